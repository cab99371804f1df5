"""font-variant and font-feature-settings: CSS Fonts 4 sections 6 and 7; languages."""
from layout import CUBIC, SIZE, TEST, draw, glyph, line
from registry import case


def shown(name, about, style, text, names, key="", without="", attributes="", kern=True):
    case(f"variants/{name}", about, f'<text x="20" y="100"{attributes} style="{style}">{text}</text>',
         draw(line(names, 20, 100, kern=kern)), key or style, without)


shown("small-caps", "small-caps.", "font-variant: small-caps", "aAb", ["a.small", "A", "b.small"])
shown("small-caps-long", "font-variant-caps.", "font-variant-caps: small-caps", "aAb", ["a.small", "A", "b.small"])
shown("all-small-caps", "all-small-caps.", "font-variant-caps: all-small-caps", "aAB", ["a.small", "a.small", "b.small"])
shown("attribute", "font-variant as a presentation attribute.", "fill-opacity: 1", "ab", ["a.small", "b.small"],
      ' font-variant="small-caps"', attributes=' font-variant="small-caps"')
shown("old-style", "oldstyle-nums.", "font-variant-numeric: oldstyle-nums", "010", ["zero.old", "one.old", "zero.old"])
shown("slashed-zero", "slashed-zero.", "font-variant-numeric: slashed-zero", "010", ["zero.slash", "one", "zero.slash"])
shown("super", "font-variant-position: super.", "font-variant-position: super", "1A1", ["one.sup", "A", "one.sup"])
shown("sub", "font-variant-position: sub.", "font-variant-position: sub", "1A1", ["one.sub", "A", "one.sub"])
shown("no-ligatures", "font-variant-ligatures: none.", "font-variant-ligatures: none", "fi", "fi")
shown("no-common-ligatures", "no-common-ligatures.", "font-variant-ligatures: no-common-ligatures", "fi", "fi")
shown("discretionary", "discretionary-ligatures.", "font-variant-ligatures: discretionary-ligatures", "ab", ["a_b"])
shown("none", "font-variant: none is without ligatures.", "font-variant: none", "fi", "fi")
shown("shorthand", "font-variant with words of several groups.", "font-variant: small-caps slashed-zero", "a0",
      ["a.small", "zero.slash"])
shown("normal", "normal takes all back.", "font-variant: small-caps; font-variant: normal", "ab", "ab",
      " font-variant: normal")
shown("font-resets", "font resets them.", "font-variant: small-caps; font: 40px VTM Test", "ab", "ab",
      " font: 40px VTM Test")
shown("font-small-caps", "small-caps in font.", "font: small-caps 40px VTM Test", "ab", ["a.small", "b.small"])
shown("feature", "font-feature-settings.", "font-feature-settings: 'ss01'", "AC", ["A.style", "C"])
shown("feature-off", "A feature switched off.", "font-feature-settings: 'kern' off", "ABA", "ABA", kern=False)
shown("feature-value", "1 and 0.", "font-feature-settings: 'ss01' 1, 'liga' 0", "Afi", ["A.style", "f", "i"])
shown("feature-wins", "Features win over font-variant.", "font-variant: small-caps; font-feature-settings: 'smcp' 0",
      "ab", "ab", " font-feature-settings: 'smcp' 0")
shown("feature-of-part", "Ligatures of a part only.", "fill-opacity: 1",
      "<tspan style=\"font-feature-settings: 'liga' 0\">fi</tspan> fi", ["f", "i", "space", "f_i"],
      " style=\"font-feature-settings: 'liga' 0\"")
shown("language", "Forms of a language, by xml:lang.", "fill-opacity: 1", "iA", ["i.turkish", "A"], ' xml:lang="tr"',
      attributes=' xml:lang="tr"')
shown("language-lang", "By lang, with a region.", "fill-opacity: 1", "iA", ["i.turkish", "A"], ' lang="tr-TR"',
      attributes=' lang="tr-TR"')
shown("language-of-part", "Of a part.", "fill-opacity: 1", 'i<tspan xml:lang="tr">i</tspan>', ["i", "i.turkish"],
      ' xml:lang="tr"')
shown("ligature-across-tspans", "An element that changes nothing stops no ligature (CSS Text 3 section 7.3).",
      "fill-opacity: 1", "f<tspan>i</tspan>", ["f_i"], "<tspan", '<tspan font-size="20"')

SMALL = 0.7 * SIZE  # made small capitals
FIRST = CUBIC.advance("A") * SMALL
HANGING = 100 + 0.8 * CUBIC.font["hhea"].ascent / CUBIC.em * SIZE


def made(name, about, style, outlines, key):
    case(f"variants/{name}", about, f'<text x="20" y="100" style="font-family: VTM Cubic; {style}">aA</text>',
         draw(*outlines), key)


made("small-caps-made", "Without smcp small letters are capitals of 0.7 of the size.", "font-variant: small-caps",
     [glyph("A", 20, 100, SMALL, CUBIC), glyph("A", 20 + FIRST, 100, face=CUBIC)], "font-variant: small-caps")
made("all-small-caps-made", "Without c2sc capitals are made smaller, too.", "font-variant: all-small-caps",
     [glyph("A", 20, 100, SMALL, CUBIC), glyph("A", 20 + FIRST, 100, SMALL, CUBIC)], "all-")
made("small-caps-baseline", "They stand on the line of the letters around them.",
     "font-variant: small-caps; dominant-baseline: hanging",
     [glyph("A", 20, HANGING, SMALL, CUBIC), glyph("A", 20 + FIRST, HANGING, face=CUBIC)],
     "; dominant-baseline: hanging")
made("small-caps-not-made", "font-synthesis: none; the small letter is that of the default family.",
     "font-variant: small-caps; font-synthesis: none",
     [glyph("a.small", 20, 100), glyph("A", 20 + TEST.advance("a.small") * SIZE, 100, face=CUBIC)],
     "; font-synthesis: none")
