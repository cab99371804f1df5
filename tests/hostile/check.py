#!/usr/bin/env python3
"""Renders hostile files under limits: each must end in time and memory, with a picture or a spoken error.

check.py VTM FOLDER [--full] [--engine E] [--only NAME...]

Files are made below FOLDER and removed again. What is measured is the command's CPU time and its largest
resident memory; wall time, which depends on who else is at work, only has to be sane.
"""
import argparse
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from files import FILES  # noqa: E402

# Beyond the limits: a tenth, and what starting and ending a process takes.
SHARE, START_SECONDS, START_MEGABYTES = 1.1, 0.3, 30


def run(command):
    """Exit code, stderr, CPU seconds, wall seconds, peak MB."""
    with tempfile.TemporaryFile() as errors:
        start = time.monotonic()
        child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=errors)
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        wall = time.monotonic() - start
        errors.seek(0)
        text = errors.read().decode(errors="replace")
    return child.returncode, text, usage.ru_utime + usage.ru_stime, wall, usage.ru_maxrss / 1024


def faults(code, text, cpu, wall, peak, seconds, megabytes, source, picture):
    if code not in (0, 1):
        yield f"ended with {code}"
    if code == 0 and not picture.exists():
        yield "no picture, no error"
    if code == 1 and not any(line.startswith(str(source)) and "warning:" not in line for line in text.splitlines()):
        yield f"no error that names the file: {text[-200:]!r}"
    if cpu > SHARE * seconds + START_SECONDS:
        yield f"took {cpu:.2f} s of CPU time"
    if wall > 20 * seconds:
        yield f"took {wall:.1f} s"
    if peak > SHARE * megabytes + START_MEGABYTES:
        yield f"took {peak:.0f} MB"


def make(name, scale, path):
    pathlib.Path(path).write_bytes(FILES[name](int(scale)))


def main():
    if sys.argv[1:2] == ["--make"]:
        return make(*sys.argv[2:])
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("vtm", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--full", action="store_true", help="ten times as large files, 4 s and 900 MB")
    parser.add_argument("--engine", default="cpu")
    parser.add_argument("--only", nargs="*", default=list(FILES))
    arguments = parser.parse_args()
    scale, seconds, megabytes = (10, 4, 900) if arguments.full else (1, 1, 300)
    arguments.folder.mkdir(parents=True, exist_ok=True)
    # A small stack shows recursions.
    resource.setrlimit(resource.RLIMIT_STACK, (8 << 20, resource.getrlimit(resource.RLIMIT_STACK)[1]))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    bad = 0
    for name in arguments.only:
        source, picture = arguments.folder / f"{name}.svg", arguments.folder / f"{name}.png"
        # In a process of its own: a child's peak begins with what its parent holds.
        subprocess.run([sys.executable, __file__, "--make", name, str(scale), source], check=True)
        picture.unlink(missing_ok=True)
        result = run([arguments.vtm, "render", source, "-o", picture, "--engine", arguments.engine,
                      "--max-seconds", str(seconds), "--max-memory", str(megabytes)])
        found = list(faults(*result, seconds, megabytes, source, picture))
        code, text, cpu, wall, peak = result
        last = text.strip().splitlines()[-1].replace(str(arguments.folder) + "/", "") if text.strip() else ""
        print(f"{'FAILED' if found else 'ok':6} {name:28} {code:3} {cpu:6.2f} s {peak:6.0f} MB  {last[:110]}")
        for fault in found:
            print(f"       {fault}")
        sys.stdout.flush()
        bad += bool(found)
        source.unlink()
        picture.unlink(missing_ok=True)
    print(f"{len(arguments.only) - bad} of {len(arguments.only)} hostile files held")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
