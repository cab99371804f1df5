#!/usr/bin/env python3
"""Runs an example of OpenVG and looks at what it drew.

check.py EXAMPLE OUT.png PROGRAM [ARGUMENTS], where EXAMPLE names a function below and the word OUT among the arguments
stands for a file beside OUT.png that the check names. Exit code 77 where numpy or Pillow is missing.
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


def check(condition, words):
    if not condition:
        sys.exit(f"wrong: {words}")


class Example:
    def __init__(self, out, command):
        self.out, self.command = pathlib.Path(out), command

    def draw(self, name, *arguments):
        """The picture that the program draws, as numbers in [0, 255], rows from the top."""
        file = self.out.with_name(f"{self.out.stem}{name}.png")
        command = [str(file) if word == "OUT" else word for word in self.command]
        subprocess.run([*command, *map(str, arguments)], check=True)
        return numpy.asarray(Image.open(file).convert("RGB")).astype(float)


def distance(pixels, color):
    return abs(pixels - numpy.array(color)).max(axis=-1)


def drawing(example):
    """The lighthouse: against the picture itself turned, and for what a renderer of another kind must show too."""
    upright = example.draw("")
    paper = upright[5, 5]
    check((distance(upright[:140], paper) == 0).all(), "nothing is drawn outside the drawing's frame")
    check(distance(upright[152, 60], (20, 20, 51)) < 6, "the sky's first colour")
    check(distance(upright[433, 300], (249, 166, 108)) < 14, "the sky's last colour")
    check(distance(upright[433, 235], (255, 237, 183)) < 6, "the sun above the horizon")
    check(distance(upright[440, 235], upright[440, 100]) < 2, "and not below it, where it is clipped")
    check(distance(upright[340, 505], (208, 52, 69)) < 8, "the tower's red band, a gradient")
    check(distance(upright[340, 490], upright[340, 552]) < 4, "which is clipped to the tower")
    turned = example.draw("_turned", 90, 1)
    check(abs(numpy.rot90(upright) - turned).mean() < 0.6, "a quarter turn by the matrix turns the picture")
    small = example.draw("_small", 0, 0.5)
    halved = Image.fromarray(upright.astype("uint8")).resize((360, 360), Image.BOX)
    check(abs(numpy.asarray(halved).astype(float) - small[180:540, 180:540]).mean() < 3, "half the size by the matrix")


def record(example):
    """The lighthouse as one picture: what it is without a recording, and a file that others read."""
    file = next(pathlib.Path(word) for word in example.command if word.endswith(".vtm"))
    file.unlink(missing_ok=True)
    drawing(example)
    check(file.read_bytes()[:4] == b"VTM\xb6", "the recording is a .vtm file")


def in_gles(example):
    """The program's stripes, on them three recordings drawn by shaders, and a panel that OpenVG drew."""
    pixels = example.draw("")
    stripe, other = pixels[10, 40], pixels[10, 120]
    check(distance(stripe, other) > 5 and (distance(pixels[:, :80], stripe) < 1)[430:].all(), "stripes")
    for x, y, size in ((300, 270, 420), (700, 210, 240), (880, 390, 90)):
        part = pixels[y - size // 8:y + size // 8, x - size // 4:x + size // 4]
        check(part[:, :, 0].max() > 190 and part.std() > 30, f"a recording of {size} pixels")
    check(distance(pixels[464, 608:800], (76, 214, 164)).min() < 2, "green dots")
    check(distance(pixels[464, 640], pixels[464, 560]) > 15, "the panel is translucent: lighter than the stripes")
    steps = abs(numpy.diff(pixels[430, 600:820].mean(axis=1)))
    check(steps.max() > 2, "and stripes are seen through it")


def tiger(example):
    pixels = example.draw("")
    green = (pixels[:, :, 1] > 120) & (pixels[:, :, 0] < 170) & (pixels[:, :, 2] < 80)
    check(300 < green.sum() < 4000, "two green eyes")
    orange = distance(pixels, (204, 114, 38)) < 12
    check(20000 < orange.sum() < 120000, "the fur")
    check(15000 < (pixels.max(axis=2) < 30).sum() < 120000, "the stripes")


def gauges(example):
    middle = {"speed": (216, 210), "revolutions": (744, 210)}

    def share_of(name, seconds):
        if name == "speed":
            return (120 - 100 * math.cos(0.5 * seconds)) / 240
        return (3.9 - 2.9 * math.cos(1.1 * seconds)) / 8

    def at(pixels, name, share, radius):
        angle = math.radians(225 - 270 * share)
        x, y = middle[name]
        return pixels[round(420 - y - radius * math.sin(angle) - 0.5), round(x + radius * math.cos(angle) - 0.5)]

    def is_needle(color):
        return color[0] > 190 and color[0] > 1.8 * color[1]

    first, second = example.draw("_0", 0), example.draw("_3", 3)
    for name in middle:
        before, after = share_of(name, 0), share_of(name, 3)
        check(is_needle(at(first, name, before, 60)) and is_needle(at(second, name, after, 60)), f"needle of {name}")
        check(not is_needle(at(second, name, before, 60)), f"the needle of {name} has moved")
        check(at(second, name, after - 0.1, 97).max() > at(first, name, after - 0.1, 97).max() + 60, "the arc grows")
        check(at(second, name, 0, 152).min() > 200 and at(second, name, 1, 152).min() > 200, "marks at both ends")
        # The glass is lighter in the upper part of the face; the mask ends at the face's border.
        x, _ = middle[name]
        check(second[62, x - 14].min() > second[350, x].min() + 25, "light on the glass")
    lit = [(second[182:332, x + 11].max(axis=1) > 120).sum() for x in (446, 492)]
    check(lit[0] > lit[1] + 15, "bars are cut to their levels")
    check(distance(first[94, 510], (61, 220, 132)) < 4 and distance(second[94, 510], (61, 220, 132)) < 4, "blinking, on")
    check(distance(example.draw("_half", 0.7)[94, 510], (61, 220, 132)) > 60, "blinking, off")


def text(example):
    pixels = example.draw("")
    page = pixels[5, 5]
    ink = distance(pixels, page) > 60
    columns = ink[292:612]
    check(columns[:, 360:400].sum() == 0, "nothing in the gutter")
    rows = [columns[23 * i:23 * i + 22] for i in range(14)]
    ends = [numpy.flatnonzero(row[:, 60:400].any(axis=0)).max() + 60 for row in rows]
    full = [end for end in ends if end > 340]
    check(len(full) >= 10 and max(full) - min(full) <= 4, f"the margin at the right is straight: {ends}")
    check(all(row[:, 400:700].any() for row in rows), "a line in each row of the second column")
    # The headline's colour runs from red to blue and does not start anew with each letter.
    head = distance(pixels, page) > 100
    mean = [pixels[60:205, x:x + 40][head[60:205, x:x + 40]].mean(axis=0) for x in (70, 610)]
    check(mean[0][0] > mean[0][2] + 100 and mean[1][2] > mean[1][0] + 80, "a gradient across the headline")
    # It rises: the ink of the last letters lies higher than that of the first.
    centre = [numpy.flatnonzero(head[60:205, x:x + 40].any(axis=1)).mean() for x in (70, 640)]
    check(centre[0] > centre[1] + 40, "the headline rises")
    # The words of the specimen grow as their sizes do.
    gaps = numpy.flatnonzero(ink[680:780].any(axis=0))
    words = numpy.split(gaps, numpy.flatnonzero(numpy.diff(gaps) > 7) + 1)
    widths = [word[-1] - word[0] + 1 for word in words]
    check(len(widths) == 7, f"seven sizes: {widths}")
    check(all(abs(w / widths[-1] - s / 68) < 0.03 for w, s in zip(widths, (9, 13, 18, 25, 35, 49, 68))), "their ratios")


def filters(example):
    pixels = example.draw("")

    def tile(index):
        x, y = 30 + index % 5 * 183, 30 + index // 5 * 127
        return pixels[y + 2:y + 110, x + 2:x + 166]

    def change(picture, axis):
        return abs(numpy.diff(picture.mean(axis=2), axis=axis)).mean()

    original = tile(0)
    sepia, night, blurred, embossed, posterised, moved, heat, multiplied, stencil = map(tile, range(1, 10))
    check((sepia[:, :, 0] >= sepia[:, :, 1]).all() and (sepia[:, :, 1] >= sepia[:, :, 2]).all(), "sepia")
    check((night[:, :, 2] >= night[:, :, 0]).all() and night.mean() < original.mean(), "night")
    check(change(blurred, 0) < 0.7 * change(original, 0) and change(blurred, 1) < 0.5 * change(original, 1), "blur")
    check(abs(blurred.mean() - original.mean()) < 6, "a blur keeps the light")
    check(numpy.ptp(embossed, axis=2).max() <= 1, "the relief is grey")
    check(abs(numpy.median(embossed) - 128) < 4 and embossed.std() > 8, "the relief has two sides")
    steps = abs(posterised / 51 - (posterised / 51).round()) < 0.03
    check(steps.mean() > 0.75 > 0.5 > (abs(original / 51 - (original / 51).round()) < 0.03).mean(), "six tones")
    check(change(moved, 1) < 0.35 * change(original, 1) and change(moved, 0) > 0.5 * change(original, 0), "motion")
    order = numpy.argsort(original[:, :, 1], axis=None)
    by_green = heat.mean(axis=2).ravel()[order].reshape(-1, 164).mean(axis=1)
    check(numpy.diff(by_green).min() > -2 and by_green[-1] > by_green[0] + 140, "heat follows green")
    corner = multiplied[-30:, -30:].mean(axis=(0, 1))
    check(abs(multiplied[40:60, 50:70] - original[40:60, 50:70]).mean() < 14, "multiply keeps the middle")
    check(corner.min() > original[-30:, -30:].mean(axis=(0, 1)).min() + 60, "and fades the corner")
    left, right = stencil[:, :50].reshape(-1, 3), stencil[:, -50:].reshape(-1, 3)
    dark = [side[side.sum(axis=1) < numpy.percentile(side.sum(axis=1), 20)].mean(axis=0) for side in (left, right)]
    check(dark[0][2] > dark[0][0] + 30 and dark[1][0] > dark[1][2] + 30, "dots from blue to red")
    # The floor mirrors the panel in the middle, from its lower edge on.
    edge = 640 - 92
    above, below = pixels[edge - 60:edge - 4, 340:620].mean(axis=2), pixels[edge + 4:edge + 60, 340:620].mean(axis=2)
    match = numpy.corrcoef(above[::-1].ravel(), below.ravel())[0, 1]
    check(match > 0.5, f"the floor mirrors: {match:.2f}")
    check(numpy.corrcoef(above.ravel(), below.ravel())[0, 1] < match - 0.2, "upside down")


def main():
    name, out, *command = sys.argv[1:]
    globals()[name](Example(out, command))


if __name__ == "__main__":
    main()
