"""Plots as SVG text, in colours that follow the page they stand in (light ones where they stand alone)."""
import html
import math

WIDTH, HEIGHT, LEFT, BOTTOM, TOP, RIGHT = 640, 400, 70, 50, 30, 20
INK, FAINT, GROUND = "var(--ink, #222)", "var(--faint, #ddd)", "var(--ground, #fff)"
COLOURS = [f"var(--c{i}, {colour})" for i, colour in enumerate(
    ("#c00", "#e07000", "#06c", "#080", "#808", "#088", "#963", "#666", "#36a2eb", "#b0508c", "#7a7a00", "#444", "#5a4", "#c49"))]


def text(x, y, words, anchor="start", size=12):
    return (f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-family="sans-serif" font-size="{size}" '
            f'style="fill:{INK}">{html.escape(str(words))}</text>')


def short(value):
    return f"{value:.0f}" if value >= 1000 else f"{value:.3g}"


def rectangle(x, y, width, height, colour, title=""):
    tip = f"<title>{html.escape(title)}</title>" if title else ""
    return f'<rect x="{x:.1f}" y="{y:.1f}" width="{max(width, 0):.1f}" height="{height:.1f}" style="fill:{colour}">{tip}</rect>'


def circle(x, y, radius, colour, title="", opacity=1.0):
    tip = f"<title>{html.escape(title)}</title>" if title else ""
    return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius}" style="fill:{colour};fill-opacity:{opacity}">{tip}</circle>'


def svg(width, height, parts):
    body = "\n".join([rectangle(0, 0, width, height, GROUND)] + parts)
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
            f'width="{width}" height="{height}">\n{body}\n</svg>\n')


def logarithmic(values, margin=0.05):
    """Powers of ten that hold all values, with a margin."""
    low, high = math.log10(min(values)), math.log10(max(values))
    margin *= max(high - low, 0.5)
    return low - margin, high + margin


def ticks(low, high):
    steps = [1] if high - low > 3 else [1, 2, 5]
    for power in range(math.floor(low), math.ceil(high) + 1):
        for step in steps:
            if low <= math.log10(step) + power <= high:
                yield step * 10.0 ** power


class Plot:
    """Points on two logarithmic axes."""

    def __init__(self, title, x_label, y_label, points, beside=0):
        """points: all that must be in view. `beside`: how wide the notes are, if they stand right of the plot."""
        self.beside = beside
        self.x = logarithmic([x for x, _ in points])
        self.y = logarithmic([y for _, y in points])
        self.parts = [text(WIDTH / 2, 18, title, "middle"), text(WIDTH / 2, HEIGHT - 10, x_label, "middle"),
                      f'<g transform="translate(14 {HEIGHT / 2}) rotate(-90)">{text(0, 0, y_label, "middle")}</g>']
        self.grid()

    def place(self, x, y):
        across = (math.log10(x) - self.x[0]) / (self.x[1] - self.x[0])
        up = (math.log10(y) - self.y[0]) / (self.y[1] - self.y[0])
        return LEFT + across * (WIDTH - LEFT - RIGHT), HEIGHT - BOTTOM - up * (HEIGHT - BOTTOM - TOP)

    def grid(self):
        corner, end = (10 ** self.x[0], 10 ** self.y[0]), (10 ** self.x[1], 10 ** self.y[1])
        for x in ticks(*self.x):
            self.line([(x, corner[1]), (x, end[1])], FAINT)
            at = self.place(x, corner[1])
            self.parts.append(text(at[0], at[1] + 15, f"{x:g}", "middle", 10))
        for y in ticks(*self.y):
            self.line([(corner[0], y), (end[0], y)], FAINT)
            at = self.place(corner[0], y)
            self.parts.append(text(at[0] - 4, at[1] + 4, f"{y:g}", "end", 10))

    def line(self, points, colour, dashes=""):
        places = " ".join("{:.1f},{:.1f}".format(*self.place(*p)) for p in points)
        self.parts.append(f'<polyline points="{places}" style="fill:none;stroke:{colour};stroke-width:1.5" '
                          f'stroke-dasharray="{dashes}"/>')

    def dots(self, points, colour):
        for point in points:
            self.dot(point, colour)

    def dot(self, point, colour, radius=3, label="", below=False):
        x, y = self.place(*point)
        self.parts.append(circle(x, y, radius, colour, label))
        if label:
            near = x > WIDTH - RIGHT - 60  # the end of the plot
            self.parts.append(text(x - 6 if near else x + 6, y + 13 if below else y - 4, label, "end" if near else "start", 9))

    def note(self, row, colour, words):
        left = WIDTH - RIGHT if self.beside else LEFT
        self.parts.append(rectangle(left + 10, TOP + 6 + 16 * row, 10, 10, colour))
        self.parts.append(text(left + 26, TOP + 15 + 16 * row, words, size=11))

    def svg(self):
        return svg(WIDTH + self.beside, HEIGHT, self.parts)


def strips(title, x_label, rows, mark=None, width=640):
    """A logarithmic axis and a strip of dots for each row: (name, [(value, what it is)], middle, colour). `mark`: a line."""
    left, top, pitch = 190, 30, 20
    height = top + pitch * len(rows) + 46
    values = [value for _, dots, middle, _ in rows for value in [middle] + [v for v, _ in dots]] + ([mark] if mark else [])
    low, high = logarithmic(values)

    def place(value):
        return left + (math.log10(value) - low) / (high - low) * (width - left - 70)

    parts = [text(width / 2, 18, title, "middle"), text(width / 2, height - 8, x_label, "middle", 11)]
    for tick in ticks(low, high):
        parts.append(rectangle(place(tick), top, 1, pitch * len(rows), FAINT))
        parts.append(text(place(tick), top + pitch * len(rows) + 14, f"{tick:g}", "middle", 10))
    if mark:
        parts.append(rectangle(place(mark), top, 1.5, pitch * len(rows), INK))
    for i, (name, dots, middle, colour) in enumerate(rows):
        y = top + pitch * (i + 0.5)
        parts.append(text(left - 8, y + 4, name, "end", 11))
        parts += [circle(place(value), y, 3, colour, f"{name}, {what}: {short(value)}", 0.45) for value, what in dots]
        parts.append(rectangle(place(middle) - 1.5, y - 8, 3, 16, colour, f"{name}, median: {short(middle)}"))
        parts.append(text(width - 62, y + 4, short(middle), size=11))
    return svg(width, height, parts)


def stacks(title, unit, rows, steps, width=760):
    """A bar for each row, (name, {step: value}), each divided into steps, all as shares; the sum stands beside it."""
    left, top, pitch = 150, 54, 22
    height = top + pitch * len(rows) + 10
    parts = [text(width / 2, 18, title, "middle")]
    for i, step in enumerate(steps):
        x = left + i * (width - left - 20) / len(steps)
        parts += [rectangle(x, 28, 10, 10, COLOURS[i % len(COLOURS)]), text(x + 13, 37, step, size=10)]
    for k, (name, values) in enumerate(rows):
        y, x, total = top + pitch * k, left, sum(values[step] for step in steps)
        parts.append(text(left - 8, y + 12, name, "end", 11))
        for i, step in enumerate(steps):
            wide = values[step] / total * (width - left - 100)
            parts.append(rectangle(x, y, wide, pitch - 6, COLOURS[i % len(COLOURS)], f"{step}: {short(values[step])} {unit}"))
            x += wide
        parts.append(text(x + 6, y + 12, f"{short(total)} {unit}", size=11))
    return svg(width, height, parts)
