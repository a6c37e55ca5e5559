//! Pinned values of the parametric densities: a change of one is value-breaking.
//!
//! They are pinned to a few units in the last place, as the other densities' are.

use asperity_ndf_sampling::{
    AshikhminShirley, Beckmann, Blend, BlinnPhong, Ggx, Isotropic, Microfacet, Mixture, Ndf, Radial, Rotated,
    StudentT, Ward,
};
use glam::{Vec2, Vec3};

const Z: Vec2 = Vec2::new(0.7, -1.2);
const U: Vec2 = Vec2::new(0.3, 0.8);
const V: Vec3 = Vec3::new(0.8, -0.36, 0.48);
/// Some units in the last place of `f32`, after some steps.
const TOLERANCE: f32 = 3e-6;

fn pinned<const N: usize>(what: &str, got: [f32; N], expected: [f32; N]) {
    let close =
        got.iter().zip(expected).all(|(got, expected)| (got - expected).abs() <= TOLERANCE * expected.abs());
    assert!(close, "{what}: {got:?} is pinned to {expected:?}");
}

fn direction() -> Vec3 {
    Vec3::new(2.0, -3.0, 6.0) / 7.0
}

/// `D`, the density of slopes, `T`, `T⁻¹` and a sample.
fn maps(what: &str, ndf: &dyn Ndf, expected: [f32; 11]) {
    let (h, m, z, s) = (direction(), ndf.from_gaussian(Z), ndf.to_gaussian(direction()), ndf.sample(U));
    let slopes = ndf.slope_density(Vec2::new(0.3, -0.4));
    pinned(
        what,
        [ndf.density(h), slopes, ndf.sample_density(h), m.x, m.y, m.z, z.x, z.y, s.x, s.y, s.z],
        expected,
    );
}

/// Λ, σ, G₁, both G₂, a visible normal and its density.
fn masking(what: &str, ndf: &dyn Microfacet, expected: [f32; 9]) {
    let (w, m) = (Vec3::new(-0.6, 0.0, 0.8), ndf.sample_visible(V, U));
    let areas = [ndf.lambda(V), ndf.projected_area(V), ndf.g1(V), ndf.g2(V, w), ndf.g2_separable(V, w)];
    let [lambda, area, g1, g2, separable] = areas;
    pinned(
        what,
        [lambda, area, g1, g2, separable, m.x, m.y, m.z, ndf.visible_density(V, direction())],
        expected,
    );
}

