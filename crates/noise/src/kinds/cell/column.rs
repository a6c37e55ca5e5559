//! Columns of a cell: corners at one end of the first two axes, blended along the other axes.

use crate::lanes::Lanes;

/// c + a x + b y.
#[derive(Clone, Copy)]
pub(crate) struct Plane<S: Lanes> {
    pub(crate) value: S::F,
    pub(crate) slopes: [S::F; 2],
}

/// The blend of a cell's corners along all axes but the first two, and its derivatives along the
/// blended axes.
#[derive(Clone, Copy)]
pub(crate) struct Column<S: Lanes, const N: usize> {
    pub(crate) plane: Plane<S>,
    /// Entries for axes 0 and 1 are unused.
    pub(crate) derivatives: [Plane<S>; N],
}

impl<S: Lanes, const N: usize> Column<S, N> {
    #[inline(always)]
    pub(crate) fn empty(s: S) -> Self {
        let zero = s.float(0.0);
        let plane = Plane { value: zero, slopes: [zero; 2] };
        Self { plane, derivatives: [plane; N] }
    }
}
