//! The uniform numbers and the densities of normals by a packed map, in lanes.

use crate::map::packed::fetch::{PairKernel, mixed};
use crate::map::packed::grid::Grid;
use crate::map::packed::packed_map::PackedMapRef;
use crate::map::packed::record::{BEFORE, BEGIN, BELOW, MARGINAL, WEIGHT, WIDE};
use crate::simd::gather::Gather;
use crate::simd::lanes::Scalar;

/// `(M, C)`.
pub(crate) struct Forward;

impl PairKernel<2> for Forward {
    #[inline(always)]
    fn apply<P: Gather<N>, const N: usize, const SIDES: usize>(
        map: &PackedMapRef<'_>,
        p: P,
        n: [P::F; 2],
    ) -> [P::F; 2] {
        let (zero, one, half) = (p.float(0.0), p.float(1.0), p.float(0.5));
        let (nx, ny) = (p.bounded(n[0], 1.0), p.bounded(n[1], 1.0));
        let Grid { density, origin, last, .. } = map.grid;
        let x = nx * p.float(density[0]);
        let before = p.float(origin[0]);
        let (bin, at) = p.below(p.at_most(x + before, last[0]));
        let within = p.at_most(p.at_least(x - (bin - before), 0.0), 1.0);
        let at = p.words(at);
        let mut parts = mixed(p, &map.cubics(&at), within);
        parts[WEIGHT] = within * parts[WEIGHT];
        if p.any(p.less(parts[BEFORE], zero)) {
            let (within, parts_of) = (p.floats(within), parts.map(|part| p.floats(part)));
            parts = map.in_pieces(&at, &within, parts_of).map(|part| p.of_floats(&part));
        }
        let [weight, marginal, below, before] = parts;
        let u1 = p.at_most(before + weight, 1.0);

        let (column, t) = map.column(p, bin, within);
        let y = ny * p.float(density[1]);
        let middle = p.float(origin[1]);
        let (row, rows) = p.below(p.at_most(y + middle, last[1]));
        let q = p.at_most(p.at_least(y - (row - middle), 0.0), 1.0);
        let [from, a, _, b] = map.nodes::<P, N, SIDES>(p, column, rows, t);
        let sum = if SIDES == 1 { from + q * a } else { from + q * (a + half * q * (b - a)) };
        let conditional = (sum + below) / marginal;
        let mut u2 = p.at_most(p.at_least(conditional, 0.0), 1.0);
        if p.any(p.less(marginal, p.float(f32::MIN_POSITIVE))) {
            // Without weight the conditional is uniform on the chord.
            let chord = p.sqrt(p.at_least(one - nx * nx, f32::MIN_POSITIVE));
            let uniform = p.at_most(p.at_least(half * (ny / chord) + half, 0.0), 1.0);
            u2 = p.select(p.less(zero, marginal), u2, uniform);
        }
        [u1, u2]
    }
}

/// `D`.
pub(crate) struct Density;

impl PairKernel<1> for Density {
    #[inline(always)]
    fn apply<P: Gather<N>, const N: usize, const SIDES: usize>(
        map: &PackedMapRef<'_>,
        p: P,
        [nx, ny]: [P::F; 2],
    ) -> [P::F; 1] {
        let Grid { density, origin, last, .. } = map.grid;
        let per = map.grid.per_split;
        let x = nx * p.float(density[0] * per) + p.float(origin[0] * per);
        let y = ny * p.float(density[1]) + p.float(origin[1]);
        let (column, columns) = p.below(p.at_most(x, (last[0] + 0.5) * per - 0.5));
        let (row, rows) = p.below(p.at_most(y, last[1]));
        let [_, a, _, b] = map.nodes::<P, N, SIDES>(p, columns, rows, x - column);
        let value = if SIDES == 1 { a } else { a + (y - row) * (b - a) };
        let inside = p.less(nx * nx + ny * ny, p.float(1.0 + 1e-6));
        [p.at_least(p.select(inside, p.float(0.25) * value, p.float(0.0)), 0.0)]
    }
}

impl PackedMapRef<'_> {
    /// The parts of places in bins, those of bins with several pieces found anew.
    #[cold]
    fn in_pieces<const N: usize>(
        &self,
        at: &[u32; N],
        within: &[f32; N],
        mut parts: [[f32; N]; 4],
    ) -> [[f32; N]; 4] {
        for k in 0..N {
            let (count, Some(bin)) = (-parts[BEFORE][k], self.cubics.get(at[k] as usize)) else { continue };
            if count > 0.0 {
                let first = (bin[0][MARGINAL] as usize).saturating_add(bin[0][BELOW] as usize);
                let pieces = self.cubics.get(first..).and_then(|pieces| pieces.get(..count as usize));
                let pieces = pieces.unwrap_or_default();
                let before = pieces.partition_point(|piece| piece[BEGIN][BEFORE] <= within[k]);
                let Some(piece) = pieces.get(before.saturating_sub(1)) else { continue };
                let (begin, wide) = (piece[BEGIN][BEFORE], piece[WIDE][BEFORE]);
                let s = ((within[k] - begin) / wide.max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
                let mixed = mixed(Scalar, &[piece], s);
                parts[WEIGHT][k] = s * mixed[WEIGHT];
                parts[MARGINAL][k] = mixed[MARGINAL];
                parts[BELOW][k] = mixed[BELOW];
                parts[BEFORE][k] = piece[0][BEFORE];
            }
        }
        parts
    }
}
