"""White space: SVG 2 section 11.4.1, CSS Text 3 section 4, xml:space."""
from layout import RED, SIZE, TEST, draw, glyph, line
from registry import case

A, C, SPACE = (TEST.advance(n) * SIZE for n in ("A", "C", "space"))

def plain(name, about, content, text, key, without, attributes=""):
    case(f"whitespace/{name}", about, f'<text x="20" y="100"{attributes}>{content}</text>', draw(line(text, 20, 100)),
         key, without)


plain("collapse", "Spaces become one.", "A    C", "A C", "A    C", "AC")
plain("trim", "None at the ends.", "   A C   ", "A C", "   A", "\u00a0A")
plain("newline", "An end of line is a space.", "A\nC", "A C", "A\nC", "AC")
plain("indented", "So is it with spaces around.", "\n   A\n\t C\n", "A C", "A\n", "A\n\u00a0")
plain("tab", "A tab is a space.", "A\tC", "A C", "\t", "")
plain("no-break", "No-break spaces stay.", "\u00a0A\u00a0\u00a0C", "\u00a0A\u00a0\u00a0C", "\u00a0\u00a0", "  ")
plain("across-tspans", "Spaces of two elements become one, that of the first.", "A <tspan> C</tspan>", "A C", "A <tspan> ", "A<tspan>")
plain("only-in-tspan", "An element of spaces is a space.", "A<tspan> </tspan>C", "A C", "<tspan> ", "<tspan>")
case("whitespace/trim-in-tspan", "The text's last space is removed inside an element, too.",
     '<text x="180" y="100" text-anchor="end">A<tspan>C </tspan> <tspan> </tspan></text>',
     draw(line("AC", 180 - A - C, 100)), "C ", "C\u00a0")
plain("preserve", "xml:space=\"preserve\" keeps all.", "  A   C", "  A   C", ' xml:space="preserve"', "",
      ' xml:space="preserve"')
plain("preserve-newline", "Ends of lines and tabs are spaces then.", "A\n\t C", "A   C", ' xml:space="preserve"', "",
      ' xml:space="preserve"')
plain("preserve-in-tspan", "For a tspan only.", 'A<tspan xml:space="preserve">  C</tspan>', "A  C",
      ' xml:space="preserve"', "")
plain("default-in-tspan", "Taken back in a tspan.", 'A  <tspan xml:space="default">C  D </tspan>', "A  C D",
      ' xml:space="default"', "", ' xml:space="preserve"')
plain("pre", "white-space: pre keeps all.", "  A   C", "  A   C", ' style="white-space: pre"', "",
      ' style="white-space: pre"')
plain("pre-wins", "white-space wins over xml:space.", "  A   C", "A C", ' style="white-space: normal"', "",
      ' xml:space="preserve" style="white-space: normal"')
plain("nowrap", "white-space: nowrap collapses.", "A   C", "A C", "nowrap", "pre", ' style="white-space: nowrap"')
case("whitespace/preserve-inherited", "xml:space from a group.",
     '<g xml:space="preserve"><text x="20" y="100">A  C</text></g>', draw(line("A  C", 20, 100)),
     ' xml:space="preserve"')
case("whitespace/around-hidden", "An element that is not displayed leaves the spaces around it to become one.",
     '<text x="20" y="100">A <tspan display="none">D</tspan> C</text>', draw(line("A C", 20, 100)),
     ' display="none"')
case("whitespace/entity", "Character references and CDATA sections are text.",
     '<text x="20" y="100">&#65;<![CDATA[C]]>&#x45;</text>', draw(line("ACE", 20, 100)), "&#x45;")
case("whitespace/comment", "Comments and processing instructions are not.",
     f'<text x="20" y="100">A<!-- D -->C<?p D?><tspan fill="{RED}">A</tspan></text>',
     draw(line("AC", 20, 100)) + draw(glyph("A", 20 + A + C, 100), fill=RED), "<!-- D -->", "D")
case("whitespace/pre-lines", "white-space: pre breaks lines, as high as ascent and descent (SVG 2 section 11.6.1).",
     '<text x="20" y="60" style="white-space: pre">A\nC</text>', draw(glyph("A", 20, 60), glyph("C", 20, 100)), "\n", " ")
assert SPACE == 12
