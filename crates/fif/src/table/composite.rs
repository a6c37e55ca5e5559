//! All composites of a few maps of a system on equally spaced knots, in a table: one digit of a larger radix each.

use core::fmt;

use crate::numeric::interval::Interval;
use crate::numeric::polynomial::{UNIT, bernstein, falling, magnitudes, substitute};
use crate::system::fif::{Fif, Spacing};
use crate::system::map::Piece;

/// A composite of maps: over its cell, scaled to `[0, 1]`, the function less its chord is `a v(u) + Σ c_k uᵏ`.
///
/// Made by [`Fast::new`](crate::Fast::new); the powers may be scaled to the unit that the holder of the table counts in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Composite<const C: usize> {
    pub(crate) a: f64,
    pub(crate) c: [f64; C],
}

impl<const C: usize> Composite<C> {
    /// The identity; a filler for storage that a constructor is about to fill.
    pub const EMPTY: Self = Self { a: 1.0, c: [0.0; C] };
}

/// Owned storage for a table of composites.
pub trait TableStorage<const C: usize>: AsRef<[Composite<C>]> + AsMut<[Composite<C>]> + Sized {
    /// Storage for exactly `len` composites, or `None` when the type cannot hold as many.
    #[must_use]
    fn with_len(len: usize) -> Option<Self>;

    /// The number of composites that the type holds when that is fixed, else `usize::MAX`.
    #[must_use]
    fn capacity() -> usize;
}

impl<const M: usize, const C: usize> TableStorage<C> for [Composite<C>; M] {
    fn with_len(len: usize) -> Option<Self> {
        (len == M).then_some([Composite::EMPTY; M])
    }

    fn capacity() -> usize {
        M
    }
}

#[cfg(feature = "alloc")]
impl<const C: usize> TableStorage<C> for alloc::vec::Vec<Composite<C>> {
    fn with_len(len: usize) -> Option<Self> {
        Some(alloc::vec![Composite::EMPTY; len])
    }

    fn capacity() -> usize {
        usize::MAX
    }
}

/// Why there is no table for a system. [`Fif::evaluate`] serves every system.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum TableError {
    /// The knots are not equally spaced.
    Nonuniform {
        /// The first knot off its place, from 0.
        knot: usize,
        /// Where it lies.
        x: f64,
    },
    /// A table of fixed size holds no whole number of digits.
    Storage {
        /// The largest power of the number of maps that fits, at least that number.
        expected: usize,
        /// The size.
        found: usize,
    },
    /// The system has no continuous derivative.
    Rough,
    /// Rows in `f32` hold three coefficients at most.
    Coefficients {
        /// The number of coefficients of the system.
        found: usize,
    },
    /// The vertical factors are so near to one that a table of bounded depth misses the tolerance.
    Depth {
        /// The largest `|α_j|`.
        alpha: f64,
        /// Composites that one evaluation may take.
        most: u32,
        /// The error that they would leave.
        bound: f64,
    },
}

impl fmt::Display for TableError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Nonuniform { knot, x } => {
                write!(f, "knot {knot} at {x} is off the place of equally spaced knots")
            }
            Self::Storage { expected, found } => {
                write!(f, "the table must hold {expected} composites, its type holds {found}")
            }
            Self::Rough => write!(f, "jets need a continuous derivative, the system has none"),
            Self::Coefficients { found } => {
                write!(f, "the table holds 3 coefficients a row, the system has {found}")
            }
            Self::Depth { alpha, most, bound } => {
                write!(
                    f,
                    "with a vertical factor of size {alpha} {most} composites leave an error of {bound:e}"
                )
            }
        }
    }
}

impl core::error::Error for TableError {}

/// The table, with what bounds the error of sums over it.
#[derive(Clone, Debug)]
pub(crate) struct Composites<T, const C: usize> {
    pub(crate) table: T,
    /// The number of composites, `N^digits`.
    pub(crate) radix: usize,
    /// Maps in each composite.
    pub(crate) digits: u32,
    /// `max |a|`.
    pub(crate) steepest: f64,
    /// `max Σ |c_k|`.
    pub(crate) largest: f64,
    /// Bound of the error of every polynomial over `[0, 1]`.
    pub(crate) error: f64,
    /// The same of its derivatives over a row, order by order from 0.
    #[cfg(feature = "alloc")]
    pub(crate) errors: [f64; C],
    /// An enclosure of the deviation from the chord.
    pub(crate) deviation: Interval,
}

