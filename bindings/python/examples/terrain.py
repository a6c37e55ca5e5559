"""A relief map: ridges, valleys and a sea, colored by height and lit by the exact gradient."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import LinearSegmentedColormap

from asperity.noise import Fbm, Gaussian, Perlin, RidgedMultifractal

# Mountains where a slow noise is high, hills elsewhere, all bent by another noise.
mountains = RidgedMultifractal(Perlin(8), octaves=6, gain=0.42, feedback=2.0)
hills = Fbm(Gaussian(3), octaves=6, gain=0.38)
mask = Fbm(Gaussian(5), octaves=2, gain=0.4, frequency=0.4).scale(0.5, 0.4).clamp(0, 1)
land = (0.13 * hills + 0.05).blend(1.35 * mountains - 0.05, mask)
land = land.warp(Fbm(Gaussian(9), octaves=3, gain=0.4), 0.09)

height, slope = land.grid((340, 540), step=1 / 85, origin=(2.0, 6.0), with_gradient=True)

# Light from the upper left, as on a map. The image has y downwards.
normal = np.dstack([-0.55 * slope, np.ones(height.shape)])
normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
light = np.clip(normal @ np.array([-0.5, -0.5, 0.71]), 0, None)

colors = LinearSegmentedColormap.from_list(
    "land",
    [(0, "#b9bd84"), (0.12, "#8aa468"), (0.3, "#5d8256"), (0.5, "#8a7a5f"), (0.7, "#a89c8f"), (0.85, "#fff"), (1, "#fff")],
)
sea = np.clip(-height / 0.3, 0, 1)[..., None] ** 0.6
water = (1 - sea) * np.array([0.55, 0.76, 0.77]) + sea * np.array([0.16, 0.36, 0.50])
ground = colors(np.clip(height / 0.95, 0, 1))[..., :3] * (0.35 + 0.9 * light[..., None])
image = np.where(height[..., None] > 0, ground, water)

plt.imsave("terrain.png", np.clip(image, 0, 1))
