//! Values and slopes of a smooth function by composed maps, several levels per step.

use alloc::vec::Vec;
use asperity_core::Interval;
use core::fmt::Debug;
#[cfg(feature = "simd")]
use fearless_simd::{Bytes, Select, Simd, SimdBase, f64x8, u32x16};

#[cfg(feature = "simd")]
use crate::numeric::floor::WHOLE;
use crate::numeric::floor::floor;
use crate::numeric::polynomial::{UNIT, substitute};
use crate::surface::height_field::range_table::RangeTable;
use crate::system::fif::FifRef;
use crate::table::composite::{Composite, Composites};

/// Lanes of a packet: two registers of AVX2, to hide latency.
#[cfg(feature = "simd")]
pub(crate) const LANES: usize = 8;

/// Maximum number of steps of one evaluation.
pub(crate) const STEPS: usize = 64;

/// The rows of a table, of any degree.
pub trait Rows: Sized + Clone + Debug {
    /// `[f(x), f′(x)]` after this number of steps.
    ///
    /// `x` is within the rounding error of the ray, given as the fraction of the domain to its
    /// left.
    fn jet(table: &JetTable<Self>, part: f64, steps: usize) -> [f64; 2];

    /// [`Rows::jet`] with SIMD, with a number of steps per lane, at most `most`.
    #[cfg(feature = "simd")]
    fn jets<I: Simd>(table: &JetTable<Self>, part: f64x8<I>, steps: f64x8<I>, most: usize) -> [f64x8<I>; 2];

    /// Enclosures of values and slopes between two fractions of the domain, from ranges over the
    /// cells of the whole.
    ///
    /// `None` if the fractions span more than two cells of the first step.
    fn finer(table: &JetTable<Self>, ranges: &RangeTable, parts: [f64; 2]) -> Option<[Interval; 2]>;

    /// Bytes of the rows.
    fn bytes(&self) -> usize;
}

/// All composites of a few maps of a system on equal knots, and their derivatives, for any number
/// of steps.
///
/// ```text
/// f(x) = chord(x) + Σ_k W_k P_{e_{k+1}}(u_{k+1}) + W_K v       |error| ≤ max|A|^K sup|f − chord − v| + rounding
/// ```
///
/// `e_k` are the digits of `(x − x_0)/(x_N − x_0)` in the radix of the table, `u_k` is the
/// remainder, and `W_k` the product of the scalings. The slope is the sum of the derivatives, and
/// the middle of its range replaces the tail. The fraction is an `f64`, so the value is that of a
/// point within two units in the last place of the width of the domain.
#[derive(Clone, Debug)]
pub struct JetTable<R> {
    /// One per cell of the first step, and one for the end of the domain.
    entries: R,
    radix: f64,
    /// The left end of the domain and the reciprocal of its width.
    origin: f64,
    per_width: f64,
    /// Value at the left end and rise over the domain.
    chord: [f64; 2],
    /// The middle of the range of deviations from the chord.
    tail: f64,
    /// The middle of the range of their slopes over a cell of the first step.
    tail_slope: f64,
    /// Bounds of the errors of value and slope after 0, 1, … steps.
    errors: [[f64; 2]; STEPS + 1],
    /// Number of steps at which rounding exceeds truncation, for value and slope.
    enough: [usize; 2],
}

