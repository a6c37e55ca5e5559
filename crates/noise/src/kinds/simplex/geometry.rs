//! The simplicial lattice and the radial kernel around its corners.

use crate::lanes::{Arithmetic, Floats, Lanes};

/// (√(n + 1) − 1)/n, the skew that maps simplices to halves, sixths, … of cubes; 0 in 1-D.
pub(crate) const SKEW: [f32; 4] = [0.0, 0.366_025_4, 1.0 / 3.0, 0.309_017];
/// (1 − 1/√(n + 1))/n, the inverse skew.
pub(crate) const UNSKEW: [f32; 4] = [0.0, 0.211_324_87, 1.0 / 6.0, 0.138_196_6];

/// The first corner of a point's simplex in the skewed lattice.
pub(crate) struct Corner<S: Lanes, const N: usize> {
    /// The corner's skewed coordinates, integers.
    pub(crate) skewed: [S::F; N],
    /// Their sum.
    pub(crate) sum: S::F,
}

#[inline(always)]
pub(crate) fn first_corner<S: Lanes, const N: usize>(s: S, p: &[S::F; N]) -> Corner<S, N> {
    let mut corner = Corner { skewed: *p, sum: s.float(0.0) };
    // The first coordinate comes last: along a row of a grid the rest of the sum does not change.
    let mut sum = p[N - 1];
    for axis in (0..N - 1).rev() {
        sum = sum + p[axis];
    }
    let shift = sum * s.float(SKEW[N - 1]);
    for axis in 0..N {
        corner.skewed[axis] = s.floor(if N == 1 { p[axis] } else { p[axis] + shift });
        corner.sum = if axis == 0 { corner.skewed[0] } else { corner.sum + corner.skewed[axis] };
    }
    corner
}

/// The axes stepped along from the first corner to each inner corner, by the corner's number minus
/// one.
pub(crate) type Steps<S, const N: usize> = [[<S as Arithmetic>::M; N]; N];

impl<S: Lanes, const N: usize> Corner<S, N> {
    /// For each axis the number of axes along which the point is less far in the skewed cell.
    #[inline(always)]
    pub(crate) fn ranks(&self, s: S, p: &[S::F; N]) -> [S::F; N] {
        let (one, zero) = (s.float(1.0), s.float(0.0));
        let mut ranks = [zero; N];
        // The comparison of two axes does not depend on their common shift.
        for axis in 1..N {
            for before in 0..axis {
                let low = p[axis] - self.skewed[axis];
                let ahead = s.select(s.less(low, p[before] - self.skewed[before]), one, zero);
                ranks[before] = ranks[before] + ahead;
                ranks[axis] = ranks[axis] + (one - ahead);
            }
        }
        ranks
    }

    /// The steps from corner to corner, along the axes in descending order of the ranks.
    #[inline(always)]
    pub(crate) fn steps(&self, s: S, p: &[S::F; N]) -> Steps<S, N> {
        let none = s.less(s.float(0.0), s.float(0.0));
        let mut steps = [[none; N]; N];
        let ahead =
            |axis: usize, before: usize| s.less(p[axis] - self.skewed[axis], p[before] - self.skewed[before]);
        match N {
            1 => {}
            // A single lane has no masks, and comparisons would compile to branches.
            2 if S::LEN > 1 => {
                let x = ahead(1, 0);
                (steps[0][0], steps[0][1]) = (x, s.not(x));
            }
            3 if S::LEN > 1 => {
                let (xy, xz, yz) = (ahead(1 % N, 0), ahead(2 % N, 0), ahead(2 % N, 1 % N));
                let (yx, zx, zy) = (s.not(xy), s.not(xz), s.not(yz));
                for (axis, [a, b]) in [[xy, xz], [yx, yz], [zx, zy]].into_iter().enumerate() {
                    (steps[0][axis % N], steps[1 % N][axis % N]) = (s.both(a, b), s.either(a, b));
                }
            }
            _ => {
                let ranks = self.ranks(s, p);
                for k in 1..N {
                    for axis in 0..N {
                        steps[k - 1][axis] = s.less(s.float((N - k) as f32 - 0.5), ranks[axis]);
                    }
                }
            }
        }
        steps
    }
}

/// The end of kernels: t is taken as 0 up to here.
///
/// Corners of other simplices come as near as t = 0, and nearer by rounding. Without a gap their
/// contribution would depend on the order of evaluation. The discontinuity is t⁴ A |g·d| < 1e-10 in
/// the value and 5e-7 in the gradient.
pub(crate) const GAP: f32 = 1.0 / 1024.0;

/// One term of the sum: t = r² − |d|², 0 below the gap, d, g and g·d.
///
/// In 3-D g is unspecified if only values are wanted.
pub(crate) struct Term<S: Lanes, const N: usize> {
    pub(crate) t: S::F,
    pub(crate) d: [S::F; N],
    pub(crate) g: [S::F; N],
    pub(crate) slope: S::F,
}

/// t = r² − |d|², the first axis last; 0 below the gap.
#[inline(always)]
pub(crate) fn within<S: Lanes, const N: usize>(s: S, radius_squared: f32, d: &[S::F; N]) -> S::F {
    let mut t = s.float(radius_squared);
    for axis in 1..N {
        t = t - d[axis] * d[axis];
    }
    beyond_gap(s, t - d[0] * d[0])
}

/// g·d, the first axis last.
#[inline(always)]
pub(crate) fn product<S: Lanes, const N: usize>(g: &[S::F; N], d: &[S::F; N]) -> S::F {
    let mut sum = g[1 % N] * d[1 % N];
    for axis in 2..N {
        sum = sum + g[axis] * d[axis];
    }
    if N == 1 { sum } else { sum + g[0] * d[0] }
}

/// t where it is above the gap, else 0.
#[inline(always)]
fn beyond_gap<S: Lanes>(s: S, t: S::F) -> S::F {
    // Non-negative floats are ordered like their bits, with negative floats below. This saves one
    // operation.
    let above = s.signed_less(s.word(GAP.to_bits()), s.bits(t));
    s.select(above, t, s.float(0.0))
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
