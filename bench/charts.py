"""What is plotted of each report of vtm-bench: functions from a report, as read from JSON, to SVG text."""
import math
import statistics

import plot

OTHER_PICTURE = 2.5  # rms from ours, as in bench/reports/drawing.cpp: who draws something else is in no median
NAMES = {"scan": "VTM, CPU", "gl": "VTM, as it is", "shaders": "VTM, shaders", "blend2d": "Blend2D", "thorvg": "ThorVG",
         "thorvg-gl": "ThorVG GL", "nanovg": "NanoVG"}
ORDER = ("scan", "gl", "shaders", "cairo", "librsvg", "resvg", "skia", "qt-raster", "qt-gl", "qt-gl-4", "blend2d", "thorvg",
         "thorvg-gl", "nanovg")
VIEWS = ("cold", "unchanged", "turning", "turning at 8x", "zoom path", "minified")


def engines_of(report):
    """Ours first, then the known peers, then others."""
    present = dict.fromkeys(row["engine"] for row in report["rows"])
    return [name for name in ORDER if name in present] + [name for name in present if name not in ORDER]


def colour_of(engine):
    return plot.COLOURS[ORDER.index(engine)] if engine in ORDER else plot.INK


def name_of(engine):
    return NAMES.get(engine, engine)


def spread(report, engine, value, where=lambda row: True):
    """(value, file) of an engine's rows."""
    return [(value(row), row["file"]) for row in report["rows"] if row["engine"] == engine and where(row) and value(row)]


def strip_rows(engines, dots_of):
    """For plot.strips, those that have a value."""
    rows = [(engine, dots_of(engine)) for engine in engines]
    return [(name_of(engine), dots, statistics.median(v for v, _ in dots), colour_of(engine)) for engine, dots in rows if dots]


def times_of(drawing, engine, views):
    """Ratios to our scanner's time, file by file, where the same picture is drawn."""
    return spread(drawing, engine, lambda row: row["ratios"].get("scan", {}).get("median"),
                  lambda row: row["views"] == views and row["rms from ours"] <= OTHER_PICTURE)


def draw_times(drawing):
    for views in VIEWS:
        rows = strip_rows(engines_of(drawing), lambda engine: times_of(drawing, engine, views))
        if rows:
            yield plot.strips(f"Time, {views}", "times as long as VTM on the CPU (a dot a file, a bar the median)", rows, mark=1)


def errors_of(error, engine, pixels, files=None, column="mean"):
    """Of these files, or of all that it draws, rightly or not."""
    return spread(error, engine, lambda row: row[column],
                  lambda row: row["px"] == pixels and (files is None or row["file"] in files))


def files_alike(drawing, engine):
    """Those that it draws as we do."""
    return {file for views in VIEWS for _, file in times_of(drawing, engine, views)}


def draw_errors(error):
    for pixels in dict.fromkeys(row["px"] for row in error["rows"]):
        rows = strip_rows(engines_of(error), lambda engine: errors_of(error, engine, pixels))
        yield plot.strips(f"Error at {pixels} pixels", "mean absolute difference from exact truth, 255ths", rows)


def draw_balance(drawing, error):
    """Time against error, medians over the files that an engine draws alike."""
    points = {}
    for engine in engines_of(drawing):
        times, errors = times_of(drawing, engine, "turning"), errors_of(error, engine, 1024, files_alike(drawing, engine))
        if times and errors:
            points[engine] = tuple(statistics.median(v for v, _ in dots) for dots in (times, errors))
    balance = plot.Plot("Time and error together: lower left is better", "time, turning, times VTM's on the CPU",
                        "mean error at 1024 px, 255ths", list(points.values()))
    for i, (engine, point) in enumerate(points.items()):
        balance.dot(point, colour_of(engine), 5, name_of(engine), below=i % 2 == 1)
    return balance.svg()


def draw_memory(memory):
    rows = strip_rows(engines_of(memory), lambda engine: spread(memory, engine, lambda row: row["MB"]))
    yield plot.strips("Peak memory, from the file to 1024 pixels", "MB beyond the bare process", rows)


