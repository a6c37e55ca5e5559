//! Sparse convolution: settings, variance and reach.

use approx::assert_abs_diff_eq;
use asperity_noise::{
    Field, Lattice, NoiseError, SparseConvolution,
    glam::{Vec2, Vec3, Vec4},
};

use super::words::{further, uniform};

#[test]
fn sparse_rejects_invalid_impulses() {
    for impulses in 1..=4 {
        assert_eq!(SparseConvolution::default().with_impulses(impulses).unwrap().impulses(), impulses);
    }
    for impulses in [0, 5, 256, 257, u32::MAX] {
        assert_eq!(
            SparseConvolution::default().with_impulses(impulses),
            Err(NoiseError::Count { parameter: "impulses", value: impulses, min: 1, max: 4 })
        );
    }
}

#[test]
fn sparse_variance_is_1_everywhere_in_a_cell() {
    for impulses in [1, 3] {
        let noise = SparseConvolution::default().with_impulses(impulses).unwrap();
        let square = |f: &dyn Fn(u32) -> f32| (0..4000).map(|seed| f(seed) * f(seed)).sum::<f32>() / 4000.0;
        let squares = [
            square(&|seed| noise.with_seed(seed).value(0.0)),
            square(&|seed| noise.with_seed(seed).value(Vec2::ZERO)),
            square(&|seed| noise.with_seed(seed).value(Vec2::splat(0.5))),
            square(&|seed| noise.with_seed(seed).value(Vec3::new(0.0, 0.5, 0.0))),
            square(&|seed| noise.with_seed(seed).value(Vec4::new(0.9, 0.5, 0.0, 0.3))),
        ];
        // The kurtosis is at most 6, so this is 4.5 standard errors of the mean square.
        let tolerance = 4.5 * (5.0_f32 / 4000.0).sqrt();
        for square in squares {
            assert_abs_diff_eq!(square, 1.0, epsilon = tolerance);
        }
    }
}

/// A lattice whose impulses are all next to the origin, with the largest weight.
struct Heap;

impl Lattice for Heap {
    fn word<const N: usize>(&self, cell: [i32; N], _: u32) -> u32 {
        if cell[0] < 0 { 0xffff_0000 } else { 0 }
    }
}

#[test]
fn sparse_kernel_reaches_its_radius() {
    // One impulse lies at −2⁻¹⁷, one at 2⁻¹⁷, and so on at ±1.
    let noise = SparseConvolution::new(0).with_impulses(1).unwrap().with_lattice(Heap);
    let (here, there) = (noise.value(0.0), noise.value(1.0));
    // √(3/∫h²) in 1-D.
    let weight = |word: u32| uniform(further(word, 1)) * 2.097_361_6;
    assert_abs_diff_eq!(here, (weight(0xffff_0000) + weight(0)), epsilon = 1e-4);
    assert_abs_diff_eq!(there, weight(0), epsilon = 1e-4);
}
