//! Glints in elongated pixels and under lights of some size.

use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::material::{GlintField, PaintFlakes};
use asperity_shading::ndf_sampling::{Ndf, gaussian_cdf};
use asperity_shading::{
    Beckmann, Footprint, Ggx, MetallicPaint, MetallicPaintParameters, PixelEllipse, SurfacePoint, check,
    reflect,
};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::random::Random;
use rayon::prelude::*;

use crate::checked::quick;

const VALID: &str = "in range";

fn pixel(width: f32, ratio: f32, turn: f32) -> PixelEllipse {
    let along = Vec3::new(turn.cos(), turn.sin(), 0.0);
    PixelEllipse::from_derivatives(along * (width * ratio), along.cross(Vec3::Z) * width)
}

fn half_vector() -> Vec3 {
    Vec3::new(0.15, 0.1, 1.0).normalize()
}

/// The mean of D over half vectors within an angular radius, by rings.
fn smooth(ndf: &impl Ndf, h: Vec3, spread: f32) -> f64 {
    let (u, mut sum) = (h.any_orthonormal_vector(), 0.0);
    let v = h.cross(u);
    for ring in 0..64_u8 {
        let radius = spread * ((f32::from(ring) + 0.5) / 64.0).sqrt();
        for k in 0..64_u8 {
            let turn = core::f32::consts::TAU * f32::from(k) / 64.0;
            let aside = radius * (turn.cos() * u + turn.sin() * v);
            sum += f64::from(ndf.d((h + aside).normalize()));
        }
    }
    sum / 4096.0
}

