//! Sparse convolution: settings, variance and reach.

use approx::assert_abs_diff_eq;
use asperity_noise::{
    Field, Lattice, Sparse, SparseError,
    glam::{Vec2, Vec3, Vec4},
};

use super::words::{further, uniform};

#[test]
fn only_counts_in_range_are_accepted() {
    for impulses in 1..=4 {
        assert_eq!(Sparse::default().with_impulses(impulses).unwrap().impulses(), impulses);
    }
    for impulses in [0, 5, 256, 257, u32::MAX] {
        assert_eq!(
            Sparse::default().with_impulses(impulses),
            Err(SparseError::ImpulsesOutOfRange { impulses })
        );
    }
}

#[test]
fn the_variance_is_one_at_every_place_of_the_cell() {
    for impulses in [1, 3] {
        let noise = Sparse::default().with_impulses(impulses).unwrap();
        let square = |f: &dyn Fn(u32) -> f32| (0..4000).map(|seed| f(seed) * f(seed)).sum::<f32>() / 4000.0;
        let squares = [
            square(&|seed| noise.with_seed(seed).value(0.0)),
            square(&|seed| noise.with_seed(seed).value(Vec2::ZERO)),
            square(&|seed| noise.with_seed(seed).value(Vec2::splat(0.5))),
            square(&|seed| noise.with_seed(seed).value(Vec3::new(0.0, 0.5, 0.0))),
            square(&|seed| noise.with_seed(seed).value(Vec4::new(0.9, 0.5, 0.0, 0.3))),
        ];
        // The kurtosis is at most 6: 4.5 standard errors of the mean square.
        let tolerance = 4.5 * (5.0_f32 / 4000.0).sqrt();
        for square in squares {
            assert_abs_diff_eq!(square, 1.0, epsilon = tolerance);
        }
    }
}

/// A lattice whose impulses all lie next to the origin, with the greatest weight.
struct Heap;

impl Lattice for Heap {
    fn word<const N: usize>(&self, cell: [i32; N], _: u32) -> u32 {
        if cell[0] < 0 { 0xffff_0000 } else { 0 }
    }
}

#[test]
fn a_kernel_reaches_as_far_as_its_radius() {
    // One impulse lies at −2⁻¹⁷, one at 2⁻¹⁷, and so on at ±1.
    let noise = Sparse::new(0).with_impulses(1).unwrap().with_lattice(Heap);
    let (here, there) = (noise.value(0.0), noise.value(1.0));
    // √(3/∫h²) on the line.
    let weight = |word: u32| uniform(further(word, 1)) * 2.097_361_6;
    assert_abs_diff_eq!(here, (weight(0xffff_0000) + weight(0)), epsilon = 1e-4);
    assert_abs_diff_eq!(there, weight(0), epsilon = 1e-4);
}
