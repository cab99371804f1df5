#!/usr/bin/env python3
"""Makes the command's man page and shell completions from its own --help.

pages.py VTM FOLDER: writes vtm.1.gz, vtm.bash, _vtm and vtm.fish.
"""
import dataclasses
import gzip
import pathlib
import re
import subprocess
import sys

HEADING = re.compile(r"^(\S.*):$")
# "  -o,--output TEXT:{a,b} ... Excludes: x   What it does", or with the description on lines of their own.
ENTRY = re.compile(r"^  (\S.*?)(?:\s{2,}(\S.*))?$")
FLAG = re.compile(r"--?[A-Za-z][\w-]*")
CHOICES = re.compile(r"\{([\w,.+-]+)\}")


@dataclasses.dataclass
class Entry:
    head: str  # as written: names, type, default
    text: str

    @property
    def flags(self):
        """Empty for positional arguments and subcommands."""
        names = self.head.split()[0] if self.head.startswith("-") else ""
        return [part.split("{")[0] for part in names.split(",") if FLAG.match(part)]

    @property
    def takes_value(self):
        return len(re.sub(r"(Excludes|Needs):.*", "", self.head).split()) > 1

    @property
    def choices(self):
        found = CHOICES.search(self.head.partition(" ")[2])
        return found[1].split(",") if found else []


@dataclasses.dataclass
class Help:
    what: str
    usage: str
    sections: dict  # heading: entries
    footer: list  # paragraphs

    def entries(self):
        return [entry for section in self.sections.values() for entry in section]


def parse(text):
    page, section = Help("", "", {}, []), None
    for line in text.splitlines():
        heading, entry = HEADING.match(line), ENTRY.match(line)
        if line.startswith("Usage: "):
            page.usage = line.removeprefix("Usage: ")
        elif not page.usage:
            page.what += line
        elif heading and heading[1] != "Examples":
            section = page.sections.setdefault(heading[1], [])
        elif line.startswith("   ") and section:  # a description below its entry
            section[-1].text += (" " if section[-1].text else "") + line.strip()
        elif entry and section is not None:
            section.append(Entry(entry[1], entry[2] or ""))
        elif line.strip():
            section = None
            page.footer.append(line)
    return page


def help_of(vtm, *command):
    return parse(subprocess.run([vtm, *command, "--help"], check=True, capture_output=True, text=True).stdout)


# ---- Man page -------------------------------------------------------------------------------------

def roff(text):
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return re.sub(r"^([.'])", r"\\&\1", text)


def man_entries(entries):
    for entry in entries:
        yield f".TP\n\\fB{roff(entry.head)}\\fR\n{roff(entry.text)}"


def man_page(version, whole, commands):
    lines = [f'.TH VTM 1 "" "{version}" "User Commands"', ".SH NAME", f"vtm \\- {roff(whole.what.rstrip('.'))}",
             ".SH SYNOPSIS"]
    for number, page in enumerate(commands.values()):
        lines += [".br"] * (number > 0) + [roff(page.usage)]
    lines += [".SH OPTIONS", *man_entries(whole.sections["Options"])]
    for name, page in commands.items():
        lines += [f".SH {roff(name.upper())}", roff(page.what)]
        for heading, entries in page.sections.items():
            lines += [f".SS {roff(heading)}", *man_entries(entries)]
        own = [line for line in page.footer if line not in whole.footer]
        lines += [".PP", ".nf", *map(roff, own), ".fi"] if own else []
    lines.append(".SH NOTES")
    for paragraph in whole.footer:
        lines += [".PP", roff(paragraph.strip())]
    return "\n".join(lines) + "\n"


# ---- Completions ----------------------------------------------------------------------------------

