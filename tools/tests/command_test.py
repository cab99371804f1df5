#!/usr/bin/env python3
"""The vtm command as its users run it. command_test.py VTM"""
import json
import os
import pathlib
import struct
import subprocess
import zlib

from PIL import Image, ImageStat

from support import NOTHING, PALE_BLUE, RED, SQUARE, Command, main


class Drawing(Command):
    def draw(self, *arguments, engine="asset"):
        self.vtm("render", self.svg, "-o", "out.png", "--engine", engine, *arguments)
        return self.picture("out.png")


class Render(Drawing):
    def test_default_size_and_colours(self):
        for engine in ("gl", "asset", "reference"):
            with self.subTest(engine=engine):
                image = self.draw(engine=engine)
                self.assertEqual(image.size, (40, 20))
                self.assertEqual([image.getpixel((x, 10)) for x in (10, 25, 35)], [RED, PALE_BLUE, NOTHING])

    def test_compat_mode(self):
        image = self.draw("--mode", "compat", engine="gl")
        self.assertEqual([image.getpixel((x, 10)) for x in (10, 25, 35)], [RED, PALE_BLUE, NOTHING])

    def test_one_dimension_keeps_the_aspect(self):
        self.assertEqual(self.draw("--width", "100").size, (100, 50))
        self.assertEqual(self.draw("--height", "100").size, (200, 100))
        self.assertEqual(self.draw("--width", "30", "--height", "30").size, (30, 30))
        self.assertEqual(self.draw("--scale", "2.5").size, (100, 50))
        self.assertEqual(self.draw("--width", "1").size, (1, 1))

    def test_view_fills_the_raster(self):
        image = self.draw("--view", "15,5,10,10", "--width", "50")
        self.assertEqual(image.size, (50, 50))
        self.assertEqual([image.getpixel((x, 25)) for x in (5, 45)], [RED, PALE_BLUE])
        image = self.draw("--view", "-10,0,20,20")
        self.assertEqual([image.getpixel((x, 10)) for x in (5, 15)], [NOTHING, RED])

    def test_zoom_is_exact(self):
        size, edge = 2.0**-30, 20.3  # which is no border of a cell
        self.svg = self.write("edge.svg", SQUARE.replace('x="20"', f'x="{edge}"').replace('width="20" h', f'width="{edge}" h'))
        image = self.draw("--view", f"{edge - size / 2!r},5,{size!r},{size!r}", "--width", "16", engine="cpu")
        self.assertEqual([image.getpixel((x, 8)) for x in (0, 7, 8, 15)], [RED, RED, PALE_BLUE, PALE_BLUE])

    def test_zoom_beyond_what_a_file_shows_is_a_warning(self):
        self.vtm("compile", self.svg, "-o", "square.vtm")
        drawing = ("render", "square.vtm", "-o", "out.png", "--engine", "cpu")
        self.assertEqual(self.vtm(*drawing, "--width", "400").stderr, "")
        self.assertIn("boundaries may be off by", self.vtm(*drawing, "--view", "20,5,1e-6,1e-6", "--width", "16").stderr)
        beyond_doubles = ("render", self.svg, "-o", "out.png", "--engine", "cpu", "--width", "16")
        for size in ("1e-13", "1e-30"):
            self.assertIn("double precision", self.vtm(*beyond_doubles, "--view", f"20,5,{size},{size}").stderr)

    def test_background(self):
        image = self.draw("--background", "white")
        self.assertEqual([image.getpixel((x, 10)) for x in (10, 25, 35)],
                         [RED, (153, 153, 255, 255), (255, 255, 255, 255)])
        self.assertEqual(self.draw("--background", "#0f08").getpixel((35, 10)), (0, 255, 0, 136))

    def test_straight_alpha(self):
        self.assertEqual(self.draw().getpixel((25, 10)), PALE_BLUE)

    def test_program_cache(self):
        first = self.draw("--program-cache", "programs", engine="gl")
        self.assertEqual(list(self.draw("--program-cache", "programs", engine="gl").getdata()), list(first.getdata()))

    def test_debug_views(self):
        plain = list(self.draw("--width", "80").getdata())
        for name in ("cells", "depth", "pieces", "cost", "regions", "fallback", "tiles"):
            with self.subTest(name=name):
                pictures = [list(self.draw("--debug-view", name, "--width", "80", engine=e).getdata())
                            for e in ("gl", "asset")]
                self.assertNotEqual(pictures[0], plain)
                worst = max(abs(a - b) for p, q in zip(*pictures) for a, b in zip(p, q))
                self.assertLessEqual(worst, 1)

    def test_debug_views_have_the_legends_colours(self):
        # A whole picture of one paint: level 0, no pieces, 5 ns a pixel.
        whole = self.write("whole.svg", "<svg xmlns='http://www.w3.org/2000/svg' width='16' height='16'>"
                           "<rect width='16' height='16' fill='red'/></svg>")
        for name, expected in (("depth", (0x1a, 0x26, 0x5c, 255)), ("pieces", (235, 235, 235, 255)),
                               ("cost", (0x1a, 0x26, 0x5c, 255))):
            with self.subTest(name=name):
                self.vtm("render", whole, "-o", "out.png", "--debug-view", name, "--width", "64")
                self.assertEqual(self.picture("out.png").getpixel((32, 32)), expected)

    def test_debug_views_that_there_are_not(self):
        out = ("render", self.svg, "-o", "out.png", "--debug-view")
        self.assertIn("not one of cells", self.vtm(*out, "lines", expect=2).stderr)
        for arguments in (("depth", "--mode", "compat"), ("depth", "--mode", "paper"),
                          ("depth", "--engine", "reference")):
            self.assertIn("needs exact mode", self.vtm(*out, *arguments, expect=1).stderr)
        self.vtm("compile", self.svg, "-o", "square.vtm")
        self.assertIn("SVG file", self.vtm("render", "square.vtm", "-o", "out.png", "--debug-view", "fallback",
                                           expect=1).stderr)
        self.vtm("render", "square.vtm", "-o", "out.png", "--debug-view", "depth")

    def test_many_inputs_into_a_directory(self):
        second = self.write("second.svg", SQUARE)
        done = self.vtm("render", self.svg, second, "-o", "pictures")
        self.assertEqual({p.name for p in (self.folder / "pictures").iterdir()}, {"square.png", "second.png"})
        self.assertIn("2 of 2 drawn, 0 failed", done.stderr)

    def test_batch_goes_on_after_a_bad_file(self):
        bad = self.write("bad.svg", "<svg xmlns='http://www.w3.org/2000/svg'>\n<rect></svg>")
        batch = self.write("list.tsv", f"{bad}\ta.png\n{self.folder}/absent.svg\tb.png\n{self.svg}\tdeep/c.png\n")
        done = self.vtm("render", "--batch", batch, expect=1)
        self.assertRegex(done.stderr, r"bad\.svg:2:\d+: ")
        self.assertIn("absent.svg", done.stderr)
        self.assertTrue(done.stderr.endswith("1 of 3 drawn, 2 failed\n"), done.stderr)
        self.assertEqual(self.picture("deep/c.png").size, (40, 20))
        self.assertFalse((self.folder / "a.png").exists())

    def test_json(self):
        report = json.loads(self.vtm("render", self.svg, "-o", "out.png", "--json").stdout)
        for key in ("width", "height", "bytes", "regions", "leaves", "pieces"):
            self.assertIsInstance(report[key], int, key)
        self.assertEqual((report["width"], report["height"]), (40, 20))
        for stage in ("read", "parse", "compile", "lower", "start", "upload", "render", "write"):
            self.assertGreaterEqual(report["stages_ms"][stage], 0, stage)

    def test_json_of_a_name_that_is_no_utf8(self):
        name = b"\xff.svg"
        (self.folder / os.fsdecode(name)).write_text(SQUARE)
        done = subprocess.run([os.fsencode(self.program), b"render", name, b"-o", b"out.png", b"--json"],
                              capture_output=True, cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads(done.stdout)["input"], "\ufffd.svg")

    def test_warnings_name_their_place(self):
        path = self.write("warned.svg", '<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9">\n'
                          '  <rect width="9" height="9" filter="url(#absent)"/>\n'
                          '  <image href="absent.png" width="9" height="9"/>\n</svg>')
        done = self.vtm("render", path, "-o", "out.png")
        self.assertRegex(done.stderr, r"warned\.svg:3:\d+: warning: ")


