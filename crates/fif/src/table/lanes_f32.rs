//! Values in the lanes of a SIMD register: rows of four lanes are transposed, so no gather is needed.

use fearless_simd::{Bytes, Select, Simd, SimdBase, dispatch, f32x4, i32x4, prelude::*, u32x4};

use crate::numeric::level::best_level;
use crate::table::uniform_f32::{Rows32, Table32};

/// Registers that are in work at once, to hide their latency.
const GROUP: usize = 2;
const LANES: usize = 4;

/// The least place in the domain whose 24 bits lie within 30: 2⁻⁷.
const LEAST: f32 = 1.0 / 128.0;

impl<const C: usize> Table32<C> {
    /// All values, in lanes where digits are bits.
    pub(crate) fn in_lanes(&self, x: &[f32], out: &mut [f32]) {
        let bits = |rows: &Rows32| rows.radix.trailing_zeros();
        match &self.rows {
            Some(rows) if rows.radix.is_power_of_two() && (1..=16).contains(&bits(rows)) => {
                dispatch!(best_level(), simd => self.fill(simd, rows, bits(rows), x, out));
            }
            _ => self.one_by_one(x, out),
        }
    }

    #[inline(always)]
    fn fill<I: Simd>(&self, simd: I, own: &Rows32, bits: u32, x: &[f32], out: &mut [f32]) {
        let (groups, rest) = x.as_chunks::<{ LANES * GROUP }>();
        let (places, left) = out.as_chunks_mut::<{ LANES * GROUP }>();
        for (x, out) in groups.iter().zip(places) {
            self.group(simd, own, bits, x, out);
        }
        self.one_by_one(rest, left);
    }

    #[inline(always)]
    fn group<I: Simd>(
        &self,
        simd: I,
        own: &Rows32,
        bits: u32,
        x: &[f32; LANES * GROUP],
        out: &mut [f32; LANES * GROUP],
    ) {
        let splat = |x: f32| -> f32x4<I> { f32x4::splat(simd, x) };
        let (zero, one) = (u32x4::splat(simd, 0), splat(1.0));
        let (origin, per_width) = (splat(own.origin), splat(own.per_width));
        let [start, rise] = own.chord.map(splat);
        let (mut rest, mut sum, mut weight) = ([zero; GROUP], [one; GROUP], [one; GROUP]);
        let mut whole = true;
        for (g, x) in x.as_chunks::<LANES>().0.iter().enumerate() {
            let t = (f32x4::from_slice(simd, x) - origin) * per_width;
            whole &= (t.simd_ge(splat(LEAST)) & t.simd_lt(one)).all_true();
            let fraction: i32x4<I> = simd.cvt_i32_f32x4(t * splat(2_147_483_648.0));
            let fraction: u32x4<I> = fraction.bitcast();
            rest[g] = fraction << 1;
            sum[g] = start + rise * t;
        }
        if !whole {
            self.one_by_one(x, out);
            return;
        }
        // After 30 bits the digits are zeros, and so are their terms.
        for _ in 0..own.steps.min(30_u32.div_ceil(bits)) {
            for g in 0..GROUP {
                let digits = rest[g] >> (32 - bits);
                let mut rows = [one; LANES];
                for (to, digit) in rows.iter_mut().zip(digits.as_slice()) {
                    if let Some(row) = own.table.get(*digit as usize) {
                        *to = f32x4::from_slice(simd, row);
                    }
                }
                rest[g] <<= bits;
                let s: f32x4<I> = simd.cvt_f32_i32x4((rest[g] >> 8).bitcast());
                let [r0, r1, r2, r3] = rows;
                let (even, odd) = (r0.zip_low(r2), r1.zip_low(r3));
                let (high_even, high_odd) = (r0.zip_high(r2), r1.zip_high(r3));
                let (a, c0) = (even.zip_low(odd), even.zip_high(odd));
                let (c1, c2) = (high_even.zip_low(high_odd), high_even.zip_high(high_odd));
                let p = match C {
                    0 | 1 => c0,
                    2 => c1 * s + c0,
                    _ => (c2 * s + c1) * s + c0,
                };
                sum[g] += weight[g] * p;
                weight[g] *= a;
            }
        }
        for (g, out) in out.as_chunks_mut::<LANES>().0.iter_mut().enumerate() {
            let value: f32x4<I> =
                rest[g].simd_eq(zero).select(sum[g], sum[g] + weight[g] * splat(own.middle));
            value.store_slice(out);
        }
    }
}
