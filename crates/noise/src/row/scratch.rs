//! The memory that rows of a grid share, so that it is cleared once and not for every row.

use crate::{kinds::cell::rows::Stretch, row::cells::POINTS};

/// Points of a row whose octaves are summed at once.
pub(crate) const STRETCH: usize = POINTS;

/// What a batch keeps from row to row.
#[derive(Clone)]
pub struct Scratch<const N: usize> {
    pub(crate) columns: Stretch<N>,
    pub(crate) octave: [f32; STRETCH],
    pub(crate) slopes: [[f32; STRETCH]; N],
}

impl<const N: usize> Scratch<N> {
    /// Not a constant, because a constant would be copied, which takes longer than zeros.
    #[inline(always)]
    pub(crate) fn empty() -> Self {
        Self { columns: Stretch::empty(), octave: [0.0; STRETCH], slopes: [[0.0; STRETCH]; N] }
    }
}