class BadInput(Drawing):
    def test_parse_errors_name_their_place(self):
        for name, text in (("empty.svg", ""), ("cut.svg", SQUARE[:100]), ("other.svg", "<html/>")):
            path = self.write(name, text)
            done = self.vtm("render", path, "-o", "out.png", expect=1)
            self.assertRegex(done.stderr, rf"{name}:\d+:\d+: ")

    def test_absent_file(self):
        self.assertIn("absent.svg", self.vtm("render", "absent.svg", "-o", "out.png", expect=1).stderr)
        self.assertIn("absent.vtm", self.vtm("info", "absent.vtm", expect=1).stderr)
        self.assertIn("absent.tsv", self.vtm("render", "--batch", "absent.tsv", expect=1).stderr)

    def test_output_that_cannot_be_written(self):
        (self.folder / "file").touch()
        self.assertIn("file", self.vtm("render", self.svg, "-o", "file/out.png", expect=1).stderr)

    def test_damaged_asset(self):
        path = self.write("damaged.vtm", "VTM?")
        self.assertIn("damaged.vtm: ", self.vtm("render", path, "-o", "out.png", expect=1).stderr)

    def test_picture_too_large(self):
        path = self.write("large.svg", SQUARE.replace('width="40" height="20"', 'width="100000" height="100000"'))
        done = self.vtm("render", path, "-o", "out.png", expect=1)
        self.assertIn("100,000 x 100,000 pixels are too many (the limit is 16,384 per side and 134,217,728 in all)", done.stderr)
        self.assertEqual(self.draw("--width", "64").size, (64, 32))

    def test_huge_sizes_are_readable(self):
        done = self.vtm("render", self.svg, "-o", "out.png", "--zoom", "1e60", expect=1)
        self.assertIn("4e+61 x 2e+61 pixels are too many", done.stderr)

    def test_batch_line_without_tab(self):
        batch = self.write("list.tsv", "a.svg b.png\n")
        self.assertIn("list.tsv:1:1: ", self.vtm("render", "--batch", batch, expect=1).stderr)

    def test_not_enough_memory(self):
        """Within 1 GiB of address space a picture of 2 GiB is an error, not a crash."""
        self.skip_with_sanitizers()
        shell = 'ulimit -v 1048576 && exec "$0" "$@"'
        done = self.shell(shell, "render", self.svg, "-o", "out.png", "--engine", "asset", "--width", "16000",
                          "--height", "8000", expect=1)
        self.assertIn("square.svg: not enough memory", done.stderr)