impl<T: TableStorage<C>, const C: usize> Composites<T, C> {
    /// The largest table with at most 1024 composites and 32 KB, or as the storage wants it.
    pub(crate) fn new<S: AsRef<[Piece<C>]>>(system: &Fif<S, C>) -> Result<Self, TableError> {
        if system.spacing() == Spacing::Nonuniform {
            let (knot, x) = displaced(system);
            return Err(TableError::Nonuniform { knot, x });
        }
        let maps = system.pieces().len();
        let (digits, radix) = size(maps, T::capacity(), size_of::<Composite<C>>());
        let storage = TableError::Storage { expected: radix, found: T::capacity() };
        let mut table = T::with_len(radix).ok_or(storage)?;
        let (mut steepest, mut largest, mut errors) = (1.0_f64, [0.0; C], [0.0; C]);
        let gamma = 4.0 * C as f64 * UNIT;
        for digit in 0..digits {
            // Outer composites first: v∘L_e∘L_j = a_e (α_j v + p_j) + P_e∘L_j, in place from the last to the first.
            let outer = maps.saturating_pow(digit);
            let (mut steep, mut large, mut part, mut slack) = (0.0_f64, [0.0; C], [0.0; C], 0.0_f64);
            for e in (0..outer).rev() {
                let Some(&Composite { a, c }) = table.as_ref().get(e) else { continue };
                let children = system.pieces().iter().zip(table.as_mut().iter_mut().skip(e * maps));
                for (piece, child) in children {
                    let map = system.deviation(piece);
                    let mut polynomial = substitute(&c, map.a, map.s);
                    for (sum, p) in polynomial.iter_mut().zip(map.p) {
                        *sum += a * p;
                    }
                    *child = Composite { a: a * map.alpha, c: polynomial };
                    steep = steep.max(child.a.abs());
                    large = greater(large, magnitudes(&child.c));
                    part = greater(part, magnitudes(&map.p));
                    slack = slack.max(map.slack);
                }
            }
            // In the norms Σ|c| of the derivatives, which no substitution u ↦ a u + s into [0, 1] enlarges: it takes aᵐ off.
            let factor = f64::from(digit) + 2.0;
            let mut shrink = 1.0;
            let sizes = largest.iter().zip(part).zip(large);
            for (m, (error, ((before, part), after))) in errors.iter_mut().zip(sizes).enumerate() {
                let added = falling(C - 1, m) * slack + factor * UNIT * part;
                *error = shrink * (*error + gamma * before) + steepest * added + UNIT * after;
                shrink /= maps as f64;
            }
            (steepest, largest) = (steep, large);
        }
        let errors = errors.map(|error: f64| 1.01 * error);
        let (error, largest) = (first(&errors), first(&largest));
        let roundings = f64::from(digits) + 2.0;
        let rows = table.as_ref().iter().map(|row| (row.a, &row.c));
        let deviation = enclose(system, &rows, error + 8.0 * C as f64 * UNIT * largest, roundings);
        let steepest = steepest * (1.0 + roundings * UNIT);
        Ok(Self {
            table,
            radix,
            digits,
            steepest,
            largest,
            error,
            #[cfg(feature = "alloc")]
            errors,
            deviation,
        })
    }
}

impl<T, const C: usize> Composites<T, C> {
    /// Steps after which nothing is left of 64 bits: a power of two uses them up.
    pub(crate) fn end(&self) -> u32 {
        let bits = self.radix.trailing_zeros();
        if self.radix.is_power_of_two() { u64::BITS.div_ceil(bits.max(1)) } else { u32::MAX }
    }
}

fn greater<const C: usize>(mut most: [f64; C], values: [f64; C]) -> [f64; C] {
    for (most, value) in most.iter_mut().zip(values) {
        *most = most.max(value);
    }
    most
}

fn first<const C: usize>(values: &[f64; C]) -> f64 {
    values.first().copied().unwrap_or(0.0)
}

