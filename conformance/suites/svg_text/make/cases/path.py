"""textPath: SVG 2 sections 11.5 (position on path) and 11.8."""
import math

from layout import BLUE, RED, SIZE, TEST, WORLD, draw, glyph, line, move, turn, underline  # noqa: F401
from registry import case

ADVANCE = {n: TEST.advance(n) * SIZE for n in "ACEDH"}
LINE = '<path id="p" d="M 20,100 H 180" fill="none"/>'
RADIUS = 60
PERIMETER = 2 * math.pi * RADIUS
CIRCLE = f'<circle id="p" cx="100" cy="100" r="{RADIUS}" fill="none"/>'


def on_circle(names, start=0, clockwise=True, dy=0):
    """Glyphs on the circle, which begins at its right and goes clockwise."""
    made, pen = [], start
    for name in names:
        middle, sense = (pen + ADVANCE[name] / 2) / RADIUS, 1 if clockwise else -1
        point = 100 + RADIUS * math.cos(sense * middle), 100 + RADIUS * math.sin(sense * middle)
        frame = move(*point) @ turn(math.degrees(sense * middle) + 90 * sense) @ move(-ADVANCE[name] / 2, dy)
        made.append(glyph(name, 0, 0, frame=frame))
        pen += ADVANCE[name]
    return made


def on(path, name, about, content, outlines, key, without="", attributes=""):
    case(f"path/{name}", about, f'<defs>{path}</defs><text{attributes}>{content}</text>', draw(*outlines), key, without)


def reference(content, attributes=""):
    return f'<textPath href="#p"{attributes}>{content}</textPath>'


A, C, E = (ADVANCE[n] for n in "ACE")
on(LINE, "straight", "A straight path.", reference("ACE"), [line("ACE", 20, 100)], "<textPath[^>]*>ACE</textPath>", "ACE")
on('<path id="p" d="M 100,20 V 180"/>', "down", "A path that goes down turns glyphs.", reference("AC"),
   [glyph("A", 0, 0, frame=move(100, 20) @ turn(90)), glyph("C", 0, 0, frame=move(100, 20 + A) @ turn(90))],
   "V 180", "h 90")
on(CIRCLE, "circle", "Glyphs stand on the path with the middles of their advances.", reference("ACEDA"),
   on_circle("ACEDA"), "ACEDA", "ACED")
on(CIRCLE, "xlink", "xlink:href.", '<textPath xlink:href="#p">ACE</textPath>', on_circle("ACE"), "#p", "#q")
on(CIRCLE, "start-offset", "startOffset along the path.", reference("ACE", ' startOffset="50"'), on_circle("ACE", 50),
   ' startOffset="50"')
on(CIRCLE, "start-offset-percent", "startOffset in percent of the path.", reference("ACE", ' startOffset="50%"'),
   on_circle("ACE", PERIMETER / 2), ' startOffset="50%"')
on(LINE, "start-offset-negative", "Characters whose middles are before the path are not drawn.",
   reference("ACE", ' startOffset="-30"'), [line("CE", 20 + A - 30, 100)], ' startOffset="-30"')
on('<path id="p" d="M 20,100 h 55"/>', "off-the-end", "Nor are those behind it.", reference("ACE"),
   [line("AC", 20, 100)], "h 55", "h 155")
on(CIRCLE, "side-right", "side=\"right\": on the other side, in the other direction.", reference("ACE", ' side="right"'),
   on_circle("ACE", clockwise=False), ' side="right"')
on('<path id="p" d="M 20,100 H 180"/>', "side-right-offset", "startOffset is measured on the reversed path.",
   reference("AC", ' side="right" startOffset="40"'),
   [glyph("A", 140, 100, rotate=180), glyph("C", 140 - A, 100, rotate=180)], ' side="right"')
on(CIRCLE, "closed", "Text runs on over the start of a closed path.", reference("ACEDACE", ' startOffset="75%"'),
   on_circle("ACEDACE", 0.75 * PERIMETER), ' startOffset="75%"')
on(CIRCLE, "closed-once", "It goes round a closed path once.", reference("HHHHHHHHHHHHHHHHH", ' startOffset="30"'),
   on_circle("H" * 13, 30), "H{17}", "HHHHHHHHHHHH")
on(CIRCLE, "closed-middle", "text-anchor: middle on a closed path, over its start.",
   reference("ACE", ' text-anchor="middle"'), on_circle("ACE", -(A + C + E) / 2), ' text-anchor="middle"')
on(CIRCLE, "closed-end", "text-anchor: end on a closed path: before its start.",
   reference("ACE", ' text-anchor="end"'), on_circle("ACE", -(A + C + E)), ' text-anchor="end"')
on(LINE, "anchor-middle", "text-anchor: middle about startOffset.",
   reference("ACE", ' startOffset="50%" text-anchor="middle"'), [line("ACE", 100 - (A + C + E) / 2, 100)],
   ' text-anchor="middle"')
on(LINE, "anchor-end", "text-anchor: end at startOffset.", reference("ACE", ' startOffset="100%" text-anchor="end"'),
   [line("ACE", 180 - A - C - E, 100)], ' text-anchor="end"')
on('<path id="p" d="M 10,50 H 90" transform="scale(2)"/>', "transform", "The path's own transform counts, glyphs keep "
   "their size.", reference("ACE"), [line("ACE", 20, 100)], ' transform="scale\\(2\\)"')