def bash(whole, commands):
    cases, values = [], {}
    for name, page in commands.items():
        flags = " ".join(flag for entry in page.entries() for flag in entry.flags)
        cases.append(f"        {name}) words='{flags}' ;;")
        for entry in page.entries():
            if entry.choices:
                values["|".join(entry.flags)] = " ".join(entry.choices)
    choices = [f"        {flags}) COMPREPLY=($(compgen -W '{words}' -- \"$word\")); return ;;"
               for flags, words in values.items()]
    first = " ".join([*commands, *(flag for entry in whole.sections["Options"] for flag in entry.flags)])
    return "\n".join([
        "# Completion of vtm for bash; made from its --help.", "_vtm() {",
        '    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} words', "    COMPREPLY=()",
        '    case "$before" in', *choices, "        *) ;;", "    esac", '    case "${COMP_WORDS[1]}" in', *cases,
        f"        *) words='{first}' ;;", "    esac",
        '    if [ "$COMP_CWORD" -eq 1 ] || [[ $word == -* ]]; then',
        '        COMPREPLY=($(compgen -W "$words" -- "$word"))', "    else",
        '        COMPREPLY=($(compgen -f -- "$word"))', "    fi", "}", "complete -o filenames -F _vtm vtm", ""])


def quoted(text):
    return text.replace("'", "'\\''")


def zsh_spec(entry):
    """'(-o --output)'{-o,--output}'[what]:value:_files'."""
    what = quoted(re.sub(r"([\[\]:\\])", r"\\\1", entry.text))
    action = f"({' '.join(entry.choices)})" if entry.choices else "_files"
    value = f":value:{action}" if entry.takes_value else ""
    if len(entry.flags) == 1:
        return f"'{entry.flags[0]}[{what}]{value}'"
    return f"'({' '.join(entry.flags)})'{{{','.join(entry.flags)}}}'[{what}]{value}'"


def zsh(_whole, commands):
    lines = ["#compdef vtm", "# Completion of vtm for zsh; made from its --help.", "local -a commands=("]
    lines += [f"    '{name}:{quoted(page.what.replace(':', chr(92) + ':'))}'" for name, page in commands.items()]
    lines += [")", "if (( CURRENT == 2 )); then", "    _describe command commands", "    return", "fi",
              "local command=$words[2]", "shift words; (( CURRENT-- ))", "case $command in"]
    for name, page in commands.items():
        specs = " \\\n            ".join(zsh_spec(entry) for entry in page.entries() if entry.flags)
        lines.append(f"    {name}) _arguments \\\n            {specs} \\\n            '*:file:_files' ;;")
    return "\n".join([*lines, "esac", ""])


def fish(_whole, commands):
    lines = ["# Completion of vtm for fish; made from its --help."]
    for name, page in commands.items():
        lines.append(f"complete -c vtm -n __fish_use_subcommand -f -a {name} -d '{fish_quoted(page.what)}'")
        for entry in page.entries():
            names = [f"-l {flag[2:]}" if flag.startswith("--") else f"-s {flag[1:]}" for flag in entry.flags]
            value = " -r" * entry.takes_value + (f" -f -a '{' '.join(entry.choices)}'" if entry.choices else "")
            if names:
                lines.append(f"complete -c vtm -n '__fish_seen_subcommand_from {name}' {' '.join(names)}{value} "
                             f"-d '{fish_quoted(entry.text)}'")
    return "\n".join([*lines, ""])


def fish_quoted(text):
    return text.replace("\\", "\\\\").replace("'", "\\'")


def main():
    vtm, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    whole = help_of(vtm)
    names = [entry.head.split()[0] for entry in whole.sections["Subcommands"]]
    commands = {name: help_of(vtm, name) for name in names}
    version = subprocess.run([vtm, "--version"], check=True, capture_output=True, text=True).stdout.strip()
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "vtm.1.gz").write_bytes(gzip.compress(man_page(version, whole, commands).encode(), mtime=0))
    for name, shell in {"vtm.bash": bash, "_vtm": zsh, "vtm.fish": fish}.items():
        (folder / name).write_text(shell(whole, commands), encoding="utf-8")


if __name__ == "__main__":
    main()
