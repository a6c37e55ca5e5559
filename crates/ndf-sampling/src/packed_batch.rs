//! Blocks of samples of a packed map: searches one by one, arithmetic for the whole block.

use crate::bernstein::{inverse_share, kept_away};
use crate::math;
use crate::packed::PackedMap;
use crate::packed_layout::{KEYS, LINES, SLAB};

/// The largest `f32` below 1.
const BELOW_ONE: f32 = 1.0 - f32::EPSILON / 2.0;

/// What a sample leaves on either side of it where the chord shrinks to a point, as the exact map does.
const LEAST_MASS: f64 = 1e-7;

/// The numbers of a slab that the arithmetic needs, a block's after another's.
struct Slabs<const N: usize> {
    numbers: [[f32; N]; SLAB],
}

impl<const N: usize> Slabs<N> {
    /// The numbers of the slabs `at`, by four slabs at once where there are four: so they are turned in registers.
    #[inline(always)]
    fn load(slabs: &[[f32; SLAB]], at: &[u32; N]) -> Self {
        let slab = |k: usize| slabs.get(at[k] as usize).unwrap_or(&[0.0; SLAB]);
        let mut numbers = [[0.0; N]; SLAB];
        let mut k = 0;
        while k + 4 <= N {
            let [a, b, c, d] = [slab(k), slab(k + 1), slab(k + 2), slab(k + 3)];
            for (j, numbers) in numbers.iter_mut().enumerate() {
                numbers[k..k + 4].copy_from_slice(&[a[j], b[j], c[j], d[j]]);
            }
            k += 4;
        }
        while k < N {
            for (numbers, &number) in numbers.iter_mut().zip(slab(k)) {
                numbers[k] = number;
            }
            k += 1;
        }
        Self { numbers }
    }
}

