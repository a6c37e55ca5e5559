"""BSDFs and materials: evaluation, importance sampling and densities over arrays of directions.

::

    from asperity import ndf, shading

    gold = shading.metal(ndf.ggx(0.3), f0=(1.0, 0.78, 0.34))
    light = gold.eval(wo, wi)

Directions are unit vectors of shape ``(..., 3)`` in the frame of the surface, whose z axis is the
normal. They point away from it: ``wo`` to the eye, ``wi`` to the light. Colors are linear RGB. Every
input is accepted; the result is 0 where a direction is below the horizon or not finite.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any, NamedTuple, Union

import numpy as np
import numpy.typing as npt

from . import _asperity
from ._arrays import Float32Array, joined, shaped
from ._recorded import Recorded, recorded
from .ndf import Ndf

__all__ = [
    "Bsdf",
    "Samples",
    "charlie_sheen",
    "conductor",
    "dielectric",
    "ggx_glass",
    "ggx_metal",
    "lambert",
    "metal",
    "open_pbr",
    "oren_nayar",
    "phong",
    "standard_material",
    "zeltner_fuzz",
]

Color = Union[float, Sequence[float]]


class Samples(NamedTuple):
    """Sampled directions; the pdf is 0 where there is no sample."""

    wi: Float32Array
    """Directions to the light, shape ``(..., 3)``."""
    eval_cos: Float32Array
    """f |cos θ| in 1/sr, or the scattered fraction of a specular sample, shape ``(..., 3)``."""
    pdf: Float32Array
    """Densities over solid angle in 1/sr, or the probability of a specular sample."""
    specular: npt.NDArray[np.bool_]
    """Whether the direction is a single one, without a density."""
    transmitted: npt.NDArray[np.bool_]
    """Whether the light comes from the other side of the surface."""

    @property
    def weight(self) -> Float32Array:
        """The factor of the throughput of a path, ``eval_cos / pdf``, 0 where there is no sample."""
        pdf = self.pdf[..., None]
        return np.divide(self.eval_cos, pdf, out=np.zeros_like(self.eval_cos), where=pdf > 0)


class Bsdf(Recorded):
    """A bidirectional scattering distribution function in the frame of the surface."""

    __slots__ = ("_bsdf", "_text")

    _bsdf: _asperity.Bsdf
    _text: str

    def __init__(self) -> None:
        raise TypeError("make a BSDF by a function, for instance lambert(0.8)")

    def __repr__(self) -> str:
        return self._text

    @property
    def transmits(self) -> bool:
        """Whether directions below the surface are valid."""
        return self._bsdf.transmits()

    def eval(self, wo: npt.ArrayLike, wi: npt.ArrayLike, *, threads: int | None = None) -> Float32Array:
        """f(wo, wi) in 1/sr, without the cosine, shape ``(..., 3)``."""
        flat, shape = joined(("wo", wo, 3), ("wi", wi, 3))
        return shaped(self._bsdf.eval(flat, threads), shape, 3)

    def pdf(self, wo: npt.ArrayLike, wi: npt.ArrayLike, *, threads: int | None = None) -> Float32Array:
        """The density of :meth:`sample` over solid angle, in 1/sr, shape ``(...)``."""
        flat, shape = joined(("wo", wo, 3), ("wi", wi, 3))
        return shaped(self._bsdf.pdf(flat, threads), shape, 0)

    def sample(
        self, wo: npt.ArrayLike, uc: npt.ArrayLike, u: npt.ArrayLike, *, threads: int | None = None
    ) -> Samples:
        """Directions to the light for light that leaves along ``wo``.

        ``uc`` selects a lobe, shape ``(...)``, and ``u`` a direction, shape ``(..., 2)``; all are
        uniform in [0, 1).
        """
        flat, shape = joined(("wo", wo, 3), ("uc", uc, 0), ("u", u, 2))
        rows = shaped(self._bsdf.sample(flat, threads), shape, 8)
        kind = rows[..., 7]
        return Samples(rows[..., :3], rows[..., 3:6], rows[..., 6], kind >= 3, (kind == 2) | (kind == 4))


def _made(bsdf: _asperity.Bsdf, text: str) -> Bsdf:
    made = object.__new__(Bsdf)
    made._bsdf, made._text = bsdf, text
    return made


def _color(name: str, color: Color) -> tuple[float, float, float]:
    numbers = np.asarray(color, dtype=np.float64)
    if numbers.shape not in ((), (3,)):
        raise ValueError(f"`{name}` must be a number or three, got the shape {numbers.shape}")
    red, green, blue = np.broadcast_to(numbers, (3,)).tolist()
    return red, green, blue


def _microfacets(ndf: object) -> _asperity.Ndf:
    if not isinstance(ndf, Ndf):
        raise TypeError(f"`ndf` must be a distribution of asperity.ndf, got {ndf!r}")
    return ndf._ndf


@recorded
def lambert(albedo: Color) -> Bsdf:
    """Diffuse reflection, albedo/π."""
    return _made(_asperity.Bsdf.lambert(_color("albedo", albedo)), f"lambert({albedo})")


@recorded
def oren_nayar(albedo: Color, roughness: float) -> Bsdf:
    """Energy-preserving Oren–Nayar reflection (EON) with a roughness in [0, 1]."""
    bsdf = _asperity.Bsdf.oren_nayar(_color("albedo", albedo), roughness)
    return _made(bsdf, f"oren_nayar({albedo}, {roughness})")


@recorded
def phong(specular: Color, exponent: float) -> Bsdf:
    """Normalized Phong reflection."""
    return _made(_asperity.Bsdf.phong(_color("specular", specular), exponent), f"phong({specular}, {exponent})")


@recorded
def charlie_sheen(color: Color, alpha: float) -> Bsdf:
    """Sheen of cloth after Estevez and Kulla."""
    bsdf = _asperity.Bsdf.charlie_sheen(_color("color", color), alpha)
    return _made(bsdf, f"charlie_sheen({color}, {alpha})")


@recorded
def zeltner_fuzz(color: Color, alpha: float) -> Bsdf:
    """Fuzz of cloth by linearly transformed cosines, after Zeltner, Burley and Chiang."""
    return _made(_asperity.Bsdf.zeltner_fuzz(_color("color", color), alpha), f"zeltner_fuzz({color}, {alpha})")


@recorded
def metal(ndf: Ndf, f0: Color) -> Bsdf:
    """Microfacet mirrors with any distribution and the reflectance ``f0`` at normal incidence."""
    return _made(_asperity.Bsdf.metal(_microfacets(ndf), _color("f0", f0)), f"metal({ndf}, {f0})")


@recorded
def conductor(ndf: Ndf, eta: Color, k: Color) -> Bsdf:
    """Microfacet mirrors with the index of refraction eta + i k per channel."""
    bsdf = _asperity.Bsdf.conductor(_microfacets(ndf), _color("eta", eta), _color("k", k))
    return _made(bsdf, f"conductor({ndf}, {eta}, {k})")


@recorded
def dielectric(ndf: Ndf, ior: float, *, thin: Color | None = None) -> Bsdf:
    """Rough glass with a relative index of refraction; ``thin`` is the tint of a thin pane."""
    tint = None if thin is None else _color("thin", thin)
    return _made(_asperity.Bsdf.dielectric(_microfacets(ndf), ior, tint), f"dielectric({ndf}, {ior})")


@recorded
def ggx_metal(alpha_x: float, alpha_y: float | None = None, *, f0: Color) -> Bsdf:
    """GGX mirrors with every bounce between facets."""
    alpha_y = alpha_x if alpha_y is None else alpha_y
    return _made(_asperity.Bsdf.ggx_metal(alpha_x, alpha_y, _color("f0", f0)), f"ggx_metal({alpha_x}, {alpha_y})")


@recorded
def ggx_glass(alpha_x: float, alpha_y: float | None = None, *, ior: float) -> Bsdf:
    """Rough GGX glass with every bounce: reflection plus transmission is 1."""
    alpha_y = alpha_x if alpha_y is None else alpha_y
    return _made(_asperity.Bsdf.ggx_glass(alpha_x, alpha_y, ior), f"ggx_glass({alpha_x}, {alpha_y}, {ior})")


@recorded
def standard_material(**parameters: Any) -> Bsdf:
    """The material of glTF 2.0 with its extensions.

    Keywords are ``base_color``, ``metallic``, ``roughness``, ``emissive``, ``ior``, ``specular``,
    ``specular_color``, ``clearcoat``, ``clearcoat_roughness``, ``sheen_color``,
    ``sheen_roughness``, ``transmission``, ``thickness``, ``anisotropy`` and
    ``anisotropy_rotation``, with the defaults of glTF. Colors are three numbers.
    """
    return _made(_asperity.Bsdf.standard_material(_json(parameters)), f"standard_material(**{parameters})")


@recorded
def open_pbr(**parameters: Any) -> Bsdf:
    """The material of OpenPBR Surface 1.1; keywords are the parameters of the specification."""
    return _made(_asperity.Bsdf.open_pbr(_json(parameters)), f"open_pbr(**{parameters})")


def _json(parameters: dict[str, Any]) -> str:
    def plain(value: object) -> object:
        return value.tolist() if isinstance(value, (np.ndarray, np.generic)) else value

    try:
        return json.dumps({name: plain(value) for name, value in parameters.items()}, allow_nan=False)
    except (TypeError, ValueError) as error:
        raise ValueError(f"parameters must be finite numbers or colors: {error}") from None
