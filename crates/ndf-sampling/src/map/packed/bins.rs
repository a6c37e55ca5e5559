//! The bins of the marginal of a packed map: parts of columns where one cubic does, and pieces where none does.

use alloc::vec::Vec;
use core::ops::Range;

use crate::map::cdf::{Cdf, place_in_column};
use crate::map::disk::half_chord;
use crate::map::packed::record::{
    BEFORE, BEGIN, BELOW, CUBIC_OF, END, LEAF, MANY_STEPS, MARGINAL, ONE_STEP, Rows, WIDE,
};
use crate::map::piece::Piece;
use crate::numeric::bernstein::{Cubic, cubic, inverse_share, kept_away, share};

/// Columns are cut into more bins while the map has fewer than this,
const PIECES: usize = 1024;

/// and more weight than this is in bins where no cubic does.
const IN_SLABS: f32 = 1.0 / 32.0;

/// Largest error of a cubic, of the whole chord's weight, for the weight below and above the middle.
const FIT: f64 = 5e-7;

/// Largest error, in u, of the inverse of a bin's weight.
const INVERSE: f64 = 3e-8;

/// The bins of all columns, in their order.
pub(crate) struct Bins {
    /// Bins of a column.
    pub(crate) split: usize,
    /// Bins.
    count: usize,
    /// Cubics of bins first, then those of pieces.
    pub(crate) cubics: Vec<Rows>,
    /// In the order of x.
    pub(crate) leaves: Vec<[f32; LEAF]>,
}

/// A cubic with all that is needed of it.
struct Bin {
    marginal: Cubic,
    below: Cubic,
    /// Beginning and end, in bins.
    place: [f64; 2],
    /// `M` there.
    weights: [f64; 2],
}

impl Bins {
    pub(crate) fn new(cdf: &Cdf) -> Self {
        let mut bins = Self::split(cdf, 1);
        while bins.in_pieces() > IN_SLABS && 2 * bins.split * cdf.width() <= PIECES {
            bins = Self::split(cdf, 2 * bins.split);
        }
        bins
    }

    /// The weight of bins that have several pieces.
    fn in_pieces(&self) -> f32 {
        let pieces = self.leaves.iter().filter(|leaf| leaf[CUBIC_OF].to_bits() as usize >= self.count);
        pieces.map(|leaf| leaf[END] - leaf[0]).sum()
    }

    fn split(cdf: &Cdf, split: usize) -> Self {
        let (width, kind) = (cdf.width(), cdf.reconstruction());
        let count = kind.cells(width) * split;
        let line = |bin: usize| ((bin as f64 / split as f64 - kind.offset()) / width as f64).clamp(0.0, 1.0);
        let mut cubics = Vec::with_capacity(count);
        let (mut pieces, mut leaves) = (Vec::new(), Vec::new());
        let (mut first, mut before) = (0, 0.0);
        for bin in 0..count {
            let x = [line(bin), line(bin + 1)];
            let range = overlapping(&cdf.pieces, first, x);
            first = range.start;
            let weights = [before, if bin + 1 < count { cdf.marginal_cdf(x[1]) } else { 1.0 }];
            before = weights[1];
            // The bins at either end of the map may begin or end outside it.
            let inside = bin >= split && bin + split < count;
            if let Some(whole) = inside.then(|| fit(cdf, bin / split, x, weights)).flatten() {
                if weights[1] > weights[0] {
                    leaves.push(whole.leaf(bin, bin));
                }
                cubics.push(whole.rows());
                continue;
            }
            let parts = range.filter_map(|k| Bin::of_piece(cdf, k, split, bin));
            let before = pieces.len();
            for part in parts {
                if part.weights[1] > part.weights[0] {
                    leaves.push(part.leaf(count + pieces.len(), bin));
                }
                let mut rows = part.rows();
                rows[BEGIN][BEFORE] = part.place[0] as f32;
                rows[WIDE][BEFORE] = (part.place[1] - part.place[0]) as f32;
                pieces.push(rows);
            }
            cubics.push(link(count + before, pieces.len() - before));
        }
        cubics.append(&mut pieces);
        Self { split, count, cubics, leaves }
    }
}

