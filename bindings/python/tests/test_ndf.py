"""Distributions: normalization, bijections, shapes, images, errors."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from asperity import ndf

ALL = [
    ndf.ggx(0.3, 0.5),
    ndf.beckmann(0.4),
    ndf.ward(0.3, 0.2),
    ndf.student_t(0.3, 0.2, 3),
    ndf.blinn_phong(15),
    ndf.ashikhmin_shirley(10, 40),
    ndf.painted(),
    ndf.isotropic([0, 0.1, 1, 4]),
    ndf.ggx(0.3, 0.5).rotated(0.7),
    ndf.ggx(0.3, 0.5).conditional((0.5, -0.2), 0.6),
]


def disk(n=800):
    """Normals at the pixel centers of the disk, and the area of a pixel."""
    c = (np.arange(n) + 0.5) * 2 / n - 1
    x, y = np.meshgrid(c, c)
    z = np.sqrt(np.clip(1 - x * x - y * y, 0, None))
    return np.stack([x, y, z], -1)[z > 0], (2 / n) ** 2


@pytest.mark.parametrize("distribution", ALL, ids=repr)
def test_d_integrates_to_1(distribution):
    m, area = disk()
    assert distribution.d(m).sum() * area == pytest.approx(1, abs=0.01)


@given(z=arrays.arrays(np.float32, (6, 2), elements=st.floats(-3, 3, width=32)))
@settings(max_examples=40, deadline=None)
def test_invert_is_the_inverse(z):
    for distribution in ALL[:6]:
        normals = distribution.warp_gaussian(z)
        np.testing.assert_allclose(np.linalg.norm(normals, axis=-1), 1, atol=1e-6)
        np.testing.assert_allclose(distribution.invert(normals), z, atol=2e-3)


@given(m=arrays.arrays(np.float32, (5, 3), elements=st.floats(width=32)))
@settings(max_examples=40, deadline=None)
def test_every_input_has_a_result(m):
    for distribution in ALL:
        density = distribution.d(m)
        assert np.isfinite(density).all() and (density >= 0).all()
        assert (density[~(m[:, 2] > 0)] == 0).all()
        assert np.isfinite(distribution.invert(m)).all()
        assert np.isfinite(distribution.sample(m[:, :2])).all()


def test_residual_ndf_has_the_mean_d():
    ggx, rng = ndf.ggx(0.2, 0.4), np.random.default_rng(1)
    h = ggx.sample(rng.random((20, 1, 2)))
    z = rng.standard_normal((200_000, 2))
    means = ggx.residual_ndf(h, z, 0.3).mean(axis=1)
    np.testing.assert_allclose(means, ggx.d(h)[:, 0], rtol=0.03)
    expected = ggx.conditional((0.5, -0.2), 0.3).d(h)
    np.testing.assert_array_equal(ggx.residual_ndf(h, (0.5, -0.2), 0.3), expected)


def test_samples_have_the_density():
    rng = np.random.default_rng(2)
    for distribution in ALL:
        normals = distribution.sample(rng.random((100_000, 2)))
        m, area = disk(400)
        expected = (distribution.d(m)[:, None] * m).sum(0) * area
        np.testing.assert_allclose(normals.mean(0), expected, atol=0.01)


@pytest.mark.parametrize("distribution", ALL[:9], ids=repr)
def test_visible_normals(distribution):
    rng = np.random.default_rng(3)
    v = np.array([0.6, 0.0, 0.8])
    normals = distribution.sample_visible(v, rng.random((20_000, 2)))
    # The mean of 1 / visible_pdf over visible normals is the solid angle of those that can be seen.
    assert (distribution.visible_pdf(v, normals) > 0).mean() > 0.99
    m, area = disk(400)
    seen = (distribution.d(m) * np.clip(m @ v, 0, None) / m[:, 2]).sum() * area
    assert float(distribution.projected_area(v)) == pytest.approx(seen, rel=0.03)
    g1, g2 = distribution.g1(v), distribution.g2(v, v)
    assert 0 < g2 <= g1 <= 1
    assert g1 == pytest.approx(1 / (1 + distribution.lambda_(v)), rel=1e-6)


def test_conditional_has_no_masking():
    with pytest.raises(ValueError, match="no masking"):
        ALL[-1].g1([0, 0, 1])


def test_shapes_and_layouts():
    ggx, m = ndf.ggx(0.3), disk(40)[0][:600].reshape(20, 30, 3)
    expected = ggx.d(m)
    assert expected.shape == (20, 30) and ggx.invert(m).shape == (20, 30, 2)
    np.testing.assert_array_equal(ggx.d(np.asfortranarray(m)), expected)
    np.testing.assert_array_equal(ggx.d(m[::-2]), expected[::-2])
    np.testing.assert_array_equal(ggx.d(m.astype(np.float32)), expected)
    assert ggx.d([0, 0, 1]).shape == () and ggx.d(np.zeros((0, 3))).shape == (0,)
    assert ggx.g2(m[:, :1], m[:1]).shape == (20, 30)
    np.testing.assert_array_equal(ggx.d(m, threads=1), expected)


def test_images(tmp_path):
    from PIL import Image

    # Bright at the top right: y up, x to the right.
    texels = np.zeros((32, 32), np.uint8)
    texels[4:10, 20:26] = 255
    Image.fromarray(texels).save(tmp_path / "map.png")
    of_file = ndf.from_image(tmp_path / "map.png")
    of_array = ndf.from_array(texels, reconstruction="constant")
    m = disk(60)[0]
    np.testing.assert_array_equal(of_file.d(m), of_array.d(m))
    mean = of_file.sample(np.random.default_rng(1).random((1000, 2))).mean(0)
    assert mean[0] > 0.3 and mean[1] > 0.3
    assert of_array.image(32)[7, 22] > 0 == of_array.image(32)[22, 7]


def test_estimates(tmp_path):
    from PIL import Image

    beckmann, rng = ndf.beckmann(0.3, 0.2), np.random.default_rng(4)
    normals = beckmann.sample(rng.random((60_000, 2)))
    estimated = ndf.estimate(normals)
    m, area = disk(200)
    assert np.abs(estimated.d(m) - beckmann.d(m)).sum() * area < 0.15
    of_slopes = ndf.estimate(-normals[:, :2] / normals[:, 2:] * -1)
    np.testing.assert_allclose(of_slopes.d(m), estimated.d(m), rtol=0.05, atol=0.05)
    pixels = np.round((normals[:40_000].reshape(200, 200, 3) * 0.5 + 0.5) * 255).astype(np.uint8)
    Image.fromarray(pixels).save(tmp_path / "normals.png")
    of_map = ndf.from_normal_map(tmp_path / "normals.png")
    assert np.abs(of_map.d(m) - beckmann.d(m)).sum() * area < 0.2


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: ndf.ggx(0), "`alpha_x` must be between 1e-6 and 1e6, got 0"),
        (lambda: ndf.student_t(0.3, 0.3, 1), "`gamma` must be between 1.51 and"),
        (lambda: ndf.ggx(0.3).d([0, 1]), r"`m` must have the shape \(..., 3\), got \(2,\)"),
        (lambda: ndf.ggx(0.3).g2(np.zeros((2, 3)), np.zeros((3, 3))), "must have shapes that broadcast"),
        (lambda: ndf.from_array(np.zeros((8, 8))), "`texels` must have weight above the horizon, got none"),
        (lambda: ndf.from_array(np.zeros(8)), r"`texels` must have the shape \(height, width\), got \(8,\)"),
        (lambda: ndf.from_array(np.ones((8, 8)), measure="x"), "`measure` must be normals or solid_angle, got `x`"),
        (lambda: ndf.estimate(np.zeros((3, 4))), r"`normals` must have the shape"),
        (lambda: ndf.estimate(np.full((3, 3), np.nan)), "."),
        (lambda: ndf.isotropic([1]), "."),
    ],
)
def test_errors(call, message):
    with pytest.raises(ValueError, match=message) as error:
        call()
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("read", [ndf.from_image, ndf.from_normal_map])
def test_missing_files(read):
    with pytest.raises(FileNotFoundError):
        read("nowhere.png")
