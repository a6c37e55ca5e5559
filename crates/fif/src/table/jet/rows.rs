//! Value, slope, integral and higher derivatives at one address, by a table of composites.

use alloc::vec::Vec;

use crate::numeric::interval::Bounded;
use crate::numeric::polynomial::{UNIT, substitute};
use crate::system::chord::Chord;
use crate::system::fif::System;
use crate::system::map::Piece;
use crate::table::composite::{Composite, Composites};
use crate::table::jet::jet::Jet;
use crate::table::jet::orders::{Order, Sum, largest};
use crate::table::jet::primitive::Primitive;
use crate::table::jet::sums::{Scales, Sums};
use crate::table::truncation::MOST;
use crate::table::uniform::{LEAST, digit, fraction};

/// A smooth function with its derivatives and its integral, which share the digits of a point.
///
/// With `r` composites `v(L_e u) = A_e v(u) + P_e(u)` of `v = f − chord`, over the domain scaled to `[0, 1]`, the digits
/// `e_1, e_2, …` of a place `t` to the radix `r`, `u_1, u_2, …` left after them, and `c` the middle of a cell:
///
/// ```text
/// v^(m)(t) = Σ_k W_k r^(mk) P^(m)(u_k)                               W_k = A_{e_1} … A_{e_{k−1}},  P = P_{e_k}
/// ∫_{1/2}^t v = Σ_k W_k r^(1−k) (∫_{1/2}^c v + (1/r) ∫_{1/2}^{u_k} P)
/// ```
///
/// Every sum has its own number of terms, fixed by the tolerance. The slope has the most, the integral gains `r` more with
/// each digit; its last term is linear in `u_k`.
///
/// Not in the sources: eq. 29–36 of Cochran, Lewis, Hart 2000 make systems of derivative and integral, each with
/// addresses of its own.
#[derive(Clone, Debug)]
pub(crate) struct Jets<const C: usize> {
    /// Polynomials in `u − 1/2`.
    pub(crate) table: Vec<Composite<C>>,
    pub(crate) primitive: Primitive,
    pub(crate) radix: u64,
    pub(crate) scales: Scales<f64, C>,
    /// Terms of the sums for the integral, the value and the slope, none fewer than the one before.
    pub(crate) terms: [u32; 3],
    /// Remainder after the first digit, or lack to the next one, at the knots and around them, in units of 2⁻⁶⁴.
    pub(crate) near: u64,
    pub(crate) origin: f64,
    pub(crate) width: f64,
    pub(crate) per_width: f64,
    pub(crate) chord: Chord,
    /// Stand-ins for the tails of value and slope, where digits are left and where they are zeros.
    pub(crate) tails: [[f64; 2]; 2],
    pub(crate) orders: Vec<Order>,
    /// Bounds of the errors away from knots.
    pub(crate) away: Jet,
}

impl<const C: usize> Jets<C> {
    /// `None` when 64 steps leave more than `tolerance`, or the rounding error where that is more, of a component; `count`
    /// derivatives are continuous.
    pub(crate) fn new<S: AsRef<[Piece<C>]>>(
        system: &System<S, C>,
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
        let centre = |row: &Composite<C>| Composite { a: row.a, c: substitute(&row.c, 1.0, 0.5) };
        let table: Vec<_> = made.table.iter().map(centre).collect();
        let primitive = Primitive::new(made, &table, &chord);
        let integral = primitive.series.depth(tolerance / width).ok()?;
        least = least.max(integral.steps);
        for m in 0..=count {
            let sum = Sum { made, largest: largest.get(m).copied().unwrap_or(0.0), order: m, scale };
            let Some((series, tail)) = sum.series(&chord) else { break };
            // Higher derivatives are as good as 64 steps make them.
            let steps = match series.depth(tolerance * unit) {
                Ok(depth) => depth.steps,
                Err(_) if m > 1 => series.end.min(MOST),
                Err(_) => return None,
            };
            least = least.max(steps);
            // The chord, the width's power and the product with it.
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

    /// The place in the domain and its fraction; `None` near knots, outside, for NaN and where 64 bits do not hold it.
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

    /// The row of the next digit with its number, and what is left, from the middle of the cell.
    #[inline(always)]
    pub(crate) fn next(&self, rest: &mut u64) -> Option<(&Composite<C>, usize, f64)> {
        let index = digit(rest, self.radix);
        Some((self.table.get(index)?, index, from_middle(*rest)))
    }

    /// The jet by digits; `None` near knots, outside, for NaN and where 64 bits do not hold the place.
    #[inline(always)]
    pub(crate) fn sum(&self, x: f64) -> Option<Jet> {
        let (t, mut rest) = self.place(x)?;
        let mut sums = Sums::new(self.chord_jet(t), 1.0);
        let [integral, value, slope] = self.terms;
        // The first term apart, whose products with ones the compiler leaves out.
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

    /// The jet of the chord at a place, with slope and integral in units of the domain.
    #[inline(always)]
    fn chord_jet(&self, t: f64) -> Jet {
        let Chord { start, rise } = self.chord;
        Jet {
            value: start + rise * t,
            slope: rise,
            integral: t * (start + 0.5 * rise * t) + self.primitive.half,
        }
    }

    /// The integral at a point that [`Jets::sum`] leaves out, NaN included.
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

/// A fraction less 1/2, exactly but for the last 11 bits.
#[inline(always)]
fn from_middle(rest: u64) -> f64 {
    ((rest ^ 1 << 63) as i64 >> 11) as f64 * UNIT
}
