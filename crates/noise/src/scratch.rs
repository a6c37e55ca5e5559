//! The memory that rows of a grid share, so that it is cleared once and not for every row.

use crate::columns::{POINTS, Stretch};

/// Points of a row whose octaves are summed at once.
pub(crate) const STRETCH: usize = POINTS;

/// What a batch keeps from row to row.
#[derive(Clone, Debug)]
pub struct Scratch<const N: usize> {
    pub(crate) columns: Stretch<N>,
    pub(crate) octave: [f32; STRETCH],
    pub(crate) slopes: [[f32; STRETCH]; N],
}

impl<const N: usize> Scratch<N> {
    pub(crate) const EMPTY: Self =
        Self { columns: Stretch::EMPTY, octave: [0.0; STRETCH], slopes: [[0.0; STRETCH]; N] };
}