class BadUsage(Drawing):
    def test_exit_code_is_two(self):
        for arguments in ([], ["gone"], ["render"], ["render", self.svg], ["render", self.svg, "-o"],
                          ["render", self.svg, "-o", "o.png", "--width", "0"],
                          ["render", self.svg, "-o", "o.png", "--width", "100000", "--height", "100000"],
                          ["render", self.svg, "-o", "o.png", "--scale", "0"],
                          ["render", self.svg, "-o", "o.png", "--scale", "2", "--width", "9"],
                          ["render", self.svg, "-o", "o.png", "--view", "1,2,3"],
                          ["render", self.svg, "-o", "o.png", "--view", "0,0,0,9"],
                          ["render", self.svg, "-o", "o.png", "--engine", "steam"],
                          ["render", self.svg, "-o", "o.png", "--mode", "fancy"],
                          ["render", self.svg, "-o", "o.png", "--background", "plaid"],
                          ["render", self.svg, "-o", "o.png", "--tolerance", "2"],
                          ["render", self.svg, self.svg, "-o", "o.png"],
                          ["render", self.svg, self.svg, "-o", "pictures/"],
                          ["render", self.svg, "-o", "o.png", "--batch", "list"], ["diff", "a.png"]):
            with self.subTest(arguments=arguments):
                self.assertNotEqual(self.vtm(*arguments, expect=2).stderr, "")
        self.assertFalse((self.folder / "o.png").exists())

    def test_paper_mode(self):
        for engine in ("gl", "asset"):
            with self.subTest(engine=engine):
                image = self.draw("--mode", "paper", engine=engine)
                self.assertEqual([image.getpixel((x, 10)) for x in (10, 25, 35)], [RED, PALE_BLUE, NOTHING])
        report = json.loads(self.vtm("render", self.svg, "-o", "out.png", "--mode", "paper", "--engine", "asset",
                                     "--json").stdout)
        self.assertLessEqual(report["lookups"]["masks"], 2)

    def test_help_and_version(self):
        self.assertIn("render", self.vtm("--help").stdout)
        self.assertIn("--batch", self.vtm("render", "--help").stdout)
        self.assertRegex(self.vtm("--version").stdout, r"vtm \d+\.\d+\.\d+")