case("path/transform-around", "A transform around the path does not count.",
     f'<g transform="translate(50 50)"><defs>{LINE}</defs></g><text>{reference("ACE")}</text>',
     draw(line("ACE", 20, 100)), "<textPath", '<textPath startOffset="9"')
on("", "path-attribute", "The attribute path.", '<textPath path="M 20,100 H 180">ACE</textPath>',
   [line("ACE", 20, 100)], ' path="[^"]*"')
on(LINE, "path-attribute-wins", "It wins over href.", '<textPath href="#p" path="M 20,150 H 180">ACE</textPath>',
   [line("ACE", 20, 150)], ' path="[^"]*"')
on('<rect id="p" x="30" y="60" width="140" height="90"/>', "rectangle", "A basic shape: along its sides.",
   reference("ACEDACA"),
   [line("ACEDAC", 30, 60), glyph("A", 0, 0, frame=move(170, 60) @ turn(90) @ move(144 - 140, 0))],
   "ACEDACA", "ACEDAC")
on('<path id="p" pathLength="16" d="M 20,100 H 180"/>', "path-length", "pathLength is the unit of startOffset.",
   reference("ACE", ' startOffset="4"'), [line("ACE", 60, 100)], ' pathLength="16"')
on(CIRCLE, "dy", "dy moves off the path.", reference('<tspan dy="-10">A</tspan>C'), on_circle("AC", dy=-10), ' dy="-10"')
on(LINE, "dx", "dx moves along the path.", reference('A<tspan dx="20">C</tspan>E'),
   [glyph("A", 20, 100), line("CE", 40 + A, 100)], ' dx="20"')
on(LINE, "x-of-tspan", "x of a tspan on the path is a place along it.", reference('A<tspan x="80">C</tspan>'),
   [glyph("A", 20, 100), glyph("C", 100, 100)], ' x="80"')
on(LINE, "x-of-text", "x of the text moves along the path, y does not count.", reference("ACE"),
   [line("ACE", 50, 100)], 'x="30"', "", ' x="30" y="77"')
on(LINE, "baseline-shift", "baseline-shift is off the path.", reference('A<tspan baseline-shift="12">C</tspan>'),
   [glyph("A", 20, 100), glyph("C", 20 + A, 88)], ' baseline-shift="12"')
on(LINE, "letter-spacing", "letter-spacing along the path.", reference("ACE", ' letter-spacing="12"'),
   [line("ACE", 20, 100, spacing=12)], ' letter-spacing="12"')
on(LINE, "rotate", "rotate turns on top of the path.", reference("AC"),
   [line("", 0, 0), glyph("A", 20, 100, rotate=30), glyph("C", 20 + A, 100, rotate=30)], 'rotate="30"', "",
   ' rotate="30"')
case("path/tspans", "Parts in their own paints and sizes.",
     f'<defs>{LINE}</defs><text>{reference(f"""A<tspan fill="{RED}" font-size="60">C</tspan>E""")}</text>',
     draw(glyph("A", 20, 100), glyph("E", 20 + A + 1.5 * C, 100)) + draw(glyph("C", 20 + A, 100, size=60), fill=RED),
     ' font-size="60"')
on('<path id="p" d="M 20,60 H 120"/>', "text-behind", "Text behind a path begins at the path's end (SVG 2 11.5).",
   reference("AC") + "E", [line("AC", 20, 60), glyph("E", 120, 60)], "</textPath>E", "</textPath>")
on('<path id="p" d="M 20,60 H 120"/>', "text-before", "Text before a path stands where the text says.",
   "E" + reference("AC"), [line("AC", 20, 60), glyph("E", 30, 150)], ">E", ">", ' x="30" y="150"')
on(LINE, "missing", "A reference to nothing: not drawn; the text around it is.", f'A<textPath href="#q">E</textPath>C',
   [line("AC", 20, 150)], "#q", "#p", ' x="20" y="150"')
case("path/two-paths", "Two paths in one text.",
     '<defs><path id="p" d="M 20,60 H 180"/><path id="q" d="M 20,140 H 180"/></defs>'
     f'<text>{reference("AC")}<textPath href="#q">E</textPath></text>',
     draw(line("AC", 20, 60), line("E", 20, 140)), "#q", "#p")
on('<path id="p" d="M 20,60 h 55 M 100,140 h 60"/>', "two-subpaths", "A path of two parts: the second goes on from "
   "the end of the first.", reference("ACE"), [line("AC", 20, 60), glyph("E", 100 + A + C - 55, 140)], "M 100,140",
   "M 75,60")
on(LINE, "right-to-left", "Right-to-left text starts at the path's start and ends before it, unless it is anchored.",
   reference("\u05d0\u05d1", ' startOffset="100%"'), [line(["bet", "alef"], 180 - 1.15 * SIZE, 100, WORLD)],
   ' startOffset="100%"', "", ' direction="rtl" font-family="VTM World"')
case("path/decoration", "Decorations follow the path.",
     f'<defs>{LINE}</defs><text text-decoration="underline">{reference("ACE")}</text>',
     draw(line("ACE", 20, 100), underline(20, 20 + A + C + E, 100)), ' text-decoration="underline"')
