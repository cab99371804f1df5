#!/usr/bin/python3
"""Writes the fonts of this suite into ../fonts. Needs python3-fonttools.

Every glyph is asymmetric, so that a turned, mirrored or wrong one shows. Lengths are font units, y up.
"""
import pathlib

from fontTools.feaLib.builder import addOpenTypeFeaturesFromString
from fontTools.fontBuilder import FontBuilder
from fontTools.pens.t2CharStringPen import T2CharStringPen
from fontTools.pens.ttGlyphPen import TTGlyphPen
from fontTools.ttLib.tables.TupleVariation import TupleVariation

FOLDER = pathlib.Path(__file__).parent.parent / "fonts"
DATE = 3786825600  # of 'head', seconds since 1904: the same file every time


def box(left, bottom, right, top):
    return [(left, bottom), (left, top), (right, top), (right, bottom)]


# Advance and contours. A contour is a list of corners.
LETTERS = {
    ".notdef": (600, [box(50, 0, 550, 700), [(150, 100), (450, 100), (450, 600), (150, 600)]]),
    "space": (300, []),
    "nbspace": (300, []),
    "hyphen": (400, [box(50, 250, 350, 350)]),
    "A": (600, [[(50, 0), (300, 700), (550, 0)]]),
    "B": (550, [[(100, 0), (100, 700), (250, 700), (250, 150), (500, 150), (500, 0)]]),
    "C": (650, [[(50, 350), (325, 700), (600, 600), (350, 350), (600, 0), (325, 0)]]),
    "D": (600, [box(100, 0, 200, 700), [(200, 700), (550, 500), (200, 350)]]),
    "E": (500, [[(50, 0), (50, 700), (450, 700), (450, 550), (200, 550), (200, 150), (350, 150), (350, 0)]]),
    "H": (700, [[(100, 0), (100, 700), (200, 700), (200, 400), (500, 400), (500, 700), (600, 700), (600, 0)]]),
    "x": (500, [[(50, 0), (50, 500), (250, 300), (450, 500), (450, 0)]]),
    "a": (500, [[(50, 0), (150, 500), (450, 500), (450, 0)]]),
    "b": (520, [[(60, 0), (60, 750), (160, 750), (160, 450), (460, 250), (460, 0)]]),
    "c": (450, [[(50, 250), (400, 500), (250, 250), (400, 0)]]),
    "p": (520, [[(60, -200), (60, 500), (460, 350), (160, 100), (160, -200)]]),
    "f": (350, [[(50, 0), (50, 600), (150, 750), (330, 750), (330, 650), (150, 500), (150, 0)]]),
    "i": (250, [box(75, 0, 175, 450), box(60, 550, 190, 700)]),
    "f_i": (700, [[(50, 0), (350, 750), (650, 750), (650, 0), (550, 0), (550, 600), (150, 0)]]),
    "a_b": (900, [[(50, 0), (450, 500), (850, 0), (600, 0), (450, 250), (300, 0)]]),
    "i.turkish": (250, [box(75, 0, 175, 450), box(20, 600, 230, 650)]),
    "a.small": (400, [[(40, 0), (200, 450), (360, 0)]]),
    "b.small": (380, [[(60, 0), (60, 450), (160, 450), (160, 100), (340, 100), (340, 0)]]),
    "A.style": (800, [[(50, 0), (400, 700), (750, 0), (550, 0), (400, 300), (250, 0)]]),
    "zero": (550, [box(50, 0, 500, 700), [(150, 100), (400, 100), (400, 600), (150, 600)]]),
    "zero.slash": (550, [box(50, 0, 500, 700), [(150, 100), (400, 100), (150, 600)]]),
    "zero.old": (450, [box(50, 0, 400, 450), [(150, 100), (300, 100), (300, 350), (150, 350)]]),
    "one": (450, [[(150, 0), (150, 500), (50, 500), (250, 700), (300, 700), (300, 0)]]),
    "one.old": (350, [[(100, 0), (100, 350), (50, 350), (150, 450), (200, 450), (200, 0)]]),
    "one.sup": (250, [[(80, 400), (80, 600), (30, 600), (130, 700), (160, 700), (160, 400)]]),
    "one.sub": (250, [[(80, -150), (80, 50), (30, 50), (130, 150), (160, 150), (160, -150)]]),
}
FEATURES = """
languagesystem DFLT dflt; languagesystem latn dflt; languagesystem latn TRK;
feature locl { script latn; language TRK exclude_dflt; sub i by i.turkish; } locl;
feature liga { sub f i by f_i; } liga;
feature dlig { sub a b by a_b; } dlig;
feature smcp { sub a by a.small; sub b by b.small; } smcp;
feature c2sc { sub A by a.small; sub B by b.small; } c2sc;
feature ss01 { sub A by A.style; } ss01;
feature zero { sub zero by zero.slash; } zero;
feature onum { sub zero by zero.old; sub one by one.old; } onum;
feature sups { sub one by one.sup; } sups;
feature subs { sub one by one.sub; } subs;
feature kern { pos A B -200; pos B A 100; } kern;
"""
CHARACTERS = {ord(c): c for c in "ABCDEHxabcpfi"} | {
    0x20: "space", 0xA0: "nbspace", 0x2D: "hyphen", 0x30: "zero", 0x31: "one"}

