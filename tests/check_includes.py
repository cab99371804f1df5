#!/usr/bin/env python3
"""Proves the include rule of docs/architecture.md.

check_includes.py [ROOT]: every #include below ROOT must satisfy it; violations are printed as
file:line: message, exit code 1.
check_includes.py --self-test: the check must catch planted violations.

The rule, for a file of module M:
- Public headers stand in api/include and are included as users include them: <vtm/scene/path.hpp>. They belong to
  the module that PUBLIC names, and include public headers, the standard library and glm only.
- Other headers of ours are included with quotes, from the repository's root, and exist; but for what the build makes
  (GENERATED).
- M's headers and sources include M and the modules named in MODULES[M] only.
- Tests, and what stands in no module (tests/), may include every module.
- Another module's header comes from that module's root, never from its src/ or tests/, but for what INSIDE names.
- Angle brackets are for the standard library, POSIX and the libraries in LIBRARIES, each only in
  the modules named there.
- STANDALONE is built outside of the tree, which a packaging test does: the rule is not for it.
"""
import argparse
import pathlib
import re
import sys
import tempfile

MODULES = {
    "limits": set(),
    "image": {"limits"},
    "geometry": set(),
    "scene": {"geometry", "image", "limits"},
    "text": {"scene", "geometry", "image", "limits"},
    "svg": {"text", "scene", "geometry", "image", "limits"},
    "asset": {"image", "limits"},
    "raster": {"asset", "image", "limits"},
    "compiler": {"scene", "geometry", "raster", "asset", "image", "limits"},
    "font": {"text", "scene", "geometry", "compiler", "raster", "asset", "image", "limits"},
    "paper": {"scene", "geometry", "compiler", "raster", "asset", "image", "limits"},
    "paper/gl": {"paper", "backend_gl", "raster", "asset", "image", "limits"},
    "api": {"svg", "text", "scene", "compiler", "raster", "asset", "image", "limits"},
    "api/gl": {"api", "raster", "asset", "image", "backend_gl"},
    "gles_context": set(),
    "api/system_egl": set(),
    "api/openvg": {"scene", "geometry", "compiler", "raster", "asset", "image", "limits", "gles_context", "api/system_egl"},
    "api/egl": {"api/system_egl"},
    "api/gles": {"raster", "asset", "image", "backend_gl"},
    "backend_gl": {"raster", "asset", "image", "limits", "gles_context"},
    "web": {"backend_gl", "raster", "asset", "image", "limits"},
    "trace": {"scene", "image", "limits"},
    "conformance/generate": {"scene", "image", "limits"},
    "conformance/reference": {"scene", "image", "limits"},
    "conformance/compare": {"image", "limits"},
    "conformance/vgscript": {"svg", "scene", "image", "limits"},
}
# A second mode made of the same parts: it may look inside the modules that it is made of.
INSIDE = {"paper": {"raster", "asset", "compiler"}, "paper/gl": {"backend_gl"}}
PUBLIC = {  # folders of api/include/vtm, and the modules whose public headers they hold
    "limits": "limits",
    "image": "image",
    "scene": "scene",
    "text": "text",
    "svg": "svg",
    "asset": "asset",
    "raster": "raster",
    "compiler": "compiler",
    "font": "font",
    "gl": "backend_gl",
}
PUBLIC_ROOT = pathlib.PurePosixPath("api/include")
PUBLIC_LIBRARIES = re.compile(r"glm/.*|VG/.*|stddef\.h|stdint\.h")
EVERYTHING = set(MODULES)
MODULES["conformance/cases"] = EVERYTHING
MODULES["conformance/runner"] = EVERYTHING | {"conformance/cases"}
MODULES["bench"] = EVERYTHING
MODULES["tools"] = EVERYTHING
MODULES["examples"] = EVERYTHING
MODULES["tests"] = EVERYTHING

