#!/usr/bin/env python3
"""What is said: help, proposals, quiet, progress; diff's limits. usage_test.py VTM"""
import os
import pty
import subprocess

from support import SQUARE, Command, main


class Proposals(Command):
    def test_a_mistyped_subcommand(self):
        for typed, meant in (("rendr", "render"), ("rneder", "render"), ("comiple", "compile"), ("dif", "diff"),
                             ("inof", "info"), ("Trace", "trace")):
            self.assertIn(f"did you mean '{meant}'?", self.vtm(typed, self.svg, expect=2).stderr)
        said = self.vtm("frobnicate", expect=2).stderr
        self.assertIn("the subcommands are render, compile, info, diff, normalize, font, trace, view", said)

    def test_a_file_in_place_of_a_subcommand(self):
        self.assertIn("vtm render square.svg -o", self.vtm("square.svg", expect=2).stderr)

    def test_a_mistyped_option(self):
        said = self.vtm("render", self.svg, "-o", "o.png", "--widht", "9", expect=2).stderr
        self.assertIn("did you mean '--width'?", said)
        self.assertIn("--nonsense", self.vtm("render", self.svg, "-o", "o.png", "--nonsense", expect=2).stderr)


class Help(Command):
    def test_examples(self):
        for name in ("render", "compile", "info", "diff", "normalize", "trace", "view"):
            self.assertIn(f"  vtm {name} ", self.vtm(name, "--help").stdout)
        self.assertIn("Examples:", self.vtm("--help").stdout)
        self.assertIn("vtm info", self.vtm("info", "-h").stdout)


class Saying(Command):
    def setUp(self):
        super().setUp()
        self.warned = self.write("warned.svg", SQUARE.replace("</svg>", "<foreignObject/></svg>"))

    def test_quiet(self):
        out = ("render", self.warned, "-o", "out.png")
        self.assertIn("warning", self.vtm(*out).stderr)
        self.assertEqual(self.vtm(*out, "--quiet").stderr, "")
        self.assertIn("left out", self.vtm(*out, "-q", "--strict", expect=1).stderr)
        self.assertIn("absent.svg", self.vtm("render", "absent.svg", "-o", "o.png", "-q", expect=1).stderr)

    def test_verbose_names_the_engine(self):
        said = self.vtm("render", self.svg, "-o", "out.png", "-v", "-w", "2000", "--engine", "cpu").stderr
        self.assertIn("2,000 x 1,000 pixels, drawn by cpu", said)

    def test_progress_of_a_long_picture_on_a_terminal(self):
        """The reference takes seconds for this one; what is said is overwritten at the end."""
        circles = "".join(f"<circle cx='{i % 97}' cy='{i % 89}' r='{i % 50 + 9}' fill-opacity='.1'/>" for i in range(600))
        self.write("long.svg", f"<svg xmlns='http://www.w3.org/2000/svg' width='100' height='100'>{circles}</svg>")
        ours, theirs = pty.openpty()
        command = [self.program, "render", "long.svg", "-o", "out.png", "--engine", "reference", "-w", "1200",
                   "--max-seconds", "4"]
        done = subprocess.Popen(command, cwd=self.folder, stderr=theirs)
        os.close(theirs)
        said = b""
        try:
            while part := os.read(ours, 4096):
                said += part
        except OSError:  # how Linux ends a terminal that nobody has open
            pass
        done.wait(timeout=60)
        os.close(ours)
        self.assertRegex(said, rb"\r\x1b\[K[1-9] s: [a-z]+")


class DiffLimits(Command):
    def setUp(self):
        super().setUp()
        self.vtm("render", self.svg, "-o", "a.png")
        self.vtm("render", self.svg, "-o", "b.png", "-b", "#00000010")  # 16 of alpha, in the right half or less

    def test_exit_codes(self):
        for limits, code in (((), 0), (("--max", "16"), 0), (("--max", "15.9"), 1), (("--mean", "4"), 0),
                             (("--mean", "0.1"), 1), (("--max", "20", "--mean", "0.1"), 1), (("--max", "-1"), 2)):
            with self.subTest(limits=limits):
                done = self.vtm("diff", "a.png", "b.png", *limits, expect=code)
                if code != 2:
                    self.assertIn("max: 16.00\n", done.stdout)
                if code == 1:
                    self.assertRegex(done.stderr, r"--(max|mean) [0-9.]+: exceeded, the value is ")


if __name__ == "__main__":
    main()
