"""writing-mode, text-orientation, glyph-orientation-vertical: CSS Writing Modes 4 section 3, SVG 2 section 11.7.

The line is the central baseline. Upright glyphs of VTM World hang from their vertical origin, 0.8 em above the
baseline in the middle of the advance, and advance by an em; a sideways glyph is turned clockwise, its central line,
(ascent - descent) / 2 above the alphabetic baseline, on the line.
"""
from layout import RED, SIZE, UNDERLINE_SIZE, WORLD, draw, glyph, move, rectangle, turn
from registry import case

ONE, TWO, COMMA = "\u4e00", "\u4e8c", "\u3001"
FONT = 'font-family="VTM World"'
ORIGIN, CENTRAL = 0.8, 0.3


def upright(name, x, y, **how):
    return glyph(name, x - WORLD.advance(name) / 2 * SIZE, y + ORIGIN * SIZE, face=WORLD, **how)


def sideways(name, x, y):
    return glyph(name, 0, 0, face=WORLD, frame=move(x - CENTRAL * SIZE, y) @ turn(90))


def column(name, about, attributes, content, outlines, key, without=""):
    case(f"vertical/{name}", about, f'<text x="100" y="20" {FONT}{attributes}>{content}</text>', draw(*outlines), key,
         without)


TWO_UPRIGHT = [upright("one.cjk", 100, 20), upright("two.cjk", 100, 60)]
for mode in ("vertical-rl", "vertical-lr", "tb", "tb-rl"):
    column(mode, f"{mode}: from top to bottom.", f' writing-mode="{mode}"', ONE + TWO, TWO_UPRIGHT,
           f' writing-mode="{mode}"')
for mode in ("horizontal-tb", "lr", "lr-tb"):
    case(f"vertical/{mode}", f"{mode} takes it back.",
         f'<g writing-mode="tb"><text x="20" y="100" {FONT} writing-mode="{mode}">{ONE}{TWO}</text></g>',
         draw(glyph("one.cjk", 20, 100, face=WORLD), glyph("two.cjk", 60, 100, face=WORLD)), f' writing-mode="{mode}"')
V = ' writing-mode="vertical-rl"'
column("mixed", "Latin letters lie on their side.", V, f"{ONE}AA{TWO}",
       [upright("one.cjk", 100, 20), sideways("A", 100, 60), sideways("A", 100, 84), upright("two.cjk", 100, 108)], V)
column("alternate-glyph", "Punctuation has its own vertical form.", V, f"{COMMA}{ONE}",
       [upright("comma.vert", 100, 20), upright("one.cjk", 100, 60)], f"{COMMA}", ONE)
column("upright", "text-orientation: upright.", V + ' style="text-orientation: upright"', f"A{ONE}",
       [upright("A", 100, 20), upright("one.cjk", 100, 60)], ' style="[^"]*"')
column("sideways", "text-orientation: sideways.", V + ' style="text-orientation: sideways"', f"A{ONE}",
       [sideways("A", 100, 20), sideways("one.cjk", 100, 44)], ' style="[^"]*"')
column("orientation-of-tspan", "text-orientation of a part.", V, f'A<tspan style="text-orientation: upright">A</tspan>',
       [sideways("A", 100, 20), upright("A", 100, 44)], ' style="[^"]*"')
column("glyph-orientation-0", "SVG 1.1's glyph-orientation-vertical: 0 is upright.",
       V + ' glyph-orientation-vertical="0"', f"A{ONE}", [upright("A", 100, 20), upright("one.cjk", 100, 60)],
       ' glyph-orientation-vertical="0"')
column("glyph-orientation-90", "90deg is sideways.", V + ' glyph-orientation-vertical="90deg"', f"{ONE}A",
       [sideways("one.cjk", 100, 20), sideways("A", 100, 60)], ' glyph-orientation-vertical="90deg"')
column("glyph-orientation-auto", "auto is mixed.", V + ' glyph-orientation-vertical="auto"', f"{ONE}A",
       [upright("one.cjk", 100, 20), sideways("A", 100, 60)], '"auto"', '"90"')
case("vertical/anchor-middle", "text-anchor works along the line.",
     f'<text x="100" y="100" {FONT}{V} text-anchor="middle">{ONE}{TWO}</text>',
     draw(upright("one.cjk", 100, 60), upright("two.cjk", 100, 100)), ' text-anchor="middle"')
case("vertical/anchor-end", "end.", f'<text x="100" y="180" {FONT}{V} text-anchor="end">{ONE}A</text>',
     draw(upright("one.cjk", 100, 116), sideways("A", 100, 156)), ' text-anchor="end"')
column("baseline-shift", "Up is right.", V, f'{ONE}<tspan baseline-shift="12">{TWO}</tspan>',
       [upright("one.cjk", 100, 20), upright("two.cjk", 112, 60)], ' baseline-shift="12"')
column("letter-spacing", "letter-spacing goes down.", V + ' letter-spacing="15"', ONE + TWO,
       [upright("one.cjk", 100, 20), upright("two.cjk", 100, 75)], ' letter-spacing="15"')
column("dx-dy", "dx and dy are x and y still.", V + ' dx="0 30" dy="10 5"', ONE + TWO,
       [upright("one.cjk", 100, 30), upright("two.cjk", 130, 75)], ' dx="0 30"')
column("x-list", "x for the second character: a chunk that goes on downwards.", V, f'{ONE}<tspan x="40">{TWO}</tspan>',
       [upright("one.cjk", 100, 20), upright("two.cjk", 40, 60)], ' x="40"')
column("length", "textLength goes down.", V + ' textLength="140"', ONE + TWO,
       [upright("one.cjk", 100, 20), upright("two.cjk", 100, 120)], ' textLength="140"')
column("rotate", "rotate turns upright glyphs about their place on the line.", V + ' rotate="30"', ONE,
       [glyph("one.cjk", 0, 0, face=WORLD,
              frame=move(100, 20) @ turn(30) @ move(-SIZE / 2, ORIGIN * SIZE))], ' rotate="30"')
case("vertical/colours", "Fills of parts.", f'<text x="100" y="20" {FONT}{V}>{ONE}<tspan fill="{RED}">A</tspan></text>',
     draw(upright("one.cjk", 100, 20)) + draw(sideways("A", 100, 60), fill=RED), f' fill="{RED}"')

EDGE, HALF = 0.5 * SIZE, UNDERLINE_SIZE / 2 * SIZE  # half of ascent and descent
for word, x in (("underline", 100 - EDGE), ("overline", 100 + EDGE)):
    column(word, f"{word} on the {'left' if x < 100 else 'right'} edge of the glyphs.",
           f'{V} text-decoration="{word}"', f"{ONE}A",
           [upright("one.cjk", 100, 20), sideways("A", 100, 60), rectangle(x - HALF, 20, x + HALF, 84)],
           f' text-decoration="{word}"')
