//! Samples of a packed map, in stages.

use crate::map::packed::block::{Group, Staged, copy_guide, entries, find_leaves, of, of_mut, sides};
use crate::map::packed::grid::Grid;
use crate::map::packed::layout::LINES;
use crate::map::packed::leaf::{C0, MANY_STEPS, WEIGHT, many_steps};
use crate::map::packed::packed_map::PackedMapRef;
use asperity_core::lanes::Lanes;

/// The largest `f32` below 1.
const BELOW_ONE: f32 = 1.0 - f32::EPSILON / 2.0;

/// `(M, C)⁻¹`.
pub(crate) struct Inverse;

impl Staged<2> for Inverse {
    type Group<const L: usize> = Group<L>;
    const FEW: usize = 4;

    #[inline(always)]
    fn apply<P: Lanes, const L: usize, const SIDES: usize>(
        map: &PackedMapRef<'_>,
        p: P,
        groups: &mut [Group<L>],
    ) {
        for group in groups.iter_mut() {
            map.guide_by_weight(p, group);
        }
        copy_guide(map.by_weight, groups);
        let leaves = map.leaves;
        for group in groups.iter_mut() {
            let values = group.input[0];
            find_leaves::<P, L, WEIGHT>(p, leaves, group, &values);
        }
        for group in groups.iter_mut() {
            for k in 0..L {
                let Some([inverse, cubics]) = leaves.get(group.at[k] as usize) else { continue };
                group.eights[k] = *inverse;
                group.other_eights[k] = *cubics;
            }
        }
        for group in groups.iter_mut() {
            map.x::<P, L, SIDES>(p, group);
        }
        let quantiles = map.quantiles;
        for group in groups.iter_mut() {
            for k in 0..L {
                let Some(two) = entries(quantiles, group.at[k]) else { continue };
                group.twos[k] = *two;
            }
        }
        for group in groups.iter_mut() {
            map.first_line::<P, L, SIDES>(p, group);
        }
        let nodes = sides::<SIDES>(map.nodes, map.grid.stride);
        for group in groups.iter_mut() {
            for k in 0..L {
                fill_window::<P, L, SIDES>(p, nodes, group, k);
            }
        }
        for group in groups.iter_mut() {
            map.y::<P, L, SIDES>(p, group);
        }
    }
}

