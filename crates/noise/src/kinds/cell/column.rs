//! Columns of a cell: its corners at one end of the first two axes, blended along the others.

use crate::lanes::lanes::Lanes;

/// c + a x + b y.
#[derive(Clone, Copy)]
pub(crate) struct Plane<S: Lanes> {
    pub(crate) value: S::F,
    pub(crate) slopes: [S::F; 2],
}

/// The blend of a cell's corners along all axes but the first two, and its derivatives along those it was blended along.
#[derive(Clone, Copy)]
pub(crate) struct Column<S: Lanes, const N: usize> {
    pub(crate) plane: Plane<S>,
    /// Those along the first two axes are of no meaning.
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

impl<S: Lanes> Plane<S> {
    #[inline(always)]
    fn turned<const K: usize>(&self, s: S) -> Self {
        let [a, b] = self.slopes;
        Self { value: s.turned::<K>(self.value), slopes: [s.turned::<K>(a), s.turned::<K>(b)] }
    }
}

impl<S: Lanes, const N: usize> Column<S, N> {
    /// The columns of the lanes from lane K on.
    #[inline(always)]
    pub(crate) fn turned<const K: usize>(&self, s: S) -> Self {
        let mut column = Self { plane: self.plane.turned::<K>(s), derivatives: self.derivatives };
        for axis in 2..N {
            column.derivatives[axis] = self.derivatives[axis].turned::<K>(s);
        }
        column
    }
}
