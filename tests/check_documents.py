#!/usr/bin/env python3
"""Every link, path and command in our Markdown files exists.

check_documents.py [ROOT]: dead ones are printed as file:line: message, exit code 1.
check_documents.py --self-test: the check must catch planted ones.

- [text](target): a relative target exists (anchors and web addresses are not followed).
- `path` and words of fenced code: what starts with a folder or file of the root exists; `*` matches.
- ./dev COMMAND: the command stands in the script. vtm SUBCOMMAND: its file stands in tools/commands.
"""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

LINK = re.compile(r"\[[^\]]*\]\(([^)#\s]+)[^)]*\)")
CODE = re.compile(r"`([^`]+)`")
PATH = re.compile(r"\.?[\w.*+-]+(/[\w.*+-]+)+/?")
MADE = ("build/", "out/")  # what building and the examples' commands write


def documents(root):
    listed = subprocess.run(["git", "-C", root, "ls-files", "-co", "--exclude-standard", "*.md"],
                            capture_output=True, text=True)
    if listed.returncode == 0:
        return sorted(root / name for name in listed.stdout.split())
    return sorted(root.rglob("*.md"))


def dead_paths(root, words):
    """Words that name something below an existing top-level entry of ours that is not there."""
    for word in words:
        path = word.removeprefix("./")
        if not PATH.fullmatch(path) or path.startswith(MADE) or not (root / path.split("/")[0]).is_dir():
            continue
        if not any(root.glob(path.rstrip("/"))):
            yield f"{word} does not exist"


def dead_commands(root, code):
    script = root / "dev"
    names = re.findall(r"^    ([a-z| -]+)\)", script.read_text(), re.M) if script.is_file() else []
    commands = {c for name in names for c in name.replace(" ", "").split("|")}
    for command in re.findall(r"(?:^|\s)\./dev ([a-z-]+)", code):
        if command not in commands:
            yield f"./dev {command}: no such command"
    for sub in re.findall(r"^(?:\$ )?(?:\./dev )?vtm ([a-z]+)\b(?! =)", code):
        if not (root / f"tools/commands/{sub}.cpp").is_file():
            yield f"vtm {sub}: no such subcommand"


def dead_links(document, line):
    for target in LINK.findall(line):
        if not re.match(r"[a-z]+:", target) and not (document.parent / target).exists():
            yield f"link to {target}, which does not exist"


def faults_of(root, document):
    fenced = False
    for number, line in enumerate(document.read_text(encoding="utf-8").splitlines(), 1):
        if line.lstrip().startswith("```"):
            fenced = not fenced
            continue
        pieces = [line] if fenced else CODE.findall(line)
        faults = [] if fenced else list(dead_links(document, line))
        for piece in pieces:
            faults += dead_commands(root, piece)
            if fenced or " " not in piece:
                faults += dead_paths(root, re.split(r"[\s,;:()'\"=]+", piece))
        for fault in faults:
            yield f"{document.relative_to(root)}:{number}: {fault}"


def faults(root):
    return [fault for document in documents(root) for fault in faults_of(root, document)]


def self_test():
    script = 'case $command in\n    setup | render) x ;;\n    asan | ubsan) x ;;\nesac\n'
    good = ["[a](README.md) [b](https://example.org/x) [c](docs/a.md#part)", "`docs/a.md` `docs/*.md` `n/a` `GL_A/B`",
            "```sh\n./dev setup\n./dev ubsan\n./dev render docs/a.md -o out/a.png\nvtm render x.svg\n```"]
    bad = ["[a](docs/gone.md)", "`docs/gone.md`", "`docs/*.txt`", "```\n./dev gone\n```", "`./dev gone`",
           "```\n./dev setup docs/gone.svg\n```", "```\nvtm gone x\n```"]
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name in ("docs", "tools/commands"):
            (root / name).mkdir(parents=True)
        (root / "dev").write_text(script)
        (root / "tools/commands/render.cpp").touch()
        (root / "docs/a.md").touch()
        wrong = []
        for text, expected in [(t, 0) for t in good] + [(t, 1) for t in bad]:
            (root / "README.md").write_text(text + "\n")
            if bool(faults(root)) != bool(expected):
                wrong.append(text)
    for text in wrong:
        print(f"self-test: judged wrongly: {text!r}")
    return 1 if wrong else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("root", nargs="?", default=pathlib.Path(__file__).resolve().parent.parent, type=pathlib.Path)
    parser.add_argument("--self-test", action="store_true")
    arguments = parser.parse_args()
    if arguments.self_test:
        return self_test()
    found = faults(arguments.root)
    print("\n".join(found) if found else "documents: every link, path and command exists")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
