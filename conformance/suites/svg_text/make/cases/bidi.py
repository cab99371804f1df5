"""direction and unicode-bidi: CSS Writing Modes 4 section 2, UAX 9; joined scripts.

Glyphs are listed from left to right, as they stand in the picture.
"""
from layout import RED, SIZE, WORLD, draw, glyph, line, width
from registry import case

ALEF, BET, GIMEL, BEH = "\u05d0", "\u05d1", "\u05d2", "\u0628"
FONT = 'font-family="VTM World"'


def ordered(name, about, attributes, content, glyphs, key, without="", right=None):
    """From x = 20 on, or up to `right`."""
    left = 20 if right is None else right - width(glyphs, WORLD)
    case(f"bidi/{name}", about, f'<text x="{right or 20}" y="100" {FONT}{attributes}>{content}</text>',
         draw(line(glyphs, left, 100, WORLD)), key, without)


ordered("hebrew", "Right-to-left letters in left-to-right text.", "", f"A {ALEF}{BET} A",
        ["A", "space", "bet", "alef", "space", "A"], ALEF + BET, BET + ALEF)
ordered("latin-in-hebrew", "Latin letters in right-to-left text.", ' direction="rtl"', f"{ALEF} A {BET}",
        ["bet", "space", "A", "space", "alef"], ' direction="rtl"', right=180)
case("bidi/direction-inherited", "direction from a group's style.",
     f'<g style="direction: rtl"><text x="150" y="100" {FONT}>{ALEF}A</text></g>',
     draw(line(["A", "alef"], 150 - 1.2 * SIZE, 100, WORLD)), ' style="direction: rtl"')
ordered("override", "bidi-override turns letters of the other direction.", "",
        'A<tspan direction="rtl" unicode-bidi="bidi-override">A(</tspan>', ["A", "parenright", "A"],
        ' unicode-bidi="bidi-override"')
ordered("override-on-text", "bidi-override on the text itself.", ' direction="rtl" unicode-bidi="bidi-override"',
        "A\u4e00", ["one.cjk", "A"], ' unicode-bidi="bidi-override"', right=150)
ordered("embed", "embed: a line of the other direction in the line.", "",
        f'A<tspan direction="rtl" unicode-bidi="embed">{ALEF} A</tspan>A', ["A", "A", "space", "alef", "A"],
        ' unicode-bidi="embed"')
ordered("direction-without-embed", "direction of a tspan alone orders nothing.", "",
        f'A<tspan direction="rtl">{ALEF} A</tspan>A', ["A", "alef", "space", "A", "A"], 'direction="rtl"',
        'direction="rtl" unicode-bidi="embed"')
ordered("isolate", "isolate: what is inside does not order what is around it.", "",
        f'{ALEF}<tspan unicode-bidi="isolate">A</tspan>{BET}', ["bet", "A", "alef"], ' unicode-bidi="isolate"')
ordered("isolate-override", "isolate-override: both.", "",
        f'{ALEF}<tspan unicode-bidi="isolate-override">{BET}{GIMEL}</tspan>{ALEF}', ["alef", "bet", "gimel", "alef"],
        ' unicode-bidi="isolate-override"')
ordered("plaintext", "plaintext: the first letter decides.", "",
        f'A<tspan unicode-bidi="plaintext">{ALEF} A</tspan>', ["A", "A", "space", "alef"],
        ' unicode-bidi="plaintext"')
ordered("mirrored", "Brackets are mirrored in right-to-left text.", ' direction="rtl"', f"({ALEF})",
        ["parenleft", "alef", "parenright"], r"\(", ")", right=150)
ordered("arabic", "Letters join: first, middle and last forms.", ' direction="rtl"', f"{BEH}{BEH}\u0627",
        ["alefar.fina", "beh.medi", "beh.init"], "\u0627", BEH, right=150)
ordered("arabic-alone", "A letter alone.", ' direction="rtl"', f"{BEH} {BEH}", ["beh", "space", "beh"], " \u0628<", "\u0628<",
        right=150)
ordered("arabic-non-joiner", "A zero-width non-joiner parts letters and takes no room.", ' direction="rtl"',
        f"{BEH}\u200c{BEH}", ["beh", "beh"], "\u200c", right=150)
