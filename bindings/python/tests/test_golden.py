"""Bits of the package are the bits of the crates."""

from pathlib import Path

import numpy as np
import pytest

import asperity.noise
from asperity import fif, ndf, shading

LINES = (Path(__file__).parent / "golden.tsv").read_text().splitlines()


def points(n):
    p = [[((i * 37 + axis * 101) % 257) / 16 - 8 for axis in range(n)] for i in range(12)]
    p[10] = [123_456.5 + axis for axis in range(n)]
    p[11] = [np.nan] * n
    return np.array(p, dtype=np.float32)


NAMES = {name: getattr(asperity.noise, name) for name in asperity.noise.__all__} | {
    "P1": points(1),
    "P2": points(2),
    "P3": points(3),
    "P4": points(4),
    "M": np.array(
        [[0, 0, 1], [0.6, 0, 0.8], [-0.48, 0.64, 0.6], [0.36, 0.48, 0.8], [0.28, -0.96, 0], [0, 0.6, -0.8]],
        dtype=np.float32,
    ),
    "U": np.array(
        [[0.5, 0.5], [0.125, 0.875], [0, 0.25], [0.75, 0.0625], [0.9375, 0.3125], [0.4375, 0.6875]],
        dtype=np.float32,
    ),
    "X": np.arange(9) / 4 - 0.25,
    "TEXELS": np.array([i * 7 % 11 for i in range(64)]).reshape(8, 8),
    "COLOR": (0.8, 0.5, 0.25),
    "TAKAGI": fif.affine([0, 1, 2], [0, 1, 0], 0.5),
    "fif": fif,
    "ndf": ndf,
    "shading": shading,
}


@pytest.mark.parametrize("line", LINES, ids=lambda line: line.split("\t")[0])
def test_bits(line):
    expression, bits = line.split("\t")
    words = bits.split(" ")
    result = np.asarray(eval(expression, dict(NAMES)))  # noqa: S307
    if len(words[0]) == 16:
        found = result.astype(np.float64).ravel().view(np.uint64)
    else:
        assert result.dtype == np.float32
        found = result.ravel().view(np.uint32)
    assert [f"{x:0{len(words[0])}x}" for x in found] == words


def test_every_module_has_golden_values():
    assert len(LINES) > 200
    for name in ("Gaussian", "Fbm", "ndf.ggx", "TAKAGI", "shading.open_pbr"):
        assert any(name in line for line in LINES)
