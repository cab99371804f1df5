#!/usr/bin/env python3
"""--max-seconds and --max-memory. limits_test.py VTM"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

VTM = None

SMALL = '<svg xmlns="http://www.w3.org/2000/svg" width="8" height="8"><rect width="8" height="8" fill="red"/></svg>'
# Strokes that take many seconds, on line 2.
LARGE = ('<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100">\n<g>' +
         '<circle cx="50" cy="50" r="40" fill="none" stroke="#000" stroke-dasharray=".0013 .0012"/>' * 200 +
         "</g></svg>")


class Limits(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)
        (self.path / "small.svg").write_text(SMALL)
        (self.path / "large.svg").write_text(LARGE)

    def run_vtm(self, *arguments):
        return subprocess.run([VTM, *map(str, arguments)], cwd=self.path, capture_output=True, text=True)

    def render(self, name, *arguments):
        engine = [] if "--engine" in arguments else ["--engine", "cpu"]
        return self.run_vtm("render", name, "-o", "out.png", *engine, *arguments)

    def test_seconds_name_file_line_and_element(self):
        result = self.render("large.svg", "--max-seconds", "2")
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, r"^large\.svg:2:\d+: --max-seconds 2: exceeded while \w+.* <circle>\n$")
        self.assertFalse((self.path / "out.png").exists())

    def test_memory(self):
        result = self.render("large.svg", "--max-memory", "80")
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, r"large\.svg.*: --max-memory 80: exceeded")

    def test_every_command_that_compiles_has_them(self):
        for command in (["info", "large.svg"], ["compile", "large.svg", "-o", "out.vtm"]):
            result = self.run_vtm(*command, "--max-seconds", "0.5")
            self.assertEqual(result.returncode, 1, command)
            self.assertIn("--max-seconds 0.5: exceeded", result.stderr)
        self.assertFalse((self.path / "out.vtm").exists())

    def test_the_reference_engine_holds(self):
        result = self.render("large.svg", "--max-seconds", "0.5", "--engine", "reference")
        self.assertEqual(result.returncode, 1)
        self.assertIn("--max-seconds 0.5: exceeded", result.stderr)

    def test_a_batch_goes_on(self):
        (self.path / "list").write_text("".join(f"{name}.svg\t{i}.png\n" for i, name in
                                                enumerate(["small", "large", "small", "large", "small"])))
        result = self.run_vtm("render", "--batch", "list", "--engine", "cpu", "--max-seconds", "1")
        self.assertEqual(result.returncode, 1)
        self.assertEqual([(self.path / f"{i}.png").exists() for i in range(5)], [True, False, True, False, True])
        self.assertIn("3 of 5 drawn, 2 failed", result.stderr)

    def test_memory_of_one_picture_is_not_counted_for_the_next(self):
        (self.path / "list").write_text("".join(f"{name}.svg\t{i}.png\n" for i, name in
                                                enumerate(["large", "small", "large", "small"])))
        result = self.run_vtm("render", "--batch", "list", "--engine", "cpu", "--max-memory", "80")
        self.assertIn("2 of 4 drawn, 2 failed", result.stderr)

    def test_none_and_zero_are_no_limit(self):
        for value in ("none", "0", "1e9"):
            result = self.render("small.svg", "--max-seconds", value, "--max-memory", value)
            self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_what_is_no_limit_is_refused(self):
        for value in ("", "-1", "1s", "nan", "many"):
            for option in ("--max-seconds", "--max-memory"):
                result = self.render("small.svg", f"{option}={value}")
                self.assertEqual(result.returncode, 2, (option, value))
                self.assertIn(option, result.stderr)


if __name__ == "__main__":
    VTM = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main()
