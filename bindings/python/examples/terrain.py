"""A relief map: ridges, valleys and a sea, colored by height and lit by the exact gradient."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import LinearSegmentedColormap

from asperity.noise import Fbm, Gaussian, Perlin, RidgedMultifractal

# Mountains where a slow noise is high, hills elsewhere, all bent by another noise.
mountains = RidgedMultifractal(Perlin(8), octaves=9, feedback=1.8)
hills = Fbm(Gaussian(3), octaves=8, gain=0.45)
mask = Fbm(Gaussian(5), octaves=3, gain=0.4, frequency=0.35).scale(0.45, 0.35).clamp(0, 1)
land = (0.16 * hills + 0.1).blend(1.5 * mountains - 0.12, mask)
land = land.warp(Fbm(Gaussian(9), octaves=4), 0.12)

height, slope = land.grid((560, 900), step=1 / 150, origin=(2.0, 6.0), with_gradient=True)

# Light from the upper left, as on a map. The image has y downwards.
normal = np.dstack([-0.8 * slope, np.ones(height.shape)])
normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
light = np.clip(normal @ np.array([-0.55, -0.5, 0.67]), 0, None)

colors = LinearSegmentedColormap.from_list(
    "land",
    [(0.0, "#8d9a5b"), (0.15, "#5f7d45"), (0.35, "#46663f"), (0.55, "#7d6f58"), (0.75, "#94897c"), (1.0, "#ffffff")],
)
sea = np.clip(-height / 0.35, 0, 1)[..., None]
water = (1 - sea) * np.array([0.45, 0.66, 0.68]) + sea * np.array([0.13, 0.30, 0.43])
ground = colors(np.clip(height / 1.05, 0, 1))[..., :3] * (0.3 + 1.05 * light[..., None])
image = np.where(height[..., None] > 0, ground, water)

plt.imsave("terrain.png", np.clip(image, 0, 1))
