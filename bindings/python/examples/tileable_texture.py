"""Cracked clay that repeats without a seam. The picture shows the tile twice along each axis."""

import matplotlib.pyplot as plt
import numpy as np

from asperity.noise import Cellular, Fbm, Gaussian

size, cells = 256, 5
# Every part has the same period, so the whole has it, too.
edges = Cellular(4, output="f2_minus_f1", period=cells)
bend = Fbm(Gaussian(1), octaves=3, gain=0.4, period=cells)
plates = (6.0 * edges.warp(bend, 0.06)).clamp(0, 1)
grain = Fbm(Gaussian(2), octaves=5, gain=0.5, period=cells)
clay = plates * (1 + 0.05 * grain) + 0.02 * grain

height, slope = clay.grid((size, size), step=cells / size, with_gradient=True)
tint = Fbm(Gaussian(3), octaves=3, period=cells).grid((size, size), step=cells / size)

normal = np.dstack([-0.22 * slope, np.ones(height.shape)])
normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
light = np.clip(normal @ np.array([-0.5, -0.6, 0.62]), 0, None)
warm = np.array([0.78, 0.60, 0.45]) + 0.05 * tint[..., None] * np.array([1.0, 0.7, 0.4])
image = warm * (0.25 + 1.1 * light[..., None]) * (0.25 + 0.75 * np.clip(height, 0, 1)[..., None])

plt.imsave("tileable_texture.png", np.clip(np.tile(image, (2, 2, 1)), 0, 1))
