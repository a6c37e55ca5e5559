//! Value, slope, integral and higher derivatives at one address, from a table of composites.

use alloc::vec::Vec;
use asperity_core::Interval;

use crate::numeric::estimate::Bounded;
use crate::numeric::polynomial::{UNIT, falling, magnitudes, substitute};
use crate::system::chord::Chord;
use crate::system::fif::{Fif, FifRef};
use crate::table::composite::{Composite, Composites, MOST, Series, greater, narrow};
use crate::table::jet::jet::{Jet, Scales, Sums};
use crate::table::jet::primitive::Primitive;
use crate::table::uniform::{LEAST, digit, fraction};

/// A smooth function with its derivatives and its integral, which use the same digits of a point.
///
/// With `r` composites `v(L_e u) = A_e v(u) + P_e(u)` of `v = f − chord`, over the domain scaled to
/// `[0, 1]`, the digits `e_1, e_2, …` of a position `t` to the radix `r`, the remainders `u_1, u_2,
/// …`, and the center `c` of a cell:
///
/// ```text
/// v^(m)(t) = Σ_k W_k r^(mk) P^(m)(u_k)                               W_k = A_{e_1} … A_{e_{k−1}},  P = P_{e_k}
/// ∫_{1/2}^t v = Σ_k W_k r^(1−k) (∫_{1/2}^c v + (1/r) ∫_{1/2}^{u_k} P)
/// ```
///
/// Every sum has a separate number of terms, determined by the tolerance. The slope needs the most.
/// The integral gains a factor `r` more with each digit; its last term is linear in `u_k`.
///
/// Not in the sources: eq. 29–36 of Cochran, Lewis, Hart 2000 create systems of derivative and
/// integral, each with its own addresses.
#[derive(Clone, Debug)]
pub(crate) struct Jets<const C: usize> {
    /// Polynomials in `u − 1/2`.
    pub(crate) table: Vec<Composite<C>>,
    pub(crate) primitive: Primitive,
    pub(crate) radix: u64,
    pub(crate) scales: Scales<f64, C>,
    /// Numbers of terms of the sums for the integral, the value and the slope, in nondecreasing
    /// order.
    pub(crate) terms: [u32; 3],
    /// Remainder after the first digit, or distance to the next one, at the knots and around them.
    ///
    /// In units of 2⁻⁶⁴.
    pub(crate) near: u64,
    pub(crate) origin: f64,
    pub(crate) width: f64,
    pub(crate) per_width: f64,
    pub(crate) chord: Chord,
    /// Replacements for the tails of value and slope, for nonzero and for zero remaining digits.
    pub(crate) tails: [[f64; 2]; 2],
    pub(crate) orders: Vec<Order>,
    /// Error bounds away from knots.
    pub(crate) away: Jet,
}

impl<const C: usize> Jets<C> {
    /// Returns `None` if 64 steps leave more than `tolerance` in a component, or the rounding error
    /// if larger.
    ///
    /// `count` derivatives are continuous.
    pub(crate) fn new(
        system: FifRef<'_, C>,
        made: &Composites<C>,
        count: usize,
        tolerance: f64,
    ) -> Option<Self> {
        if count == 0 {
            return None;
        }
        let (chord, domain) = (system.chord(), system.domain());
        let (width, radix) = (domain.width(), made.radix as f64);
        let largest = largest(&made.table);
        let (mut orders, mut scale, mut unit, mut least) = (Vec::new(), 1.0, 1.0, 1);
        let center = |row: &Composite<C>| Composite { a: row.a, c: substitute(&row.c, 1.0, 0.5) };
        let table: Vec<_> = made.table.iter().map(center).collect();
        let primitive = Primitive::new(made, &table, &chord);
        let integral = primitive.series.depth(tolerance / width).ok()?;
        least = least.max(integral.steps);
        for m in 0..=count {
            let sum = Sum { made, largest: largest.get(m).copied().unwrap_or(0.0), order: m, scale };
            let Some((series, tail)) = sum.series(&chord) else { break };
            // Higher derivatives have the accuracy of 64 steps.
            let steps = match series.depth(tolerance * unit) {
                Ok(depth) => depth.steps,
                Err(_) if m > 1 => series.end.min(MOST),
                Err(_) => return None,
            };
            least = least.max(steps);
            // The chord, the power of the width and the product with it.
            let rounding = 4.0 * (m + 1) as f64 * UNIT * (series.tail.magnitude() + series.scale);
            let bound = 1.001 * (series.bound(least) + rounding) / unit;
            orders.push(Order { terms: least, tail, bound });
            scale *= radix;
            unit *= width;
        }
        let [value, slope, ..] = *orders.as_slice() else { return None };
        let away = Jet {
            value: value.bound,
            slope: slope.bound,
            integral: 1.001 * width * (integral.bound + 4.0 * UNIT * primitive.series.scale),
        };
        let per_width = 1.0 / width;
        // The cast saturates: far from zero every point is near a knot, in units of its last place.
        let near = 8.0 * f64::EPSILON * domain.magnitude() * per_width * radix;
        Some(Self {
            table,
            primitive,
            radix: made.radix as u64,
            scales: Scales::new(radix),
            terms: [integral.steps, value.terms, slope.terms],
            near: (near * 18_446_744_073_709_551_616.0) as u64,
            origin: domain.lo,
            width,
            per_width,
            chord,
            tails: [value.tail, slope.tail],
            orders,
            away,
        })
    }

