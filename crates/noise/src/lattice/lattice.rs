//! The source of a lattice's random words, and the cell of a point.

use crate::lanes::{Arithmetic, Lanes, Scalar};

/// Whether this build compiles the kinds in the crate. The unit tests call none of them.
pub(crate) const IS_FULL: bool = cfg!(not(any(debug_assertions, test)));

/// A hash of lattice points, the only randomness of every noise of this crate.
///
/// All 32 bits of a word must look independent of each other, of the words of other points and of
/// other seeds. [`IntegerHash`](crate::IntegerHash) is the default.
/// [`PermutationTable`](crate::lattice::PermutationTable) and
/// [`ChainedTable`](crate::lattice::ChainedTable) reproduce published lattices.
/// The method `tiled` of a noise makes any lattice periodic.
///
/// Implement [`word`](Self::word) for a custom lattice. The methods over [`Lanes`] have default
/// implementations.
///
/// ```
/// use asperity_noise::{Field, IntegerHash, Lattice, Perlin, glam::Vec2};
///
/// /// Only the row of cells matters.
/// struct Stripes;
///
/// impl Lattice for Stripes {
///     fn word<const N: usize>(&self, cell: [i32; N], seed: u32) -> u32 {
///         IntegerHash.word([cell[0]], seed)
///     }
/// }
///
/// let noise = Perlin::new(1).with_lattice(Stripes);
/// assert_eq!(noise.value(Vec2::new(0.4, 0.25)), noise.value(Vec2::new(0.4, 7.25)));
/// ```
pub trait Lattice {
    /// Returns the random word of a lattice point in N dimensions.
    fn word<const N: usize>(&self, cell: [i32; N], seed: u32) -> u32;

    /// Returns the word of a lattice point for kinds that use only its upper bits.
    ///
    /// It may be faster than [`word`](Self::word), which is the default. Its upper 16 bits are as
    /// random as the bits of [`word`](Self::word), but may be different bits.
    #[inline]
    fn upper_word<const N: usize>(&self, cell: [i32; N], seed: u32) -> u32 {
        self.word(cell, seed)
    }

    /// Whether it is [`IntegerHash`](crate::IntegerHash), for which this crate compiles every kind.
    #[doc(hidden)]
    const STANDARD: bool = false;

    /// Whether the lattice repeats.
    const TILED: bool = false;

    /// The period along an axis, or 0 for an axis without a period.
    #[inline(always)]
    fn period(&self, _axis: usize) -> u32 {
        0
    }

    /// The lattice of an octave of a sum; `None` if it is the lattice itself.
    ///
    /// Its periods are multiplied by the frequency, and its cells are relative to another cell.
    #[inline(always)]
    fn of_octave(&self, _frequency: f32, _cell: &[i32]) -> Option<Self>
    where
        Self: Sized,
    {
        None
    }

    /// A copy of the lattice, if it takes no memory.
    ///
    /// Parameters of an owned noise stay in registers. For a borrowed noise the compiler must
    /// assume that writes can alias them.
    #[inline(always)]
    fn copied(&self) -> Option<Self>
    where
        Self: Sized,
    {
        None
    }

    /// Whether all octaves of a sum use the lattice itself.
    const SHARED: bool = true;

    /// The key that replaces the seed in words, computed once for all words of a seed.
    #[inline(always)]
    fn key(&self, seed: u32) -> u32 {
        seed
    }

    /// The part of a cell's word that depends on its coordinate along an axis.
    #[inline(always)]
    fn term<S: Lanes>(&self, _: S, _axis: usize, cell: S::U) -> S::U {
        cell
    }

    /// The terms of a cell and of the next cell.
    #[inline(always)]
    fn terms<S: Lanes>(&self, s: S, axis: usize, cell: S::U) -> [S::U; 2] {
        [self.term(s, axis, cell), self.term(s, axis, cell + s.word(1))]
    }

