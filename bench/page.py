#!/usr/bin/env python3
"""vtm-bench's results as one page, page.py [FOLDER] [--readme FILE]

Reads FOLDER/*.json (build/bench) and writes FOLDER/index.html, which needs nothing else, and FOLDER/zoom.svg for the
documents. With --readme, the table between FILE's bench markers is replaced. docs/benchmarks.md says what all means.
"""
import argparse
import html
import json
import pathlib
import re
import statistics
import sys

from charts import CHARTS, VIEWS, draw_balance, draw_recursion, draw_zoom, engines_of, errors_of, files_alike, name_of, spread, times_of

START, END = "<!-- bench: written by ./dev bench --record -->", "<!-- /bench -->"
STYLE = """
:root { color-scheme: light dark; --ink: #1c1c1c; --faint: #ddd; --ground: #fff; --c2: #06c; --c7: #666; --c11: #444; }
@media (prefers-color-scheme: dark) { :root { --ink: #e4e4e4; --faint: #3a3a3a; --ground: #16181c; --c0: #ff6b6b;
  --c2: #5aa9ff; --c3: #4ec04e; --c4: #d070d0; --c6: #c99a60; --c7: #aaa; --c11: #bbb; } }
body { background: var(--ground); color: var(--ink); font: 15px/1.5 sans-serif; max-width: 1000px; margin: 2em auto; padding: 0 1em; }
svg { max-width: 100%; height: auto; } summary { cursor: pointer; } .wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: 13px; margin: 1em 0; } td, th { padding: 2px 8px; border-bottom: 1px solid var(--faint); text-align: right; white-space: nowrap; }
td:first-child, th:first-child { text-align: left; } .ours td { font-weight: bold; } figure { margin: 1em 0; } li { margin-left: 1.2em; }
"""


def prose(text):
    """Our reports' Markdown: paragraphs, lists, code, links to documents (which do not come along)."""
    text = re.sub(r"`([^`]+)`", r"<code>\1</code>", html.escape(text))
    text = re.sub(r"\[([^\]]+)\]\([^)]*\)", r"\1", text)
    blocks = re.split(r"\n(?=- )|\n\n", text)
    return "".join(f"<li>{block[2:]}</li>" if block.startswith("- ") else f"<p>{block}</p>" for block in blocks if block.strip())


def rounded(value):
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def table(rows):
    """Rows of equal keys as HTML."""
    if not rows:
        return ""
    head = "".join(f"<th>{html.escape(key)}</th>" for key in rows[0])
    body = "".join("<tr>" + "".join(f"<td>{html.escape(rounded(v))}</td>" for v in row.values()) + "</tr>" for row in rows)
    return f'<div class="wide"><table><tr>{head}</tr>{body}</table></div>'


def median_of(dots, form):
    return form.format(statistics.median(v for v, _ in dots)) if dots else "–"


def quartiles_of(dots):
    """Median and quartiles over the files."""
    if not dots:
        return "–"
    values = [value for value, _ in dots] * (2 if len(dots) == 1 else 1)
    low, middle, high = (f"{v:.0f}" if v >= 10 else f"{v:.2g}" for v in statistics.quantiles(values, n=4, method="inclusive"))
    return middle if low == middle == high else f"{middle} ({low}–{high})"


def headline(reports):
    """A row an engine: medians over the files that it draws as we do."""
    drawing, error, memory = (reports.get(name) for name in ("drawing", "error", "memory"))
    rows = []
    for engine in engines_of(drawing) if drawing else ():
        alike = files_alike(drawing, engine)
        row = {"engine": name_of(engine)}
        for views in VIEWS:
            row[views] = quartiles_of(times_of(drawing, engine, views))
        for pixels in (1024, 64) if error else ():
            mean, tail = (errors_of(error, engine, pixels, alike, column) for column in ("mean", "p99.9"))
            row[f"error, {pixels} px"] = median_of(mean, "{:.3f}") + median_of(tail, " / {:.0f}")
        if memory:
            row["MB"] = median_of(spread(memory, engine, lambda r: r["MB"]), "{:.0f}")
        row["files"] = len(alike)
        rows.append(row)
    return rows


def machine_of(reports):
    """Of the latest of the reports that say it."""
    known = [report["machine"] for report in reports.values() if "machine" in report]
    return max(known, key=lambda machine: machine["date"]) if known else None


