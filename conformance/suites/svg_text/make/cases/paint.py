"""Paint on text: SVG 2 sections 11.10, 13 and 14. Boxes of text are those of its glyph cells (section 8.10)."""
from layout import ASCENT, BLUE, DESCENT, GREEN, RED, SIZE, TEST, draw, glyph, line, rectangle, width
from registry import case

A, C, E, H = (TEST.advance(n) * SIZE for n in "ACEH")
STOPS = f'<stop offset="0.5" stop-color="{GREEN}"/><stop offset="0.5" stop-color="{RED}"/>'


def halves(d, box, **more):
    """The outline, green in the left half of the box and red in the right one."""
    gradient = (f'<linearGradient id="g" gradientUnits="userSpaceOnUse" x1="{box[0]}" x2="{box[1]}">{STOPS}'
                '</linearGradient>')
    return gradient + draw(d, fill="url(#g)", **more)


GRADIENT = f'<linearGradient id="g">{STOPS}</linearGradient>'
END = 20 + A + C + E
case("paint/gradient", "objectBoundingBox: the box of all glyph cells.",
     f'{GRADIENT}<text x="20" y="100" fill="url(#g)">ACE</text>', halves(line("ACE", 20, 100), (20, END)), ' fill="url\\(#g\\)"')
case("paint/gradient-vertical", "Cells go from the descent to the ascent.",
     f'<linearGradient id="g" x2="0" y2="1">{STOPS}</linearGradient><text x="20" y="100" fill="url(#g)">ACE</text>',
     f'<linearGradient id="g" gradientUnits="userSpaceOnUse" x1="0" x2="0" y1="{100 - ASCENT * SIZE}" '
     f'y2="{100 + DESCENT * SIZE}">{STOPS}</linearGradient>' + draw(line("ACE", 20, 100), fill="url(#g)"),
     ' y2="1"', ' y2="0.5"')
case("paint/gradient-of-tspan", "The box is the text's, also for a tspan.",
     f'{GRADIENT}<text x="20" y="100">A<tspan fill="url(#g)">H</tspan>E</text>',
     draw(glyph("A", 20, 100), glyph("E", 20 + A + H, 100)) + halves(glyph("H", 20 + A, 100), (20, 20 + A + H + E)),
     ' fill="url\\(#g\\)"')
case("paint/gradient-two-lines", "Chunks far apart share one box.",
     f'{GRADIENT}<text fill="url(#g)"><tspan x="20" y="60">AC</tspan><tspan x="120" y="150">HE</tspan></text>',
     halves(" ".join((line("AC", 20, 60), line("HE", 120, 150))), (20, 120 + H + E)), ' fill="url\\(#g\\)"')
case("paint/gradient-user-space", "userSpaceOnUse.",
     f'<linearGradient id="g" gradientUnits="userSpaceOnUse" x1="0" x2="100">{STOPS}</linearGradient>'
     '<text x="20" y="100" fill="url(#g)">ACE</text>', halves(line("ACE", 20, 100), (0, 100)), ' x2="100"', ' x2="120"')
case("paint/gradient-inherited", "From a group: the box is still the text's.",
     f'{GRADIENT}<g fill="url(#g)"><text x="20" y="100">ACE</text><rect x="0" y="0" width="9" height="9" fill="none"/></g>',
     halves(line("ACE", 20, 100), (20, END)), ' fill="url\\(#g\\)"')
case("paint/gradient-with-space", "Spaces are part of the box.",
     f'{GRADIENT}<text x="20" y="100" fill="url(#g)" xml:space="preserve">AC  </text>',
     halves(line("AC", 20, 100), (20, 20 + width("AC  "))), ' xml:space="preserve"')
case("paint/gradient-stroke", "A stroke with a gradient: the box does not hold the stroke.",
     f'{GRADIENT}<text x="20" y="100" fill="none" stroke="url(#g)" stroke-width="4">ACE</text>',
     f'<linearGradient id="g" gradientUnits="userSpaceOnUse" x1="20" x2="{END}">{STOPS}</linearGradient>'
     + draw(line("ACE", 20, 100), fill="none", stroke="url(#g)", stroke_width=4), ' stroke-width="4"')
case("paint/pattern", "A pattern in user space.",
     f'<pattern id="p" width="10" height="10" patternUnits="userSpaceOnUse"><rect width="5" height="10" fill="{RED}"/>'
     '</pattern><text x="20" y="100" fill="url(#p)">HH</text>',
     f'<pattern id="p" width="10" height="10" patternUnits="userSpaceOnUse"><rect width="5" height="10" fill="{RED}"/>'
     '</pattern>' + draw(line("HH", 20, 100), fill="url(#p)"), ' fill="url\\(#p\\)"')
case("paint/stroke", "Fill and stroke: strokes of one element are above all its fills.",
     f'<text x="20" y="100" stroke="{RED}" stroke-width="4" letter-spacing="-12">HH</text>',
     draw(line("HH", 20, 100, spacing=-12), stroke=RED, stroke_width=4), ' stroke-width="4"')
case("paint/stroke-only", "Without a fill.", f'<text x="20" y="100" fill="none" stroke="{RED}">ACE</text>',
     draw(line("ACE", 20, 100), fill="none", stroke=RED), ' fill="none"')
