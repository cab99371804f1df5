#!/usr/bin/env python3
"""Which engine draws where nothing is said, with a driver and without. engines_test.py VTM"""
from support import SQUARE, Command, main

NO_EGL = {"__EGL_VENDOR_LIBRARY_FILENAMES": "/dev/null"}
SOFTWARE = {"LIBGL_ALWAYS_SOFTWARE": "1"}


class Automatic(Command):
    def drawn_by(self, *arguments, env):
        report = self.json("render", self.svg, "-o", "out.png", *arguments, env=env)
        self.assert_square("out.png")
        return report["engine"]

    def test_a_software_driver_leaves_exact_pictures_to_the_scanner(self):
        self.assertEqual(self.drawn_by(env=SOFTWARE), "cpu")
        self.assertEqual(self.drawn_by("--engine", "gl", env=SOFTWARE), "gl")

    def test_a_software_driver_draws_what_the_scanner_cannot(self):
        for mode in ("compat", "paper"):
            self.assertEqual(self.drawn_by("--mode", mode, env=SOFTWARE), "gl")

    def test_whatever_is_here_draws(self):
        self.assertIn(self.drawn_by(env={}), ("gl", "cpu"))

    def test_a_compiled_picture(self):
        self.vtm("compile", self.svg, "-o", "square.vtm", "--mode", "compat")
        report = self.json("render", "square.vtm", "-o", "out.png", env=NO_EGL)
        self.assertEqual(report["engine"], "asset")
        self.assert_square("out.png")


class WithoutEgl(Command):
    def test_the_cpu_draws_and_one_line_says_so(self):
        for arguments in ((), ("--mode", "compat"), ("--mode", "paper"), ("--debug-view", "regions")):
            with self.subTest(arguments=arguments):
                said = self.vtm("render", self.svg, "-o", "out.png", *arguments, env=NO_EGL).stderr
                self.assertEqual(said, "vtm: EGL has no driver; drawing on the CPU\n")
                if "--debug-view" not in arguments:
                    self.assert_square("out.png")

    def test_one_line_for_a_batch(self):
        for name in ("a", "b", "c"):
            self.write(f"{name}.svg", SQUARE)
        done = self.vtm("render", "a.svg", "b.svg", "c.svg", "-o", "pictures", "--mode", "compat", env=NO_EGL)
        self.assertEqual(done.stderr, "vtm: EGL has no driver; drawing on the CPU\n3 of 3 drawn, 0 failed\n")

    def test_a_driver_that_cannot_start(self):
        """Compat mode wants shaders; there are devices, but the driver's files are not where it looks."""
        env = {**SOFTWARE, "LIBGL_DRIVERS_PATH": "/nonexistent", "EGL_LOG_LEVEL": "fatal"}
        said = self.vtm("render", self.svg, "-o", "out.png", "--mode", "compat", env=env).stderr
        self.assert_square("out.png")
        if said:  # drivers may lie elsewhere
            self.assertIn("; drawing on the CPU\n", said)

    def test_shaders_that_were_asked_for_are_an_error(self):
        said = self.vtm("render", self.svg, "-o", "out.png", "--engine", "gl", env=NO_EGL, expect=1).stderr
        self.assertIn("no EGL display gives an OpenGL ES 3 context", said)


if __name__ == "__main__":
    main()
