#!/usr/bin/env python3
"""Fills a folder with the files that a fuzz target starts from, made of what the repository has.

usage: seeds.py TARGET FOLDER [PROGRAM]     PROGRAM: fuzz_asset_seeds, for the target asset
"""

import io
import pathlib
import random
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Larger files are slow to mutate and run, and show nothing that small ones do not.
MAX_BYTES = 2048


def drawings():
    """Small SVG files of ours: a behaviour each."""
    folders = [ROOT / "tests/fuzz/seeds/svg", ROOT / "examples", ROOT / "conformance/suites"]
    files = [path for folder in folders for path in sorted(folder.rglob("*.svg"))]
    return {f"{i}-{path.name}": data for i, path in enumerate(files) if len(data := path.read_bytes()) <= MAX_BYTES}


def trees():
    """Texts of VTMs."""
    files = [path for folder in ("examples", "conformance/suites") for path in sorted((ROOT / folder).rglob("*.vtmtree"))]
    small = {
        "paints": "draw { linear(0 0, 8 8) reflect transform rotate(9) { 0 red, 1 blue } radial(4 4 3) focus(5 4 1) { 0 #f008 1 lime } "
                  "pattern(0 0, 4 4) transform scale(2) { red opacity 0.5 } material m red \"vec4 m(vec2 p) { return vec4(1); }\" }",
        "layers": "clip c = { rect(0 0 4 4) evenodd } within { circle(4 4 3) } draw { blue "
                  "layer opacity 0.5 blend hue clip c mask linear-luminance { red } select \"M0 0Q1 2 3 4T5 6Z\" red }",
        "strokes": "shape s = \"M1 1C2 2 3 3 4 1A2 3 9 1 0 6 6\" stroke 2 cap round join bevel miter 3 dash(1 2 3) phase 1 "
                   "draw select s placed skewX(9) red else select s {} else color(srgb 0.1 0.2 0.3 / 0.4)",
    }
    return ({path.name: path.read_bytes() for path in files}
            | {name: f"vtmtree 1 size 8 8 {text}".encode() for name, text in small.items()})


def noise(count, size):
    """Bytes that a target takes for calls or scenes."""
    generator = random.Random(20055)
    return {f"noise-{i}": generator.randbytes(generator.randint(size // 8, size)) for i in range(count)}


def pictures():
    """The formats and pixel types that image::decode reads."""
    from PIL import Image

    seeds = {path.name: path.read_bytes() for path in sorted((ROOT / "conformance/suites/robustness/png").glob("*.png"))}
    generator = random.Random(20056)
    for mode, channels in {"1": 1, "L": 1, "LA": 2, "P": 1, "RGB": 3, "RGBA": 4, "CMYK": 4, "I;16": 2}.items():
        size = (9, 7)
        data = generator.randbytes(size[0] * size[1] * channels)
        image = Image.frombytes(mode, size, data if mode != "1" else data[: 2 * size[1]])
        for name, settings in {"png": {}, "jpeg": {}, "webp": {}, "gif": {}, "jpeg-progressive": {"progressive": True},
                               "webp-lossless": {"lossless": True}}.items():
            out = io.BytesIO()
            try:
                image.save(out, format=name.split("-")[0], **settings)
            except (OSError, ValueError):
                continue  # the format has no such pixels
            seeds[f"{mode.replace(';', '')}.{name}"] = out.getvalue()
    return seeds


def fonts():
    """DejaVu Sans with a few glyphs, alone, compressed, with colour layers and with a variation axis."""
    from fontTools import subset, ttLib
    from fontTools.colorLib import builder
    from fontTools.ttLib.tables import TupleVariation

    dejavu = pathlib.Path("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf")

    def few():
        font = ttLib.TTFont(dejavu)
        settings = subset.Options(layout_features=["kern", "liga", "mark", "init"], hinting=False, name_IDs=[1, 2])
        settings.drop_tables.append("FFTM")
        maker = subset.Subsetter(settings)
        maker.populate(text="Afi\u00c4\u0301\u0628")
        maker.subset(font)
        return font

    def saved(font, flavor=None):
        out = io.BytesIO()
        font.flavor = flavor
        font.save(out)
        return out.getvalue()

    def colored(version, layers):
        font = few()
        font["COLR"] = builder.buildCOLR(layers, version=version)
        font["CPAL"] = builder.buildCPAL([[(1, 0, 0, 1), (0, 0, 1, 0.5)]])
        return saved(font)

    stops = {"Extend": "repeat", "ColorStop": [{"StopOffset": o, "PaletteIndex": o, "Alpha": 1} for o in (0, 1)]}
    paints = [
        {"Format": 4, "ColorLine": stops, "x0": 0, "y0": 0, "x1": 900, "y1": 0, "x2": 0, "y2": 900},
        {"Format": 6, "ColorLine": stops, "x0": 0, "y0": 0, "r0": 9, "x1": 900, "y1": 0, "r1": 90},
        {"Format": 8, "ColorLine": stops, "centerX": 9, "centerY": 9, "startAngle": 0, "endAngle": 180},
        {"Format": 2, "PaletteIndex": 0, "Alpha": 0.5},
    ]
    outlined = [{"Format": 10, "Glyph": "f", "Paint": paint} for paint in paints]
    moved = [{"Format": 14, "Paint": outlined[0], "dx": 50, "dy": 50},
             {"Format": 24, "Paint": outlined[3], "angle": 45},
             {"Format": 32, "SourcePaint": outlined[3], "CompositeMode": "src_in", "BackdropPaint": outlined[1]}]

    def variable():
        font = few()
        fvar = font["fvar"] = ttLib.newTable("fvar")
        from fontTools.ttLib.tables._f_v_a_r import Axis
        axis = Axis()
        axis.axisTag, axis.minValue, axis.defaultValue, axis.maxValue, axis.axisNameID = "wght", 100, 400, 900, 1
        fvar.axes, fvar.instances = [axis], []
        gvar = font["gvar"] = ttLib.newTable("gvar")
        gvar.version, gvar.reserved, gvar.variations = 1, 0, {}
        for name in font.getGlyphOrder():
            points = len(font["glyf"]._getCoordinatesAndControls(name, font["hmtx"].metrics)[0])
            gvar.variations[name] = [TupleVariation.TupleVariation({"wght": (0, 1, 1)}, [(9, 5)] * points)]
        return saved(font)

    return {"plain.ttf": saved(few()), "plain.woff": saved(few(), "woff"), "variable.ttf": variable(),
            "layers.ttf": colored(0, {"A": [("f", 0), ("i", 1)]}),
            "paints.ttf": colored(1, {"A": {"Format": 1, "Layers": outlined}, "i": {"Format": 1, "Layers": moved}})}


def main():
    target, folder, *program = sys.argv[1:]
    out = pathlib.Path(folder)
    out.mkdir(parents=True, exist_ok=True)
    if target == "asset":
        subprocess.run([program[0], str(out)], check=True)
        return
    seeds = {"svg": drawings, "image": pictures, "font": fonts, "openvg": lambda: noise(40, 1024),
             "pipeline": lambda: drawings() | noise(200, 512), "tree": trees}[target]()
    for name, data in seeds.items():
        (out / name).write_bytes(data)


if __name__ == "__main__":
    main()