    /// The position in the domain and its fraction.
    ///
    /// `None` near knots, outside, for NaN and if 64 bits are not sufficient.
    #[inline(always)]
    pub(crate) fn place(&self, x: f64) -> Option<(f64, u64)> {
        let t = (x - self.origin) * self.per_width;
        if !(LEAST..1.0).contains(&t) {
            return None;
        }
        let rest = fraction(t);
        let first = rest.wrapping_mul(self.radix);
        (first.wrapping_add(self.near) > self.near.saturating_mul(2)).then_some((t, rest))
    }

    /// The row of the next digit with its index, and the remainder, from the center of the cell.
    #[inline(always)]
    pub(crate) fn next(&self, rest: &mut u64) -> Option<(&Composite<C>, usize, f64)> {
        let index = digit(rest, self.radix);
        Some((self.table.get(index)?, index, from_middle(*rest)))
    }

    /// The jet by digits; `None` near knots, outside, for NaN and if 64 bits are not sufficient.
    #[inline(always)]
    pub(crate) fn sum(&self, x: f64) -> Option<Jet> {
        let (t, mut rest) = self.place(x)?;
        let mut sums = Sums::new(self.chord_jet(t), 1.0);
        let [integral, value, slope] = self.terms;
        // The first term separately, whose products with ones the compiler removes.
        if integral > 1 {
            let (row, index, z) = self.next(&mut rest)?;
            sums.all(&row.c, row.a, *self.primitive.middles.get(index)?, z, &self.scales);
            for _ in 2..integral {
                let (row, index, z) = self.next(&mut rest)?;
                sums.all(&row.c, row.a, *self.primitive.middles.get(index)?, z, &self.scales);
            }
        }
        let (row, index, z) = self.next(&mut rest)?;
        sums.end_integral(&row.c, *self.primitive.middles.get(index)?, z, &self.scales);
        sums.value_and_slope(&row.c, row.a, z, &self.scales);
        for _ in integral..value {
            let (row, _, z) = self.next(&mut rest)?;
            sums.value_and_slope(&row.c, row.a, z, &self.scales);
        }
        let zeros = usize::from(rest == 0);
        sums.end_value(self.tails[0][zeros]);
        for _ in value..slope {
            let (row, _, z) = self.next(&mut rest)?;
            sums.slope(&row.c, row.a, z, &self.scales);
        }
        let zeros = usize::from(rest == 0);
        sums.end_slope(self.tails[1][zeros]);
        Some(sums.jet(self.width, self.per_width))
    }

    /// The jet of the chord at a position, with slope and integral in units of the domain.
    #[inline(always)]
    fn chord_jet(&self, t: f64) -> Jet {
        let Chord { start, rise } = self.chord;
        Jet {
            value: start + rise * t,
            slope: rise,
            integral: t * (start + 0.5 * rise * t) + self.primitive.half,
        }
    }

    /// The integral at a point that [`Jets::sum`] does not cover, including NaN.
    pub(crate) fn integral_at(&self, x: f64) -> Bounded {
        let t = (x - self.origin) * self.per_width;
        if x.is_nan() {
            Bounded::NAN
        } else if t <= 0.0 {
            Bounded { value: 0.0, bound: 0.0 }
        } else {
            Bounded { value: self.width * self.integral(t), bound: self.away.integral }
        }
    }

    /// The integral alone, anywhere right of the left end.
    fn integral(&self, t: f64) -> f64 {
        if t >= 1.0 {
            return self.chord.start + 0.5 * self.chord.rise + self.primitive.whole;
        }
        let mut rest = (t * 18_446_744_073_709_551_616.0) as u64;
        let mut sums = Sums::new(self.chord_jet(t), 1.0);
        for _ in 1..self.terms[0] {
            let Some((row, index, z)) = self.next(&mut rest) else { break };
            let middle = self.primitive.middles.get(index).copied().unwrap_or(0.0);
            sums.all(&row.c, row.a, middle, z, &self.scales);
        }
        if let Some((row, index, z)) = self.next(&mut rest) {
            let middle = self.primitive.middles.get(index).copied().unwrap_or(0.0);
            sums.end_integral(&row.c, middle, z, &self.scales);
        }
        sums.jet(1.0, 1.0).integral
    }
}

/// A fraction minus 1/2, exact except for the last 11 bits.
#[inline(always)]
fn from_middle(rest: u64) -> f64 {
    ((rest ^ 1 << 63) as i64 >> 11) as f64 * UNIT
}

/// The sum for one derivative.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Order {
    pub(crate) terms: u32,
    pub(crate) tail: [f64; 2],
    /// Error bound away from knots.
    pub(crate) bound: f64,
}

/// All derivatives that are continuous.
pub(crate) fn derivatives<const C: usize>(system: FifRef<'_, C>) -> Vec<Fif<C>> {
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

/// The maximum of `Σ_k k!/(k − m)! |c_k|` of any row, for each order `m`.
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
    /// The series, and the replacement of its tail for nonzero and for zero remaining digits.
    ///
    /// `None` if it diverges.
    pub(crate) fn series(&self, chord: &Chord) -> Option<(Series, [f64; 2])> {
        let Self { made, order: m, largest, scale } = *self;
        let (ratio, largest) = (made.steepest * scale, scale * largest);
        // Shifting the origin to the center; Horner's rule and 11 unused bits of u, for every
        // coefficient up to C times with each derivative.
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

impl<const C: usize> Jets<C> {
    /// `f, f′, …, f^(M−1)` at `x`, NaN beyond the continuous ones; `None` as in [`Jets::sum`].
    pub(crate) fn derivatives<const M: usize>(&self, x: f64) -> Option<[Bounded; M]> {
        let mut out = [Bounded::NAN; M];
        let (t, mut rest) = self.place(x)?;
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
                // Horner's rule divides by z: the remainder is the next coefficient of the
                // expansion there.
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
        Some(out)
    }
}
