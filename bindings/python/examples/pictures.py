"""Runs every example and writes the pictures of docs/python.md, at most 100 KB each.

    python examples/pictures.py [directory]
"""

from __future__ import annotations

import os
import runpy
import sys
from pathlib import Path

import matplotlib
from PIL import Image

EXAMPLES = ("terrain", "tileable_texture", "painted_highlight", "takagi", "roughness_filter")


def main() -> None:
    here = Path(__file__).resolve().parent
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else here / "../../../docs/pictures/python").resolve()
    folder.mkdir(parents=True, exist_ok=True)
    matplotlib.use("Agg")
    os.chdir(folder)
    for name in EXAMPLES:
        runpy.run_path(str(here / f"{name}.py"), run_name="__main__")
        file = Path(f"{name}.png")
        image = Image.open(file).convert("RGB")
        for colors, dither in ((256, True), (256, False), (192, False), (128, False), (96, False), (64, False)):
            few = image.quantize(colors, method=Image.Quantize.MAXCOVERAGE)
            if dither:
                few = image.quantize(palette=few, dither=Image.Dither.FLOYDSTEINBERG)
            few.save(file, optimize=True)
            if file.stat().st_size <= 100_000:
                break
        print(f"{file} {file.stat().st_size / 1000:.0f} KB")


if __name__ == "__main__":
    main()
