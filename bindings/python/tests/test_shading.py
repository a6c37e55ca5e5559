"""BSDFs: energy, densities, shapes, parameters, errors."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from asperity import ndf, shading

ALL = [
    shading.lambert((0.8, 0.5, 0.2)),
    shading.oren_nayar(0.7, 0.6),
    shading.phong(0.8, 20),
    shading.charlie_sheen(0.9, 0.4),
    shading.zeltner_fuzz(0.9, 0.4),
    shading.metal(ndf.ggx(0.4, 0.2), (1, 0.8, 0.3)),
    shading.metal(ndf.painted(), 0.9),
    shading.conductor(ndf.beckmann(0.3), (0.2, 0.9, 1.3), (3.9, 2.4, 1.9)),
    shading.dielectric(ndf.ggx(0.3), 1.5),
    shading.dielectric(ndf.ggx(0.3), 1.5, thin=(0.9, 1, 1)),
    shading.ggx_metal(0.6, f0=1),
    shading.ggx_glass(0.3, ior=1.5),
    shading.standard_material(base_color=(0.6, 0.1, 0.1), metallic=0.2, roughness=0.4, clearcoat=1, clearcoat_roughness=0.5),
    shading.open_pbr(base_color=(0.4, 0.4, 0.4), coat_weight=1, coat_roughness=0.5),
]


def sphere(n, rng):
    z, turn = rng.uniform(-1, 1, n), rng.uniform(0, 2 * np.pi, n)
    r = np.sqrt(1 - z * z)
    return np.stack([r * np.cos(turn), r * np.sin(turn), z], -1)


@pytest.mark.parametrize("bsdf", ALL, ids=repr)
def test_weights_are_the_albedo(bsdf):
    rng = np.random.default_rng(1)
    wo = np.array([0.6, 0.0, 0.8])
    wi = sphere(400_000, rng)
    lit = bsdf.eval(wo, wi) * np.abs(wi[:, 2:]) * 4 * np.pi
    samples = bsdf.sample(wo, rng.random(200_000), rng.random((200_000, 2)))
    glossy = np.where(samples.specular[:, None], 0, samples.weight)
    np.testing.assert_allclose(glossy.mean(0), lit.mean(0), atol=0.02)
    assert (samples.weight.mean(0) < 1.02).all()
    # The density integrates to the fraction of samples.
    drawn = (samples.pdf > 0) & ~samples.specular
    assert bsdf.pdf(wo, wi).mean() * 4 * np.pi == pytest.approx(drawn.mean(), abs=0.03)
    np.testing.assert_allclose(bsdf.pdf(wo, samples.wi[drawn]), samples.pdf[drawn], rtol=2e-3, atol=1e-4)
    if not bsdf.transmits:
        assert not samples.transmitted.any() and (samples.wi[drawn, 2] > 0).all()


@given(
    wo=arrays.arrays(np.float32, (4, 3), elements=st.floats(width=32)),
    wi=arrays.arrays(np.float32, (4, 3), elements=st.floats(width=32)),
)
@settings(max_examples=40, deadline=None)
def test_every_input_has_a_result(wo, wi):
    for bsdf in ALL:
        light, pdf = bsdf.eval(wo, wi), bsdf.pdf(wo, wi)
        assert (light >= 0).all() and (pdf >= 0).all()
        assert not np.isnan(bsdf.sample(wo, wi[:, 0], wi[:, 1:]).weight).any()


def test_shapes():
    wo, wi = np.zeros((5, 1, 3)), np.zeros((7, 3))
    wo[..., 2] = wi[..., 2] = 1
    bsdf = ALL[5]
    assert bsdf.eval(wo, wi).shape == (5, 7, 3) and bsdf.pdf(wo, wi).shape == (5, 7)
    samples = bsdf.sample(wo, 0.5, np.zeros((7, 2)))
    assert samples.wi.shape == samples.weight.shape == (5, 7, 3) and samples.specular.shape == (5, 7)
    assert bsdf.eval([0, 0, 1], [0, 0, 1]).shape == (3,)
    np.testing.assert_array_equal(bsdf.eval(wi, wi, threads=1), bsdf.eval(np.asfortranarray(wi), wi))


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: shading.lambert(2), "`albedo`"),
        (lambda: shading.lambert((1, 2)), r"`albedo` must be a number or three, got the shape \(2,\)"),
        (lambda: shading.metal(ndf.ggx(0.3), np.nan), r"`f0` must be within \[0, 1\], got NaN"),
        (lambda: shading.metal(ndf.ggx(0.3).conditional((0, 0), 0.5), 1), "no masking"),
        (lambda: shading.dielectric(ndf.ggx(0.3), 0), "."),
        (lambda: shading.standard_material(roughness=2), "`roughness`"),
        (lambda: shading.standard_material(ruffness=1), "unknown field `ruffness`"),
        (lambda: shading.open_pbr(base_color="red"), "."),
        (lambda: shading.standard_material(roughness=np.nan), "parameters must be finite"),
        (lambda: ALL[0].eval([0, 0], [0, 0, 1]), r"`wo` must have the shape \(..., 3\)"),
    ],
)
def test_errors(call, message):
    with pytest.raises(ValueError, match=message) as error:
        call()
    assert "\n" not in str(error.value)
