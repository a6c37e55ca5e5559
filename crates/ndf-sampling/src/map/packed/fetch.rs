//! Gathers from the parts of a packed map, one for each lane.

use crate::map::packed::packed_map::PackedMapRef;
use crate::map::packed::record::{LEAF, Rows};
use crate::simd::gather::Gather;

/// A function of a map and a pair of numbers, in lanes; `SIDES` tells how many columns of values a cell lies between.
pub(crate) trait PairKernel<const OUT: usize> {
    fn apply<P: Gather<N>, const N: usize, const SIDES: usize>(
        map: &PackedMapRef<'_>,
        p: P,
        pair: [P::F; 2],
    ) -> [P::F; OUT];
}

impl PackedMapRef<'_> {
    /// The column of a bin, and how far a place in the bin is from the column's left side.
    #[inline(always)]
    pub(crate) fn column<P: Gather<N>, const N: usize>(&self, p: P, bin: P::F, within: P::F) -> (P::U, P::F) {
        let per = p.float(self.grid.per_split);
        let (column, word) = p.below((bin + p.float(0.5)) * per);
        (word, ((bin - column * p.float(self.grid.split)) + within) * per)
    }

    /// Cubics by their numbers.
    #[inline(always)]
    pub(crate) fn cubics<const N: usize>(&self, at: &[u32; N]) -> [&Rows; N] {
        let mut cubics = [&[[0.0; 4]; 4]; N];
        for k in 0..N {
            if let Some(cubic) = self.cubics.get(at[k] as usize) {
                cubics[k] = cubic;
            }
        }
        cubics
    }

    /// The integral and the value where rows begin, and where they end, `t` of the way from the left to the right side.
    #[inline(always)]
    pub(crate) fn nodes<P: Gather<N>, const N: usize, const SIDES: usize>(
        &self,
        p: P,
        column: P::U,
        row: P::U,
        t: P::F,
    ) -> [P::F; 4] {
        let stride = self.grid.stride;
        let at = p.words(column * p.word(stride) + (row + row));
        let (mut left, mut right) = ([&[0.0; 4]; N], [&[0.0; 4]; N]);
        for k in 0..N {
            (left[k], right[k]) = sides::<4, SIDES>(self.nodes, at[k], stride);
        }
        if SIDES == 1 { p.transposed(&left) } else { p.blended([&left, &right], [p.float(1.0) - t, t]) }
    }
}

/// Four numbers of leaves.
#[inline(always)]
pub(crate) fn quads<P: Gather<N>, const N: usize>(
    p: P,
    leaves: &[&[f32; LEAF]; N],
    quad: usize,
) -> [P::F; 4] {
    let mut rows = [&[0.0; 4]; N];
    for k in 0..N {
        if let Some(row) = leaves[k].as_chunks().0.get(quad) {
            rows[k] = row;
        }
    }
    p.transposed(&rows)
}

/// The polynomials of cubics at the places `s`.
#[inline(always)]
pub(crate) fn mixed<P: Gather<N>, const N: usize>(p: P, cubics: &[&Rows; N], s: P::F) -> [P::F; 4] {
    let r = p.float(1.0) - s;
    let (r2, s2) = (r * r, s * s);
    p.mixed(cubics, &[p.floats(r2 * r), p.floats(r2 * s), p.floats(r * s2), p.floats(s2 * s)])
}

/// `LEN` numbers from `at` on, and those `stride` further if there are two sides; zeros where the array is not as long.
#[inline(always)]
pub(crate) fn sides<const LEN: usize, const SIDES: usize>(
    array: &[f32],
    at: u32,
    stride: u32,
) -> (&[f32; LEN], &[f32; LEN]) {
    // Indices of 32 bits, whose sums do not overflow: so that there is one comparison for all.
    let (at, stride) = (at as usize, if SIDES == 2 { stride as usize } else { 0 });
    let from = array.get(at..at + stride + LEN);
    match from.and_then(|from| Some((from.first_chunk()?, from.last_chunk()?))) {
        Some(sides) => sides,
        None => (&[0.0; LEN], &[0.0; LEN]),
    }
}
