"""Filtered models."""

from __future__ import annotations

import base64
import json
import struct
import zlib
from pathlib import Path

import numpy as np
import pytest

import asperity


def png(rgb: np.ndarray) -> bytes:
    """An RGB image as a PNG file."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    height, width, _ = rgb.shape
    rows = b"".join(b"\0" + row.tobytes() for row in rgb)
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def model(folder: Path) -> Path:
    """A model with one material, half of whose normal map is tilted to the left, half to the right."""
    tilt = np.where(np.arange(16) < 8, 0.3, -0.3)
    normal = np.stack([tilt, 0 * tilt, np.sqrt(1 - tilt**2)], -1)
    texels = np.broadcast_to(np.round(127.5 + 127.5 * normal).astype(np.uint8), (16, 16, 3))
    image = "data:image/png;base64," + base64.b64encode(png(np.ascontiguousarray(texels))).decode()
    document = {
        "asset": {"version": "2.0"},
        "images": [{"uri": image}],
        "textures": [{"source": 0}],
        "materials": [
            {
                "name": "ridges",
                "normalTexture": {"index": 0},
                "pbrMetallicRoughness": {"roughnessFactor": 0.3},
            }
        ],
    }
    file = folder / "ridges.gltf"
    file.write_text(json.dumps(document))
    return file


def test_lost_variance_becomes_roughness(tmp_path: Path) -> None:
    done = asperity.filter(model(tmp_path), tmp_path / "out.gltf", report=True)
    (material,) = done.materials
    assert material.name == "ridges" and material.reason is None and material.levels is not None
    top = material.levels[-1]
    # Slopes of ±0.3/√(1 − 0.09) on 14 of 16 columns, linear between them on two.
    variance = 0.09 / 0.91 * (14 + 2 / 3) / 16
    expected = (0.3**4 + variance) ** 0.25
    assert top.before == pytest.approx(0.3, abs=5e-3)
    assert top.after == pytest.approx(expected, abs=1e-2)
    assert material.error is not None and material.error[1] < material.error[0]
    document = json.loads((tmp_path / "out.gltf").read_text())
    assert document["extensionsUsed"] == ["KHR_texture_basisu"]


def test_errors_are_one_line_and_leave_no_file(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="nowhere.glb"):
        asperity.filter(tmp_path / "nowhere.glb", tmp_path / "out.glb")
    with pytest.raises(ValueError, match="`format` must be uastc or zstd, got `png`"):
        asperity.filter(model(tmp_path), tmp_path / "out.gltf", format="png")  # type: ignore[arg-type]
    assert [file.name for file in tmp_path.iterdir()] == ["ridges.gltf"]