    /// The words of points, from their terms.
    #[inline(always)]
    fn words<S: Lanes, const N: usize>(&self, s: S, terms: [S::U; N], seed: u32) -> S::U {
        let seeds = s.keys(|| seed);
        s.words(|lane| self.word(terms.map(|term| s.lane_word(term, lane) as i32), s.lane_word(seeds, lane)))
    }

    /// The upper words of points, from their terms.
    #[inline(always)]
    fn upper_words<S: Lanes, const N: usize>(&self, s: S, terms: [S::U; N], seed: u32) -> S::U {
        let seeds = s.keys(|| seed);
        s.words(|lane| {
            self.upper_word(terms.map(|term| s.lane_word(term, lane) as i32), s.lane_word(seeds, lane))
        })
    }
}

/// The terms of the corners of a cell in lanes.
///
/// Every four lanes have the ends of the first two axes: 0 and 0, 0 and 1, 1 and 0, 1 and 1. Bit i
/// of `k` selects the end along axis i + 2.
#[inline(always)]
pub(crate) fn at_ends<S: Lanes, const N: usize>(s: S, ends: &[[u32; 2]; N], k: usize) -> [S::U; N] {
    let mut terms = [s.word(0); N];
    for axis in 0..N {
        terms[axis] = match axis {
            0 => s.words(|lane| ends[0][lane >> 1 & 1]),
            1 => s.words(|lane| ends[1 % N][lane & 1]),
            _ => s.word(ends[axis][k >> (axis - 2) & 1]),
        };
    }
    terms
}

/// A noise that draws its words from a lattice.
pub(crate) trait OnLattice {
    /// The source of the words.
    type Lattice: Lattice;

    fn lattice(&self) -> &Self::Lattice;

    /// The noise on the lattice of an octave, [`Lattice::of_octave`].
    #[inline(always)]
    fn of_octave(&self, _frequency: f32, _cell: &[i32]) -> Option<Self>
    where
        Self: Sized,
    {
        None
    }
}

/// From here on cells do not fit into `i32`.
const LIMIT: f32 = 2_147_483_648.0;

/// The reach of a kind of noise: Σ |xᵢ| < 2³⁰, so that every coordinate has a cell.
pub(crate) const REACH: f32 = LIMIT / 2.0;

/// Whether Σ |xᵢ| < `reach` in every lane.
#[inline(always)]
pub(crate) fn is_within<S: Lanes, const N: usize>(s: S, p: &[S::F; N], reach: f32) -> bool {
    let mut sum = s.abs(p[0]);
    for &x in &p[1..] {
        sum = sum + s.abs(x);
    }
    s.all(s.less(sum, s.float(reach)))
}

/// The cell of each coordinate and the position in it, in [0, 1], for |x| ≤ 2³¹.
///
/// The position rounds to 1 if x is closer under an integer than `f32` can resolve. Noises are
/// continuous there.
#[inline(always)]
pub(crate) fn cell<S: Lanes>(s: S, x: S::F) -> (S::U, S::F) {
    s.cell(x)
}

/// A point with the same cell modulo 2³² whose coordinates all fit into `i32`; `None` if a
/// coordinate is not finite.
///
/// From |x| = 2²³ on, `f32` holds only integers, so that only the cell changes.
#[inline]
pub(crate) fn wrapped<const N: usize>(p: [f32; N]) -> Option<[f32; N]> {
    // From 2⁵⁵ on every `f32` is a multiple of 2³².
    const FAR: f32 = 36_028_797_018_963_968.0;
    p.iter().all(|x| x.is_finite()).then(|| {
        p.map(|x| match x.abs() {
            near if near < LIMIT => x,
            far if far < FAR => x as i64 as i32 as f32,
            _ => 0.0,
        })
    })
}

/// The terms of one lattice point.
#[inline(always)]
pub(crate) fn terms_of<L: Lattice + ?Sized, const N: usize>(
    lattice: &L,
    cell: [i32; N],
) -> [<Scalar as Arithmetic>::U; N] {
    let mut terms = [Scalar.word(0); N];
    for axis in 0..N {
        terms[axis] = lattice.term(Scalar, axis, Scalar.word(cell[axis] as u32));
    }
    terms
}