impl PackedMapRef<'_> {
    /// The parts of the guide.
    #[inline(always)]
    fn guide_by_weight<P: Lanes, const L: usize>(&self, p: P, group: &mut Group<L>) {
        for from in (0..L).step_by(P::LEN) {
            for axis in 0..2 {
                let u = p.min(p.at_least(p.load(of(p, &group.input[axis], from)), 0.0), p.float(BELOW_ONE));
                p.store(u, of_mut(p, &mut group.input[axis], from));
                if axis == 0 {
                    let part = p.truncated(u * p.float(self.grid.guide));
                    p.store_words(part, of_mut(p, &mut group.at, from));
                }
            }
        }
    }

    /// `x` from the leaves, and the integral to search for in its column.
    #[inline(always)]
    fn x<P: Lanes, const L: usize, const SIDES: usize>(&self, p: P, group: &mut Group<L>) {
        let Grid { density, size, origin, last, .. } = self.grid;
        let (zero, one) = (p.float(0.0), p.float(1.0));
        for from in (0..L).step_by(P::LEN) {
            let (u1, u2) = (p.load(of(p, &group.input[0], from)), p.load(of(p, &group.input[1], from)));
            let [weight, per, begin, wide, c0, c1, c2, c3] = p.fields8(of(p, &group.eights, from));
            let cubics = p.fields8(of(p, &group.other_eights, from));
            let r = p.unit((u1 - weight) * per);
            let bent = (c0 + r * c1) + (r * r) * (c2 + r * c3);
            let mut s = p.unit(r + r * (one - r) * bent);
            let flagged = p.less(wide, zero);
            let is_any_flagged = p.any(flagged);
            if is_any_flagged {
                s = p.select(flagged, newton(p, &cubics, r, s), s);
                if p.any(p.less(p.float(0.5 * MANY_STEPS), c0)) {
                    let mut places = [0.0; L];
                    p.store(s, &mut places);
                    for k in from..from + P::LEN {
                        let leaf = [group.eights[k], group.other_eights[k]];
                        if leaf[0][C0] == MANY_STEPS {
                            places[k - from] = many_steps(leaf, group.input[0][k]);
                        }
                    }
                    s = p.load(&places);
                }
            }
            let wide = p.max(wide, -wide);
            let x = p.min(p.max((begin + wide * s) * p.float(size[0]), p.float(-1.0)), one);
            // A piece lies in one column, so the column does not depend on the position in the
            // piece.
            let origin = p.float(origin[0]);
            let column = p.truncated(p.min(begin + p.float(0.5) * wide + origin, p.float(last[0])));
            // The conditional uses the rounded position, which the inverse finds again.
            let at = x * p.float(density[0]);
            let t = p.unit(at - (p.real(column) - origin));
            if is_any_flagged {
                s = p.select(flagged, place(p, at, begin, wide), s);
            }
            let [marginal, below] = marginals(p, &cubics, s);
            p.store(x, of_mut(p, &mut group.output[0], from));
            p.store(t, of_mut(p, &mut group.t, from));
            p.store(u2 * marginal - below, of_mut(p, &mut group.target, from));
            let part = p.truncated(u2 * p.float(self.grid.quantiles));
            p.store_words(column, of_mut(p, &mut group.column, from));
            p.store_words(column * p.word(self.grid.ranks) + part, of_mut(p, &mut group.at, from));
        }
    }

    /// The line before the row given by the quantiles.
    #[inline(always)]
    fn first_line<P: Lanes, const L: usize, const SIDES: usize>(&self, p: P, group: &mut Group<L>) {
        for from in (0..L).step_by(P::LEN) {
            let place = p.load(of(p, &group.input[1], from)) * p.float(self.grid.quantiles);
            let [before, after] = p.fields2(of(p, &group.twos, from));
            let part = p.real(p.truncated(place));
            let guess = before + (after - before) * (place - part) - p.float(1.0);
            let row = p.truncated(p.min(p.max(guess, p.float(0.0)), p.float(self.grid.last_row as f32)));
            let column = p.load_words(of(p, &group.column, from));
            let at = column * p.word(self.grid.stride) + row * p.word(SIDES as u32);
            p.store_words(row, of_mut(p, &mut group.row, from));
            p.store_words(at, of_mut(p, &mut group.at, from));
        }
    }

    /// `y` from the three rows between these lines, or by a search if it is in none of them.
    #[inline(always)]
    fn y<P: Lanes, const L: usize, const SIDES: usize>(&self, p: P, group: &mut Group<L>) {
        let Grid { size, origin, margin, .. } = self.grid;
        let (zero, one) = (p.float(0.0), p.float(1.0));
        for from in (0..L).step_by(P::LEN) {
            let mut target = p.load(of(p, &group.target, from));
            let mut lines = window::<P, L, SIDES>(p, group, from);
            let missed = p.either(p.less(target, lines[0][0]), p.at_or_below(lines[3][0], target));
            if p.any(missed) {
                for k in from..from + P::LEN {
                    let ends = match SIDES {
                        1 => [group.fours[k][0], group.fours[k][3]],
                        _ => [group.eights[k][0], group.eights[k][6]],
                    };
                    if group.target[k] < ends[0] || ends[1] <= group.target[k] {
                        let (row, target) =
                            self.search::<SIDES>(group.column[k], group.t[k], group.target[k], group.row[k]);
                        (group.row[k], group.target[k]) = (row, target);
                        group.at[k] = group.column[k]
                            .wrapping_mul(self.grid.stride)
                            .wrapping_add(row.wrapping_mul(SIDES as u32));
                        let nodes = sides::<SIDES>(self.nodes, self.grid.stride);
                        fill_window::<P, L, SIDES>(p, nodes, group, k);
                    }
                }
                target = p.load(of(p, &group.target, from));
                lines = window::<P, L, SIDES>(p, group, from);
            }
            let [first, second, third, fourth] = lines;
            let passed = [p.at_or_below(second[0], target), p.at_or_below(third[0], target)];
            let begin = chosen(p, passed, [first[0], second[0], third[0]]);
            let excess = p.max(target - begin, zero);
            let q = if SIDES == 1 {
                let end = chosen(p, passed, [second[0], third[0], fourth[0]]);
                excess / p.max(end - begin, p.float(f32::MIN_POSITIVE))
            } else {
                let a = chosen(p, passed, [first[1], second[1], third[1]]);
                let b = chosen(p, passed, [second[1], third[1], fourth[1]]);
                let twice = excess + excess;
                let root = p.sqrt(p.max(a * a + (b - a) * twice, zero));
                twice / p.max(a + root, p.float(f32::MIN_POSITIVE))
            };
            let q = p.min(p.max(q, p.float(margin)), p.float(1.0 - margin));
            let row = p.real(p.load_words(of(p, &group.row, from)));
            let row = row + chosen(p, passed, [zero, one, p.float(2.0)]);
            let x = p.load(of(p, &group.output[0], from));
            let y = ((row - p.float(origin[1])) + q) * p.float(size[1]);
            p.store(y, of_mut(p, &mut group.output[1], from));
            if p.any(p.less(p.float(1.0 - 4.0 * f32::EPSILON), x * x + y * y)) {
                for k in from..from + P::LEN {
                    let at = [group.output[0][k], group.output[1][k]];
                    group.output[1][k] = self.inside::<SIDES>(group.column[k], group.t[k], at);
                }
            }
        }
    }

    /// The column of a position in columns from the middle, and the position in it.
    #[inline(always)]
    pub(crate) fn column<P: Lanes>(&self, p: P, at: P::F, [origin, last]: [f32; 2]) -> (P::U, P::F) {
        let origin = p.float(origin);
        let cell = p.truncated(p.min(at + origin, p.float(last)));
        // Rounding of the sum may select the neighboring cell.
        (cell, p.unit(at - (p.real(cell) - origin)))
    }
}

