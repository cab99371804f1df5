"""Glyphs as paths: outlines and advances from the font files by fontTools, places as the caller computes them.

Lengths are user units, y down, unless said otherwise. Nothing here shapes text: a caller names glyphs.
"""
import math
import pathlib
from typing import NamedTuple

from fontTools.pens.svgPathPen import SVGPathPen
from fontTools.pens.transformPen import TransformPen
from fontTools.ttLib import TTFont

FONTS = pathlib.Path(__file__).parent.parent / "fonts"
BLUE, RED, GREEN = "#1040c0", "#d02020", "#109030"
SIZE = 40  # of the suite's documents, user units an em


class Face:
    def __init__(self, file):
        self.font = TTFont(FONTS / file)
        self.em = self.font["head"].unitsPerEm
        self.glyphs = self.font.getGlyphSet()

    def names(self, text):
        """Glyph names of characters; a list is one already."""
        return text if isinstance(text, list) else [self.font.getBestCmap()[ord(c)] for c in text]

    def advance(self, name):
        """In ems."""
        return self.glyphs[name].width / self.em


TEST, BOLD, BLACK, LIGHT = (Face(f"VTMTest-{s}.ttf") for s in ("Regular", "Bold", "Black", "Light"))
ITALIC, CONDENSED = Face("VTMTest-Italic.ttf"), Face("VTMTest-Condensed.ttf")
WORLD, CUBIC = Face("VTMWorld-Regular.ttf"), Face("VTMCubic-Regular.otf")

KERNING = {("A", "B"): -0.2, ("B", "A"): 0.1}  # ems, as fonts.py has it in all faces of VTM Test

# Ems, as fonts.py has them in all fonts.
ASCENT, DESCENT, X_HEIGHT = 0.8, 0.2, 0.5
SUB, SUPER = 0.15, 0.35
UNDERLINE, UNDERLINE_SIZE = 0.12, 0.08  # middle of the line below the baseline, thickness
STRIKE, STRIKE_SIZE = 0.3, 0.06  # middle above the baseline


class Matrix(NamedTuple):
    """x' = a x + c y + e, y' = b x + d y + f."""
    a: float
    b: float
    c: float
    d: float
    e: float
    f: float

    def __matmul__(self, o):
        return Matrix(self.a * o.a + self.c * o.b, self.b * o.a + self.d * o.b, self.a * o.c + self.c * o.d,
                      self.b * o.c + self.d * o.d, self.a * o.e + self.c * o.f + self.e,
                      self.b * o.e + self.d * o.f + self.f)

    def point(self, x, y):
        return self.a * x + self.c * y + self.e, self.b * x + self.d * y + self.f


def move(x, y):
    return Matrix(1, 0, 0, 1, x, y)


def scale(x, y=None):
    return Matrix(x, 0, 0, x if y is None else y, 0, 0)


def turn(degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return Matrix(c, s, -s, c, 0, 0)


def number(value):
    return "0" if abs(value) < 5e-7 else f"{value:.6f}".rstrip("0").rstrip(".")


def glyph(name, x, y, size=SIZE, face=TEST, rotate=0, frame=None, stretch=1):
    """Path data of one glyph, its origin at (x, y) or at the origin of `frame`."""
    unit = size / face.em
    matrix = (frame or move(x, y)) @ turn(rotate) @ scale(stretch * unit, -unit)
    pen = SVGPathPen(face.glyphs, ntos=number)
    face.glyphs[name].draw(TransformPen(pen, matrix))
    return pen.getCommands()


def advances(names, face=TEST, size=SIZE, spacing=0, words=0, kern=True):
    """Of each glyph, kerning with the next one in it. `spacing` comes after each but the last."""
    made = []
    for i, name in enumerate(names):
        last = i + 1 == len(names)
        pair = 0 if last or not kern else KERNING.get((name, names[i + 1]), 0)
        made.append((face.advance(name) + pair) * size + (0 if last else spacing)
                    + (words if name in ("space", "nbspace") else 0))
    return made


def width(text, face=TEST, **how):
    return sum(advances(face.names(text), face, **how))


def line(text, x, y, face=TEST, size=SIZE, **how):
    """Path data of a horizontal line that starts at (x, y)."""
    names, made = face.names(text), []
    for name, advance in zip(names, advances(names, face, size=size, **how)):
        made.append(glyph(name, x, y, size, face))
        x += advance
    return " ".join(d for d in made if d)


def rectangle(left, top, right, bottom, frame=Matrix(1, 0, 0, 1, 0, 0)):
    corners = [frame.point(*p) for p in ((left, top), (right, top), (right, bottom), (left, bottom))]
    return "M" + " L".join(f"{number(x)},{number(y)}" for x, y in corners) + " Z"


def bar(x, right, y, middle, thickness, size=SIZE):
    """A line of text-decoration; `middle` in ems below the baseline y."""
    return rectangle(x, y + (middle - thickness / 2) * size, right, y + (middle + thickness / 2) * size)


def underline(x, right, y, size=SIZE):
    return bar(x, right, y, UNDERLINE, UNDERLINE_SIZE, size)


def draw(*data, **attributes):
    """A path element of all the data; underscores in names of attributes are hyphens."""
    said = "".join(f' {name.replace("_", "-")}="{value}"' for name, value in attributes.items())
    return f'<path{said} d="{" ".join(data)}"/>'
