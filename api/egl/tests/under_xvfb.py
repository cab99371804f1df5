#!/usr/bin/env python3
"""under_xvfb.py PROGRAM ARGUMENTS...: runs the program with an X server of its own.

Exit code 77, skipped, if there is no Xvfb; else the program's.
"""
import os
import shutil
import subprocess
import sys


def main():
    if not shutil.which("Xvfb"):
        print("skipped: Xvfb is not installed")
        return 77
    reader, writer = os.pipe()
    server = subprocess.Popen(["Xvfb", "-displayfd", str(writer), "-screen", "0", "320x240x24", "-nolisten", "tcp"],
                              pass_fds=[writer], stderr=subprocess.DEVNULL)
    os.close(writer)
    try:
        with os.fdopen(reader) as numbers:
            number = numbers.readline().strip()
        if not number:
            print("skipped: Xvfb does not start")
            return 77
        environment = {**os.environ, "DISPLAY": f":{number}", "EGL_PLATFORM": "x11"}
        return subprocess.run(sys.argv[1:], env=environment, check=False, timeout=240).returncode
    finally:
        server.terminate()
        server.wait()


if __name__ == "__main__":
    sys.exit(main())
