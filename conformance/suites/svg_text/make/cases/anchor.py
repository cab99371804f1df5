"""text-anchor: SVG 2 section 11.10.2."""
from layout import RED, SIZE, TEST, WORLD, draw, glyph, line, width
from registry import case

A, C, E = (TEST.advance(n) * SIZE for n in "ACE")

case("anchor/start", "start: the same as without.", '<text x="60" y="100" text-anchor="start">ACE</text>',
     draw(line("ACE", 60, 100)), '"start"', '"end"')
case("anchor/middle", "middle.", '<text x="100" y="100" text-anchor="middle">ACE</text>',
     draw(line("ACE", 100 - width("ACE") / 2, 100)), ' text-anchor="middle"')
case("anchor/end", "end.", '<text x="180" y="100" text-anchor="end">ACE</text>',
     draw(line("ACE", 180 - width("ACE"), 100)), ' text-anchor="end"')
case("anchor/inherited", "From a group.", '<g text-anchor="end"><text x="180" y="100">ACE</text></g>',
     draw(line("ACE", 180 - width("ACE"), 100)), ' text-anchor="end"')
case("anchor/with-kerning", "Kerning counts.", '<text x="100" y="100" text-anchor="middle">ABAB</text>',
     draw(line("ABAB", 100 - width("ABAB") / 2, 100)), ' text-anchor="middle"')
case("anchor/chunks", "Every x starts a chunk, which is aligned by itself.",
     '<text x="100" y="80" text-anchor="middle">ACE<tspan x="100" y="140">AC</tspan></text>',
     draw(line("ACE", 100 - width("ACE") / 2, 80), line("AC", 100 - width("AC") / 2, 140)), ' text-anchor="middle"')
case("anchor/of-tspan", "A chunk is aligned as its first character says.",
     '<text x="100" y="80">ACE<tspan x="180" y="140" text-anchor="end">AC</tspan></text>',
     draw(line("ACE", 100, 80), line("AC", 180 - width("AC"), 140)), ' text-anchor="end"')
case("anchor/of-tspan-inside", "A tspan without x starts no chunk, so that its text-anchor is not used.",
     '<text x="60" y="100">A<tspan text-anchor="end">CE</tspan></text>', draw(line("ACE", 60, 100)), "<tspan",
     '<tspan x="100"')
case("anchor/dx", "Shifts inside a chunk count in its length.",
     '<text x="100" y="100" dx="0 20" text-anchor="middle">AC</text>',
     draw(glyph("A", 100 - (A + 20 + C) / 2, 100), glyph("C", 100 - (A + 20 + C) / 2 + A + 20, 100)), ' text-anchor="middle"')
case("anchor/dx-first", "A shift of the first character moves the chunk.",
     '<text x="100" y="100" dx="20" text-anchor="middle">AC</text>', draw(line("AC", 120 - (A + C) / 2, 100)),
     ' dx="20"')
case("anchor/x-list", "One character a chunk.", '<text x="60 120" y="100" text-anchor="middle">AC</text>',
     draw(glyph("A", 60 - A / 2, 100), glyph("C", 120 - C / 2, 100)), " 120")
case("anchor/trailing-space", "A space at the end is removed and does not count.",
     '<text x="180" y="100" text-anchor="end">AC </text>', draw(line("AC", 180 - A - C, 100)), "AC ", "AC\u00a0")
case("anchor/preserved-space", "A preserved one counts.",
     '<text x="180" y="100" text-anchor="end" xml:space="preserve">AC </text>', draw(line("AC", 168 - A - C, 100)),
     ' xml:space="preserve"')
case("anchor/letter-spacing", "Letter-spacing between characters counts, there is none behind the last.",
     '<text x="180" y="100" text-anchor="end" letter-spacing="10">ACE</text>',
     draw(line("ACE", 160 - width("ACE"), 100, spacing=10)), ' letter-spacing="10"')
case("anchor/right-to-left-start", "start of right-to-left text is its right end.",
     '<text x="150" y="100" direction="rtl" font-family="VTM World">\u05d0\u05d1</text>',
     draw(line(["bet", "alef"], 150 - width(["bet", "alef"], WORLD), 100, WORLD)), ' direction="rtl"')
case("anchor/right-to-left-end", "end is its left end.",
     '<text x="50" y="100" direction="rtl" text-anchor="end" font-family="VTM World">\u05d0\u05d1</text>',
     draw(line(["bet", "alef"], 50, 100, WORLD)), ' text-anchor="end"')
case("anchor/two-fonts", "All elements of a chunk count.",
     f'<text x="190" y="100" text-anchor="end">A<tspan font-size="60" fill="{RED}">C</tspan>E</text>',
     draw(glyph("A", 190 - A - C * 1.5 - E, 100), glyph("E", 190 - E, 100))
     + draw(glyph("C", 190 - E - 1.5 * C, 100, size=60), fill=RED), ' font-size="60"')
case("anchor/y-only", "A chunk that begins with a y alone is aligned about the place where the line had come to.",
     '<text x="100" y="60" text-anchor="end">AC<tspan y="120">E</tspan></text>',
     draw(line("AC", 100 - A - C, 60), glyph("E", 100 + A + C - E, 120)), ' text-anchor="end"')
case("anchor/invalid", "An unknown word is as if it were not there.",
     '<text x="60" y="100" text-anchor="center">ACE</text>', draw(line("ACE", 60, 100)), '"center"', '"middle"')
