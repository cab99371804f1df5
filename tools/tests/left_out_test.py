#!/usr/bin/env python3
"""What vtm says of what it leaves out: filters in error, anything else; --strict. left_out_test.py VTM"""
from support import SQUARE, Command, main

TEXT = "<svg xmlns='http://www.w3.org/2000/svg' width='40' height='20'>\n"


class LeftOut(Command):
    def test_filters_in_error_are_named(self):
        self.write("a.svg", f"{TEXT} <filter id='f'><feDiffuseLighting/></filter>"
                   "<rect filter='url(#f)' width='9' height='9'/></svg>")
        said = "a.svg:2:18: warning: <feDiffuseLighting>: is in error; its result is transparent\n"
        for arguments in (("render", "a.svg", "-o", "o.png"), ("compile", "a.svg", "-o", "o.vtm"), ("info", "a.svg")):
            self.assertEqual(self.vtm(*arguments).stderr, said)

    def test_filters_are_no_loss(self):
        self.write("a.svg", TEXT + "<rect style='filter: blur(2px)' width='9' height='9'/></svg>")
        self.assertEqual(self.vtm("render", "a.svg", "-o", "o.png", "--strict").stderr, "")

    def test_filters_that_are_drawn_now(self):
        self.write("a.svg", TEXT + "<rect style='filter: blur(2px)' width='9' height='9'/></svg>")
        said = self.vtm("compile", "a.svg", "-o", "a.vtm", "--filter-pixels", "256").stderr
        self.assertIn("is an image, drawn with 256 pixels along the picture's longer side", said)
        self.assertIn("filters:", self.vtm("info", "a.vtm").stdout)
        self.assertEqual(self.vtm("compile", "a.svg", "-o", "a.vtm", "--filter-pixels", "9999", expect=2).returncode, 2)

    def test_once_a_file_of_a_batch(self):
        for name in ("a", "b"):
            self.write(f"{name}.svg", TEXT + "<rect width='9' height='9' filter='url(#f)'/></svg>")
        said = self.vtm("render", "a.svg", "b.svg", "-o", "pictures").stderr
        self.assertEqual(said.count('"#f" refers to an element of the wrong kind'), 2)

    def test_what_is_not_shown_is_no_loss(self):
        self.write("a.svg", TEXT + "<g filter='blur(1px)' display='none'/><defs><foreignObject/></defs></svg>")
        self.assertEqual(self.vtm("render", "a.svg", "-o", "o.png", "--strict").stderr, "")


class Strict(Command):
    LOSSES = {"font": "<text font-family='No Such Family'>a</text>", "filter": "<rect style='filter:url(#f)' width='9' height='9'/>",
              "element": "<foreignObject/>", "value": "<rect width='9' height='9' fill='octarine'/>",
              "reference": "<use href='#none'/>", "image": "<image href='none.png' width='9' height='9'/>"}

    def test_what_is_left_out_is_an_error(self):
        for name, body in self.LOSSES.items():
            with self.subTest(name=name):
                self.write("a.svg", TEXT + body + "</svg>")
                for arguments in (("render", "a.svg", "-o", "o.png"), ("compile", "a.svg", "-o", "o.vtm"),
                                  ("info", "a.svg")):
                    said = self.vtm(*arguments, "--strict", expect=1).stderr
                    self.assertRegex(said, r"^a\.svg:2:2: warning: .*\na\.svg: --strict: .*\n$")
                self.assertEqual(self.names(), ["a.svg", "square.svg"])
                self.vtm("render", "a.svg", "-o", "o.png")
                (self.folder / "o.png").unlink()

    def test_the_old_picture_stays(self):
        self.write("a.svg", TEXT + "<foreignObject/></svg>")
        old = self.write("o.png", "old")
        self.vtm("render", "a.svg", "-o", "o.png", "--strict", expect=1)
        self.assertEqual(old.read_text(), "old")

    def test_whole_pictures_are_drawn(self):
        self.assertEqual(self.vtm("render", self.svg, "-o", "o.png", "--strict").stderr, "")
        self.assert_square("o.png")

    def test_a_batch_goes_on(self):
        self.write("a.svg", TEXT + "<foreignObject/></svg>")
        said = self.vtm("render", "a.svg", self.svg, "-o", "pictures", "--strict", expect=1).stderr
        self.assertIn("1 of 2 drawn, 1 failed", said)
        self.assert_square("pictures/square.png")

    def test_what_the_papers_model_lacks(self):
        self.write("a.svg", SQUARE.replace("<rect x", "<rect style='mix-blend-mode: multiply' x"))
        said = self.vtm("render", "a.svg", "-o", "o.png", "--mode", "paper").stderr
        self.assertIn("the paper's model", said)
        self.vtm("render", "a.svg", "-o", "o.png", "--mode", "paper", "--strict", expect=1)


class FontOptions(Command):
    OPTIONS = ("--font-dir", "--serif-family", "--sans-serif-family", "--cursive-family", "--fantasy-family",
               "--monospace-family", "--default-family")

    def test_each_is_accepted(self):
        (self.folder / "fonts").mkdir()
        given = [word for option in self.OPTIONS for word in (option, "fonts")] + ["--no-system-fonts"]
        self.assertEqual(self.vtm("render", self.svg, "-o", "o.png", "--strict", *given).stderr, "")

    def test_a_family_that_is_not_there_is_named_once(self):
        self.write("a.svg", TEXT + "<text font-family='None'>a</text><text font-family='None'>b</text></svg>")
        self.assertRegex(self.vtm("render", "a.svg", "-o", "o.png").stderr,
                         r'^a\.svg:2:2: warning: <text>: there is no font of the family "None"; "[^"]+" is used\n$')

    def test_without_any_font_text_is_named(self):
        self.write("a.svg", TEXT + "<text>a</text></svg>")
        said = self.vtm("render", "a.svg", "-o", "o.png", "--no-system-fonts").stderr
        self.assertEqual(said, "a.svg:2:2: warning: <text>: there are no fonts; it is left out\n")

    def test_a_folder_that_does_not_exist_is_bad_usage(self):
        self.assertIn("absent", self.vtm("render", self.svg, "-o", "o.png", "--font-dir", "absent", expect=2).stderr)


if __name__ == "__main__":
    main()
