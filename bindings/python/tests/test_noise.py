"""Noise: shapes, dtypes, grids, operators, threads, errors."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from asperity import noise
from asperity.noise import Cellular, Fbm, Gaussian, Perlin, RidgedMultifractal, Simplex, Value

LAND = Fbm(Perlin(3), octaves=3.5)


def same(a, b):
    np.testing.assert_array_equal(np.asarray(a).view(np.uint32), np.asarray(b).view(np.uint32))


def scattered(*shape):
    return np.random.default_rng(1).uniform(-50, 50, shape).astype(np.float32)


@pytest.mark.parametrize("dimension", [1, 2, 3, 4])
def test_shapes(dimension):
    for shape in [(), (7,), (3, 5), (2, 0, 4)]:
        sample = Perlin(1)(np.zeros((*shape, dimension)), with_hessian=True)
        assert sample.value.shape == shape and sample.value.dtype == np.float32
        assert sample.gradient.shape == (*shape, dimension)
        assert sample.hessian.shape == (*shape, dimension, dimension)


@pytest.mark.parametrize("dtype", [np.float16, np.float32, np.float64, np.int8, np.int64, np.uint32, np.bool_, ">f4"])
def test_dtypes(dtype):
    points = np.array([[0, 1], [1, 0], [1, 1]]).astype(dtype)
    same(Gaussian(2)(points), Gaussian(2)(points.astype(np.float32)))


def test_contiguity():
    points = scattered(40, 30, 3)
    expected = LAND(points)
    same(LAND(points[::-1, ::2]), expected[::-1, ::2])
    same(LAND(points.transpose(1, 0, 2)), expected.T)
    same(LAND(np.asfortranarray(points)), expected)
    same(LAND(points.tolist()), expected)
    same(LAND(np.broadcast_to(points[0, 0], (4, 5, 3))), np.broadcast_to(expected[0, 0], (4, 5)))
    unaligned = np.frombuffer(b"x" + points.tobytes(), np.uint8)[1:].view(np.float32).reshape(points.shape)
    same(LAND(unaligned), expected)
    points.setflags(write=False)
    same(LAND(points), expected)


def test_coordinates_broadcast():
    x, y = scattered(4, 1), scattered(5)
    same(LAND.at(x, y), LAND(np.stack(np.broadcast_arrays(x, y), -1)))
    assert LAND.at(0.5, 1.5).shape == ()


@pytest.mark.parametrize("field", [LAND, Cellular(1), Perlin(2, frequency=1.5), Perlin(1).warp(Value(4), 0.4)], ids=repr)
@pytest.mark.parametrize("shape", [(9,), (37, 53), (200, 130), (5, 7, 11), (30, 20, 25), (3, 2, 4, 5), (0, 4)])
def test_grid_is_a_list_of_points(field, shape):
    n = len(shape)
    step, origin = [0.25, -0.5, 0.125, 0.75][:n], [3.0, -1.5, 0.25, 7.0][:n]
    axes = [np.float32(origin[k]) + np.float32(step[k]) * np.arange(shape[n - 1 - k], dtype=np.float32) for k in range(n)]
    points = np.stack(np.meshgrid(*reversed(axes), indexing="ij")[::-1], -1)
    for threads in (1, 3):
        sample = field.grid(shape, step, origin=origin, with_gradient=True, threads=threads)
        expected = field(points, with_gradient=True, threads=1)
        same(sample.value, expected.value)
        same(sample.gradient, expected.gradient)
        same(field.grid(shape, step, origin=origin, threads=threads), expected.value)
    if field is LAND:
        same(field.grid(shape, step, origin=origin, with_hessian=True).hessian, field(points, with_hessian=True).hessian)


def test_threads_change_no_bit():
    points = scattered(50_000, 2)
    expected = LAND(points, threads=1, with_gradient=True)
    for threads in (2, 5, None):
        sample = LAND(points, threads=threads, with_gradient=True)
        same(sample.value, expected.value)
        same(sample.gradient, expected.gradient)


def test_operators():
    a, b, p = Perlin(1), Simplex(2), scattered(100, 3)
    x, y = a(p), b(p)
    same((a + b)(p), x + y)
    same((a - b)(p), x - y)
    same((2 * a + 1)(p), np.float32(2) * x + np.float32(1))
    same((np.float64(0.5) * a)(p), np.float32(0.5) * x)
    same((1 - a)(p), -x + np.float32(1))
    same((-a)(p), -x)
    same((a / 4)(p), x / 4)
    same((a * b)(p), x * y)
    same((a**2)(p), x * x)
    same(a.clamp(-0.1, 0.2)(p), np.clip(x, np.float32(-0.1), np.float32(0.2)))
    assert np.all((0 <= a.unit()(p)) & (a.unit()(p) <= 1))
    assert a.range(3) == (-1.0, 1.0)
    half = 0.5 * Value(3) ** 0
    same(a.blend(b, half)(p), x + np.float32(0.5) * (y - x))


def test_octaves_of_a_noise_at_another_frequency_have_their_seeds():
    p = scattered(100, 2)
    same(Fbm(Perlin(1, frequency=2))(p), Fbm(Perlin(1), frequency=2)(p))


def test_single_warp_displaces_axes_independently():
    p = scattered(500, 2)
    constant = Perlin(1).warp(Value(5), 0.0)
    same(constant(p), Perlin(1)(p))
    moved = Perlin(1).warp(Value(5), 0.5)
    assert np.abs(moved(p) - Perlin(1).warp([Value(5), Value(5)], 0.5)(p)).max() > 0.05


@given(
    points=arrays.arrays(np.float32, (5, 2), elements=st.floats(-100, 100, width=32)),
    seed=st.integers(0, 2**32 - 1),
    octaves=st.floats(0, 12),
)
@settings(max_examples=60, deadline=None)
def test_gradients_match_differences(points, seed, octaves):
    field = Fbm(Gaussian(seed), octaves=min(octaves, 3), normalization="unit_range")
    h = np.float32(1 / 512)
    gradient = field(points, with_gradient=True).gradient
    for axis in range(2):
        step = np.zeros(2, np.float32)
        step[axis] = h
        difference = (field(points + step) - field(points - step)) / (2 * h)
        # Third derivatives reach some hundreds at the third octave, and values round to 4e-7.
        np.testing.assert_allclose(gradient[:, axis], difference, atol=0.02 + 0.01 * np.abs(gradient).max())


@given(
    points=arrays.arrays(np.float32, (4, 3), elements=st.floats(width=32, allow_nan=True, allow_infinity=True)),
    seed=st.integers(0, 2**32 - 1),
)
@settings(max_examples=60, deadline=None)
def test_every_point_has_a_value(points, seed):
    for field in (Perlin(seed), Simplex(seed), Cellular(seed), Fbm(Value(seed), octaves=2)):
        sample = field(points, with_gradient=True)
        assert np.isfinite(sample.value).all() and np.isfinite(sample.gradient).all()
    bad = ~np.isfinite(points).all(axis=1)
    assert (Perlin(seed)(points)[bad] == 0).all()


def test_tiles_repeat():
    p = np.round(scattered(200, 2) * 16) / 16
    for field in (Perlin(1, period=(8, 5)), Fbm(Perlin(1), period=(8, 5)), RidgedMultifractal(Value(1), period=(8, 5))):
        same(field(p), field(p + np.float32([8, -5])))
    frequency = Perlin(1, frequency=4, period=8)
    same(frequency(p), frequency(p + 2))


def test_anchor_moves_the_origin():
    near, far = Perlin(4), Perlin(4, anchor=(1000.0, -2000.0))
    p = np.round(scattered(50, 2) * 16) / 16
    same(far(p), near(p + np.float32([1000, -2000])))
    assert np.ptp(Fbm(Simplex(4), anchor=1e12)(p)) > 0.5


def test_curl_has_no_divergence():
    p, h = scattered(50, 2), np.float32(1 / 256)
    v = [noise.curl(p + np.float32(d) * h, Gaussian(1)) for d in ([1, 0], [-1, 0], [0, 1], [0, -1])]
    divergence = ((v[0] - v[1])[:, 0] + (v[2] - v[3])[:, 1]) / (2 * h)
    assert np.abs(divergence).max() < 0.02
    assert noise.curl(scattered(2, 3, 3), Perlin(1), Perlin(2)).shape == (2, 3, 3)
    assert noise.curl(scattered(4, 3), Perlin(1), Perlin(2), Perlin(3)).shape == (4, 3)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: Perlin(-1), "`seed` must be between 0 and 4294967295, got -1"),
        (lambda: Perlin(1)(3.0), "`points` must have a last axis of coordinates, got a number"),
        (lambda: Perlin(1)(np.zeros((2, 5))), "points must have 1 to 4 coordinates, got 5"),
        (lambda: Perlin(1)(np.zeros((2, 2), complex)), "`points` must be an array of real numbers, got dtype complex128"),
        (lambda: Perlin(1)(["a", "b"]), "`points` must be an array of real numbers, got dtype <U1"),
        (lambda: Perlin(1)(np.zeros((2, 2)), threads=0), "`threads` must be at least 1, got 0"),
        (lambda: Perlin(1).grid((4, 4), step=(1, 2, 3)), "`step` must have 2 numbers, got 3"),
        (lambda: Perlin(1).grid((4, -1), 1), "`shape` must have numbers from 0 to 2147483647, got (4, -1)"),
        (lambda: Cellular(1, jitter=2), "`jitter` must be between 0 and 1, got 2"),
        (lambda: Cellular(1)(np.zeros((1, 2)), with_hessian=True), "the field does not have Hessians"),
        (lambda: Fbm(Perlin(1), lacunarity=0.5), "`lacunarity` must be finite and above 1, got 0.5"),
        (lambda: Fbm(Perlin(1), max_octaves=17), "`max_octaves` must be between 1 and 16, got 17"),
        (lambda: Fbm(Perlin(1, period=4)), "the field of a sum must not be tiled: pass `period` to the sum"),
        (lambda: Simplex(1, period=3)(np.zeros((1, 2))), "simplex noise in 2-D has no period (1-D and 3-D have)"),
        (lambda: Perlin(1, period=0), "`period` of axis 0 must be between 1 and 2097152, got 0"),
        (lambda: Perlin(1).grid((2, 2), np.nan), "`step` must be finite, got nan"),
        (lambda: Perlin(1).grid((2, 2), None), "`step` must be an array of real numbers, got dtype object"),
        (lambda: Perlin(1).warp([Value(1)] * 3, 1)(np.zeros((1, 2))), "`by` must be one field or 2 in 2-D, got 3"),
        (lambda: Perlin(1).warp(Value(1), np.inf), "`strength` must be finite, got inf"),
        (lambda: Perlin(1.5), "`seed` must be an integer, got 1.5"),
        (lambda: Perlin([1, 2]), "`seed` must be an integer, got [1, 2]"),
        (lambda: Perlin(1).grid(4.5, 1), "`shape` must be an integer or a list of integers, got 4.5"),
        (lambda: Perlin(1)(np.zeros((2, 2)), threads=-1), "`threads` must be at least 1, got -1"),
        (lambda: nested(129), "a noise must have at most 128 nested terms, got 129"),
        (lambda: doubled(12), "a noise must have at most 4096 terms, got 8191"),
    ],
)
def test_errors(call, message):
    with pytest.raises(ValueError) as error:
        call()
    assert str(error.value) == message


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: Fbm(1), "`noise` must be a noise, got 1"),
        (lambda: Perlin(1).warp(None, 1), "`by` must be a noise, got None"),
        (lambda: Perlin(1).blend("x", 0.5), "`other` must be a noise, got 'x'"),
    ],
)
def test_wrong_types(call, message):
    with pytest.raises(TypeError) as error:
        call()
    assert str(error.value) == message


def test_constants_are_noises_of_a_blend():
    p = np.random.default_rng(3).uniform(-3, 3, (50, 2))
    half = Perlin(1).blend(1.0, 0.5)(p)
    assert np.allclose(half, 0.5 + 0.5 * Perlin(1)(p), atol=1e-6)


def test_too_many_points():
    with pytest.raises(MemoryError):
        Perlin(1).grid((2**30, 2**20), 1)


def nested(depth):
    field = Perlin(0)
    for _ in range(depth - 1):
        field = field * Perlin(1)
    return field


def doubled(times):
    field = Perlin(0)
    for _ in range(times):
        field = field + field
    return field


@pytest.mark.parametrize("count", [10, 20_000])
def test_the_deepest_noise_is_evaluated(count):
    points = np.full((count, 4), 0.3, np.float32)
    blended, warped = Perlin(1), Perlin(1)
    for _ in range(127):
        blended = blended.blend(Perlin(2), Perlin(3))
        warped = Perlin(2).warp([warped] + 3 * [Perlin(3)], 0.1)
    for field in (nested(128), blended, warped):
        assert np.isfinite(field(points, with_gradient=True, threads=2).gradient).all()


def test_anchor_and_footprint_are_in_units_of_the_points():
    points = scattered(1000, 2)
    for near, all_ in [
        (Perlin(1, frequency=2, anchor=16), Perlin(1, frequency=2)),
        (Fbm(Perlin(1, frequency=2), octaves=3, anchor=16), Fbm(Perlin(1, frequency=2), octaves=3)),
        (Fbm(Perlin(1), octaves=3, frequency=2, anchor=16), Fbm(Perlin(1), octaves=3, frequency=2)),
    ]:
        assert np.allclose(near(points), all_(points + 16), atol=1e-3)
    wide = Fbm(Perlin(1), footprint=0.25)(8 * points)
    for finer in (Fbm(Perlin(1, frequency=8), footprint=0.25 / 8), Fbm(Perlin(1), frequency=8, footprint=0.25 / 8)):
        assert np.array_equal(finer(points), wide)


def test_numpy_integers_are_integers():
    four = np.int64(4)
    assert np.array_equal(Perlin(np.uint8(1), period=four).grid(four, 0.3), Perlin(1, period=4).grid((4,), 0.3))
    assert np.array_equal(Perlin(1, anchor=np.float32(8)).grid(4, 0.3), Perlin(1, anchor=8).grid(4, 0.3))


def test_float32_is_not_copied():
    import tracemalloc

    points = scattered(1_000_000, 2)
    tracemalloc.start()
    Perlin(1)(points[:1000])
    values = Perlin(1)(points)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    # NumPy reports its arrays. A copy of the points would take 8 MB.
    assert values.nbytes == 4_000_000 and peak < 6_000_000
