"""textLength and lengthAdjust: SVG 2 section 11.5."""
from layout import RED, SIZE, TEST, WORLD, draw, glyph, line, width
from registry import case

A, C, E = (TEST.advance(n) * SIZE for n in "ACE")
SUM = A + C + E

def spread(text, x, y, length, **how):
    """Advances with the same space between all glyphs."""
    return line(text, x, y, spacing=(length - width(text, **how)) / (len(text) - 1), **how)


case("length/wider", "spacing: the room is between characters.", '<text x="20" y="100" textLength="150">ACE</text>',
     draw(spread("ACE", 20, 100, 150)), ' textLength="150"')
case("length/narrower", "Less room than the characters take.", '<text x="20" y="100" textLength="50">ACE</text>',
     draw(spread("ACE", 20, 100, 50)), ' textLength="50"')
case("length/glyphs", "spacingAndGlyphs stretches all.",
     '<text x="20" y="100" textLength="150" lengthAdjust="spacingAndGlyphs">ACE</text>',
     draw(*(glyph(n, 20 + at * 150 / SUM, 100, stretch=150 / SUM) for n, at in (("A", 0), ("C", A), ("E", A + C)))),
     ' lengthAdjust="spacingAndGlyphs"')
case("length/glyphs-narrower", "spacingAndGlyphs, to half.",
     f'<text x="20" y="100" textLength="{SUM / 2:g}" lengthAdjust="spacingAndGlyphs">ACE</text>',
     draw(*(glyph(n, 20 + at / 2, 100, stretch=0.5) for n, at in (("A", 0), ("C", A), ("E", A + C)))),
     ' lengthAdjust="spacingAndGlyphs"')
case("length/spaces", "Spaces are characters like others.", '<text x="20" y="100" textLength="160">A C</text>',
     draw(spread("A C", 20, 100, 160)), ' textLength="160"')
case("length/kerning", "Kerning stays.", '<text x="20" y="100" textLength="150">ABA</text>',
     draw(spread("ABA", 20, 100, 150)), ' textLength="150"')
case("length/middle", "text-anchor sees the new length.",
     '<text x="100" y="100" textLength="160" text-anchor="middle">ACE</text>', draw(spread("ACE", 20, 100, 160)),
     ' text-anchor="middle"')
case("length/end", "text-anchor: end.", '<text x="180" y="100" textLength="160" text-anchor="end">ACE</text>',
     draw(spread("ACE", 20, 100, 160)), ' text-anchor="end"')
case("length/of-tspan", "Of a tspan; what follows it moves.",
     f'<text x="10" y="100">A<tspan textLength="80" fill="{RED}">CE</tspan>A</text>',
     draw(glyph("A", 10, 100), glyph("A", 90 + A, 100)) + draw(spread("CE", 10 + A, 100, 80), fill=RED),
     ' textLength="80"')
case("length/nested", "A tspan with a length of its own is one unit in that of the text.",
     '<text x="10" y="100" textLength="180">A<tspan textLength="70">CE</tspan>A</text>',
     draw(glyph("A", 10, 100), spread("CE", 10 + A + (180 - 2 * A - 70) / 2, 100, 70), glyph("A", 190 - A, 100)),
     ' textLength="180"')
case("length/glyphs-of-tspan", "spacingAndGlyphs of a tspan; what follows it moves.",
     '<text x="10" y="100">A<tspan textLength="92" lengthAdjust="spacingAndGlyphs">CE</tspan>A</text>',
     draw(glyph("A", 10, 100), glyph("C", 34, 100, stretch=2), glyph("E", 34 + 2 * C, 100, stretch=2),
          glyph("A", 34 + 92, 100)), ' lengthAdjust="spacingAndGlyphs"')
case("length/on-path", "Along a path.",
     '<defs><path id="p" d="M 20,100 H 190"/></defs><text textLength="150"><textPath href="#p">ACE</textPath></text>',
     draw(spread("ACE", 20, 100, 150)), ' textLength="150"')
case("length/percent", "Of the viewport.", '<text x="20" y="100" textLength="75%">ACE</text>',
     draw(spread("ACE", 20, 100, 150)), ' textLength="75%"')
case("length/negative", "An error: not used.", '<text x="20" y="100" textLength="-150">ACE</text>',
     draw(line("ACE", 20, 100)), '"-150"', '"150"')
case("length/one-character", "There is nothing to put the room into.", '<text x="20" y="100" textLength="150">C</text>',
     draw(glyph("C", 20, 100)), 'textLength="150"', 'textLength="150" lengthAdjust="spacingAndGlyphs"')
case("length/with-letter-spacing", "Added to letter-spacing.",
     '<text x="20" y="100" textLength="150" letter-spacing="10">ACE</text>',
     draw(spread("ACE", 20, 100, 150)), ' textLength="150"')
case("length/right-to-left", "The start, at the right, stays.",
     '<text x="180" y="100" direction="rtl" font-family="VTM World" textLength="150">\u05d0\u05d1\u05d2</text>',
     draw(line(["gimel", "bet", "alef"], 30, 100, WORLD,
               spacing=(150 - width(["gimel", "bet", "alef"], WORLD)) / 2)), ' textLength="150"')
case("length/stretched-stroke", "spacingAndGlyphs: the outline is stretched, not its stroke.",
     f'<text x="20" y="100" textLength="{2 * A:g}" lengthAdjust="spacingAndGlyphs" fill="none" stroke="{RED}" '
     'stroke-width="4">A</text>',
     draw(glyph("A", 20, 100, stretch=2), fill="none", stroke=RED, stroke_width=4), ' lengthAdjust="spacingAndGlyphs"')
