"""@font-face with data: URLs: CSS Fonts 4 section 4."""
import base64

from layout import BOLD, CUBIC, FONTS, SIZE, TEST, draw, glyph, line, width
from registry import case

A = TEST.advance("A") * SIZE


def url(file):
    return f"url(data:font/otf;base64,{base64.b64encode((FONTS / file).read_bytes()).decode()})"


CUBIC_URL, BOLD_URL = url("VTMCubic-Regular.otf"), url("VTMTest-Bold.ttf")


def shown(name, about, rules, attributes, text, outlines, key, without=""):
    case(f"font-face/{name}", about,
         f'<style>{"".join(f"@font-face {{ {rule} }}" for rule in rules)}</style>'
         f'<text x="20" y="100"{attributes}>{text}</text>', draw(*outlines), key, without)


shown("data", "A font in the document.", [f"font-family: own; src: {CUBIC_URL}"], ' font-family="own"', "Ax",
      [line("Ax", 20, 100, CUBIC)], "font-family: own;", "font-family: other;")
shown("replaces", "It stands before a family of that name.", [f"font-family: 'VTM Test'; src: {CUBIC_URL}"], "", "Ax",
      [line("Ax", 20, 100, CUBIC)], "font-family: 'VTM Test'", "font-family: other")
shown("characters", "unicode-range: for some characters only.",
      [f"font-family: own; src: {CUBIC_URL}; unicode-range: U+61-7A"], ' font-family="own, VTM Test"', "Ax",
      [glyph("A", 20, 100), glyph("x", 20 + A, 100, face=CUBIC)], "; unicode-range: U\\+61-7A")
shown("weights", "Two faces by their weights.",
      [f"font-family: own; src: {CUBIC_URL}", f"font-family: own; font-weight: bold; src: {BOLD_URL}"],
      ' font-family="own" font-weight="bold"', "A", [glyph("A", 20, 100, face=BOLD)], ' font-weight="bold"')
shown("second-source", "A source that is no font gives way to the next one.",
      [f"font-family: own; src: url(data:font/ttf;base64,AAAA), {CUBIC_URL}"], ' font-family="own"', "Ax",
      [line("Ax", 20, 100, CUBIC)], ", url\\(data:font/otf[^)]*\\)")
