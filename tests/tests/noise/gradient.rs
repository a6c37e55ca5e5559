//! Values and analytic gradients against a plain `f64` evaluation and its central differences;
//! ranges.

use asperity_noise::{
    Field, GaussianNoise, IntegerHash, Perlin, PerlinClassic, Simplex, SparseConvolution, ValueCatmullRom,
    ValueGradient, ValueNoise, WhiteNoise,
    glam::{Vec2, Vec3, Vec4},
};
use asperity_tests::{
    assert_abs_diff_eq, in_every_dimension,
    noise_any::{AnyNoise, dimensions},
    noise_errors::{errors, errors_on},
    noise_kinds::AnyKind,
    noise_reference::Kind,
};

/// The divisor of ±4096: ±64, and ±4 for simplex noise, whose corners are rounded by |p|·2⁻²².
const NEAR: f32 = 64.0;
const NEAREST: f32 = 1024.0;
const FAR: f32 = 1.0;

/// Asserts the errors of a noise in every dimension.
fn close<K: AnyKind>(name: &str, noise: K, kind: Kind, divisor: f32, tolerances: [[f64; 2]; 4]) {
    fn close<const N: usize>(
        name: &str,
        noise: &dyn AnyNoise<N>,
        (kind, divisor, tolerances): (Kind, f32, [[f64; 2]; 4]),
    ) {
        let words = |cell: [i32; N], seed| kind.word(&IntegerHash, cell, seed);
        let [v, g] = errors_on(&words, kind, divisor, &|p, seed| noise.sample(p, seed));
        let [value, gradient] = tolerances[N - 1];
        assert!(v < value && g < gradient, "{name}: {v:e}, {g:e}");
    }
    in_every_dimension!(dimensions(name, noise), close, (kind, divisor, tolerances));
}

/// [`close`] for a noise that is scaled to its range.
///
/// A noise that equals the reference with the scale derived here has the tight bound |n| ≤ 1.
/// Scales have seven digits; maximum seen 2.1e-7.
fn tight<K: AnyKind>(name: &str, noise: K, kind: Kind, divisor: f32, tolerances: [[f64; 2]; 4]) {
    let bounds = [largest::<1>(kind), largest::<2>(kind), largest::<3>(kind), largest::<4>(kind)];
    for (bound, scale) in bounds.into_iter().zip(kind.scales()) {
        assert_abs_diff_eq!(scale * bound, 1.0 - 2e-6, epsilon = 4e-7, "{name}");
    }
    close(name, noise, kind, divisor, tolerances);
}

/// Returns the maximum value of a noise, by local search from the best grid points.
fn largest<const D: usize>(kind: Kind) -> f64 {
    let steps: usize = [2000, 160, 36, 14][D - 1];
    // The grid covers every shape of simplex, which extend beyond the unit cube by a third.
    let coordinate = |index: usize, k: u32| (index / steps.pow(k) % steps) as f64 * 1.5 / steps as f64 - 0.4;
    let mut grid: Vec<(f64, [f64; D])> = (0..steps.pow(D as u32))
        .map(|index| std::array::from_fn(|k| coordinate(index, k as u32)))
        .map(|p| (kind.largest(p), p))
        .collect();
    grid.sort_by(|a, b| b.0.total_cmp(&a.0));
    let climb = |(mut value, mut p): (f64, [f64; D])| {
        let mut step = 1.5 / steps as f64;
        while step > 1e-8 {
            let mut moved = false;
            for direction in 0..3_usize.pow(D as u32) {
                let q: [f64; D] = std::array::from_fn(|k| {
                    p[k] + step * ((direction / 3_usize.pow(k as u32) % 3) as f64 - 1.0)
                });
                let there = kind.largest(q);
                if there > value + 1e-12 {
                    (value, p, moved) = (there, q, true);
                }
            }
            if !moved {
                step *= 0.5;
            }
        }
        value
    };
    grid.into_iter().take(24).map(climb).fold(0.0, f64::max)
}

// Tolerances of value and gradient are about twice the maximum errors seen, noted next to each.
// They are roundings of sums of 2ⁿ products: half a unit of 2⁻²³ for each of about ten operations
// on numbers up to the noise's range, and on slopes of at most 4, or 20 for Gaussian noise.

#[test]
fn gradient_noises_match_the_reference() {
    let kind = Kind::PerlinClassic;
    // 2.0e-7, 3.6e-7, 1.8e-7, 1.5e-7; 5.6e-7, 5.9e-7, 4.9e-7, 3.8e-7.
    let tolerances = [[5e-7, 1.2e-6], [6e-7, 1.4e-6], [5e-7, 1.2e-6], [4e-7, 1e-6]];
    tight("Perlin 1985", PerlinClassic::default(), kind, NEAR, tolerances);
    let kind = Kind::Perlin;
    // 9.0e-7, 9.5e-7, 7.7e-7, 6.6e-7; 1.7e-6, 2.1e-6, 3.1e-6, 1.4e-6.
    let tolerances = [[2e-6, 4e-6], [2e-6, 5e-6], [2e-6, 6e-6], [1.2e-6, 4e-6]];
    tight("Perlin 2002", Perlin::default(), kind, NEAR, tolerances);
}

