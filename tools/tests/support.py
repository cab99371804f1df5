"""What the tests of the vtm command share: each runs it as its users do, in a folder of its own."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from PIL import Image

SQUARE = """<svg xmlns="http://www.w3.org/2000/svg" width="40" height="20">
  <rect width="20" height="20" fill="#ff0000"/>
  <rect x="20" width="10" height="20" fill="#0000ff" fill-opacity="0.4"/>
</svg>
"""
RED, PALE_BLUE, NOTHING = (255, 0, 0, 255), (0, 0, 255, 102), (0, 0, 0, 0)
SQUARE_COLOURS = [RED, PALE_BLUE, NOTHING]  # at (5, 10), (25, 10), (35, 10)


class Command(unittest.TestCase):
    program = ""  # the vtm under test

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.svg = self.write("square.svg", SQUARE)

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def run_vtm(self, *arguments, env=None, **options):
        """The command in the test's folder, whatever becomes of it; `env` is added to the environment."""
        options = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True,
                   "cwd": self.folder, "timeout": 120, **options}
        if "input" in options:
            del options["stdin"]
        return subprocess.run([self.program, *map(str, arguments)], env={**os.environ, **(env or {})}, **options)

    def vtm(self, *arguments, expect=0, **options):
        """The same, with its exit code checked."""
        done = self.run_vtm(*arguments, **options)
        self.assertEqual(done.returncode, expect, f"{arguments}\n{done.stdout}\n{done.stderr}")
        return done

    def shell(self, script, *arguments, expect=0):
        """A bash script, in which vtm is "$0", and `arguments` follow."""
        done = subprocess.run(["bash", "-c", script, self.program, *map(str, arguments)], capture_output=True, text=True,
                              cwd=self.folder, stdin=subprocess.DEVNULL, timeout=120)
        self.assertEqual(done.returncode, expect, f"{script}\n{done.stdout}\n{done.stderr}")
        return done

    def picture(self, name):
        with Image.open(self.folder / name) as image:
            image.load()
        self.assertEqual(image.mode, "RGBA")
        return image

    def assert_square(self, name):
        """The picture of SQUARE, whole."""
        image = self.picture(name)
        self.assertEqual([image.getpixel((x, 10)) for x in (5, 25, 35)], SQUARE_COLOURS)

    def json(self, *arguments, **options):
        return json.loads(self.vtm(*arguments, "--json", **options).stdout)

    def names(self):
        return sorted(path.name for path in self.folder.iterdir())

    def skip_with_sanitizers(self):
        if os.environ.get("ASAN_OPTIONS") is not None or b"__asan_init" in pathlib.Path(self.program).read_bytes():
            self.skipTest("AddressSanitizer needs the address space itself")


def main():
    """TEST.py VTM [UNITTEST ARGUMENTS]"""
    Command.program = os.path.abspath(sys.argv.pop(1))
    unittest.main(module="__main__")
