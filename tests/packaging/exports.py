"""What libvtm and libvtm_gl export: what the public headers declare, and what classes declared there bring with them."""
import re

from check import require, run

# vtm::scene::Path: a mangled name's nested names, without std's.
NESTED = re.compile(r"^_Z(?:T[ISV])?NK?(3vtm.*)$")
OPERATORS = re.compile(r"^(C[1-3]|D[0-2]|a[SN]|eq|ix|cv|cl|pl|ml|E)")
C_HOOK = "vtm_gl_draw"  # by which libvtm finds libvtm_gl


def exported(library):
    """Demangled names by mangled ones, without versions."""
    names = [line.split()[-1].split("@")[0] for line in run("nm", "-D", "--defined-only", library).splitlines()]
    plain = run("c++filt", input="\n".join(names)).splitlines()
    return dict(zip(names, plain))


def identifiers(mangled):
    """Of a mangled nested name: vtm, scene, Path."""
    rest, found = NESTED.match(mangled), []
    rest = rest[1] if rest else ""
    while match := re.match(r"(\d+)", rest):
        length, start = int(match[1]), match.end()
        found.append(rest[start:start + length])
        rest = re.sub(r"^B5cxx11", "", rest[start + length:])
    return found


def unexpected(names, declared):
    """Names that no public header has a word for, or that are not ours at all."""
    for mangled, plain in names.items():
        words = [mangled] if mangled.startswith("vtm") else identifiers(mangled)
        is_hook = mangled == C_HOOK
        if not is_hook and (not words or any(word not in declared for word in words)):
            yield plain


def check(folder):
    headers = (folder.source / "api" / "include" / "vtm").rglob("*.h*")
    declared = set(re.findall(r"\w+", "\n".join(header.read_text(encoding="utf-8") for header in headers)))
    require(list(unexpected({"_ZN3vtm12hiddenHelperEv": "vtm::hiddenHelper()", "_ZSt4move": "std::move"}, declared)) ==
            ["vtm::hiddenHelper()", "std::move"], "the check does not see what is not public")
    for name in ("libvtm.so", "libvtm_gl.so"):
        found = list((folder.prefix / "lib").glob(f"{name}*"))
        if not found:
            continue
        names = exported(found[0])
        require(len(names) > 10, f"{name} exports nothing")
        strange = sorted(unexpected(names, declared))
        require(not strange, f"{name} exports what no public header declares:\n" + "\n".join(strange[:40]))
