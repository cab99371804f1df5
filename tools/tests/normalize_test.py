#!/usr/bin/env python3
"""vtm normalize: what is written draws as what was read. normalize_test.py VTM"""
import os

from support import SQUARE, SQUARE_COLOURS, Command, main

DRAWING = """<svg xmlns="http://www.w3.org/2000/svg" width="2in" viewBox="0 0 60 30">
  <style>.warm { fill: url(#fire) }</style>
  <linearGradient id="fire"><stop stop-color="red"/><stop offset="1" stop-color="gold"/></linearGradient>
  <clipPath id="cut"><circle cx="15" cy="15" r="12"/></clipPath>
  <mask id="fade"><rect width="60" height="30" fill="#777"/></mask>
  <pattern id="dots" width="4" height="4" patternUnits="userSpaceOnUse"><circle cx="2" cy="2" r="1"/></pattern>
  <g clip-path="url(#cut)"><rect class="warm" width="30" height="30"/></g>
  <g id="right" mask="url(#fade)"><rect x="30" y="5" width="20" height="20" fill="url(#dots)" stroke="blue"/></g>
  <g style="mix-blend-mode:multiply"><rect x="10" y="10" width="30" height="5" fill="lime"/></g>
</svg>
"""


class Normalize(Command):
    def test_draws_the_same(self):
        for text in (SQUARE, DRAWING):
            self.write("in.svg", text)
            self.vtm("normalize", "in.svg", "-o", "out.svg")
            for mode in ("exact", "compat"):
                for name in ("in", "out"):
                    self.vtm("render", f"{name}.svg", "-o", f"{name}.png", "--mode", mode, "--engine", "asset")
                self.vtm("diff", "in.png", "out.png", "--max", "1")

    def test_again_is_the_same_text(self):
        self.write("in.svg", DRAWING)
        self.vtm("normalize", "in.svg", "-o", "once.svg")
        self.vtm("normalize", "once.svg", "-o", "twice.svg")
        self.assertEqual((self.folder / "once.svg").read_text(), (self.folder / "twice.svg").read_text())

    def test_text_is_outlines(self):
        self.write("in.svg", SQUARE.replace("</svg>", '<text id="a" x="5" y="15">VTM</text></svg>'))
        self.vtm("normalize", "in.svg", "-o", "out.svg")
        out = (self.folder / "out.svg").read_text()
        self.assertNotIn("<text", out)
        self.assertGreater(out.count(" d="), SQUARE.count("<rect") + 2)

    def test_streams(self):
        with open(self.svg) as file:
            written = self.vtm("normalize", "-", "-o", "-", stdin=file).stdout
        self.assertTrue(written.startswith("<svg "))
        self.write("out.svg", written)
        self.vtm("render", "out.svg", "-o", "out.png")
        image = self.picture("out.png")
        self.assertEqual([image.getpixel((x, 10)) for x in (5, 25, 35)], SQUARE_COLOURS)

    def test_one_element_is_as_large_as_its_bounds(self):
        self.write("in.svg", DRAWING)
        self.vtm("normalize", "in.svg", "-o", "out.svg", "--export-id", "right")
        for name, more in (("in", ("--export-id", "right")), ("out", ())):
            self.vtm("render", f"{name}.svg", "-o", f"{name}.png", "-w", "90", "--engine", "asset", *more)
        self.vtm("diff", "in.png", "out.png", "--max", "1")
        self.assertIn("#none", self.vtm("normalize", "in.svg", "-o", "out.svg", "-i", "#none", expect=1).stderr)

    def test_options_of_the_importer(self):
        self.write("sheet.css", "rect { fill: lime }")
        self.vtm("normalize", self.svg, "-o", "out.svg", "-s", "sheet.css")
        self.assertIn("#00ff00", (self.folder / "out.svg").read_text())
        self.write("filtered.svg", SQUARE.replace("<rect ", '<rect filter="url(#none)" '))
        self.assertIn("#none", self.vtm("normalize", "filtered.svg", "-o", "new.svg", "--strict", expect=1).stderr)
        self.assertFalse((self.folder / "new.svg").exists())

    def test_what_is_refused(self):
        self.vtm("compile", self.svg, "-o", "a.vtm")
        self.assertIn("needs an SVG or a .vtmtree file", self.vtm("normalize", "a.vtm", "-o", "b.svg", expect=1).stderr)
        self.vtm("normalize", self.svg, "-o", "b.png", expect=2)
        before = self.svg.read_bytes()
        os.link(self.svg, self.folder / "link.svg")
        self.vtm("normalize", self.svg, "-o", "link.svg", expect=2)
        self.assertEqual(self.svg.read_bytes(), before)


if __name__ == "__main__":
    main()