class CompileAndInfo(Drawing):
    KEYS = ("bytes", "prefilter_bytes", "leaves", "pieces", "fallback_leaves", "regions", "max_depth")

    def check_figures(self, report):
        for key in self.KEYS:
            self.assertIsInstance(report[key], int, key)
        self.assertEqual(report["prefilter_bytes"], 0)
        self.assertEqual(report["fallback_leaves"], 0)
        self.assertGreater(report["bytes"], 0)

    def check_proof(self, report):
        self.assertGreater(report["proven_error"], 0)
        self.assertLessEqual(report["proven_error"], 1 / 65536)
        self.assertEqual(report["unproven_squares"], [])
        self.assertEqual(report["sampled_strokes"], 0)

    def test_what_repeats_is_stored_once_unless_asked_otherwise(self):
        flower = "M0-9C5-9 9-5 9 0C9 5 5 9 0 9C-4 4 -8 6 -9 0C-9-5-5-9 0-9Z"
        self.write("repeats.svg", '<svg xmlns="http://www.w3.org/2000/svg" width="400" height="400">' + "".join(
            f'<path d="{flower}" fill="#36c" transform="translate({20 * x + 10} {20 * y + 10})"/>'
            for x in range(20) for y in range(20)) + "</svg>")
        self.vtm("compile", "repeats.svg", "-o", "once.vtm")
        self.vtm("compile", "repeats.svg", "-o", "each.vtm", "--no-instances")
        once, each = (json.loads(self.vtm("info", name, "--json").stdout) for name in ("once.vtm", "each.vtm"))
        self.assertEqual((once["instances"], each["instances"]), (400, 0))
        self.assertLess(once["bytes"] * 10, each["bytes"])
        for engine in ("cpu", "gl"):
            for name in ("once", "each"):
                self.vtm("render", name + ".vtm", "-o", name + ".png", "--engine", engine)
            self.vtm("diff", "once.png", "each.png", "--max", "4", "--mean", "0.1")
        self.vtm("render", "once.vtm", "-o", "cells.png", "--debug-view", "cells")

    def test_compiled_file_draws_the_same(self):
        report = json.loads(self.vtm("compile", self.svg, "-o", "square.vtm", "--json").stdout)
        self.check_figures(report)
        self.check_proof(report)
        for stage in ("parse", "lower", "compile"):
            self.assertGreaterEqual(report["stages_ms"][stage], 0, stage)
        self.assertEqual(report["file_bytes"], (self.folder / "square.vtm").stat().st_size)
        self.vtm("render", "square.vtm", "-o", "compiled.png", "--width", "100", "--engine", "asset")
        self.assertEqual(self.picture("compiled.png").tobytes(), self.draw("--width", "100").tobytes())
        self.check_figures(json.loads(self.vtm("info", "square.vtm", "--json").stdout))

    def test_info_of_svg(self):
        report = json.loads(self.vtm("info", self.svg, "--json").stdout)
        self.check_figures(report)
        self.check_proof(report)
        self.assertEqual((report["width"], report["height"], report["mode"]), (40, 20, "exact"))
        for stage in ("parse", "lower", "compile"):
            self.assertGreaterEqual(report["stages_ms"][stage], 0, stage)
        text = self.vtm("info", self.svg).stdout
        self.assertIn("leaves: ", text)
        self.assertRegex(text, r"proven_error: [1-9]\.\d+e-0[56]")

    def test_filters_that_are_drawn(self):
        drawing = self.folder / "blurred.svg"
        drawing.write_text('<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"><filter id="f">'
                           '<feGaussianBlur stdDeviation="1"/></filter>'
                           '<rect x="2" y="2" width="5" height="5" filter="url(#f)"/></svg>')
        for pixels, filters, images in (0, 1, 0), (64, 0, 1):
            self.vtm("compile", drawing, "-o", "blurred.vtm", "--filter-pixels", str(pixels))
            report = json.loads(self.vtm("info", "blurred.vtm", "--json").stdout)
            self.assertEqual((report["filter_pixels"], report["filters"], report["images"]),
                             (pixels, filters, images))

    def test_prefilter(self):
        """The size of a real drawing's, its bytes beside those of the tree, and the last level's mean."""
        drawing = pathlib.Path(__file__).resolve().parents[2] / "examples" / "rose_window.svg"
        self.vtm("compile", drawing, "-o", "plain.vtm")
        plain = json.loads(self.vtm("info", "plain.vtm", "--json").stdout)
        made = json.loads(self.vtm("compile", drawing, "-o", "filtered.vtm", "--prefilter", "--json").stdout)
        self.assertGreaterEqual(made["stages_ms"]["prefilter"], 0)
        report = json.loads(self.vtm("info", "filtered.vtm", "--json").stdout)
        self.assertEqual((report["bytes"], plain["prefilter_bytes"]), (plain["bytes"], 0))
        self.assertGreaterEqual(report["prefilter_width"], 16)
        self.assertLessEqual(report["prefilter_width"], 512)
        section = next(s for s in report["sections"] if s["name"] == "prefilter")
        self.assertEqual(section["bytes"], report["prefilter_bytes"])
        file = (self.folder / "filtered.vtm").read_bytes()
        last = file[section["offset"] + section["bytes"] - 4:][:4]
        self.vtm("render", drawing, "-o", "whole.png", "--engine", "asset", "--width", "256")
        self.assertTrue(all(pixel[3] == 255 for pixel in self.picture("whole.png").getdata()))
        for mean, of in zip(last, ImageStat.Stat(self.picture("whole.png")).mean):
            self.assertAlmostEqual(mean, of, delta=1)

    def test_info_lists_the_sections(self):
        self.vtm("compile", self.svg, "-o", "square.vtm")
        sections = json.loads(self.vtm("info", "square.vtm", "--json").stdout)["sections"]
        self.assertEqual([s["name"] for s in sections[:4]], ["picture", "maps", "commands", "nodes"])
        for section in sections:
            self.assertEqual((section["offset"] % 64, section["intact"]), (0, True), section)
            self.assertEqual(section["bytes"], section["count"] * section["record_bytes"])
        self.assertRegex(self.vtm("info", "square.vtm").stdout, r"\npaints .* ok\n")

    def test_info_of_a_damaged_file_names_the_section(self):
        self.vtm("compile", self.svg, "-o", "square.vtm")
        path = self.folder / "square.vtm"
        paints = next(s for s in json.loads(self.vtm("info", path, "--json").stdout)["sections"]
                      if s["name"] == "paints")
        file = bytearray(path.read_bytes())
        file[paints["offset"] + 5] ^= 1
        path.write_bytes(file)
        done = self.vtm("info", path, expect=1)
        self.assertIn("section paints: checksum does not match", done.stderr)
        self.assertRegex(done.stdout, r"\npaints .* DAMAGED: is [0-9a-f]{8}\n")
        report = json.loads(self.vtm("info", path, "--json", expect=1).stdout)
        self.assertEqual([s["name"] for s in report["sections"] if not s["intact"]], ["paints"])

    def test_compiled_file_keeps_its_mode(self):
        self.vtm("compile", self.svg, "-o", "square.vtm", "--mode", "compat")
        self.assertEqual(json.loads(self.vtm("info", "square.vtm", "--json").stdout)["mode"], "compat")
        self.assertIn("mode", self.vtm("render", "square.vtm", "-o", "o.png", "--mode", "exact", expect=1).stderr)
        self.assertIn("reference", self.vtm("render", "square.vtm", "-o", "o.png", "--engine", "reference",
                                            expect=1).stderr)

    def test_paper_mode_has_figures_but_no_file(self):
        report = json.loads(self.vtm("info", self.svg, "--mode", "paper", "--json").stdout)
        self.assertEqual((report["mode"], report["masks"], report["nodes"]), ("paper", 2, 2))
        for key in ("bytes", "prefilter_bytes", "indirections", "cells", "pieces", "approximated_cells"):
            self.assertIsInstance(report[key], int, key)
        self.assertEqual(report["approximated_cells"], 0)
        self.vtm("compile", self.svg, "-o", "square.vtm", "--mode", "paper", expect=2)
        self.vtm("compile", self.svg, "-o", "square.vtm")
        self.assertIn("paper", self.vtm("render", "square.vtm", "-o", "o.png", "--mode", "paper", expect=1).stderr)


