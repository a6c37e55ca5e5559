"""Noises, distributions, functions and materials are pickled and copied by the call that made them."""

import copy
import pickle

import numpy as np
import pytest

from asperity import fif, ndf, shading
from asperity.noise import Cellular, Fbm, Gaussian, Perlin, RidgedMultifractal, Simplex, ValueGradient, White

POINTS = np.random.default_rng(1).uniform(-3, 3, (200, 2))
KNOTS = np.array([0.0, 0.5, 1.0])

NOISES = [
    Perlin(1),
    Perlin(seed=2, frequency=1.5, period=[4, 8]),
    Cellular(3, output="f2_minus_f1", metric="manhattan", jitter=0.5),
    ValueGradient(1, weight=0.3),
    Simplex(1, classic_radius=True),
    Fbm(Gaussian(1), octaves=3.4, gain=0.6, shape="ridged", footprint=0.01),
    RidgedMultifractal(Perlin(1), feedback=1.5),
    Fbm(White(1, anchor=(1e6, 2))),
    (1 - 2 * Perlin(1) * Perlin(2) ** 2 / 3 + Simplex(1)).clamp(-1, 1).unit(),
    Perlin(1).warp([Perlin(2), Simplex(3)], 0.4).at_frequency(2).blend(0.5, weight=Perlin(3)),
]


def again(made):
    return [pickle.loads(pickle.dumps(made)), copy.deepcopy(made), copy.copy(made)]


@pytest.mark.parametrize("noise", NOISES, ids=repr)
def test_noises_keep_their_bits(noise):
    expected = noise(POINTS)
    assert np.ptp(expected) > 0
    for made in again(noise):
        assert np.array_equal(made(POINTS), expected) and repr(made) == repr(noise)


def test_others_keep_their_values():
    takagi = fif.affine(KNOTS, [0, 0.5, 0], scaling=0.5)
    surface = fif.product_surface(takagi.integral(), takagi)
    table = ndf.from_array(np.random.default_rng(2).uniform(size=(16, 16)))
    for distribution in (ndf.ggx(0.2, 0.4), ndf.isotropic([0.1, 1, 5]), table.rotated(0.3)):
        normals = distribution.sample(POINTS % 1)
        for made in again(distribution):
            assert np.array_equal(made.d(normals), distribution.d(normals))
    for made in again(surface):
        assert np.array_equal(made(POINTS), surface(POINTS))
    gold = shading.metal(table, f0=(1.0, 0.78, 0.34))
    wo, wi = np.array([0.6, 0, 0.8]), np.array([0, 0.6, 0.8])
    for made in again(gold):
        assert np.array_equal(made.eval(wo, wi), gold.eval(wo, wi))
    KNOTS[1] = 0.25
    for made in again(takagi):
        assert made.knots.tolist() == [0, 0.5, 1]


def test_estimates_are_not_pickled():
    with pytest.raises(TypeError, match="cannot pickle estimate"):
        pickle.dumps(ndf.estimate(np.zeros((5, 2))))


def test_texts_have_the_parameters():
    assert repr(Fbm(Perlin(1), octaves=3, gain=0.3)) == "Fbm(Perlin(1), octaves=3, gain=0.3)"