case("paint/stroke-joins", "Joins and dashes begin at each outline's first point.",
     f'<text x="20" y="150" font-size="120" fill="none" stroke="{RED}" stroke-width="8" stroke-linejoin="round" '
     'stroke-dasharray="20 6">A</text>',
     draw(line("A", 20, 150, size=120), fill="none", stroke=RED, stroke_width=8, stroke_linejoin="round",
          stroke_dasharray="20 6"), ' stroke-dasharray="20 6"')
case("paint/paint-order", "paint-order: the stroke below.",
     f'<text x="20" y="100" stroke="{RED}" stroke-width="6" paint-order="stroke">ACE</text>',
     draw(line("ACE", 20, 100), fill="none", stroke=RED, stroke_width=6) + draw(line("ACE", 20, 100)),
     ' paint-order="stroke"')
case("paint/paint-order-of-tspan", "Of a part.",
     f'<text x="20" y="100" stroke="{RED}" stroke-width="6">A<tspan paint-order="stroke">C</tspan></text>',
     draw(glyph("A", 20, 100), stroke=RED, stroke_width=6)
     + draw(glyph("C", 20 + A, 100), fill="none", stroke=RED, stroke_width=6) + draw(glyph("C", 20 + A, 100)),
     ' paint-order="stroke"')
case("paint/opacity", "opacity of a text is that of a group.",
     f'<text x="20" y="100" opacity="0.5">H<tspan x="30" fill="{RED}">H</tspan></text>',
     f'<g opacity="0.5">{draw(glyph("H", 20, 100))}{draw(glyph("H", 30, 100), fill=RED)}</g>', ' opacity="0.5"')
case("paint/fill-opacity", "fill-opacity of a tspan.", '<text x="20" y="100">A<tspan fill-opacity="0.3">C</tspan></text>',
     draw(glyph("A", 20, 100)) + draw(glyph("C", 20 + A, 100), fill_opacity="0.3"), ' fill-opacity="0.3"')
case("paint/current-color", "currentColor.", f'<text x="20" y="100" color="{RED}" fill="currentColor">ACE</text>',
     draw(line("ACE", 20, 100), fill=RED), f' color="{RED}"')
case("paint/fill-none", "A part without paint takes its room.",
     '<text x="20" y="100">A<tspan fill="none">C</tspan>E</text>', draw(glyph("A", 20, 100), glyph("E", 20 + A + C, 100)),
     ' fill="none"')
case("paint/clip", "clip-path on text, in fractions of its box.",
     '<clipPath id="c" clipPathUnits="objectBoundingBox"><rect width="0.5" height="1"/></clipPath>'
     '<text x="20" y="100" clip-path="url(#c)">HHH</text>',
     f'<clipPath id="c"><rect x="20" width="{1.5 * H:g}" height="200"/></clipPath>'
     + draw(line("HHH", 20, 100), clip_path="url(#c)"), ' clip-path="[^"]*"')
case("paint/mask", "mask on text, in fractions of its box.",
     '<mask id="m" maskContentUnits="objectBoundingBox"><rect width="0.5" height="1" fill="white"/></mask>'
     '<text x="20" y="100" mask="url(#m)">HHH</text>',
     f'<clipPath id="c"><rect x="20" width="{1.5 * H:g}" height="200"/></clipPath>'
     + draw(line("HHH", 20, 100), clip_path="url(#c)"), ' mask="[^"]*"')
case("paint/transform", "A transform.", '<text x="20" y="10" transform="rotate(30) scale(1.5 1)">ACE</text>',
     draw(line("ACE", 20, 10), transform="rotate(30) scale(1.5 1)"), ' transform="[^"]*"')
case("paint/skewed", "A skewed and mirrored text.", '<text x="-150" y="60" transform="skewY(20) scale(-1 1.5)">ACE</text>',
     draw(line("ACE", -150, 60), transform="skewY(20) scale(-1 1.5)"), ' transform="[^"]*"')
case("paint/transform-of-tspan", "transform is not for tspans.",
     '<text x="20" y="100">A<tspan transform="translate(0 50)">C</tspan></text>', draw(line("AC", 20, 100)),
     "tspan transform", "tspan dy='50' transform")
case("paint/huge-size", "A font of 40000 units made small.",
     '<text x="20000" y="100000" font-size="40000" transform="scale(0.001)">ACE</text>', draw(line("ACE", 20, 100)),
     '"40000"', '"30000"')
case("paint/tiny-size", "A font of 0.004 units made large.",
     '<text x="0.002" y="0.01" font-size="0.004" transform="scale(10000)">ACE</text>', draw(line("ACE", 20, 100)),
     '"0.004"', '"0.003"')
case("paint/view-box", "A tiny viewBox.",
     '<svg width="200" height="200" viewBox="0 0 0.02 0.02"><text x="0.002" y="0.01" font-size="0.004">ACE</text></svg>',
     draw(line("ACE", 20, 100)), '"0.004"', '"0.003"')
case("paint/non-zero", "Outlines are filled by the non-zero rule, whatever fill-rule says.",
     '<text x="20" y="150" font-size="120" fill-rule="evenodd" letter-spacing="-50">HH</text>',
     draw(line("HH", 20, 150, size=120, spacing=-50)), "-50", "-40")
case("paint/counter", "Counters are holes.", '<text x="20" y="150" font-size="120">0</text>',
     draw(line("0", 20, 150, size=120), fill_rule="evenodd"), ">0<", ">E<")