impl PackedMap<'_> {
    /// `(M, C)⁻¹` of a block of uniform numbers. `SIDES`: how many columns of values a cell lies between.
    #[inline(always)]
    pub(crate) fn inverse_block<const N: usize, const SIDES: usize>(
        &self,
        u: [&[f32; N]; 2],
    ) -> [[f32; N]; 2] {
        let parts = self.layout.guide as f32;
        let u = u.map(|u| u.map(|u| bounded(u, 0.0, BELOW_ONE)));
        let (part, mut at) = (u[0].map(|u| index(u * parts)), [0_u32; N]);
        for k in 0..N {
            at[k] = found(self.weights, self.by_weight, part[k], u[0][k]);
        }
        let slabs = Slabs::load(self.slabs, &at);
        let [bend0, bend1, begin, wide, m0, m1, m2, m3, b0, b1, b2, b3, column, w0, w1, _] = &slabs.numbers;
        let column = column.map(f32::to_bits);
        let mut place = [0.0; N];
        let mut most = 0.0_f32;
        for k in 0..N {
            let share = bounded((u[0][k] - w0[k]) / (w1[k] - w0[k]), 0.0, 1.0);
            let rest = 1.0 - share;
            place[k] = share + share * rest * (bend0[k] * rest + bend1[k] * share);
            most = most.max(bend0[k]);
        }
        if most == f32::MAX {
            for k in 0..N {
                if bend0[k] == f32::MAX {
                    let marginal = [m0[k], m1[k], m2[k], m3[k]].map(f64::from);
                    let [from, to] = [w0[k], w1[k]].map(f64::from);
                    let share = ((f64::from(u[0][k]) - from) / (to - from)).clamp(0.0, 1.0);
                    place[k] =
                        inverse_share(marginal, kept_away(marginal, share, LEAST_MASS / (to - from))) as f32;
                }
            }
        }
        let offset = self.layout.kind.offset() as f32;
        let per_width = 2.0 / self.layout.width as f32;
        let margins =
            [self.layout.width, self.layout.height].map(|n| (2.0 * f32::EPSILON * n as f32).min(0.25));
        let (mut x, mut t, mut target) = ([0.0; N], [0.0; N], [0.0; N]);
        for k in 0..N {
            let s = place[k];
            t[k] = (begin[k] + wide[k] * s).min(1.0);
            // Not on a line, from which the normal might round into the next column.
            let within = t[k].max(margins[0]).min(1.0 - margins[0]);
            x[k] = bounded(((column[k] as i32 as f32 - offset) + within) * per_width - 1.0, -1.0, 1.0);
            let marginal = cubic([m0[k], m1[k], m2[k], m3[k]], s);
            let below = cubic([b0[k], b1[k], b2[k], b3[k]], s);
            target[k] = u[1][k] * marginal - below;
        }
        let (mut row, mut from, mut ends) = ([0_u32; N], [0.0; N], [[0.0; N]; 2]);
        // Three short loops: in each the loads of many samples are under way at once.
        let mut first = [0_u32; N];
        for k in 0..N {
            first[k] = self.first_line(column[k] as usize, u[1][k]);
        }
        for k in 0..N {
            row[k] = self.row::<SIDES>(column[k] as usize, first[k] as usize, t[k], target[k]);
        }
        for k in 0..N {
            let cell = self.cell::<SIDES>(column[k] as usize, row[k] as usize, t[k]);
            [from[k], ends[0][k], ends[1][k]] = cell;
        }
        let middle = 0.5 * self.layout.height as f32 + offset;
        let per_height = 2.0 / self.layout.height as f32;
        let mut y = [0.0; N];
        for k in 0..N {
            let excess = (target[k] - from[k]).max(0.0);
            let q = if SIDES == 1 {
                excess / ends[0][k].max(f32::MIN_POSITIVE)
            } else {
                let (a, b) = (ends[0][k], ends[1][k]);
                let root = math::sqrt((a * a + 2.0 * (b - a) * excess).max(0.0));
                2.0 * excess / (a + root).max(f32::MIN_POSITIVE)
            };
            let chord = math::sqrt((1.0 - x[k] * x[k]).max(0.0)) * (1.0 - 4.0 * f32::EPSILON);
            y[k] = (((row[k] as i32 as f32 - middle) + q.max(margins[1]).min(1.0 - margins[1])) * per_height)
                .max(-chord)
                .min(chord);
        }
        [x, y]
    }

    /// The first of the lines among which the quantile `u` of a column should be.
    #[inline(always)]
    fn first_line(&self, column: usize, u: f32) -> u32 {
        let quantiles = self.layout.quantiles;
        let place = u * quantiles as f32;
        let part = index(place);
        match self.quantiles.get(column * (quantiles + 1) + part as usize..) {
            Some(&[from, to, ..]) => {
                index(from + (to - from) * (place - part as i32 as f32) - (LINES / 2 - 1) as f32)
            }
            _ => 0,
        }
    }

    /// The row in which the conditional reaches `target`.
    #[inline(always)]
    fn row<const SIDES: usize>(&self, column: usize, first: usize, t: f32, target: f32) -> u32 {
        let lines = self.layout.lines();
        let sides = [column, column + SIDES - 1];
        let [left, right] = sides
            .map(|side| self.sums.get(side * lines + first..).and_then(|sums| sums.first_chunk::<LINES>()));
        let mut before = 0;
        if let (Some(left), Some(right)) = (left, right) {
            for (&left, &right) in left.iter().zip(right) {
                before += u32::from(mix::<SIDES>(left, right, t) <= target);
            }
        }
        let row = first as u32 + before;
        if (1..LINES as u32).contains(&before) && row <= self.layout.kind.cells(self.layout.height) as u32 {
            row - 1
        } else {
            // Beyond what was looked through, or beyond the weight of the column.
            self.search::<SIDES>(sides, t, target)
        }
    }

    /// The integral to the beginning of a row, and its values there and at its end.
    #[inline(always)]
    fn cell<const SIDES: usize>(&self, column: usize, row: usize, t: f32) -> [f32; 3] {
        let side = |side: usize| {
            let sum = self.sums.get(side * self.layout.lines() + row).copied().unwrap_or(0.0);
            match self.values.get(side * self.layout.stride() + row..) {
                Some(&[a, b, ..]) => [sum, a, b],
                _ => [sum, 0.0, 0.0],
            }
        };
        let left = side(column);
        let right = if SIDES == 1 { left } else { side(column + 1) };
        [0, 1, 2].map(|of| mix::<SIDES>(left[of], right[of], t))
    }

    /// The last row that begins at or below `target` and has weight, by halving.
    #[cold]
    fn search<const SIDES: usize>(&self, [left, right]: [usize; 2], t: f32, target: f32) -> u32 {
        let lines = self.layout.lines();
        let column = |side: usize| self.sums.get(side * lines..(side + 1) * lines).unwrap_or_default();
        let (left, right) = (column(left), column(right));
        let at = |line: usize| match (left.get(line), right.get(line)) {
            (Some(&l), Some(&r)) => mix::<SIDES>(l, r, t),
            _ => f32::MAX,
        };
        let rows = self.layout.kind.cells(self.layout.height);
        let [bottom, top] = [at(0), at(rows)];
        let reaches = |line: usize| {
            if target >= top { at(line) >= top } else { at(line) > target.max(bottom) }
        };
        let (mut low, mut high) = (0, rows);
        while high - low > 1 {
            let middle = low.midpoint(high);
            if reaches(middle) {
                high = middle;
            } else {
                low = middle;
            }
        }
        low as u32
    }

    /// `(M, C)` of a block of normals.
    #[inline(always)]
    pub(crate) fn forward_block<const N: usize, const SIDES: usize>(
        &self,
        n: [&[f32; N]; 2],
    ) -> [[f32; N]; 2] {
        let parts = self.layout.guide as f32;
        let n = n.map(|n| n.map(|n| if n.is_nan() { 0.0 } else { bounded(n, -1.0, 1.0) }));
        let part = n[0].map(|x| index((x * 0.5 + 0.5) * parts).min(self.layout.guide as u32 - 1));
        let mut at = [0_u32; N];
        for k in 0..N {
            at[k] = found(self.places, self.by_place, part[k], n[0][k]).min(self.layout.slabs as u32 - 1);
        }
        let slabs = Slabs::load(self.slabs, &at);
        let [_, _, begin, wide, m0, m1, m2, m3, b0, b1, b2, b3, column, w0, w1, x0] = &slabs.numbers;
        let column = column.map(f32::to_bits);
        let half_width = 0.5 * self.layout.width as f32;
        let (height, offset) = (self.layout.height as f32, self.layout.kind.offset() as f32);
        let last = self.layout.kind.cells(self.layout.height) as u32 - 1;
        let middle = 0.5 * height + offset;
        let (mut u1, mut t, mut marginal, mut below) = ([0.0; N], [0.0; N], [0.0; N], [0.0; N]);
        let (mut q, mut row) = ([0.0; N], [0_u32; N]);
        for k in 0..N {
            let s = bounded((n[0][k] - x0[k]) * half_width / wide[k].max(f32::MIN_POSITIVE), 0.0, 1.0);
            t[k] = (begin[k] + wide[k] * s).min(1.0);
            let weight = [m0[k], m1[k], m2[k], m3[k]];
            let share =
                quartic(weight, s) / (weight[0] + weight[1] + weight[2] + weight[3]).max(f32::MIN_POSITIVE);
            u1[k] = (w0[k] + (w1[k] - w0[k]) * share).min(w1[k]);
            marginal[k] = cubic(weight, s);
            below[k] = cubic([b0[k], b1[k], b2[k], b3[k]], s);
            let y = n[1][k] * (0.5 * height) + middle;
            row[k] = index(y).min(last);
            q[k] = bounded(n[1][k] * (0.5 * height) + (middle - row[k] as i32 as f32), 0.0, 1.0);
        }
        let mut u2 = [0.0; N];
        for k in 0..N {
            let [sum, a, b] = self.cell::<SIDES>(column[k] as usize, row[k] as usize, t[k]);
            let within = if SIDES == 1 { q[k] * a } else { q[k] * (a + 0.5 * q[k] * (b - a)) };
            u2[k] = (sum + within) + below[k];
        }
        for k in 0..N {
            let conditional = u2[k] / marginal[k];
            // Without weight the conditional is uniform on the chord.
            let chord = math::sqrt((1.0 - n[0][k] * n[0][k]).max(f32::MIN_POSITIVE));
            let uniform = 0.5 * (n[1][k] / chord) + 0.5;
            u2[k] = bounded(if marginal[k] > 0.0 { conditional } else { uniform }, 0.0, 1.0);
        }
        [u1, u2]
    }

    /// The densities `D` of a block of normals, by their first two coordinates.
    #[inline(always)]
    pub(crate) fn density_block<const N: usize, const SIDES: usize>(&self, n: [&[f32; N]; 2]) -> [f32; N] {
        let kind = self.layout.kind;
        let offset = kind.offset() as f32;
        let (half_width, half_height) = (0.5 * self.layout.width as f32, 0.5 * self.layout.height as f32);
        let (columns, rows) = (kind.cells(self.layout.width) as u32, kind.cells(self.layout.height) as u32);
        let (mut column, mut row, mut t, mut q) = ([0_u32; N], [0_u32; N], [0.0; N], [0.0; N]);
        for k in 0..N {
            let (x, y) = (
                n[0][k] * half_width + (half_width + offset),
                n[1][k] * half_height + (half_height + offset),
            );
            column[k] = index(x).min(columns - 1);
            row[k] = index(y).min(rows - 1);
            t[k] = x - column[k] as i32 as f32;
            q[k] = y - row[k] as i32 as f32;
        }
        let stride = self.layout.stride();
        let mut corners = [[0.0; N]; 4];
        for k in 0..N {
            let [left, right] = [column[k] as usize, column[k] as usize + SIDES - 1];
            let row = row[k] as usize;
            if SIDES == 1 {
                corners[0][k] = self.values.get(left * stride + row).copied().unwrap_or(0.0);
                continue;
            }
            if let Some(&[a, b, ..]) = self.values.get(left * stride + row..) {
                (corners[0][k], corners[1][k]) = (a, b);
            }
            if let Some(&[a, b, ..]) = self.values.get(right * stride + row..) {
                (corners[2][k], corners[3][k]) = (a, b);
            }
        }
        let mut density = [0.0; N];
        for k in 0..N {
            let value = if SIDES == 1 {
                corners[0][k]
            } else {
                let (p, r) = (1.0 - q[k], 1.0 - t[k]);
                r * (p * corners[0][k] + q[k] * corners[1][k])
                    + t[k] * (p * corners[2][k] + q[k] * corners[3][k])
            };
            let inside = n[0][k] * n[0][k] + n[1][k] * n[1][k] <= 1.0 + 1e-6;
            density[k] = if inside { (0.25 * value).max(0.0) } else { 0.0 };
        }
        density
    }
}

