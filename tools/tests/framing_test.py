#!/usr/bin/env python3
"""Size and place: fit modes, parts, rotation, single elements, short options. framing_test.py VTM"""
from support import NOTHING, PALE_BLUE, RED, SQUARE, Command, main

GREEN = (0, 128, 0, 255)


class Framing(Command):
    def draw(self, *arguments, svg=None):
        self.vtm("render", svg or self.svg, "-o", "out.png", "--engine", "cpu", *arguments)
        return self.picture("out.png")

    def colours(self, image, *points):
        return [image.getpixel(p) for p in points]

    def test_both_sizes_contain_by_default(self):
        for arguments in ((), ("--fit", "contain")):
            image = self.draw("--width", "40", "--height", "40", *arguments)
            self.assertEqual(image.size, (40, 40))
            self.assertEqual(self.colours(image, (5, 5), (5, 12), (5, 28), (5, 35)), [NOTHING, RED, RED, NOTHING])

    def test_cover_and_stretch(self):
        image = self.draw("--width", "40", "--height", "40", "--fit", "cover")
        self.assertEqual(self.colours(image, (5, 2), (18, 39), (22, 2), (39, 39)), [RED, RED, PALE_BLUE, PALE_BLUE])
        image = self.draw("--width", "40", "--height", "40", "--fit", "stretch")
        self.assertEqual(self.colours(image, (5, 2), (19, 39), (25, 2), (35, 39)), [RED, RED, PALE_BLUE, NOTHING])

    def test_bands_beside_a_part_show_what_lies_there(self):
        image = self.draw("--view", "20,5,10,10", "--width", "30", "--height", "10")
        self.assertEqual(self.colours(image, (5, 5), (15, 5), (25, 5)), [RED, PALE_BLUE, NOTHING])

    def test_short_options(self):
        self.assertEqual(self.draw("-w", "80").size, (80, 40))
        self.assertEqual(self.draw("-h", "80").size, (160, 80))
        self.assertEqual(self.draw("-z", "3").size, (120, 60))
        self.assertEqual(self.draw("--zoom", "3").size, (120, 60))
        self.assertEqual(self.draw("-b", "white").getpixel((35, 10)), (255, 255, 255, 255))

    def test_quarter_turns(self):
        image = self.draw("--rotate", "90")
        self.assertEqual(image.size, (20, 40))
        self.assertEqual(self.colours(image, (10, 5), (10, 25), (10, 35)), [RED, PALE_BLUE, NOTHING])
        image = self.draw("--rotate", "-90")
        self.assertEqual(self.colours(image, (10, 5), (10, 15), (10, 35)), [NOTHING, PALE_BLUE, RED])
        self.assertEqual(list(self.draw("--rotate", "360").getdata()), list(self.draw().getdata()))

    def test_engines_agree_on_turned_pictures(self):
        for view in ((), ("--view", "19,9,1e-3,1e-3")):
            pictures = []
            for engine in ("cpu", "asset", "reference"):
                self.vtm("render", self.svg, "-o", "out.png", "--engine", engine, "--rotate", "33", "-w", "50", *view)
                pictures.append(list(self.picture("out.png").getdata()))
            for other in pictures[1:]:
                worst = max(abs(a - b) * min(p[3], q[3]) / 255 for p, q in zip(pictures[0], other) for a, b in zip(p, q))
                self.assertLessEqual(worst, 2)

    def test_bad_values(self):
        out = ("render", self.svg, "-o", "out.png")
        self.assertIn("not one of contain, cover, stretch", self.vtm(*out, "--fit", "meet", expect=2).stderr)
        for value in ("north", "nan", "1e999", "90deg"):
            self.assertIn("degrees", self.vtm(*out, "--rotate", value, expect=2).stderr)
        self.vtm(*out, "--rotate", "45", "--debug-view", "cells", expect=2)

    def test_a_size_for_what_has_none(self):
        none = self.write("none.svg", "<svg xmlns='http://www.w3.org/2000/svg'><rect width='9' height='9'/></svg>")
        self.assertEqual(self.draw(svg=none).size, (100, 100))
        self.assertEqual(self.draw("--default-width", "30", "--default-height", "20", svg=none).size, (30, 20))
        box = self.write("box.svg", "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 12 8'><rect width='9' height='9'/></svg>")
        self.assertEqual(self.draw(svg=box).size, (12, 8))