WORLD = {
    ".notdef": LETTERS[".notdef"],
    "space": (300, []),
    "A": LETTERS["A"],
    "parenleft": (300, [[(250, -100), (50, 300), (250, 800), (150, 300)]]),
    "parenright": (300, [[(50, -100), (250, 300), (50, 800), (150, 300)]]),
    "alef": (600, [[(50, 0), (50, 600), (150, 600), (450, 200), (550, 600), (550, 0)]]),
    "bet": (550, [[(50, 0), (50, 100), (350, 100), (350, 500), (50, 600), (500, 600), (500, 0)]]),
    "gimel": (400, [[(50, 0), (200, 600), (350, 600), (350, 0), (250, 0), (250, 300)]]),
    "acute": (0, [[(-60, 750), (40, 950), (100, 900)]]),
    "beh": (700, [[(50, 0), (50, 300), (150, 300), (150, 100), (650, 100), (650, 0)], box(300, -200, 400, -100)]),
    "beh.init": (400, [[(0, 0), (0, 100), (250, 100), (250, 400), (350, 400), (350, 0)], box(150, -200, 250, -100)]),
    "beh.medi": (400, [[(0, 0), (0, 100), (150, 100), (200, 300), (250, 100), (400, 100), (400, 0)],
                       box(150, -200, 250, -100)]),
    "beh.fina": (650, [[(50, 0), (50, 300), (150, 300), (150, 100), (650, 100), (650, 0)],
                       box(250, -200, 350, -100)]),
    "alefar": (300, [box(100, 0, 200, 800)]),
    "alefar.fina": (350, [[(100, 0), (100, 800), (200, 800), (200, 100), (350, 100), (350, 0)]]),
    "one.cjk": (1000, [[(100, 250), (50, 400), (950, 450), (900, 250)]]),
    "two.cjk": (1000, [box(250, 600, 750, 700), [(50, 0), (150, 150), (900, 150), (950, 0)]]),
    "comma.cjk": (1000, [[(100, 0), (300, 200), (350, 50)]]),
    "comma.vert": (1000, [[(700, 600), (900, 800), (950, 650)]]),
}
WORLD_FEATURES = """
languagesystem DFLT dflt; languagesystem arab dflt; languagesystem latn dflt; languagesystem hebr dflt;
languagesystem hani dflt;
feature init { script arab; sub beh by beh.init; } init;
feature medi { script arab; sub beh by beh.medi; } medi;
feature fina { script arab; sub beh by beh.fina; sub alefar by alefar.fina; } fina;
feature vert { script hani; sub comma.cjk by comma.vert; script DFLT; sub comma.cjk by comma.vert; } vert;
markClass acute <anchor 0 700> @above;
feature mark { pos base A <anchor 300 700> mark @above; pos base bet <anchor 300 600> mark @above; } mark;
"""
WORLD_CHARACTERS = {0x20: "space", 0x41: "A", 0x28: "parenleft", 0x29: "parenright", 0x5D0: "alef", 0x5D1: "bet",
                    0x5D2: "gimel", 0x301: "acute", 0x628: "beh", 0x627: "alefar", 0x4E00: "one.cjk",
                    0x4E8C: "two.cjk", 0x3001: "comma.cjk"}


def mapped(glyphs, function, width=1):
    return {name: (round(advance * width), [[function(x, y) for x, y in contour] for contour in contours])
            for name, (advance, contours) in glyphs.items()}


def truetype(glyphs):
    made = {}
    for name, (_, contours) in glyphs.items():
        pen = TTGlyphPen(None)
        for first, *rest in contours:
            pen.moveTo(first)
            for corner in rest:
                pen.lineTo(corner)
            pen.closePath()
        made[name] = pen.glyph()
    return made


def finish(builder, family, style, weight, width, slanted, glyphs, xHeight, capHeight):
    em = builder.font["head"].unitsPerEm
    unit = em / 1000
    ascent, descent = round(800 * unit), round(200 * unit)
    builder.setupHorizontalHeader(ascent=ascent, descent=-descent)
    full = f"{family} {style}"
    builder.setupNameTable({"familyName": family, "styleName": style, "uniqueFontIdentifier": full, "fullName": full,
                            "psName": full.replace(" ", ""), "version": "1.0"})
    regular = weight == 400 and not slanted
    builder.setupOS2(version=4, sTypoAscender=ascent, sTypoDescender=-descent, sTypoLineGap=0, usWinAscent=ascent,
                     usWinDescent=descent, usWeightClass=weight, usWidthClass=width, sxHeight=xHeight,
                     sCapHeight=capHeight, ySubscriptYOffset=round(150 * unit), ySuperscriptYOffset=round(350 * unit),
                     yStrikeoutPosition=round(300 * unit), yStrikeoutSize=round(60 * unit),
                     fsSelection=(1 if slanted else 0) | (0x20 if weight >= 600 else 0) | (0x40 if regular else 0))
    builder.setupPost(underlinePosition=round(-120 * unit), underlineThickness=round(80 * unit))
    builder.font["head"].macStyle = (1 if weight >= 600 else 0) | (2 if slanted else 0)
    builder.font["head"].created = builder.font["head"].modified = DATE
    builder.font.recalcTimestamp = False


