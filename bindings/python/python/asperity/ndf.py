"""Microfacet normal distribution functions: evaluation, sampling and exact level of detail.

A distribution is made by a function of its name, from an image, or from measured normals::

    from asperity import ndf

    ggx = ndf.ggx(0.2, 0.4)
    normals = ggx.sample(rng.random((1000, 2)))
    density = ggx.d(normals)

Normals are unit vectors of shape ``(..., 3)`` in a frame whose z axis is the surface normal. ``d``
is in 1/sr with ∫ d cos θ dω = 1. Roughness parameters are α, not the perceptual roughness √α.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Literal

import numpy as np
import numpy.typing as npt

from . import _asperity
from ._arrays import Float32Array, joined, readable, real, rows, shaped
from ._recorded import Recorded, recorded

__all__ = [
    "Ndf",
    "ashikhmin_shirley",
    "beckmann",
    "blinn_phong",
    "estimate",
    "from_array",
    "from_image",
    "from_normal_map",
    "ggx",
    "isotropic",
    "painted",
    "student_t",
    "ward",
]


class Ndf(Recorded):
    """A normal distribution function D with its bijection T from Gaussian pairs to normals.

    Every method takes arrays of any shape, broadcasts them, and accepts every number; a wrong
    shape is a ``ValueError``. ``threads`` is the number of threads, all cores by default.
    """

    __slots__ = ("_ndf", "_text")

    _ndf: _asperity.Ndf
    _text: str

    def __init__(self) -> None:
        raise TypeError("make a distribution by a function, for instance ggx(0.3)")

    def __repr__(self) -> str:
        return self._text

    def _evaluate(
        self, method: str, columns: int, threads: int | None, *arguments: tuple[str, npt.ArrayLike, int]
    ) -> Float32Array:
        flat, shape = joined(*arguments)
        return shaped(self._ndf.evaluate(method, flat, threads), shape, columns)

    def d(self, m: npt.ArrayLike, *, threads: int | None = None) -> Float32Array:
        """D of normals, in 1/sr; 0 below the horizon and for NaN."""
        return self._evaluate("d", 0, threads, ("m", m, 3))

    def pdf(self, m: npt.ArrayLike, *, threads: int | None = None) -> Float32Array:
        """The density of :meth:`sample` over solid angle, d cos θ, in 1/sr."""
        return self._evaluate("pdf", 0, threads, ("m", m, 3))

    def slope_density(self, slope: npt.ArrayLike, *, threads: int | None = None) -> Float32Array:
        """The density of slopes of shape ``(..., 2)``, the negative gradients of the height."""
        return self._evaluate("slope_density", 0, threads, ("slope", slope, 2))

    def sample(self, u: npt.ArrayLike, *, threads: int | None = None) -> Float32Array:
        """Normals from uniform numbers in [0, 1) of shape ``(..., 2)``."""
        return self._evaluate("sample", 3, threads, ("u", u, 2))

    def warp_gaussian(self, z: npt.ArrayLike, *, threads: int | None = None) -> Float32Array:
        """T: normals from pairs of standard normal numbers of shape ``(..., 2)``."""
        return self._evaluate("warp_gaussian", 3, threads, ("z", z, 2))

    def invert(self, m: npt.ArrayLike, *, threads: int | None = None) -> Float32Array:
        """The inverse of :meth:`warp_gaussian`, of shape ``(..., 2)``."""
        return self._evaluate("invert", 2, threads, ("m", m, 3))

    def residual_ndf(
        self, h: npt.ArrayLike, z: npt.ArrayLike, variance: npt.ArrayLike, *, threads: int | None = None
    ) -> Float32Array:
        """D of the bumps that a pixel does not resolve, at half vectors ``h``, in 1/sr.

        ``z`` are the Gaussian pairs of the resolved bumps, scaled to variance 1, and ``variance`` the
        fraction of the variance that is resolved, in [0, 1). The mean over the surface is :meth:`d`.
        """
        return self._evaluate("residual_ndf", 0, threads, ("h", h, 3), ("z", z, 2), ("variance", variance, 0))

    @recorded
    def conditional(self, z: Sequence[float] | npt.NDArray[np.floating], variance: float) -> Ndf:
        """The distribution of unresolved bumps at one place, see :meth:`residual_ndf`."""
        first, second = (float(x) for x in z)
        return _made(self._ndf.conditional((first, second), variance), f"{self}.conditional({z}, {variance})")

    @recorded
    def rotated(self, angle: float) -> Ndf:
        """The distribution rotated by an angle in radians, from x towards y."""
        return _made(self._ndf.rotated(angle), f"{self}.rotated({angle})")

    def lambda_(self, v: npt.ArrayLike, *, threads: int | None = None) -> Float32Array:
        """Smith's Λ of directions; infinite below the horizon."""
        return self._evaluate("lambda", 0, threads, ("v", v, 3))

    def projected_area(self, v: npt.ArrayLike, *, threads: int | None = None) -> Float32Array:
        """The visible area of facets from directions, per unit of the surface."""
        return self._evaluate("projected_area", 0, threads, ("v", v, 3))

    def g1(self, v: npt.ArrayLike, *, threads: int | None = None) -> Float32Array:
        """Smith's masking of directions, in [0, 1]."""
        return self._evaluate("g1", 0, threads, ("v", v, 3))

    def g2(self, v: npt.ArrayLike, w: npt.ArrayLike, *, threads: int | None = None) -> Float32Array:
        """Height-correlated masking and shadowing of two directions, in [0, 1]."""
        return self._evaluate("g2", 0, threads, ("v", v, 3), ("w", w, 3))

    def sample_visible(
        self, v: npt.ArrayLike, u: npt.ArrayLike, *, threads: int | None = None
    ) -> Float32Array:
        """Normals that are visible from ``v``, from uniform numbers of shape ``(..., 2)``."""
        return self._evaluate("sample_visible", 3, threads, ("v", v, 3), ("u", u, 2))

    def visible_pdf(self, v: npt.ArrayLike, m: npt.ArrayLike, *, threads: int | None = None) -> Float32Array:
        """The density of :meth:`sample_visible` over solid angle, in 1/sr."""
        return self._evaluate("visible_pdf", 0, threads, ("v", v, 3), ("m", m, 3))

    def image(self, size: int = 256) -> Float32Array:
        """D at the pixel centers of the (x, y) disk, shape ``(size, size)``; y is 1 at the top."""
        if not 1 <= size <= 16384:
            raise ValueError(f"`size` must be between 1 and 16384, got {size}")
        return self._ndf.texels(size).reshape(size, size)