impl<const C: usize> JetTable<Vec<Composite<C>>> {
    /// Returns `None` unless the knots are equally spaced and the sums of values and slopes
    /// converge.
    pub(crate) fn new(value: FifRef<'_, C>, slopes: Interval) -> Option<Self> {
        let Composites { table, radix, steepest, largest, error, deviation, .. } = Composites::new(value)?;
        let wide = radix as f64;
        let width = value.domain().width();
        let (y0, rise) = (value.chord().start, value.chord().rise);
        let slopes = slopes.scaled(width).sum(Interval::new(-rise, -rise));
        let steep = steepest * wide;
        let converges = steepest < 1.0 && steep < 1.0;
        // Horner's rule rounds twice per step; a derivative contains each coefficient up to C
        // times.
        let noise = error + 4.0 * C as f64 * UNIT * largest;
        let slope_noise = C as f64 * wide * noise;
        if !(converges && noise.is_finite() && slope_noise.is_finite() && slopes.width().is_finite()) {
            return None;
        }
        let scale = y0.abs() + rise.abs() + 2.0 * deviation.magnitude() + largest;
        let slope_scale = rise.abs() + 2.0 * slopes.magnitude() + C as f64 * wide * largest;
        let mut errors = [[f64::INFINITY; 2]; STEPS + 1];
        let mut left = [0.5 * deviation.width(), 0.5 * slopes.width()];
        let (mut weight, mut weights) = ([1.0; 2], [0.0; 2]);
        for (k, entry) in errors.iter_mut().enumerate() {
            let rounding = UNIT * (2 * k + 8) as f64;
            let value = left[0] + weights[0] * noise + rounding * (weights[0] + 1.0) * scale;
            let slope = left[1] + weights[1] * slope_noise + rounding * (weights[1] + 1.0) * slope_scale;
            *entry = [1.0001 * value, 1.0001 * slope / width];
            for (i, factor) in [steepest, steep].into_iter().enumerate() {
                left[i] *= factor;
                weights[i] += weight[i];
                weight[i] *= factor;
            }
        }
        let enough = [0, 1].map(|i| {
            let last = errors.last().map_or(f64::INFINITY, |e| e[i]);
            errors.iter().position(|e| e[i] <= 1.05 * last).unwrap_or(STEPS)
        });
        // Near-critical systems: no table rather than one that is worse than plain evaluation.
        let rounding = |i: usize, scale: f64| errors.get(enough[i]).is_some_and(|e| e[i] <= 1e-8 * scale);
        if !(rounding(0, scale) && rounding(1, slopes.magnitude() / width)) {
            return None;
        }
        // One more at the end of the domain, for the position that begins there: the last
        // polynomial shifted by a cell.
        let mut table = table;
        let end = table.last().map(|last| Composite { a: last.a, c: substitute(&last.c, 1.0, 1.0) })?;
        table.push(end);
        Some(Self {
            entries: table,
            radix: wide,
            origin: value.domain().lo,
            per_width: 1.0 / width,
            chord: [y0, rise],
            tail: deviation.middle(),
            tail_slope: slopes.middle() / wide,
            errors,
            enough,
        })
    }
}

impl<R: Rows> JetTable<R> {
    #[inline(always)]
    pub(crate) fn jet(&self, part: f64, steps: usize) -> [f64; 2] {
        R::jet(self, part, steps)
    }

    #[cfg(feature = "simd")]
    #[inline(always)]
    pub(crate) fn in_lanes<I: Simd>(&self, part: f64x8<I>, steps: f64x8<I>, most: usize) -> [f64x8<I>; 2] {
        R::jets(self, part, steps, most)
    }

    pub(crate) fn finer(&self, ranges: &RangeTable, parts: [f64; 2]) -> Option<[Interval; 2]> {
        R::finer(self, ranges, parts)
    }

    pub(crate) fn bytes(&self) -> usize {
        self.entries.bytes() + size_of::<Self>()
    }

    /// The fraction of the domain to the left of `x`.
    #[inline]
    pub(crate) fn part(&self, x: f64) -> f64 {
        (x - self.origin) * self.per_width
    }

    /// Error bound of a value after this number of steps.
    #[inline]
    pub(crate) fn error(&self, steps: usize) -> f64 {
        self.errors.get(steps).map_or(f64::INFINITY, |e| e[0])
    }

    /// The number of steps for a value to the rounding error, and its bound.
    #[inline]
    pub(crate) fn finest(&self) -> (usize, f64) {
        (self.enough[0], self.error(self.enough[0]))
    }

