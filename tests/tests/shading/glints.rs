//! Glints in elongated pixels and under lights of some size.

use asperity_shading::glam::Vec3;
use asperity_shading::material::GlintField;
use asperity_shading::ndf_sampling::Ndf;
use asperity_shading::{Beckmann, Footprint, Ggx, PixelEllipse};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::random::Random;
use rayon::prelude::*;

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

/// Nothing pops: a step of a camera that changes the pixel, the light or the half vector by a
/// millionth changes the density by a small multiple of it.
#[test]
fn glints_do_not_pop() {
    let field = GlintField::new(Ggx::new(0.3, 0.3).expect(VALID), 1.0, 0.1, 5).expect(VALID);
    let mut worst = [0.0_f32; 3];
    let mut random = Random(21);
    for _ in 0..4000 {
        let mut u = || random.uniform() as f32;
        let p = Vec3::new(u(), u(), u()) * 1e4;
        let (width, ratio, spread) = (0.4 * (6.0 * u()).exp(), 1.0 + 15.0 * u(), 0.2 * u());
        let h = Vec3::new(0.4 * u() - 0.2, 0.4 * u() - 0.2, 1.0).normalize();
        let at = |h: Vec3, ratio: f32, spread: f32| {
            // Of a fixed width, so that round pixels stay where they are.
            field.density_over(h, spread, p, &pixel(width, ratio, 0.7))
        };
        let here = at(h, ratio, spread);
        let steps = [
            at(h, ratio * 1.000_01, spread),
            at(h, ratio, spread * 1.000_01),
            at((h + Vec3::new(1e-6, -1e-6, 0.0)).normalize(), ratio, spread),
        ];
        for (worst, next) in worst.iter_mut().zip(steps) {
            *worst = worst.max((next - here).abs() / here.max(field.ndf().d(h)));
        }
    }
    println!("{worst:?}");
    assert!(worst.iter().all(|&change| change < 2e-3), "{worst:?}");
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
