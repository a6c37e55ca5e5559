//! The tails of Gaussian noise: of its variates, word by word, and at every position of the cell.

use std::f64::consts::{PI, SQRT_2};

use asperity_noise::{Field, GaussianNoise, glam::Vec2};
use asperity_tests::assert_abs_diff_eq;
use rayon::prelude::*;
use statrs::function::erf::erfc;

/// P(z > x) under N(0, 1).
fn upper(x: f64) -> f64 {
    0.5 * erfc(x / SQRT_2)
}

#[test]
fn variates_have_the_normal_tail_to_5_5_deviations() {
    // All words with |s| > 3.2. The values of others are between the inner levels.
    let (first, count) = (0_u32.wrapping_sub(5 << 20), 10_u32 << 20);
    let values: Vec<f32> = (0..count)
        .into_par_iter()
        .map(|i| GaussianNoise::variates::<1>(first.wrapping_add(i))[0].0.abs())
        .collect();
    for x in [3.2, 3.5, 4.0, 4.5, 5.0, 5.5_f32] {
        let beyond = values.par_iter().filter(|&&value| value > x).count() as f64;
        let ratio = beyond / 4_294_967_296.0 / (2.0 * upper(f64::from(x)));
        // 163 words are beyond 5.5. Maximum seen below 5.5: 7e-4, at 5.
        let tolerance = if x < 5.5 { 2e-3 } else { 8e-3 };
        assert_abs_diff_eq!(ratio, 1.0, epsilon = tolerance, "beyond {x}");
    }
    let largest = values.iter().fold(0.0_f32, |largest, &value| largest.max(value));
    assert!(largest > 6.22 && largest < 6.24, "{largest}");
}

#[test]
fn lattice_points_have_the_normal_tail() {
    // 8.4 million seeds, of which 530 and 57 are beyond 4 and 4.5.
    let beyond: [u64; 2] = (0..1 << 23_u32)
        .into_par_iter()
        .map(|seed| {
            let value = GaussianNoise::new(seed).value(3.0_f32).abs();
            [4.0, 4.5].map(|x| u64::from(value > x))
        })
        .reduce(|| [0; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
    for (x, beyond) in [4.0, 4.5].into_iter().zip(beyond) {
        let expected = 2.0 * upper(x) * f64::from(1 << 23_u32);
        // Four standard errors. Two levels over √2 gave 0.967 and 0.88 of them.
        assert_abs_diff_eq!(beyond as f64, expected, epsilon = 4.0 * expected.sqrt(), "beyond {x}");
    }
}

/// Returns the weights of values and gradients at a position of a cell in N dimensions, divided by
/// their norm.
fn weights<const N: usize>(place: [f64; N]) -> (Vec<f64>, Vec<f64>) {
    let (mut values, mut slopes) = (Vec::new(), Vec::new());
    for corner in 0..1_usize << N {
        let d: [f64; N] = std::array::from_fn(|axis| (place[axis] - (corner >> axis & 1) as f64).abs());
        let weight: f64 =
            d.iter().map(|d| 1.0 - d).map(|t| t.powi(3) * (t * (6.0 * t - 15.0) + 10.0)).product();
        values.push(weight);
        slopes.extend(d.map(|d| 2.0 * weight * d));
    }
    let norm = values.iter().chain(&slopes).map(|w| w * w).sum::<f64>().sqrt();
    values.iter_mut().chain(&mut slopes).for_each(|w| *w /= norm);
    (values, slopes)
}

/// P(Σ wᵢ sᵢ + Σ vᵢ gᵢ > x), s normal and g the levels: ∫ M(z) e^(−zx)/z dz/(2πi) along the line Re
/// z = x, M = E e^(z Σ).
fn beyond(levels: &[f64], (values, slopes): &(Vec<f64>, Vec<f64>), x: f64) -> f64 {
    const STEP: f64 = 0.125;
    let times = |[a, b]: [f64; 2], [c, d]: [f64; 2]| [a * c - b * d, a * d + b * c];
    let mean = |[a, b]: [f64; 2]| {
        let sum = levels.iter().fold([0.0; 2], |[re, im], g| {
            [re + (a * g).cosh() * (b * g).cos(), im + (a * g).sinh() * (b * g).sin()]
        });
        sum.map(|x| x / levels.len() as f64)
    };
    let integral: f64 = (-64..=64)
        .into_par_iter()
        .map(|k| {
            let t = f64::from(k) * STEP;
            let half = 0.5 * values.iter().map(|w| w * w).sum::<f64>();
            // e^(z² half − z x), and 1/z.
            let (size, angle) = (((x * x - t * t) * half - x * x).exp(), 2.0 * x * t * half - t * x);
            let first = [size * angle.cos(), size * angle.sin()];
            let product =
                slopes.iter().filter(|v| **v > 1e-6).map(|v| mean([x * v, t * v])).fold(first, times);
            times(product, [x / (x * x + t * t), -t / (x * x + t * t)])[0]
        })
        .sum();
    integral * STEP / (2.0 * PI)
}

#[test]
fn every_cell_position_has_the_normal_tail() {
    // The positive levels of a gradient component. The upper bits of its word come from a product
    // with an odd number.
    let mut levels: Vec<f64> = (0..1_u32 << 18)
        .map(|i| f64::from(GaussianNoise::variates::<1>(i.wrapping_mul(0x4001_3a67))[0].1[0]))
        .filter(|g| *g > 0.0)
        .collect();
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    assert_eq!(levels.len(), 2048);
    let normal = weights([0.0]);
    assert_abs_diff_eq!(beyond(&levels, &normal, 5.0) / upper(5.0), 1.0, epsilon = 1e-6);
    let places = [
        weights([0.2]),
        weights([0.35]),
        weights([0.5]),
        weights([0.35, 0.35]),
        weights([0.5, 0.5]),
        weights([0.3, 0.3, 0.3]),
    ];
    for place in places {
        // Extremes seen: 0.9966 and 0.9695, both in the middle of a cell's edge.
        for (x, least) in [(4.0, 0.996), (5.0, 0.969)] {
            let ratio = beyond(&levels, &place, x) / upper(x);
            assert!(ratio > least && ratio < 1.001, "beyond {x} with {place:?}: {ratio}");
        }
    }
}

#[test]
fn planes_have_the_normal_tail() {
    // 8.4 million points, mostly in different cells; 531 of them are beyond 4.
    let beyond: usize = (0..2048_u32)
        .into_par_iter()
        .map(|seed| {
            let points: Vec<Vec2> = (0..4096_u16)
                .map(|i| Vec2::new(f32::from(i) * 1.618, f32::from(i) * 0.4142 - 800.0))
                .collect();
            let mut values = vec![0.0; points.len()];
            GaussianNoise::new(seed).values(&points, &mut values).expect("one number per point");
            values.iter().filter(|value| value.abs() > 4.0).count()
        })
        .sum();
    let expected = 2.0 * upper(4.0) * f64::from(1 << 23_u32);
    // Four standard errors. Because neighbors share cells, they are 1.5 times the errors of
    // independent points.
    assert_abs_diff_eq!(beyond as f64, expected, epsilon = 6.0 * expected.sqrt());
}