#[test]
fn parametric_densities() {
    let ndf = StudentT::new(0.2, 0.4, 3.0).unwrap();
    maps(
        "StudentT",
        &ndf,
        [
            0.231_372_85,
            0.219_974_38,
            0.198_319_58,
            0.104_172,
            -0.357_161_16,
            0.928_215_5,
            1.718_623,
            -1.288_967_3,
            0.037_545_39,
            -0.231_105_58,
            0.972_203_97,
        ],
    );
    masking(
        "StudentT",
        &ndf,
        [
            0.007_159_736_5,
            0.483_436_67,
            0.992_891_2,
            0.992_771_8,
            0.992_770_9,
            0.063_282_825,
            0.193_143_56,
            0.979_127_6,
            0.380_145_25,
        ],
    );
    let ndf = Ward::new(0.2, 0.4).unwrap();
    maps(
        "Ward",
        &ndf,
        [
            0.096_070_14,
            0.154_277_56,
            0.082_345_836,
            0.093_333_35,
            -0.320_000_05,
            0.942_809_1,
            2.357_022_8,
            -1.767_766_8,
            0.035_969_842,
            -0.221_407_52,
            0.974_517_76,
        ],
    );
    masking(
        "Ward",
        &ndf,
        [
            6.972645e-5,
            0.480_033_46,
            0.999_930_26,
            0.999_930_26,
            0.999_930_26,
            0.058_112_94,
            0.208_091_4,
            0.976_381_5,
            0.158_962_15,
        ],
    );
    let ndf = BlinnPhong::new(20.0).unwrap();
    maps(
        "BlinnPhong",
        &ndf,
        [
            0.160_437_91,
            0.240_614_92,
            0.137_518_21,
            0.146_026_43,
            -0.250_331,
            0.957_084_5,
            1.444_632_5,
            -2.166_948_8,
            0.055_196_5,
            -0.169_877_29,
            0.983_918_25,
        ],
    );
    masking(
        "BlinnPhong",
        &ndf,
        [
            0.001_492_152_5,
            0.480_716_23,
            0.998_510_06,
            0.998_509_94,
            0.998_509_94,
            0.052_373_68,
            0.169_448_05,
            0.984_146_54,
            0.265_091,
        ],
    );
    let ndf = AshikhminShirley::new(50.0, 10.0).unwrap();
    maps(
        "AshikhminShirley",
        &ndf,
        [
            0.127_639_17,
            0.167_220_76,
            0.109_405_01,
            0.094_014_74,
            -0.335_498_24,
            0.937_337_8,
            2.220_995_7,
            -1.600_397_7,
            0.035_700_92,
            -0.228_725_33,
            0.972_836_14,
        ],
    );
    masking(
        "AshikhminShirley",
        &ndf,
        [
            0.000_368_957_93,
            0.480_177_07,
            0.999_631_17,
            0.999_631_17,
            0.999_631_17,
            0.016_212_191,
            0.490_140_14,
            0.871_492_9,
            0.211_134_57,
        ],
    );
    let ndf = Rotated::new(Ggx::new(0.2, 0.4).unwrap(), 0.7).unwrap();
    maps(
        "Rotated",
        &ndf,
        [
            0.660_175_26,
            0.598_936_1,
            0.565_864_5,
            0.259_180_55,
            -0.368_160_64,
            0.892_907_2,
            0.715_570_33,
            -1.378_698_8,
            0.185_569_05,
            -0.159_419_18,
            0.969_613_2,
        ],
    );
    masking(
        "Rotated",
        &ndf,
        [
            0.103_997_886,
            0.529_918_97,
            0.905_798_8,
            0.895_679_5,
            0.894_640_1,
            -0.255_806_74,
            0.188_586_8,
            0.948_155_05,
            0.989_524_5,
        ],
    );
    let ndf = Mixture::new(Beckmann::isotropic(0.3).unwrap(), BlinnPhong::new(0.0).unwrap(), 0.7).unwrap();
    maps(
        "Mixture",
        &ndf,
        [
            0.178_469_17,
            0.215_048_57,
            0.152_973_58,
            0.185_813_2,
            -0.318_536_94,
            0.929_520_13,
            0.946_705_64,
            -1.420_058_4,
            0.067_667_25,
            -0.208_258_33,
            0.975_730_3,
        ],
    );
    masking(
        "Mixture",
        &ndf,
        [
            0.162_924_27,
            0.558_203_64,
            0.859_901_2,
            0.833_038_75,
            0.828_820_4,
            0.141_245_19,
            0.128_613_07,
            0.981_584_67,
            0.253_949_46,
        ],
    );
    let (ggx, beckmann) = (Ggx::new(0.2, 0.4).unwrap(), Beckmann::new(0.2, 0.4).unwrap());
    masking(
        "Ggx",
        &ggx,
        [
            0.047_976_084,
            0.503_028_5,
            0.954_220_2,
            0.949_154,
            0.948_912_26,
            0.019_224_735,
            0.486_633_15,
            0.873_394_9,
            0.408_134_88,
        ],
    );
    masking(
        "Beckmann",
        &beckmann,
        [
            6.972645e-5,
            0.480_033_46,
            0.999_930_26,
            0.999_930_26,
            0.999_930_26,
            0.058_112_94,
            0.208_091_4,
            0.976_381_5,
            0.158_962_15,
        ],
    );
    let converted =
        [BlinnPhong::from_roughness(0.3).unwrap().exponent(), BlinnPhong::new(20.0).unwrap().roughness()];
    pinned("conversions", converted, [20.222_221, 0.301_511_35]);
    pinned("Ward::lobe", [Ward::new(0.2, 0.4).unwrap().lobe(direction())], [0.012_964_068]);
}

#[test]
fn composed_densities() {
    let table = Isotropic::new(&[0.1, 0.5, 0.4, 2.0, 9.0]).unwrap();
    maps(
        "Isotropic",
        &table,
        [
            0.534_600_2,
            0.413_581_1,
            0.458_228_74,
            0.256_815_7,
            -0.440_255_52,
            0.860_360_86,
            0.780_489_5,
            -1.170_734_3,
            -0.201_594_8,
            0.323_543_7,
            0.924_488_5,
        ],
    );
    pinned("Radial::exponent", [table.exponent(0.7).unwrap() as f32], [1.286_901_8]);
    let blend = Blend::new(Ggx::new(0.2, 0.4).unwrap(), Beckmann::new(0.5, 0.1).unwrap(), 0.3).unwrap();
    let (m, s, h) = (blend.sample(U), blend.sample_visible(V, U), direction());
    let areas = [blend.density(h), blend.lambda(V), blend.projected_area(V), blend.visible_density(V, h)];
    pinned("Blend", areas, [0.077_542_68, 0.022_148_935, 0.490_631_46, 0.125_534_24]);
    pinned(
        "Blend::sample",
        [m.x, m.y, m.z, s.x, s.y, s.z],
        [-0.0, 0.0, 1.0, 0.481_895_71, -0.341_391_18, 0.806_987_35],
    );
}
