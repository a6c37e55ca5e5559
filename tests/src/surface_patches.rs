//! Means over patches of a surface in a random field, with standard errors.

use asperity_ndf_sampling::Frame;
use glam::Vec3;
use rayon::prelude::*;

use crate::low_discrepancy::r2;

/// Points on each side of a patch.
const SIDE: u32 = 128;

/// The frame of every patch.
pub const FRAME: Frame = Frame {
    tangent: Vec3::new(0.8, 0.36, -0.48),
    bitangent: Vec3::new(0.0, 0.8, 0.6),
    normal: Vec3::new(0.6, -0.48, 0.64),
};

/// Returns the points of one patch, `128²/stride` of them: one in each stratum of a tilted plane.
///
/// They are at least 1.5 apart, more than a cell of the first octave, so that they are nearly
/// independent.
pub fn points(stride: usize) -> impl Iterator<Item = Vec3> {
    let strata = (0..SIDE).flat_map(move |i| (0..SIDE).step_by(stride).map(move |j| (i, j)));
    strata.map(|(i, j)| {
        let [u, v] = r2(i * SIDE + j);
        let (x, y) = (3.0 * (f64::from(i) + 0.5 * u) as f32, 3.0 * (f64::from(j) + 0.5 * v) as f32);
        x * FRAME.tangent + y * FRAME.bitangent
    })
}

/// Returns, for every seed, the means of `N` quantities over its own patch. `field` creates the
/// field, `add` adds a point's values.
///
/// The patches are measured in parallel. The order of every sum is fixed.
pub fn patch_means<F, const N: usize>(
    seeds: u32,
    stride: usize,
    field: impl Fn(u32) -> F + Sync,
    add: impl Fn(&F, Vec3, &mut [f64; N]) + Sync,
) -> Vec<[f64; N]> {
    let patch = |seed| {
        let field = field(seed);
        let mut sums = [0.0; N];
        let mut count = 0.0;
        for p in points(stride) {
            add(&field, p, &mut sums);
            count += 1.0;
        }
        sums.map(|sum| sum / count)
    };
    (0..seeds).into_par_iter().map(patch).collect()
}

/// Returns the mean of quantity `index` over the patches, and its standard error from their
/// variation.
#[must_use]
pub fn mean_and_error<const N: usize>(patches: &[[f64; N]], index: usize) -> (f64, f64) {
    let n = patches.len() as f64;
    let mean = patches.iter().map(|patch| patch[index]).sum::<f64>() / n;
    let variance = patches.iter().map(|patch| (patch[index] - mean).powi(2)).sum::<f64>() / (n - 1.0);
    (mean, (variance / n).sqrt())
}
