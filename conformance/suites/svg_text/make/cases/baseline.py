"""dominant-baseline, alignment-baseline and baseline-shift: SVG 2 section 11.10.2, CSS Inline 3.

The fonts have no table of baselines: hanging and mathematical are 0.8 and 0.5 of the ascent, as in browsers.
"""
from layout import ASCENT, DESCENT, RED, SIZE, SUB, SUPER, TEST, X_HEIGHT, draw, glyph, line
from registry import case

A, C = (TEST.advance(n) * SIZE for n in "AC")
HEIGHTS = {"middle": X_HEIGHT / 2, "central": (ASCENT - DESCENT) / 2, "hanging": 0.8 * ASCENT,
           "mathematical": ASCENT / 2, "ideographic": -DESCENT, "text-before-edge": ASCENT, "text-top": ASCENT,
           "text-after-edge": -DESCENT, "text-bottom": -DESCENT}

for word, height in HEIGHTS.items():
    case(f"baseline/dominant-{word}", f"dominant-baseline: {word} of the font stands on y.",
         f'<text x="20" y="100" dominant-baseline="{word}">ACp</text>', draw(line("ACp", 20, 100 + height * SIZE)),
         f' dominant-baseline="{word}"')
for word in ("middle", "central", "text-before-edge", "text-after-edge"):
    case(f"baseline/alignment-{word}", f"alignment-baseline of a tspan: its {word} stands on the line's baseline.",
         f'<text x="20" y="100">A<tspan alignment-baseline="{word}" fill="{RED}">C</tspan>A</text>',
         draw(glyph("A", 20, 100), glyph("A", 20 + A + C, 100))
         + draw(glyph("C", 20 + A, 100 + HEIGHTS[word] * SIZE), fill=RED), f' alignment-baseline="{word}"')

case("baseline/dominant-alphabetic", "alphabetic: the same as without.",
     '<text x="20" y="100" dominant-baseline="alphabetic">ACp</text>', draw(line("ACp", 20, 100)), "alphabetic",
     "hanging")
case("baseline/dominant-inherited", "From a group.",
     '<g dominant-baseline="hanging"><text x="20" y="100">ACp</text></g>',
     draw(line("ACp", 20, 100 + HEIGHTS["hanging"] * SIZE)), ' dominant-baseline="hanging"')
case("baseline/dominant-in-tspan-size", "Letters of two sizes hang from one line.",
     '<text x="20" y="60" dominant-baseline="hanging">A<tspan font-size="80">C</tspan></text>',
     draw(glyph("A", 20, 60 + HEIGHTS["hanging"] * SIZE), glyph("C", 20 + A, 60 + HEIGHTS["hanging"] * 80, size=80)),
     ' dominant-baseline="hanging"')
SHIFTS = {"sub": -SUB * SIZE, "super": SUPER * SIZE, "12": 12, "-9": -9, "50%": 20, "0.25em": 10, "baseline": 0}
for value, up in SHIFTS.items():
    case(f"baseline/shift-{value.replace('%', '-percent')}", f"baseline-shift: {value}; what follows is on the line.",
         f'<text x="20" y="100">A<tspan baseline-shift="{value}">C</tspan>A</text>',
         draw(glyph("A", 20, 100), glyph("C", 20 + A, 100 - up), glyph("A", 20 + A + C, 100)),
         f'baseline-shift="{value}"', 'baseline-shift="3"')
case("baseline/shift-nested", "Shifts of elements in each other add up.",
     '<text x="20" y="100">A<tspan baseline-shift="10">C<tspan baseline-shift="super">A</tspan></tspan></text>',
     draw(glyph("A", 20, 100), glyph("C", 20 + A, 90), glyph("A", 20 + A + C, 90 - SUPER * SIZE)),
     ' baseline-shift="super"')
case("baseline/shift-in-small-text", "super and sub are those of the font around the element (CSS Inline 3 section 4.2.3).",
     '<text x="20" y="100">A<tspan baseline-shift="super" font-size="20">C</tspan></text>',
     draw(glyph("A", 20, 100), glyph("C", 20 + A, 100 - SUPER * SIZE, size=20)), ' baseline-shift="super"')
case("baseline/shift-with-dy", "dy stays behind the element, the shift does not.",
     '<text x="20" y="100">A<tspan baseline-shift="10" dy="5">C</tspan>A</text>',
     draw(glyph("A", 20, 100), glyph("C", 20 + A, 95), glyph("A", 20 + A + C, 105)), ' baseline-shift="10"')
case("baseline/shift-and-alignment", "A shift on top of an alignment.",
     '<text x="20" y="100">A<tspan baseline-shift="10" alignment-baseline="middle">C</tspan></text>',
     draw(glyph("A", 20, 100), glyph("C", 20 + A, 90 + HEIGHTS["middle"] * SIZE)), ' alignment-baseline="middle"')
