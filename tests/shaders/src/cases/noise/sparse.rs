//! Sparse convolution noise with one to four impulses.

use asperity_noise::SparseConvolution;
use asperity_wgsl::noise;

use super::{body, case, number, outputs_of, seed};
use crate::case::{Bound, Case};

const BOUNDS: [Bound; 2] = [Bound::Absolute(4e-6), Bound::Absolute(1e-5)];

pub(super) fn cases() -> Vec<Case> {
    // 0 is treated as 1, 5 as 4.
    let count = "u32(b.x * 6.0), ";
    vec![case(&noise::SPARSE_CONVOLUTION, body("sparse_convolution", count, false), BOUNDS, |words| {
        let sparse = SparseConvolution::new(seed(words));
        let impulses = ((number(words, 4) * 6.0) as u32).clamp(1, SparseConvolution::MAX_IMPULSES);
        outputs_of(&sparse.with_impulses(impulses).unwrap_or(sparse), words)
    })]
}
