"""Baked textures as arrays."""

import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import asperity


@pytest.mark.skipif(not hasattr(os, "fork"), reason="the platform does not fork")
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_a_forked_process_bakes():
    asperity.bake(noise="perlin", size=64)
    child = os.fork()
    if child == 0:
        os._exit(0 if "normal" in asperity.bake(noise="perlin", size=64) else 1)
    deadline, status = time.monotonic() + 30, (0, 0)
    while status[0] == 0 and time.monotonic() < deadline:
        status = os.waitpid(child, os.WNOHANG)
        time.sleep(0.05)
    if status[0] == 0:
        os.kill(child, signal.SIGKILL)
    assert status == (child, 0)


def test_maps_have_the_texels_of_the_files(tmp_path):
    from PIL import Image

    words = ["--noise=perlin", "--size=128", "--tileable", "--metallic=0.5", "--seed=3"]
    command = [sys.executable, "-m", "asperity", "bake", *words, "--out", str(tmp_path)]
    subprocess.run(command, check=True, capture_output=True)
    maps = asperity.bake(noise="perlin", size=128, tileable=True, metallic=0.5, seed=3)
    assert set(maps) == {"base_color", "normal", "height", "roughness", "metallic", "ambient_occlusion"}
    for name in ("roughness", "ambient_occlusion"):
        texels = np.asarray(Image.open(tmp_path / f"{name}.png")).astype(np.float64)
        np.testing.assert_allclose(maps[name] * 65535, texels, atol=0.01)
    height = np.asarray(Image.open(tmp_path / "height.png")).astype(np.float64) / 65535
    low, high = maps["height"].min(), maps["height"].max()
    np.testing.assert_allclose((maps["height"] - low) / (high - low), height, atol=2e-5)
    np.testing.assert_allclose(np.linalg.norm(maps["normal"], axis=-1), 1, atol=1e-3)
    assert maps["base_color"].shape == (128, 128, 3) and np.ptp(maps["metallic"]) == 0
    # Tileable: the step across the border is one of a neighbor.
    steps = np.abs(np.diff(maps["height"], axis=1)).max()
    assert np.abs(maps["height"][:, 0] - maps["height"][:, -1]).max() <= 2 * steps


def test_a_surface_without_height():
    maps = asperity.bake(ndf="ggx:0.2,0.4", size=64)
    assert "height" not in maps and maps["ambient_occlusion"].min() == 1


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"size": 1000}, "`--size` must be a power of two and at least 64, got 1000"),
        ({"noise": "velvet"}, "invalid value 'velvet' for '--noise"),
        ({"tileable": True, "lacunarity": 2.17}, "`--tileable`: `--cells`"),
        ({"noise": "perlin", "ndf": "ggx:0.3"}, "cannot be used with"),
    ],
)
def test_errors(options, message):
    with pytest.raises(ValueError, match=message) as error:
        asperity.bake(**options)
    assert "\n" not in str(error.value)
