//! Every kind as a field: continuous across cells, decorrelated between seeds, total on any input.

use asperity_noise::{
    Gaussian, GaussianOctaves, Noise, Normalisation, Octaves, Perlin1985, Perlin2002, PermutationTable,
    Sample, Simplex, Spectrum,
    glam::{Vec2, Vec3},
};
use asperity_tests::random::Random;

type Field2 = (&'static str, fn(Vec2, u32) -> Sample<Vec2>);
type Field3 = (&'static str, fn(Vec3, u32) -> Sample<Vec3>);

fn planar() -> [Field2; 6] {
    [
        ("Perlin 1985", |p, seed| Perlin1985::default().sample(p, seed)),
        ("Perlin 2002", |p, seed| Perlin2002::default().sample(p, seed)),
        ("Perlin 2002 by permutation", |p, seed| Perlin2002(PermutationTable::new(1)).sample(p, seed)),
        ("simplex", |p, seed| Simplex::CONTINUOUS.sample(p, seed)),
        ("Gaussian", |p, seed| Gaussian::default().sample(p, seed)),
        ("Gaussian by permutation", |p, seed| Gaussian(PermutationTable::new(1)).sample(p, seed)),
    ]
}

fn spatial() -> [Field3; 6] {
    [
        ("Perlin 1985", |p, seed| Perlin1985::default().sample(p, seed)),
        ("Perlin 2002", |p, seed| Perlin2002::default().sample(p, seed)),
        ("Perlin 2002 by permutation", |p, seed| Perlin2002(PermutationTable::new(1)).sample(p, seed)),
        ("simplex", |p, seed| Simplex::CONTINUOUS.sample(p, seed)),
        ("Gaussian", |p, seed| Gaussian::default().sample(p, seed)),
        ("Gaussian by permutation", |p, seed| Gaussian(PermutationTable::new(1)).sample(p, seed)),
    ]
}

const STEP: f32 = 1.0 / 1024.0;
/// What a step may add beyond the mean of the two gradients: h²/4 times the jump of the second derivative (at most 80)
/// and rounding. Worst seen 1.2e-5.
const LEAP: f32 = 4e-5;

#[test]
fn fields_are_continuous_across_cells_on_both_sides_of_the_origin() {
    for (name, field) in planar() {
        for seed in 0..8 {
            for i in -6000..6000_i16 {
                let at = |i: i16| Vec2::new(f32::from(i) * STEP, f32::from(i) * 0.5 * STEP + 0.3);
                let (a, b) = (field(at(i), seed), field(at(i + 1), seed));
                let mean = (a.gradient + b.gradient) * 0.5;
                let expected = mean.dot(at(i + 1) - at(i));
                assert!((b.value - a.value - expected).abs() < LEAP, "2-D {name}, step {i}: {a:?} to {b:?}");
            }
        }
    }
    for (name, field) in spatial() {
        for seed in 0..8 {
            for i in -6000..6000_i16 {
                let t = |i: i16| f32::from(i) * STEP;
                let at = |i: i16| Vec3::new(t(i), t(i) * 0.5 + 0.3, 0.1 - t(i) * 0.75);
                let (a, b) = (field(at(i), seed), field(at(i + 1), seed));
                let mean = (a.gradient + b.gradient) * 0.5;
                let expected = mean.dot(at(i + 1) - at(i));
                assert!((b.value - a.value - expected).abs() < LEAP, "3-D {name}, step {i}: {a:?} to {b:?}");
            }
        }
    }
}

/// The greatest leap of the wide simplex noise beyond its gradient, over walks of many seeds.
fn greatest_leap(field: impl Fn(f32, u32) -> (f32, f32)) -> f32 {
    let mut greatest = 0.0_f32;
    for seed in 0..400 {
        for i in -3000..3000_i16 {
            let at = |i: i16| f32::from(i) * STEP;
            let ((a, slope_a), (b, slope_b)) = (field(at(i), seed), field(at(i + 1), seed));
            greatest = greatest.max((b - a - 0.5 * STEP * (slope_a + slope_b)).abs());
        }
    }
    greatest
}

#[test]
fn the_wide_simplex_kernel_leaps_at_faces() {
    let planar = greatest_leap(|t, seed| {
        let direction = Vec2::new(0.8, 0.6);
        let sample = Simplex::WIDE.sample(direction * t, seed);
        (sample.value, sample.gradient.dot(direction))
    });
    let spatial = greatest_leap(|t, seed| {
        let direction = Vec3::new(0.48, 0.6, -0.64);
        let sample = Simplex::WIDE.sample(direction * t, seed);
        (sample.value, sample.gradient.dot(direction))
    });
    assert!(planar > 1e-3 && planar < 0.006, "2-D: {planar}");
    assert!(spatial > 1e-3 && spatial < 0.006, "3-D: {spatial}");
}

/// The correlation of two fields and of their squares over random points, in standard errors.
fn correlations(a: impl Fn(Vec3) -> f32, b: impl Fn(Vec3) -> f32) -> [f64; 2] {
    const COUNT: u32 = 40_000;
    let mut random = Random(11);
    let values: Vec<[f64; 2]> = (0..COUNT)
        .map(|_| {
            // Mostly in cells of their own, so that the points are independent.
            let p = Vec3::from_array([(); 3].map(|()| ((random.uniform() - 0.5) * 2000.0) as f32));
            [f64::from(a(p)), f64::from(b(p))]
        })
        .collect();
    let correlation = |f: &dyn Fn(f64) -> f64| {
        let mean = |g: &dyn Fn(&[f64; 2]) -> f64| values.iter().map(g).sum::<f64>() / f64::from(COUNT);
        let (ma, mb) = (mean(&|v| f(v[0])), mean(&|v| f(v[1])));
        let covariance = mean(&|v| (f(v[0]) - ma) * (f(v[1]) - mb));
        let (va, vb) = (mean(&|v| (f(v[0]) - ma).powi(2)), mean(&|v| (f(v[1]) - mb).powi(2)));
        covariance / (va * vb).sqrt() * f64::from(COUNT).sqrt()
    };
    [correlation(&|x| x), correlation(&|x| x * x)]
}

#[test]
fn seeds_axes_and_mirror_images_are_decorrelated() {
    // 4.2 standard errors for significance 0.001/40.
    // A permutation table has only 256 words, too few for other seeds to be uncorrelated.
    for (name, field) in spatial().into_iter().filter(|(name, _)| !name.ends_with("permutation")) {
        for (how, other) in [
            (
                "the next seed",
                (|p, field| field(p, 6)) as fn(Vec3, fn(Vec3, u32) -> Sample<Vec3>) -> Sample<Vec3>,
            ),
            ("seed and high bit", |p, field| field(p, 5 | 1 << 31)),
            ("swapped axes", |p, field| field(Vec3::new(p.y, p.x, p.z), 5)),
            ("rotated axes", |p, field| field(Vec3::new(p.y, p.z, p.x), 5)),
            ("the mirror image", |p, field| field(-p, 5)),
        ] {
            let [values, squares] = correlations(|p| field(p, 5).value, |p| other(p, field).value);
            assert!(values.abs() < 4.2, "{name} and {how}: correlation of {values} standard errors");
            // Other kinds have a variance that depends on the place in the cell.
            if name == "Gaussian" {
                assert!(
                    squares.abs() < 4.2,
                    "{name} and {how}: squares' correlation of {squares} standard errors"
                );
            }
        }
    }
}

const NOT_FINITE: [f32; 3] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];
const HUGE: [f32; 9] = [
    8_388_608.5,
    16_777_216.0,
    -16_777_218.0,
    2_147_483_648.0,
    -2_147_483_648.0,
    1e19,
    -1e19,
    f32::MAX,
    f32::MIN,
];

#[test]
fn points_that_are_not_finite_give_zero() {
    for bad in NOT_FINITE {
        for k in 0..3 {
            let mut p = [0.3; 3];
            p[k] = bad;
            for (name, field) in spatial() {
                assert_eq!(field(Vec3::from_array(p), 1), Sample::default(), "{name} at {p:?}");
            }
            assert_eq!(Simplex::WIDE.sample(Vec3::from_array(p), 1), Sample::default());
            assert_eq!(Gaussian::default().pair(Vec3::from_array(p), 1), [Sample::default(); 2]);
            let octaves = GaussianOctaves::new(Spectrum::default(), 1);
            assert_eq!(octaves.pair(Vec3::from_array(p), 3.5), [Sample::default(); 2]);
            let octaves =
                Octaves::new(Perlin2002::default(), Spectrum::default(), Normalisation::Variance, 1);
            assert_eq!(octaves.sample(Vec3::from_array(p), 3.5), Sample::default());
            for (name, field) in planar() {
                let p = if k == 0 { Vec2::new(bad, 0.3) } else { Vec2::new(0.3, bad) };
                assert_eq!(field(p, 1), Sample::default(), "{name} at {p}");
            }
        }
    }
}

#[test]
fn huge_points_give_finite_samples() {
    for huge in HUGE {
        for p in [Vec3::new(huge, 0.3, 0.6), Vec3::new(0.1, huge, huge), Vec3::splat(huge)] {
            for (name, field) in spatial() {
                let sample = field(p, 1);
                assert!(
                    sample.value.abs() < 24.0 && sample.gradient.is_finite(),
                    "{name} at {p}: {sample:?}"
                );
            }
            for (name, field) in planar() {
                let sample = field(p.truncate(), 1);
                assert!(
                    sample.value.abs() < 24.0 && sample.gradient.is_finite(),
                    "{name} at {p}: {sample:?}"
                );
            }
            for sample in GaussianOctaves::new(Spectrum::default(), 1).pair(p, 10.0) {
                assert!(
                    sample.value.is_finite() && sample.gradient.is_finite(),
                    "octaves at {p}: {sample:?}"
                );
            }
        }
    }
    // 2³² + 1024 is the cell 1024 again.
    let (near, far) = (Vec2::new(1024.0, 0.5), Vec2::new(4_294_968_320.0, 0.5));
    assert_eq!(Gaussian::default().sample(near, 1), Gaussian::default().sample(far, 1));
}

#[test]
fn octaves_take_any_count_and_stay_in_range() {
    let noise = Octaves::new(Simplex::CONTINUOUS, Spectrum::default(), Normalisation::Range, 1);
    let mut random = Random(12);
    for i in 0..2000_u16 {
        let p = Vec3::from_array([(); 3].map(|()| ((random.uniform() - 0.5) * 50.0) as f32));
        let octaves = f32::from(i) / 180.0;
        assert!(noise.sample(p, octaves).value.abs() <= 1.0, "{octaves} octaves at {p}");
        for nothing in [0.0, -1.0, f32::NAN, f32::NEG_INFINITY] {
            assert_eq!(noise.sample(p, nothing), Sample::default());
        }
        assert_eq!(noise.sample(p, f32::INFINITY), noise.sample(p, 10.0));
    }
}

#[test]
fn a_lone_octave_stays_as_it_is_however_small_its_weight() {
    let p = Vec3::new(0.3, -1.7, 2.4);
    for normalisation in [Normalisation::Range, Normalisation::Variance] {
        let noise = Octaves::new(Perlin2002::default(), Spectrum::default(), normalisation, 3);
        for octaves in [1e-45, 1e-40, 1e-39, 1e-30, 3e-23, 0.5] {
            assert_eq!(noise.sample(p, octaves), noise.sample(p, 1.0), "{normalisation:?} {octaves}");
            let [lone, whole] = [octaves, 1.0].map(|o| noise.standard_deviation(o));
            assert_eq!(lone, whole, "{normalisation:?} {octaves}");
        }
    }
}
