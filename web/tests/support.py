"""What the tests of pages share: pages that the vtm command makes, in headless Chromium."""
import base64
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy
    from PIL import Image
except ImportError:
    print("numpy or Pillow is not installed: the tests of pages are skipped")
    sys.exit(77)

import browser

ROOT = pathlib.Path(__file__).resolve().parents[2]
CORPUS = pathlib.Path(os.environ.get("VTM_SHARED", ROOT.parent / "shared")) / "corpus"
EXAMPLES = ROOT / "examples"
TIGER = CORPUS / "tiger.svg"

ALL_PIXELS = """
const canvas = document.getElementById('canvas'), gl = canvas.getContext('webgl2');
const bytes = new Uint8Array(canvas.width * canvas.height * 4);
gl.bindFramebuffer(gl.FRAMEBUFFER, null);
gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
let text = '';
for (let i = 0; i < bytes.length; i += 8192)
  text += String.fromCharCode(...bytes.subarray(i, i + 8192));
return [canvas.width, canvas.height, btoa(text)];
"""


class Pages(unittest.TestCase):
    """One browser for all tests of a class."""
    program = ""  # the vtm under test
    width, height = 1000, 700

    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = pathlib.Path(temporary.name)
        cls.browser = browser.Browser(cls.width, cls.height)
        cls.addClassCleanup(cls.browser.close)

    def setUp(self):
        self.browser.resize(self.width, self.height)

    def vtm(self, *arguments, expect=0, **options):
        done = subprocess.run([self.program, *map(str, arguments)], cwd=self.folder, capture_output=True, timeout=300, **options)
        self.assertEqual(done.returncode, expect, f"{arguments}\n{done.stdout[:500]}\n{done.stderr.decode()}")
        return done

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def page(self, source, *options):
        """The page of a file; made once."""
        made = self.folder / (re.sub(r"\W+", "_", " ".join(map(str, (source, *options)))) + ".html")
        if not made.exists():
            self.vtm("view", source, "-o", made, "-q", *options)
        return made

    def open(self, page, fragment=""):
        self.browser.open(page, fragment)
        self.wait()

    def wait(self):
        """Until all that was asked for is drawn."""
        self.browser.wait_until("document.getElementById('canvas').dataset.state === 'complete'"
                                " || !document.getElementById('message').hidden", "drawing")
        self.assertEqual(self.browser.text("#message"), "")

    def do(self, action, *arguments, **options):
        """Something that changes the view, and what comes of it drawn."""
        before = self.frame()
        action(*arguments, **options)
        self.browser.wait_until(f"document.getElementById('canvas').dataset.frame !== '{before}'", "a new frame")
        self.wait()

    def frame(self):
        return self.browser.run("return document.getElementById('canvas').dataset.frame")

    def pixels(self):
        """Premultiplied, rows from the top: height × width × 4."""
        width, height, text = self.browser.run(ALL_PIXELS)
        return numpy.frombuffer(base64.b64decode(text), numpy.uint8).reshape(height, width, 4)[::-1].astype(int)

    def rendered(self, source, *options):
        """The same of `vtm render`."""
        self.vtm("render", source, "-o", "rendered.png", "-q", *options)
        with Image.open(self.folder / "rendered.png") as image:
            straight = numpy.asarray(image.convert("RGBA")).astype(float)
        alpha = straight[..., 3:] / 255
        return numpy.rint(numpy.concatenate([straight[..., :3] * alpha, straight[..., 3:]], axis=2)).astype(int)

    def stage(self):
        """Left, top, width, height of the picture's part of the page."""
        return self.browser.run("const b = document.getElementById('stage').getBoundingClientRect();"
                                "return [b.left, b.top, b.width, b.height]")

    def state(self):
        """The view as the page's address has it."""
        self.browser.wait_until("location.hash.includes('scale=')", "the address")
        self.browser.run("return new Promise((resolve) => setTimeout(resolve, 450))")
        text = self.browser.run("return location.hash.slice(1)")
        return {name: value if name in ("view", "ground") else float(value)
                for name, value in (part.split("=") for part in text.split("&"))}

    def assert_quiet(self):
        """Nothing in the console."""
        self.assertEqual(self.browser.log(), [])


def main():
    """TEST.py VTM [UNITTEST ARGUMENTS]"""
    Pages.program = os.path.abspath(sys.argv.pop(1))
    if not browser.is_installed():
        print("Chromium or its driver is not installed (chromium, chromium-driver)")
        sys.exit(77)
    unittest.main(module="__main__")
