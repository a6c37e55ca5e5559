//! The uniform numbers of normals of a packed map, in stages.

use crate::map::packed::block::{Group, Staged, copy_guide, entries, find_leaves, of, of_mut, sides};
use crate::map::packed::grid::Grid;
use crate::map::packed::inverse_cdf::{integrals, marginals};
use crate::map::packed::leaf::BEGIN;
use crate::map::packed::packed_map::PackedMapRef;
use asperity_core::lanes::Lanes;

/// `(M, C)`.
pub(crate) struct Forward;

impl Staged<2> for Forward {
    type Group<const L: usize> = Group<L>;
    const FEW: usize = 6;

    #[inline(always)]
    fn apply<P: Lanes, const L: usize, const SIDES: usize>(
        map: &PackedMapRef<'_>,
        p: P,
        groups: &mut [Group<L>],
    ) {
        for group in groups.iter_mut() {
            map.place::<P, L, SIDES>(p, group);
        }
        copy_guide(map.by_place, groups);
        let (heads, leaves) = (map.heads, map.leaves);
        for group in groups.iter_mut() {
            let values = group.target;
            find_leaves::<P, L, BEGIN>(p, leaves, group, &values);
        }
        for group in groups.iter_mut() {
            for k in 0..L {
                let at = group.at[k] as usize;
                let (Some(head), Some([_, cubics])) = (heads.get(at), leaves.get(at)) else { continue };
                group.other_fours[k] = *head;
                group.eights[k] = *cubics;
            }
        }
        let [left, right] = sides::<SIDES>(map.nodes, map.grid.stride);
        for group in groups.iter_mut() {
            for k in 0..L {
                let (at, t) = (group.row[k], group.t[k]);
                if SIDES == 1 {
                    let Some(nodes) = entries(left, at) else { continue };
                    group.twos[k] = *nodes;
                } else {
                    let (Some(left), Some(right)) = (entries(left, at), entries(right, at)) else { continue };
                    group.fours[k] = p.blended4([left, right], [1.0 - t, t]);
                }
            }
        }
        for group in groups.iter_mut() {
            uniforms::<P, L, SIDES>(p, group);
        }
    }
}

impl PackedMapRef<'_> {
    /// The part of the guide, the column, the row and the positions in them.
    #[inline(always)]
    fn place<P: Lanes, const L: usize, const SIDES: usize>(&self, p: P, group: &mut Group<L>) {
        let Grid { density, origin, last, guide, stride, .. } = self.grid;
        for from in (0..L).step_by(P::LEN) {
            let x = coordinate(p, p.load(of(p, &group.input[0], from)));
            let y = coordinate(p, p.load(of(p, &group.input[1], from)));
            let half = p.float(0.5 * guide);
            let part = p.truncated(p.min(x * half + half, p.float(guide - 0.5)));
            let at = x * p.float(density[0]);
            let (column, t) = self.column(p, at, [origin[0], last[0]]);
            let (row, q) = self.column(p, y * p.float(density[1]), [origin[1], last[1]]);
            let node = column * p.word(stride) + row * p.word(SIDES as u32);
            p.store_words(part, of_mut(p, &mut group.at, from));
            p.store_words(node, of_mut(p, &mut group.row, from));
            p.store(at, of_mut(p, &mut group.target, from));
            p.store(t, of_mut(p, &mut group.t, from));
            p.store(q, of_mut(p, &mut group.output[1], from));
        }
    }
}

/// Clamps to [−1, 1]; NaN becomes 0.
#[inline(always)]
fn coordinate<P: Lanes>(p: P, n: P::F) -> P::F {
    let n = p.select(p.at_or_below(n, n), n, p.float(0.0));
    p.min(p.max(n, p.float(-1.0)), p.float(1.0))
}

/// `M` and `C`.
#[inline(always)]
fn uniforms<P: Lanes, const L: usize, const SIDES: usize>(p: P, group: &mut Group<L>) {
    let (zero, half, tiny) = (p.float(0.0), p.float(0.5), p.float(f32::MIN_POSITIVE));
    for from in (0..L).step_by(P::LEN) {
        let (at, q) = (p.load(of(p, &group.target, from)), p.load(of(p, &group.output[1], from)));
        let [weight, per_sum, begin, per_wide] = p.fields4(of(p, &group.other_fours, from));
        let cubics = p.fields8(of(p, &group.eights, from));
        let s = p.unit((at - begin) * per_wide);
        let u1 = weight + integrals(p, &cubics, s)[0] * per_sum;
        let [marginal, below] = marginals(p, &cubics, s);
        let sum = if SIDES == 1 {
            let [begin, end] = p.fields2(of(p, &group.twos, from));
            begin + q * (end - begin)
        } else {
            let [begin, a, _, b] = p.fields4(of(p, &group.fours, from));
            begin + q * (a + half * q * (b - a))
        };
        let mut u2 = p.unit((sum + below) / p.max(marginal, tiny));
        if p.any(p.less(marginal, tiny)) {
            // Without weight the conditional is uniform on the chord.
            let x = coordinate(p, p.load(of(p, &group.input[0], from)));
            let y = coordinate(p, p.load(of(p, &group.input[1], from)));
            let chord = p.sqrt(p.max(p.float(1.0) - x * x, tiny));
            u2 = p.select(p.less(zero, marginal), u2, p.unit(half * (y / chord) + half));
        }
        p.store(p.min(u1, p.float(1.0)), of_mut(p, &mut group.output[0], from));
        p.store(u2, of_mut(p, &mut group.output[1], from));
    }
}
