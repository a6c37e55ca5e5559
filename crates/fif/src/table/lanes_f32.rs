//! Values in SIMD lanes: rows are copied side by side and transposed, so no gather is needed.

use asperity_core::lanes::best_level;
use fearless_simd::{Bytes, Select, Simd, SimdBase, SimdMask, dispatch, f32x16, i32x16, u32x16};

use crate::table::uniform_f32::{Rows32, Table32};

const LANES: usize = 16;

/// Registers per iteration, enough that rows are written before they are read; and for the
/// remainder.
const MOST: usize = 8;
const LEFT: usize = 4;

/// The smallest position in the domain whose 24 bits lie within 30: 2⁻⁷.
const LEAST: f32 = 1.0 / 128.0;

impl<const C: usize> Table32<C> {
    /// Computes all values, with SIMD if digits are bits.
    pub(crate) fn in_lanes(&self, x: &[f32], out: &mut [f32]) {
        let bits = |rows: &Rows32| rows.radix.trailing_zeros();
        if x.len() <= LANES {
            return self.one_by_one(x, out);
        }
        match &self.rows {
            Some(rows) if rows.radix.is_power_of_two() && (1..=16).contains(&bits(rows)) => {
                dispatch!(best_level(), simd => self.fill(simd, rows, bits(rows), x, out));
            }
            _ => self.one_by_one(x, out),
        }
    }

    #[inline(always)]
    fn fill<I: Simd>(&self, simd: I, own: &Rows32, bits: u32, x: &[f32], out: &mut [f32]) {
        let (x, out) = self.blocks::<I, MOST>(simd, own, bits, x, out);
        let (x, out) = self.blocks::<I, LEFT>(simd, own, bits, x, out);
        if x.len() <= LANES {
            return self.one_by_one(x, out);
        }
        let (mut all, mut values) = ([[x[0]; LANES]; LEFT], [[0.0; LANES]; LEFT]);
        all.as_flattened_mut()[..x.len()].copy_from_slice(x);
        self.blocks::<I, LEFT>(simd, own, bits, all.as_flattened(), values.as_flattened_mut());
        out.copy_from_slice(&values.as_flattened()[..out.len()]);
    }

    /// Blocks of this number of registers, and the rest of the lists.
    #[inline(always)]
    fn blocks<'a, I: Simd, const G: usize>(
        &self,
        simd: I,
        own: &Rows32,
        bits: u32,
        x: &'a [f32],
        out: &'a mut [f32],
    ) -> (&'a [f32], &'a mut [f32]) {
        let mut scratch = Scratch { digits: [[0; LANES]; G], rows: [[[0.0; 4]; LANES]; G] };
        let served = x.len() - x.len() % (G * LANES);
        let ((x, rest), (out, left)) = (x.split_at(served), out.split_at_mut(served));
        let blocks = x.as_chunks().0.as_chunks().0.iter();
        for (x, out) in blocks.zip(out.as_chunks_mut().0.as_chunks_mut().0) {
            self.block::<I, G>(simd, own, bits, x, out, &mut scratch);
        }
        (rest, left)
    }

    #[inline(always)]
    fn block<I: Simd, const G: usize>(
        &self,
        simd: I,
        own: &Rows32,
        bits: u32,
        x: &[[f32; LANES]; G],
        out: &mut [[f32; LANES]; G],
        scratch: &mut Scratch<G>,
    ) {
        let splat = |x: f32| -> f32x16<I> { f32x16::splat(simd, x) };
        let (zero, one) = (u32x16::splat(simd, 0), splat(1.0));
        let [start, rise] = own.chord.map(splat);
        let (mut rest, mut sum, mut weight, mut served) = ([zero; G], [one; G], [one; G], [0; G]);
        for (g, x) in x.iter().enumerate() {
            let t = (f32x16::from_slice(simd, x) - own.origin) * own.per_width;
            served[g] = (t.simd_ge(splat(LEAST)) & t.simd_lt(one)).to_bitmask();
            let fraction: i32x16<I> = simd.cvt_i32_f32x16(t * 2_147_483_648.0);
            let fraction: u32x16<I> = fraction.bitcast();
            rest[g] = fraction << 1;
            sum[g] = start + rise * t;
        }
        let table = own.table.as_slice();
        next(table, bits, &mut rest, scratch);
        for (g, rows) in scratch.rows.iter().enumerate() {
            let (a, p) = term::<I, C>(rows, rest[g]);
            sum[g] += p;
            weight[g] = a;
        }
        // After 30 bits the digits are zeros, and so are their terms.
        for _ in 1..own.steps.min(30_u32.div_ceil(bits)) {
            next(table, bits, &mut rest, scratch);
            for (g, rows) in scratch.rows.iter().enumerate() {
                let (a, p) = term::<I, C>(rows, rest[g]);
                sum[g] += weight[g] * p;
                weight[g] *= a;
            }
        }
        for (g, out) in out.iter_mut().enumerate() {
            let value = rest[g].simd_eq(zero).select(sum[g], sum[g] + weight[g] * own.middle);
            value.store_slice(out);
        }
        for ((served, x), out) in served.iter().zip(x).zip(out) {
            let mut others = !served & 0xFFFF;
            while others != 0 {
                let lane = others.trailing_zeros() as usize;
                if let (Some(x), Some(out)) = (x.get(lane), out.get_mut(lane)) {
                    *out = self.value(*x);
                }
                others &= others - 1;
            }
        }
    }
}

/// Digits and their rows, in whole cache lines.
#[repr(align(64))]
struct Scratch<const G: usize> {
    digits: [[u32; LANES]; G],
    rows: [[[f32; 4]; LANES]; G],
}

/// The next digit of every position, which keeps the remaining digits, and its row.
#[inline(always)]
fn next<I: Simd, const G: usize>(
    table: &[[f32; 4]],
    bits: u32,
    rest: &mut [u32x16<I>; G],
    Scratch { digits, rows }: &mut Scratch<G>,
) {
    for (rest, digits) in rest.iter_mut().zip(digits.iter_mut()) {
        (*rest >> (32 - bits)).store_slice(digits);
        *rest <<= bits;
    }
    for (row, digit) in rows.as_flattened_mut().iter_mut().zip(digits.as_flattened()) {
        if let Some(entry) = table.get(*digit as usize) {
            *row = *entry;
        }
    }
}

/// Scalings and polynomials of rows, at the remainder.
#[inline(always)]
fn term<I: Simd, const C: usize>(rows: &[[f32; 4]; LANES], rest: u32x16<I>) -> (f32x16<I>, f32x16<I>) {
    let simd = rest.simd;
    let s: f32x16<I> = simd.cvt_f32_i32x16((rest >> 8).bitcast());
    let [r0, r1, r2, r3] = quarters(simd, rows.as_flattened());
    let ((a_c1, c0_c2), (b_d1, d0_d2)) = (r0.deinterleave(r1), r2.deinterleave(r3));
    let ((a, c1), (c0, c2)) = (a_c1.deinterleave(b_d1), c0_c2.deinterleave(d0_d2));
    let p = match C {
        0 | 1 => c0,
        2 => c1 * s + c0,
        _ => (c2 * s + c1) * s + c0,
    };
    (a, p)
}

/// Four registers of rows.
#[inline(always)]
fn quarters<I: Simd>(simd: I, rows: &[f32]) -> [f32x16<I>; 4] {
    let mut out = [f32x16::splat(simd, 0.0); 4];
    for (out, rows) in out.iter_mut().zip(rows.as_chunks::<LANES>().0) {
        *out = f32x16::from_slice(simd, rows);
    }
    out
}