#[test]
fn value_noises_match_the_reference() {
    // One number per cell, which is not rounded.
    close("white", WhiteNoise::default(), Kind::White, NEAR, [[1e-30; 2]; 4]);
    let kind = Kind::Value;
    // 6.0e-7, 8.1e-7, 1.0e-6, 7.5e-7; 5.0e-7, 2.0e-6, 1.9e-6, 2.5e-6.
    let tolerances = [[1.2e-6, 1e-6], [2e-6, 4e-6], [2e-6, 5e-6], [2e-6, 5e-6]];
    tight("value", ValueNoise::default(), kind, NEAR, tolerances);
    let kind = Kind::CatmullRom;
    // 2.9e-7, 2.1e-7, 2.1e-7, 1.3e-7; 6.3e-7, 5.3e-7, 4.8e-7, 2.9e-7.
    let tolerances = [[6e-7, 1.2e-6], [5e-7, 1.2e-6], [5e-7, 1e-6], [3e-7, 6e-7]];
    tight("value, Catmull-Rom", ValueCatmullRom::default(), kind, NEAR, tolerances);
    for weight in [0.0, 0.5, 0.8125, 1.0] {
        let (noise, kind) =
            (ValueGradient::default().with_weight(weight).unwrap(), Kind::ValueGradient(weight.into()));
        // 9.4e-7, 8.9e-7, 1.1e-6, 7.9e-7; 2.0e-6, 2.4e-6, 2.6e-6, 2.7e-6.
        let tolerances = [[2e-6, 4e-6], [2e-6, 5e-6], [2e-6, 5e-6], [2e-6, 5e-6]];
        tight(&format!("value-gradient {weight}"), noise, kind, NEAR, tolerances);
    }
}

#[test]
fn sparse_noises_match_the_reference() {
    for impulses in 1..=SparseConvolution::MAX_IMPULSES {
        let noise = SparseConvolution::default().with_impulses(impulses).unwrap();
        // 5.3e-7, 6.7e-7, 6.5e-7, 1.0e-6; 1.1e-6, 2.6e-6, 1.8e-6, 2.1e-6.
        let tolerances = [[1.2e-6, 2.5e-6], [1.5e-6, 5e-6], [1.5e-6, 4e-6], [2e-6, 5e-6]];
        close(&format!("sparse {impulses}"), noise, Kind::Sparse(impulses), NEAR, tolerances);
    }
}

#[test]
fn simplex_noises_match_the_reference() {
    // Corners are rounded by up to 8·2⁻²² = 2e-6 there, and second derivatives reach 30. Maximum
    // seen 1.8e-6 and 1.3e-5.
    let tolerances = [[4e-6, 3e-5]; 4];
    let kind = Kind::Simplex(0.5);
    tight("simplex", Simplex::new(0), kind, NEAREST, tolerances);
    let kind = Kind::Simplex(f64::from(0.6_f32));
    tight("wide simplex", Simplex::new(0).with_classic_radius(), kind, NEAREST, tolerances);
}

#[test]
fn gaussian_channels_match_the_reference() {
    // 2.1e-6, 3.8e-6, 2.1e-6, 2.8e-6; 2.3e-6, 8.9e-6, 7.4e-6, 8.1e-6.
    let tolerances = [[5e-6, 6e-6], [8e-6, 2e-5], [6e-6, 2e-5], [6e-6, 2e-5]];
    close("Gaussian", GaussianNoise::default(), Kind::Gaussian(0), NEAR, tolerances);
    let (noise, second) = (GaussianNoise::default(), Kind::Gaussian(1));
    for worst in [
        errors::<f32, 1>(second, NEAR, |p, seed| noise.with_seed(seed).pair(p)[1]),
        errors::<Vec2, 2>(second, NEAR, |p, seed| noise.with_seed(seed).pair(p)[1]),
        errors::<Vec3, 3>(second, NEAR, |p, seed| noise.with_seed(seed).pair(p)[1]),
        errors::<Vec4, 4>(second, NEAR, |p, seed| noise.with_seed(seed).pair(p)[1]),
    ] {
        assert!(worst[0] < 6e-6 && worst[1] < 2e-5, "second channel: {worst:?}");
    }
}

#[test]
fn noises_far_from_the_origin_match_the_reference() {
    let (gaussian, simplex) = (Kind::Gaussian(0), Kind::Simplex(0.5));
    let worst = errors::<Vec3, 3>(gaussian, FAR, |p, seed| GaussianNoise::new(seed).sample(p));
    assert!(worst[0] < 6e-6 && worst[1] < 2e-5, "Gaussian: {worst:?}");
    // Corners are rounded by up to 7100·2⁻²² = 0.0017 there, where slopes reach 4 and second
    // derivatives 30.
    let worst = errors::<Vec3, 3>(simplex, FAR, |p, seed| Simplex::new(seed).sample(p));
    assert!(worst[0] < 0.007 && worst[1] < 0.05, "simplex: {worst:?}");
}
