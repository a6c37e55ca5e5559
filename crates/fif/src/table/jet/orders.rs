//! Sums for the derivatives of a function over its table of composites: their lengths and the errors that they leave.

use alloc::vec::Vec;

use crate::numeric::interval::{Bounded, Interval};
use crate::numeric::polynomial::{UNIT, falling, magnitudes};
use crate::system::chord::Chord;
use crate::system::fif::Fif;
use crate::system::fif::System;
use crate::system::map::Piece;
use crate::table::composite::{Composite, Composites, greater, narrow};
use crate::table::truncation::Series;

/// The sum for one derivative.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Order {
    pub(crate) terms: u32,
    pub(crate) tail: [f64; 2],
    /// Bound of the error away from knots.
    pub(crate) bound: f64,
}

/// All derivatives that are continuous.
pub(crate) fn derivatives<S: AsRef<[Piece<C>]>, const C: usize>(system: &System<S, C>) -> Vec<Fif<C>> {
    let mut all: Vec<Fif<C>> = Vec::new();
    while all.len() < C.max(1) {
        let next = match all.last() {
            None => system.derivative(),
            Some(last) => last.derivative(),
        };
        let Ok(next) = next else { break };
        all.push(next);
    }
    all
}

/// The greatest `Σ_k k!/(k − m)! |c_k|` of any row, for each order `m`.
pub(crate) fn largest<const C: usize>(table: &[Composite<C>]) -> [f64; C] {
    table.iter().fold([0.0; C], |most, row| greater(most, magnitudes(&row.c)))
}

/// Terms of the sum for a derivative; `scale` is `rᵐ`.
pub(crate) struct Sum<'a, const C: usize> {
    pub(crate) made: &'a Composites<C>,
    pub(crate) order: usize,
    pub(crate) largest: f64,
    pub(crate) scale: f64,
}

impl<const C: usize> Sum<'_, C> {
    /// The series, and what stands for its tail where digits are left and where they are zeros; `None` when it diverges.
    pub(crate) fn series(&self, chord: &Chord) -> Option<(Series, [f64; 2])> {
        let Self { made, order: m, largest, scale } = *self;
        let (ratio, largest) = (made.steepest * scale, scale * largest);
        // Shifting the origin to the middle; Horner's rule and 11 bits of u that a sum does not see, for every coefficient
        // up to C times with each derivative.
        let gamma = 4.0 * C as f64 * UNIT;
        let row = scale * made.errors.get(m).copied().unwrap_or(0.0)
            + gamma * (1.0 + (m + 1) as f64 * C as f64) * largest;
        let roundings = 2.0 * f64::from(made.digits) + 4.0;
        let (tail, start) = if m == 0 {
            (made.deviation, Bounded { value: 0.0, bound: 0.0 })
        } else {
            if ratio >= 1.0 || ratio.is_nan() {
                return None;
            }
            let factors = core::array::from_fn(|k| scale * falling(k + m, m));
            let rows = made.table.iter().map(|row| (row.a * scale, differentiate(&row.c, m, &factors)));
            let widest = 1.001 * (largest + row) / (1.0 - ratio);
            let tail = narrow(Interval::new(-widest, widest), rows, row + gamma * largest, roundings);
            // v^(m)(0) = a rᵐ v^(m)(0) + rᵐ P^(m)(0) with the first row.
            let first = made.table.first().map_or(0.0, |row| 1.0 - row.a * scale);
            let p =
                made.table.first().and_then(|row| row.c.get(m)).map_or(0.0, |c| falling(m, m) * scale * c);
            let value = p / first;
            (tail, Bounded { value, bound: (row + 8.0 * UNIT * (p.abs() + value.abs())) / (1.0 - ratio) })
        };
        let series = Series {
            ratio: ratio * (1.0 + 4.0 * UNIT),
            largest,
            row,
            roundings,
            tail,
            scale: match m {
                0 => chord.start.abs() + chord.rise.abs(),
                1 => chord.rise.abs(),
                _ => 0.0,
            },
            end: made.end(),
            lost: scale * f64::MIN_POSITIVE + start.bound,
            unit: UNIT,
        };
        Some((series, [tail.middle(), start.value]))
    }
}

/// Coefficients of the `m`-th derivative with these factors.
fn differentiate<const C: usize>(c: &[f64; C], m: usize, factors: &[f64; C]) -> [f64; C] {
    let mut out = [0.0; C];
    for ((out, c), factor) in out.iter_mut().zip(c.iter().skip(m)).zip(factors) {
        *out = factor * c;
    }
    out
}
