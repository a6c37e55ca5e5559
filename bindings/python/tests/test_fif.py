"""Fractal functions: known values, bounds, calculus, fits, surfaces, errors."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from asperity import fif

TAKAGI = fif.affine([0, 0.5, 1], [0, 0.5, 0], 0.5)


def takagi(x, terms=50):
    distance = lambda t: np.abs(t - np.round(t))  # noqa: E731
    return sum(distance(2.0**k * x) / 2.0**k for k in range(terms))


def test_takagi():
    x = np.linspace(0, 1, 1001)
    np.testing.assert_allclose(TAKAGI(x), takagi(x), atol=1e-14)
    assert TAKAGI.integrate(0, 1).value == pytest.approx(0.5, abs=1e-15)
    low, high = TAKAGI.extrema(width=1e-12).maximum
    assert low <= 2 / 3 <= high and high - low < 1e-11
    low, high = TAKAGI.dimension
    assert low <= 1 <= high
    assert fif.affine([0, 0.5, 1], [0, 0.5, 0], 2**-0.5).dimension[0] == pytest.approx(1.5, abs=1e-12)


@given(
    y=st.lists(st.floats(-10, 10), min_size=3, max_size=6),
    scaling=st.floats(-0.9, 0.9),
    x=st.lists(st.floats(-0.5, 1.5), min_size=1, max_size=8),
)
@settings(max_examples=60, deadline=None)
def test_functional_equation(y, scaling, x):
    knots = np.linspace(0, 1, len(y))
    f = fif.affine(knots, y, scaling)
    np.testing.assert_allclose(f(knots), y, atol=1e-12)
    value, bound = f.bounded(x, tolerance=1e-9)
    assert np.all(np.abs(value - f(x)) <= bound + 1e-12)
    low, high = f.range
    assert np.all((low <= f(x)) & (f(x) <= high))
    # f(L(x)) = scaling f(x) + q(x), with L the map to the first piece.
    inside = np.clip(x, 0, 1)
    c = f.polynomials[0]
    difference = f(inside * knots[1]) - (scaling * f(inside) + c[0] + c[1] * inside)
    # The image of x is rounded, which changes a rough function by its modulus.
    assert np.all(np.abs(difference) <= 1e-10 + f.modulus(2.0**-52))


def test_calculus():
    f = fif.affine([0, 1, 2.5], [1, 3, 0], [0.4, -0.6])
    integral = f.integral(2.0)
    x = np.linspace(0, 2.5, 51)
    np.testing.assert_allclose(integral(x) - 2, f.integrate(0, x).value, atol=1e-13)
    np.testing.assert_allclose(integral.derivative()(x), f(x), atol=1e-10)
    fine = np.linspace(0, 2.5, 200_001)
    assert f.mean(0, 2.5).value == pytest.approx(f(fine).mean(), abs=1e-4)
    value, bound, condition = f.moment(1, 2)
    assert value == pytest.approx((fine * f(fine) ** 2).mean() * 2.5, rel=1e-3)
    assert bound < 1e-10 and condition >= 1
    assert f.integrate(2, 1).value == -f.integrate(1, 2).value
    smooth = fif.hermite([0, 1, 2], [0, 1, 0], [1, 0, -1], 0.2)
    np.testing.assert_allclose(smooth.derivative()([0, 1, 2]), [1, 0, -1], atol=1e-12)


def test_special_values():
    assert np.isnan(TAKAGI(np.nan))
    assert TAKAGI(-3) == TAKAGI(0) == 0 and TAKAGI(np.inf) == 0
    assert TAKAGI(np.zeros((2, 0, 3))).shape == (2, 0, 3)
    assert TAKAGI(np.float32([[0.5], [0.25]])).dtype == np.float64
    x = np.asfortranarray(np.random.default_rng(1).random((40, 50)))
    np.testing.assert_array_equal(TAKAGI(x), TAKAGI(x.copy(order="C")))
    np.testing.assert_array_equal(TAKAGI(x[::3, ::-1]), TAKAGI(x)[::3, ::-1])


def test_polynomials_round_trip():
    f = fif.affine([0, 1, 2.5], [1, 3, 0], [0.4, -0.6])
    g = fif.polynomial(f.knots, f.scaling, f.polynomials)
    x = np.linspace(0, 2.5, 101)
    np.testing.assert_allclose(g(x), f(x), atol=1e-13)


def test_fit_recovers_a_function():
    x = np.linspace(0, 1, 129)
    fitted = fif.fit(x, TAKAGI(x), [0, 64, 128])
    assert fitted.error < 1e-12
    np.testing.assert_allclose(fitted.function.scaling, 0.5, atol=1e-12)
    assert list(fif.fit_knots(x, TAKAGI(x), 1e-12, longest=128)) == [0, 64, 128]
    rough = np.sin(17 * x) + 0.3 * np.cos(91 * x * x)
    knots = [0, 32, 64, 96, 128]
    assert fif.fit(x, rough, knots, steps=10).rms < fif.fit(x, rough, knots).rms


def surfaces():
    smooth = TAKAGI.integral()
    z = np.random.default_rng(1).normal(size=(8, 8))
    knots = np.linspace(0, 2, 4)
    return [
        fif.product_surface(smooth, smooth),
        fif.periodic_surface(z, scaling=0.2),
        fif.folded_surface(knots, knots, z[:4, :4], scaling=0.1),
        fif.folded_surface(knots, knots, z[:4, :4], scaling=np.full((4, 4), 0.5)),
    ]


@pytest.mark.parametrize("surface", surfaces(), ids=["product", "periodic", "folded", "rough"])
def test_rays_meet_the_surface(surface):
    (left, right), (front, back) = surface.domain
    rng = np.random.default_rng(2)
    target = rng.uniform([left, front], [right, back], (40, 2)) * 0.8 + 0.1 * np.array([right, back])
    height = surface.bounded(target)
    top = surface.range[1] + 1
    origin = np.concatenate([target, np.full((40, 1), top)], axis=1)
    hits = surface.intersect(origin, [0, 0, -1])
    assert hits.certain.dtype == bool and hits.point.shape == (40, 3)
    np.testing.assert_allclose(hits.t, top - height.value, atol=1e-9)
    assert np.isnan(surface.intersect(origin, [0, 0, 1]).t).all()
    gradient = surface.gradient(target)
    if np.isfinite(gradient).all():
        normal = np.concatenate([-gradient, np.ones((40, 1))], axis=1)
        normal /= np.linalg.norm(normal, axis=1, keepdims=True)
        np.testing.assert_allclose(hits.normal, normal, atol=1e-6)
    low, high = surface.range
    assert np.all((low <= height.value) & (height.value <= high)) and np.all(height.bound < 1e-9)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: fif.affine([0, 1, 1], [0, 1, 0], 0.5), "x"),
        (lambda: fif.affine([0, 1, 2], [0, 1, 0], 1.0), "alpha"),
        (lambda: fif.affine([0, 1, 2], [0, 1], 0.5), "`y` must have 3 elements, got 2"),
        (lambda: fif.affine([0], [0]), "."),
        (lambda: fif.polynomial([0, 1, 2], 0.5, [1, 2]), r"`polynomials` must have the shape \(maps, coefficients\)"),
        (lambda: fif.polynomial([0, 1, 2], 0.5, np.zeros((2, 9))), "`polynomials` must have 1 to 7 coefficients, got 9"),
        (lambda: TAKAGI.derivative(), "."),
        (lambda: TAKAGI.extrema(3, 4), "does not meet the domain"),
        (lambda: TAKAGI("x"), "`x` must be an array of real numbers"),
        (lambda: TAKAGI.moment(-1), "`k` and `p` must be at least 0"),
        (lambda: fif.product_surface(TAKAGI, TAKAGI)([1, 2, 3]), r"`points` must have the shape \(..., 2\)"),
        (lambda: fif.periodic_surface(np.zeros((3, 3)), scaling=0.1), "."),
        (lambda: fif.periodic_surface(np.zeros((4, 4)), scaling=0.9), "scaling"),
    ],
)
def test_errors(call, message):
    with pytest.raises(ValueError, match=message) as error:
        call()
    assert "\n" not in str(error.value)