ANYWHERE = None
LIBRARIES = {
    r"glm/.*": ANYWHERE,
    r"fmt/.*": ANYWHERE,
    r"tbb/.*": {"image", "raster", "backend_gl", "compiler", "font", "bench", "tests"},
    r"gtest/.*|gmock/.*": ANYWHERE,
    r"pugixml\.hpp": {"svg", "bench"},
    r"hb(-ot)?\.h|fribidi\.h|linebreak\.h|fontconfig/.*|woff2/.*": {"text", "conformance/cases"},
    r"iconv\.h": {"svg"},
    r"zlib\.h": {"text", "svg", "asset", "image", "web"},
    r"png\.h|jpeglib\.h|jerror\.h|webp/.*": {"image", "conformance/compare"},
    r"libdeflate\.h|avif/.*": {"image"},
    r"VG/.*|vtm/(vtm|vg|vg_image|vg_gl|gles|egl)\.h": ANYWHERE,
    r"EGL/.*|GLES3/.*|GLES2/.*|KHR/.*": {"backend_gl", "examples", "bench", "api/egl", "api/gl", "api/gles", "api/openvg", "api/system_egl", "gles_context"},
    r"dlfcn\.h": {"api", "api/openvg", "api/egl", "api/system_egl", "backend_gl", "image", "trace"},
    r"stddef\.h|stdint\.h": {"api"},
    r"stdio\.h": {"api/egl", "tests"},
    r"immintrin\.h": {"api/openvg"},
    r"CLI/.*": {"tools", "conformance/runner"},
    r"nlohmann/.*": {"tools", "web", "bench", "conformance/cases", "conformance/runner"},
    r"benchmark/.*|librsvg/.*|cairo\.h|blend2d/.*|nanovg(_gl)?\.h|thorvg\.h": {"bench"},
    r"ft2build\.h": {"text", "bench", "examples"},
    r"X11/.*": {"examples", "bench"},
    r"Q[A-Z]\w+": {"bench"},
    r"potracelib\.h": {"trace"},
    r"emmintrin\.h": {"raster", "compiler"},
    r"linux/magic\.h": {"image"},
    r"malloc\.h": {"limits", "tools", "bench"},
    r"fnmatch\.h": {"conformance/runner"},
    r"pthread\.h|sched\.h|signal\.h|unistd\.h|fcntl\.h|poll\.h|sys/.*\.h": ANYWHERE,
}
STANDALONE = pathlib.PurePosixPath("examples/openvg/c")
GENERATED = {"vg_constants.inc", "vg_functions.inc"}  # made by a module for itself when it is built
STANDARD = re.compile(r"[a-z_0-9]+")  # <vector>, <cstdint>: no dot, no folder
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]*)[>"]')
SUFFIXES = {".cpp", ".hpp", ".h", ".c", ".cc"}


def is_public(path):
    return path.is_relative_to(PUBLIC_ROOT)


def module_of(path):
    """The module a path relative to the root belongs to, or None."""
    if is_public(path):
        inner = path.relative_to(PUBLIC_ROOT).parts
        return PUBLIC.get(inner[1]) if len(inner) > 2 else "api"
    for depth in (2, 1):
        name = "/".join(path.parts[:depth])
        if len(path.parts) > depth and name in MODULES:
            return name
    return None


def inside(path, module):
    """The path's parts below its module's folder."""
    return path.parts[len(module.split("/")):]


def check_ours(root, file, module, target):
    if target in GENERATED:
        return None
    path = pathlib.PurePosixPath(target)
    other = module_of(path)
    if ".." in path.parts or path.is_absolute():
        return "leaves the repository's root"
    if is_public(path):
        return "is public: include it as <vtm/...>"
    if other is None:
        return "is not a path from the repository's root into a module"
    if not (root / path).is_file():
        return "does not exist"
    if other == module:
        return None
    if len(inside(path, other)) != 1 and other not in INSIDE.get(module, ()):
        return f"is private to {other}"
    is_test = "tests" in inside(file, module)[:-1]
    if not is_test and other not in MODULES[module]:
        return f"{module} may not include {other}"
    return None


def check_public(root, file, module, target):
    """An include of <vtm/...hpp>."""
    path = PUBLIC_ROOT / target
    other = module_of(path)
    if not (root / path).is_file():
        return "does not exist"
    if other == module or "tests" in inside(file, module)[:-1] or other in MODULES[module]:
        return None
    # What every module throws is derived from it.
    return None if target == "vtm/error.hpp" else f"{module} may not include {other}"


def check_library(root, file, module, target):
    if target.startswith("vtm/") and target.endswith(".hpp"):
        return check_public(root, file, module, target)
    if is_public(file) and not (STANDARD.fullmatch(target) or PUBLIC_LIBRARIES.fullmatch(target)
                                or (root / PUBLIC_ROOT / target).is_file()):
        return "is no public header"
    if (root / target).is_file():
        return "is ours: include it with quotes"
    if STANDARD.fullmatch(target):
        return None
    for pattern, where in LIBRARIES.items():
        if re.fullmatch(pattern, target):
            return None if where is ANYWHERE or module in where else f"{module} may not use this library"
    return "is no library that we use"


def violations(root):
    for path in sorted(root.rglob("*")):
        file = pathlib.PurePosixPath(path.relative_to(root).as_posix())
        module = module_of(file)
        if path.suffix not in SUFFIXES or file.is_relative_to(STANDALONE):
            continue
        if module is None:
            if is_public(file):
                yield f"{file}:1: belongs to no module"
            continue
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            match = INCLUDE.match(line)
            if not match:
                continue
            quote, target = match.groups()
            if quote == "<":
                wrong = check_library(root, file, module, target)
            else:
                wrong = "is not public" if is_public(file) else check_ours(root, file, module, target)
            if wrong:
                yield f'{file}:{number}: "{target}" {wrong}'


def self_test():
    """Each planted file holds one include; those marked True are violations."""
    cases = [
        ("scene/src/good.cpp", "#include <vtm/scene/path.hpp>", False),
        ("scene/src/shared.cpp", '#include "scene/shared.hpp"', False),
        ("scene/src/own_private.cpp", '#include "scene/src/private.hpp"', False),
        ("scene/src/standard.cpp", "#include <vector>", False),
        ("svg/src/allowed.cpp", "#include <vtm/scene/path.hpp>", False),
        ("svg/src/allowed_shared.cpp", '#include "scene/shared.hpp"', False),
        ("svg/src/error.cpp", "#include <vtm/error.hpp>", False),
        ("svg/tests/wide.cpp", "#include <vtm/asset/asset.hpp>", False),
        ("backend_gl/core/own.cpp", "#include <vtm/gl/context.hpp>", False),
        ("api/include/vtm/svg/allowed.hpp", "#include <vtm/scene/path.hpp>", False),
        ("api/include/vtm/svg/glm.hpp", "#include <glm/vec2.hpp>", False),
        ("examples/openvg/c/sibling.c", '#include "other.h"', False),
        ("examples/openvg/sibling.cpp", '#include "other.h"', True),
        ("scene/src/upwards.cpp", "#include <vtm/svg/load.hpp>", True),
        ("asset/forbidden.hpp", "#  include <vtm/scene/path.hpp>", True),
        ("asset/forbidden_shared.hpp", '#include "scene/shared.hpp"', True),
        ("api/include/vtm/scene/upwards.hpp", "#include <vtm/svg/load.hpp>", True),
        ("api/include/vtm/svg/internal.hpp", '#include "scene/shared.hpp"', True),
        ("api/include/vtm/svg/internal_angle.hpp", "#include <scene/shared.hpp>", True),
        ("api/include/vtm/svg/library.hpp", "#include <fmt/core.h>", True),
        ("api/include/vtm/stray/stray.hpp", "#include <vector>", True),
        ("svg/src/quoted.cpp", '#include "api/include/vtm/scene/path.hpp"', True),
        ("paper/inside.cpp", '#include "asset/src/private.hpp"', False),
        ("paper/too_far.cpp", '#include "scene/src/private.hpp"', True),
        ("svg/src/private.cpp", '#include "scene/src/private.hpp"', True),
        ("svg/tests/private.cpp", '#include "scene/src/private.hpp"', True),
        ("svg/src/relative.cpp", '#include "../../scene/shared.hpp"', True),
        ("svg/src/sibling.cpp", '#include "private.hpp"', True),
        ("svg/src/missing.cpp", '#include "scene/missing.hpp"', True),
        ("svg/src/missing_public.cpp", "#include <vtm/scene/missing.hpp>", True),
        ("svg/src/angle.cpp", "#include <scene/shared.hpp>", True),
        ("svg/src/gl.cpp", "#include <GLES3/gl3.h>", True),
        ("svg/src/unknown.cpp", "#include <boost/variant.hpp>", True),
        ("conformance/compare/src/reference.cpp", '#include "conformance/reference/reference.hpp"', True),
    ]
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        public = ["error", "scene/path", "svg/load", "asset/asset", "gl/context"]
        given = [f"api/include/vtm/{name}.hpp" for name in public] + [
            "scene/shared.hpp", "scene/src/private.hpp", "asset/src/private.hpp", "svg/src/private.hpp", "conformance/reference/reference.hpp"]
        for name, text in [(g, "") for g in given] + [(c[0], c[1]) for c in cases]:
            path = root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text + "\n")
        caught = {v.split(":")[0] for v in violations(root)}
    wrong = [name for name, _, bad in cases if (name in caught) != bad]
    for name in wrong:
        print(f"self-test: {name} was judged wrongly")
    return 1 if wrong else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("root", nargs="?", default=pathlib.Path(__file__).resolve().parent.parent, type=pathlib.Path)
    parser.add_argument("--self-test", action="store_true")
    arguments = parser.parse_args()
    if arguments.self_test:
        return self_test()
    found = list(violations(arguments.root))
    print("\n".join(found) if found else "include rule: holds")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