case("bidi/mark-on-letter", "A mark stands on its right-to-left letter.",
     f'<text x="150" y="100" direction="rtl" {FONT}>{BET}\u0301{ALEF}</text>',
     draw(line(["alef", "bet"], 150 - width(["alef", "bet"], WORLD), 100, WORLD),
          glyph("acute", 150 - 0.25 * SIZE, 100 + 0.1 * SIZE, face=WORLD)), "\u0301")
case("bidi/arabic-across-tspans", "Letters of two elements join, each in its own paint.",
     f'<text x="150" y="100" direction="rtl" {FONT}>{BEH}<tspan fill="{RED}">{BEH}</tspan></text>',
     draw(glyph("beh.init", 150 - 0.4 * SIZE, 100, face=WORLD))
     + draw(glyph("beh.fina", 150 - 1.05 * SIZE, 100, face=WORLD), fill=RED), f' fill="{RED}"')
case("bidi/x-list", "Each x is the right edge of a right-to-left character.",
     f'<text x="80 160" y="100" direction="rtl" {FONT}>{ALEF}{BET}</text>',
     draw(glyph("alef", 80 - 0.6 * SIZE, 100, face=WORLD), glyph("bet", 160 - 0.55 * SIZE, 100, face=WORLD)), " 160")
case("bidi/arabic-x-list", "Letters that are placed one by one keep the forms in which they join.",
     f'<text x="110 40" y="100" {FONT}>{BEH}{BEH}</text>',
     draw(glyph("beh.init", 110, 100, face=WORLD), glyph("beh.fina", 40, 100, face=WORLD)), " 40")
case("bidi/arabic-lines", "Letters of an element on another line do not join with it.",
     f'<text x="110" y="60" {FONT}>{BEH}{BEH}<tspan x="110" y="120">{BEH}</tspan><tspan x="110" dy="40">{BEH}</tspan></text>',
     draw(*(glyph(name, 110 + x * SIZE, y, face=WORLD)
            for name, x, y in (("beh.fina", 0, 60), ("beh.init", 0.65, 60), ("beh", 0, 120), ("beh", 0, 160)))),
     ' dy="40"')
case("bidi/dx", "dx counts characters in logical order.",
     f'<text x="150" y="100" dx="0 -15" direction="rtl" {FONT}>{ALEF}{BET}</text>',
     draw(glyph("alef", 150 - 0.6 * SIZE, 100, face=WORLD), glyph("bet", 135 - 1.15 * SIZE, 100, face=WORLD)),
     ' dx="0 -15"')
case("bidi/rotate", "So does rotate.", f'<text x="150" y="100" rotate="20 0" direction="rtl" {FONT}>{ALEF}{BET}</text>',
     draw(glyph("alef", 150 - 0.6 * SIZE, 100, face=WORLD, rotate=20),
          glyph("bet", 150 - 1.15 * SIZE, 100, face=WORLD)), ' rotate="20 0"')
case("bidi/colours", "The paint goes with the character.",
     f'<text x="20" y="100" {FONT}>A{ALEF}<tspan fill="{RED}">{BET}</tspan>{GIMEL}</text>',
     draw(glyph("A", 20, 100, face=WORLD), glyph("gimel", 44, 100, face=WORLD), glyph("alef", 82, 100, face=WORLD))
     + draw(glyph("bet", 60, 100, face=WORLD), fill=RED), f' fill="{RED}"')
case("bidi/anchor-of-tspan", "text-anchor: start is that of the direction of the chunk's first character (SVG 2 11.5).",
     f'<text x="20" y="60" {FONT}>A<tspan x="150" y="120" direction="rtl" unicode-bidi="embed">{ALEF}{BET}</tspan></text>',
     draw(glyph("A", 20, 60, face=WORLD), line(["bet", "alef"], 150 - 1.15 * SIZE, 120, WORLD)), ' direction="rtl"')
case("bidi/chunks", "Nothing is reordered across chunks.",
     f'<text x="20 90" y="100" {FONT}>{ALEF}{BET}{GIMEL}</text>',
     draw(glyph("alef", 20, 100, face=WORLD), line(["gimel", "bet"], 90, 100, WORLD)), " 90")
