//! The variance of a sum of Gaussian variates at a point, by axes.

use crate::{
    lanes::{LaneSample, Lanes, Scalar, splat},
    lattice::fade::Along,
};

/// The variance of a sum of N(0, 1) variates from all axes but the first.
///
/// Each corner has a value and twice a gradient.
///
/// ```text
/// v = Σ W² (1 + 4 |d|²) = p₀ (P + 4Q) + 4 q₀ P,   pᵢ = Σ w²,   qᵢ = Σ w² d²,   P = Π pᵢ,   Q = Σ qᵢ Π_{j≠i} pⱼ
/// ```
#[derive(Clone, Copy)]
pub(crate) struct Variance<S: Lanes, const N: usize> {
    /// P + 4Q and its derivatives.
    pq: S::F,
    dpq: [S::F; N],
    /// 4P and its derivatives.
    p4: S::F,
    dp4: [S::F; N],
}

/// pᵢ, qᵢ, pᵢ′ and qᵢ′ of an axis.
#[inline(always)]
pub(crate) fn axis_variance<S: Lanes>(s: S, along: &Along<S>) -> [S::F; 4] {
    let Along { position: t, weight: high, slope } = *along;
    let (one, two) = (s.float(1.0), s.float(2.0));
    let (low, rest) = (one - high, one - t);
    let (low_t, high_rest) = (low * t, high * rest);
    [
        low * low + high * high,
        low_t * low_t + high_rest * high_rest,
        two * slope * (high - low),
        two * (low_t * (low - slope * t) + high_rest * (slope * rest - high)),
    ]
}

impl<S: Lanes, const N: usize> Variance<S, N> {
    #[inline(always)]
    pub(crate) fn new(s: S, along: &[Along<S>; N]) -> Self {
        let (zero, one, four) = (s.float(0.0), s.float(1.0), s.float(4.0));
        let (mut p, mut q, mut dp, mut dq) = (one, zero, [zero; N], [zero; N]);
        for axis in 1..N {
            let [pi, qi, dpi, dqi] = axis_variance(s, &along[axis]);
            for i in 1..axis {
                dq[i] = dq[i] * pi + dp[i] * qi;
                dp[i] = dp[i] * pi;
            }
            dq[axis] = q * dpi + p * dqi;
            dp[axis] = p * dpi;
            q = q * pi + p * qi;
            p = p * pi;
        }
        let mut variance = Self { pq: p + four * q, dpq: dp, p4: four * p, dp4: dp };
        for axis in 1..N {
            variance.dpq[axis] = dp[axis] + four * dq[axis];
            variance.dp4[axis] = four * dp[axis];
        }
        variance
    }

    /// The variance from all axes, and its gradient if `GRADIENTS`.
    #[inline(always)]
    pub(crate) fn at<const GRADIENTS: bool>(&self, [p, q, dp, dq]: [S::F; 4]) -> LaneSample<S, N> {
        let mut gradient = [p; N];
        if GRADIENTS {
            gradient[0] = dp * self.pq + dq * self.p4;
            for axis in 1..N {
                gradient[axis] = p * self.dpq[axis] + q * self.dp4[axis];
            }
        }
        (p * self.pq + q * self.p4, gradient)
    }
}

impl<const N: usize> Variance<Scalar, N> {
    /// This variance in every lane.
    #[inline(always)]
    pub(crate) fn splat<S: Lanes>(&self, s: S) -> Variance<S, N> {
        Variance {
            pq: s.float(self.pq),
            dpq: splat(s, self.dpq),
            p4: s.float(self.p4),
            dp4: splat(s, self.dp4),
        }
    }
}
