#!/usr/bin/env python3
"""Runs an example that draws with textures and looks at what it drew.

textures.py PROGRAM OUT.png; exit code 77 where numpy or Pillow is missing.
"""
import math
import pathlib
import subprocess
import sys

try:
    import numpy
    from PIL import Image
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

HERE = pathlib.Path(__file__).parent


FONTS = pathlib.Path("/usr/share/fonts/truetype/dejavu")
INPUTS = {
    "animated_shape": [],
    "book": [FONTS / "DejaVuSerif.ttf", *sorted((HERE.parent / "docs").glob("*.md"))],
    "terminal": [FONTS / "DejaVuSansMono.ttf", HERE / "terminal.cpp"],
}


def check(condition, words):
    if not condition:
        sys.exit(f"wrong: {words}")


def textured_cube(pixels):
    red, green, blue = pixels[310, 440]
    check(red > 2 * green and red > 2 * blue, "the lighthouse's red band on the cube's front")
    check(pixels[330, 620].min() > 60, "the rose window's heart on the cube's side")
    # Tiles near by are crisp; towards the horizon they melt into one colour, without moire.
    contrast = pixels.astype(float).mean(axis=2).std(axis=1)
    check(contrast[600] > 45, "tiles near by have contrast")
    horizon = pixels[94:100, :200].astype(float).mean(axis=2)
    check(horizon.std(axis=1).max() < 6, "tiles at the horizon melt")


def road_scene(pixels):
    # Inside the nearest tree's rectangle but beside its outline: the sky, as where no tree is.
    sky = pixels[60, 400].astype(int)
    check(abs(pixels[60, 20].astype(int) - sky).max() <= 1, "nothing is drawn beside an outline")
    row = pixels[250, :70, 2].astype(int)  # blue falls from sky to leaves
    inside = (row < row.max() - 10) & (row > row.min() + 10)
    check(inside.any(), "outlines are smooth")
    check(pixels[275, 714].min() > 190 or pixels[262, 714].max() < 120, "the sign's middle")
    red = (pixels[:, :, 0] > 180) & (pixels[:, :, 1] < 80)
    check(700 < red.sum() < 4000, "red rims of signs")
    # The broken line towards the horizon fades instead of flickering: neighbouring rows are alike.
    middle = pixels[316:330, 480:505].astype(float).mean(axis=(1, 2))
    check(abs(numpy.diff(middle)).max() < 25, "the road near the horizon")


def animated_shape(pixels):
    paper = numpy.array([1, 0.98, 0.95]) * 255
    for i in range(8):
        y, x = 240 * (i // 4), 240 * (i % 4)
        frame = pixels[y:y + 240, x:x + 240].astype(float)
        ink = frame[120, 120]
        drawn = ((paper - frame)[:, :, 1].sum() / (paper - ink)[1]) / 240 ** 2
        swing = 16 * math.cos(2 * math.pi * i / 8)
        area = math.pi * (30 ** 2 + swing ** 2 / 2) / 100 ** 2
        check(abs(drawn - area) < 0.002, f"frame {i} covers {drawn:.4f}, the curve {area:.4f}")


def star_swarm(pixels):
    # 1000 stars of two colours on one sky; each keeps its area whatever its place.
    sky = (abs(pixels.astype(int) - numpy.array([0x12, 0x20, 0x3a])).max(axis=2) <= 1).mean()
    check(0.75 < sky < 0.95, f"{sky:.3f} of the picture is sky")
    gold = (abs(pixels.astype(int) - numpy.array([0xff, 0xd7, 0x5e])).max(axis=2) <= 1)
    red = (abs(pixels.astype(int) - numpy.array([0xe8, 0x64, 0x3c])).max(axis=2) <= 1)
    check(0.8 < gold.sum() / red.sum() < 4, "a third of the stars has its colours exchanged")
    squares = (gold | red)[:600, :960].reshape(25, 24, 40, 24).any(axis=(1, 3))
    check(squares.mean() > 0.5, f"a star in {squares.mean():.2f} of the squares")


def book(pixels):
    paper = pixels.min(axis=2) > 200
    check(0.15 < paper.mean() < 0.6, "the book's paper")
    # Lines of text on the left page: rows of the turned page alternate, and are not grey all over.
    text = pixels[200:420, 120:400].astype(float).mean(axis=2)
    check(text.std() > 20, "letters are dark on the paper")


def terminal(pixels):
    for name, channel in (("red marks", 0), ("blue numbers", 2)):
        others = [c for c in range(3) if c != channel]
        strong = pixels[:, :, channel].astype(int) - pixels[:, :, others].max(axis=2)
        check((strong > 30).sum() > 200, name)


def main():
    program, out = sys.argv[1:]
    name = pathlib.Path(program).name
    inputs = INPUTS.get(name, [HERE])
    if any(not path.exists() for path in inputs):
        print(f"skipped: {inputs[0]} is absent")
        sys.exit(77)
    subprocess.run([program, *inputs, out], check=True)
    globals()[name](numpy.asarray(Image.open(out).convert("RGB")))


if __name__ == "__main__":
    main()
