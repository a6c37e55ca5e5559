//! Values in the lanes of SIMD registers: rows are copied side by side and turned, so no gather is needed.

use fearless_simd::{Bytes, Select, Simd, SimdBase, SimdMask, dispatch, f32x16, i32x16, u32x16};

use crate::numeric::level::best_level;
use crate::table::uniform_f32::{Rows32, Table32};

const LANES: usize = 16;

/// Points of one turn, so that rows have been written before they are read.
const BLOCK: usize = 64;

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
        let mut scratch = Scratch { digits: [0; BLOCK], rows: [[0.0; 4]; BLOCK] };
        let (blocks, rest) = x.as_chunks::<BLOCK>();
        let (places, left) = out.as_chunks_mut::<BLOCK>();
        for (x, out) in blocks.iter().zip(places) {
            self.block(simd, own, bits, x, out, &mut scratch);
        }
        if rest.len() <= LANES {
            return self.one_by_one(rest, left);
        }
        let (mut x, mut values) = ([rest[0]; BLOCK], [0.0; BLOCK]);
        x[..rest.len()].copy_from_slice(rest);
        self.block(simd, own, bits, &x, &mut values, &mut scratch);
        left.copy_from_slice(&values[..left.len()]);
    }

    #[inline(always)]
    fn block<I: Simd>(
        &self,
        simd: I,
        own: &Rows32,
        bits: u32,
        x: &[f32; BLOCK],
        out: &mut [f32; BLOCK],
        Scratch { digits, rows }: &mut Scratch,
    ) {
        let splat = |x: f32| -> f32x16<I> { f32x16::splat(simd, x) };
        let (zero, one) = (u32x16::splat(simd, 0), splat(1.0));
        let [start, rise] = own.chord.map(splat);
        let (mut rest, mut sum, mut weight) =
            ([zero; BLOCK / LANES], [one; BLOCK / LANES], [one; BLOCK / LANES]);
        let mut served = [0; BLOCK / LANES];
        for (g, x) in x.as_chunks::<LANES>().0.iter().enumerate() {
            let t = (f32x16::from_slice(simd, x) - own.origin) * own.per_width;
            served[g] = (t.simd_ge(splat(LEAST)) & t.simd_lt(one)).to_bitmask();
            let fraction: i32x16<I> = simd.cvt_i32_f32x16(t * 2_147_483_648.0);
            let fraction: u32x16<I> = fraction.bitcast();
            rest[g] = fraction << 1;
            sum[g] = start + rise * t;
        }
        let table = own.table.as_slice();
        // After 30 bits the digits are zeros, and so are their terms.
        for _ in 0..own.steps.min(30_u32.div_ceil(bits)) {
            for (rest, digits) in rest.iter_mut().zip(digits.as_chunks_mut::<LANES>().0) {
                (*rest >> (32 - bits)).store_slice(digits);
                *rest <<= bits;
            }
            for (row, digit) in rows.iter_mut().zip(digits.iter()) {
                if let Some(entry) = table.get(*digit as usize) {
                    *row = *entry;
                }
            }
            for (g, rows) in rows.as_chunks::<LANES>().0.iter().enumerate() {
                let s: f32x16<I> = simd.cvt_f32_i32x16((rest[g] >> 8).bitcast());
                let [r0, r1, r2, r3] = quarters(simd, rows.as_flattened());
                let ((a_c1, c0_c2), (b_d1, d0_d2)) = (r0.deinterleave(r1), r2.deinterleave(r3));
                let ((a, c1), (c0, c2)) = (a_c1.deinterleave(b_d1), c0_c2.deinterleave(d0_d2));
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
            let value = rest[g].simd_eq(zero).select(sum[g], sum[g] + weight[g] * own.middle);
            value.store_slice(out);
        }
        for (group, served) in (0..).zip(served) {
            let mut others = !served & 0xFFFF;
            while others != 0 {
                let point = LANES * group + others.trailing_zeros() as usize;
                if let (Some(x), Some(out)) = (x.get(point), out.get_mut(point)) {
                    *out = self.value(*x);
                }
                others &= others - 1;
            }
        }
    }
}

/// Digits and their rows.
struct Scratch {
    digits: [u32; BLOCK],
    rows: [[f32; 4]; BLOCK],
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