def _made(ndf: _asperity.Ndf, text: str) -> Ndf:
    made = object.__new__(Ndf)
    made._ndf, made._text = ndf, text
    return made


def _formula(name: str, *parameters: float) -> Ndf:
    numbers = [float(x) for x in parameters]
    text = ", ".join(f"{x:g}" for x in numbers)
    return _made(_asperity.Ndf.formula(name, numbers), f"{name}({text})")


@recorded
def ggx(alpha_x: float, alpha_y: float | None = None) -> Ndf:
    """The GGX (Trowbridge–Reitz) distribution; isotropic without ``alpha_y``."""
    return _formula("ggx", alpha_x, alpha_x if alpha_y is None else alpha_y)


@recorded
def beckmann(alpha_x: float, alpha_y: float | None = None) -> Ndf:
    """The Beckmann distribution: Gaussian slopes."""
    return _formula("beckmann", alpha_x, alpha_x if alpha_y is None else alpha_y)


@recorded
def ward(alpha_x: float, alpha_y: float | None = None) -> Ndf:
    """The distribution of Ward's reflection model."""
    return _formula("ward", alpha_x, alpha_x if alpha_y is None else alpha_y)


@recorded
def student_t(alpha_x: float, alpha_y: float, gamma: float) -> Ndf:
    """The Student-t distribution; ``gamma`` 2 is GGX, and infinity the limit Beckmann."""
    return _formula("student_t", alpha_x, alpha_y, gamma)