/// Copies the lines of a lane, at `t` between the left and the right side.
#[inline(always)]
fn fill_window<P: Lanes, const L: usize, const SIDES: usize>(
    p: P,
    [left, right]: [&[f32]; 2],
    group: &mut Group<L>,
    k: usize,
) {
    let (at, t) = (group.at[k], group.t[k]);
    if SIDES == 1 {
        let Some(lines) = entries(left, at) else { return };
        group.fours[k] = *lines;
    } else {
        let (Some(left), Some(right)) = (entries(left, at), entries(right, at)) else { return };
        group.eights[k] = p.blended8([left, right], [1.0 - t, t]);
    }
}

/// The integral, and the value if there are two sides, on each line of a window.
#[inline(always)]
fn window<P: Lanes, const L: usize, const SIDES: usize>(
    p: P,
    group: &Group<L>,
    from: usize,
) -> [[P::F; 2]; LINES] {
    if SIDES == 1 {
        let [a, b, c, d] = p.fields4(of(p, &group.fours, from));
        [[a, a], [b, b], [c, c], [d, d]]
    } else {
        let [a, p0, b, p1, c, p2, d, p3] = p.fields8(of(p, &group.eights, from));
        [[a, p0], [b, p1], [c, p2], [d, p3]]
    }
}

/// The position in a leaf of a position in columns from the middle.
#[inline(always)]
fn place<P: Lanes>(p: P, at: P::F, begin: P::F, wide: P::F) -> P::F {
    p.unit((at - begin) / p.max(p.max(wide, -wide), p.float(f32::MIN_POSITIVE)))
}

/// The first number, or the second or third if one or two lines are passed.
#[inline(always)]
fn chosen<P: Lanes>(p: P, passed: [P::M; 2], [a, b, c]: [P::F; 3]) -> P::F {
    p.select(passed[1], c, p.select(passed[0], b, a))
}

/// The marginal and its part below the middle, from the second half of a leaf, at the position `s`.
#[inline(always)]
pub(crate) fn marginals<P: Lanes>(p: P, &[m0, m1, m2, m3, b0, b1, b2, b3]: &[P::F; 8], s: P::F) -> [P::F; 2] {
    let o = p.float(1.0) - s;
    let (o2, s2) = (o * o, s * s);
    let (a, b, c, d) = (o2 * o, o2 * s, o * s2, s2 * s);
    [(m0 * a + m1 * b) + (m2 * c + m3 * d), (b0 * a + b1 * b) + (b2 * c + b3 * d)]
}

/// Four times the integral of the marginal up to the position `s`, and over the whole leaf.
#[inline(always)]
pub(crate) fn integrals<P: Lanes>(p: P, &[m0, m1, m2, m3, ..]: &[P::F; 8], s: P::F) -> [P::F; 2] {
    let (four, six, third) = (p.float(4.0), p.float(6.0), p.float(1.0 / 3.0));
    let o = p.float(1.0) - s;
    let (o2, s2) = (o * o, s * s);
    let two = m0 + m1 * third;
    let three = two + m2 * third;
    let sum = three + m3;
    let first = o2 * (four * m0 * o + six * two * s);
    [s * (first + s2 * (four * three * o + sum * s)), sum]
}

/// One Newton step towards the fraction `r`.
#[inline(always)]
fn newton<P: Lanes>(p: P, cubics: &[P::F; 8], r: P::F, s: P::F) -> P::F {
    let ([integral, sum], [marginal, _]) = (integrals(p, cubics, s), marginals(p, cubics, s));
    let slope = p.max(p.float(4.0) * marginal, p.float(f32::MIN_POSITIVE));
    p.unit(s - (integral - r * sum) / slope)
}
