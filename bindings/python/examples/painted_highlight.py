"""A highlight of any shape: a painted distribution of normals on metal balls."""

import matplotlib.pyplot as plt
import numpy as np

from asperity import ndf, shading

# The painting: a star in the disk of normals, brightest in its middle.
size = 256
x, y = np.meshgrid(np.linspace(-1, 1, size), np.linspace(1, -1, size))
radius, angle = np.hypot(x, y), np.arctan2(x, y)
star = np.exp(-((radius / (0.10 + 0.30 * np.abs(np.cos(2.5 * angle)) ** 3)) ** 2))
painted = ndf.from_array(star)


def ball(distribution: ndf.Ndf, f0: tuple[float, float, float], pixels: int = 420) -> np.ndarray:
    """A ball in the light of three lamps, seen from the front."""
    x, y = np.meshgrid(np.linspace(-1.05, 1.05, pixels), np.linspace(1.05, -1.05, pixels))
    inside = x * x + y * y < 1
    normal = np.stack([x, y, np.sqrt(np.clip(1 - x * x - y * y, 0, None))], -1)
    # A frame for every pixel: the tangent lies in the plane of x and z.
    tangent = np.stack([normal[..., 2], 0 * x, -normal[..., 0]], -1)
    tangent /= np.linalg.norm(tangent, axis=-1, keepdims=True) + 1e-9
    bitangent = np.cross(normal, tangent)
    frame = np.stack([tangent, bitangent, normal], -2)
    metal, color = shading.metal(distribution, f0), np.zeros((pixels, pixels, 3))
    wo = frame @ np.array([0.0, 0.0, 1.0])
    for lamp, power in (((-0.5, 0.6, 0.62), 2.2), ((0.75, 0.1, 0.65), 0.9), ((0.1, -0.8, 0.6), 0.45)):
        wi = frame @ (np.array(lamp) / np.linalg.norm(lamp))
        color += power * metal.eval(wo, wi) * np.clip(wi[..., 2:], 0, None)
    # A dim sky.
    color += np.array(f0) * (0.02 + 0.10 * (0.5 + 0.5 * normal[..., 1:2]) ** 2)
    return np.where(inside[..., None], np.clip(color / (1 + 0.25 * color), 0, 1) ** (1 / 2.2), 1.0)


figure, axes = plt.subplots(1, 3, figsize=(9.6, 3.4), facecolor="white")
axes[0].imshow(painted.image(size), cmap="magma", extent=(-1, 1, -1, 1))
axes[0].set_title("painted distribution of normals", fontsize=9)
axes[1].imshow(ball(painted, (1.0, 0.66, 0.24)))
axes[1].set_title("its highlights", fontsize=9)
axes[2].imshow(ball(ndf.ggx(0.25), (1.0, 0.66, 0.24)))
axes[2].set_title("GGX, α = 0.25", fontsize=9)
for axis in axes:
    axis.set_axis_off()
figure.tight_layout(pad=0.8)
figure.savefig("painted_highlight.png", dpi=100, bbox_inches="tight", pad_inches=0.12)