/// Mean of the density over the smooth one, and its standard error, over `count` random points.
fn mean<N: Ndf + Sync>(field: &GlintField<N>, [width, ratio, spread]: [f32; 3], count: u32) -> [f64; 2] {
    let (h, expected) = (half_vector(), smooth(field.ndf(), half_vector(), spread));
    let sums = (0..64_u32).into_par_iter().map(|part| {
        let mut random = Random(u64::from(part) * 1000 + (width * ratio) as u64);
        (0..count / 64).fold([0.0; 2], |[sum, squares], _| {
            let mut u = || random.uniform() as f32;
            let p = Vec3::new(u(), u(), 0.01 * u()) * 1e5;
            let value =
                f64::from(field.density_over(h, spread, p, &pixel(width, ratio, 3.0 * u()))) / expected;
            [sum + value, squares + value * value]
        })
    });
    let [sum, squares] = sums.reduce(|| [0.0; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
    let mean = sum / f64::from(count);
    [mean, ((squares / f64::from(count) - mean * mean) / f64::from(count)).sqrt()]
}

fn cases() -> impl Iterator<Item = [f32; 3]> {
    let spreads = |ratio: f32| [0.0, 0.02, 0.1].map(|spread| [ratio, spread]);
    let pixels = [1.0, 4.0, 16.0].into_iter().flat_map(spreads);
    pixels.flat_map(|[ratio, spread]| [1.5, 12.0].map(|width| [width, ratio, spread]))
}

#[test]
#[ignore = "slow: weekly"]
fn mean_over_elongated_pixels_and_lights_is_the_smooth_density() {
    fn check<N: Ndf + Sync>(name: &str, ndf: N) {
        let field = GlintField::new(ndf, 1.0, 0.25, 5).expect(VALID);
        for case in cases() {
            let [mean, error] = mean(&field, case, 1 << 12);
            // Seven half vectors for the light: 0.4 % at 0.1 rad.
            assert_abs_diff_eq!(mean, 1.0, epsilon = 0.005 + 4.5 * error, "{name} {case:?}: ± {error}");
        }
    }
    check("GGX", Ggx::new(0.2, 0.4).expect(VALID));
    check("Beckmann", Beckmann::new(0.3, 0.3).expect(VALID));
}

#[test]
#[ignore = "slow: weekly"]
fn mean_over_elongated_pixels_is_within_one_percent() {
    let field = GlintField::new(Ggx::new(0.2, 0.4).expect(VALID), 1.0, 0.25, 5).expect(VALID);
    let mut worst = [0.0_f64; 2];
    for case in cases() {
        let [mean, error] = mean(&field, case, 1 << 20);
        worst = [worst[0].max((mean - 1.0).abs()), worst[1].max(error)];
        assert!((mean - 1.0).abs() < 0.01, "{case:?}: {mean} ± {error}");
    }
    println!("largest deviation {}, largest standard error {}", worst[0], worst[1]);
}

#[test]
fn round_pixels_and_point_lights_are_those_of_density() {
    let field = GlintField::new(Ggx::new(0.2, 0.4).expect(VALID), 0.01, 0.1, 3).expect(VALID);
    let mut random = Random(8);
    for _ in 0..2000 {
        let mut u = || random.uniform() as f32;
        let (p, footprint) = (Vec3::new(u(), u(), u()), Footprint::from_width((8.0 * u() - 7.0).exp()));
        let h = Vec3::new(u() - 0.5, u() - 0.5, 1.0).normalize();
        assert_eq!(field.density_over(h, 0.0, p, &footprint.into()), field.density(h, p, footprint));
    }
}

#[test]
fn larger_lights_and_longer_pixels_see_more_flakes() {
    let field = GlintField::new(Ggx::new(0.3, 0.3).expect(VALID), 1.0, 0.1, 5).expect(VALID);
    let deviation = |ratio: f32, spread: f32| {
        let mut random = Random(4);
        let values = (0..20_000).map(|_| {
            let p = Vec3::new(random.uniform() as f32, random.uniform() as f32, 0.0) * 1e5;
            f64::from(field.density_over(half_vector(), spread, p, &pixel(4.0, ratio, 0.4)))
        });
        let values: Vec<f64> = values.collect();
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        (values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / values.len() as f64).sqrt() / mean
    };
    let [point, disk] = [0.0, 0.2].map(|spread| deviation(1.0, spread));
    let long = deviation(16.0, 0.0);
    println!("{point} {disk} {long}");
    // Independent flakes: the deviation is that of the inverse root of their number.
    assert!(disk < 0.6 * point, "{point} {disk}");
    assert_abs_diff_eq!(long, point / 4.0, epsilon = 0.1 * point);
}

/// Nothing pops: a small step of a camera changes the density by a small multiple of it.
///
/// Single flakes have borders, so the pixels are wider.
#[test]
fn glints_do_not_pop() {
    let field = GlintField::new(Ggx::new(0.3, 0.3).expect(VALID), 1.0, 0.1, 5).expect(VALID);
    let mut worst = [0.0_f32; 6];
    let mut random = Random(21);
    for _ in 0..4000 {
        let mut u = || random.uniform() as f32;
        let p = Vec3::new(u(), u(), u()) * 8.0;
        let (width, ratio, spread) = (3.2 * (4.0 * u()).exp(), 1.0 + 15.0 * u(), 0.2 * u());
        let h = Vec3::new(0.4 * u() - 0.2, 0.4 * u() - 0.2, 1.0).normalize();
        let at = |h: Vec3, p: Vec3, [width, ratio, turn]: [f32; 3], spread: f32| {
            field.density_over(h, spread, p, &pixel(width, ratio, turn))
        };
        let shape = [width, ratio, 0.7];
        let here = at(h, p, shape, spread);
        let steps = [
            at(h, p, [width, ratio * 1.000_01, 0.7], spread),
            at(h, p, [width * 1.000_01, ratio, 0.7], spread),
            at(h, p, [width, ratio, 0.700_01], spread),
            at(h, p, shape, spread * 1.000_01),
            at(h, p + Vec3::new(1e-5, -1e-5, 1e-5) * width, shape, spread),
            at((h + Vec3::new(1e-6, -1e-6, 0.0)).normalize(), p, shape, spread),
        ];
        for (worst, next) in worst.iter_mut().zip(steps) {
            *worst = worst.max((next - here).abs() / here.max(field.ndf().d(h)));
        }
    }
    println!("length, width, turn, light, position, half vector: {worst:?}");
    assert!(worst.iter().all(|&change| change < 1e-2), "{worst:?}");
}

/// Across borders of bins and of tetrahedra, and where counts end.
#[test]
fn glints_do_not_jump_at_borders() {
    let field = GlintField::new(Ggx::new(0.3, 0.3).expect(VALID), 1.0, 0.25, 5).expect(VALID);
    let ndf = field.ndf();
    let (mut random, mut worst) = (Random(3), [0.0_f32; 3]);
    let compare = |worst: &mut f32, [before, after]: [(Vec2, Vec3, f32); 2]| {
        let [before, after] = [before, after].map(|(z, p, width)| {
            let h = ndf.warp_gaussian(z);
            field.density_over(h, 0.0, p, &pixel(width, 2.0, 0.4)) / ndf.d(h)
        });
        *worst = worst.max((after - before).abs() / before.max(after).max(1.0));
    };
    for _ in 0..2000 {
        let mut u = || random.uniform() as f32;
        let p = Vec3::new(u(), u(), u()) * 40.0;
        let width = 3.2 * (3.0 * u()).exp();
        // The border between two bins.
        let z = Vec2::new(0.25 * (8.0 * u() - 4.0).round(), 2.0 * u() - 1.0);
        compare(&mut worst[0], [-1e-5, 1e-5].map(|step| (z + Vec2::new(step, 0.0), p, width)));
        // A face of the cubes of each lattice with up to four spacings between points.
        let face = Vec3::new(4.0 * (10.0 * u()).floor(), p.y, p.z);
        compare(&mut worst[1], [-1e-4, 1e-4].map(|step| (z, face + Vec3::new(step, 0.0, 0.0), width)));
        // The width at which a level ends, and the last of them.
        let level = if u() < 0.5 { 14.0 } else { (2.0 + 10.0 * u()).floor() };
        let end = level.exp2() / 0.632_455_5;
        compare(&mut worst[2], [-1e-5, 1e-5].map(|step| (z, p, 0.5 * end * (1.0 + step))));
        compare(&mut worst[2], [-1e-5, 1e-5].map(|step| (z, p, end * (1.0 + step))));
    }
    println!("bins, lattice, levels: {worst:?}");
    assert!(worst.iter().all(|&jump| jump < 1e-2), "{worst:?}");
}

/// Counts in cells of equal probability of both Gaussian coordinates.
fn cell(ndf: &impl Ndf, m: Vec3) -> usize {
    let [x, y] = ndf.invert(m).to_array().map(|z| (8.0 * gaussian_cdf(f64::from(z))).min(7.0) as usize);
    8 * x + y
}

/// Steps of the rule along each axis.
const STEPS: i16 = 1000;

#[test]
fn samples_of_glints_have_their_density_whose_integral_is_one() {
    let field = GlintField::new(Ggx::new(0.3, 0.5).expect(VALID), 1.0, 0.3, 5).expect(VALID);
    let p = Vec3::new(3.3, 1.2, 0.4);
    for (width, ratio) in [(0.5, 1.0), (4.0, 3.0), (40.0, 1.0)] {
        let pixel = pixel(width, ratio, 0.4);
        // D̂ cos θ dω = D̂/D N(z) dz by the midpoint rule within four standard deviations.
        let row = |i: i16| {
            let mut row = [0.0_f64; 64];
            for k in 0..STEPS {
                let z = Vec2::new(f32::from(2 * i + 1 - STEPS), f32::from(2 * k + 1 - STEPS));
                let z = z * (4.0 / f32::from(STEPS));
                let m = field.ndf().warp_gaussian(z);
                let relative = field.density_over(m, 0.0, p, &pixel) / field.ndf().d(m);
                row[cell(field.ndf(), m)] += f64::from((-0.5 * z.length_squared()).exp() * relative);
            }
            row
        };
        let rows = (0..STEPS).into_par_iter().map(row);
        let expected = rows.reduce(|| [0.0; 64], |a, b| core::array::from_fn(|k| a[k] + b[k]));
        let scale = (8.0 / f64::from(STEPS)).powi(2) / core::f64::consts::TAU;
        let total = expected.iter().sum::<f64>() * scale;
        println!("width {width}, ratio {ratio}: {total}");
        // The midpoint rule over edges of bins.
        assert_abs_diff_eq!(total, 1.0, epsilon = 5e-3, "width {width}, ratio {ratio}");
        let (mut counts, mut random) = ([0.0_f64; 64], Random(6));
        let count = 40_000.0;
        for _ in 0..count as u32 {
            let u = Vec2::new(random.uniform() as f32, random.uniform() as f32);
            let m = field.sample(u, p, &pixel);
            assert!(field.density_over(m, 0.0, p, &pixel) > 0.0, "{m}");
            counts[cell(field.ndf(), m)] += 1.0;
        }
        let chi_squared: f64 = counts
            .iter()
            .zip(expected)
            .map(|(got, expected)| {
                let expected = expected * scale * count;
                // The rule's own error is 0.5 % of a cell.
                let variance = expected + (5e-3 * expected).powi(2) + 1.0;
                (got - expected).powi(2) / variance
            })
            .sum();
        // 64 degrees of freedom: 110 has a probability of 3·10⁻⁴.
        assert!(chi_squared < 110.0, "width {width}, ratio {ratio}: {chi_squared}");
    }
}

#[test]
#[ignore = "slow: weekly"]
fn samples_of_counted_paint_have_their_pdf() {
    let paint = MetallicPaint::new(MetallicPaintParameters {
        flakes: PaintFlakes::Counted { spacing: 1e-3, bin: 1.0 },
        coat_index: 1.0,
        ..Default::default()
    });
    let point = SurfacePoint::new(Vec3::new(0.3, 0.1, 0.2), Vec3::Z, pixel(6e-3, 3.0, 0.4));
    let report = check::material(&paint.expect(VALID), &point, quick(1));
    // Single pixels may be brighter than the surface.
    assert!(report.failures().all(|failed| failed == "energy"), "{report}");
}

/// The light of a sky with a lamp in it, seen in the flakes of a pixel: the same from samples of the
/// flakes as from samples of the smooth NDF, with less noise.
#[test]
fn flakes_mirror_an_environment_with_less_noise_by_their_samples() {
    let field = GlintField::new(Ggx::new(0.4, 0.4).expect(VALID), 1.0, 0.1, 5).expect(VALID);
    let lamp = Vec3::new(0.3, 0.2, 1.0).normalize();
    let sky = |w: Vec3| 0.3 + 0.2 * w.x + if w.dot(lamp) > 0.9 { 4.0 } else { 0.0 };
    let wo = Vec3::new(-0.2, 0.1, 1.0).normalize();
    let mirrored = |m: Vec3| {
        let wi = reflect(wo, m);
        if wi.z > 0.0 { f64::from(sky(wi) * wo.dot(m).max(0.0) / (wo.z * m.z)) } else { 0.0 }
    };
    let mut random = Random(12);
    let (mut deviations, mut surface, mut smooth) = ([0.0; 2], 0.0, 0.0);
    for point in 0..200 {
        let mut u = || random.uniform() as f32;
        let (p, pixel) = (Vec3::new(u(), u(), u()) * 1e4, pixel(4.0, 2.0, 3.0 * u()));
        let mut sums = [[0.0; 2]; 2];
        let count = 256;
        for _ in 0..count {
            let u = Vec2::new(u(), u());
            let (flake, any) = (field.sample(u, p, &pixel), field.ndf().sample(u));
            let weight = f64::from(field.density_over(any, 0.0, p, &pixel) / field.ndf().d(any));
            for (sum, value) in sums.iter_mut().zip([mirrored(flake), weight * mirrored(any)]) {
                *sum = [sum[0] + value / f64::from(count), sum[1] + value * value / f64::from(count)];
            }
            smooth += mirrored(any) / f64::from(count);
        }
        let variances = sums.map(|[mean, square]| square - mean * mean);
        let error = (variances.iter().sum::<f64>() / f64::from(count)).sqrt();
        assert_abs_diff_eq!(sums[0][0], sums[1][0], epsilon = 5.5 * error, "{point}");
        for (deviation, variance) in deviations.iter_mut().zip(variances) {
            *deviation += variance.sqrt() / 200.0;
        }
        surface += sums[0][0];
    }
    println!("deviation by flakes {}, by the NDF {}", deviations[0], deviations[1]);
    assert!(deviations[0] < 0.35 * deviations[1], "{deviations:?}");
    // The mean over the surface is that of the smooth surface: four standard errors.
    assert_abs_diff_eq!(surface / smooth, 1.0, epsilon = 0.06);
}

#[test]
fn glints_accept_every_pixel_and_light() {
    let field = GlintField::new(Ggx::new(0.3, 0.3).expect(VALID), 1e-3, 0.1, 5).expect(VALID);
    let odd = [f32::NAN, f32::NEG_INFINITY, -1.0, 0.0, 1e-30, 0.3, 1e10, 1e30, f32::INFINITY];
    let mut random = Random(2);
    for _ in 0..5000 {
        let mut x = || odd[(random.uniform() * odd.len() as f64) as usize];
        let mut v = || Vec3::new(x(), x(), x());
        let (dx, dy, p) = (v(), v(), v());
        let h = v().normalize_or(half_vector());
        let value = field.density_over(h, x(), p, &PixelEllipse::from_derivatives(dx, dy));
        assert!(value >= 0.0 && value.is_finite(), "{value}: {h} {p} {dx} {dy}");
    }
}