class SingleElements(Command):
    def setUp(self):
        super().setUp()
        self.svg = self.write("parts.svg", """<svg xmlns="http://www.w3.org/2000/svg" width="100" height="60" style="background: white">
  <defs><rect id="hidden" width="5" height="5"/><g id="used"><rect width="6" height="4" fill="green"/></g></defs>
  <rect width="100" height="60" fill="red"/>
  <g opacity="0.5" transform="translate(10 20)" fill="green" clip-path="url(#nowhere)">
    <rect id="one" width="30" height="10"/>
    <rect width="90" height="30" fill="blue"/>
  </g>
  <use id="copy" href="#used" x="50" y="40"/>
  <path id="line" d="M10 5H30" stroke="green" stroke-width="4"/>
  <rect id="far" x="500" width="9" height="9"/>
</svg>""")

    def draw(self, name, *arguments, expect=0):
        return self.vtm("render", self.svg, "-o", "out.png", "--export-id", name, *arguments, expect=expect)

    def test_it_fills_the_raster_without_its_ancestors_effects(self):
        for name, size in (("one", (30, 10)), ("copy", (6, 4))):
            with self.subTest(name=name):
                self.draw(name)
                image = self.picture("out.png")
                self.assertEqual(image.size, size)
                self.assertEqual(set(image.getdata()), {GREEN})

    def test_its_size_is_rounded_up_to_whole_pixels(self):
        svg = self.write("s.svg", '<svg xmlns="http://www.w3.org/2000/svg" width="100" height="60">'
                         '<rect id="it" x="10.1" y="20" width="4.3" height="2.6"/></svg>')
        self.vtm("render", svg, "-o", "s.png", "-i", "it")
        image = self.picture("s.png")
        self.assertEqual(image.size, (5, 3))
        alpha = [[image.getpixel((x, y))[3] for x in (0, 3, 4)] for y in (0, 2)]
        for drawn, wanted in zip(sum(alpha, []), (255, 255, 255 * .3, 255 * .6, 255 * .6, 255 * .18)):
            self.assertLessEqual(abs(drawn - wanted), 1, alpha)

    def test_strokes_are_in_the_bounds(self):
        self.draw("line")
        drawn = [p for p in self.picture("out.png").getdata() if p[3] > 0]
        self.assertEqual((len(drawn), set(drawn)), (20 * 4, {GREEN}))

    def test_bounds_of_strokes_are_tight(self):
        # A mitre reaches sqrt(2) times half the width beyond its right angle; butt ends do not reach along the line.
        shapes = {"mitre": ('<path id="{}" d="M20 40L40 20L60 40" stroke-width="10" fill="none"/>',
                            (20 - 5 / 2**.5, 20 - 5 * 2**.5, 60 + 5 / 2**.5, 40 + 5 / 2**.5)),
                  "bevel": ('<path id="{}" d="M20 40L40 20L60 40" stroke-width="10" stroke-miterlimit="1" fill="none"/>',
                            (20 - 5 / 2**.5, 20 - 5 / 2**.5, 60 + 5 / 2**.5, 40 + 5 / 2**.5)),
                  "square": ('<path id="{}" d="M20 40H60" stroke-width="10" stroke-linecap="square"/>', (15, 35, 65, 45)),
                  "circle": ('<circle id="{}" cx="50" cy="50" r="20" stroke-width="10"/>', (25, 25, 75, 75)),
                  "dashes": ('<path id="{}" d="M10 40H60" stroke-width="10" stroke-dasharray="10 20"/>', (10, 35, 50, 45)),
                  "scaled": ('<circle id="{}" r="1" transform="matrix(20 0 0 10 50 50)"/>', (20, 35, 80, 65))}
        for name, (shape, expected) in shapes.items():
            with self.subTest(name=name):
                svg = self.write("s.svg", '<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100" stroke="red">'
                                 + shape.format("it") + "</svg>")
                scale = 16
                self.vtm("render", svg, "-o", "s.png", "-i", "it", "-z", scale)
                size = (expected[2] - expected[0], expected[3] - expected[1])
                for drawn, wanted in zip(self.picture("s.png").size, size):
                    self.assertLessEqual(abs(drawn - scale * wanted), 1, (name, self.picture("s.png").size, size))

    def test_on_its_place_in_the_picture(self):
        self.draw("one", "--view", "0,0,100,60")
        image = self.picture("out.png")
        self.assertEqual([image.getpixel(p) for p in ((5, 25), (12, 22), (38, 28), (42, 25), (12, 45))],
                         [NOTHING, GREEN, GREEN, NOTHING, NOTHING])

    def test_what_cannot_be_drawn_is_an_error(self):
        self.assertRegex(self.draw("absent", expect=1).stderr, r'parts\.svg:1:\d+: no element has the id "absent"')
        for name in ("hidden", "far"):
            self.assertRegex(self.draw(name, expect=1).stderr, rf"parts\.svg:\d+:\d+: #{name}: the element draws nothing")
        self.vtm("compile", self.svg, "-o", "parts.vtm")
        self.assertIn("--export-id", self.vtm("render", "parts.vtm", "-o", "o.png", "-i", "one", expect=1).stderr)
        self.draw("", expect=2)


class StyleSheets(Command):
    def test_it_wins_over_attributes_and_loses_to_the_document(self):
        svg = self.write("styled.svg", """<svg xmlns="http://www.w3.org/2000/svg" width="30" height="10">
  <style>.b { fill: #00f }</style>
  <rect width="10" height="10" fill="red"/><rect class="b" x="10" width="10" height="10"/>
  <rect x="20" width="10" height="10" style="fill: #f00"/></svg>""")
        self.write("green.css", "rect { fill: green } .b { fill: green }")
        self.vtm("render", svg, "-o", "out.png", "--stylesheet", "green.css")
        image = self.picture("out.png")
        self.assertEqual([image.getpixel((x, 5)) for x in (5, 15, 25)], [GREEN, (0, 0, 255, 255), RED])
        self.assertIn("absent.css", self.vtm("render", svg, "-o", "o.png", "-s", "absent.css", expect=1).stderr)


if __name__ == "__main__":
    main()
