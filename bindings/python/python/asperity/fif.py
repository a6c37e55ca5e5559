"""Fractal interpolation functions: curves through knots that consist of smaller copies of themselves.

::

    from asperity import fif

    takagi = fif.affine([0, 0.5, 1], [0, 0.5, 0], scaling=0.5)
    y = takagi(np.linspace(0, 1, 1000))

Values are ``float64``. Points outside the domain are clamped, and NaN gives NaN. Results with an
error bound are pairs or triples of arrays: the true value is within ``bound`` of ``value``.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple, Union

import numpy as np
import numpy.typing as npt

from . import _asperity
from ._arrays import Float64Array, flat64, integers, real
from ._recorded import Recorded, recorded

__all__ = [
    "Bounded",
    "Estimate",
    "Extrema",
    "Fif",
    "Fit",
    "Hits",
    "Surface",
    "affine",
    "fit",
    "fit_knots",
    "folded_surface",
    "hermite",
    "periodic_surface",
    "polynomial",
    "product_surface",
]

Scaling = Union[float, npt.ArrayLike]


class Bounded(NamedTuple):
    """Values with error bounds."""

    value: Float64Array
    bound: Float64Array


class Estimate(NamedTuple):
    """Integrals with error bounds and condition numbers."""

    value: Float64Array
    bound: Float64Array
    condition: Float64Array
    """How much larger the terms of the sum are than the sum itself."""


class Extrema(NamedTuple):
    """Brackets ``(low, high)`` of the extrema and of their positions."""

    minimum: tuple[float, float]
    maximum: tuple[float, float]
    at_minimum: tuple[float, float]
    at_maximum: tuple[float, float]


class Fif(Recorded):
    """A fractal interpolation function f with f(L_j(x)) = α_j f(x) + q_j(x)."""

    __slots__ = ("_fif",)

    _fif: _asperity.Fif

    def __init__(self) -> None:
        raise TypeError("make a function from knots, for instance affine(x, y, scaling=0.5)")

    def __repr__(self) -> str:
        return f"Fif(<{len(self.knots)} knots, degree {self._fif.degree()}>)"

    def __call__(
        self, x: npt.ArrayLike, *, tolerance: float = 0.0, threads: int | None = None
    ) -> Float64Array:
        """Values at x, of the shape of x, within ``tolerance`` or as near as ``float64`` allows."""
        return self.bounded(x, tolerance=tolerance, threads=threads).value

    def bounded(
        self, x: npt.ArrayLike, *, tolerance: float = 0.0, threads: int | None = None
    ) -> Bounded:
        """Values at x with their error bounds."""
        flat, shape = flat64("x", x)
        pairs = self._fif.evaluate(flat.reshape(-1, 1), tolerance, threads).reshape(*shape, 2)
        return Bounded(pairs[..., 0], pairs[..., 1])

    def integrate(self, low: npt.ArrayLike, high: npt.ArrayLike, *, threads: int | None = None) -> Estimate:
        """Integrals from ``low`` to ``high``, which are broadcast."""
        return self._over("integral", low, high, threads)

    def mean(self, low: npt.ArrayLike, high: npt.ArrayLike, *, threads: int | None = None) -> Estimate:
        """Mean values over intervals."""
        return self._over("mean", low, high, threads)

    def _over(self, what: str, low: npt.ArrayLike, high: npt.ArrayLike, threads: int | None) -> Estimate:
        ends = np.stack(np.broadcast_arrays(real("low", low), real("high", high)), axis=-1)
        flat, shape = flat64("low", ends)
        triples = self._fif.integrate(what, flat.reshape(-1, 2), threads).reshape(*shape[:-1], 3)
        return Estimate(triples[..., 0], triples[..., 1], triples[..., 2])

    def moment(
        self, k: int, p: int = 1, low: float | None = None, high: float | None = None
    ) -> tuple[float, float, float]:
        """∫ xᵏ f(x)ᵖ dx with its error bound and condition number, over the domain by default."""
        first, last = self.domain
        if k < 0 or p < 0:
            raise ValueError(f"`k` and `p` must be at least 0, got {k} and {p}")
        return self._fif.moment(k, p, first if low is None else low, last if high is None else high)

    def extrema(
        self, low: float | None = None, high: float | None = None, *, width: float = 0.0
    ) -> Extrema:
        """Minimum and maximum over an interval, in brackets of at most ``width`` if possible."""
        first, last = self.domain
        low, high = first if low is None else low, last if high is None else high
        extrema = self._fif.extrema(low, high, width)
        if extrema is None:
            raise ValueError(f"the interval [{low}, {high}] does not meet the domain [{first}, {last}]")
        return Extrema(*extrema)

    @property
    def dimension(self) -> tuple[float, float]:
        """Lower and upper bound of the box dimension of the graph, in [1, 2]."""
        return self._fif.dimension()

    @property
    def holder_exponent(self) -> float:
        """The exponent h of |f(x) - f(y)| ≤ c |x - y|^h."""
        return self._fif.holder_exponent()

    def modulus(self, distance: npt.ArrayLike) -> Float64Array:
        """An upper bound of |f(x) - f(y)| for all points at most ``distance`` apart."""
        flat, shape = flat64("distance", distance)
        return self._fif.modulus(flat.reshape(-1, 1)).reshape(shape)

    def conditioning(self, x: npt.ArrayLike) -> Float64Array:
        """The error of the value at x that a rounding of x can cause."""
        flat, shape = flat64("x", x)
        return self._fif.conditioning(flat.reshape(-1, 1)).reshape(shape)

    @recorded
    def integral(self, y0: float = 0.0) -> Fif:
        """The integral as a function, with the value ``y0`` at the first knot."""
        return _made(self._fif.integral(y0))

    @recorded
    def derivative(self) -> Fif:
        """The derivative as a function, or a ``ValueError`` if the function is not differentiable."""
        return _made(self._fif.derivative())

    @property
    def domain(self) -> tuple[float, float]:
        """The first and the last knot."""
        return self._fif.domain()

    @property
    def range(self) -> tuple[float, float]:
        """Lower and upper bound of all values."""
        return self._fif.range()

    @property
    def knots(self) -> Float64Array:
        """The knots x."""
        return np.array(self._fif.system()[0])

    @property
    def values(self) -> Float64Array:
        """The values at the knots."""
        return np.array(self._fif.system()[1])

    @property
    def scaling(self) -> Float64Array:
        """The vertical scaling α of every map."""
        return np.array(self._fif.system()[2])

    @property
    def polynomials(self) -> Float64Array:
        """The coefficients of the polynomial of every map, constants first."""
        return np.array(self._fif.system()[3])


def _made(fif: _asperity.Fif) -> Fif:
    made = object.__new__(Fif)
    made._fif = fif
    return made


def _list(name: str, numbers: npt.ArrayLike) -> list[float]:
    array = real(name, numbers)
    if array.ndim != 1:
        raise ValueError(f"`{name}` must have one axis, got the shape {array.shape}")
    return [float(x) for x in array]


def _scalings(scaling: Scaling, maps: int) -> list[float]:
    array = real("scaling", scaling)
    return [float(array)] * max(maps, 0) if array.ndim == 0 else _list("scaling", array)


@recorded
def affine(x: npt.ArrayLike, y: npt.ArrayLike, scaling: Scaling = 0.0) -> Fif:
    """The function through points, with one vertical scaling for all maps or one for each.

    Scalings are below 1 in magnitude. 0 is the polygon through the points.
    """
    knots = _list("x", x)
    return _made(_asperity.Fif.affine(knots, _list("y", y), _scalings(scaling, len(knots) - 1)))


@recorded
def hermite(x: npt.ArrayLike, y: npt.ArrayLike, slope: npt.ArrayLike, scaling: Scaling = 0.0) -> Fif:
    """The differentiable function through points with slopes, of degree 3."""
    knots = _list("x", x)
    scalings = _scalings(scaling, len(knots) - 1)
    return _made(_asperity.Fif.hermite(knots, _list("y", y), _list("slope", slope), scalings))


@recorded
def polynomial(x: npt.ArrayLike, scaling: Scaling, polynomials: npt.ArrayLike) -> Fif:
    """The function with a polynomial for every map, shape ``(maps, coefficients)``, constants first."""
    knots, rows = _list("x", x), real("polynomials", polynomials)
    if rows.ndim != 2:
        raise ValueError(f"`polynomials` must have the shape (maps, coefficients), got {rows.shape}")
    q = [[float(c) for c in row] for row in rows]
    return _made(_asperity.Fif.polynomial(knots, _scalings(scaling, len(knots) - 1), q))


class Fit(NamedTuple):
    """A function that fits data."""

    function: Fif
    error: float
    """The largest distance from the data."""
    rms: float
    """The root mean square distance from the data."""
    collage: float
    """The largest distance of the collage from the data."""
    bound: float
    """The bound of the error by the collage theorem."""


def fit(x: npt.ArrayLike, y: npt.ArrayLike, knots: Sequence[int], *, steps: int = 0) -> Fit:
    """The affine function that fits data between the knots, which are indices of the data.

    ``steps`` of refinement minimize the error itself in place of the error of the collage.
    """
    indices = integers("knots", knots)
    if steps < 0 or any(k < 0 for k in indices):
        raise ValueError("`knots` and `steps` must be at least 0")
    function, numbers = _asperity.Fif.fit(_list("x", x), _list("y", y), indices, steps)
    return Fit(_made(function), *numbers)


def fit_knots(
    x: npt.ArrayLike, y: npt.ArrayLike, tolerance: float, *, longest: int = 64
) -> npt.NDArray[np.intp]:
    """Indices of data that are knots of a fit within ``tolerance``, at most ``longest`` apart."""
    if longest < 0:
        raise ValueError(f"`longest` must be at least 1, got {longest}")
    return np.array(_asperity.Fif.fit_knots(_list("x", x), _list("y", y), tolerance, longest), dtype=np.intp)


class Hits(NamedTuple):
    """First hits of rays; NaN and ``False`` for rays without a hit."""

    t: Float64Array
    """Distances in units of the direction, shape ``(...)``."""
    point: Float64Array
    """Points x, y and height, shape ``(..., 3)``."""
    normal: Float64Array
    """Unit normals, shape ``(..., 3)``, NaN where the surface has none."""
    certain: npt.NDArray[np.bool_]
    """Whether the hit is proved to be the first."""


class Surface(Recorded):
    """A fractal height field z = h(x, y)."""

    __slots__ = ("_surface",)

    _surface: _asperity.Surface

    def __init__(self) -> None:
        raise TypeError("make a surface by a function, for instance product_surface(f, g)")

    def __repr__(self) -> str:
        return f"Surface(<domain {self.domain}>)"

    def __call__(
        self, points: npt.ArrayLike, *, tolerance: float = 0.0, threads: int | None = None
    ) -> Float64Array:
        """Heights at points of shape ``(..., 2)``."""
        return self.bounded(points, tolerance=tolerance, threads=threads).value

    def bounded(
        self, points: npt.ArrayLike, *, tolerance: float = 0.0, threads: int | None = None
    ) -> Bounded:
        """Heights at points with their error bounds."""
        flat, shape = _points("points", points, 2)
        pairs = self._surface.evaluate(flat, tolerance, threads).reshape(*shape, 2)
        return Bounded(pairs[..., 0], pairs[..., 1])

    def gradient(self, points: npt.ArrayLike, *, threads: int | None = None) -> Float64Array:
        """Gradients of the height at points, shape ``(..., 2)``; NaN where it has no derivative."""
        flat, shape = _points("points", points, 2)
        return self._surface.gradient(flat, threads).reshape(*shape, 2)

    def intersect(
        self,
        origin: npt.ArrayLike,
        direction: npt.ArrayLike,
        *,
        low: float = 0.0,
        high: float = np.inf,
        tolerance: float = 0.0,
        threads: int | None = None,
    ) -> Hits:
        """First hits of rays from ``origin`` along ``direction``, both ``(..., 3)`` and broadcast."""
        origins, directions = np.broadcast_arrays(real("origin", origin), real("direction", direction))
        if origins.ndim == 0 or origins.shape[-1] != 3:
            raise ValueError(f"`origin` and `direction` must have the shape (..., 3), got {origins.shape}")
        flat, shape = _points("origin", np.concatenate([origins, directions], axis=-1), 6)
        hits = self._surface.intersect(flat, (low, high), tolerance, threads).reshape(*shape, 8)
        return Hits(hits[..., 0], hits[..., 1:4], hits[..., 4:7], hits[..., 7] == 1.0)

    @property
    def domain(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """The ends of the domain along x and along y."""
        x, y = self._surface.domain()
        return x, y

    @property
    def range(self) -> tuple[float, float]:
        """Lower and upper bound of the heights."""
        return self._surface.range()


def _points(name: str, points: npt.ArrayLike, columns: int) -> tuple[Float64Array, tuple[int, ...]]:
    flat, shape = flat64(name, points)
    if not shape or shape[-1] != columns:
        raise ValueError(f"`{name}` must have the shape (..., {columns}), got {shape}")
    return flat.reshape(-1, columns), shape[:-1]


def _made_surface(surface: _asperity.Surface) -> Surface:
    made = object.__new__(Surface)
    made._surface = surface
    return made


@recorded
def product_surface(f: Fif, g: Fif) -> Surface:
    """The surface f(x) g(y), with exact normals if both functions are differentiable."""
    return _made_surface(_asperity.Surface.product(f._fif, g._fif))


@recorded
def periodic_surface(
    heights: npt.ArrayLike,
    *,
    scaling: float,
    gradients: npt.ArrayLike | None = None,
    matrix: Sequence[Sequence[int]] = ((2, 0), (0, 2)),
) -> Surface:
    """A surface of period 1 through heights at the nodes (i, j)/side, shape ``(side, side)``.

    ``gradients`` has the shape ``(side, side, 2)``, 0 by default. ``matrix`` maps the torus to
    itself, and |scaling| times its norm is below 1.
    """
    z, d = _nodes(heights, gradients)
    if z.ndim != 2 or z.shape[0] != z.shape[1]:
        raise ValueError(f"`heights` must have the shape (side, side), got {z.shape}")
    (a, b), (c, e) = ((int(x) for x in row) for row in matrix)
    surface = _asperity.Surface.periodic(z.shape[0], ((a, b), (c, e)), scaling, _flat(z), _pairs(d))
    return _made_surface(surface)


@recorded
def folded_surface(
    x: npt.ArrayLike,
    y: npt.ArrayLike,
    heights: npt.ArrayLike,
    *,
    scaling: Scaling,
    gradients: npt.ArrayLike | None = None,
) -> Surface:
    """A surface over a grid of knots, ``heights`` of shape ``(len(x), len(y))``.

    One scaling gives a differentiable surface. A scaling for each node, of the shape of the heights,
    gives a rough surface without gradients.
    """
    z, d = _nodes(heights, gradients)
    knots = _list("x", x), _list("y", y)
    scalings = real("scaling", scaling)
    if scalings.ndim == 0:
        return _made_surface(_asperity.Surface.folded(*knots, float(scalings), _flat(z), _pairs(d)))
    return _made_surface(_asperity.Surface.rough_folded(*knots, _flat(scalings), _flat(z), _pairs(d)))


def _nodes(heights: npt.ArrayLike, gradients: npt.ArrayLike | None) -> tuple[Float64Array, Float64Array]:
    z = np.asarray(real("heights", heights), dtype=np.float64)
    if gradients is None:
        return z, np.zeros((*z.shape, 2))
    d = np.asarray(real("gradients", gradients), dtype=np.float64)
    if d.shape != (*z.shape, 2):
        raise ValueError(f"`gradients` must have the shape {(*z.shape, 2)}, got {d.shape}")
    return z, d


def _flat(numbers: npt.NDArray[Any]) -> list[float]:
    return [float(x) for x in numbers.ravel()]


def _pairs(numbers: Float64Array) -> list[tuple[float, float]]:
    return [(float(x), float(y)) for x, y in numbers.reshape(-1, 2)]
