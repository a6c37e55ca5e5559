//! Rows of points at equal steps along the first axis, in the coordinates of a field or of an
//! octave.

use core::ops::Range;

use crate::{
    lanes::{LaneSample, Lanes, Scalar},
    lattice::lattice::is_within,
};

/// Points at equal steps along the first axis: xᵢ = frequency·(x₀ + step·i) + offset.
///
/// Every operation is rounded, as for points computed one by one. Frequency 1 and offset 0 change
/// no bit.
#[derive(Clone, Copy, Debug)]
pub struct Row<const N: usize> {
    /// x₀, and the other coordinates, which are equal for all points.
    origin: [f32; N],
    step: f32,
    /// The index of the first point.
    start: usize,
    frequency: f32,
    offset: f32,
}

impl<const N: usize> Row<N> {
    #[inline(always)]
    pub(crate) fn new(origin: [f32; N], step: f32, start: usize) -> Self {
        // −0 + 0 = 0, so that no point's first coordinate is −0.
        Self { origin: origin.map(|x| x + 0.0), step, start, frequency: 1.0, offset: 0.0 }
    }

    /// The row in the coordinates of an octave; the offset must not be −0.
    #[inline(always)]
    pub(crate) fn scaled(&self, frequency: [f32; N], offset: [f32; N]) -> Self {
        let mut origin = self.origin;
        for axis in 1..N {
            origin[axis] = frequency[axis] * self.origin[axis] + offset[axis];
        }
        Self { origin, frequency: frequency[0], offset: offset[0], ..*self }
    }

    /// The row from point `start` on.
    #[inline(always)]
    pub(crate) fn after(&self, start: usize) -> Self {
        Self { start: self.start + start, ..*self }
    }

    /// Everything that the first coordinates depend on.
    #[inline(always)]
    pub(crate) fn key(&self) -> RowKey {
        let x = [self.origin[0], self.step, self.frequency, self.offset];
        RowKey { x: x.map(f32::to_bits), start: self.start }
    }

    /// The coordinates of point i.
    #[inline(always)]
    pub(crate) fn point(&self, i: usize) -> [f32; N] {
        let mut p = self.origin;
        p[0] = self.x(i);
        p
    }

    /// The first coordinate of point i.
    #[inline(always)]
    pub(crate) fn x(&self, i: usize) -> f32 {
        let x = self.origin[0] + self.step * ((self.start + i) as i32 as f32);
        self.frequency * x + self.offset
    }

    /// The first coordinates of one point per lane, from point i on.
    #[inline(always)]
    pub(crate) fn xs<S: Lanes>(&self, s: S, i: usize) -> S::F {
        let index = s.word((self.start + i) as u32) + s.iota();
        let x = s.float(self.origin[0]) + s.float(self.step) * s.real(index);
        s.float(self.frequency) * x + s.float(self.offset)
    }

    /// The coordinates of the first point; in a scaled row the first coordinate is unspecified.
    #[inline(always)]
    pub(crate) fn origin(&self) -> [f32; N] {
        self.origin
    }

    /// The distance from point to point, up to rounding.
    #[inline(always)]
    pub(crate) fn stride(&self) -> f32 {
        self.frequency * self.step
    }

    /// Whether all of `count` points are within reach.
    #[inline(always)]
    pub(crate) fn is_within(&self, reach: f32, count: usize) -> bool {
        [0, count].into_iter().all(|i| is_within(Scalar, &self.point(i), reach))
    }
}

/// Everything that the first coordinates of a row depend on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct RowKey {
    x: [u32; 4],
    start: usize,
}

/// Writes the lanes for the points from `i` to `count`.
#[inline(always)]
pub(crate) fn put<S: Lanes>(s: S, x: S::F, out: &mut [f32], i: usize, count: usize) {
    if let Some(out) = out.get_mut(i..i + S::LEN) {
        s.store(x, out);
    } else if let Some(out) = out.get_mut(i..count) {
        s.store(x, out);
    }
}

/// Empty slices, to be replaced. Not inlined, because arrays of references take long to compile
/// wherever they are created.
#[inline(never)]
pub(crate) fn no_slices<'a, T, const N: usize>() -> [&'a mut [T]; N] {
    core::array::from_fn(|_| <&mut [T]>::default())
}

/// A row of points in the coordinates of a noise with a seed, with space for values, and for
/// gradients if `GRADIENTS`.
#[derive(Debug)]
pub struct Strip<'a, const N: usize, const GRADIENTS: bool> {
    pub(crate) row: Row<N>,
    pub(crate) seed: u32,
    pub(crate) values: &'a mut [f32],
    /// One slice per axis, as long as `values`; empty unless `GRADIENTS`.
    pub(crate) gradients: [&'a mut [f32]; N],
}

impl<const N: usize, const GRADIENTS: bool> Strip<'_, N, GRADIENTS> {
    /// The points of a range.
    #[inline(always)]
    pub(crate) fn part(&mut self, range: Range<usize>) -> Strip<'_, N, GRADIENTS> {
        let mut gradients = no_slices();
        if GRADIENTS {
            for (part, g) in gradients.iter_mut().zip(&mut self.gradients) {
                *part = g.get_mut(range.clone()).unwrap_or_default();
            }
        }
        let (row, seed) = (self.row.after(range.start), self.seed);
        Strip { row, seed, values: self.values.get_mut(range).unwrap_or_default(), gradients }
    }

    /// Writes values and gradients in lanes for the points from `i` on.
    #[inline(always)]
    pub(crate) fn put<S: Lanes>(&mut self, s: S, (value, gradient): LaneSample<S, N>, i: usize) {
        let count = self.values.len();
        put(s, value, self.values, i, count);
        if GRADIENTS {
            for axis in 0..N {
                put(s, gradient[axis], self.gradients[axis], i, count);
            }
        }
    }
}
