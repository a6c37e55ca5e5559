//! Samples of a packed map in lanes.

use crate::map::packed::fetch::{PairKernel, mixed, quads, sides};
use crate::map::packed::grid::Grid;
use crate::map::packed::layout::{KEYS, LINES};
use crate::map::packed::packed_map::PackedMapRef;
use crate::map::packed::record::{LEAF, MANY_STEPS, MARGINAL, Rows};
use crate::math;
use crate::numeric::bernstein::{inverse_share, kept_away};
use crate::simd::gather::Gather;

/// The largest `f32` below 1.
const BELOW_ONE: f32 = 1.0 - f32::EPSILON / 2.0;

/// Weight that a sample leaves on either side of it where the chord shrinks to a point, as the exact map does.
const LEAST_MASS: f64 = 1e-7;

/// `(M, C)⁻¹`.
pub(crate) struct Inverse;

impl PairKernel<2> for Inverse {
    #[inline(always)]
    fn apply<P: Gather<N>, const N: usize, const SIDES: usize>(
        map: &PackedMapRef<'_>,
        p: P,
        u: [P::F; 2],
    ) -> [P::F; 2] {
        let one = p.float(1.0);
        let u1 = p.at_most(p.at_least(u[0], 0.0), BELOW_ONE);
        let u2 = p.at_most(p.at_least(u[1], 0.0), BELOW_ONE);
        let (_, parts) = p.below(u1 * p.float(map.grid.guide));
        let (parts, weights) = (p.words(parts), p.floats(u1));
        let leaf = map.leaf(&parts, &weights);
        let mut leaves = [&[0.0; LEAF]; N];
        for k in 0..N {
            leaves[k] = map.leaves.get(leaf[k] as usize).unwrap_or(&[0.0; LEAF]);
        }
        let [from, per, c0, c1] = quads(p, &leaves, 0);
        let [c2, c3, begin, wide] = quads(p, &leaves, 1);
        let [cubic, bin, steps, _] = quads(p, &leaves, 2);
        let cubics = map.cubics(&p.words(p.bits(cubic)));

        let share = p.at_most(p.at_least((u1 - from) * per, 0.0), 1.0);
        let mut s = share + share * (one - share) * (c0 + share * (c1 + share * (c2 + share * c3)));
        if p.any(p.less(p.float(0.0), steps)) {
            let [weight, marginal, ..] = mixed(p, &cubics, s);
            let slope =
                p.at_least(wide * marginal * p.float(map.grid.weight_per_marginal), f32::MIN_POSITIVE);
            let nearer = s - (s * weight - (u1 - from)) / slope;
            let nearer = p.select(p.less(p.float(0.0), steps), nearer, s);
            s = p.of_floats(&many_steps(&leaves, &cubics, &weights, p.floats(nearer)));
        }
        s = p.at_most(p.at_least(s, 0.0), 1.0);
        let [_, marginal, below, _] = mixed(p, &cubics, s);

        let Grid { size, origin, margin, .. } = map.grid;
        // Not on a line, from which the normal might round into the next bin.
        let within = p.at_most(p.at_least(begin + wide * s, margin[0]), 1.0 - margin[0]);
        let bin = p.float_of_word(p.bits(bin));
        let x = ((bin - p.float(origin[0])) + within) * p.float(size[0]);
        let x = p.at_most(p.at_least(x, -1.0), 1.0);
        let (column, t) = map.column(p, bin, within);
        let target = u2 * marginal - below;

        let r = one - t;
        let (row, [from, a, next, b]) = map.rows::<P, N, SIDES>(p, column, u2, [r, t], target);
        let excess = p.at_least(target - from, 0.0);
        let q = if SIDES == 1 {
            excess / p.at_least(next - from, f32::MIN_POSITIVE)
        } else {
            let twice = excess + excess;
            let root = p.sqrt(p.at_least(a * a + (b - a) * twice, 0.0));
            twice / p.at_least(a + root, f32::MIN_POSITIVE)
        };
        let q = p.at_most(p.at_least(q, margin[1]), 1.0 - margin[1]);
        let y = ((p.float_of_word(row) - p.float(origin[1])) + q) * p.float(size[1]);
        let outside = p.less(p.float(1.0 - 4.0 * f32::EPSILON), x * x + y * y);
        if p.any(outside) {
            let places = [x, y, t].map(|place| p.floats(place));
            return [x, p.of_floats(&map.inside::<N, SIDES>(p.words(column), places))];
        }
        [x, y]
    }
}

