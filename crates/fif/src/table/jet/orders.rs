//! The sums for the derivatives of a function over its table of composites: how far they go, what they leave, their values.

use alloc::vec::Vec;

use crate::numeric::interval::{Bounded, Interval};
use crate::numeric::polynomial::{UNIT, falling, magnitudes};
use crate::system::chord::Chord;
use crate::system::fif::Fif;
use crate::system::map::Piece;
use crate::system::storage::FifBuf;
use crate::table::composite::{Composite, Composites, narrow};
use crate::table::jet::table::FastJets;
use crate::table::truncation::Series;

/// The sum for one derivative.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Order {
    pub(crate) terms: u32,
    pub(crate) tail: [f64; 2],
    /// Bound of the error away from knots.
    pub(crate) bound: f64,
}

impl<S: AsRef<[Piece<C>]>, const C: usize> FastJets<S, C> {
    /// `f, f′, …, f^(M−1)` at `x`, with the bounds of their errors, as [`FastJets::jet`].
    ///
    /// NaN for derivatives beyond [`Fif::differentiability`].
    ///
    /// ```
    /// use asperity_fif::{FastJets, FixedFif, paper};
    /// let twice: FixedFif<2, 4> = paper::f_hat()?.integral(0.0)?;
    /// let jets = FastJets::new(twice, 1e-12)?;
    /// let [_, first, second, third] = jets.derivatives(0.3);
    /// assert!((first.value - paper::f_hat()?.evaluate(0.3, 1e-14).value).abs() <= first.bound + 1e-14);
    /// assert!((second.value - paper::f()?.evaluate(0.3, 1e-14).value).abs() <= second.bound + 1e-14);
    /// assert!(third.value.is_nan());
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    #[must_use]
    pub fn derivatives<const M: usize>(&self, x: f64) -> [Bounded; M] {
        let mut out = [Bounded::NAN; M];
        let Some((t, mut rest)) = self.place(x) else {
            for (m, out) in out.iter_mut().enumerate() {
                *out = match m.checked_sub(1) {
                    None => self.system.evaluate(x, 0.0),
                    Some(m) => self.derivatives.get(m).map_or(Bounded::NAN, |f| f.evaluate(x, 0.0)),
                };
            }
            return out;
        };
        let mut weights = [1.0; M];
        let (mut scale, mut factorial) = (1.0, 1.0);
        for (m, weight) in weights.iter_mut().enumerate() {
            factorial *= if m > 0 { m as f64 } else { 1.0 };
            *weight = scale * factorial;
            scale *= self.scales.radix;
        }
        let tail = weights;
        for (m, (out, order)) in out.iter_mut().zip(&self.orders).enumerate() {
            let value = match m {
                0 => self.chord.at(t),
                1 => self.chord.rise,
                _ => 0.0,
            };
            *out = Bounded { value, bound: order.bound };
        }
        let most = self.orders.iter().take(M).fold(0, |most, order| most.max(order.terms));
        for k in 0..most {
            let Some((row, _, z)) = self.next(&mut rest) else { break };
            let mut taylor = row.c;
            let mut scale = row.a;
            let sums = out.iter_mut().zip(&mut weights).zip(&tail).zip(&self.orders).enumerate();
            for (m, (((out, weight), unit), order)) in sums {
                // Horner's rule divides by z: what remains is the next coefficient of the expansion there.
                let mut p = 0.0;
                for c in taylor.iter_mut().skip(m).rev() {
                    p = p * z + *c;
                    *c = p;
                }
                if k < order.terms {
                    out.value += *weight * p;
                    *weight *= scale;
                }
                if k + 1 == order.terms {
                    out.value += *weight / unit * if rest == 0 { order.tail[1] } else { order.tail[0] };
                }
                scale *= self.scales.radix;
            }
        }
        let mut unit = 1.0;
        for out in &mut out {
            out.value *= unit;
            unit *= self.per_width;
        }
        out
    }
}

/// All derivatives that are continuous.
pub(crate) fn derivatives<S: AsRef<[Piece<C>]>, const C: usize>(system: &Fif<S, C>) -> Vec<FifBuf<C>> {
    let mut all: Vec<FifBuf<C>> = Vec::new();
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
    table.iter().fold([0.0; C], |mut most, row| {
        for (most, size) in most.iter_mut().zip(magnitudes(&row.c)) {
            *most = most.max(size);
        }
        most
    })
}

/// What the sum for a derivative is made of; `scale` is `rᵐ`.
pub(crate) struct Sum<'a, const C: usize> {
    pub(crate) made: &'a Composites<Vec<Composite<C>>, C>,
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
            let rows = made.table.iter().map(|row| (row.a * scale, differentiate(&row.c, m, scale)));
            let widest = 1.001 * (largest + row) / (1.0 - ratio);
            let tail = narrow(Interval::new(-widest, widest), &rows, row + gamma * largest, roundings);
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

/// Coefficients of the `m`-th derivative times `scale`.
fn differentiate<const C: usize>(c: &[f64; C], m: usize, scale: f64) -> [f64; C] {
    let mut out = [0.0; C];
    for (k, (out, c)) in out.iter_mut().zip(c.iter().skip(m)).enumerate() {
        *out = scale * falling(k + m, m) * c;
    }
    out
}
