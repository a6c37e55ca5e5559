//! Lattices with a period along each axis, for tileable noises.

use crate::{
    error::NoiseError,
    lanes::Lanes,
    lattice::lattice::{Lattice, words_of_terms_in},
};

/// The lattice of a tiled noise, with a period along each of the first N axes.
///
#[cfg_attr(doc, doc = include_str!("../../docs/pictures/tiled.md"))]
///
/// ```text
/// word(c) = L.word(c mod period)
/// ```
///
/// The method `tiled` of a noise returns the noise on it, for instance
/// [`Perlin::tiled`](crate::Perlin::tiled). Axes beyond the N-th do not repeat.
///
/// ```
/// use asperity_noise::{Field, Perlin, glam::Vec2};
///
/// let noise = Perlin::new(1).tiled([8, 3])?;
/// let p = Vec2::new(1.25, -0.5);
/// assert_eq!(noise.sample(p), noise.sample(p + Vec2::new(8.0, -3.0)));
/// # Ok::<(), asperity_noise::NoiseError>(())
/// ```
#[doc(alias("seamless", "tileable", "periodic"))]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tiled<L, const N: usize> {
    pub(crate) lattice: L,
    pub(crate) periods: [u32; N],
}

/// The longest period, a quarter of the cells in which `f32` can resolve a position.
pub(crate) const MAX_PERIOD: u32 = 1 << 21;

/// A kind of noise that tiles in N dimensions.
///
/// Call `tiled` of the noise, or [`Fbm::tiled`](crate::Fbm::tiled).
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not tile in {N} dimensions",
    note = "all kinds of this crate tile, except simplex noise in 2-D and 4-D, where its lattice is irrational along the axes",
    note = "a sum of a periodic field of your own tiles if its lacunarity is an integer and its rotation `Rotation::Aligned`"
)]
pub trait Tile<const N: usize>: Sized {
    /// The tiled noise.
    type Tiled;

    /// The noise with a period along each axis.
    ///
    /// # Errors
    ///
    /// If the noise does not have these periods.
    fn tiled(self, periods: [u32; N]) -> Result<Self::Tiled, NoiseError>;
}

impl<L, const N: usize> Tiled<L, N> {
    /// Creates the lattice with the given periods.
    pub(crate) fn new(lattice: L, periods: [u32; N]) -> Result<Self, NoiseError> {
        for (axis, period) in periods.into_iter().enumerate() {
            if period == 0 || period > MAX_PERIOD {
                return Err(NoiseError::Period { axis, period });
            }
        }
        Ok(Self { lattice, periods })
    }

    /// Returns the period along each axis.
    #[must_use]
    pub const fn periods(&self) -> &[u32; N] {
        &self.periods
    }
}

/// The period of an octave, an integer as checked by the sum.
#[inline(always)]
pub(crate) fn octave_period(period: u32, frequency: f32) -> u32 {
    ((period as f32 * frequency) as u32).max(1)
}

/// Points moved into the first tile by whole periods without rounding; along an axis of period 0
/// they stay.
#[inline(always)]
pub(crate) fn in_first_tile<S: Lanes, const N: usize>(s: S, p: [S::F; N], periods: &[f32; N]) -> [S::F; N] {
    let mut q = p;
    for axis in 0..N {
        if periods[axis] > 0.0 {
            let period = s.float(periods[axis]);
            let near = p[axis] - period * s.floor(p[axis] / period);
            // The quotient may be rounded up to the next integer, or down from it.
            let low = s.select(s.less(near, s.float(0.0)), near + period, near);
            q[axis] = s.select(s.less(low, period), low, low - period);
        }
    }
    q
}

/// A cell modulo a period of at most 6 · 2²¹, with a non-negative remainder.
///
/// It is exact. The first quotient times the period has an error below 2³¹ · 2⁻²², which leaves a
/// remainder from −2⁹ to the period + 2⁹. The remainder is a float so close to 0, or so small a
/// multiple of the period, that its quotient does not round to the next integer.
#[inline(always)]
pub(crate) fn remainder<S: Lanes>(s: S, cell: S::U, period: u32) -> S::U {
    let (real, bits) = (s.float(period as f32), s.word(period));
    let near = cell - s.integer(s.floor(s.real(cell) / real)) * bits;
    near - s.integer(s.floor(s.real(near) / real)) * bits
}

impl<L: Lattice + Clone, const M: usize> Lattice for Tiled<L, M> {
    const TILED: bool = true;
    const SHARED: bool = false;

    #[inline(always)]
    fn period(&self, axis: usize) -> u32 {
        self.periods.get(axis).copied().unwrap_or(0)
    }

    #[inline(always)]
    fn of_octave(&self, frequency: f32, _: &[i32]) -> Option<Self> {
        let periods = self.periods.map(|period| octave_period(period, frequency));
        Some(Self { lattice: self.lattice.clone(), periods })
    }

    words_of_terms_in!(lattice);

    #[inline(always)]
    fn term<S: Lanes>(&self, s: S, axis: usize, cell: S::U) -> S::U {
        let cell = match self.periods.get(axis) {
            Some(&period) => remainder(s, cell, period),
            None => cell,
        };
        self.lattice.term(s, axis, cell)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::{Arithmetic, Scalar};
    use crate::{IntegerHash, lattice::PermutationTable};

    const LONG: u32 = MAX_PERIOD;

    #[test]
    fn remainder_matches_rem_euclid() {
        for period in [1, 2, 3, 5, 7, 12, 255, 256, 1000, 65_537, LONG - 1, LONG, 6 * LONG - 6, 6 * LONG] {
            let signed = period as i32;
            let near = (-300..300_i32).flat_map(|i| {
                let multiple = i.wrapping_mul(signed);
                [i, multiple, multiple.wrapping_sub(1), multiple.wrapping_add(1)]
            });
            let far =
                (0..300_i32).flat_map(|i| [i32::MAX - i * 77, i32::MIN + i * 991, i.wrapping_mul(7_654_321)]);
            for cell in near.chain(far).chain([i32::MAX / signed * signed, i32::MIN / signed * signed]) {
                let rest = remainder(Scalar, Scalar.word(cell as u32), period);
                assert_eq!(rest.0 as i32, cell.rem_euclid(signed), "{cell} mod {period}");
            }
        }
    }

    #[test]
    fn only_periods_in_range_are_accepted() {
        assert_eq!(Tiled::new(IntegerHash, [1, LONG]).unwrap().periods(), &[1, LONG]);
        assert_eq!(Tiled::new(IntegerHash, [1, 0]), Err(NoiseError::Period { axis: 1, period: 0 }));
        assert!(Tiled::new(IntegerHash, [LONG + 1]).is_err());
    }

    #[test]
    fn words_repeat_but_not_along_later_axes() {
        let tiled = Tiled::new(IntegerHash, [5, 12]).unwrap();
        for i in -50..50_i32 {
            let cell = [3 * i, -i, i];
            let first = [(3 * i).rem_euclid(5), (-i).rem_euclid(12), i];
            assert_eq!(tiled.word(cell, 3), IntegerHash.word(first, 3));
            assert_eq!(tiled.word(cell, 3), tiled.word([3 * i + 10, -i - 12, i], 3));
            assert_ne!(tiled.word(cell, 3), tiled.word([3 * i, -i, i + 12], 3));
        }
        let table = PermutationTable::new(1);
        assert_eq!(Tiled::new(table, [5, 12]).unwrap().word([77, -8, 3], 3), table.word([2, 4, 3], 3));
    }
}
