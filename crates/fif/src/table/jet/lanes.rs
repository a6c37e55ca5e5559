//! Jets in SIMD lanes, where the radix is a power of two and digits of a float are exact.

use asperity_core::lanes::best_level;
use fearless_simd::{Bytes, Simd, dispatch, f64x4, prelude::*, u32x8};

use crate::table::composite::Composite;
use crate::table::jet::jet::{Jet, Scales, Sums};
use crate::table::jet::rows::Jets;
use crate::table::uniform::LEAST;

const LANES: usize = 4;

/// Remainder in each lane, and the row of the previous digit.
struct Places<'a, I: Simd, const C: usize> {
    rest: f64x4<I>,
    digits: [usize; LANES],
    rows: [&'a Composite<C>; LANES],
}

/// Range of positions for SIMD: all bits after one digit are above 2⁻⁵³, and the position is
/// between knots.
struct Edges {
    least: f64,
    near: f64,
    far: f64,
}

impl<const C: usize> Jets<C> {
    /// Computes all jets with SIMD if the radix is a power of two; other points go to `one_by_one`.
    pub(crate) fn in_lanes(
        &self,
        x: &[f64],
        out: Jet<&mut [f64]>,
        one_by_one: &impl Fn(&[f64], Jet<&mut [f64]>),
    ) {
        if self.radix.is_power_of_two() {
            dispatch!(best_level(), simd => self.fill(simd, x, out, one_by_one));
        } else {
            one_by_one(x, out);
        }
    }

    #[inline(always)]
    fn fill<I: Simd>(
        &self,
        simd: I,
        x: &[f64],
        Jet { value, slope, integral }: Jet<&mut [f64]>,
        one_by_one: &impl Fn(&[f64], Jet<&mut [f64]>),
    ) {
        let near = (self.near as f64 + 1.0) * (1.0 / 18_446_744_073_709_551_616.0);
        let half = 0.5 * self.scales.per_radix;
        let edges = Edges { least: if half > LEAST { half } else { LEAST }, near, far: 1.0 - near };
        let (groups, rest) = x.as_chunks::<LANES>();
        let (values, value) = value.as_chunks_mut::<LANES>();
        let (slopes, slope) = slope.as_chunks_mut::<LANES>();
        let (integrals, integral) = integral.as_chunks_mut::<LANES>();
        for (x, ((value, slope), integral)) in groups.iter().zip(values.iter_mut().zip(slopes).zip(integrals))
        {
            match self.group(simd, &edges, x) {
                Some(jet) => {
                    jet.value.store_slice(value);
                    jet.slope.store_slice(slope);
                    jet.integral.store_slice(integral);
                }
                None => one_by_one(x, Jet { value, slope, integral }),
            }
        }
        one_by_one(rest, Jet { value, slope, integral });
    }

    /// `None` if a lane needs another path.
    #[inline(always)]
    fn group<I: Simd>(&self, simd: I, edges: &Edges, x: &[f64; LANES]) -> Option<Jet<f64x4<I>>> {
        let (one, half) = (f64x4::splat(simd, 1.0), f64x4::splat(simd, 0.5));
        let by = self.scales.splat(simd);
        let t = (f64x4::from_slice(simd, x) - self.origin) * self.per_width;
        let scaled = t * by.radix;
        let left = scaled - scaled.floor();
        let within = t.simd_ge(f64x4::splat(simd, edges.least)) & t.simd_lt(one);
        let apart =
            left.simd_gt(f64x4::splat(simd, edges.near)) & left.simd_lt(f64x4::splat(simd, edges.far));
        if !(within & apart).all_true() {
            return None;
        }
        let rise = f64x4::splat(simd, self.chord.rise);
        let start = f64x4::splat(simd, self.chord.start);
        let jet = Jet {
            value: start + rise * t,
            slope: rise,
            integral: t * (start + f64x4::splat(simd, 0.5 * self.chord.rise) * t) + self.primitive.half,
        };
        let table = self.table.as_slice();
        // Of equal length, so that one comparison covers both.
        let middles = self.primitive.middles.get(..table.len())?;
        let mut sums = Sums::new(jet, one);
        let mut rest = t;
        let [integral, value, slope] = self.terms;
        for _ in 1..integral {
            let at = Places::next(table, rest, by.radix)?;
            rest = at.rest;
            sums.all(&at.columns(), at.factors(), middles_at(simd, middles, &at.digits)?, rest - half, &by);
        }
        let at = Places::next(table, rest, by.radix)?;
        rest = at.rest;
        let (c, z) = (at.columns(), rest - half);
        sums.end_integral(&c, middles_at(simd, middles, &at.digits)?, z, &by);
        sums.value_and_slope(&c, at.factors(), z, &by);
        for _ in integral..value {
            let at = Places::next(table, rest, by.radix)?;
            rest = at.rest;
            sums.value_and_slope(&at.columns(), at.factors(), rest - half, &by);
        }
        sums.end_value(tail(rest, self.tails[0]));
        for _ in value..slope {
            let at = Places::next(table, rest, by.radix)?;
            rest = at.rest;
            sums.slope(&at.columns(), at.factors(), rest - half, &by);
        }
        sums.end_slope(tail(rest, self.tails[1]));
        Some(sums.jet(f64x4::splat(simd, self.width), f64x4::splat(simd, self.per_width)))
    }
}