class Diff(Command):
    def test_figures(self):
        Image.new("RGBA", (8, 4), (10, 20, 30, 255)).save(self.folder / "a.png")
        other = Image.new("RGBA", (8, 4), (10, 20, 30, 255))
        other.putpixel((3, 2), (10, 60, 30, 255))
        other.save(self.folder / "b.png")
        same = json.loads(self.vtm("diff", "a.png", "a.png", "--json").stdout)
        self.assertEqual((same["max"], same["mean"], same["rms"], same["p999"], same["over"]), (0, 0, 0, 0, 0))
        different = json.loads(self.vtm("diff", "a.png", "b.png", "--json", "-o", "d.png").stdout)
        self.assertAlmostEqual(different["max"], 40, places=3)
        self.assertAlmostEqual(different["mean"], 40 / (8 * 4 * 4), places=3)
        self.assertEqual((different["over"], different["worst_x"], different["worst_y"]), (1, 3, 2))
        self.assertEqual(Image.open(self.folder / "d.png").size, (8, 4))

    def test_sixteen_bits_are_premultiplied(self):
        """The convention of our ground truth: value / 65535, premultiplied."""
        Image.new("RGBA", (1, 1), (255, 0, 0, 128)).save(self.folder / "a.png")
        half = struct.pack(">4H", 128 * 257, 0, 0, 128 * 257)
        write_png16(self.folder / "b.png", half)
        self.assertLess(json.loads(self.vtm("diff", "a.png", "b.png", "--json").stdout)["max"], 0.01)

    def test_sizes_must_agree(self):
        Image.new("RGBA", (8, 4)).save(self.folder / "a.png")
        Image.new("RGBA", (4, 8)).save(self.folder / "b.png")
        done = self.vtm("diff", "a.png", "b.png", expect=1)
        self.assertIn("4 x 8", done.stderr)
        self.assertIn("8 x 4", done.stderr)

    def test_no_png(self):
        self.assertIn("square.svg", self.vtm("diff", self.svg, self.svg, expect=1).stderr)


