"""text-decoration: SVG 2 section 11.10.3, CSS Text Decoration 3 section 2.

The middles and thicknesses of lines are the font's; overlines are at its ascent.
"""
from layout import (ASCENT, BLUE, GREEN, ITALIC, RED, SIZE, STRIKE, STRIKE_SIZE, TEST, UNDERLINE, UNDERLINE_SIZE, bar,
                    draw, glyph, line, move, rectangle, turn, underline, width)
from registry import case

A, C, E = (TEST.advance(n) * SIZE for n in "ACE")
END = 20 + A + C + E
PLACES = {"underline": (UNDERLINE, UNDERLINE_SIZE), "overline": (-ASCENT, UNDERLINE_SIZE),
          "line-through": (-STRIKE, STRIKE_SIZE)}

for word, place in PLACES.items():
    case(f"decoration/{word}", f"{word}.", f'<text x="20" y="100" text-decoration="{word}">ACE</text>',
         draw(line("ACE", 20, 100)) + draw(bar(20, END, 100, *place)), f' text-decoration="{word}"')
case("decoration/all", "Three lines.", '<text x="20" y="100" text-decoration="underline overline line-through">ACE</text>',
     draw(line("ACE", 20, 100)) + draw(*(bar(20, END, 100, *place) for place in PLACES.values())), "underline overline ")
case("decoration/order", "Underlines are below the glyphs, line-through is above them; paints of two elements.",
     f'<text x="20" y="100" text-decoration="underline line-through" fill="{RED}"><tspan fill="{BLUE}">pHp</tspan></text>',
     draw(underline(20, 20 + width("pHp"), 100), fill=RED) + draw(line("pHp", 20, 100))
     + draw(bar(20, 20 + width("pHp"), 100, *PLACES["line-through"]), fill=RED), " line-through")
case("decoration/of-tspan", "Under the characters of a tspan only.",
     '<text x="20" y="100">A<tspan text-decoration="underline">C</tspan>E</text>',
     draw(line("ACE", 20, 100)) + draw(underline(20 + A, 20 + A + C, 100)), ' text-decoration="underline"')
case("decoration/paint-of-parent", "A line has the paint of the element that asks for it.",
     f'<text x="20" y="100" text-decoration="underline">A<tspan fill="{RED}">C</tspan>E</text>',
     draw(glyph("A", 20, 100), glyph("E", 20 + A + C, 100)) + draw(glyph("C", 20 + A, 100), fill=RED)
     + draw(underline(20, END, 100)), ' text-decoration="underline"')
case("decoration/two-elements", "Each with its own line in its own paint.",
     f'<text x="20" y="100" text-decoration="underline">A<tspan fill="{RED}" text-decoration="overline">C</tspan>E</text>',
     draw(glyph("A", 20, 100), glyph("E", 20 + A + C, 100), underline(20, END, 100))
     + draw(glyph("C", 20 + A, 100), bar(20 + A, 20 + A + C, 100, *PLACES["overline"]), fill=RED),
     ' text-decoration="overline"')
case("decoration/size-of-parent", "Place and thickness are those of the font of the element that asks for it.",
     '<text x="20" y="100" text-decoration="underline">A<tspan font-size="20">C</tspan></text>',
     draw(glyph("A", 20, 100), glyph("C", 20 + A, 100, size=20), underline(20, 20 + A + C / 2, 100)),
     ' text-decoration="underline"')
case("decoration/of-group", "A group's reaches the text in it, in the text's paint.",
     f'<g text-decoration="underline"><text x="20" y="100" fill="{RED}">ACE</text></g>',
     draw(line("ACE", 20, 100), underline(20, END, 100), fill=RED), ' text-decoration="underline"')
case("decoration/not-undone", "none on a tspan does not take away the line of the text around it.",
     '<text x="20" y="100" text-decoration="underline">A<tspan text-decoration="none">C</tspan>E</text>',
     draw(line("ACE", 20, 100), underline(20, END, 100)), ' text-decoration="underline"')
case("decoration/spaces", "A line runs on below spaces.", '<text x="20" y="100" text-decoration="underline">A C</text>',
     draw(line("A C", 20, 100), underline(20, 20 + width("A C"), 100)), ' text-decoration="underline"')
case("decoration/gap", "A shift tears the line.", '<text x="20" y="100" dx="0 30" text-decoration="underline">AC</text>',
     draw(glyph("A", 20, 100), glyph("C", 50 + A, 100), underline(20, 20 + A, 100),
          underline(50 + A, 50 + A + C, 100)), ' text-decoration="underline"')
case("decoration/letter-spacing", "A line runs on below the space between letters.",
     '<text x="20" y="100" letter-spacing="15" text-decoration="underline">AC</text>',
     draw(line("AC", 20, 100, spacing=15), underline(20, 35 + A + C, 100)), ' text-decoration="underline"')
case("decoration/dy", "A line goes with each character.", '<text x="20" y="100" dy="0 20" text-decoration="underline">AC</text>',
     draw(glyph("A", 20, 100), glyph("C", 20 + A, 120), underline(20, 20 + A, 100), underline(20 + A, 20 + A + C, 120)),
     ' text-decoration="underline"')
TURNED = [move(20, 100) @ turn(25), move(20 + A, 100) @ turn(25)]
case("decoration/rotate", "A line is turned with each character.",
     '<text x="20" y="100" rotate="25" text-decoration="underline">AC</text>',
     draw(glyph("A", 20, 100, rotate=25), glyph("C", 20 + A, 100, rotate=25),
          *(rectangle(0, (UNDERLINE - UNDERLINE_SIZE / 2) * SIZE, w, (UNDERLINE + UNDERLINE_SIZE / 2) * SIZE, frame)
            for w, frame in zip((A, C), TURNED))), ' text-decoration="underline"')
