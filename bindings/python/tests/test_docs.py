"""docs/python.md has the code of the examples, and the examples run."""

import os
import runpy
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
PAGE = ROOT / "docs/python.md"
EXAMPLES = sorted(p for p in (ROOT / "bindings/python/examples").glob("*.py") if p.stem != "pictures")


def blocks():
    return [part.split("```")[0].removesuffix("\n") for part in PAGE.read_text().split("```python\n")[1:]]


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_page_has_the_example(example, tmp_path, monkeypatch):
    assert example.read_text().rstrip() in blocks()
    assert f"(pictures/python/{example.stem}.png)" in PAGE.read_text()
    import matplotlib

    matplotlib.use("Agg")
    monkeypatch.chdir(tmp_path)
    runpy.run_path(str(example), run_name="__main__")
    assert os.path.getsize(f"{example.stem}.png") > 10_000


def test_usage_runs():
    usage = [block for block in blocks() if "land(points)" in block]
    assert len(usage) == 1
    names = {}
    exec(usage[0], names)  # noqa: S102
    assert names["heights"].shape == (512, 512) and names["gradients"].shape == (1000, 2)


def test_pictures_are_small():
    pictures = list((ROOT / "docs/pictures/python").glob("*.png"))
    assert len(pictures) == len(EXAMPLES)
    assert all(picture.stat().st_size <= 100_000 for picture in pictures)
