#!/usr/bin/env python3
"""Draws the SVG files of a folder with vtm and with other renderers, and lists where they differ.

realfiles.py --vtm VTM FOLDER [--out DIR] [--width 512] [--limit SECONDS] [--explained FILE]

The others are rsvg-convert and resvg, where they are installed. vtm draws in compat mode, as they do. A picture looks
like another if hardly any pixel lies outside of what the other has in the 3 x 3 pixels around it, and the other way
round. Files are drawn one after the other, each by a process of its own. A folder in FOLDER is a source.

Writes DIR/table.tsv and DIR/index.html, worst first, and DIR/sources.tsv. Prints how many files look like a picture on
which the others agree, and names those that do not, those that vtm alone cannot draw, and those for which it takes far
more time or memory. FILE explains them: lines of a path in FOLDER, a tab and a reason.
"""
import argparse
import html
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

import numpy
from PIL import Image

LEAST_DIFFERENCE = 32   # of 255: what antialiasing and rounding may amount to
MANY_PIXELS = 0.003     # of those that are not empty
FEW_PIXELS = 8          # that may differ in any case
FAR_MORE = 5            # times what the costliest of the others takes,
LEAST_SECONDS = 1       # beyond these, which a process takes to start,
LEAST_KILOBYTES = 100 * 1024


class Drawing:
    """What one renderer made of a file."""

    def __init__(self, picture, seconds, kilobytes, message):
        self.picture, self.seconds, self.kilobytes, self.message = picture, seconds, kilobytes, message

    @property
    def failed(self):
        return self.picture is None


def commands(vtm, width):
    """By name: the command that draws FILE into OUT."""
    found = {"vtm": lambda file, out: [vtm, "render", file, "-o", out, "--mode", "compat", "--width", str(width)]}
    if shutil.which("rsvg-convert"):
        found["rsvg"] = lambda file, out: ["rsvg-convert", "--keep-aspect-ratio", "-w", str(width), file, "-o", out]
    if shutil.which("resvg"):
        found["resvg"] = lambda file, out: ["resvg", "-w", str(width), file, out]
    return found