/// Implements the words of a [`Lattice`] at one point by its terms.
macro_rules! words_by_terms {
    () => {
        #[inline(always)]
        fn word<const N: usize>(&self, cell: [i32; N], seed: u32) -> u32 {
            let terms = $crate::lattice::lattice::terms_of(self, cell);
            self.words($crate::lanes::Scalar, terms, seed).0
        }

        #[inline(always)]
        fn upper_word<const N: usize>(&self, cell: [i32; N], seed: u32) -> u32 {
            let terms = $crate::lattice::lattice::terms_of(self, cell);
            self.upper_words($crate::lanes::Scalar, terms, seed).0
        }
    };
}

pub(crate) use words_by_terms;

/// Implements the words of a [`Lattice`] that has its own terms and hashes them like the lattice in
/// the given field.
macro_rules! words_of_terms_in {
    ($lattice:ident) => {
        $crate::lattice::lattice::words_by_terms!();

        #[inline(always)]
        fn key(&self, seed: u32) -> u32 {
            self.$lattice.key(seed)
        }

        #[inline(always)]
        fn words<S: Lanes, const N: usize>(&self, s: S, terms: [S::U; N], seed: u32) -> S::U {
            self.$lattice.words(s, terms, seed)
        }

        #[inline(always)]
        fn upper_words<S: Lanes, const N: usize>(&self, s: S, terms: [S::U; N], seed: u32) -> S::U {
            self.$lattice.upper_words(s, terms, seed)
        }
    };
}

pub(crate) use words_of_terms_in;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_floors() {
        fn cell(x: f32) -> (i32, f32) {
            let (cell, position) = super::cell(Scalar, x);
            (cell.0 as i32, position)
        }
        assert_eq!(cell(2.25), (2, 0.25));
        assert_eq!(cell(-0.25), (-1, 0.75));
        assert_eq!(cell(-3.0), (-3, 0.0));
        assert_eq!(cell(-0.0), (0, 0.0));
        assert_eq!(cell(-1e-20), (-1, 1.0));
        assert_eq!(cell(8_388_607.5), (8_388_607, 0.5));
        assert_eq!(cell(-8_388_607.5), (-8_388_608, 0.5));
        assert_eq!(cell(2_147_483_520.0), (2_147_483_520, 0.0));
    }

    #[test]
    fn points_are_within_reach_or_not() {
        assert!(is_within(Scalar, &[5e8, -5e8], REACH));
        assert!(!is_within(Scalar, &[6e8, -6e8], REACH));
        assert!(!is_within(Scalar, &[f32::NAN, 0.0], REACH));
        assert!(!is_within(Scalar, &[f32::NEG_INFINITY], REACH));
    }

    #[test]
    fn huge_coordinates_wrap() {
        assert_eq!(wrapped([5.5, -7.25]), Some([5.5, -7.25]));
        assert_eq!(wrapped([f32::MAX, f32::MIN]), Some([0.0, 0.0]));
        assert_eq!(wrapped([4_294_967_296.0 + 1024.0]), Some([1024.0]));
        assert_eq!(wrapped([2_147_483_648.0, -2_147_483_904.0]), Some([-2_147_483_648.0, 2_147_483_392.0]));
        assert_eq!(wrapped([f32::INFINITY, 0.0]), None);
        assert_eq!(wrapped([0.0, f32::NAN]), None);
        for exponent in 29..=127 {
            let p = [2.0_f32.powi(exponent), -2.0_f32.powi(exponent) * 1.75, 0.5, f32::MAX];
            let wrapped = wrapped(p).unwrap();
            assert!(wrapped.iter().all(|x| x.abs() <= LIMIT), "2^{exponent}: {wrapped:?}");
        }
    }
}
