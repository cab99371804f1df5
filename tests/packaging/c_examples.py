"""examples/openvg/c as a user builds them: outside of the tree, with the installed headers and `pkg-config openvg`."""
import shutil
import subprocess
import sys

from check import require, run

PAPER, GOLD, INK = (255, 255, 255), (255, 192, 0), (32, 48, 96)
RED, GREEN, BLUE, YELLOW, WHITE = (255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 0), (255, 255, 255)
NEVER_SHOWN = 77


class Picture:
    """A PPM file; y from the top."""

    def __init__(self, file):
        magic, size, limit, self.bytes = file.read_bytes().split(b"\n", 3)
        require((magic, limit) == (b"P6", b"255"), f"{file} is no PPM file")
        self.width, self.height = map(int, size.split())
        require(len(self.bytes) == self.width * self.height * 3, f"{file} has another size than it says")

    def at(self, x, y):
        start = (y * self.width + x) * 3
        return tuple(self.bytes[start:start + 3])

    def expect(self, x, y, color, what):
        require(self.at(x, y) == color, f"{what}: {self.at(x, y)} at ({x}, {y}) instead of {color}")


def first_path(picture):
    require((picture.width, picture.height) == (320, 240), "the star's picture is 320 x 240")
    picture.expect(3, 3, PAPER, "nothing is drawn in the corner")
    picture.expect(160, 50, GOLD, "the upper point is filled")
    picture.expect(160, 128, GOLD, "so is what the outline goes around twice: VG_NON_ZERO")
    picture.expect(130, 97, INK, "the horizontal line is stroked")
    picture.expect(160, 220, PAPER, "there is no point below")


def label(picture):
    require((picture.width, picture.height) == (400, 240), "the label is 400 x 240")
    top, bottom = picture.at(200, 1), picture.at(200, 238)
    require(top[0] > bottom[0] + 100 and top[2] > bottom[2] + 80, "the gradient is light at the top")
    picture.expect(30, 50, RED, "the image's first pixel is at its lower left")
    picture.expect(50, 50, YELLOW, "the second one right of it")
    picture.expect(30, 30, YELLOW, "the third one above")
    picture.expect(205, 215, RED, "the pattern begins at the origin")
    picture.expect(215, 215, YELLOW, "and repeats")
    picture.expect(360, 112, WHITE, "the last letter is where the escapements have led")


def turned_texture(picture):
    require((picture.width, picture.height) == (320, 160), "the picture is 320 x 160")
    for (x, y), color, what in (((80, 110), RED, "its lower left is turned down"), ((110, 80), GREEN, "its lower right to the right"),
                                ((50, 80), BLUE, "its upper left to the left"), ((80, 50), WHITE, "its upper right up")):
        picture.expect(x, y, color, what)
    picture.expect(240, 80, GREEN, "the pattern repeats from the origin: (240, 79) is (48, 15)")
    picture.expect(200, 85, YELLOW, "with what OpenGL ES changed later")
    picture.expect(310, 10, (0, 0, 0), "the disc is round")


def texture(folder, packages):
    """With the system's OpenGL ES, if there is one."""
    if subprocess.run(["pkg-config", "--exists", "glesv2"], check=False).returncode != 0:
        return
    run("make", "-C", folder, "texture", env={"PKG_CONFIG_PATH": packages})
    run(folder / "texture", folder / "texture.ppm", env={"EGL_PLATFORM": "surfaceless"})
    turned_texture(Picture(folder / "texture.ppm"))


def window(folder, source, packages):
    """On an X server of its own, if there is one; libX11 is the system's."""
    if subprocess.run(["pkg-config", "--exists", "x11"], check=False).returncode != 0:
        return
    run("make", "-C", folder, "window", env={"PKG_CONFIG_PATH": packages})
    shown = subprocess.run([sys.executable, source / "api/egl/tests/under_xvfb.py", folder / "window", "1"], check=False)
    require(shown.returncode in (0, NEVER_SHOWN), "the window is not shown")


def check(folder):
    place = folder.fresh("c_examples") / "c"
    shutil.copytree(folder.source / "examples/openvg/c", place)
    packages = str(folder.prefix / "lib/pkgconfig")
    run("make", "-C", place, "CFLAGS=-std=c11 -Wall -Wextra -Wpedantic -Werror", "first_path", "label", "quality",
        env={"PKG_CONFIG_LIBDIR": packages})
    for name, look in (("first_path", first_path), ("label", label)):
        run(place / name, place / f"{name}.ppm", env={"EGL_PLATFORM": "surfaceless"})
        look(Picture(place / f"{name}.ppm"))
    texture(place, packages)
    window(place, folder.source, packages)