def premultiplied(path):
    pixels = numpy.asarray(Image.open(path).convert("RGBA")).astype(numpy.int32)
    alpha = pixels[..., 3:]
    return numpy.concatenate([(pixels[..., :3] * alpha + 127) // 255, alpha], axis=2)


def high_water(pid, last):
    """The most memory that a process has had, kB. rusage would count that of the interpreter that started it."""
    try:
        with open(f"/proc/{pid}/status") as status:
            return next((int(line.split()[1]) for line in status if line.startswith("VmHWM")), last)
    except OSError:
        return last


def draw(command, out, limit):
    out.unlink(missing_ok=True)
    log = out.with_suffix(".log")
    with open(log, "wb") as said:
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=said)
        end = time.monotonic() + limit
        pid = kilobytes = 0
        while pid == 0 and time.monotonic() < end:
            kilobytes = high_water(process.pid, kilobytes)
            pid, status, used = os.wait4(process.pid, os.WNOHANG)
            time.sleep(0.002 if pid == 0 else 0)
        if pid == 0:
            process.kill()
            _, status, used = os.wait4(process.pid, 0)
        process.returncode = status
    message = log.read_text(errors="replace").strip()
    log.unlink()
    drawn = status == 0 and out.exists()
    return Drawing(premultiplied(out) if drawn else None, used.ru_utime + used.ru_stime, kilobytes, message)


def neighbourhoods(picture):
    """The least and the largest value of each channel in the 3 x 3 pixels around each."""
    padded = numpy.pad(picture, ((1, 1), (1, 1), (0, 0)), mode="edge")
    height, width = picture.shape[:2]
    around = [padded[y:y + height, x:x + width] for y in range(3) for x in range(3)]
    return numpy.minimum.reduce(around), numpy.maximum.reduce(around)


def outside(picture, other):
    low, high = neighbourhoods(other)
    return numpy.maximum(low - picture, picture - high).max(axis=2) > LEAST_DIFFERENCE


def difference(a, b):
    """Pixels that differ, as a multiple of those that may; nothing where sizes differ by more than rounding."""
    if max(abs(a.shape[0] - b.shape[0]), abs(a.shape[1] - b.shape[1])) > 1:
        return None
    height, width = min(a.shape[0], b.shape[0]), min(a.shape[1], b.shape[1])
    a, b = a[:height, :width], b[:height, :width]
    wrong = numpy.count_nonzero(outside(a, b) | outside(b, a))
    filled = numpy.count_nonzero((a[..., 3] > 0) | (b[..., 3] > 0))
    return wrong / max(FEW_PIXELS, MANY_PIXELS * filled)


class Row:
    def __init__(self, path, reason, drawings):
        self.path, self.reason, self.drawings = path, reason, drawings
        own = drawings["vtm"]
        others = {name: d for name, d in drawings.items() if name != "vtm"}
        self.differences = {}
        for name, drawing in others.items():
            if not drawing.failed:
                share = None if own.failed else difference(own.picture, drawing.picture)
                self.differences[name] = float("inf") if share is None else share
        self.agreed = len(self.differences) == len(others) and agree([d.picture for d in others.values()])
        self.worst = max(self.differences.values(), default=0)
        self.alike = min(self.differences.values(), default=float("inf")) <= 1
        self.failed = own.failed and bool(self.differences)
        self.slow = own.seconds > max(LEAST_SECONDS, FAR_MORE * max(d.seconds for d in others.values()))
        self.large = own.kilobytes > max(LEAST_KILOBYTES, FAR_MORE * max(d.kilobytes for d in others.values()))

    @property
    def source(self):
        return self.path.parts[0] if len(self.path.parts) > 1 else "."

    @property
    def faults(self):
        """What asks for an explanation, in words."""
        words = {"differs": self.agreed and not self.alike, "fails": self.failed, "takes long": self.slow,
                 "takes much memory": self.large}
        return ", ".join(word for word, holds in words.items() if holds)

    def cells(self, names):
        cells = [str(self.path), "" if self.agreed else "others differ"]
        for name in names:
            drawing = self.drawings[name]
            cells += ["failed" if drawing.failed else f"{self.differences.get(name, 0):.2f}",
                      f"{drawing.seconds:.3f}", f"{drawing.kilobytes // 1024}"]
        return cells + [self.reason]


def agree(pictures):
    shares = [difference(pictures[0], picture) for picture in pictures[1:]]
    return all(share is not None and share <= 1 for share in shares)


def page(rows, names, folder):
    heads = ["file", "peers"] + [f"{name} {what}" for name in names for what in ("difference", "CPU s", "MiB")]
    with open(folder / "table.tsv", "w") as table:
        for cells in [heads + ["reason"]] + [row.cells(names) for row in rows]:
            table.write("\t".join(cells) + "\n")
    with open(folder / "index.html", "w") as text:
        text.write("<!DOCTYPE html><meta charset='utf-8'><title>Real files</title>"
                   "<style>img{width:256px;background:#fff;border:1px solid #ccc}td{vertical-align:top}</style><table>")
        for row in rows:
            pictures = "".join(f"<td><img src='{picture_name(row.path, name)}' alt='{name}'><br>{name}"
                               for name in names)
            said = html.escape(row.drawings["vtm"].message[:600])
            text.write(f"<tr><td colspan={len(names)}><b>{html.escape(' '.join(row.cells(names)))}</b><br>{said}"
                       f"<tr>{pictures}\n")
        text.write("</table>")


def sources(rows, folder):
    """A line for each source: on how many of its files the others agree, and what vtm makes of them."""
    found = sorted({row.source for row in rows})
    with open(folder / "sources.tsv", "w") as table:
        table.write("source\tfiles\tothers agree\talike\tfailed\n")
        for source in found:
            own = [row for row in rows if row.source == source]
            agreed = [row for row in own if row.agreed]
            counts = len(own), len(agreed), sum(row.alike for row in agreed), sum(row.failed for row in own)
            table.write("\t".join([source, *map(str, counts)]) + "\n")
    return found


def picture_name(path, name):
    return f"{re.sub('[^A-Za-z0-9_.-]', '_', '__'.join(path.parts))}.{name}.png"


def explanations(file):
    lines = file.read_text().splitlines() if file else []
    return dict(line.split("\t", 1) for line in lines if "\t" in line)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--vtm", required=True)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("realfiles"))
    parser.add_argument("--width", type=int, default=512)
    parser.add_argument("--limit", type=float, default=60, help="seconds for a file")
    parser.add_argument("--explained", type=pathlib.Path, help="reasons for files that differ")
    options = parser.parse_args()
    files = sorted(f for f in options.folder.rglob("*") if f.suffix in (".svg", ".svgz"))
    if not files:
        sys.exit(f"{options.folder}: there are no SVG files in it")
    options.out.mkdir(parents=True, exist_ok=True)
    renderers = commands(options.vtm, options.width)
    if len(renderers) == 1:
        sys.exit("neither rsvg-convert nor resvg is installed")
    reasons = explanations(options.explained)
    rows = []
    for file in files:
        path = file.relative_to(options.folder)
        drawings = {}
        for name, command in renderers.items():
            out = options.out / picture_name(path, name)
            drawings[name] = draw(command(str(file), str(out)), out, options.limit)
        row = Row(path, reasons.get(str(path), ""), drawings)
        for drawing in drawings.values():
            drawing.picture = drawing.picture if drawing.failed else True  # only that it is there counts from here on
        rows.append(row)
    rows.sort(key=lambda row: -row.worst)
    page(rows, list(renderers), options.out)
    found = sources(rows, options.out)
    agreed = [row for row in rows if row.agreed]
    alike = sum(row.alike for row in agreed)
    print(f"{len(rows)} files of {len(found)} sources; the others agree on {len(agreed)}, "
          f"vtm looks like them in {alike}" + (f" ({100 * alike / len(agreed):.1f} %)" if agreed else ""))
    for name in renderers:
        drawn = [row.drawings[name] for row in rows]
        print(f"{name:6} CPU {sum(d.seconds for d in drawn):8.1f} s, failed {sum(d.failed for d in drawn)}, "
              f"largest {max(d.kilobytes for d in drawn) // 1024} MiB")
    for row in rows:
        if row.faults:
            print(f"{row.path} {row.faults}: {row.reason or 'not explained'}")
    print(f"{options.out / 'index.html'}")


if __name__ == "__main__":
    main()