impl PackedMapRef<'_> {
    /// The leaves in which the weights `u` are reached, from where the guide says.
    #[inline(always)]
    fn leaf<const N: usize>(&self, parts: &[u32; N], u: &[f32; N]) -> [u32; N] {
        let (mut leaf, mut more) = ([0; N], false);
        for k in 0..N {
            let start = self.by_weight.get(parts[k] as usize).map_or(0, |start| start.to_bits());
            let (&[first, second], _) = sides::<KEYS, 1>(self.weights, start, 0);
            // Whether the first one is passed is never clear before, the second seldom is.
            leaf[k] = start.wrapping_add(u32::from(first <= u[k]) + u32::from(second <= u[k]));
            more |= second <= u[k];
        }
        if more {
            for k in 0..N {
                let passed = |leaf: u32| self.weights.get(leaf as usize).is_some_and(|&next| next <= u[k]);
                while passed(leaf[k]) {
                    leaf[k] += 1;
                }
            }
        }
        leaf
    }

    /// The rows in which conditionals reach their targets.
    #[inline(always)]
    fn rows<P: Gather<N>, const N: usize, const SIDES: usize>(
        &self,
        p: P,
        column: P::U,
        u: P::F,
        [r, t]: [P::F; 2],
        target: P::F,
    ) -> (P::U, [P::F; 4]) {
        let place = u * p.float(self.grid.quantiles);
        let (part, parts) = p.below(place);
        let ranks = p.words(column * p.word(self.grid.ranks) + parts);
        let mut pairs = [[0.0; 4]; N];
        for k in 0..N {
            let ([before, after], _) = sides::<2, 1>(self.quantiles, ranks[k], 0);
            pairs[k] = [*before, *after, 0.0, 0.0];
        }
        let [before, after, ..] = p.transposed(&pairs.each_ref());
        let guess = before + (after - before) * (place - part) - p.float((LINES / 2 - 1) as f32);
        let (_, first) = p.below(guess);
        let stride = self.grid.stride;
        let (first, at) = (p.words(first), p.words(column * p.word(stride) + (first + first)));
        let (rs, ts, targets) = (p.floats(r), p.floats(t), p.floats(target));
        let (mut row, mut nodes) = ([0; N], [[0.0; 4]; N]);
        let mut found = true;
        for k in 0..N {
            let (left, right) = sides::<{ 2 * LINES }, SIDES>(self.nodes, at[k], stride);
            let (reached, four) = p.reached::<SIDES>([left, right], [rs[k], ts[k]], targets[k]);
            let before = reached.wrapping_sub(1);
            (row[k], nodes[k]) = (first[k].wrapping_add(before), four);
            found &= before < LINES as u32 - 1 && row[k] <= self.grid.last_row;
        }
        if !found {
            let columns = p.words(column);
            for k in 0..N {
                let before = row[k].wrapping_sub(first[k]);
                if before >= LINES as u32 - 1 || row[k] > self.grid.last_row {
                    (row[k], nodes[k]) =
                        self.search::<SIDES>(columns[k] as usize, [rs[k], ts[k]], targets[k]);
                }
            }
        }
        (p.of_words(&row), p.transposed(&nodes.each_ref()))
    }

    /// The last row that begins at or below `target` and has weight, by halving, and its nodes.
    #[cold]
    fn search<const SIDES: usize>(&self, column: usize, [r, t]: [f32; 2], target: f32) -> (u32, [f32; 4]) {
        let stride = self.grid.stride as usize;
        let side = |side: usize| self.nodes.get(side * stride..(side + 1) * stride).unwrap_or_default();
        let (left, right) = (side(column), side(column + SIDES - 1));
        let number = |k: usize, none: f32| match (left.get(k), right.get(k)) {
            (Some(left), Some(_)) if SIDES == 1 => *left,
            (Some(left), Some(right)) => r * left + t * right,
            _ => none,
        };
        let at = |line: usize| number(2 * line, f32::MAX);
        let rows = self.grid.last_row as usize + 1;
        let [bottom, top] = [at(0), at(rows)];
        let reaches =
            |line: usize| if target >= top { at(line) >= top } else { at(line) > target.max(bottom) };
        let (mut low, mut high) = (0, rows);
        while high - low > 1 {
            let middle = low.midpoint(high);
            if reaches(middle) {
                high = middle;
            } else {
                low = middle;
            }
        }
        (low as u32, [0, 1, 2, 3].map(|k| number(2 * low + k, 0.0)))
    }

    /// The places `y`, with those beyond the chord moved to its end, or to where there is weight from there on.
    #[cold]
    fn inside<const N: usize, const SIDES: usize>(
        &self,
        column: [u32; N],
        places: [[f32; N]; 3],
    ) -> [f32; N] {
        let Grid { density, size, origin, last_row, stride, .. } = self.grid;
        let [x, mut y, t] = places;
        for k in 0..N {
            if x[k] * x[k] + y[k] * y[k] <= 1.0 - 4.0 * f32::EPSILON {
                continue;
            }
            let chord = math::sqrt((1.0 - x[k] * x[k]).max(0.0)) * (1.0 - 4.0 * f32::EPSILON);
            let end = y[k].clamp(-chord, chord);
            let has_weight = |row: u32| {
                let at = column[k].wrapping_mul(stride).wrapping_add(2 * row);
                let (left, right) = sides::<4, SIDES>(self.nodes, at, stride);
                let [from, to] = [0, 2].map(|of| (1.0 - t[k]) * left[of] + t[k] * right[of]);
                from < to
            };
            let row_at = |y: f32| ((y * density[1] + origin[1]) as u32).min(last_row);
            let (first, last) = (row_at(-chord), row_at(chord));
            let nearest = if y[k] < 0.0 {
                (first..=last).find(|&row| has_weight(row))
            } else {
                (first..=last).rev().find(|&row| has_weight(row))
            };
            y[k] = match nearest {
                Some(row) if row != row_at(end) => {
                    let margin = if y[k] < 0.0 { self.grid.margin[1] } else { 1.0 - self.grid.margin[1] };
                    ((row as f32 - origin[1] + margin) * size[1]).clamp(-chord, chord)
                }
                _ => end,
            };
        }
        y
    }
}

/// The places `s` in leaves, with those found anew that need many steps.
#[cold]
fn many_steps<const N: usize>(
    leaves: &[&[f32; LEAF]; N],
    cubics: &[&Rows; N],
    weights: &[f32; N],
    mut s: [f32; N],
) -> [f32; N] {
    for k in 0..N {
        let [from, .., steps, to] = *leaves[k];
        if steps >= MANY_STEPS {
            let [from, to] = [from, to].map(f64::from);
            let marginal = [(0, 1.0), (1, 3.0), (2, 3.0), (3, 1.0)];
            let marginal = marginal.map(|(row, times)| f64::from(cubics[k][row][MARGINAL]) / times);
            let share = ((f64::from(weights[k]) - from) / (to - from)).clamp(0.0, 1.0);
            s[k] = inverse_share(marginal, kept_away(marginal, share, LEAST_MASS / (to - from))) as f32;
        }
    }
    s
}
