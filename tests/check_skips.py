#!/usr/bin/env python3
"""Turns skipped tests into failures where what they need is required.

check_skips.py JUNIT [FEATURE,...]: JUNIT is what `ctest --output-junit` wrote. Every skipped test is listed
with what it lacks; exit code 1 if that is among the features.
check_skips.py --self-test: planted skips must be told apart.
"""
import re
import sys
import tempfile
import xml.etree.ElementTree

# What a test says when it is skipped, first match. "driver": GL is there, and cannot do what is tested.
FEATURES = [
    ("driver", r"the driver|no OpenGL ES 1\b|notice of resets|of the largest textures|no multisampled"),
    ("svg", r"svg-suite"),
    ("corpus", r"is absent|corpus"),
    ("avif", r"built without libavif"),
    ("potrace", r"built without potrace"),
    ("glslang", r"glslangValidator"),
    ("chromium", r"Chromium"),
    ("valgrind", r"valgrind|callgrind"),
    ("xvfb", r"Xvfb|X server"),
    ("gl", r"OpenGL|EGL|does not draw"),
    ("python", r"numpy|Pillow|PIL"),
]
# These test what is not there, or have no truth to be held against.
MEANT = re.compile(r"egl_alone\.|trace\.TraceWithoutPotrace\.|texture\..*/gallardo\b")


def feature_of(name, output):
    """What a skipped test lacks; None if it is meant to be skipped."""
    if MEANT.match(name):
        return None
    return next((feature for feature, reason in FEATURES if re.search(reason, output)), "other")


def skips(path):
    for case in xml.etree.ElementTree.parse(path).getroot().iter("testcase"):
        if case.find("skipped") is not None:
            name = case.get("name")
            yield name, feature_of(name, case.findtext("system-out") or "")


def check(path, required):
    bad = 0
    for name, feature in skips(path):
        is_bad = feature in required
        bad += is_bad
        print(f"{'MISSING' if is_bad else 'skipped'}: {name}: {feature or 'meant to be'}")
    return bad


def self_test():
    cases = [("a", "gl", "no OpenGL ES 3.0"), ("b", "corpus", "../shared/corpus is absent"),
             ("c", "svg", "svg-suite is absent"), ("egl_alone.X", None, "no OpenGL ES"), ("d", "other", "no reason")]
    text = "<testsuite>" + "".join(
        f"<testcase name='{name}'><skipped message=''/><system-out>{output}</system-out></testcase>"
        for name, _, output in cases) + "<testcase name='passed'/></testsuite>"
    with tempfile.NamedTemporaryFile("w", suffix=".xml") as file:
        file.write(text)
        file.flush()
        assert list(skips(file.name)) == [(name, feature) for name, feature, _ in cases]
        assert check(file.name, {"gl", "svg"}) == 2 and check(file.name, set()) == 0


def main(arguments):
    if arguments == ["--self-test"]:
        self_test()
        return 0
    if not 1 <= len(arguments) <= 2:
        print(__doc__, file=sys.stderr)
        return 2
    required = {feature for feature in (arguments[1:] or [""])[0].split(",") if feature}
    unknown = required - {feature for feature, _ in FEATURES} - {"other"}
    if unknown:
        print(f"check_skips: unknown features: {', '.join(sorted(unknown))}", file=sys.stderr)
        return 2
    return min(check(arguments[0], required), 1)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