#[inline(always)]
fn middles_at<I: Simd>(simd: I, middles: &[f64], [d0, d1, d2, d3]: &[usize; LANES]) -> Option<f64x4<I>> {
    let values = [*middles.get(*d0)?, *middles.get(*d1)?, *middles.get(*d2)?, *middles.get(*d3)?];
    Some(f64x4::from_slice(simd, &values))
}

#[inline(always)]
fn tail<I: Simd>(rest: f64x4<I>, tails: [f64; 2]) -> f64x4<I> {
    let simd = rest.simd;
    let zeros = rest.simd_eq(f64x4::splat(simd, 0.0));
    zeros.select(f64x4::splat(simd, tails[1]), f64x4::splat(simd, tails[0]))
}

impl<'a, I: Simd, const C: usize> Places<'a, I, C> {
    #[inline(always)]
    fn next(table: &'a [Composite<C>], rest: f64x4<I>, radix: f64x4<I>) -> Option<Self> {
        let scaled = rest * radix;
        let whole = scaled.floor();
        // 2⁵² plus the digit: its bits are the last ones.
        let bits: u32x8<I> = (whole + 4_503_599_627_370_496.0).bitcast();
        let [d0, _, d1, _, d2, _, d3, _] = <[u32; 8]>::from(bits);
        let digits = [d0 as usize, d1 as usize, d2 as usize, d3 as usize];
        let rows =
            [table.get(digits[0])?, table.get(digits[1])?, table.get(digits[2])?, table.get(digits[3])?];
        Some(Self { rest: scaled - whole, digits, rows })
    }

    #[inline(always)]
    fn columns(&self) -> [f64x4<I>; C] {
        let simd = self.rest.simd;
        let [r0, r1, r2, r3] = self.rows;
        let mut columns = [f64x4::splat(simd, 0.0); C];
        for (k, column) in columns.iter_mut().enumerate() {
            *column = f64x4::from_slice(simd, &[r0.c[k], r1.c[k], r2.c[k], r3.c[k]]);
        }
        columns
    }

    #[inline(always)]
    fn factors(&self) -> f64x4<I> {
        let [r0, r1, r2, r3] = self.rows;
        f64x4::from_slice(self.rest.simd, &[r0.a, r1.a, r2.a, r3.a])
    }
}

impl<const C: usize> Scales<f64, C> {
    /// In every lane.
    #[inline(always)]
    fn splat<I: Simd>(&self, simd: I) -> Scales<f64x4<I>, C> {
        let mut parts = [f64x4::splat(simd, 0.0); C];
        for (part, value) in parts.iter_mut().zip(self.parts) {
            *part = f64x4::splat(simd, value);
        }
        Scales { radix: f64x4::splat(simd, self.radix), per_radix: f64x4::splat(simd, self.per_radix), parts }
    }
}
