//! The simplicial lattice and the radial kernel around its corners.

use crate::lanes::lanes::{Floats, Lanes};

/// (√(n + 1) − 1)/n, which shears the simplices into halves, sixths, … of cubes; nothing is sheared in 1-D.
const SKEW: [f32; 4] = [0.0, 0.366_025_4, 1.0 / 3.0, 0.309_017];
/// (1 − 1/√(n + 1))/n, which shears back.
pub(crate) const UNSKEW: [f32; 4] = [0.0, 0.211_324_87, 1.0 / 6.0, 0.138_196_6];

/// A point's simplex: its first corner in the skewed lattice, and the order of the axes on the way to the last.
pub(crate) struct Corner<S: Lanes, const N: usize> {
    /// The corner's skewed coordinates, integers.
    pub(crate) skewed: [S::F; N],
    /// Their sum.
    pub(crate) sum: S::F,
    /// Than how many axes the point is farther along each axis in the skewed cell.
    pub(crate) rank: [S::F; N],
}

#[inline(always)]
pub(crate) fn first_corner<S: Lanes, const N: usize>(s: S, p: &[S::F; N]) -> Corner<S, N> {
    let (one, zero) = (s.float(1.0), s.float(0.0));
    let mut corner = Corner { skewed: *p, sum: zero, rank: [zero; N] };
    // The first coordinate comes last: along a row of a grid the rest of the sum does not change.
    let mut sum = p[N - 1];
    for axis in (0..N - 1).rev() {
        sum = sum + p[axis];
    }
    let shift = sum * s.float(SKEW[N - 1]);
    for axis in 0..N {
        corner.skewed[axis] = s.floor(if N == 1 { p[axis] } else { p[axis] + shift });
        corner.sum = corner.sum + corner.skewed[axis];
    }
    // Which axis the point is farther along does not depend on what all are shifted by.
    for axis in 1..N {
        for before in 0..axis {
            let low = p[axis] - corner.skewed[axis];
            let ahead = s.select(s.less(low, p[before] - corner.skewed[before]), one, zero);
            corner.rank[before] = corner.rank[before] + ahead;
            corner.rank[axis] = corner.rank[axis] + (one - ahead);
        }
    }
    corner
}

/// The end of kernels: t is 0 from here down.
///
/// Corners of other simplices come as near as t = 0, and nearer by rounding. Were there no gap, it would depend on the order of
/// evaluation whether they count. The leap is t⁴ A |g·d| < 1e-10, and that of the gradient 5e-7.
pub(crate) const GAP: f32 = 1.0 / 1024.0;

/// One term of the sum: t = r² − |d|², 0 below the gap, d, g and g·d.
pub(crate) struct Term<S: Lanes, const N: usize> {
    pub(crate) t: S::F,
    pub(crate) d: [S::F; N],
    pub(crate) g: [S::F; N],
    pub(crate) slope: S::F,
}

/// r² − Σ dᵢ² and Σ gᵢ dᵢ over all axes but the first: what does not change along a row.
#[inline(always)]
pub(crate) fn beside<S: Lanes, const N: usize>(
    s: S,
    radius_squared: f32,
    d: &[S::F; N],
    g: &[S::F; N],
) -> [S::F; 2] {
    let (mut rest, mut side) = (s.float(radius_squared), s.float(0.0));
    for axis in 1..N {
        rest = rest - d[axis] * d[axis];
        side = if axis == 1 { g[axis] * d[axis] } else { side + g[axis] * d[axis] };
    }
    [rest, side]
}

/// t and g·d of a term from what is beside the first axis.
#[inline(always)]
pub(crate) fn along<S: Lanes, const N: usize>(s: S, [rest, side]: [S::F; 2], d: S::F, g: S::F) -> [S::F; 2] {
    let (t, slope) = (rest - d * d, g * d);
    let t = s.above(t, GAP);
    [t, if N == 1 { slope } else { side + slope }]
}

/// t⁴.
#[inline(always)]
pub(crate) fn kernel<F: Floats>(t: F) -> F {
    let t2 = t * t;
    t2 * t2
}

/// 8 t³ (g·d).
#[inline(always)]
pub(crate) fn pull<S: Lanes>(s: S, t: S::F, slope: S::F) -> S::F {
    s.float(8.0) * (t * t * t) * slope
}
