"""Choice of fonts and sizes: CSS Fonts 4 sections 2 and 5."""
import math

from layout import (BLACK, BOLD, CONDENSED, CUBIC, ITALIC, LIGHT, RED, SIZE, TEST, WORLD, X_HEIGHT, Matrix, draw, glyph,
                    line, move, rectangle, scale, width)
from registry import case

A, C = (TEST.advance(n) * SIZE for n in "AC")


def shown(name, about, attributes, face=TEST, size=SIZE, key=None, without="", text="AC", around=""):
    body = f'<text x="20" y="100"{attributes}>{text}</text>'
    case(f"font/{name}", about, f"<g{around}>{body}</g>" if around else body,
         draw(line(text, 20, 100, face, size=size)), key or attributes, without)


shown("family", "A family by its name.", ' font-family="VTM Cubic"', CUBIC, text="Ax")
shown("family-case", "Names are compared without case.", ' font-family="vtm CUBIC"', CUBIC, text="Ax")
shown("family-quoted", "A name in quotes.", " font-family=\"'VTM Cubic'\"", CUBIC, text="Ax")
shown("family-list", "The first family that is there.", ' font-family="Nowhere, VTM Cubic, VTM World"', CUBIC, text="A")
shown("family-generic", "A generic name stands for the family that options give.", ' font-family="serif"', CUBIC, text="Ax")
shown("family-quoted-generic", "A generic name in quotes is a name.", " font-family=\"'sans-serif', 'VTM Cubic'\"", CUBIC,
      text="Ax")
shown("family-none", "Without any that is there: the default family.", ' font-family="Nowhere"', TEST, text="AC",
      key="Nowhere", without="VTM Cubic")
case("font/fallback-list", "A character that the first family lacks comes from the next.",
     '<text x="20" y="100" font-family="VTM World, VTM Cubic">Ax</text>',
     draw(glyph("A", 20, 100, face=WORLD), glyph("x", 20 + A, 100, face=CUBIC)), ", VTM Cubic")
case("font/fallback-any", "One that no family of the list has comes from any font.",
     '<text x="20" y="100" font-family="VTM Test">A\u05d0</text>',
     draw(glyph("A", 20, 100), glyph("alef", 20 + A, 100, face=WORLD)), "\u05d0", "x")
case("font/fallback-cluster", "A letter and its mark come from one font.",
     '<text x="20" y="100" font-family="VTM Test">A\u0301</text>',
     draw(glyph("A", 20, 100, face=WORLD), glyph("acute", 20 + 0.3 * SIZE, 100, face=WORLD)), "\u0301")
case("font/missing-glyph", "A character that no font has: the first font's glyph for that.",
     '<text x="20" y="100">A\u2603C</text>',
     draw(glyph("A", 20, 100), glyph(".notdef", 20 + A, 100), glyph("C", 44 + A, 100)), "\u2603")
for weight, face in {"bold": BOLD, "700": BOLD, "900": BLACK, "300": LIGHT, "100": LIGHT, "600": BOLD, "800": BLACK,
                     "bolder": BOLD, "lighter": LIGHT, "1000": BLACK}.items():
    shown(f"weight-{weight}", f"font-weight: {weight} of a family with 300, 400, 700 and 900.",
          f' font-weight="{weight}"', face)
shown("weight-500", "500 takes 400 where there is no 500.", ' font-weight="500"', TEST, key='"500"', without='"700"')
shown("weight-normal", "normal takes bold back.", ' font-weight="normal"', TEST, around=' font-weight="bold"')
shown("weight-bolder-bold", "bolder than bold is 900.", ' font-weight="bolder"', BLACK, around=' font-weight="bold"')
shown("weight-lighter-black", "lighter than 900 is 700.", ' font-weight="lighter"', BOLD, around=' font-weight="900"')
shown("weight-lighter-bold", "lighter than bold is normal.", ' font-weight="lighter"', TEST, around=' font-weight="bold"')
shown("weight-invalid", "An invalid weight is not used.", ' font-weight="1001"', TEST, key="1001", without="1000")
shown("italic", "font-style: italic.", ' font-style="italic"', ITALIC)
shown("oblique", "oblique takes italic where there is no oblique.", ' font-style="oblique"', ITALIC)
shown("oblique-angle", "oblique with an angle.", ' style="font-style: oblique 10deg"', ITALIC)
shown("condensed", "font-stretch.", ' font-stretch="condensed"', CONDENSED)
shown("condensed-percent", "font-stretch in percent: the nearest narrower one.", ' font-stretch="80%"', CONDENSED)
shown("condensed-before-weight", "Width is matched before weight.", ' font-stretch="condensed" font-weight="bold" style="font-synthesis: none"', CONDENSED,
      key=' font-stretch="condensed"')
shown("italic-before-weight", "Style is matched before weight.", ' font-style="italic" font-weight="bold" style="font-synthesis: none"', ITALIC,
      key=' font-style="italic"')
