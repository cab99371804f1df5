"""letter-spacing and word-spacing: CSS Text 3 section 8; kerning."""
from layout import RED, SIZE, TEST, WORLD, draw, glyph, line
from registry import case

A, C, E, I = (TEST.advance(n) * SIZE for n in "ACEi")

case("spacing/letter", "After each character.", '<text x="20" y="100" letter-spacing="12">ACE</text>',
     draw(line("ACE", 20, 100, spacing=12)), ' letter-spacing="12"')
case("spacing/letter-negative", "Letters overlap.", '<text x="20" y="100" letter-spacing="-8">ACE</text>',
     draw(line("ACE", 20, 100, spacing=-8)), ' letter-spacing="-8"')
case("spacing/letter-em", "In ems of the element.",
     '<g letter-spacing="0.5em" font-size="20"><text x="20" y="100" font-size="40">ACE</text></g>',
     draw(line("ACE", 20, 100, spacing=10)), ' letter-spacing="0.5em"')
case("spacing/letter-normal", "normal takes it back.",
     '<g letter-spacing="10"><text x="20" y="100" letter-spacing="normal">ACE</text></g>',
     draw(line("ACE", 20, 100)), ' letter-spacing="normal"')
case("spacing/letter-in-tspan", "The space behind a character is that of its own element.",
     '<text x="20" y="100">A<tspan letter-spacing="15">CE</tspan>A</text>',
     draw(line("ACEA"[:2], 20, 100), glyph("E", 35 + A + C, 100), glyph("A", 50 + A + C + E, 100)),
     ' letter-spacing="15"')
case("spacing/letter-no-ligature", "Spaced letters form no ligature (CSS Text 3 section 8.2).",
     '<text x="20" y="100" letter-spacing="6">fi</text>', draw(line("fi", 20, 100, spacing=6)), ' letter-spacing="6"')
case("spacing/ligature", "Without spacing they do.", '<text x="20" y="100">fiA</text>',
     draw(line(["f_i", "A"], 20, 100)), "fiA", "f\u200ciA")
case("spacing/letter-keeps-kerning", "Kerning is added.", '<text x="20" y="100" letter-spacing="10">ABA</text>',
     draw(line("ABA", 20, 100, spacing=10)), ' letter-spacing="10"')
case("spacing/letter-on-mark", "None between a letter and its mark.",
     '<text x="20" y="100" font-family="VTM World" letter-spacing="15">A\u0301A</text>',
     draw(glyph("A", 20, 100, face=WORLD), glyph("acute", 20 + 0.3 * SIZE, 100, face=WORLD),
          glyph("A", 35 + A, 100, face=WORLD)), ' letter-spacing="15"')
case("spacing/letter-with-dx", "Beside shifts.", '<text x="20" y="100" letter-spacing="5" dx="0 10">ACE</text>',
     draw(glyph("A", 20, 100), glyph("C", 35 + A, 100), glyph("E", 40 + A + C, 100)), ' letter-spacing="5"')
case("spacing/letter-with-spaces", "A space is a character, too.",
     '<text x="20" y="100" letter-spacing="10">A C</text>', draw(line("A C", 20, 100, spacing=10)),
     ' letter-spacing="10"')
case("spacing/word", "Behind each space.", '<text x="20" y="100" word-spacing="20">A C E</text>',
     draw(line("A C E", 20, 100, words=20)), ' word-spacing="20"')
case("spacing/word-negative", "Words move together.", '<text x="20" y="100" word-spacing="-10">A C E</text>',
     draw(line("A C E", 20, 100, words=-10)), ' word-spacing="-10"')
case("spacing/word-no-break-space", "A no-break space parts words, too.",
     '<text x="20" y="100" word-spacing="20">A\u00a0C</text>', draw(line("A\u00a0C", 20, 100, words=20)),
     ' word-spacing="20"')
case("spacing/word-collapsed", "White space that is one space counts once.",
     '<text x="20" y="100" word-spacing="20">A   \n C</text>', draw(line("A C", 20, 100, words=20)),
     ' word-spacing="20"')
case("spacing/word-preserved", "Each preserved space counts.",
     '<text x="20" y="100" word-spacing="10" xml:space="preserve">A  C</text>',
     draw(line("A  C", 20, 100, words=10)), ' word-spacing="10"')
case("spacing/word-and-letter", "Both.", '<text x="10" y="100" word-spacing="15" letter-spacing="6">A C E</text>',
     draw(line("A C E", 10, 100, words=15, spacing=6)), ' word-spacing="15"')
case("spacing/word-percent", "A share of the font size (CSS Text 4 section 9.1).",
     '<text x="20" y="100" word-spacing="50%">A C</text>', draw(line("A C", 20, 100, words=20)),
     ' word-spacing="50%"')
case("spacing/letter-percent", "A share of the font size (CSS Text 4 section 9.2).",
     '<text x="20" y="100" letter-spacing="25%">ACE</text>', draw(line("ACE", 20, 100, spacing=10)),
     ' letter-spacing="25%"')
case("spacing/kerning", "Pairs of the font's table GPOS.", '<text x="20" y="100">ABAB</text>',
     draw(line("ABAB", 20, 100)), ">ABAB", ' style="font-kerning: none">ABAB')
case("spacing/kerning-none", "font-kerning: none.", '<text x="20" y="100" style="font-kerning: none">ABAB</text>',
     draw(line("ABAB", 20, 100, kern=False)), ' style="font-kerning: none"')
case("spacing/kerning-not-between-sizes", "Two font sizes share no pair.",
     f'<text x="20" y="100">A<tspan font-size="20" fill="{RED}">B</tspan></text>',
     draw(glyph("A", 20, 100)) + draw(glyph("B", 20 + A, 100, size=20), fill=RED), ' font-size="20"')
case("spacing/letter-before-y", "The space behind a character stays where a y follows: the line does not end there.",
     '<text x="20" y="60" letter-spacing="15">A<tspan y="120">C</tspan></text>',
     draw(glyph("A", 20, 60), glyph("C", 35 + A, 120)), ' letter-spacing="15"')
case("spacing/letter-right-to-left", "In right-to-left text it is left of each character.",
     '<text x="150" y="100" direction="rtl" font-family="VTM World" letter-spacing="15">\u05d0\u05d1\u05d2</text>',
     draw(line(["gimel", "bet", "alef"], 120 - 1.55 * SIZE, 100, WORLD, spacing=15)), ' letter-spacing="15"')
case("spacing/letter-mixed", "Between letters of two directions, too.",
     '<text x="20" y="100" font-family="VTM World" letter-spacing="10">A\u05d0\u05d1A</text>',
     draw(line(["A", "bet", "alef", "A"], 20, 100, WORLD, spacing=10)), ' letter-spacing="10"')
case("spacing/cursive", "Joined Arabic letters are not torn apart (CSS Text 3 section 8.2.1).",
     '<text x="150" y="100" direction="rtl" font-family="VTM World" letter-spacing="20">\u0628\u0628\u0627</text>',
     draw(line(["alefar.fina", "beh.medi", "beh.init"], 150 - 1.15 * SIZE, 100, WORLD)), "\u0628\u0628", "\u0628")
