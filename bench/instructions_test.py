#!/usr/bin/env python3
"""instructions.py where valgrind cannot start, and where only the program cannot be counted: by valgrinds of our own."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parent / "instructions.py"
NO_PROC = "--1:0: aspacem Valgrind: FATAL: can't open /proc/self/maps"


class Instructions(unittest.TestCase):
    def run_with(self, valgrind):
        """instructions.py with `valgrind`, a shell script, in the path's place."""
        with tempfile.TemporaryDirectory() as folder:
            program = pathlib.Path(folder) / "valgrind"
            program.write_text(f"#!/bin/sh\n{valgrind}\n")
            program.chmod(0o755)
            return subprocess.run([sys.executable, SCRIPT, "/bin/true", "no key", "--self-test"], text=True,
                                  capture_output=True, env={**os.environ, "PATH": f"{folder}:{os.environ['PATH']}"})

    def test_a_valgrind_that_cannot_start_is_a_skip(self):
        done = self.run_with(f'echo "{NO_PROC}" >&2; echo "--1:0: aspacem Exiting now." >&2; exit 1')
        self.assertEqual(done.returncode, 77, done.stderr)
        self.assertEqual(done.stdout, f"skipped: valgrind cannot start: {NO_PROC}\n")

    def test_a_program_that_cannot_be_counted_is_a_failure(self):
        done = self.run_with('[ "$1" = --tool=none ] || exit 1')
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("could not be counted", done.stderr)


if __name__ == "__main__":
    unittest.main()