    /// The number of steps after which cells are at most this fraction of the domain.
    ///
    /// It is smaller if more steps do not improve the slope.
    #[inline]
    pub(crate) fn cells_within(&self, part: f64) -> usize {
        let (mut steps, mut finer) = (0, part);
        if part == 0.0 {
            return self.enough[1];
        }
        while finer < 1.0 && steps < self.enough[1] {
            finer *= self.radix;
            steps += 1;
        }
        steps
    }
}

impl<const C: usize> Rows for Vec<Composite<C>> {
    #[inline(always)]
    fn jet(table: &JetTable<Self>, part: f64, steps: usize) -> [f64; 2] {
        let t = if part > 0.0 { part } else { 0.0 };
        let t = if t < 1.0 { t } else { 1.0 };
        let mut rest = t;
        let (mut value, mut slope) = (table.chord[0] + table.chord[1] * t, table.chord[1]);
        let (mut weight, mut steep) = (1.0, table.radix);
        for _ in 0..steps {
            let place = rest * table.radix;
            let (whole, number) = floor(place);
            rest = place - whole;
            let Some(entry) = table.entries.get(number) else { break };
            let Some((&last, lower)) = entry.c.split_last() else { break };
            let (mut p, mut rise) = (last, 0.0);
            for (k, &c) in lower.iter().rev().enumerate() {
                rise = if k == 0 { p } else { rise * rest + p };
                p = p * rest + c;
            }
            value += weight * p;
            slope += steep * rise;
            weight *= entry.a;
            steep *= entry.a * table.radix;
        }
        value += weight * table.tail;
        slope += steep * table.tail_slope;
        [value, slope * table.per_width]
    }

    #[cfg(feature = "simd")]
    #[inline(always)]
    fn jets<I: Simd>(table: &JetTable<Self>, part: f64x8<I>, steps: f64x8<I>, most: usize) -> [f64x8<I>; 2] {
        let simd = part.simd;
        let (zero, one) = (f64x8::splat(simd, 0.0), f64x8::splat(simd, 1.0));
        let t = part.simd_gt(zero).select(part, zero);
        let t = t.simd_lt(one).select(t, one);
        let mut rest = t;
        let [start, rise] = table.chord;
        let (mut value, mut slope) = (t * rise + start, f64x8::splat(simd, rise));
        let (mut weight, mut steep) = (one, f64x8::splat(simd, table.radix));
        for k in 0..most {
            let place = rest * table.radix;
            let (whole, numbers) = floors(place);
            rest = place - whole;
            let mut rows = [&Composite { a: 0.0, c: [0.0; C] }; LANES];
            for (row, number) in rows.iter_mut().zip(numbers) {
                if let Some(entry) = table.entries.get(number) {
                    *row = entry;
                }
            }
            let [r0, r1, r2, r3, r4, r5, r6, r7] = rows;
            let (mut p, mut bend) = (zero, zero);
            for j in (0..C).rev() {
                let c = [r0.c[j], r1.c[j], r2.c[j], r3.c[j], r4.c[j], r5.c[j], r6.c[j], r7.c[j]];
                let c = f64x8::from_slice(simd, &c);
                if j + 2 == C {
                    bend = p;
                } else if j + 2 < C {
                    bend = bend * rest + p;
                }
                p = if j + 1 == C { c } else { p * rest + c };
            }
            let a = f64x8::from_slice(simd, &[r0.a, r1.a, r2.a, r3.a, r4.a, r5.a, r6.a, r7.a]);
            let next = (value + weight * p, slope + steep * bend, weight * a, steep * (a * table.radix));
            if k == 0 {
                (value, slope, weight, steep) = next;
            } else {
                let on = steps.simd_gt(f64x8::splat(simd, k as f64));
                (value, slope) = (on.select(next.0, value), on.select(next.1, slope));
                (weight, steep) = (on.select(next.2, weight), on.select(next.3, steep));
            }
        }
        value += weight * table.tail;
        slope += steep * table.tail_slope;
        [value, slope * table.per_width]
    }

