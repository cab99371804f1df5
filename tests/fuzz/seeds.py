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


def main():
    target, folder, *program = sys.argv[1:]
    out = pathlib.Path(folder)
    out.mkdir(parents=True, exist_ok=True)
    if target == "asset":
        subprocess.run([program[0], str(out)], check=True)
        return
    seeds = {"svg": drawings, "image": pictures, "openvg": lambda: noise(40, 1024),
             "pipeline": lambda: drawings() | noise(200, 512)}[target]()
    for name, data in seeds.items():
        (out / name).write_bytes(data)


if __name__ == "__main__":
    main()
