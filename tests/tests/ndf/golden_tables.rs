//! Pinned values of normal tables, bump maps, noise distributions and unresolved parts: a change is
//! value-breaking. As in `golden.rs`, values are pinned to a few units in the last place.

use asperity_ndf_sampling::{
    Beckmann, ConditionalNdf, ConditionalTable, GaussianDistribution, GaussianSplit, Ggx,
    KurtoticDistribution, Ndf, NdfEstimator, NoiseCdfRef, NoiseDistribution, NormalLut, OffsetBeckmann,
    add_detail, add_detail_normal, estimate_ndf,
    normal_map::{NormalMapFormat, TangentSpace, Zero},
    normal_table::{Chart, Spacing, TableLayout},
};
use glam::{Vec2, Vec3};

use asperity_tests::pinned::{Numbers, SINGLE, pinned, single};

use super::golden::{Z, direction};

#[test]
fn charts_and_spacings() {
    single("Chart::Projected", Chart::Projected.to_point(direction()), [0.2857143, -0.42857143]);
    single("Chart::Slopes", Chart::Slopes.to_point(direction()), [0.33333334, -0.5]);
    single("Chart::Stereographic", Chart::Stereographic.to_point(direction()), [0.15384616, -0.23076923]);
    let p = Vec2::new(0.3, -0.4);
    single("Chart::Projected", Chart::Projected.to_normal(p), [0.30000001, -0.40000001, 0.86602539]);
    single("Chart::Slopes", Chart::Slopes.to_normal(p), [0.26832816, -0.35777089, 0.89442718]);
    single("Chart::Stereographic", Chart::Stereographic.to_normal(p), [0.48000002, -0.64000005, 0.60000002]);
    let spacings = [Spacing::Coordinates, Spacing::Quantiles, Spacing::Warped];
    single(
        "Spacing::place",
        spacings.map(|by| f64::from(by.place(1.3))),
        [0.64444447, 0.90319949, 0.73893231],
    );
    single(
        "Spacing::coordinate",
        spacings.map(|by| f64::from(by.coordinate(0.2))),
        [-2.7, -0.84162122, -1.7284979],
    );
}

#[test]
fn tables_of_normals() {
    let ggx = Ggx::new(0.2, 0.4).unwrap();
    let layout = TableLayout { spacing: Spacing::Warped, chart: Chart::Slopes };
    let table = NormalLut::with_layout(&ggx, 16, layout).unwrap();
    single("bilinear, warped slopes", table.view().bilinear_normal(Z), [0.11860554, -0.40503016, 0.90657783]);
    single("nearest, warped slopes", table.view().nearest_normal(Z), [0.13651079, -0.39627129, 0.90792835]);
    let accuracy = table.accuracy(&ggx);
    let angles = [
        accuracy.nearest.rms,
        accuracy.nearest.largest,
        accuracy.bilinear.rms,
        accuracy.bilinear.largest,
        accuracy.bilinear_half.rms,
        accuracy.largest_step,
    ];
    pinned(
        "NormalTable::accuracy",
        angles.numbers(),
        [0.099320903, 0.26526895, 0.02356004, 0.13109571, 0.023563193, 0.4971796],
        1e-4,
    );
    single("TableAccuracy::beyond", [accuracy.beyond], [0.000368133]);
    let halves = table.halves();
    let packed = NormalLut::from_entries(16, layout, &halves).unwrap();
    single("bilinear, half floats", packed.bilinear_normal(Z), [0.11863048, -0.4050467, 0.90656716]);
}

