//! Values and slopes of a smooth function by composed maps, several levels at a step.

use alloc::vec::Vec;
use core::fmt::Debug;

use crate::composites::{Composite, Composites};
use crate::fast::digit;
use crate::interval::Interval;
use crate::map::Piece;
use crate::polynomial::UNIT;
use crate::system::Fif;

/// Steps of one evaluation at most.
pub(crate) const STEPS: usize = 64;

/// One ulp of the 53-bit argument of a composite's polynomial.
const STEP: f64 = 1.0 / 9_007_199_254_740_992.0;

/// The value and the slope at a point; what the descent of a ray asks of a table, whatever its degree.
pub trait Jets: Clone + Debug {
    /// `[f(x), f′(x)]` after so many steps, for an `x` within the rounding error of the ray.
    fn jet(&self, x: f64, steps: usize) -> [f64; 2];

    /// Bounds of the errors of value and slope after 0, 1, … steps.
    fn errors(&self) -> &[[f64; 2]; STEPS + 1];

    /// Steps after which value and slope do not gain any more.
    fn enough(&self) -> [usize; 2];

    /// Bytes of the table.
    fn bytes(&self) -> usize;

    /// The steps after which cells are at most this part of the domain, unless the slope does not gain any more before.
    fn cells_within(&self, part: f64) -> usize;

    /// The steps for a value to the rounding error, and its bound.
    #[inline]
    fn finest(&self) -> (usize, f64) {
        let steps = self.enough()[0];
        (steps, self.errors().get(steps).map_or(f64::INFINITY, |e| e[0]))
    }
}

/// No table.
#[derive(Clone, Debug)]
pub enum NoJets {}

impl Jets for NoJets {
    fn jet(&self, _x: f64, _steps: usize) -> [f64; 2] {
        match *self {}
    }

    fn errors(&self) -> &[[f64; 2]; STEPS + 1] {
        match *self {}
    }

    fn enough(&self) -> [usize; 2] {
        match *self {}
    }

    fn cells_within(&self, _part: f64) -> usize {
        match *self {}
    }

    fn bytes(&self) -> usize {
        match *self {}
    }
}

/// All composites of a few maps of a system on equal knots, and their derivatives, evaluated to any number of steps.
///
/// ```text
/// f(x) = chord(x) + Σ_k W_k P_{e_{k+1}}(u_{k+1}) + W_K v       |error| ≤ max|A|^K sup|f − chord − v| + rounding
/// ```
///
/// `e_k` are the digits of `(x − x_0)/(x_N − x_0)` in the table's radix, `u_k` what is left of it, `W_k` the product of the
/// factors; the slope is the sum of the derivatives, and the middle of its range the tail. Bits of the fraction under 2⁻⁶³ are
/// cut off, so the value is that of a point within a unit in the last place of the domain's width.
#[derive(Clone, Debug)]
pub struct JetTable<const C: usize> {
    entries: Vec<Composite<C>>,
    radix: u64,
    /// The left end of the domain and the reciprocal of its width.
    origin: f64,
    per_width: f64,
    /// Value at the left end and rise over the domain.
    chord: [f64; 2],
    /// The middle of the range of deviations from the chord, and of that of their slopes over the unit interval.
    tail: [f64; 2],
    errors: [[f64; 2]; STEPS + 1],
    enough: [usize; 2],
}

impl<const C: usize> JetTable<C> {
    /// `None` unless the knots are equally spaced and the sums of values and slopes converge.
    pub(crate) fn new<S: AsRef<[Piece<C>]>, T: AsRef<[Piece<D>]>, const D: usize>(
        value: &Fif<S, C>,
        slope: &Fif<T, D>,
    ) -> Option<Self> {
        let Composites { mut table, radix, steepest, largest, error, deviation, .. } =
            Composites::<Vec<Composite<C>>, C>::new(value).ok()?;
        let wide = radix as f64;
        let width = value.domain().width();
        let (y0, rise) = (value.chord().start, value.chord().rise);
        let slopes = slope.range().scaled(width).sum(Interval::new(-rise, -rise));
        let steep = steepest * wide;
        let converges = steepest < 1.0 && steep < 1.0;
        // Horner's rule rounds twice a step; a derivative has each coefficient up to C times.
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
        // Near-critical systems: better none than one that is worse than the plain evaluation.
        let rounding = |i: usize, scale: f64| errors.get(enough[i]).is_some_and(|e| e[i] <= 1e-8 * scale);
        if !(rounding(0, scale) && rounding(1, slopes.magnitude() / width)) {
            return None;
        }
        // Powers of s = 2⁵³ u, exactly.
        for entry in &mut table {
            let mut scale = 1.0;
            for c in &mut entry.c {
                *c *= scale;
                scale *= STEP;
            }
        }
        Some(Self {
            entries: table,
            radix: radix as u64,
            origin: value.domain().lo,
            per_width: 1.0 / width,
            chord: [y0, rise],
            tail: [deviation.middle(), slopes.middle()],
            errors,
            enough,
        })
    }
}

