//! Pinned values of every public function of the crate: a change of one is value-breaking.
//!
//! They are pinned to a few units in the last place, not to the bit: the float functions of `std` round differently from
//! platform to platform, and `libm`'s differently again.

use asperity_ndf_sampling::{
    Beckmann, Frame, GaussianSplit, Ggx, Measure, Ndf, NdfMap, NoiseCdfRef, NormalTable, PackedMapRef,
    Reconstruction, conditional_density, inverse_phi, level_of_detail::MAX_SHARE, phi,
};
use asperity_tests::pinned::{SINGLE, pinned, vec2, vec3};
use glam::{Vec2, Vec3};

/// Some units in the last place of `f64`.
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
    pinned("Ggx::density", [f64::from(ggx.density(h))], [0.258_475_57], SINGLE);
    pinned(
        "Ggx::from_gaussian",
        vec3(ggx.from_gaussian(Z)),
        [0.116_753_96, -0.400_299_28, 0.908_916_35],
        SINGLE,
    );
    pinned("Ggx::to_gaussian", vec2(ggx.to_gaussian(h)), [1.464_361_8, -1.098_271_4], SINGLE);
    pinned("Beckmann::density", [f64::from(beckmann.density(h))], [0.096_070_141], SINGLE);
    pinned(
        "Beckmann::from_gaussian",
        vec3(beckmann.from_gaussian(Z)),
        [0.093_333_341, -0.320_000_02, 0.942_809_1],
        SINGLE,
    );
    pinned("Beckmann::to_gaussian", vec2(beckmann.to_gaussian(h)), [2.357_022_8, -1.767_767], SINGLE);
    let clamped = Ggx::clamped(f32::NAN, -1.0);
    pinned("clamped", [f64::from(clamped.alpha_x()), f64::from(clamped.alpha_y())], [1.0, 1e-6], SINGLE);
}

#[test]
fn level_of_detail() {
    let ggx = Ggx::new(0.2, 0.4).unwrap();
    let seen = [0.25, 0.75, 0.99].map(|s| f64::from(conditional_density(&ggx, direction(), Z, s)));
    // The exponent of the last is −29, which magnifies the rounding of its terms.
    pinned("conditional_density", seen, [0.681_554_79, 1.257_120_7, 1.372_429_5e-11], 30.0 * SINGLE);
    let split = GaussianSplit::new(Z, 0.5);
    pinned(
        "GaussianSplit",
        [split.share(), split.weigh(1.0, -Z)].map(f64::from),
        [0.5, 0.018_943_675],
        SINGLE,
    );
    assert_eq!(MAX_SHARE, 0.999_999_05);
}

#[test]
fn maps() {
    let map =
        NdfMap::from_fn(24, 16, Measure::Normals, Reconstruction::Constant, |n| 0.1 + n.x * n.x + 0.5 * n.y)
            .unwrap_err();
    assert_eq!(map.to_string().split(' ').next(), Some("texel"));
    let map = NdfMap::from_fn(24, 16, Measure::SolidAngle, Reconstruction::Constant, |n| {
        0.7 + n.x * n.x + 0.5 * n.y
    })
    .unwrap();
    let cdf = map.cdf();
    assert_eq!((cdf.width(), cdf.height()), (24, 16));
    pinned("NdfMap::density", [f64::from(map.density(direction()))], [0.103_214_55], SINGLE);
    pinned(
        "NdfMap::from_gaussian",
        vec3(map.from_gaussian(Z)),
        [0.632_519_13, -0.645_998_66, 0.427_323_4],
        SINGLE,
    );
    pinned("NdfMap::to_gaussian", vec2(map.to_gaussian(direction())), [0.257_028_73, -0.914_421_2], SINGLE);
    pinned("Cdf::density", [cdf.density([0.3, 0.6])], [0.637_499_79], SINGLE);
    pinned("Cdf::marginal", [cdf.marginal(0.3), cdf.marginal_cdf(0.3)], [0.782_129_41, 0.353_155_29], SINGLE);
    pinned("Cdf::conditional_cdf", [cdf.conditional_cdf(0.3, 0.6)], [0.406_761_50], SINGLE);
    pinned("Cdf::inverse", cdf.inverse([0.01, 0.4]), [0.012_858_106, 0.480_371_34], SINGLE);
    pinned("Cdf::forward", cdf.forward([0.9, 0.4]), [0.857_682_86, 0.320_739_8], SINGLE);
    let map =
        NdfMap::from_texels(2, 2, &[1.0, 2.0, 3.0, 4.0], Measure::Normals, Reconstruction::Constant).unwrap();
    pinned(
        "NdfMap::from_texels",
        vec3(map.from_gaussian(Z)),
        [0.488_912_43, -0.571_194_89, 0.659_318_63],
        SINGLE,
    );
}