/// `x` from `least` to `most`, NaN as `least`.
#[inline(always)]
fn bounded(x: f32, least: f32, most: f32) -> f32 {
    x.max(least).min(most)
}

/// The integer below `x` (or `x`, or the one below, if it is one) for 0 ≤ x < 2²²: in two operations that all lanes have.
#[inline(always)]
fn index(x: f32) -> u32 {
    ((x - 0.5).max(0.0) + 8_388_608.0).to_bits() & 0x7f_ffff
}

/// The last key that is at most `value`, from where the guide says.
#[inline(always)]
fn found(keys: &[f32], guide: &[f32], part: u32, value: f32) -> u32 {
    let mut at = guide.get(part as usize).map_or(0, |start| start.to_bits() as usize);
    while let Some(next) = keys.get(at + 1..).and_then(|keys| keys.first_chunk::<KEYS>()) {
        let mut more = 0;
        for &key in next {
            more += u32::from(key <= value);
        }
        at += more as usize;
        if more < KEYS as u32 {
            break;
        }
    }
    at as u32
}

/// `a` at t = 0, `b` at t = 1; with one side `a`.
#[inline(always)]
fn mix<const SIDES: usize>(a: f32, b: f32, t: f32) -> f32 {
    if SIDES == 1 { a } else { (1.0 - t) * a + t * b }
}

/// A polynomial by its Bernstein coefficients.
#[inline(always)]
fn cubic([b0, b1, b2, b3]: [f32; 4], s: f32) -> f32 {
    let r = 1.0 - s;
    r * r * (r * b0 + 3.0 * s * b1) + s * s * (3.0 * r * b2 + s * b3)
}

/// Four times its integral from 0 to `s`.
#[inline(always)]
fn quartic([b0, b1, b2, b3]: [f32; 4], s: f32) -> f32 {
    let r = 1.0 - s;
    let (g2, g3) = (b0 + b1, b0 + b1 + b2);
    s * (r * r * (4.0 * r * b0 + 6.0 * s * g2) + s * s * (4.0 * r * g3 + s * (g3 + b3)))
}
