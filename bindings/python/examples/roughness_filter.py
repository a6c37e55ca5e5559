"""Bumps that a pixel does not resolve become roughness: without sparkles, and as bright as the bumps."""

import matplotlib.pyplot as plt
import numpy as np

from asperity import ndf
from asperity.noise import Fbm, Gaussian

# A normal map as slopes, and its mip levels: the mean slopes of 2 × 2 texels, and their squares.
size, cells, alpha = 2048, 48, 0.03
bumps = Fbm(Gaussian(3), octaves=4, gain=0.5, period=cells)
slope = 0.018 * bumps.grid((size, size), step=cells / size, with_gradient=True).gradient


def halved(a: np.ndarray) -> np.ndarray:
    return np.asarray(0.25 * (a[::2, ::2] + a[1::2, ::2] + a[::2, 1::2] + a[1::2, 1::2]))


def highlight(slopes: np.ndarray, alpha: np.ndarray) -> np.ndarray:
    """Light of a lamp at the mirror direction of the middle of a wide plane."""
    n = len(slopes)
    y, x = np.meshgrid(*[(np.arange(n) + 0.5) / n - 0.5] * 2, indexing="ij")
    half = 0.45 * np.stack([x, y], -1) - slopes
    light = np.zeros((n, n))
    # One distribution for each of 64 roughnesses.
    steps = np.unique(np.round(64 * np.log2(alpha)))
    for step in steps:
        of_step = np.round(64 * np.log2(alpha)) == step
        light[of_step] = ndf.beckmann(2.0 ** (step / 64)).slope_density(half[of_step])
    return light


level, levels = slope, 4
squares = slope**2
for _ in range(levels):
    level, squares = halved(level), halved(squares)
variance = (squares - level**2).sum(axis=-1)

plain = np.full(level.shape[:2], alpha)
filtered = np.sqrt(alpha**2 + variance)  # the mean of both axes: alpha² + 2 · variance / 2
reference = highlight(slope, np.full(slope.shape[:2], alpha))
for _ in range(levels):
    reference = halved(reference[..., None])[..., 0]

figure, axes = plt.subplots(1, 3, figsize=(9.6, 3.75), facecolor="white")
for axis, picture, title in (
    (axes[0], highlight(level, plain), "mip level of the normal map alone"),
    (axes[1], highlight(level, filtered), "its lost variance added to the roughness"),
    (axes[2], reference, "reference: 256 samples a pixel"),
):
    error = np.sqrt(np.mean((picture - reference) ** 2)) / np.sqrt(np.mean(reference**2))
    axis.imshow(picture ** (1 / 2.2), cmap="copper", vmin=0, vmax=np.percentile(reference, 99.9) ** (1 / 2.2))
    axis.set_title(f"{title}\nerror {100 * error:.0f} %" if picture is not reference else title + "\n", fontsize=9)
    axis.set_axis_off()
figure.tight_layout(pad=0.8)
figure.savefig("roughness_filter.png", dpi=100, bbox_inches="tight", pad_inches=0.12)
