#!/usr/bin/env python3
"""Fonts as files of maps. font_test.py VTM"""
import json
import pathlib

from support import Command, main

SERIF = pathlib.Path("/usr/share/fonts/truetype/dejavu/DejaVuSerif.ttf")
SANS = SERIF.with_name("DejaVuSans.ttf")


class Fonts(Command):
    def font(self, *arguments):
        return json.loads(self.vtm("font", *arguments, "--json").stdout)

    def test_latin_takes_128_kib(self):
        figures = self.font(SERIF, "-o", "a.vtm")
        self.assertEqual(figures["glyphs"], 256)
        self.assertEqual(figures["family"], "DejaVu Serif")
        self.assertLessEqual(figures["file_bytes"], 128 << 10)
        self.assertEqual(figures["file_bytes"], (self.folder / "a.vtm").stat().st_size)
        self.assertEqual(self.json("info", "a.vtm")["glyphs"], 256)
        self.vtm("render", "a.vtm", "-o", "a.png", "-w", 200)
        alpha = self.picture("a.png").getchannel("A")
        ink = sum(alpha.getdata()) / 255 / (200 * 200)
        self.assertTrue(0.05 < ink < 0.5, ink)

    def test_a_file_of_the_font_is_extended(self):
        first = self.font(SERIF, "-o", "a.vtm", "--chars", "U+0041-U+005A")
        self.assertEqual((first["glyphs"], first["glyphs_compiled"]), (26, 26))
        more = self.font(SERIF, "-o", "a.vtm", "--chars", "U+41,61-63", "--text", "Zé")
        self.assertEqual((more["glyphs"], more["glyphs_compiled"], more["file_was_extended"]), (30, 4, True))
        again = self.font(SERIF, "-o", "a.vtm", "--chars", "U+0041", "--anew")
        self.assertEqual((again["glyphs"], again["file_was_extended"]), (1, False))
        other = self.font(SANS, "-o", "a.vtm", "--chars", "U+0041")
        self.assertEqual((other["glyphs"], other["file_was_extended"]), (1, False))

    def test_what_the_font_lacks_is_told(self):
        done = self.vtm("font", SERIF, "-o", "a.vtm", "--chars", "U+1F600-U+1F610,U+41")
        self.assertEqual(done.stderr, f"{SERIF}: warning: the font has no U+1F600, U+1F601, U+1F602, U+1F603, U+1F604 "
                                      "and 12 more\n")

    def test_bad_arguments_are_named(self):
        for arguments, cause in ((["--chars", "U+41-"], "'' is not a character such as U+00E9"),
                                 (["--chars", "x"], "'x' is not a character such as U+00E9"),
                                 (["--chars", "U+110000"], "'U+110000' is not a character such as U+00E9"),
                                 (["--chars", "U+42-U+41"], "the range 'U+42-U+41' runs backwards"),
                                 (["--variation", "bold"], "'bold' is not an axis and its value, such as wght=700")):
            done = self.vtm("font", SERIF, "-o", "a.vtm", *arguments, expect=2)
            self.assertIn(cause, done.stderr)
            self.assertNotIn("a.vtm", self.names())
        self.vtm("font", SERIF, "-o", "a.png", expect=2)
        self.vtm("font", SERIF, "-o", SERIF, expect=2)

    def test_bad_fonts_are_named(self):
        self.write("a.ttf", "no font at all")
        done = self.vtm("font", "a.ttf", "-o", "a.vtm", expect=1)
        self.assertEqual(done.stderr, "a.ttf: neither OpenType nor WOFF\n")
        (self.folder / "b.ttf").write_bytes(SERIF.read_bytes()[:2000])
        done = self.vtm("font", "b.ttf", "-o", "a.vtm", expect=1)
        self.assertTrue(done.stderr.startswith("b.ttf: "), done.stderr)
        self.vtm("font", SERIF, "-o", "a.vtm", "--face", "3", expect=1)
        self.assertNotIn("a.vtm", self.names())


if __name__ == "__main__":
    main()
