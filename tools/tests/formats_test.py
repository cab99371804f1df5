#!/usr/bin/env python3
"""Raster formats, and how much memory drawing takes. formats_test.py VTM"""
import os
import struct
import subprocess
import zlib

from PIL import Image

from support import PALE_BLUE, RED, SQUARE_COLOURS, Command, main

ON_WHITE = [(255, 0, 0), (153, 153, 255), (255, 255, 255)]


class Formats(Command):
    def colours(self, name, mode):
        with Image.open(self.folder / name) as image:
            self.assertEqual(image.mode, mode)
            return [image.getpixel((x, 10)) for x in (5, 25, 35)]

    def render(self, name, *arguments, **options):
        return self.vtm("render", self.svg, "-o", name, *arguments, **options)

    def assert_near(self, found, expected, limit=6):
        for a, b in zip(found, expected):
            self.assertLessEqual(max(abs(x - y) for x, y in zip(a, b)), limit, found)

    def test_the_suffix_decides(self):
        for name in ("a.webp", "b.WEBP"):
            self.render(name)
            self.assertEqual(self.colours(name, "RGBA"), SQUARE_COLOURS)
        self.render("a.ppm")
        self.assertTrue((self.folder / "a.ppm").read_bytes().startswith(b"P6\n40 20\n255\n"))
        self.assertEqual(self.colours("a.ppm", "RGB"), ON_WHITE)
        for name in ("a.jpg", "a.jpeg"):
            self.render(name)
            self.assert_near(self.colours(name, "RGB"), ON_WHITE)

    def test_formats_without_alpha_lie_on_the_background(self):
        self.render("a.ppm", "-b", "#0f0")
        self.assertEqual(self.colours("a.ppm", "RGB")[2], (0, 255, 0))

    def test_sixteen_bits(self):
        self.render("a.png", "--depth", "16", "--engine", "cpu")
        file = (self.folder / "a.png").read_bytes()
        self.assertEqual(struct.unpack(">IIBB", file[16:26]), (40, 20, 16, 6))
        start = file.index(b"IDAT")
        size, = struct.unpack(">I", file[start - 4:start])
        row = bytearray(zlib.decompress(file[start + 4:start + 4 + size])[:1 + 40 * 8])
        for i in range(9, len(row)):  # in the first row every filter that we use but None is a difference to the left
            row[i] = (row[i] + (row[i - 8] if row[0] else 0)) & 255
        self.assertEqual(struct.unpack(">4H", row[1 + 25 * 8:1 + 26 * 8]), (0, 0, 65535, 26214))  # 0.4 of 65535
        for engine in ("gl", "asset", "reference"):
            self.render("b.png", "--depth", "16", "--engine", engine)
            self.vtm("diff", "a.png", "b.png", "--max", "0.3")
        self.render("c.png")
        self.vtm("diff", "a.png", "c.png", "--max", "0.6")  # straight, though our truth is premultiplied
        self.render("a.ppm", "--depth", "16")
        self.assertTrue((self.folder / "a.ppm").read_bytes().startswith(b"P6\n40 20\n65535\n"))

    def test_quality(self):
        self.render("fine.jpg", "--quality", "100")
        self.render("rough.jpg", "--quality", "5")
        sizes = [(self.folder / name).stat().st_size for name in ("fine.jpg", "rough.jpg")]
        self.assertLess(sizes[1], sizes[0])
        self.render("lossy.webp", "--quality", "50")
        self.assertNotEqual((self.folder / "lossy.webp").read_bytes()[12:16], b"VP8L")

    def test_format_where_no_suffix_says_it(self):
        self.render("picture", "--format", "webp")
        self.assertTrue((self.folder / "picture").read_bytes().startswith(b"RIFF"))
        self.render("folder/", "-f", "jpeg")
        self.assertTrue((self.folder / "folder/square.jpg").exists())
        self.assertTrue(self.render("-", "-f", "ppm", text=False).stdout.startswith(b"P6"))

    def test_what_a_format_does_not_have_is_bad_usage(self):
        for name, arguments in (("a.jpg", ("--depth", "16")), ("a.png", ("--depth", "12")), ("a.png", ("--quality", "50")),
                                ("a.jpg", ("--quality", "101")), ("a.png", ("--format", "jpeg")), ("a.tiff", ()),
                                ("a", ("--format", "gif"))):
            with self.subTest(name=name, arguments=arguments):
                before = self.names()
                self.assertNotEqual(self.render(name, *arguments, expect=2).stderr, "")
                self.assertEqual(self.names(), before)
        self.assertIn("16383", self.render("a.webp", "-w", "16384", "-h", "4", expect=1).stderr)

    def test_other_formats_can_be_compared(self):
        self.render("a.webp")
        self.render("a.png")
        self.assertIn("max: 0.00", self.vtm("diff", "a.webp", "a.png").stdout)


class Bytes(Command):
    def test_the_scanner_and_its_twin_write_the_same_picture(self):
        """By rows, and of floats that are rounded at once; the largest difference is a rounding."""
        for engine in ("cpu", "asset"):
            self.vtm("render", self.svg, "-o", f"{engine}.png", "--engine", engine, "-w", "333", "-b", "#12345680")
        self.vtm("diff", "cpu.png", "asset.png", "--max", "1")

    def test_large_pictures_are_not_held(self):
        """8000 x 4000 pixels are 128 MB of bytes, and were 512 MB of floats."""
        self.skip_with_sanitizers()
        drawing = subprocess.Popen([self.program, "render", self.svg, "-o", "out.png", "--engine", "cpu", "-w", "8000"],
                                   cwd=self.folder)
        _, status, usage = os.wait4(drawing.pid, 0)
        drawing.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual(drawing.returncode, 0)
        self.assertLess(usage.ru_maxrss, 100_000)  # kB
        image = self.picture("out.png")
        self.assertEqual([image.getpixel((x, 2000)) for x in (1000, 5000)], [RED, PALE_BLUE])


if __name__ == "__main__":
    main()