def bearings(glyphs):
    """Advance and left edge."""
    return {name: (advance, min((x for contour in contours for x, _ in contour), default=0))
            for name, (advance, contours) in glyphs.items()}


def begin(glyphs, characters, em=1000, outlines="glyf"):
    builder = FontBuilder(em, isTTF=outlines == "glyf")
    builder.setupGlyphOrder(list(glyphs))
    builder.setupCharacterMap(characters)
    return builder


def write(file, family, style, glyphs, characters, features, weight=400, width=5, slanted=False, vertical=False):
    builder = begin(glyphs, characters)
    builder.setupGlyf(truetype(glyphs))
    builder.setupHorizontalMetrics(bearings(glyphs))
    finish(builder, family, style, weight, width, slanted, glyphs, 500, 700)
    if vertical:
        top = {name: 1000 for name in glyphs}
        builder.setupVerticalHeader(ascent=500, descent=-500)
        builder.setupVerticalMetrics({
            name: (top[name], 800 - max((y for contour in contours for _, y in contour), default=800))
            for name, (_, contours) in glyphs.items()})
    addOpenTypeFeaturesFromString(builder.font, features)
    builder.font.save(FOLDER / file)


def write_cubic():
    """CFF outlines: a curve, 2048 units an em, no heights in OS/2 version 1."""
    builder = begin({".notdef": 0, "space": 0, "A": 0, "x": 0}, {0x20: "space", 0x41: "A", 0x78: "x"}, 2048, "CFF")
    strings = {}
    for name, curve in {".notdef": None, "space": None, "A": (0, 1400), "x": (0, 1000)}.items():
        pen = T2CharStringPen(1200, None)
        if curve:
            pen.moveTo((100, 0))
            pen.curveTo((100, 600), (300, curve[1]), (700, curve[1]))
            pen.lineTo((1100, curve[1]))
            pen.curveTo((800, 800), (1100, 300), (1000, 0))
            pen.closePath()
        strings[name] = pen.getCharString()
    builder.setupCFF("VTMCubic-Regular", {"FullName": "VTM Cubic Regular"}, strings, {})
    builder.setupHorizontalMetrics({name: (1200, 100 if name in "Ax" else 0) for name in strings})
    finish(builder, "VTM Cubic", "Regular", 400, 5, False, strings, 1000, 1400)
    builder.font.save(FOLDER / "VTMCubic-Regular.otf")


def write_variable():
    """Axis wght: the right edge of A goes with it by a unit a weight unit, and so does the advance; GROW: its top."""
    glyphs = {".notdef": LETTERS[".notdef"], "space": (300, []), "A": (600, [box(100, 0, 400, 500)])}
    builder = begin(glyphs, {0x20: "space", 0x41: "A"})
    builder.setupGlyf(truetype(glyphs))
    builder.setupHorizontalMetrics(bearings(glyphs))
    finish(builder, "VTM Variable", "Regular", 400, 5, False, glyphs, 500, 700)
    builder.setupFvar([("wght", 100, 400, 900, "Weight"), ("GROW", 0, 0, 100, "Growth")], [])
    # Corners in order, then the four phantom points (left, right, top, bottom).
    builder.setupGvar({"A": [
        TupleVariation({"wght": (0, 1, 1)}, [(0, 0), (0, 0), (500, 0), (500, 0), (0, 0), (500, 0), (0, 0), (0, 0)]),
        TupleVariation({"wght": (-1, -1, 0)},
                       [(0, 0), (0, 0), (-200, 0), (-200, 0), (0, 0), (-200, 0), (0, 0), (0, 0)]),
        TupleVariation({"GROW": (0, 1, 1)}, [(0, 0), (0, 300), (0, 300), (0, 0), (0, 0), (0, 0), (0, 0), (0, 0)]),
    ]})
    builder.font.save(FOLDER / "VTMVariable.ttf")


def main():
    FOLDER.mkdir(exist_ok=True)
    family = "VTM Test"

    def face(style, function=lambda x, y: (x, y), stretched=1, **properties):
        write(f"VTMTest-{style.replace(' ', '')}.ttf", family, style, mapped(LETTERS, function, stretched), CHARACTERS,
              FEATURES, **properties)

    face("Regular")
    face("Bold", lambda x, y: (x, y + (100 if y > 0 else 0)), weight=700)
    face("Black", lambda x, y: (x, y - 100 if y > 400 else y), weight=900)
    face("Light", lambda x, y: (x, y + 100), weight=300)
    face("Italic", lambda x, y: (x + y // 5, y), slanted=True)
    face("Condensed", lambda x, y: (x // 2, y), stretched=0.5, width=3)
    write("VTMWorld-Regular.ttf", "VTM World", "Regular", WORLD, WORLD_CHARACTERS, WORLD_FEATURES, vertical=True)
    write_cubic()
    write_variable()


if __name__ == "__main__":
    main()