def draw_sides(sides):
    rows = sides["rows"]
    lines = plot.Plot("Growth over the number of pixels, turning", "pixels of a side", "CPU ms",
                      [(row["side"], row["ms"]) for row in rows])
    for i, engine in enumerate(engines_of(sides)):
        points = [(row["side"], row["ms"]) for row in rows if row["engine"] == engine]
        lines.line(points, colour_of(engine))
        lines.dots(points, colour_of(engine))
        lines.note(i, colour_of(engine), name_of(engine))
    yield lines.svg()


def draw_steps(title, report, name, steps):
    yield plot.stacks(title, "ms", [(row[name], row) for row in report["rows"]], steps)


def draw_micro(micro):
    rows = [(row["step"], [(row["low"], "lower quartile"), (row["high"], "upper quartile")], row["ns"], plot.COLOURS[2])
            for row in micro["rows"]]
    yield plot.strips("Single steps", "nanoseconds an item (dots: quartiles)", rows)


def draw_texture(texture):
    bitmaps = [row for row in texture["rows"] if row["as"].startswith("bitmap")]
    views = list(dict.fromkeys(row["view"] for row in bitmaps))
    rows = [(view, [(1 / row["ratio"], f"{row['file']}, {row['as']}") for row in bitmaps if row["view"] == view]) for view in views]
    yield plot.strips("Pictures as textures", "times as long as mip-mapped bitmaps",
                      [(view, dots, statistics.median(v for v, _ in dots), plot.COLOURS[2]) for view, dots in rows], mark=1)


def draw_scaling(scaling):
    rows = scaling["rows"]
    time, memory = ([(row["curves"], row[column]) for row in rows] for column in ("cpu ms", "peak MB"))
    n, first = time[0]
    ideal = [(x, first * x * math.log(x) / (n * math.log(n))) for x, _ in time]
    lines = plot.Plot("Encoding synthetic scenes", "curves", "CPU ms, peak MB", time + memory + ideal)
    lines.line(ideal, plot.COLOURS[7], "4 4")
    for row, (colour, words, points) in enumerate(((plot.COLOURS[2], "CPU time, ms", time), (plot.COLOURS[1], "peak memory, MB", memory),
                                                   (plot.COLOURS[7], "n log n through the first point", []))):
        if points:
            lines.line(points, colour)
        lines.dots(points, colour)
        lines.note(row, colour, words)
    yield lines.svg()


def draw_traps(traps):
    families = list(dict.fromkeys(row["family"] for row in traps["rows"]))
    series = {name: [(row["n"], row["cpu ms"]) for row in traps["rows"] if row["family"] == name] for name in families}
    sizes = [row["n"] for row in traps["rows"]]
    bound = [(min(sizes), 4000), (max(sizes), 4000)]
    lines = plot.Plot("Drawn once, 500 pixels wide", "shapes", "CPU ms", bound + [p for points in series.values() for p in points],
                      beside=90)
    lines.line(bound, plot.COLOURS[7], "4 4")
    for row, (name, points) in enumerate(series.items()):
        lines.line(points, plot.COLOURS[row])
        lines.dots(points, plot.COLOURS[row])
        lines.note(row, plot.COLOURS[row], name)
    yield lines.svg()


def draw_paper(paper):
    timed = [row for row in paper["rows"] if row["what"] == "time"]
    for tile in dict.fromkeys(row["tile"] for row in timed):
        rows = []
        for form in dict.fromkeys(row["form"] for row in timed):
            ours = [row for row in timed if row["tile"] == tile and row["form"] == form and row["shown"] in ("1 x 1 periods", "4 x 4 periods")]
            rows.append((form.replace("compressed", "compr."), [(float(ours[0]["paper"]), "the paper")],
                         statistics.median(row["ratio"] for row in ours), plot.COLOURS[2]))
        yield plot.strips(f"The paper's four configurations, {tile}, magnified", "time over the first (bar: here; dot: the paper)", rows, mark=1)


