#!/usr/bin/env python3
"""Draws the SVG test suite with the vtm command and scores it with the suite's own scorer.

svg_suite.py --vtm VTM [--mode compat|exact] [--keep DIR] [--fails] [--verdicts FILE]
Exit code 1 where a folder falls below its share in WANTED, 77 where the suite is absent.

The suite's references were drawn layer by layer: where green must cover red exactly, they expect the red to show through
along the edge. Exact mode has no red there. A test that fails in exact mode alone is listed as "edges" if the exact
picture is what compat mode comes to as pixels get finer: the mean of its picture at four times the size.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy
from PIL import Image

# Shares of tests that must pass.
WANTED = {"filters": 0.95, "masking": 0.95, "paint-servers": 0.95, "painting": 0.95, "shapes": 0.95,
          "structure": 0.95, "text": 0.95, "all": 0.97}

# The suite's conventions: only its own fonts, 96 dpi, 300 pixels wide.
WIDTH = 300
CONVENTIONS = ["--dpi", "96", "--language", "en", "--no-system-fonts",
               "--serif-family", "Noto Serif", "--sans-serif-family", "Noto Sans", "--cursive-family", "Yellowtail",
               "--fantasy-family", "Sedgwick Ave Display", "--monospace-family", "Noto Mono",
               "--default-family", "Times New Roman", "--default-font-size", "12"]


def suite_folder():
    beside = pathlib.Path(__file__).resolve().parents[2] / "../shared"
    return pathlib.Path(os.environ.get("VTM_SHARED", beside)).resolve() / "svg-suite"


def draw(vtm, suite, tests, mode, width, folder):
    folder.mkdir(parents=True, exist_ok=True)
    batch = folder / "batch.tsv"
    batch.write_text("".join(f"{suite / 'tests' / t}\t{folder / t[:-4]}.png\n" for t in tests))
    done = subprocess.run([vtm, "render", "--batch", batch, "--font-dir", suite / "fonts", "--mode", mode,
                           "--width", str(width), *CONVENTIONS],
                          stderr=subprocess.PIPE, text=True, errors="replace")
    if done.returncode not in (0, 1):
        sys.exit(f"vtm ended with {done.returncode}:\n{done.stderr[-2000:]}")
    return done.stderr.strip().split("\n")[-1]


def score(suite, tests, drawn, references):
    """The tests whose pictures in two folders are alike."""
    result, listed = drawn / "score.json", drawn / "listed.txt"
    listed.write_text("".join(f"{t}\n" for t in tests))
    subprocess.run([sys.executable, suite / "score.py", drawn, "--ref", references, "--list", listed, "--quiet",
                    "--json", result], check=True, stdout=subprocess.DEVNULL)
    return {name for name, verdict in json.loads(result.read_text()).items() if verdict["ok"]}


def save_mean(file, side):
    """In place of a picture the means over squares of pixels, of premultiplied colours."""
    pixels = numpy.asarray(Image.open(file).convert("RGBA")).astype(numpy.float64)
    pixels[..., :3] *= pixels[..., 3:] / 255
    height, width = (n // side for n in pixels.shape[:2])
    means = pixels[:height * side, :width * side].reshape(height, side, width, side, 4).mean(axis=(1, 3))
    means[..., :3] *= 255 / numpy.maximum(means[..., 3:], 1e-9)
    Image.fromarray(numpy.uint8(means + 0.5), "RGBA").save(file)


def edges(vtm, suite, tests, exact, folder):
    """The tests that pass in compat mode, and whose exact pictures are what its pictures come to."""
    finer = 4
    compat, fine = folder / "compat", folder / "fine"
    draw(vtm, suite, tests, "compat", WIDTH, compat)
    passed = sorted(score(suite, tests, compat, suite / "tests"))
    draw(vtm, suite, passed, "compat", finer * WIDTH, fine)
    for test in passed:
        save_mean(fine / (test[:-4] + ".png"), finer)
    return score(suite, passed, exact, fine)


def report(verdicts):
    """Prints a line a folder; whether all are as good as they must be."""
    good, counts = True, {}
    for name, verdict in sorted(verdicts.items()):
        for group in (name.split("/")[0], "all"):
            count = counts.setdefault(group, [0, 0])
            count[0] += verdict != "failed"
            count[1] += 1
    for group, (passed, total) in sorted(counts.items(), key=lambda item: (item[0] == "all", item[0])):
        good = good and passed / total >= WANTED[group]
        print(f"{group:14} {passed:4} of {total:4} = {100 * passed / total:5.1f} %  (at least {100 * WANTED[group]:.0f} %)")
    return good


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--vtm", required=True, type=lambda path: pathlib.Path(path).resolve())
    parser.add_argument("--mode", choices=["compat", "exact"], default="compat")
    parser.add_argument("--keep", type=pathlib.Path, help="leave the pictures here")
    parser.add_argument("--fails", action="store_true", help="name the tests that fail")
    parser.add_argument("--verdicts", type=pathlib.Path,
                        help="write passed, edges or failed for each test as JSON")
    arguments = parser.parse_args()
    suite = suite_folder()
    if not suite.is_dir():
        print(f"skipped: {suite} is absent")
        return 77
    tests = [line for line in (suite / "tests.txt").read_text().split("\n") if line]
    with tempfile.TemporaryDirectory() as temporary:
        folder = (arguments.keep or pathlib.Path(temporary)).resolve()
        print(draw(arguments.vtm, suite, tests, arguments.mode, WIDTH, folder))
        passed = score(suite, tests, folder, suite / "tests")
        failed = [test for test in tests if test not in passed]
        at_edges = set()
        if arguments.mode == "exact" and failed:
            at_edges = edges(arguments.vtm, suite, failed, folder, pathlib.Path(temporary))
    verdicts = {t: "passed" if t in passed else "edges" if t in at_edges else "failed" for t in tests}
    if at_edges:
        print(f"{len(at_edges)} differ at edges alone, as exact mode means them:")
        print("".join(f"    {test}\n" for test in sorted(at_edges)), end="")
    if arguments.fails:
        print("\n".join(test for test in tests if verdicts[test] == "failed"))
    if arguments.verdicts:
        arguments.verdicts.write_text(json.dumps(verdicts))
    return 0 if report(verdicts) else 1


if __name__ == "__main__":
    sys.exit(main())
