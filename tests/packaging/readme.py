"""README.md's code, compiled as it stands there.

A block is a function's body, or a file where it begins with #include; readme_context.hpp has what its text is about: the
reader's own shapes and shaders."""
import pathlib
import re

from check import require, run

BLOCK = re.compile(r"^```(cpp|c)\n(.*?)^```", re.M | re.S)


def program(language, text, context):
    if text.startswith("#include"):
        includes, _, body = text.partition("\n\n")
    else:
        includes, body = "", text
    if "main(" in body:
        return f"{includes}\n{body}"
    head = f'{includes}\n#include "{context}.{"hpp" if language == "cpp" else "h"}"\n'
    return f"{head}\nvoid readme(void);\nvoid readme(void) {{\n{body}}}\n"


def check(folder):
    here = pathlib.Path(__file__).parent
    output = folder.fresh("readme")
    blocks = BLOCK.findall((folder.source / "README.md").read_text(encoding="utf-8"))
    require({language for language, _ in blocks} == {"cpp", "c"}, "README.md has no code in C++ or C")
    for number, (language, text) in enumerate(blocks):
        file = output / f"{number}.{language}"
        file.write_text(program(language, text, here / "readme_context"), encoding="utf-8")
        compiler = ["c++", "-std=c++20"] if language == "cpp" else ["cc", "-std=c99"]
        run(*compiler, "-fsyntax-only", "-Wall", "-Werror", "-Wno-unused-variable", "-I", folder.prefix / "include", file)
