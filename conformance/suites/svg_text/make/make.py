#!/usr/bin/python3
"""Writes the cases of this suite: NAME.svg, text, and NAME.paths.svg, the same picture as outlines.

The outlines are those of the font files, read by fontTools, at places that are computed here from the
specifications; nothing of the library under test is used. With --mutants FOLDER: a copy of the suite, whose texts
lack what their case is about; every case of it must fail.
"""
import argparse
import pathlib
import re
import shutil

from layout import BLUE, SIZE
from registry import CASES
import cases  # noqa: F401  (fills CASES)

SUITE = pathlib.Path(__file__).parent.parent
ROOT = 'xmlns="http://www.w3.org/2000/svg" viewBox="0 0 200 200" width="200" height="200"'


def document(about, body, extra=""):
    comment = f"<!-- {about} -->\n"
    return f'{comment}<svg {ROOT} fill="{BLUE}"{extra}>\n{body.strip()}\n</svg>\n'


def text_document(case, body):
    links = ' xmlns:xlink="http://www.w3.org/1999/xlink"' if "xlink:" in body else ""
    return document(case.about, body, f' font-family="VTM Test" font-size="{SIZE}"{links}')


def write(folder, mutants):
    for case in CASES:
        file = folder / f"{case.name}.svg"
        file.parent.mkdir(parents=True, exist_ok=True)
        body = case.text
        if mutants:
            body = re.sub(case.key, case.without, body)
            assert body != case.text, f"{case.name}: there is no {case.key}"
        file.write_text(text_document(case, body))
        file.with_suffix(".paths.svg").write_text(document("Outlines of the text.", case.paths))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--mutants", type=pathlib.Path, metavar="FOLDER")
    arguments = parser.parse_args()
    if not arguments.mutants:
        return write(SUITE, False)
    shutil.copytree(SUITE / "fonts", arguments.mutants / "fonts", dirs_exist_ok=True)
    shutil.copy(SUITE / "suite.json", arguments.mutants)
    write(arguments.mutants, True)


if __name__ == "__main__":
    main()
