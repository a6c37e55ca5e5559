//! Pinned values of every public function of the crate: a change is value-breaking.
//!
//! Values are pinned to a few units in the last place, not to the bit, because the float functions
//! of `std` and of `libm` round differently on different platforms.

use asperity_ndf_sampling::{
    Beckmann, Frame, GaussianSplit, Ggx, Measure, Ndf, NdfMap, NoiseCdfRef, NoiseDistribution, NormalLut,
    PackedMapRef, Reconstruction, gaussian_cdf, inverse_gaussian_cdf, residual_ndf,
};
use asperity_tests::pinned::{SINGLE, pinned, single};
use glam::{Vec2, Vec3};

/// A few units in the last place of `f64`.
const DOUBLE: f64 = 1e-14;

pub(crate) const Z: Vec2 = Vec2::new(0.7, -1.2);

pub(crate) fn direction() -> Vec3 {
    Vec3::new(2.0, -3.0, 6.0) / 7.0
}

#[test]
fn closed_forms() {
    let ggx = Ggx::new(0.2, 0.4).unwrap();
    let beckmann = Beckmann::new(0.2, 0.4).unwrap();
    let h = direction();
    single("Ggx::d", ggx.d(h), [0.258_475_57]);
    single("Ggx::warp_gaussian", ggx.warp_gaussian(Z), [0.116_753_96, -0.400_299_28, 0.908_916_35]);
    single("Ggx::invert", ggx.invert(h), [1.464_361_8, -1.098_271_4]);
    single("Beckmann::d", beckmann.d(h), [0.096_070_141]);
    single("Beckmann::warp_gaussian", beckmann.warp_gaussian(Z), [0.093_333_341, -0.320_000_02, 0.942_809_1]);
    single("Beckmann::invert", beckmann.invert(h), [2.357_022_8, -1.767_767]);
    let clamped = Ggx::new_clamped(f32::NAN, -1.0);
    single("clamped", [f64::from(clamped.alpha_x()), f64::from(clamped.alpha_y())], [1.0, 1e-6]);
}

#[test]
fn level_of_detail() {
    let ggx = Ggx::new(0.2, 0.4).unwrap();
    let seen = [0.25, 0.75, 0.99].map(|s| f64::from(residual_ndf(&ggx, direction(), Z, s)));
    // The exponent of the last value is −29, which magnifies the rounding of its terms.
    pinned("residual_ndf", seen, [0.681_554_79, 1.257_120_7, 1.372_429_5e-11], 30.0 * SINGLE);
    let split = GaussianSplit::new(Z, 0.5);
    single("GaussianSplit", [split.resolved_variance(), split.weigh(1.0, -Z)], [0.5, 0.018_943_675]);
    assert_eq!(GaussianSplit::MAX_RESOLVED_VARIANCE, 0.999_999_05);
}

#[test]
fn maps() {
    let map = NdfMap::from_fn(24, 16, Measure::ProjectedSolidAngle, Reconstruction::Constant, |n| {
        0.1 + n.x * n.x + 0.5 * n.y
    })
    .unwrap_err();
    assert!(map.to_string().starts_with("`texels[6]` must be"), "{map}");
    let map = NdfMap::from_fn(24, 16, Measure::SolidAngle, Reconstruction::Constant, |n| {
        0.7 + n.x * n.x + 0.5 * n.y
    })
    .unwrap();
    assert_eq!((map.view().width(), map.view().height()), (24, 16));
    single("NdfMap::d", map.d(direction()), [0.103_214_55]);
    single("NdfMap::warp_gaussian", map.warp_gaussian(Z), [0.632_519_13, -0.645_998_66, 0.427_323_4]);
    single("NdfMap::invert", map.invert(direction()), [0.257_028_73, -0.914_421_2]);
    let map = NdfMap::from_texels(
        2,
        2,
        &[1.0, 2.0, 3.0, 4.0],
        Measure::ProjectedSolidAngle,
        Reconstruction::Constant,
    )
    .unwrap();
    single("NdfMap::from_texels", map.warp_gaussian(Z), [0.488_912_43, -0.571_194_89, 0.659_318_63]);
}

#[test]
fn packed_maps() {
    let ggx = Ggx::new(0.2, 0.4).unwrap();
    let h = direction();
    for (kind, n, u, density) in [
        (Reconstruction::Constant, [-0.08157335, 0.2463624], [0.9321298, 0.15395501], 0.29030696),
        (Reconstruction::Bilinear, [-0.08215712, 0.25313857], [0.9320055, 0.15815866], 0.261013),
    ] {
        let map = NdfMap::from_ndf(48, 40, kind, &ggx).unwrap();
        let map = PackedMapRef::new(map.array()).unwrap();
        single("PackedMapRef::inverse", map.inverse(Vec2::new(0.3, 0.8)), n);
        single("PackedMapRef::forward", map.forward(h.truncate()), u);
        single("PackedMapRef::d", map.d(h), [density]);
    }
}

#[test]
fn tables() {
    let table = NormalLut::new(&Ggx::new(0.2, 0.4).unwrap(), 16).unwrap();
    assert_eq!((table.size(), table.view().entries().len()), (16, 256));
    let (nearest, bilinear) = (table.nearest(Z), table.bilinear(Z));
    single("NormalTable::nearest", nearest.normal, [0.148_413_45, -0.494_711_52, 0.856_290_82]);
    single("NormalTable::bilinear", bilinear.tangent, [0.992_469_9, 0.025_873_253, -0.119_724_96]);
    let g = NoiseCdfRef::new(1.5, &[0.0, 0.1, 0.6, 1.0]).unwrap();
    let got = [g.cdf(0.2), g.invert(0.2), g.quantile(0.3), g.warp_gaussian(0.7)];
    single("NoiseCdfRef", got, [0.450_000_02, -0.125_661_3, -0.099_999_994, 0.895_090_76]);
}

#[test]
fn frames() {
    let frame = Frame::from_normal(direction());
    single("Frame::from_normal", frame.tangent, [0.956_043_96, 0.065_934_069, -0.285_714_3]);
    single("Frame::to_local", frame.to_local(Vec3::new(1.0, 2.0, 3.0)), [0.230_769_16, 3.153_846_3, 2.0]);
    single(
        "Frame::to_world",
        frame.to_world(Vec3::new(1.0, 2.0, 3.0)),
        [1.945_055, 0.582_417_61, 3.142_857_1],
    );
    let frame = Frame::from_normal_tangent(direction(), Vec3::new(1.0, 2.0, 3.0));
    single("Frame::from_normal_tangent", frame.bitangent, [-0.948_683_26, -7.4505806e-09, 0.316_227_76]);
}

#[test]
fn gaussian() {
    pinned(
        "phi",
        [gaussian_cdf(-6.5), gaussian_cdf(-3.0), gaussian_cdf(0.3), gaussian_cdf(2.0)],
        [
            4.016000583859118e-11,
            0.001_349_898_031_630_094_8,
            0.617_911_422_188_952_7,
            0.977_249_868_051_820_8,
        ],
        DOUBLE,
    );
    pinned(
        "inverse_gaussian_cdf",
        [inverse_gaussian_cdf(1e-12), inverse_gaussian_cdf(0.01), inverse_gaussian_cdf(0.6)],
        [-7.034_483_825_301_132, -2.326_347_874_040_840_8, 0.253_347_103_135_799_7],
        DOUBLE,
    );
}
