"""Elements in and around text: SVG 2 sections 5, 11.2 and 16."""
from layout import BLUE, GREEN, RED, SIZE, TEST, draw, glyph, line
from registry import case

A, C, E = (TEST.advance(n) * SIZE for n in "ACE")

def inside(name, about, content, text, key, without="", before=""):
    case(f"structure/{name}", about, f'{before}<text x="20" y="100">{content}</text>', draw(line(text, 20, 100)), key,
         without)


case("structure/tspans", "tspans in each other, each with its paint.",
     f'<text x="20" y="100">A<tspan fill="{RED}">C<tspan fill="{GREEN}">E</tspan></tspan>A</text>',
     draw(glyph("A", 20, 100), glyph("A", 20 + A + C + E, 100)) + draw(glyph("C", 20 + A, 100), fill=RED)
     + draw(glyph("E", 20 + A + C, 100), fill=GREEN), f' fill="{GREEN}"')
case("structure/a", "A link in text is drawn like a tspan.",
     f'<text x="20" y="100">A<a href="x" fill="{RED}">C</a>E</text>',
     draw(glyph("A", 20, 100), glyph("E", 20 + A + C, 100)) + draw(glyph("C", 20 + A, 100), fill=RED), "(?<=<|/)a\\b", "q")
inside("tref", "tref: the characters of another element (SVG 1.1 section 10.6).", 'A<tref xlink:href="#t"/>', "ACE",
       "<tref[^>]*>", before='<defs><text id="t">C<tspan>E</tspan></text></defs>')
inside("tref-x", "A list that reaches into a tref.", 'A<tref xlink:href="#t" dx="0"/>', "ACE", "<tref[^>]*>",
       before='<defs><text id="t">CE</text></defs>')
inside("empty", "Empty elements leave nothing.", "A<tspan/><tspan></tspan>C", "AC", "<tspan/>", "E")
inside("display-none", "An element that is not displayed takes no room.", 'A<tspan display="none">D</tspan>C', "AC",
       ' display="none"')
case("structure/hidden", "One that is hidden does.", '<text x="20" y="100">A<tspan visibility="hidden">C</tspan>E</text>',
     draw(glyph("A", 20, 100), glyph("E", 20 + A + C, 100)), ' visibility="hidden"')
case("structure/visible-in-hidden", "A visible part of hidden text.",
     '<text x="20" y="100" visibility="hidden">A<tspan visibility="visible">C</tspan>E</text>',
     draw(glyph("C", 20 + A, 100)), ' visibility="hidden"')
inside("title-and-desc", "Titles and descriptions are not text.", "<title>D</title>A<desc>D</desc>C", "AC",
       "<desc>D</desc>", "D")
inside("unknown", "Unknown elements in text are not drawn.", "A<blink>D</blink>C", "AC", "<blink>D</blink>", "D")
inside("shape-in-text", "Nor are shapes.", 'A<rect width="100" height="100"/>C', "AC", "<rect[^>]*/>", "D")
inside("text-in-text", "Nor is text in text.", "A<text>D</text>C", "AC", "<text>D</text>", "D")
case("structure/switch-around", "switch: the first text whose conditions hold.",
     '<switch><text x="20" y="100" systemLanguage="xx">D</text><text x="20" y="100" systemLanguage="en">A</text>'
     '<text x="20" y="100">C</text></switch>', draw(line("A", 20, 100)), ' systemLanguage="xx"')
inside("conditions-of-tspan", "A tspan whose conditions do not hold is left out.",
       'A<tspan systemLanguage="xx">D</tspan>C', "AC", ' systemLanguage="xx"')
case("structure/use", "use of a text, moved.", '<defs><text id="t" x="20" y="60">AC</text></defs><use href="#t" y="50"/>',
     draw(line("AC", 20, 110)), ' y="50"')