#[test]
fn bump_maps() {
    let directx = NormalMapFormat {
        tangent_space: TangentSpace::DirectX,
        zero: Zero::Half,
        ..NormalMapFormat::default()
    };
    assert_eq!(directx.encode_u8(direction()), [164, 182, 237]);
    assert_eq!(directx.encode_u16(direction()), [42130, 46811, 60854]);
    single("decode_u8", directx.decode_u8([200, 30, 220]), [0.47217435, 0.64268172, 0.60333383]);
    single("decode_u16", directx.decode_u16([50_000, 30, 52_000]), [0.41327325, 0.78515202, 0.46123907]);
    let mut estimator = NdfEstimator::new(16, 0.4).unwrap();
    estimator.extend([direction(), Vec3::Z, Vec3::new(-0.6, 0.8, 0.0)]);
    let texels = estimator.texels();
    single("NdfEstimator", [texels[0], texels[119], texels[90]], [0.0, 1.1468836, 1.1644205]);
    let normals: Vec<Vec3> = (0..100).map(|k| Vec3::new(k as f32 * 0.004, 0.1, 1.0).normalize()).collect();
    let suited = NdfEstimator::suited(&normals);
    single("NdfEstimator::suited", [suited.size() as f64, f64::from(suited.width())], [512.0, 0.015686275]);
    let estimate = estimate_ndf(&normals).unwrap();
    pinned("estimate_ndf", estimate.d(normals[40]).numbers(), [121.53986], 10.0 * SINGLE);
    single("detailed", add_detail(Z, Vec2::new(-0.3, 1.0), 0.5), [0.4919349, -0.62609905]);
    let ggx = Ggx::new(0.2, 0.4).unwrap();
    single(
        "detailed_normal",
        add_detail_normal(&ggx, direction(), Z, 0.5),
        [0.33640453, -0.62975997, 0.70016748],
    );
}

#[test]
fn distributions_of_noise() {
    let turbulence = NoiseCdfRef::between(0.5, 2.0, &[0.0, 0.3, 0.9, 1.0]).unwrap();
    single("NoiseCdfRef::between", turbulence.invert(0.8), [-0.91536504]);
    let gaussian = GaussianDistribution::new(0.7).unwrap();
    let kurtotic = KurtoticDistribution::new(0.7, -0.5).unwrap();
    for (name, noise, expected) in [
        (
            "GaussianNoise",
            &gaussian as &dyn NoiseDistribution,
            [1.2857143, 0.76999998, 0.28385457, -0.58913487],
        ),
        ("KurtoticNoise", &kurtotic, [1.24364984, 0.805968285, 0.299737692, -0.629065633]),
    ] {
        let got = [noise.invert(0.9), noise.warp_gaussian(1.1), noise.cdf(-0.4), noise.quantile(0.2)];
        single(name, got, expected);
    }
}

#[test]
fn unresolved_parts() {
    let ggx = Ggx::new(0.2, 0.4).unwrap();
    let seen = ConditionalNdf::new(ggx, Z, 0.75);
    pinned("ConditionalNdf::d", seen.d(direction()).numbers(), [1.2571207], 5.0 * SINGLE);
    single("ConditionalNdf::warp_gaussian", seen.warp_gaussian(-Z), [0.037107747, -0.12722658, 0.99117923]);
    single("ConditionalNdf::invert", seen.invert(direction()), [1.7162881, -0.11808181]);
    let offset = OffsetBeckmann::new(Vec2::new(0.3, -0.2), [0.04, -0.01, 0.09]).unwrap();
    single("OffsetBeckmann::d", offset.d(direction()), [3.0229151]);
    single("OffsetBeckmann::warp_gaussian", offset.warp_gaussian(Z), [0.35437137, -0.47515145, 0.80538946]);
    pinned(
        "OffsetBeckmann::invert",
        offset.invert(direction()).numbers(),
        [0.16666666, -0.98601335],
        10.0 * SINGLE,
    );
    let beckmann = OffsetBeckmann::conditional(Beckmann::new(0.2, 0.4).unwrap(), Z, 0.9);
    single("OffsetBeckmann::conditional", beckmann.warp_gaussian(-Z), [0.061101012, -0.20948918, 0.97590011]);
    let table = ConditionalTable::new(&ggx, 32).unwrap();
    let density = table.view().residual_ndf(direction(), GaussianSplit::new(Z, 0.75));
    pinned("ConditionalTable::d", density.numbers(), [1.2619957], 5.0 * SINGLE);
    single("ConditionalTable::invert", table.view().invert(direction()), [1.465818, -1.0993671]);
    single("GaussianSplit::rest", GaussianSplit::new(Z, 0.3).rest(Vec2::ONE), [0.73697102, 1.980813]);
    single("GaussianSplit::join", GaussianSplit::new(Z, 0.3).join(Vec2::ONE), [1.2200658, 0.17939293]);
}