/// An enclosure of the deviation from the chord: the range of `f` less that of the chord, then the hull of its images
/// under all rows `(a, c)` of a table that covers the domain, while that pays. `slack` bounds the error of their
/// polynomials, `roundings` those of `a`.
pub(crate) fn enclose<'a, S: AsRef<[Piece<C>]>, const C: usize>(
    system: &Fif<S, C>,
    rows: &(impl Iterator<Item = (f64, &'a [f64; C])> + Clone),
    slack: f64,
    roundings: f64,
) -> Interval {
    let (chord, range) = (system.chord(), system.range());
    let scale = range.magnitude() + 2.0 * (chord.start.abs() + chord.rise.abs());
    let (start, end) = (chord.start, chord.at(1.0));
    let line = Interval::new(start, start).hull(Interval::new(end, end));
    let bound = Interval::new(range.lo - line.hi, range.hi - line.lo).inflated(8.0 * UNIT * scale);
    narrow(bound, &rows.clone().map(|(a, c)| (a, *c)), slack, roundings)
}

/// The hull of the images of a bound under all rows `(a, c)` of a table that covers the domain, while that pays.
pub(crate) fn narrow<const C: usize>(
    mut bound: Interval,
    rows: &(impl Iterator<Item = (f64, [f64; C])> + Clone),
    slack: f64,
    roundings: f64,
) -> Interval {
    const ROUNDS: usize = 8;
    for _ in 0..ROUNDS {
        let hull = rows.clone().fold(Interval::EMPTY, |hull, (a, c)| {
            let p = bernstein(&c).iter().fold(Interval::EMPTY, |p, &b| p.hull(Interval::new(b, b)));
            let p = if C == 0 { Interval::new(0.0, 0.0) } else { p };
            hull.hull(p.sum(bound.scaled(a)))
        });
        let margin = slack + UNIT * (roundings + 2.0) * bound.magnitude();
        let next = hull.inflated(margin).intersection(bound);
        let gained = next.width() < 0.99 * bound.width();
        bound = next;
        if !gained {
            break;
        }
    }
    bound
}

/// Maps in a composite and composites in the table: a fixed capacity decides alone.
fn size(maps: usize, capacity: usize, bytes: usize) -> (u32, usize) {
    let free = if bytes * 1024 <= 32_768 { 1024 } else { 256 };
    let most = if capacity == usize::MAX { free } else { capacity };
    let mut digits = 1;
    while maps.saturating_pow(digits + 1) <= most {
        digits += 1;
    }
    (digits, maps.saturating_pow(digits))
}

/// The knot farthest from its place.
fn displaced<S: AsRef<[Piece<C>]>, const C: usize>(system: &Fif<S, C>) -> (usize, f64) {
    let pieces = system.pieces();
    let off = |j: usize, piece: &Piece<C>| (piece.s[0] - j as f64 / pieces.len() as f64).abs();
    let mut worst = (0, system.domain().lo, 0.0);
    for (j, piece) in pieces.iter().enumerate() {
        if off(j, piece) > worst.2 {
            worst = (j, piece.x()[0], off(j, piece));
        }
    }
    (worst.0, worst.1)
}

#[cfg(all(test, feature = "alloc"))]
mod tests {
    use super::*;
    use crate::{FifBuf, paper};
    use alloc::string::ToString;
    use alloc::vec::Vec;

    #[test]
    fn composites_are_maps_in_turn() {
        let g = paper::g_hat().unwrap();
        let t: Composites<[Composite<3>; 8], 3> = Composites::new(&g).unwrap();
        let chord = g.chord();
        let v = |t: f64| g.evaluate(2.0 * t, 1e-15).value - chord.at(t);
        for (k, e) in t.table.iter().enumerate() {
            for u in [0.0, 0.3, 0.5, 0.9] {
                let (got, want) =
                    (e.a * v(u) + crate::numeric::polynomial::horner(&e.c, u), v((k as f64 + u) / 8.0));
                assert!((got - want).abs() < 1e-14 + t.error, "cell {k}, u = {u}: {got} != {want}");
            }
        }
        assert!(t.error < 1e-13, "{:e}", t.error);
    }

    #[test]
    fn the_deviation_is_enclosed_tightly() {
        // f of the source vanishes at both ends and reaches 4/3.
        let t: Composites<Vec<Composite<2>>, 2> = Composites::new(&paper::f().unwrap()).unwrap();
        assert_eq!((t.radix, t.digits, t.steepest), (1024, 10, 1.0 / 1024.0 * (1.0 + 6.0 * f64::EPSILON)));
        assert!(t.deviation.contains(0.0) && t.deviation.contains(4.0 / 3.0) && t.deviation.width() < 1.34);
    }

    #[test]
    fn sizes_follow_the_storage() {
        assert_eq!(size(2, usize::MAX, 32), (10, 1024));
        assert_eq!(size(2, usize::MAX, 40), (8, 256));
        assert_eq!(size(3, usize::MAX, 24), (6, 729));
        assert_eq!(size(4096, usize::MAX, 24), (1, 4096));
        assert_eq!((size(2, 64, 24), size(3, 64, 24)), ((6, 64), (3, 27)));
        let error = Composites::<[Composite<2>; 100], 2>::new(&paper::f().unwrap()).unwrap_err();
        assert_eq!(error.to_string(), "the table must hold 64 composites, its type holds 100");
    }

    #[test]
    fn uneven_knots_are_refused() {
        let f = FifBuf::affine(&[0.0, 0.4, 1.4, 2.0], &[0.0; 4], &[0.4, -0.6, 0.5]).unwrap();
        let error = Composites::<Vec<Composite<2>>, 2>::new(&f).unwrap_err();
        assert_eq!(error.to_string(), "knot 1 at 0.4 is off the place of equally spaced knots");
    }
}
