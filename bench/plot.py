#!/usr/bin/env python3
"""Plots of bench_report's results as SVG: plot.py [FOLDER]

scaling.json: CPU time and bytes over the number of curves, both axes logarithmic, with n log n through the first point.
sweep.json: bytes over fragment cost in all files, for the cost model at all its settings and for fixed sizes of leaves.
zoom.json (of conformance/cases/texture_table): what a texture's frames change beyond the exact picture's.
"""
import json
import math
import pathlib
import sys

WIDTH, HEIGHT, LEFT, BOTTOM, TOP, RIGHT = 640, 400, 70, 50, 30, 20


class Plot:
    """Points on two logarithmic axes."""

    def __init__(self, title, x_label, y_label, points):
        """points: all that must be in view."""
        self.x = self.axis([x for x, _ in points])
        self.y = self.axis([y for _, y in points])
        self.parts = [f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
                      self.text(WIDTH / 2, 18, title, "middle"),
                      self.text(WIDTH / 2, HEIGHT - 10, x_label, "middle"),
                      f'<g transform="translate(14 {HEIGHT / 2}) rotate(-90)">{self.text(0, 0, y_label, "middle")}</g>']
        self.grid()

    @staticmethod
    def axis(values):
        low, high = math.log10(min(values)), math.log10(max(values))
        return low - 0.05 * (high - low), high + 0.05 * (high - low)

    @staticmethod
    def text(x, y, words, anchor="start", size=12):
        return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-family="sans-serif" font-size="{size}">{words}</text>'

    def place(self, x, y):
        across = (math.log10(x) - self.x[0]) / (self.x[1] - self.x[0])
        up = (math.log10(y) - self.y[0]) / (self.y[1] - self.y[0])
        return LEFT + across * (WIDTH - LEFT - RIGHT), HEIGHT - BOTTOM - up * (HEIGHT - BOTTOM - TOP)

    @staticmethod
    def ticks(low, high):
        steps = [1] if high - low > 3 else [1, 2, 5]
        for power in range(math.floor(low), math.ceil(high) + 1):
            for step in steps:
                if low <= math.log10(step) + power <= high:
                    yield step * 10.0 ** power

    def grid(self):
        corner, end = (10 ** self.x[0], 10 ** self.y[0]), (10 ** self.x[1], 10 ** self.y[1])
        for x in self.ticks(*self.x):
            self.line([(x, corner[1]), (x, end[1])], "#ddd")
            at = self.place(x, corner[1])
            self.parts.append(self.text(at[0], at[1] + 15, f"{x:g}", "middle", 10))
        for y in self.ticks(*self.y):
            self.line([(corner[0], y), (end[0], y)], "#ddd")
            at = self.place(corner[0], y)
            self.parts.append(self.text(at[0] - 4, at[1] + 4, f"{y:g}", "end", 10))

    def line(self, points, colour, dashes=""):
        places = " ".join("{:.1f},{:.1f}".format(*self.place(*p)) for p in points)
        self.parts.append(f'<polyline points="{places}" fill="none" stroke="{colour}" stroke-width="1.5" '
                          f'stroke-dasharray="{dashes}"/>')

    def dot(self, point, colour, radius=3, label=""):
        x, y = self.place(*point)
        self.parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius}" fill="{colour}"/>')
        if label:
            self.parts.append(self.text(x + 5, y - 4, label, size=9))

    def note(self, row, colour, words):
        self.parts.append(f'<rect x="{LEFT + 10}" y="{TOP + 6 + 16 * row}" width="10" height="10" fill="{colour}"/>')
        self.parts.append(self.text(LEFT + 26, TOP + 15 + 16 * row, words, size=11))

    def write(self, path):
        body = "\n".join(self.parts)
        path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" '
                        f'width="{WIDTH}" height="{HEIGHT}">\n{body}\n</svg>\n')


def series(rows, column):
    return [(row["curves"], row[column]) for row in rows]


def plot_scaling(rows, folder):
    time, memory = series(rows, "cpu ms"), series(rows, "peak MB")
    n, first = time[0]
    ideal = [(x, first * x * math.log(x) / (n * math.log(n))) for x, _ in time]
    plot = Plot("Encoding synthetic scenes", "curves", "CPU ms, peak MB", time + memory + ideal)
    plot.line(ideal, "#888", "4 4")
    for points, colour in ((time, "#06c"), (memory, "#c60")):
        plot.line(points, colour)
        for point in points:
            plot.dot(point, colour)
    for row, (colour, words) in enumerate((("#06c", "CPU time, ms"), ("#c60", "peak memory, MB"),
                                           ("#888", "n log n through the first point"))):
        plot.note(row, colour, words)
    plot.write(folder / "scaling.svg")


def plot_sweep(rows, folder):
    """Sums over the files."""
    sums, is_model = {}, {}
    for row in rows:
        cost, size = sums.get(row["setting"], (0, 0))
        sums[row["setting"]] = (cost + row["fragment cost"], size + row["bytes"] / 1e6)
        is_model[row["setting"]] = row["model"]
    files = len({row["file"] for row in rows})
    points = {setting: (cost / files, size) for setting, (cost, size) in sums.items()}
    plot = Plot("The cost model and fixed sizes of leaves", "fragment cost, ns a pixel", "MB in all", points.values())
    plot.line([point for setting, point in points.items() if is_model[setting]], "#c00")
    for setting, point in points.items():
        if not is_model[setting]:
            plot.dot(point, "#06c", 3, setting.replace(" pieces, depth ", "/"))
    plot.note(0, "#c00", "the cost model")
    plot.note(1, "#06c", "at most so many pieces a leaf / depth")
    plot.write(folder / "sweep.svg")


def plot_zoom(rows, folder):
    """What a texture's frames change beyond the exact picture's, from 16 to 65536 pixels."""
    least, visible = 1e-3, 2.0
    files = list(dict.fromkeys(row["file"] for row in rows))
    lines = {name: [(row["px"], max(row["change"], least)) for row in rows if row["file"] == name][1:] for name in files}
    sizes = [row["px"] for row in rows]
    bound = [(min(sizes), visible), (max(sizes), visible)]
    plot = Plot("Zooming by 1/8 octave a frame: what changes beyond the exact picture", "pixels of the picture's longer side",
                "rms of 255", bound + [point for line in lines.values() for point in line] + [(min(sizes), 5 * visible)])
    plot.line(bound, "#888", "4 4")
    plot.note(0, "#888", "the bound")
    for row, (name, colour) in enumerate(zip(lines, ("#c00", "#06c", "#080", "#c60", "#808")), 1):
        plot.line(lines[name], colour)
        plot.note(row, colour, name)
    plot.write(folder / "zoom.svg")


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).parent / "results"
    for name, plot in (("scaling", plot_scaling), ("sweep", plot_sweep), ("zoom", plot_zoom)):
        path = folder / f"{name}.json"
        if path.exists():
            plot(json.loads(path.read_text())["rows"], folder)
        else:
            print(f"skipped: {path} is absent", file=sys.stderr)


if __name__ == "__main__":
    main()
