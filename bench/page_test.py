#!/usr/bin/env python3
"""The page and the README's table from a real run of some reports: page_test.py VTM_BENCH"""
import html.parser
import pathlib
import re
import subprocess
import sys
import tempfile

import page

VOID = {"meta", "br"}


class Nesting(html.parser.HTMLParser):
    """Fails where tags do not close in order, or where something outside of the page is referred to."""

    def __init__(self):
        super().__init__()
        self.open = []

    def handle_starttag(self, tag, attributes):
        if tag not in VOID:
            self.open.append(tag)
        for name, value in attributes:
            if name in ("src", "href", "data") and not value.startswith("#"):
                raise AssertionError(f"{tag} refers to {value}")

    def handle_endtag(self, tag):
        assert self.open.pop() == tag, f"</{tag}> at {self.getpos()}"


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        subprocess.run([sys.argv[1], "drawing", "error", "texture", "--quick", "--examples", "--only", "tree",
                        "--output", name], check=True, stdout=subprocess.DEVNULL)
        readme = folder / "README.md"
        readme.write_text(f"before\n{page.START}\noutdated\n{page.END}\nafter\n")
        script = pathlib.Path(page.__file__)
        for _ in range(2):  # the second time replaces what the first has written
            subprocess.run([sys.executable, script, name, "--readme", readme], check=True, stdout=subprocess.DEVNULL)
        text = (folder / "index.html").read_text()
        nesting = Nesting()
        nesting.feed(text)
        assert not nesting.open, nesting.open
        assert text.count("<svg") >= 8, "plots are missing"
        table = readme.read_text()
        assert table.startswith("before\n") and table.endswith("after\n") and "outdated" not in table
        assert table.count("| VTM, CPU | 1 | 1 |") == 1, table
        assert re.search(r"\d{4}-\d\d-\d\d", table), "no date"


if __name__ == "__main__":
    main()