impl<const C: usize> Jets for JetTable<C> {
    #[inline(always)]
    fn jet(&self, x: f64, steps: usize) -> [f64; 2] {
        const SCALE: f64 = 9_223_372_036_854_775_808.0;
        let t = (x - self.origin) * self.per_width;
        let t = if t > 0.0 { t } else { 0.0 };
        let t = if t < 1.0 { t } else { 1.0 - UNIT };
        let mut rest = ((t * SCALE) as i64 as u64) << 1;
        let radix = self.radix as i64 as f64;
        let (mut value, mut slope) = (self.chord[0] + self.chord[1] * t, self.chord[1]);
        let (mut weight, mut steep) = (1.0, radix / STEP);
        for _ in 0..steps {
            let Some(entry) = self.entries.get(digit(&mut rest, self.radix)) else { break };
            let s = (rest >> 11) as i64 as f64;
            let Some((&last, lower)) = entry.c.split_last() else { break };
            let (mut p, mut rise) = (last, 0.0);
            for (k, &c) in lower.iter().rev().enumerate() {
                rise = if k == 0 { p } else { rise * s + p };
                p = p * s + c;
            }
            value += weight * p;
            slope += steep * rise;
            weight *= entry.a;
            steep *= entry.a * radix;
        }
        value += weight * self.tail[0];
        slope += steep * (STEP / radix) * self.tail[1];
        [value, slope * self.per_width]
    }

    #[inline]
    fn errors(&self) -> &[[f64; 2]; STEPS + 1] {
        &self.errors
    }

    #[inline]
    fn enough(&self) -> [usize; 2] {
        self.enough
    }

    fn bytes(&self) -> usize {
        self.entries.len() * size_of::<Composite<C>>() + size_of::<Self>()
    }

    #[inline]
    fn cells_within(&self, part: f64) -> usize {
        let radix = self.radix as i64 as f64;
        let (mut steps, mut finer) = (0, part);
        while finer < 1.0 && steps < self.enough[1] {
            finer *= radix;
            steps += 1;
        }
        steps
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{FifBuf, SmoothBuf, paper};

    fn check<const C: usize, const D: usize>(axis: &SmoothBuf<C, D>) -> [f64; 2] {
        let (value, slope) = (axis.value(), axis.derivative());
        let table = JetTable::new(value, slope).unwrap();
        let (domain, mut finest) = (value.domain(), [0.0_f64; 2]);
        for i in 0..=2000 {
            // Also the ends, points outside and some knots.
            let x = domain.lo + domain.width() * (f64::from(i) * 0.618_033_988_749_895).fract();
            let x = if i % 50 == 0 { domain.lo + domain.width() * f64::from(i - 100) / 1800.0 } else { x };
            let near = 4.0 * f64::EPSILON * domain.magnitude();
            let (f, d) = (value.evaluate(x, 0.0), slope.evaluate(x, 0.0));
            // A slope is one of a point near by.
            let moved = slope.extrema_over(
                domain.lo.max(domain.hi.min(x)) - near,
                domain.lo.max(domain.hi.min(x)) + near,
                1e-9,
            );
            let moved = moved.unwrap().enclosure().width() + 1e-9;
            for steps in (0..=8).chain([STEPS / 2, STEPS]) {
                let (got, error) = (table.jet(x, steps), table.errors[steps]);
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
    fn values_and_slopes_keep_their_bounds_after_any_number_of_steps() {
        let integral = |maps: [crate::Map<2>; 2]| {
            let f = FifBuf::new(&paper::KNOTS, &maps.map(|w| w.alpha), &maps.map(|w| w.q)).unwrap();
            SmoothBuf::<3, 2>::integral(f, 0.0).unwrap()
        };
        let hermite = FifBuf::hermite(
            &[-1.0, 0.0, 1.0, 2.0],
            &[0.3, 1.0, -0.5, 2.0],
            &[1.0, 0.0, -1.0, 0.5],
            &[0.3, -0.2, 0.1],
        );
        let worst = [
            check(&integral(paper::F_MAPS)),
            check(&integral(paper::G_MAPS)),
            check::<4, 3>(&SmoothBuf::of(hermite.unwrap()).unwrap()),
        ];
        for [off, bound] in worst {
            // Measured: 1.5e-14, 9.6e-15 and 2.2e-13, bounds 6.6e-14 to 7.4e-13.
            assert!(off < 5e-13 && bound < 2e-12, "{worst:?}");
        }
    }

    #[test]
    fn uneven_knots_have_no_table() {
        let hermite =
            FifBuf::hermite(&[0.0, 0.4, 1.0], &[0.0, 1.0, 0.5], &[1.0, 0.0, -1.0], &[0.3, -0.4]).unwrap();
        let axis = SmoothBuf::<4, 3>::of(hermite).unwrap();
        assert!(JetTable::new(axis.value(), axis.derivative()).is_none());
    }
}