case("decoration/stroke", "Lines are filled and stroked like glyphs.",
     f'<text x="20" y="100" text-decoration="underline" stroke="{RED}" stroke-width="2">AC</text>',
     draw(underline(20, 20 + A + C, 100), stroke=RED, stroke_width=2)
     + draw(line("AC", 20, 100), stroke=RED, stroke_width=2), ' text-decoration="underline"')
case("decoration/shifted", "An underline of the text is straight below a superscript in it.",
     '<text x="20" y="100" text-decoration="underline">A<tspan baseline-shift="15">C</tspan></text>',
     draw(glyph("A", 20, 100), glyph("C", 20 + A, 85), underline(20, 20 + A + C, 100)), ' text-decoration="underline"')
case("decoration/shifted-itself", "That of a superscript itself goes up with it.",
     '<text x="20" y="100">A<tspan baseline-shift="15" text-decoration="underline">C</tspan></text>',
     draw(glyph("A", 20, 100), glyph("C", 20 + A, 85), underline(20 + A, 20 + A + C, 85)), ' text-decoration="underline"')
case("decoration/anchor", "Beside text-anchor.",
     '<text x="180" y="100" text-anchor="end" text-decoration="underline">AC</text>',
     draw(line("AC", 180 - A - C, 100), underline(180 - A - C, 180, 100)), ' text-decoration="underline"')
case("decoration/italic", "Lines of an oblique font are not slanted.",
     '<text x="20" y="100" font-style="italic" text-decoration="underline">AC</text>',
     draw(line("AC", 20, 100, ITALIC), underline(20, 20 + A + C, 100)), ' text-decoration="underline"')
case("decoration/line-property", "The longhand text-decoration-line in a style.",
     '<text x="20" y="100" style="text-decoration-line: underline">AC</text>',
     draw(line("AC", 20, 100), underline(20, 20 + A + C, 100)), ' style="[^"]*"')
case("decoration/hidden", "A hidden tspan has no glyphs; the line of the visible text around it runs through.",
     '<text x="20" y="100" text-decoration="underline">A<tspan visibility="hidden">C</tspan>E</text>',
     draw(glyph("A", 20, 100), glyph("E", 20 + A + C, 100), underline(20, END, 100)), ' visibility="hidden"')
case("decoration/gradient", "A paint server sees the box of the whole text.",
     f'<linearGradient id="g"><stop offset="0.5" stop-color="{GREEN}"/><stop offset="0.5" stop-color="{RED}"/>'
     '</linearGradient><text x="20" y="100" fill="url(#g)" text-decoration="underline">AA</text>',
     draw(glyph("A", 20, 100), underline(20, 20 + A, 100), fill=GREEN)
     + draw(glyph("A", 20 + A, 100), underline(20 + A, 20 + 2 * A, 100), fill=RED), ' text-decoration="underline"')

MIDDLE, THICK = UNDERLINE * SIZE, UNDERLINE_SIZE * SIZE


def looks(name, about, style, bars, key):
    """Lines under AC by their left and right ends, middles below the baseline and thicknesses, user units."""
    case(f"decoration/{name}", about, f'<text x="20" y="100" style="{style}">AC</text>',
         draw(line("AC", 20, 100)) + draw(*(d if isinstance(d, str) else bar(d[0], d[1], 100, d[2], d[3], 1) for d in bars)),
         key)


def dot(left, radius):
    return f"M{left},{100 + MIDDLE} a{radius},{radius} 0 1 1 {2 * radius},0 a{radius},{radius} 0 1 1 {-2 * radius},0 Z"


RIGHT = 20 + A + C
looks("thickness", "text-decoration-thickness.", "text-decoration: underline; text-decoration-thickness: 8px",
      [(20, RIGHT, MIDDLE, 8)], "; text-decoration-thickness: 8px")
looks("thickness-percent", "Of the font size.", "text-decoration: underline 25%", [(20, RIGHT, MIDDLE, SIZE / 4)], " 25%")
looks("underline-offset", "text-underline-offset, from the baseline.",
      "text-decoration: underline; text-underline-offset: 16px", [(20, RIGHT, 16, THICK)], "; text-underline-offset: 16px")
looks("double", "The second line is outside, a line's thickness between them.", "text-decoration: underline double",
      [(20, RIGHT, MIDDLE, THICK), (20, RIGHT, MIDDLE + 2 * THICK, THICK)], " double")
looks("double-line-through", "On both sides of the middle.", "text-decoration: line-through double 3px",
      [(20, RIGHT, -STRIKE * SIZE - 3, 3), (20, RIGHT, -STRIKE * SIZE + 3, 3)], " double")
DASHES = [20 + 5 * THICK * i for i in range(20) if 5 * THICK * i < RIGHT - 20]
looks("dashed", "Dashes of three thicknesses, gaps of two.", "text-decoration-style: dashed; text-decoration-line: underline",
      [(x, min(x + 3 * THICK, RIGHT), MIDDLE, THICK) for x in DASHES], "text-decoration-style: dashed; ")
looks("dotted", "Round dots, a diameter between them.", "text-decoration: underline dotted 4px",
      [dot(20 + 8 * i, 2) for i in range(20) if 8 * i + 4 <= RIGHT - 20], " dotted")
