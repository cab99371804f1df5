#!/usr/bin/env python3
"""Draws the SVG test suite with the vtm command and scores it with the suite's own scorer.

svg_suite.py --vtm VTM [--keep DIR] [--fails] [--verdicts FILE]
Exit code 1 where a folder falls below its share in WANTED, 77 where the suite is absent.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

# Shares of tests that must pass.
WANTED = {"filters": 0.95, "masking": 0.95, "paint-servers": 0.95, "painting": 0.95, "shapes": 0.95,
          "structure": 0.95, "text": 0.95}

# The suite's conventions: only its own fonts, 96 dpi, width 300. Its references were drawn layer by
# layer: where green must cover red exactly, they expect the red to show through along the edge.
CONVENTIONS = ["--mode", "compat", "--width", "300", "--dpi", "96", "--language", "en", "--no-system-fonts",
               "--serif-family", "Noto Serif", "--sans-serif-family", "Noto Sans", "--cursive-family", "Yellowtail",
               "--fantasy-family", "Sedgwick Ave Display", "--monospace-family", "Noto Mono",
               "--default-family", "Times New Roman", "--default-font-size", "12"]


def suite_folder():
    beside = pathlib.Path(__file__).resolve().parents[2] / "../shared"
    return pathlib.Path(os.environ.get("VTM_SHARED", beside)).resolve() / "svg-suite"


def draw(vtm, suite, folder):
    tests = [line for line in (suite / "tests.txt").read_text().split("\n") if line]
    batch = folder / "batch.tsv"
    batch.write_text("".join(f"{suite / 'tests' / t}\t{folder / t[:-4]}.png\n" for t in tests))
    done = subprocess.run([vtm, "render", "--batch", batch, "--font-dir", suite / "fonts", *CONVENTIONS],
                          stderr=subprocess.PIPE, text=True, errors="replace")
    if done.returncode not in (0, 1):
        sys.exit(f"vtm ended with {done.returncode}:\n{done.stderr[-2000:]}")
    print(done.stderr.strip().split("\n")[-1])


def score(suite, folder):
    """Passed and all tests by folder, and whether each passed, by name."""
    result = folder / "score.json"
    subprocess.run([sys.executable, suite / "score.py", folder, "--quiet", "--json", result],
                   check=True, stdout=subprocess.DEVNULL)
    counts, passed = {}, {}
    for name, verdict in json.loads(result.read_text()).items():
        count = counts.setdefault(name.split("/")[0], [0, 0])
        count[0] += verdict["ok"]
        count[1] += 1
        passed[name] = verdict["ok"]
    return counts, passed


def report(counts):
    """Prints a line a folder; whether all are as good as they must be."""
    good = True
    for top, (passed, total) in sorted(counts.items()):
        share = passed / total
        wanted = WANTED.get(top, 0)
        good = good and share >= wanted
        print(f"{top:14} {passed:4} of {total:4} = {100 * share:5.1f} %  (at least {100 * wanted:.0f} %)")
    passed, total = (sum(c[i] for c in counts.values()) for i in (0, 1))
    print(f"{'all':14} {passed:4} of {total:4} = {100 * passed / total:5.1f} %")
    return good


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--vtm", required=True, type=lambda path: pathlib.Path(path).resolve())
    parser.add_argument("--keep", type=pathlib.Path, help="leave the pictures here")
    parser.add_argument("--fails", action="store_true", help="name the tests that fail")
    parser.add_argument("--verdicts", type=pathlib.Path, help="write what passed as JSON, by the tests' names")
    arguments = parser.parse_args()
    suite = suite_folder()
    if not suite.is_dir():
        print(f"skipped: {suite} is absent")
        return 77
    with tempfile.TemporaryDirectory() as temporary:
        folder = (arguments.keep or pathlib.Path(temporary)).resolve()
        folder.mkdir(parents=True, exist_ok=True)
        draw(arguments.vtm, suite, folder)
        counts, passed = score(suite, folder)
    if arguments.fails:
        print("\n".join(name for name in passed if not passed[name]))
    if arguments.verdicts:
        arguments.verdicts.write_text(json.dumps(passed))
    return 0 if report(counts) else 1


if __name__ == "__main__":
    sys.exit(main())