impl Bin {
    /// The part of a piece that lies in a bin.
    fn of_piece(cdf: &Cdf, piece: usize, split: usize, bin: usize) -> Option<Self> {
        let (width, kind) = (cdf.width() as f64, cdf.reconstruction());
        let weights: &[f64; 2] = cdf.cumulative.get(piece..piece + 2)?.as_array()?;
        let piece = cdf.pieces.get(piece)?;
        let place = piece.x.map(|x| (x * width + kind.offset()) * split as f64 - bin as f64);
        let within = [0.0, 1.0].map(|end: f64| ((end - place[0]) / (place[1] - place[0])).clamp(0.0, 1.0));
        let at = |s: f64| match s {
            0.0 => (place[0], weights[0]),
            1.0 => (place[1], weights[1]),
            _ => (
                place[0] + (place[1] - place[0]) * s,
                weights[0] + (weights[1] - weights[0]) * share(piece.marginal, s),
            ),
        };
        let (begin, end) = (at(within[0]), at(within[1]));
        let [marginal, below] = [piece.marginal, piece.below].map(|b| part(b, within).map(|b| b * cdf.scale));
        Some(Self { marginal, below, place: [begin.0, end.0], weights: [begin.1, end.1] })
    }

    fn leaf(&self, cubic: usize, bin: usize) -> [f32; LEAF] {
        let ([from, to], [begin, end]) = (self.weights, self.place);
        let ([c0, c1, c2, c3], steps) = inverse(self.marginal, to - from);
        let [cubic, bin] = [cubic, bin].map(|k| f32::from_bits(k as u32));
        let per = (1.0 / (f64::from(to as f32) - f64::from(from as f32))).min(f64::from(f32::MAX));
        let (begin, wide) = (begin as f32, (end - begin) as f32);
        [from as f32, per as f32, c0, c1, c2, c3, begin, wide, cubic, bin, steps, to as f32]
    }

    fn rows(&self) -> Rows {
        let mut rows = [[0.0; 4]; 4];
        let ([m0, m1, m2, m3], [b0, b1, b2, b3]) = (self.marginal, self.below);
        let sum = m0 + m1 + m2 + m3;
        let per = if sum > 0.0 { (self.weights[1] - self.weights[0]) / sum } else { 0.0 };
        let weight = [4.0 * m0, 6.0 * (m0 + m1), 4.0 * (m0 + m1 + m2), sum].map(|m| per * m);
        let columns = [weight, [m0, 3.0 * m1, 3.0 * m2, m3], [b0, 3.0 * b1, 3.0 * b2, b3]];
        for (column, numbers) in columns.iter().enumerate() {
            for (row, number) in rows.iter_mut().zip(numbers) {
                row[column] = *number as f32;
            }
        }
        rows[0][BEFORE] = self.weights[0] as f32;
        rows
    }
}

/// The cubic on a part of its bin.
fn part([b0, b1, b2, b3]: Cubic, [from, to]: [f64; 2]) -> Cubic {
    if [from, to] == [0.0, 1.0] {
        return [b0, b1, b2, b3];
    }
    // Its blossom.
    let mix = |a: f64, b: f64, t: f64| (1.0 - t) * a + t * b;
    let blossom = |r: f64, s: f64, t: f64| {
        let [c0, c1, c2] = [mix(b0, b1, r), mix(b1, b2, r), mix(b2, b3, r)];
        mix(mix(c0, c1, s), mix(c1, c2, s), t)
    };
    [blossom(from, from, from), blossom(from, from, to), blossom(from, to, to), blossom(to, to, to)]
}