@recorded
def blinn_phong(exponent: float) -> Ndf:
    """The distribution of Blinn and Phong, cosⁿ θ."""
    return _formula("blinn_phong", exponent)


@recorded
def ashikhmin_shirley(n_u: float, n_v: float) -> Ndf:
    """The anisotropic distribution of Ashikhmin and Shirley with two exponents."""
    return _formula("ashikhmin_shirley", n_u, n_v)


@recorded
def painted() -> Ndf:
    """Two lobes and a diffuse floor, as an artist could paint them."""
    return _made(_asperity.Ndf.painted(), "painted()")


@recorded
def isotropic(values: npt.ArrayLike) -> Ndf:
    """An isotropic distribution proportional to values at equally spaced cosines, 0 first."""
    numbers = real("values", values).ravel()
    return _made(_asperity.Ndf.isotropic([float(x) for x in numbers]), f"isotropic(<{numbers.size} values>)")


@recorded
def from_array(
    texels: npt.ArrayLike,
    *,
    measure: Literal["normals", "solid_angle"] = "normals",
    reconstruction: Literal["constant", "bilinear"] = "bilinear",
) -> Ndf:
    """A distribution from a gray image of the (x, y) disk, shape ``(height, width)``.

    The first row is the top, y = 1, as in an image. Texels outside the unit disk are ignored, and the
    scale does not matter. With the ``measure`` ``"normals"`` values are proportional to D, with
    ``"solid_angle"`` to D cos θ.
    """
    array = np.require(real("texels", texels), np.float32, ("C", "A"))
    if array.ndim != 2:
        raise ValueError(f"`texels` must have the shape (height, width), got {array.shape}")
    text = f"from_array(<{array.shape[0]}×{array.shape[1]} texels>)"
    return _made(_asperity.Ndf.from_texels(array, measure, reconstruction), text)


def from_image(
    path: str | os.PathLike[str],
    *,
    measure: Literal["normals", "solid_angle"] = "normals",
    reconstruction: Literal["constant", "bilinear"] = "constant",
) -> Ndf:
    """A distribution from the gray values of an image file: PNG, JPEG, WebP, HDR or EXR."""
    readable(path)
    return _made(_asperity.Ndf.from_image(path, measure, reconstruction), f"from_image({os.fspath(path)!r})")


def from_normal_map(
    path: str | os.PathLike[str],
    *,
    tangent_space: Literal["opengl", "directx"] | None = None,
    blue: Literal["z", "unused"] | None = None,
) -> Ndf:
    """The distribution of the normals of a normal map file."""
    readable(path)
    ndf = _asperity.Ndf.from_normal_map(path, tangent_space, blue)
    return _made(ndf, f"from_normal_map({os.fspath(path)!r})")


def estimate(normals: npt.ArrayLike) -> Ndf:
    """The distribution of measured normals of shape ``(..., 3)`` or slopes of shape ``(..., 2)``.

    Slopes are negative gradients of a height. Normals that are not finite are ignored.
    """
    flat, _ = rows("normals", normals)
    if flat.shape[1] == 2:
        up = 1.0 / np.sqrt(1.0 + np.square(flat).sum(axis=1, keepdims=True))
        flat = np.concatenate([flat * up, up], axis=1, dtype=np.float32)
    if flat.shape[1] != 3:
        raise ValueError(f"`normals` must have the shape (..., 3), or (..., 2) for slopes, got {flat.shape}")
    return _made(_asperity.Ndf.estimate(flat), f"estimate(<{len(flat)} normals>)")
