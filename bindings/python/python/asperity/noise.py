"""Noise with analytic gradients and Hessians, in one to four dimensions.

Every noise, sum and transform is a :class:`Noise`. It is called with points of shape ``(..., N)``
and returns ``float32`` values of shape ``(...)``::

    from asperity.noise import Fbm, Perlin

    land = Fbm(Perlin(seed=1), octaves=6)
    values = land(points)                       # any array of points
    heights = land.grid((512, 512), step=1/64)  # an image
    heights, slopes = land.grid((512, 512), step=1/64, with_gradient=True)

The bits of values and gradients are the bits of the Rust crate ``asperity-noise``, on every machine
and for any number of threads.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import ClassVar, Literal, NamedTuple, Union, overload

import numpy as np
import numpy.typing as npt

from ._arrays import Float32Array, integers, real, rows, seed32
from ._asperity import Field
from ._recorded import Recorded, recorded, text_of

__all__ = [
    "Cellular",
    "Fbm",
    "Gaussian",
    "Noise",
    "Perlin",
    "PerlinClassic",
    "RidgedMultifractal",
    "Sample",
    "SampleHessian",
    "Simplex",
    "SparseConvolution",
    "Value",
    "ValueCatmullRom",
    "ValueGradient",
    "White",
    "curl",
]

Period = Union[int, Sequence[int], None]
Anchor = Union[float, Sequence[float], None]


class Sample(NamedTuple):
    """Values and gradients."""

    value: Float32Array
    """Values, shape ``(...)``."""
    gradient: Float32Array
    """Derivatives along each coordinate, shape ``(..., N)``, per unit of the points."""


class SampleHessian(NamedTuple):
    """Values, gradients and Hessians."""

    value: Float32Array
    """Values, shape ``(...)``."""
    gradient: Float32Array
    """Derivatives along each coordinate, shape ``(..., N)``."""
    hessian: Float32Array
    """Second derivatives, shape ``(..., N, N)``, symmetric bit for bit."""


class Noise(Recorded):
    """A random function of points with its gradient.

    Noises are made by the classes of kinds, such as :class:`Perlin`, by sums such as :class:`Fbm`,
    and by operators: ``a + 0.5 * b``, ``a * b``, ``-a``, ``a ** 2``, and the methods below.
    A point with an infinite or NaN coordinate has value 0 and gradient 0 in every kind.
    """

    __slots__ = ("_field", "_text")
    # NumPy scalars on the left of an operator leave it to this class.
    __array_ufunc__ = None

    _field: Field
    _text: str

    def __init__(self) -> None:
        raise TypeError("make a noise by a kind, for instance Perlin(seed=1)")

    def __repr__(self) -> str:
        return self._text

    @overload
    def __call__(
        self,
        points: npt.ArrayLike,
        *,
        with_gradient: Literal[False] = False,
        with_hessian: Literal[False] = False,
        threads: int | None = None,
    ) -> Float32Array: ...
    @overload
    def __call__(
        self,
        points: npt.ArrayLike,
        *,
        with_gradient: Literal[True],
        with_hessian: Literal[False] = False,
        threads: int | None = None,
    ) -> Sample: ...
    @overload
    def __call__(
        self,
        points: npt.ArrayLike,
        *,
        with_gradient: bool = False,
        with_hessian: Literal[True],
        threads: int | None = None,
    ) -> SampleHessian: ...
    def __call__(
        self,
        points: npt.ArrayLike,
        *,
        with_gradient: bool = False,
        with_hessian: bool = False,
        threads: int | None = None,
    ) -> Float32Array | Sample | SampleHessian:
        """Values at points of shape ``(..., N)``, N from 1 to 4.

        C-contiguous ``float32`` arrays are read without a copy, others are converted. ``threads`` is
        the number of threads, all cores by default; it changes no bit.
        """
        return self._values("points", points, with_gradient, with_hessian, threads)

    @overload
    def at(
        self,
        *coordinates: npt.ArrayLike,
        with_gradient: Literal[False] = False,
        with_hessian: Literal[False] = False,
        threads: int | None = None,
    ) -> Float32Array: ...
    @overload
    def at(
        self,
        *coordinates: npt.ArrayLike,
        with_gradient: Literal[True],
        with_hessian: Literal[False] = False,
        threads: int | None = None,
    ) -> Sample: ...
    @overload
    def at(
        self,
        *coordinates: npt.ArrayLike,
        with_gradient: bool = False,
        with_hessian: Literal[True],
        threads: int | None = None,
    ) -> SampleHessian: ...
    def at(
        self,
        *coordinates: npt.ArrayLike,
        with_gradient: bool = False,
        with_hessian: bool = False,
        threads: int | None = None,
    ) -> Float32Array | Sample | SampleHessian:
        """Values at coordinates ``x``, ``y``, … that are broadcast against each other."""
        if not coordinates:
            raise ValueError("`coordinates` must be 1 to 4 arrays, got 0")
        points = np.stack(np.broadcast_arrays(*coordinates), axis=-1)
        return self._values("coordinates", points, with_gradient, with_hessian, threads)

    def _values(
        self, name: str, points: npt.ArrayLike, with_gradient: bool, with_hessian: bool, threads: int | None
    ) -> Float32Array | Sample | SampleHessian:
        flat, shape = rows(name, points)
        arrays = _arrays(flat.shape[0], flat.shape[1], with_gradient, with_hessian)
        self._field.evaluate(flat, arrays, threads)
        return _result(arrays, shape, flat.shape[1])

    @overload
    def grid(
        self,
        shape: int | Sequence[int],
        step: float | Sequence[float],
        *,
        origin: float | Sequence[float] = 0.0,
        with_gradient: Literal[False] = False,
        with_hessian: Literal[False] = False,
        threads: int | None = None,
    ) -> Float32Array: ...
    @overload
    def grid(
        self,
        shape: int | Sequence[int],
        step: float | Sequence[float],
        *,
        origin: float | Sequence[float] = 0.0,
        with_gradient: Literal[True],
        with_hessian: Literal[False] = False,
        threads: int | None = None,
    ) -> Sample: ...
    @overload
    def grid(
        self,
        shape: int | Sequence[int],
        step: float | Sequence[float],
        *,
        origin: float | Sequence[float] = 0.0,
        with_gradient: bool = False,
        with_hessian: Literal[True],
        threads: int | None = None,
    ) -> SampleHessian: ...
    def grid(
        self,
        shape: int | Sequence[int],
        step: float | Sequence[float],
        *,
        origin: float | Sequence[float] = 0.0,
        with_gradient: bool = False,
        with_hessian: bool = False,
        threads: int | None = None,
    ) -> Float32Array | Sample | SampleHessian:
        """Values on a regular grid of the given shape, faster than a list of the same points.

        The shape is a NumPy shape: ``(height, width)`` is an image whose last axis is x, and
        ``(depth, height, width)`` a volume. ``step`` and ``origin`` are in the order x, y, z, w. The
        point of index ``[j, i]`` is ``origin + step * (i, j)``.
        """
        size = tuple(integers("shape", shape))
        if any(n < 0 or n >= 2**31 for n in size):
            raise ValueError(f"`shape` must have numbers from 0 to 2147483647, got {size}")
        steps, origins = _axes("step", step, len(size)), _axes("origin", origin, len(size))
        arrays = _arrays(math.prod(size), len(size), with_gradient, with_hessian)
        self._field.grid(list(reversed(size)), steps, origins, arrays, threads)
        return _result(arrays, size, len(size))

    def range(self, dimension: int) -> tuple[float, float]:
        """Lower and upper bound of the values in 1 to 4 dimensions, infinite if unknown."""
        return self._field.range(dimension)

    @recorded
    def __add__(self, other: Noise | float) -> Noise:
        if isinstance(other, Noise):
            return _made(self._field.add(other._field), f"({self} + {other})")
        return self.scale(1.0, other)

    def __radd__(self, other: float) -> Noise:
        return self.scale(1.0, other)

    def __sub__(self, other: Noise | float) -> Noise:
        return self + (-other)

    def __rsub__(self, other: float) -> Noise:
        return self.scale(-1.0, other)

    @recorded
    def __mul__(self, other: Noise | float) -> Noise:
        if isinstance(other, Noise):
            return _made(self._field.multiply(other._field), f"({self} * {other})")
        return self.scale(other)

    def __rmul__(self, other: float) -> Noise:
        return self.scale(other)

    def __truediv__(self, other: float) -> Noise:
        return self.scale(1.0 / other)

    def __neg__(self) -> Noise:
        return self.scale(-1.0)

    @recorded
    def __pow__(self, exponent: int) -> Noise:
        if not 0 <= exponent <= 255:
            raise ValueError(f"`exponent` must be between 0 and 255, got {exponent}")
        return _made(self._field.power(exponent), f"{self} ** {exponent}")

    @recorded
    def scale(self, factor: float, offset: float = 0.0) -> Noise:
        """``factor * value + offset``."""
        return _made(self._field.scale_bias(factor, offset), f"{self}.scale({factor}, {offset})")

    @recorded
    def clamp(self, low: float, high: float) -> Noise:
        """Values clamped to two bounds; the gradient is 0 where it clamps."""
        return _made(self._field.clamp(low, high), f"{self}.clamp({low}, {high})")

    @recorded
    def unit(self) -> Noise:
        """Values mapped from the range of the noise to [0, 1]; 0.5 if the range is unknown."""
        return _made(self._field.unit(), f"{self}.unit()")

    @recorded
    def blend(self, other: Noise | float, weight: Noise | float) -> Noise:
        """``self + weight * (other - self)``; the weight is not clamped."""
        other, weight = (self.scale(0.0, x) if isinstance(x, (int, float)) else x for x in (other, weight))
        field = self._field.blend(_field("other", other), _field("weight", weight))
        return _made(field, f"{self}.blend({other}, {weight})")

    @recorded
    def at_frequency(self, frequency: float) -> Noise:
        """The noise at points times a frequency."""
        if not math.isfinite(frequency):
            raise ValueError(f"`frequency` must be finite, got {frequency}")
        return _made(self._field.at_frequency(frequency), f"{self}.at_frequency({frequency})")

    @recorded
    def warp(self, by: Noise | Sequence[Noise], strength: float) -> Noise:
        """The noise at points displaced by ``strength`` times the values of other noises.

        ``by`` is one noise per coordinate. A single noise displaces x as it is, and the other
        coordinates with seeds derived from its own.
        """
        fields = list(by) if isinstance(by, Sequence) else [by]
        if not fields:
            raise ValueError("`by` must be one noise or one per coordinate, got 0")
        text = repr(by) if isinstance(by, Noise) else repr(fields)
        field = self._field.warp([_field("by", field) for field in fields], strength)
        return _made(field, f"{self}.warp({text}, {strength})")


def _made(field: Field, text: str) -> Noise:
    noise = object.__new__(Noise)
    noise._field, noise._text = field, text
    return noise


def _field(name: str, noise: object) -> Field:
    if not isinstance(noise, Noise):
        raise TypeError(f"`{name}` must be a noise, got {noise!r}")
    return noise._field


def _arrays(count: int, dimension: int, with_gradient: bool, with_hessian: bool) -> list[Float32Array]:
    """Arrays for values, gradients and Hessians of points."""
    order = 2 if with_hessian else int(with_gradient)
    return [np.empty(count * dimension**each, np.float32) for each in range(order + 1)]


def _result(
    arrays: list[Float32Array], shape: tuple[int, ...], dimension: int
) -> Float32Array | Sample | SampleHessian:
    shaped = [array.reshape(shape + (dimension,) * each) for each, array in enumerate(arrays)]
    if len(shaped) == 1:
        return shaped[0]
    return Sample(*shaped) if len(shaped) == 2 else SampleHessian(*shaped)


def _axes(name: str, numbers: float | Sequence[float], dimension: int) -> list[float]:
    array = real(name, numbers)
    if not np.isfinite(array).all():
        raise ValueError(f"`{name}` must be finite, got {numbers}")
    return [float(x) for x in (np.broadcast_to(array, dimension) if array.ndim == 0 else array.ravel())]


def _anchor(anchor: Anchor, frequency: float) -> list[float] | None:
    """The anchor in cells, one number for all axes or one for each."""
    if anchor is None:
        return None
    return [float(x) * frequency for x in np.atleast_1d(anchor)]


def _periods(periods: Period) -> list[int] | None:
    if periods is None:
        return None
    numbers = integers("period", periods)
    for axis, period in enumerate(numbers):
        if not 1 <= period <= 2**21:
            raise ValueError(f"`period` of axis {axis} must be between 1 and 2097152, got {period}")
    return numbers


class _Kind(Noise):
    """A kind of noise."""

    __slots__ = ()
    _name: ClassVar[str]

    def __init__(
        self, seed: int = 0, *, frequency: float = 1.0, period: Period = None, anchor: Anchor = None
    ) -> None:
        self._make(seed, frequency, period, anchor)

    def _make(
        self,
        seed: int,
        frequency: float,
        period: Period,
        anchor: Anchor,
        *,
        weight: float = 0.5,
        impulses: int = 1,
        output: str = "f1",
        metric: str = "euclidean",
        jitter: float = 1.0,
        classic: bool = False,
    ) -> None:
        if period is not None and anchor is not None:
            raise ValueError("`period` and `anchor` exclude each other: move the anchor by whole periods")
        field = Field.kind(
            self._name,
            seed32(seed),
            period=_periods(period),
            anchor=_anchor(anchor, frequency),
            weight=weight,
            impulses=impulses,
            output=output,
            metric=metric,
            jitter=jitter,
            classic=classic,
        )
        self._field = _with_frequency(field, frequency)
        self._text = text_of(self)


def _with_frequency(field: Field, frequency: float) -> Field:
    if frequency == 1.0:
        return field
    if not math.isfinite(frequency):
        raise ValueError(f"`frequency` must be finite, got {frequency}")
    return field.at_frequency(frequency)


class White(_Kind):
    """White noise: one uniform value in [-1, 1] per cell.

    ``frequency`` is in cells per unit of the points. ``period`` makes the noise repeat after that
    many cells, one number for all axes or one for each. ``anchor`` is a far place, in units of the
    points, whose surroundings keep their precision: the value at p is the value of the noise at anchor + p.
    """

    __slots__ = ()
    _name = "white"


class Value(_Kind):
    """Value noise: random lattice values, blended with quintic weights. Has a Hessian."""

    __slots__ = ()
    _name = "value"


class ValueCatmullRom(_Kind):
    """Value noise: random lattice values, blended by a Catmull-Rom spline over 4^N points."""

    __slots__ = ()
    _name = "value_catmull_rom"


class PerlinClassic(_Kind):
    """Perlin noise of 1985: unit gradients and cubic weights. Has a Hessian."""

    __slots__ = ()
    _name = "perlin_classic"


class Perlin(_Kind):
    """Improved Perlin noise of 2002, in [-1, 1]. Has a Hessian.

    ``frequency`` is in cells per unit of the points. ``period`` makes the noise repeat after that
    many cells, one number for all axes or one for each. ``anchor`` is a far place, in units of the
    points, whose surroundings keep their precision: the value at p is the value of the noise at anchor + p.
    """

    __slots__ = ()
    _name = "perlin"


class ValueGradient(_Kind):
    """Value-gradient noise: ``weight`` of value noise plus the rest of gradient noise. Has a Hessian."""

    __slots__ = ()
    _name = "value_gradient"

    def __init__(
        self,
        seed: int = 0,
        *,
        weight: float = 0.5,
        frequency: float = 1.0,
        period: Period = None,
        anchor: Anchor = None,
    ) -> None:
        self._make(seed, frequency, period, anchor, weight=weight)


class Simplex(_Kind):
    """Simplex noise, in [-1, 1]. Has a Hessian.

    ``classic_radius`` selects the radius of 2001, r² = 0.6, which is discontinuous. Simplex noise
    has periods in 1-D, and in 3-D multiples of 3 without a Hessian.
    """

    __slots__ = ()
    _name = "simplex"

    def __init__(
        self,
        seed: int = 0,
        *,
        classic_radius: bool = False,
        frequency: float = 1.0,
        period: Period = None,
        anchor: Anchor = None,
    ) -> None:
        self._make(seed, frequency, period, anchor, classic=classic_radius)


class SparseConvolution(_Kind):
    """Sparse convolution noise: ``impulses`` per cell at random positions, standard deviation 1."""

    __slots__ = ()
    _name = "sparse_convolution"

    def __init__(
        self,
        seed: int = 0,
        *,
        impulses: int = 1,
        frequency: float = 1.0,
        period: Period = None,
        anchor: Anchor = None,
    ) -> None:
        if not 0 <= impulses < 2**32:
            raise ValueError(f"`impulses` must be between 1 and 4, got {impulses}")
        self._make(seed, frequency, period, anchor, impulses=impulses)


class Cellular(_Kind):
    """Cellular (Worley) noise: distances to the nearest feature points, in cells.

    ``output`` is the distance to the nearest point ``"f1"``, to the second ``"f2"``, their
    difference ``"f2_minus_f1"``, or a random number of the nearest point, ``"cell"``.
    """

    __slots__ = ()
    _name = "cellular"

    def __init__(
        self,
        seed: int = 0,
        *,
        output: Literal["f1", "f2", "f2_minus_f1", "cell"] = "f1",
        metric: Literal["euclidean", "manhattan", "chebyshev"] = "euclidean",
        jitter: float = 1.0,
        frequency: float = 1.0,
        period: Period = None,
        anchor: Anchor = None,
    ) -> None:
        self._make(seed, frequency, period, anchor, output=output, metric=metric, jitter=jitter)


class Gaussian(_Kind):
    """Gaussian noise: values with the distribution N(0, 1) at every point. Has a Hessian."""

    __slots__ = ()
    _name = "gaussian"


class Fbm(Noise):
    """Fractional Brownian motion: a sum of octaves of a noise, with variance 1 by default.

    The noise is a kind, and each octave has another seed, or it is any other noise, and the octaves
    are the same function at other places. ``octaves`` is a real number, all by default; a fraction fades
    in the last octave. ``lacunarity`` is the ratio of frequencies, 2.17 and in tiles 2 by default,
    and ``gain`` the ratio of amplitudes. ``shape`` is applied to every octave. ``rotation="aligned"``
    is faster on grids. Octaves that a pixel of the width ``footprint`` cannot resolve are replaced by
    their mean; ``footprint`` is in units of the points. ``period`` and ``anchor`` are as in :class:`Perlin`.
    """

    __slots__ = ()

    def __init__(
        self,
        noise: Noise,
        *,
        octaves: float | None = None,
        lacunarity: float | None = None,
        gain: float = 0.5,
        max_octaves: int | None = None,
        shape: Literal["signed", "turbulence", "plasma", "billow", "ridged"] = "signed",
        normalization: Literal["unit_variance", "unit_range"] | None = None,
        rotation: Literal["random", "aligned"] = "random",
        footprint: float = 0.0,
        frequency: float = 1.0,
        period: Period = None,
        anchor: Anchor = None,
    ) -> None:
        self._field = _sum(
            noise, octaves, lacunarity, gain, max_octaves, shape, normalization, rotation, None, footprint,
            frequency, period, anchor,
        )  # fmt: skip
        self._text = text_of(self)


class RidgedMultifractal(Noise):
    """A sum of ridged octaves in which an octave is strong only where the previous octave is.

    Values are in [0, 1] for kinds of range 1. ``feedback`` is the factor from an octave to the
    weight of the next. The other parameters are as in :class:`Fbm`.
    """

    __slots__ = ()

    def __init__(
        self,
        noise: Noise,
        *,
        feedback: float = 2.0,
        octaves: float | None = None,
        lacunarity: float | None = None,
        gain: float = 0.5,
        max_octaves: int | None = None,
        rotation: Literal["random", "aligned"] = "random",
        frequency: float = 1.0,
        period: Period = None,
        anchor: Anchor = None,
    ) -> None:
        self._field = _sum(
            noise, octaves, lacunarity, gain, max_octaves, "signed", None, rotation, feedback, 0.0,
            frequency, period, anchor,
        )  # fmt: skip
        self._text = text_of(self)


def _sum(
    noise: Noise,
    octaves: float | None,
    lacunarity: float | None,
    gain: float,
    max_octaves: int | None,
    shape: str,
    normalization: str | None,
    rotation: str,
    feedback: float | None,
    footprint: float,
    frequency: float,
    period: Period,
    anchor: Anchor,
) -> Field:
    if period is not None and anchor is not None:
        raise ValueError("`period` and `anchor` exclude each other: move the anchor by whole periods")
    if octaves is not None and math.isnan(octaves):
        raise ValueError("`octaves` must be a number, got nan")
    if max_octaves is None:
        max_octaves = 10 if octaves is None else min(16, max(10, math.ceil(min(octaves, 16.0))))
    if not 0 <= max_octaves < 2**32:
        raise ValueError(f"`max_octaves` must be between 1 and 16, got {max_octaves}")
    if lacunarity is None:
        lacunarity = 2.17 if period is None else 2.0
    field = _field("noise", noise).fbm(
        octaves=octaves,
        lacunarity=lacunarity,
        gain=gain,
        max_octaves=max_octaves,
        shape=shape,
        normalization=normalization,
        rotation=rotation,
        feedback=feedback,
        footprint=footprint * abs(frequency),
        period=_periods(period),
        anchor=_anchor(anchor, frequency),
    )
    return _with_frequency(field, frequency)


def curl(points: npt.ArrayLike, *potential: Noise, threads: int | None = None) -> Float32Array:
    """Velocities without divergence at points of shape ``(..., 2)`` or ``(..., 3)``.

    In 2-D one noise is the stream function. In 3-D two noises give the flow along the intersections
    of their level surfaces, and three are a vector potential.
    """
    flat, shape = rows("points", points)
    samples = [noise(flat, with_gradient=True, threads=threads).gradient for noise in potential]
    if (flat.shape[1], len(samples)) == (2, 1):
        (psi,) = samples
        velocity = np.stack([psi[:, 1], -psi[:, 0]], axis=-1)
    elif (flat.shape[1], len(samples)) == (3, 2):
        velocity = np.cross(samples[0], samples[1])
    elif (flat.shape[1], len(samples)) == (3, 3):
        a, b, c = samples
        velocity = np.stack([c[:, 1] - b[:, 2], a[:, 2] - c[:, 0], b[:, 0] - a[:, 1]], axis=-1)
    else:
        raise ValueError(
            "`potential` must be one noise in 2-D, or two or three in 3-D, "
            f"got {len(samples)} in {flat.shape[1]}-D"
        )
    return velocity.reshape((*shape, flat.shape[1])).astype(np.float32, copy=False)