def draw_sweep(sweep):
    sums, is_model = {}, {}
    for row in sweep["rows"]:
        cost, size = sums.get(row["setting"], (0, 0))
        sums[row["setting"]] = (cost + row["fragment cost"], size + row["bytes"] / 1e6)
        is_model[row["setting"]] = row["model"]
    files = len({row["file"] for row in sweep["rows"]})
    points = {setting: (cost / files, size) for setting, (cost, size) in sums.items()}
    lines = plot.Plot("The cost model and fixed sizes of leaves", "fragment cost, ns a pixel", "MB in all", points.values())
    lines.line([point for setting, point in points.items() if is_model[setting]], plot.COLOURS[0])
    for setting, point in points.items():
        if not is_model[setting]:
            lines.dot(point, plot.COLOURS[2], 3, setting.replace(" pieces, depth ", "/"))
    lines.note(0, plot.COLOURS[0], "the cost model")
    lines.note(1, plot.COLOURS[2], "at most so many pieces a leaf / depth")
    yield lines.svg()


def draw_zoom(zoom):
    """What a texture's frames change beyond the exact picture's, from 16 to 65536 pixels."""
    least, visible = 1e-3, 2.0
    files = list(dict.fromkeys(row["file"] for row in zoom["rows"]))
    series = {name: [(row["px"], max(row["change"], least)) for row in zoom["rows"] if row["file"] == name][1:] for name in files}
    sizes = [row["px"] for row in zoom["rows"]]
    bound = [(min(sizes), visible), (max(sizes), visible)]
    lines = plot.Plot("Zooming by 1/8 octave a frame: what changes beyond the exact picture", "pixels of the picture's longer side",
                      "rms of 255", bound + [p for points in series.values() for p in points] + [(min(sizes), 5 * visible)])
    lines.line(bound, plot.COLOURS[7], "4 4")
    lines.note(0, plot.COLOURS[7], "the bound")
    for row, (name, points) in enumerate(series.items(), 1):
        lines.line(points, plot.COLOURS[row - 1])
        lines.note(row, plot.COLOURS[row - 1], name)
    yield lines.svg()


def draw_recursion(recursion):
    """How much smaller than a flat grid each picture is, and how long it takes with instances."""
    forms = [("flat / tree", "tree", 2), ("flat / instances", "instances", 1), ("flat / both", "both", 3)]
    rows = []
    for column, name, colour in forms:
        dots = [(row[column], row["file"]) for row in recursion["rows"]]
        rows.append((name, dots, statistics.median(v for v, _ in dots), plot.COLOURS[colour]))
    times = [(row["both / tree"], row["file"]) for row in recursion["rows"]]
    rows.append(("time, both / tree", times, statistics.median(v for v, _ in times), plot.COLOURS[0]))
    yield plot.strips("Smaller than a flat grid by so many times; drawn in so much of the time", "times (a dot a file, a bar the median)", rows, mark=1)


def draw_none(_):
    """Its table says it."""
    return ()


PIPELINE = ("parse", "lower", "divide", "planarise", "fit", "encode", "upload", "first frame")
STARTUP = ("context", "renderer", "upload", "first frame")
# In the page's order.
CHARTS = {
    "drawing": draw_times, "error": draw_errors, "memory": draw_memory, "sides": draw_sides,
    "pipeline": lambda report: draw_steps("From the file to the first frame", report, "file", PIPELINE),
    "startup": lambda report: draw_steps("Until the first frame in a fresh process", report, "start", STARTUP),
    "micro": draw_micro, "texture": draw_texture, "paper": draw_paper, "pages": draw_none, "compression": draw_none, "recursion": draw_recursion, "scaling": draw_scaling, "traps": draw_traps,
    "threads": draw_none, "peers": draw_none, "editing": draw_none, "openvg": draw_none, "sweep": draw_sweep, "zoom": draw_zoom}
