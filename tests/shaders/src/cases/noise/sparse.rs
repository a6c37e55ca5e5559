//! Sparse convolution noise with one to four impulses.

use asperity_noise::Sparse;
use asperity_shaders::noise;

use super::{body, case, number, outputs_of, seed};
use crate::case::{Bound, Case};

const BOUNDS: [Bound; 2] = [Bound::Absolute(4e-6), Bound::Absolute(1e-5)];

pub(super) fn cases() -> Vec<Case> {
    // 0 is treated as 1, 5 as 4.
    let count = "u32(b.x * 6.0), ";
    vec![case(&noise::SPARSE, body("sparse", count, false), BOUNDS, |words| {
        let sparse = Sparse::new(seed(words));
        let impulses = ((number(words, 4) * 6.0) as u32).clamp(1, Sparse::MAX_IMPULSES);
        outputs_of(&sparse.with_impulses(impulses).unwrap_or(sparse), words)
    })]
}