    fn finer(table: &JetTable<Self>, ranges: &RangeTable, parts: [f64; 2]) -> Option<[Interval; 2]> {
        let places = parts.map(|part| part.clamp(0.0, 1.0) * table.radix);
        let most = table.entries.len().checked_sub(2)?;
        let [first, last] = places.map(|place| floor(place).1.min(most));
        let entries = table.entries.get(first..=last).filter(|entries| entries.len() <= 2)?;
        let number = |x: f64| Interval::new(x, x);
        let (mut values, mut slopes) = (Interval::EMPTY, Interval::EMPTY);
        for (i, entry) in entries.iter().enumerate() {
            let ends = places.map(|place| (place - (first + i) as f64).clamp(0.0, 1.0));
            let [f, s] = ranges.between(ends);
            // Deviations from the chord over the image of the domain, and over the cell.
            let over = |start: f64, rise: f64, t: [f64; 2]| {
                let [a, b] = t.map(|t| start + rise * t);
                if a < b { Interval::new(a, b) } else { Interval::new(b, a) }
            };
            let [start, rise] = table.chord;
            let chord = over(start, rise, ends);
            let v = f.sum(Interval::new(-chord.hi, -chord.lo)).scaled(entry.a);
            let v_slope = s.scaled(1.0 / table.per_width).sum(number(-rise)).scaled(entry.a);
            let (middle, half) = (0.5 * (ends[0] + ends[1]), 0.5 * (ends[1] - ends[0]));
            let (mut p, mut p_slope, mut bend) = (0.0, 0.0, 0.0);
            for (k, &c) in entry.c.iter().enumerate().rev() {
                p_slope = p_slope * middle + p;
                p = p * middle + c;
                bend += (k * k.saturating_sub(1)) as f64 * c.abs();
            }
            let p_slope = number(p_slope).inflated(bend * half);
            let p = number(p).inflated(half * p_slope.magnitude());
            let own = over(start, rise, parts.map(|part| part.clamp(0.0, 1.0)));
            values = values.hull(own.sum(p).sum(v));
            slopes = slopes
                .hull(number(rise).sum(p_slope.sum(v_slope).scaled(table.radix)).scaled(table.per_width));
        }
        let [value_error, slope_error] = *table.errors.last()?;
        Some([values.inflated(2.0 * value_error), slopes.inflated(2.0 * slope_error)])
    }

    fn bytes(&self) -> usize {
        size_of_val(self.as_slice())
    }
}