SLANT = math.tan(math.radians(14))
case("font/synthetic-oblique", "A family without an italic face: its upright one, slanted by 14 degrees.",
     '<text x="20" y="100" font-family="VTM Cubic" font-style="italic">A</text>',
     draw(glyph("A", 0, 0, face=CUBIC, frame=move(20, 100) @ Matrix(1, 0, -SLANT, 1, 0, 0))), ' font-style="italic"')
case("font/no-synthesis", "font-synthesis: none.",
     '<text x="20" y="100" font-family="VTM Cubic" font-style="italic" style="font-synthesis: none">A</text>',
     draw(glyph("A", 20, 100, face=CUBIC)), ' style="[^"]*"')
case("font/no-synthesis-style", "font-synthesis-style: none.",
     '<text x="20" y="100" font-family="VTM Cubic" font-style="italic" style="font-synthesis-style: none">A</text>',
     draw(glyph("A", 20, 100, face=CUBIC)), ' style="[^"]*"')
for size, units in {"50": 50, "30pt": 40 * 1, "2pc": 32, "0.5in": 48, "10mm": 960 / 25.4, "1.5em": 60, "75%": 30,
                    "2ex": 2 * X_HEIGHT * SIZE, "large": 14.4, "larger": 48, "smaller": SIZE / 1.2,
                    "medium": 12}.items():
    shown(f"size-{size.replace('%', '-percent')}", f"font-size: {size}.", f' font-size="{size}"', TEST, units,
          key=f'font-size="{size}"', without='font-size="20"')
shown("size-medium-in-large", "medium is the initial size, not the root's.", ' font-size="medium"', TEST, 12,
      key='medium', without='20', around=' font-size="80"')
shown("size-rem", "Of the root element.", ' style="font-size: 1.5rem"', TEST, 60, around=' font-size="10"')
shown("size-zero", "Nothing is drawn of text without size.", ' font-size="0"', TEST, 0, text="AC")
shown("size-negative", "An error: inherited.", ' font-size="-50"', TEST, 40, key='"-50"', without='"50"')
shown("shorthand", "font: style, weight, size, line height and family.",
      " style=\"font: italic bold 50px/2 'VTM Test', serif; font-synthesis: none\"", ITALIC, 50)
shown("shorthand-resets", "font resets what it does not say.", " style=\"font-weight: bold; font: 50px 'VTM Test'\"", TEST, 50,
      key=" font: 50px 'VTM Test'")
shown("shorthand-condensed", "font with a width by its name.", ' style="font: condensed 40px VTM Test"', CONDENSED)
shown("shorthand-invalid", "Without a family it is invalid as a whole.", ' style="font: bold 50px"', TEST, 40,
      key="bold 50px", without="bold 50px VTM Test")
shown("shorthand-attribute", "As a presentation attribute it is not known.", ' font="bold 50px VTM Test"', TEST, 40,
      key=' font="([^"]*)"', without=r' style="font: \1"')
shown("size-adjust", "font-size-adjust: the x-height is so many ems.", ' font-size-adjust="0.4"', TEST, 0.4 / X_HEIGHT * SIZE)
shown("size-adjust-em", "It does not change ems.", ' font-size-adjust="0.4" letter-spacing="0"', TEST, 32,
      key=' font-size-adjust="0.4"')


def variable(name, about, attributes, weight, growth, key):
    """The glyph A of VTM Variable: a box whose right edge and advance go with the weight and whose top with GROW."""
    # Places on an axis are rounded to 2^-14 of its half (OpenType, F2DOT14).
    share = round((weight - 400) / (500 if weight > 400 else 300) * 2**14) / 2**14
    wider = share * (500 if weight > 400 else 200)
    right, top, advance = 400 + wider, 500 + 3 * growth, 600 + wider
    unit = SIZE / 1000
    boxes = [rectangle(x + 100 * unit, 100 - top * unit, x + right * unit, 100) for x in (20, 20 + advance * unit)]
    case(f"font/variable-{name}", about, f'<text x="20" y="100" font-family="VTM Variable"{attributes}>AA</text>',
         draw(*boxes), key)


variable("weight-700", "An axis by font-weight, advances too.", ' font-weight="700"', 700, 0, ' font-weight="700"')
variable("weight-250", "Below the default, where the axis has 200 units in 300.", ' font-weight="250"', 250, 0, ' font-weight="250"')
variable("weight-clamped", "Not beyond its end.", ' font-weight="1000"', 900, 0, ' font-weight="1000"')
variable("settings", "An axis by font-variation-settings.", """ style="font-variation-settings: 'GROW' 50\"""", 400, 50,
         ' style="[^"]*"')
variable("settings-win", "Which wins over font-weight.",
         """ font-weight="700" style="font-variation-settings: 'GROW' 100, 'wght' 250\"""", 250, 100, ", 'wght' 250")
