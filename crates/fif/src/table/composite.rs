//! All composites of a few maps of a system on equally spaced knots, one digit of a larger radix
//! each.

use alloc::vec::Vec;
use asperity_core::Interval;

use crate::numeric::polynomial::{UNIT, bernstein, falling, hull, magnitudes, substitute};
use crate::system::error::FifError;
use crate::system::fif::{FifRef, Spacing};

/// A composite of maps: over its cell, scaled to `[0, 1]`, `f − chord` is `a v(u) + Σ c_k uᵏ`.
///
/// The powers may be scaled to the unit of the table.
#[derive(Clone, Copy, Debug)]
pub struct Composite<const C: usize> {
    pub(crate) a: f64,
    pub(crate) c: [f64; C],
}

/// The table, with error bounds for sums over it.
#[derive(Clone, Debug)]
pub(crate) struct Composites<const C: usize> {
    pub(crate) table: Vec<Composite<C>>,
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
    /// Bounds of the errors of its derivatives over a row, order by order from 0.
    pub(crate) errors: [f64; C],
    /// An enclosure of the deviation from the chord.
    pub(crate) deviation: Interval,
}

impl<const C: usize> Composites<C> {
    /// The largest table with at most 1024 composites and 32 KB; `None` unless the knots are
    /// equally spaced.
    pub(crate) fn new(system: FifRef<'_, C>) -> Option<Self> {
        if system.spacing() == Spacing::Nonuniform {
            return None;
        }
        let maps = system.pieces().len();
        let (digits, radix) = size(maps, size_of::<Composite<C>>());
        let mut table = alloc::vec![Composite { a: 1.0, c: [0.0; C] }; radix];
        let (mut steepest, mut largest, mut errors) = (1.0_f64, [0.0; C], [0.0; C]);
        let gamma = 4.0 * C as f64 * UNIT;
        for digit in 0..digits {
            // Outer composites first: v∘L_e∘L_j = a_e (α_j v + p_j) + P_e∘L_j, in place from the
            // last to the first.
            let outer = maps.saturating_pow(digit);
            let (mut steep, mut large, mut part, mut slack) = (0.0_f64, [0.0; C], [0.0; C], 0.0_f64);
            for e in (0..outer).rev() {
                let Some(&Composite { a, c }) = table.get(e) else { continue };
                let children = system.pieces().iter().zip(table.iter_mut().skip(e * maps));
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
            // In the norms Σ|c| of the derivatives, which no substitution u ↦ a u + s into [0, 1]
            // enlarges: it divides them by aᵐ.
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
        let rows = table.iter().map(|row| (row.a, row.c));
        let deviation = enclose(system, rows, error + 8.0 * C as f64 * UNIT * largest, roundings);
        let steepest = steepest * (1.0 + roundings * UNIT);
        Some(Self { table, radix, digits, steepest, largest, error, errors, deviation })
    }

    /// Steps after which 64 bits are used up; a power of two uses them up.
    pub(crate) fn end(&self) -> u32 {
        let bits = self.radix.trailing_zeros();
        if self.radix.is_power_of_two() { u64::BITS.div_ceil(bits.max(1)) } else { u32::MAX }
    }
}

/// The element-wise maximum.
pub(crate) fn greater<const C: usize>(mut most: [f64; C], values: [f64; C]) -> [f64; C] {
    for (most, value) in most.iter_mut().zip(values) {
        *most = most.max(value);
    }
    most
}

fn first<const C: usize>(values: &[f64; C]) -> f64 {
    values.first().copied().unwrap_or(0.0)
}

/// An enclosure of the deviation from the chord: the range of `f` minus that of the chord, then
/// narrowed.
///
/// It is narrowed by the hull of its images under all rows `(a, c)` of a table that covers the
/// domain, as long as this helps. `slack` bounds the error of their polynomials, `roundings` those
/// of `a`.
pub(crate) fn enclose<const C: usize>(
    system: FifRef<'_, C>,
    rows: impl Iterator<Item = (f64, [f64; C])>,
    slack: f64,
    roundings: f64,
) -> Interval {
    let (chord, range) = (system.chord(), system.range());
    let scale = range.magnitude() + 2.0 * (chord.start.abs() + chord.rise.abs());
    let (start, end) = (chord.start, chord.at(1.0));
    let line = Interval::new(start, start).hull(Interval::new(end, end));
    let bound = Interval::new(range.lo - line.hi, range.hi - line.lo).inflated(8.0 * UNIT * scale);
    narrow(bound, rows, slack, roundings)
}

/// The hull of the images of a bound under all rows `(a, c)` of a table that covers the domain.
///
/// Repeated as long as this helps.
pub(crate) fn narrow<const C: usize>(
    mut bound: Interval,
    rows: impl Iterator<Item = (f64, [f64; C])>,
    slack: f64,
    roundings: f64,
) -> Interval {
    const ROUNDS: usize = 8;
    let hulls: Vec<(f64, Interval)> = rows.map(|(a, c)| (a, hull(&bernstein(&c)))).collect();
    for _ in 0..ROUNDS {
        let images = hulls.iter().fold(Interval::EMPTY, |all, (a, own)| all.hull(own.sum(bound.scaled(*a))));
        let margin = slack + UNIT * (roundings + 2.0) * bound.magnitude();
        let next = images.inflated(margin).intersection(bound);
        let gained = next.width() < 0.99 * bound.width();
        bound = next;
        if !gained {
            break;
        }
    }
    bound
}

/// Maps in a composite and composites in the table.
fn size(maps: usize, bytes: usize) -> (u32, usize) {
    let most = if bytes * 1024 <= 32_768 { 1024 } else { 256 };
    let mut digits = 1;
    while maps.saturating_pow(digits + 1) <= most {
        digits += 1;
    }
    (digits, maps.saturating_pow(digits))
}

/// Maximum number of composites of one evaluation.
pub(crate) const MOST: u32 = 64;

/// The sum `Σ_{k < K} W_k P_k + W_K tail`, where every factor of `W_k` is at most `ratio` in
/// magnitude.
#[derive(Clone, Debug)]
pub(crate) struct Series {
    pub(crate) ratio: f64,
    /// `max |P_k|`.
    pub(crate) largest: f64,
    /// Error bound of one evaluated `P_k`.
    pub(crate) row: f64,
    /// Relative error of one factor of `W_k` and of the product, in units of rounding.
    pub(crate) roundings: f64,
    /// Encloses the tail.
    pub(crate) tail: Interval,
    /// The magnitude of the addend of the sum.
    pub(crate) scale: f64,
    /// The number of steps after which nothing remains.
    pub(crate) end: u32,
    /// An error that does not depend on the depth.
    pub(crate) lost: f64,
    /// The unit of rounding.
    pub(crate) unit: f64,
}

/// Number of steps, and the remaining error.
pub(crate) struct Depth {
    pub(crate) steps: u32,
    pub(crate) bound: f64,
}

impl Series {
    /// The smallest number of steps whose bound is within the tolerance, or else within 5/4 of the
    /// smallest bound.
    ///
    /// Returns that bound as an error if more steps than [`MOST`] would have reduced it.
    pub(crate) fn depth(&self, tolerance: f64) -> Result<Depth, f64> {
        let last = MOST.min(self.end);
        let bounds = || (1..=last).map(|steps| Depth { steps, bound: self.bound(steps) });
        let least = bounds().fold(f64::INFINITY, |least, depth| least.min(depth.bound));
        let enough = if tolerance > 1.25 * least { tolerance } else { 1.25 * least };
        let first =
            bounds().find(|depth| depth.bound <= enough).filter(|_| least.is_finite()).ok_or(least)?;
        let [truncation, rounding] = self.errors(last);
        // A NaN tolerance cannot be reached.
        let within = first.bound <= tolerance;
        if within || truncation <= rounding { Ok(first) } else { Err(least) }
    }

    /// The smallest number of steps whose truncation is within the tolerance, or else half the
    /// rounding error.
    pub(crate) fn depth_of_truncation(&self, tolerance: f64) -> Result<Depth, f64> {
        let enough = |steps: &u32| {
            let [truncation, rounding] = self.errors(*steps);
            truncation <= tolerance || truncation <= 0.5 * rounding
        };
        let bound = |steps: u32| Depth { steps, bound: self.bound(steps) };
        let last = MOST.min(self.end);
        let found = (1..=last).find(enough).map(bound).filter(|depth| depth.bound.is_finite());
        found.ok_or_else(|| self.bound(last))
    }

    /// Truncation and rounding after this number of steps.
    pub(crate) fn bound(&self, steps: u32) -> f64 {
        let [truncation, rounding] = self.errors(steps);
        1.001 * (truncation + rounding) + self.lost
    }

    /// Truncation and rounding error after `steps` steps.
    fn errors(&self, steps: u32) -> [f64; 2] {
        let (radius, most) = (0.5 * self.tail.width(), self.tail.magnitude());
        // Σ |W_k| and Σ k |W_k|.
        let (mut weight, mut weights, mut counts) = (1.0_f64, 0.0_f64, 0.0_f64);
        for k in 0..steps {
            weights += weight;
            counts += f64::from(k) * weight;
            weight *= self.ratio;
        }
        let k = f64::from(steps);
        let rounding = weights * self.row
            + counts * self.roundings * self.unit * self.largest
            + (k + 3.0) * self.unit * (self.scale + weights * self.largest)
            + weight * most * (k * self.roundings + 4.0) * self.unit;
        [if steps == self.end { 0.0 } else { weight * radius }, rounding]
    }
}

impl<const C: usize> FifRef<'_, C> {
    /// The error of a table that would leave this bound.
    pub(crate) fn too_deep(&self, bound: f64) -> FifError {
        FifError::TableDepth { alpha: self.steepest(), steps: MOST, bound }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Fif, cochran_2000};

    #[test]
    fn deviation_enclosure_is_tight() {
        // f of the source vanishes at both ends and reaches 4/3.
        let t = Composites::new(cochran_2000::f().unwrap().view()).unwrap();
        assert_eq!((t.radix, t.digits, t.steepest), (1024, 10, 1.0 / 1024.0 * (1.0 + 6.0 * f64::EPSILON)));
        assert!(t.deviation.contains(0.0) && t.deviation.contains(4.0 / 3.0) && t.deviation.width() < 1.34);
    }

    #[test]
    fn rows_fit_the_cache() {
        assert_eq!(
            [size(2, 32), size(2, 40), size(3, 24), size(4096, 24)],
            [(10, 1024), (8, 256), (6, 729), (1, 4096)]
        );
        let uneven = Fif::affine(&[0.0, 0.4, 1.4, 2.0], &[0.0; 4], &[0.4, -0.6, 0.5]).unwrap();
        assert!(Composites::new(uneven.view()).is_none());
    }
}