/// The rows of a bin with several pieces.
fn link(first: usize, count: usize) -> Rows {
    let mut rows = [[0.0; 4]; 4];
    rows[0][BEFORE] = -(count as f32);
    // Two floats that hold it: one might round.
    let rest = first % (1 << 12);
    rows[0][MARGINAL] = (first - rest) as f32;
    rows[0][BELOW] = rest as f32;
    rows
}

/// The pieces that have a part between two places, looked for from `first` on; the nearest one if there is none.
fn overlapping(pieces: &[Piece], first: usize, [begin, end]: [f64; 2]) -> Range<usize> {
    let rest = pieces.get(first..).unwrap_or_default();
    let last = pieces.len().saturating_sub(1);
    let start = (first + rest.iter().take_while(|piece| piece.x[1] <= begin).count()).min(last);
    let within = pieces.get(start..).unwrap_or_default().iter().take_while(|piece| piece.x[0] < end).count();
    start..start + within.max(1)
}

/// A whole bin of a column as one cubic, if that is good enough.
fn fit(cdf: &Cdf, column: usize, x: [f64; 2], weights: [f64; 2]) -> Option<Bin> {
    let at = |s: f64| chord(cdf, column, x[0] + (x[1] - x[0]) * s);
    let nodes = [0.0, 0.25, 0.75, 1.0].map(at);
    let below = through(nodes.map(|[below, _]| below));
    let above = through(nodes.map(|[_, above]| above));
    let good = |s: f64| {
        let exact = at(s);
        let allowed = FIT * (exact[0] + exact[1]);
        (cubic(below, s) - exact[0]).abs() <= allowed && (cubic(above, s) - exact[1]).abs() <= allowed
    };
    let marginal = [0, 1, 2, 3].map(|k| below[k] + above[k]);
    let sound = below.iter().chain(&above).all(|&b| b >= 0.0) && (1..16).all(|k| good(f64::from(k) / 16.0));
    sound.then_some(Bin { marginal, below, place: [0.0, 1.0], weights })
}

/// The integrals of `f` over the parts of the circle's chord at `x` below and above the middle of the map, as in the sums.
fn chord(cdf: &Cdf, column: usize, x: f64) -> [f64; 2] {
    let (columns, kind) = (&cdf.columns, cdf.reconstruction());
    let (strip, height) = (columns.strip(column), columns.height as f64);
    let t = place_in_column(kind, x, columns.width, column);
    let c = half_chord(x) * height;
    [-1.0, 1.0].map(|side| {
        let y = 0.5 * height + kind.offset() + side * c;
        let row = (y as usize).min(kind.cells(columns.height) - 1);
        let q = y - row as f64;
        let [a, b] = strip.row(t, row);
        (side * (strip.sum(t, row) + q * ((1.0 - 0.5 * q) * a + 0.5 * q * b)) * cdf.scale).max(0.0)
    })
}

/// The cubic with these values at 0, ¼, ¾ and 1.
fn through([a, p, q, d]: [f64; 4]) -> Cubic {
    // 64 times it is 27 b₀ + 27 b₁ + 9 b₂ + b₃ at ¼, and the same from behind at ¾.
    let (p, q) = (64.0 * p - 27.0 * a - d, 64.0 * q - a - 27.0 * d);
    [a, (3.0 * p - q) / 72.0, (3.0 * q - p) / 72.0, d]
}