/// [`floor`] in lanes.
#[cfg(feature = "simd")]
#[inline(always)]
fn floors<I: Simd>(x: f64x8<I>) -> (f64x8<I>, [usize; LANES]) {
    let sum = (x - 0.5) + WHOLE;
    let bits: u32x16<I> = sum.bitcast();
    let mut numbers = [0; LANES];
    for (number, [low, _]) in numbers.iter_mut().zip(bits.as_slice().as_chunks().0) {
        *number = *low as usize;
    }
    (sum - WHOLE, numbers)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::height_field::curve::Curve;
    use crate::{Fif, cochran_2000};

    fn check<const C: usize, const D: usize>(value: FifRef<'_, C>, slope: &Fif<D>) -> [f64; 2] {
        let table = JetTable::new(value, slope.range()).unwrap();
        let (domain, mut finest) = (value.domain(), [0.0_f64; 2]);
        for i in 0..=2000 {
            // Also the ends, points outside and some knots.
            let x = domain.lo + domain.width() * (f64::from(i) * 0.618_033_988_749_895).fract();
            let x = if i % 50 == 0 { domain.lo + domain.width() * f64::from(i - 100) / 1800.0 } else { x };
            let near = 4.0 * f64::EPSILON * domain.magnitude();
            let (f, d) = (value.evaluate(x, 0.0), slope.evaluate(x, 0.0));
            // A slope is that of a nearby point.
            let moved = slope.extrema_over(
                domain.lo.max(domain.hi.min(x)) - near,
                domain.lo.max(domain.hi.min(x)) + near,
                1e-9,
            );
            let moved = moved.unwrap().enclosure().width() + 1e-9;
            for steps in (0..=8).chain([STEPS / 2, STEPS]) {
                let (got, error) = (table.jet(table.part(x), steps), table.errors[steps]);
                let off = [(got[0] - f.value).abs(), (got[1] - d.value).abs()];
                let slack = [f.bound + near * slope.range().magnitude(), d.bound + moved];
                assert!(off[0] <= error[0] + slack[0], "{x} after {steps}: {off:?}, {error:?}");
                assert!(off[1] <= error[1] + slack[1], "{x} after {steps}: {off:?}, {error:?}");
                if steps == table.enough[0] {
                    finest = [finest[0].max(off[0]), error[0]];
                }
            }
        }
        finest
    }

    #[test]
    fn jets_are_within_their_bounds_after_any_number_of_steps() {
        let hermite = Fif::hermite(
            &[-1.0, 0.0, 1.0, 2.0],
            &[0.3, 1.0, -0.5, 2.0],
            &[1.0, 0.0, -1.0, 0.5],
            &[0.3, -0.2, 0.1],
        )
        .unwrap();
        let worst = [
            check(cochran_2000::f_hat().unwrap().view(), &cochran_2000::f().unwrap().owned()),
            check(cochran_2000::g_hat().unwrap().view(), &cochran_2000::g().unwrap().owned()),
            check::<4, 3>(hermite.view(), &hermite.derivative().unwrap()),
        ];
        for [off, bound] in worst {
            // Measured: 1.5e-14, 9.6e-15 and 2.2e-13, bounds 6.6e-14 to 7.4e-13.
            assert!(off < 5e-13 && bound < 2e-12, "{worst:?}");
        }
    }

    #[test]
    fn finer_ranges_contain_samples_and_are_narrow() {
        for (axis, most) in [(cochran_2000::f_hat(), 0.5), (cochran_2000::g_hat(), 0.85)] {
            let tabulated = Curve::new(axis.unwrap()).tabulated(1024);
            let top = tabulated.top().unwrap();
            for i in 0..400 {
                // Within cells, over the border of two, at both ends of the domain.
                let width = [1e-3, 1e-4, 1e-6][i % 3];
                let from = match i {
                    0..3 => 0.0,
                    3..6 => 1.0 - width,
                    6..9 => 0.375 - 0.3 * width,
                    _ => (i as f64 * 0.618_033_988_749_895).fract() * (1.0 - width),
                };
                let Some([values, slopes]) = top.finer([from, from + width]) else {
                    assert!(
                        (1024.0 * (from + width)).floor() > (1024.0 * from).floor() + 1.0,
                        "{from} {width}"
                    );
                    continue;
                };
                for k in 0..=20 {
                    let [f, s] = top.jets.jet(from + width * f64::from(k) / 20.0, STEPS);
                    assert!(
                        values.contains(f) && slopes.contains(s),
                        "{from} {width}: {f} {values:?}, {s} {slopes:?}"
                    );
                }
                // A few times the variation of the function over a cell of this width, and at least
                // that over one of the second step.
                let finest = [f64::from(1 << 20).recip(), width][usize::from(width > 1e-6)];
                let depth = -finest.log2();
                assert!(slopes.width() < 64.0 * f64::powf(most, depth - 2.0), "{from} {width}: {slopes:?}");
                assert!(
                    values.width() < 4.2 * width * (slopes.magnitude() + 2.0),
                    "{from} {width}: {values:?}"
                );
            }
        }
    }
}