#[test]
fn packed_maps() {
    let ggx = Ggx::new(0.2, 0.4).unwrap();
    let h = direction();
    for (kind, n, u, density) in [
        (Reconstruction::Constant, [-0.0815735832, 0.246362448], [0.9321298, 0.153955042], 0.290306956),
        (Reconstruction::Bilinear, [-0.0821571201, 0.253138751], [0.932005525, 0.158158839], 0.261013001),
    ] {
        let array = NdfMap::from_ndf(48, 40, kind, &ggx).unwrap().pack();
        let map = PackedMapRef::new(&array).unwrap();
        pinned("PackedMapRef::inverse", vec2(map.inverse(Vec2::new(0.3, 0.8))), n, SINGLE);
        pinned("PackedMapRef::forward", vec2(map.forward(h.truncate())), u, SINGLE);
        pinned("PackedMapRef::density", [f64::from(map.density(h))], [density], SINGLE);
    }
}

#[test]
fn tables() {
    let table = NormalTable::new(&Ggx::new(0.2, 0.4).unwrap(), 16).unwrap();
    assert_eq!((table.size(), table.view().entries().len()), (16, 256));
    let (nearest, bilinear) = (table.nearest(Z), table.bilinear(Z));
    pinned("NormalTable::nearest", vec3(nearest.normal), [0.148_413_45, -0.494_711_52, 0.856_290_82], SINGLE);
    pinned(
        "NormalTable::bilinear",
        vec3(bilinear.tangent),
        [0.992_469_9, 0.025_873_253, -0.119_724_96],
        SINGLE,
    );
    let g = NoiseCdfRef::new(1.5, &[0.0, 0.1, 0.6, 1.0]).unwrap();
    let got =
        [g.range(), g.uniform(0.2), g.gaussian(0.2), g.inverse(0.3), g.from_gaussian(0.7)].map(f64::from);
    pinned("NoiseCdfRef", got, [1.5, 0.450_000_02, -0.125_661_3, -0.099_999_994, 0.895_090_76], SINGLE);
}

#[test]
fn frames() {
    let frame = Frame::from_normal(direction());
    pinned("Frame::from_normal", vec3(frame.tangent), [0.956_043_96, 0.065_934_069, -0.285_714_3], SINGLE);
    pinned(
        "Frame::to_local",
        vec3(frame.to_local(Vec3::new(1.0, 2.0, 3.0))),
        [0.230_769_16, 3.153_846_3, 2.0],
        SINGLE,
    );
    pinned(
        "Frame::to_world",
        vec3(frame.to_world(Vec3::new(1.0, 2.0, 3.0))),
        [1.945_055, 0.582_417_61, 3.142_857_1],
        SINGLE,
    );
    let frame = Frame::from_normal_tangent(direction(), Vec3::new(1.0, 2.0, 3.0));
    pinned(
        "Frame::from_normal_tangent",
        vec3(frame.bitangent),
        [-0.948_683_26, -7.4505806e-09, 0.316_227_76],
        SINGLE,
    );
}

#[test]
fn gaussian() {
    pinned(
        "phi",
        [phi(-6.5), phi(-3.0), phi(0.3), phi(2.0)],
        [
            4.016000583859118e-11,
            0.001_349_898_031_630_094_8,
            0.617_911_422_188_952_7,
            0.977_249_868_051_820_8,
        ],
        DOUBLE,
    );
    pinned(
        "inverse_phi",
        [inverse_phi(1e-12), inverse_phi(0.01), inverse_phi(0.6)],
        [-7.034_483_825_301_132, -2.326_347_874_040_840_8, 0.253_347_103_135_799_7],
        DOUBLE,
    );
}