def said(machine):
    if machine is None:
        return "The machine was not recorded."
    return (f"{machine['processor']}, {machine['cores']} cores, {machine['system']}, {machine['driver']}; "
            f"{machine['compiler']}; {machine['date']}.")


OPEN = ("paper",)  # whose table is the point
CAPTION = ("Times as ratios to VTM's on the CPU (CPU time on one processor, paired in one run); mean errors against exact truth "
           "and 99.9th percentiles, in 255ths; MB of peak memory from the file to 1024 pixels. Medians over the files that an engine draws as we do, in "
           "brackets the quartiles: rows of fewer files are of easier pictures. “VTM, as it is” is the renderer with default options, which scans on the "
           "CPU where there is no GPU, as here if the driver below is llvmpipe. Skia and Blend2D read no SVG and are given our paths, also when cold.")


def quick_of(reports):
    quick = [name for name, report in reports.items() if report.get("quick")]
    return f" Quick runs, of some of the files in few rounds: {', '.join(quick)}." if quick else ""


def section(name, report):
    plots = "".join(f"<figure>{picture}</figure>" for picture in CHARTS[name](report)) if report["rows"] else ""
    rows = report.get("summary") or ([] if name in ("sweep", "zoom") else report["rows"])
    when = f"<p>{html.escape(said(report['machine']))} Load {report['machine']['load']:.1f}. It took {report['seconds']:.0f} s.</p>" if "machine" in report else ""
    notes = "".join(f"<li>{html.escape(note)}</li>" for note in report.get("notes", ()))
    return (f'<h2 id="{name}">{html.escape(report.get("title", name))}</h2>{prose(report.get("text", ""))}{plots}'
            f"<details{' open' if name in OPEN or not plots else ''}><summary>Figures</summary>{table(rows)}<ul>{notes}</ul>{when}</details>")


def page(reports):
    missing = [name for name in CHARTS if name not in reports]
    links = " · ".join(f'<a href="#{name}">{name}</a>' for name in CHARTS if name in reports)
    absent = f"<p>Not measured: {', '.join(missing)}.</p>" if missing else ""
    balance = f"<figure>{draw_balance(reports['drawing'], reports['error'])}</figure>" if {"drawing", "error"} <= reports.keys() else ""
    sections = "\n".join(section(name, reports[name]) for name in CHARTS if name in reports)
    return (f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">'
            f"<title>VTM: benchmarks</title><style>{STYLE}</style></head><body>\n<h1>VTM: benchmarks</h1>\n"
            f"<p>{html.escape(said(machine_of(reports)))}{quick_of(reports)}</p>{absent}\n<p>{links}</p>\n{table(headline(reports))}<p>{CAPTION}</p>\n"
            f"{balance}{sections}\n</body></html>\n")


def markdown(reports):
    rows = headline(reports)
    lines = ["| " + " | ".join(rows[0]) + " |", "|---" + "|--:" * (len(rows[0]) - 1) + "|"]
    lines += ["| " + " | ".join(str(value) for value in row.values()) + " |" for row in rows]
    return "\n".join([CAPTION, "", *lines, "", said(machine_of(reports)) + quick_of(reports)])


def write_readme(path, reports):
    before, rest = path.read_text().split(START)
    path.write_text(f"{before}{START}\n{markdown(reports)}\n{END}{rest.split(END)[1]}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", type=pathlib.Path, default=pathlib.Path(__file__).parent / "results")
    parser.add_argument("--readme", type=pathlib.Path)
    a = parser.parse_args()
    reports = {name: json.loads((a.folder / f"{name}.json").read_text()) for name in CHARTS if (a.folder / f"{name}.json").exists()}
    if not reports:
        sys.exit(f"{a.folder}: no results")
    (a.folder / "index.html").write_text(page(reports))
    print(a.folder / "index.html")
    for name, draw in (("zoom", draw_zoom), ("recursion", draw_recursion)):
        if name in reports:
            (a.folder / f"{name}.svg").write_text(next(draw(reports[name])))
    if a.readme:
        if not headline(reports):
            sys.exit(f"{a.folder}: no drawing.json, which the table is made of")
        write_readme(a.readme, reports)


if __name__ == "__main__":
    main()