case("structure/use-paint", "It inherits from use.",
     f'<defs><text id="t" x="20" y="60">AC</text></defs><use href="#t" fill="{RED}" font-size="60"/>',
     draw(line("AC", 20, 60, size=60), fill=RED), ' font-size="60"')
case("structure/symbol", "Text in a symbol with a viewBox.",
     '<symbol id="s" viewBox="0 0 100 100"><text x="10" y="50">A</text></symbol><use href="#s" width="200" height="200"/>',
     draw(line("A", 20, 100, size=80)), ' viewBox="[^"]*"')
case("structure/nested-svg", "Percentages are of the nested viewport.",
     '<svg x="20" y="20" width="160" height="100"><text x="25%" y="50%">AC</text></svg>', draw(line("AC", 60, 70)),
     ' height="100"')
case("structure/clip", "Text as a clip: overlapping letters are one shape.",
     f'<clipPath id="c"><text x="20" y="100" letter-spacing="-12">ACE</text></clipPath>'
     f'<rect width="200" height="200" fill="{RED}" clip-path="url(#c)"/>',
     draw(line("ACE", 20, 100, spacing=-12), fill=RED), ' letter-spacing="-12"')
case("structure/clip-decorated", "Lines of decoration are part of the clip.",
     f'<clipPath id="c"><text x="20" y="100" text-decoration="underline">H</text></clipPath>'
     f'<rect width="200" height="200" fill="{RED}" clip-path="url(#c)"/>',
     draw(glyph("H", 20, 100), "M20,103.2 H48 V106.4 H20 Z", fill=RED), ' text-decoration="underline"')
case("structure/mask", "Text in a mask.",
     f'<mask id="m" maskUnits="userSpaceOnUse" x="0" y="0" width="200" height="200"><text x="20" y="100" fill="white">AC'
     f'</text></mask><rect width="200" height="200" fill="{RED}" mask="url(#m)"/>',
     draw(line("AC", 20, 100), fill=RED), ">AC", ">A")
case("structure/pattern", "Text in a pattern.",
     '<pattern id="p" width="50" height="50" patternUnits="userSpaceOnUse"><text x="5" y="40">A</text></pattern>'
     '<rect width="100" height="100" fill="url(#p)"/>',
     draw(*(glyph("A", x, y) for x in (5, 55) for y in (40, 90))), ">A<", ">C<")
case("structure/marker", "Text in a marker.",
     '<marker id="m" overflow="visible" markerUnits="userSpaceOnUse"><text font-size="40">A</text></marker>'
     '<path d="M 40,100 H 90" marker-start="url(#m)" marker-end="url(#m)"/>',
     draw(glyph("A", 40, 100), glyph("A", 90, 100)), ' marker-end="[^"]*"')
case("structure/style-sheet", "Properties of a style sheet, by class and descendant.",
     f'<style>.big {{ font-size: 60px }} text tspan {{ fill: {RED} }}</style>'
     '<text x="20" y="100" class="big">A<tspan>C</tspan></text>',
     draw(glyph("A", 20, 100, size=60)) + draw(glyph("C", 20 + 1.5 * A, 100, size=60), fill=RED), ' class="big"')
case("structure/no-characters", "Text without characters beside text with some.",
     f'<text/><text x="20" y="50">  </text><text x="20" y="50"><tspan/></text><text x="20" y="100">A</text>',
     draw(glyph("A", 20, 100)), "<text/>", "<text y='60'>C</text>")
case("structure/deep", "A hundred elements in each other.",
     f'<text x="20" y="100">A{"<tspan>" * 100}C{"</tspan>" * 100}E</text>', draw(line("ACE", 20, 100)), ">C<", ">A<")
case("structure/opacity-of-tspan", "opacity is of the whole text: none of its elements has a group of its own.",
     '<text x="20" y="100" letter-spacing="-14" opacity="0.5">HHH</text>',
     draw(line("HHH", 20, 100, spacing=-14), opacity="0.5"), ' opacity="0.5"')
