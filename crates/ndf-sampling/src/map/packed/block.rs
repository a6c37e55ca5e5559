//! Staged evaluation of packed maps: each stage processes a block of numbers before the next one
//! begins.
//!
//! Positions are computed in SIMD lanes. Then the records there are copied one by one and
//! transposed into lanes. No load waits for a recent store, and loads overlap.

use crate::map::packed::leaf::Leaf;
use crate::map::packed::packed_map::PackedMapRef;
use asperity_core::lanes::Lanes;

/// A function of a map and pairs of numbers; `SIDES` is the number of value columns at the sides of
/// a cell.
pub(crate) trait Staged<const OUT: usize> {
    type Group<const L: usize>: Work<L>;
    /// Up to this many pairs are faster one by one.
    const FEW: usize;

    fn apply<P: Lanes, const L: usize, const SIDES: usize>(
        map: &PackedMapRef<'_>,
        p: P,
        groups: &mut [Self::Group<L>],
    );
}

/// Numbers of `L` lanes between stages, where `L` is a multiple of the register width.
///
/// They are zero at first; fewer numbers are cleared faster.
pub(crate) trait Work<const L: usize>: Copy {
    /// A constant, so that all are cleared at once.
    const ZERO: Self;

    fn input(&mut self) -> &mut [[f32; L]; 2];
    fn output(&self) -> &[[f32; L]; 2];
}

/// Numbers between the stages of samples and their inverse; no load or store crosses a cache line.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub(crate) struct Group<const L: usize> {
    pub(crate) input: [[f32; L]; 2],
    pub(crate) output: [[f32; L]; 2],
    /// Index of the next read.
    pub(crate) at: [u32; L],
    pub(crate) column: [u32; L],
    pub(crate) row: [u32; L],
    /// The positions in the columns.
    pub(crate) t: [f32; L],
    /// Integral or position to search for.
    pub(crate) target: [f32; L],
    pub(crate) eights: [[f32; 8]; L],
    pub(crate) other_eights: [[f32; 8]; L],
    pub(crate) fours: [[f32; 4]; L],
    pub(crate) other_fours: [[f32; 4]; L],
    pub(crate) twos: [[f32; 2]; L],
}

impl<const L: usize> Work<L> for Group<L> {
    const ZERO: Self = Self {
        input: [[0.0; L]; 2],
        output: [[0.0; L]; 2],
        at: [0; L],
        column: [0; L],
        row: [0; L],
        t: [0.0; L],
        target: [0.0; L],
        eights: [[0.0; 8]; L],
        other_eights: [[0.0; 8]; L],
        fours: [[0.0; 4]; L],
        other_fours: [[0.0; 4]; L],
        twos: [[0.0; 2]; L],
    };

    #[inline(always)]
    fn input(&mut self) -> &mut [[f32; L]; 2] {
        &mut self.input
    }
    #[inline(always)]
    fn output(&self) -> &[[f32; L]; 2] {
        &self.output
    }
}

/// The entries of the lanes of a register, starting at `from`.
#[inline(always)]
pub(crate) fn of<P: Lanes, T>(_: P, entries: &[T], from: usize) -> &[T] {
    entries.get(from..from + P::LEN).unwrap_or_default()
}

/// The entries of the lanes of a register, starting at `from`.
#[inline(always)]
pub(crate) fn of_mut<P: Lanes, T>(_: P, entries: &mut [T], from: usize) -> &mut [T] {
    entries.get_mut(from..from + P::LEN).unwrap_or_default()
}

/// Copies the entries of a guide at the indices of the lanes.
#[inline(always)]
pub(crate) fn copy_guide<const L: usize>(guide: &[[f32; 4]], groups: &mut [Group<L>]) {
    for group in groups {
        for k in 0..L {
            let Some(entry) = guide.get(group.at[k] as usize) else { continue };
            group.fours[k] = *entry;
        }
    }
}

/// Finds the last leaves whose keys are at most the values, starting from the guide.
///
/// Keys are the numbers of the first halves of the leaves with this index. The entries of the guide
/// contain the next three.
#[inline(always)]
pub(crate) fn find_leaves<P: Lanes, const L: usize, const KEY: usize>(
    p: P,
    leaves: &[Leaf],
    group: &mut Group<L>,
    values: &[f32; L],
) {
    let (zero, one) = (p.float(0.0), p.float(1.0));
    for from in (0..L).step_by(P::LEN) {
        let value = p.load(of(p, values, from));
        let [start, a, b, c] = p.fields4(of(p, &group.fours, from));
        let passed = [p.at_or_below(a, value), p.at_or_below(b, value), p.at_or_below(c, value)];
        let count = p.select(passed[0], p.select(passed[1], p.float(2.0), one), zero);
        p.store_words(p.bits(start) + p.truncated(count), of_mut(p, &mut group.at, from));
        // Rare, and then it is unknown whether later ones are passed too.
        if p.any(passed[2]) {
            for (leaf, &value) in of_mut(p, &mut group.at, from).iter_mut().zip(of(p, values, from)) {
                while leaves.get(*leaf as usize + 1).is_some_and(|next| next[0][KEY] <= value) {
                    *leaf += 1;
                }
            }
        }
    }
}

/// An array from each of two sides of a cell; the second begins `stride` later, if there are two.
#[inline(always)]
pub(crate) fn sides<const SIDES: usize>(array: &[f32], stride: u32) -> [&[f32]; 2] {
    let stride = if SIDES == 2 { stride as usize } else { 0 };
    // Of equal length, so that one comparison covers both.
    let len = array.len().saturating_sub(stride);
    [array.get(..len).unwrap_or_default(), array.get(stride..stride + len).unwrap_or_default()]
}

/// `LEN` numbers starting at `at`.
#[inline(always)]
pub(crate) fn entries<const LEN: usize>(array: &[f32], at: u32) -> Option<&[f32; LEN]> {
    let at = at as usize;
    array.get(at..at + LEN)?.as_array()
}