/// The numbers of a leaf's inverse, and which steps it needs to be near enough for a weight of `mass`.
fn inverse(marginal: Cubic, mass: f64) -> ([f32; 4], f32) {
    let sum = marginal.iter().sum::<f64>();
    if sum <= 0.0 {
        return ([0.0; 4], 0.0);
    }
    // Chebyshev's nodes, and divided differences on them.
    let nodes =
        [0.038_060_233_744_356_62, 0.308_658_283_817_455_1, 0.691_341_716_182_544_9, 0.961_939_766_255_643_4];
    let mut c = nodes.map(|r| (inverse_share(marginal, r) - r) / (r * (1.0 - r)));
    for order in 1..4 {
        for k in (order..4).rev() {
            c[k] = (c[k] - c[k - 1]) / (nodes[k] - nodes[k - order]);
        }
    }
    for from in (0..3).rev() {
        for k in from..3 {
            c[k] -= c[k + 1] * nodes[from];
        }
    }
    let near = |steps: usize, r: f64| {
        let mut s = r + r * (1.0 - r) * (c[0] + r * (c[1] + r * (c[2] + r * c[3])));
        for _ in 0..steps {
            s -= (share(marginal, s) - r) * 0.25 * sum / cubic(marginal, s);
        }
        (share(marginal, s.clamp(0.0, 1.0)) - r).abs() * mass < INVERSE
    };
    // Where the marginal vanishes samples are kept away from the end, whatever its weight.
    let away = [0.0, 1.0].map(|share| kept_away(marginal, share, 0.5));
    let all_near = |steps| away == [0.0, 1.0] && (0..=16).all(|k| near(steps, f64::from(k) / 16.0));
    let steps = if all_near(0) {
        0.0
    } else if all_near(1) {
        ONE_STEP
    } else {
        MANY_STEPS
    };
    (c.map(|c| c as f32), steps)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Ggx, NdfMap, Reconstruction};

    #[test]
    fn cubics_are_interpolated_and_cut() {
        let b = [0.3, 1.7, 0.2, 2.5];
        let through = through([0.0, 0.25, 0.75, 1.0].map(|s| cubic(b, s)));
        let part = part(b, [0.2, 0.7]);
        for k in 0..=10 {
            let s = f64::from(k) / 10.0;
            assert_abs_diff_eq!(cubic(through, s), cubic(b, s), epsilon = 1e-14);
            assert_abs_diff_eq!(cubic(part, s), cubic(b, 0.2 + 0.5 * s), epsilon = 1e-14);
        }
    }

    #[test]
    fn inverses_say_which_steps_they_need() {
        let (c, steps) = inverse([1.0, 1.03, 1.05, 1.06], 0.01);
        assert_eq!(steps, 0.0);
        for k in 0..=20 {
            let r = f64::from(k) / 20.0;
            let [c0, c1, c2, c3] = c.map(f64::from);
            let s = r + r * (1.0 - r) * (c0 + r * (c1 + r * (c2 + r * c3)));
            assert_abs_diff_eq!(share([1.0, 1.03, 1.05, 1.06], s), r, epsilon = 3e-6);
        }
        assert_eq!(inverse([1.0, 1.1, 1.3, 1.2], 0.1).1, ONE_STEP);
        assert_eq!(inverse([0.0, 1.0, 1.0, 1.0], 0.1).1, MANY_STEPS);
    }

    #[test]
    fn leaves_cover_all_weight_and_links_lead_to_pieces() {
        for (width, kind) in
            [(1, Reconstruction::Constant), (5, Reconstruction::Bilinear), (600, Reconstruction::Bilinear)]
        {
            let map = NdfMap::from_ndf(width, 40, kind, &Ggx::new(0.3, 0.5).unwrap()).unwrap();
            let bins = Bins::new(map.cdf());
            let (first, last) = (bins.leaves[0], bins.leaves[bins.leaves.len() - 1]);
            assert_eq!((first[0], last[END]), (0.0, 1.0));
            for pair in bins.leaves.windows(2) {
                assert_eq!(pair[0][END], pair[1][0], "{width}");
            }
            assert_eq!(bins.count, kind.cells(width) * bins.split);
            let mut next = bins.count;
            for bin in &bins.cubics[..bins.count] {
                if bin[0][BEFORE] < 0.0 {
                    assert_eq!((bin[0][MARGINAL] + bin[0][BELOW]) as usize, next, "{width}");
                    next += -bin[0][BEFORE] as usize;
                }
            }
            assert_eq!(next, bins.cubics.len(), "{width}");
        }
    }
}