class Trace(Command):
    def setUp(self):
        super().setUp()
        picture = Image.new("RGBA", (60, 40), (255, 255, 255, 255))
        picture.paste((200, 30, 40, 255), (10, 10, 40, 30))
        picture.save(self.folder / "in.png")
        done = self.run_vtm("trace", "in.png", "-o", "out.svg")
        self.potrace = done.returncode == 0
        self.message = done.stderr

    def require_potrace(self):
        if not self.potrace:
            self.skipTest("built without potrace (VTM_WITH_POTRACE)")

    def test_says_when_it_was_built_without_potrace(self):
        if self.potrace:
            self.skipTest("built with potrace")
        self.assertIn("VTM_WITH_POTRACE", self.message)
        self.vtm("trace", "in.png", "-o", "out.svg", expect=2)
        self.assertFalse((self.folder / "out.svg").exists())

    def test_svg_draws_what_was_traced(self):
        self.require_potrace()
        self.vtm("render", "out.svg", "-o", "out.png", "--engine", "reference")
        image = self.picture("out.png")
        self.assertEqual(image.size, (60, 40))
        self.assertEqual([image.getpixel(p) for p in ((25, 20), (5, 20), (50, 35))],
                         [(200, 30, 40, 255), (255, 255, 255, 255), (255, 255, 255, 255)])

    def test_asset_draws_what_was_traced(self):
        self.require_potrace()
        for name in ("out.vtm", "OUT.VTM"):
            self.vtm("trace", "in.png", "-o", name, "--colors", "2", "--speckle", "0", "--smooth", "0")
            self.assertTrue((self.folder / name).read_bytes().startswith(b"VTM"))
            self.vtm("render", name, "-o", "out.png", "--engine", "asset")
            self.assertEqual(self.picture("out.png").getpixel((25, 20)), (200, 30, 40, 255))

    def test_bad_input_and_usage(self):
        self.require_potrace()
        self.assertIn("square.svg", self.vtm("trace", self.svg, "-o", "x.svg", expect=1).stderr)
        self.assertIn("none.png", self.vtm("trace", "none.png", "-o", "x.svg", expect=1).stderr)
        self.assertIn("x.foo", self.vtm("trace", "in.png", "-o", "x.foo", expect=2).stderr)
        self.vtm("trace", "in.png", "-o", "x.svg", "--colors", "0", expect=2)


def write_png16(path, pixel):
    """One RGBA pixel of 16-bit channels."""
    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    header = struct.pack(">IIBBBBB", 1, 1, 16, 6, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(b"\0" + pixel))
                     + chunk(b"IEND", b""))


if __name__ == "__main__":
    main()
