#!/usr/bin/env python3
"""Instructions of the compiler, counted by callgrind, against recorded numbers.

instructions.py PROGRAM KEY [--record] [--only NAME]: bench_encode on some drawings; exit code 1 if a count lies more
than BAND away from bench/instructions.json, either way: a number that has become too kind would hide the next loss.
instructions.py PROGRAM KEY --self-test: a program that does its work twice, and a lowered number, must both fail.

KEY names compiler and flags, which numbers depend on. Exit code 77, skipped: valgrind is absent or cannot start (it needs
/proc), or nothing is recorded for the key. Counted are instructions inside compiler::compile, on one processor, so that no scheduling counts.
"""
import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
NUMBERS = ROOT / "bench" / "instructions.json"
BAND = 0.02  # two runs differ by less than a hundred-thousandth; the C library picks its routines by processor
SKIPPED = 77


def drawings():
    shared = pathlib.Path(os.environ.get("VTM_SHARED", ROOT.parent / "shared"))
    files = [ROOT / "examples" / f"{name}.svg" for name in ("lighthouse", "rose_window", "gauge")]
    files.append(shared / "corpus" / "tiger.svg")
    return files


def why_not():
    """What keeps valgrind from running any program at all, or None."""
    if not shutil.which("valgrind"):
        return "valgrind is not installed"
    run = subprocess.run(["valgrind", "--tool=none", "true"], capture_output=True, text=True)
    if run.returncode == 0:
        return None
    lines = run.stderr.splitlines() or [f"exit code {run.returncode}"]
    return f"valgrind cannot start: {next((line for line in lines if 'FATAL' in line), lines[-1])}"


def one_processor():
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})


def count(program, drawing, times=1):
    with tempfile.TemporaryDirectory() as folder:
        command = ["valgrind", "--tool=callgrind", "--toggle-collect=vtm::compiler::compile(*",
                   f"--callgrind-out-file={folder}/out", str(program), str(drawing), str(times)]
        run = subprocess.run(command, capture_output=True, text=True, preexec_fn=one_processor)
    found = re.search(r"Collected\s*:\s*(\d+)", run.stderr)
    if run.returncode != 0 or not found or int(found.group(1)) == 0:
        sys.exit(f"{drawing.name} could not be counted:\n{run.stderr}")
    return int(found.group(1))


def judge(name, counted, recorded):
    """Prints a line; whether the count is within the band."""
    change = counted / recorded - 1
    within = abs(change) <= BAND
    print(f"{name:<12} {counted:>13} recorded {recorded:>13} {change:+7.2%}  {'ok' if within else 'OUTSIDE ' + f'{BAND:.0%}'}")
    return within


def recorded_numbers():
    return json.loads(NUMBERS.read_text()) if NUMBERS.exists() else {}


def record(program, key, files):
    numbers = recorded_numbers()
    for drawing in files:
        numbers.setdefault(key, {})[drawing.stem] = count(program, drawing)
        print(f"{drawing.stem:<12} {numbers[key][drawing.stem]:>13}")
    NUMBERS.write_text(json.dumps(numbers, indent=2, sort_keys=True) + "\n")


def check(program, key, files):
    numbers = recorded_numbers()[key]
    within = [judge(f.stem, count(program, f), numbers[f.stem]) for f in files if f.stem in numbers]
    if not all(within):
        print("If the change is meant: ./dev bench instructions --record")
    return 0 if within and all(within) else 1


def self_test(program):
    drawing = drawings()[0]
    once = count(program, drawing)
    accepts = judge("the same", count(program, drawing), once)
    slowed = judge("twice", count(program, drawing, 2), once)
    lowered = judge("lowered", once, int(once * (1 - 2 * BAND)))
    return 0 if accepts and not slowed and not lowered else 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("key")
    parser.add_argument("--record", action="store_true")
    parser.add_argument("--self-test", action="store_true")
    parser.add_argument("--only", help="this drawing")
    a = parser.parse_args()
    obstacle = why_not()
    if obstacle:
        print(f"skipped: {obstacle}")
        return SKIPPED
    if not a.record and not a.self_test and a.key not in recorded_numbers():
        print(f"skipped: nothing is recorded for '{a.key}'")
        return SKIPPED
    if a.self_test:
        return self_test(a.program)
    files = [f for f in drawings() if not a.only or f.stem == a.only]
    for absent in [f for f in files if not f.exists()]:
        print(f"skipped: {absent.name} is absent")
    present = [f for f in files if f.exists()]
    if a.record:
        record(a.program, a.key, present)
        return 0
    return check(a.program, a.key, present)


if __name__ == "__main__":
    sys.exit(main())
