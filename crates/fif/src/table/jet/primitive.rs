//! The integral of the deviation from the chord, at the centers of all cells of a table.

use alloc::vec::Vec;
use asperity_core::Interval;

use crate::numeric::double::Double;
use crate::numeric::polynomial::{UNIT, magnitude};
use crate::system::chord::Chord;
use crate::table::composite::{Composite, Composites, Series};

/// Over the domain scaled to `[0, 1]`.
#[derive(Clone, Debug)]
pub(crate) struct Primitive {
    /// `∫ v` from 1/2 to the center of each cell.
    pub(crate) middles: Vec<f64>,
    /// `∫ v` from 0 to 1/2 and to 1.
    pub(crate) half: f64,
    pub(crate) whole: f64,
    /// The sum `Σ_k W_k r^(1−k) (∫_{1/2}^c v + (1/r) ∫_{1/2}^{u_k} P)`.
    ///
    /// Its last term uses the line through the center in place of the integral of `P`.
    pub(crate) series: Series,
}

impl Primitive {
    /// `centred` contains the polynomials of the rows in `u − 1/2`.
    pub(crate) fn new<const C: usize>(made: &Composites<C>, centred: &[Composite<C>], chord: &Chord) -> Self {
        let per_radix = 1.0 / made.radix as f64;
        let cells: Vec<_> = centred.iter().map(Cell::new).collect();
        // I = ∫ v over [0, 1] = (1/r) Σ (∫ P_e + A_e I).
        let (mut integrals, mut rest) = (Exact::default(), Exact::default());
        for cell in &cells {
            integrals.add(cell.whole);
            rest.add(1.0 - cell.a);
        }
        let whole = integrals.sum() / rest.sum();
        let mut before = Exact::default();
        let starts: Vec<f64> = cells
            .iter()
            .map(|cell| {
                let start = before.sum();
                before.add(cell.whole * per_radix);
                before.add(cell.a * whole * per_radix);
                start
            })
            .collect();
        let middle = made.radix / 2;
        let half = match (starts.get(middle), cells.get(middle)) {
            // 1/2 is the center of the middle cell.
            (Some(start), Some(cell)) if made.radix % 2 == 1 => {
                (start + per_radix * cell.left) / (1.0 - per_radix * cell.a)
            }
            (Some(start), _) => *start,
            _ => 0.0,
        };
        let middles: Vec<f64> = starts
            .iter()
            .zip(&cells)
            .map(|(start, cell)| start + per_radix * (cell.left + cell.a * half) - half)
            .collect();

        let sup = made.deviation.magnitude();
        let gamma = 4.0 * C as f64 * UNIT;
        let gain = 1.0 / (1.0 - made.steepest);
        // A polynomial, shifted to the center, and its integral.
        let part = 1.01 * (made.error + 3.0 * gamma * made.largest);
        let sums = gain * (part + 8.0 * UNIT * (made.largest + whole.abs() + sup));
        let farthest = middles.iter().fold(0.0_f64, |most, middle| most.max(middle.abs()));
        let beyond =
            cells.iter().fold(0.0_f64, |most, cell| most.max(cell.curved + 0.5 * cell.a.abs() * sup));
        // Not zero, so that the last term can be counted as a step.
        let ratio = (made.steepest * per_radix * (1.0 + 4.0 * UNIT)).max(UNIT * UNIT);
        let radius = 1.01 * per_radix * beyond / ratio;
        let series = Series {
            ratio,
            largest: farthest + per_radix * made.largest,
            row: 5.0 * gain * sums + per_radix * part + 8.0 * UNIT * (farthest + per_radix * made.largest),
            roundings: f64::from(made.digits) + 6.0,
            tail: Interval::new(-radius, radius),
            scale: 2.0 * (chord.start.abs() + chord.rise.abs()) + half.abs(),
            end: u32::MAX,
            // Positions near the left end are truncated after 64 bits.
            lost: f64::MIN_POSITIVE + UNIT / 1024.0 * sup,
            unit: UNIT,
        };
        Self { middles, half, whole, series }
    }
}

/// Integrals of a row: over the left half of its cell, and over the whole cell.
///
/// And an error bound of the line through the center.
struct Cell {
    a: f64,
    left: f64,
    whole: f64,
    curved: f64,
}

impl Cell {
    /// Integrals of a row in `u − 1/2`.
    fn new<const C: usize>(row: &Composite<C>) -> Self {
        let c = row.c;
        let (mut power, mut left, mut whole) = (0.5, 0.0, 0.0);
        for (k, c) in c.iter().enumerate() {
            let part = c * power / (k + 1) as f64;
            // Odd powers subtract from the left half the amount that they add to the right one.
            left += if k % 2 == 0 { part } else { -part };
            whole += if k % 2 == 0 { 2.0 * part } else { 0.0 };
            power *= 0.5;
        }
        let mut bent = c;
        if let Some(first) = bent.first_mut() {
            *first = 0.0;
        }
        Self { a: row.a, left, whole, curved: 0.5 * magnitude(&bent, 0.5) }
    }
}

/// A sum with its accumulated rounding error.
#[derive(Default)]
struct Exact {
    high: f64,
    low: f64,
}

impl Exact {
    fn add(&mut self, x: f64) {
        let sum = Double::two_sum(self.high, x);
        (self.high, self.low) = (sum.hi, self.low + sum.lo);
    }

    fn sum(&self) -> f64 {
        self.high + self.low
    }
}
