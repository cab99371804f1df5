"""x, y, dx, dy and rotate: SVG 2 sections 11.4.3 and 11.5."""
from layout import BOLD, RED, SIZE, TEST, WORLD, advances, draw, glyph, line, move, turn, width
from registry import case

A, B, C, D, E = (TEST.advance(n) * SIZE for n in "ABCDE")
BETWEEN = 'xml:space="default"'  # nothing; a key must not be empty


def single(names, *places, face=TEST, **how):
    return draw(*(glyph(n, x, y, face=face, **how) for n, (x, y) in zip(names, places)))


case("position/x-and-y", "A place for the start of the baseline.", '<text x="30" y="120">ACE</text>',
     draw(line("ACE", 30, 120)), 'x="30" ')
case("position/default", "Without x and y text starts at the origin.",
     '<g transform="translate(20 90)"><text>ACE</text></g>', draw(line("ACE", 20, 90)), "<text>", '<text x="9">')
case("position/x-list", "x: a place for each character, not in order.", '<text x="20 120 70" y="100">ACE</text>',
     single("ACE", (20, 100), (120, 100), (70, 100)), " 120 70")
case("position/x-list-short", "Characters behind the list follow the last one that is placed.",
     '<text x="20 80" y="100">ACED</text>', single("ACED", (20, 100), (80, 100), (80 + C, 100), (80 + C + E, 100)), " 80")
case("position/x-list-long", "Numbers without a character are not used.", '<text x="20 80 130 10" y="100">ACE</text>',
     single("ACE", (20, 100), (80, 100), (130, 100)), " 130")
case("position/y-list", "y: each character on a line of its own, x goes on.", '<text x="20" y="60 100 140">ACE</text>',
     single("ACE", (20, 60), (20 + A, 100), (20 + A + C, 140)), " 100 140")
case("position/x-and-y-lists", "Lists of different lengths.", '<text x="20 100" y="60 100 140">ACE</text>',
     single("ACE", (20, 60), (100, 100), (100 + C, 140)), " 100 140")
case("position/dx", "dx moves the first character, and with it those that follow.",
     '<text x="20" y="100" dx="15">ACE</text>', draw(line("ACE", 35, 100)), ' dx="15"')
case("position/dx-list", "dx: shifts add up.", '<text x="20" y="100" dx="0 20 -5">ACE</text>',
     single("ACE", (20, 100), (40 + A, 100), (35 + A + C, 100)), ' dx="[^"]*"')
case("position/dy", "dy of a tspan stays in force behind it.",
     '<text x="20" y="100">A<tspan dy="20">C</tspan>E</text>',
     single("ACE", (20, 100), (20 + A, 120), (20 + A + C, 120)), ' dy="20"')
case("position/dy-list", "dy: shifts add up.", '<text x="20" y="100" dy="0 30 -45">ACE</text>',
     single("ACE", (20, 100), (20 + A, 130), (20 + A + C, 85)), ' dy="[^"]*"')
case("position/x-with-dx", "dx comes on top of x.", '<text x="20 90" y="100" dx="5 10">AC</text>',
     single("AC", (25, 100), (100, 100)), ' dx="[^"]*"')
case("position/rotate", "rotate: one angle turns every character about its own origin.",
     '<text x="20" y="100" rotate="30">ACE</text>',
     single("ACE", (20, 100), (20 + A, 100), (20 + A + C, 100), rotate=30), ' rotate="30"')
case("position/rotate-list", "rotate: the last angle is that of all characters behind it.",
     '<text x="20" y="100" rotate="0 -20 45">ACED</text>',
     draw(glyph("A", 20, 100), glyph("C", 20 + A, 100, rotate=-20), glyph("E", 20 + A + C, 100, rotate=45),
          glyph("D", 20 + A + C + E, 100, rotate=45)), ' rotate="[^"]*"')
case("position/rotate-mark", "A letter is turned with its mark.",
     '<text font-family="VTM World" x="40" y="100" rotate="40">A\u0301</text>',
     draw(glyph("A", 40, 100, face=WORLD, rotate=40),
          glyph("acute", 0, 0, face=WORLD, frame=move(40, 100) @ turn(40) @ move(0.3 * SIZE, 0))), ' rotate="40"')
case("position/rotate-in-tspan", "rotate of a tspan wins over that of the text, which counts its characters.",
     '<text x="20" y="100" rotate="10 20 30 40">A<tspan rotate="-30">C</tspan>ED</text>',
     draw(glyph("A", 20, 100, rotate=10), glyph("C", 20 + A, 100, rotate=-30),
          glyph("E", 20 + A + C, 100, rotate=30), glyph("D", 20 + A + C + E, 100, rotate=40)), ' rotate="-30"')
case("position/rotate-with-dx", "rotate turns glyphs, not shifts.", '<text x="20" y="100" dx="0 10" rotate="90">AC</text>',
     single("AC", (20, 100), (30 + A, 100), rotate=90), ' rotate="90"')
