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
        for colors in (256, 192, 128, 96, 64):
            image.quantize(colors, dither=Image.Dither.FLOYDSTEINBERG).save(file, optimize=True)
            if file.stat().st_size <= 100_000:
                break
        print(f"{file} {file.stat().st_size / 1000:.0f} KB")


if __name__ == "__main__":
    main()