case("position/list-over-tspan", "A list of the text counts characters of elements in it.",
     '<text x="20 60 110 150" y="100">A<tspan>CE</tspan>D</text>',
     single("ACED", (20, 100), (60, 100), (110, 100), (150, 100)), " 60 110 150")
case("position/tspan-list-wins", "A tspan's list replaces the text's for its characters.",
     '<text x="20 60 110 150" y="100">A<tspan x="70">CE</tspan>D</text>',
     single("ACED", (20, 100), (70, 100), (110, 100), (150, 100)), ' x="70"')
case("position/tspan-x-only", "x of a tspan leaves y where the line is.",
     '<text x="20" y="100" dy="7">A<tspan x="120">C</tspan></text>', single("AC", (20, 107), (120, 107)), ' x="120"')
case("position/spaces-not-counted", "White space that is removed has no place in a list.",
     '<text x="20 60 110" y="100">\n  A<tspan>\n  </tspan>C</text>', single("AC", (20, 100), (110, 100)), " 60 110")
case("position/space-counted", "A space that is kept has one.", '<text x="20 60 110" y="100">A C</text>',
     single("AC", (20, 100), (110, 100)), " 60 110")
case("position/kerning-not-across-x", "A character with an x of its own starts anew: no kerning with the one before.",
     f'<text x="20 {20 + A:g}" y="100">ABA</text>', single("ABA", (20, 100), (20 + A, 100), (20 + A + B + 4, 100)),
     f" {20 + A:g}")
case("position/kerning-across-tspan", "An element in the text does not stop kerning.",
     f'<text x="20" y="100">A<tspan fill="{RED}">B</tspan></text>',
     draw(glyph("A", 20, 100)) + draw(glyph("B", 12 + A, 100), fill=RED), "<tspan", '<tspan dx="8"')
case("position/mark-with-x", "x for a combining mark: it stays on its letter.",
     '<text font-family="VTM World" x="20 150 90" y="100">A\u0301A</text>',
     single(["A", "acute", "A"], (20, 100), (20 + 0.3 * SIZE, 100), (90, 100), face=WORLD), " 150 90")
case("position/mark-counts", "A combining mark has a place in lists, and its shift moves what follows.",
     '<text font-family="VTM World" x="20" y="100" dx="0 0 12">A\u0301A</text>',
     single(["A", "acute", "A"], (20, 100), (20 + 0.3 * SIZE, 100), (32 + A, 100), face=WORLD), ' dx="[^"]*"')
case("position/dx-in-ligature", "A shift of a letter inside a ligature moves what follows it.",
     '<text x="20" y="100" dx="0 20">fiA</text>', single(["f_i", "A"], (20, 100), (40 + 0.7 * SIZE, 100)), ' dx="0 20"')
case("position/em-and-percent", "Lengths with units.", '<text x="10%" y="2.5em" dx="0.5em" dy="1ex">AC</text>',
     draw(line("AC", 40, 120)), ' dy="1ex"')
case("position/commas", "Numbers parted by commas and spaces, with exponents.",
     '<text x="2e1,60 ,110" y="100">ACE</text>', single("ACE", (20, 100), (60, 100), (110, 100)), ",60 ,110")
case("position/negative", "Places left of and above the picture.",
     '<text x="-10" y="20">AC</text><text x="180 150" y="110">AC</text>',
     draw(line("AC", -10, 20), glyph("A", 180, 110), glyph("C", 150, 110)), " 150")
case("position/nested-lists", "Three levels of lists: the innermost that has a number wins.",
     '<text x="20 40 60 150" y="60"><tspan y="80 100">A<tspan y="140">C</tspan></tspan>ED</text>',
     single("ACED", (20, 80), (40, 140), (60, 140), (150, 140)), ' y="140"')
case("position/text-in-text-order", "Later text is painted over earlier text.",
     f'<text x="20" y="100">H<tspan x="25" y="105" fill="{RED}">H</tspan></text>',
     draw(glyph("H", 20, 100)) + draw(glyph("H", 25, 105), fill=RED), f' fill="{RED}"')
case("position/huge-list", "A list of a thousand numbers for three characters.",
     f'<text x="{" ".join(str(20 + 40 * i) for i in range(1000))}" y="100">ACE</text>',
     single("ACE", (20, 100), (60, 100), (100, 100)), "20 60 100 ", "20 60 120 ")
case("position/bold-in-between", "Each element's advances are those of its own font.",
     '<text x="10" y="100">A<tspan font-weight="bold" font-size="60">C</tspan>A</text>',
     draw(glyph("A", 10, 100), glyph("C", 10 + A, 100, size=60, face=BOLD),
          glyph("A", 10 + A + width("C", BOLD, size=60), 100)), ' font-size="60"')
assert sum(advances(["A", "C"])) == A + C
