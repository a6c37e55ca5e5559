//! The covariance of the gradient of Gaussian noise, and the whitened gradient.

use crate::{
    kinds::cell::variance::axis_variance,
    lanes::Lanes,
    lattice::fade::{Along, Fade},
};

/// The reciprocal deviation of ∂n/∂x over all seeds and positions, by dimension.
///
/// The variances are 460/77, 3717940/693693, 758161940/160243083 and 50883729980/12338717391.
pub(crate) const SLOPE_UNIT: [f32; 5] = [0.0, 0.409_134_8, 0.431_949, 0.459_736_15, 0.492_431_17];

/// Sums over both ends of an axis, with weight w, its derivative w′ and the distance d of an end.
#[derive(Clone, Copy)]
struct AxisSums<S: Lanes> {
    /// Σ w².
    w2: S::F,
    /// Σ w² d.
    w2_d: S::F,
    /// Σ w² d².
    w2_d2: S::F,
    /// Σ w w′.
    ws: S::F,
    /// Σ w w′ d.
    ws_d: S::F,
    /// Σ w w′ d².
    ws_d2: S::F,
    /// Σ w′².
    s2: S::F,
    /// Σ w′² d².
    s2_d2: S::F,
}

impl<S: Lanes> AxisSums<S> {
    #[inline(always)]
    fn new(s: S, along: Along<S>) -> Self {
        let [w2, w2_d2, derivative, _] = axis_variance(s, &along);
        let Along { position: t, weight: high, slope } = along;
        let one = s.float(1.0);
        // The distance from the upper end is −rest.
        let (low, rest) = (one - high, one - t);
        let (low_t, high_rest) = (low * t, high * rest);
        let slopes = slope * slope;
        Self {
            w2,
            w2_d: low * low_t - high * high_rest,
            w2_d2,
            ws: s.float(0.5) * derivative,
            ws_d: s.float(0.0) - slope * (high_rest + low_t),
            ws_d2: slope * (high_rest * rest - low_t * t),
            s2: slopes + slopes,
            s2_d2: slopes * (t * t + rest * rest),
        }
    }
}

/// Π w2 and Σ w2_d2 Π w2 over the axes other than i and j.
#[inline(always)]
fn others<S: Lanes, const N: usize>(s: S, axes: &[AxisSums<S>; N], i: usize, j: usize) -> (S::F, S::F) {
    let (mut p, mut q) = (s.float(1.0), s.float(0.0));
    for k in 0..N {
        if k != i && k != j {
            q = q * axes[k].w2 + p * axes[k].w2_d2;
            p = p * axes[k].w2;
        }
    }
    (p, q)
}

/// The covariance of ∇n over all seeds, at a position in the cell.
///
/// ```text
/// C = Σ_c (1 + 4|d|²) ∇W ∇Wᵀ + 4W² I + 4W (∇W dᵀ + d ∇Wᵀ)
/// ```
///
/// The weights are products, so every sum over corners is a sum of products of sums over axes. The
/// eigenvalues are within 1.99 and 8.74 in 2-D, and 0.99 and 8.88 in 3-D.
#[inline(always)]
fn covariance<S: Lanes, const N: usize>(s: S, t: [S::F; N]) -> [[S::F; N]; N] {
    let (zero, four) = (s.float(0.0), s.float(4.0));
    let mut axes = [AxisSums::new(s, Along { position: zero, weight: zero, slope: zero }); N];
    for k in 0..N {
        axes[k] = AxisSums::new(s, Along::new(s, Fade::Quintic, t[k]));
    }
    let mut covariance = [[zero; N]; N];
    for i in 0..N {
        let (a, (p, q)) = (&axes[i], others(s, &axes, i, i));
        let linear = a.s2_d2 + (a.ws_d + a.ws_d) + a.w2;
        covariance[i][i] = a.s2 * (p + four * q) + four * (p * linear);
        for j in 0..i {
            let (b, (p, q)) = (&axes[j], others(s, &axes, i, j));
            let linear = b.ws * (a.ws_d2 + a.w2_d) + a.ws * (b.ws_d2 + b.w2_d);
            covariance[i][j] = a.ws * b.ws * (p + four * q) + four * (p * linear);
            covariance[j][i] = covariance[i][j];
        }
    }
    covariance
}

#[inline(always)]
fn dot<S: Lanes, const N: usize>(a: &[S::F; N], b: &[S::F; N]) -> S::F {
    let mut sum = a[0] * b[0];
    for k in 1..N {
        sum = sum + a[k] * b[k];
    }
    sum
}

/// (Bᵀ C B)^(−1/2) Bᵀ ∇n, where C is the covariance of ∇n and B has the tangents as columns.
///
/// It is N(0, I). A common factor of the tangents has no effect. Not finite if the tangents are
/// parallel.
#[inline(always)]
pub(crate) fn whitened<S: Lanes, const N: usize>(
    s: S,
    t: [S::F; N],
    gradient: [S::F; N],
    tangents: [[S::F; N]; 2],
) -> [S::F; 2] {
    let c = covariance(s, t);
    let [mut u, mut v] = tangents;
    // Tangents are as long as the frequency of their octave, whose fourth power would overflow. A
    // power of two changes no bit of the result.
    let mut longest = s.float(0.0);
    for k in 0..N {
        longest = s.max(longest, s.max(s.abs(u[k]), s.abs(v[k])));
    }
    let exponent = s.bits(longest) & s.word(0x7f80_0000);
    let scale = s.float_of_bits(s.word(0x7f00_0000) - exponent);
    for k in 0..N {
        (u[k], v[k]) = (u[k] * scale, v[k] * scale);
    }
    let (mut cu, mut cv) = (u, v);
    for k in 0..N {
        cu[k] = dot::<S, N>(&c[k], &u);
        cv[k] = dot::<S, N>(&c[k], &v);
    }
    let (uu, uv, vv) = (dot::<S, N>(&cu, &u), dot::<S, N>(&cu, &v), dot::<S, N>(&cv, &v));
    // The root of a matrix S is (S + d)/τ with d = √det S and τ² = tr S + 2d.
    let d = s.sqrt(uu * vv - uv * uv);
    let factor = s.float(1.0) / (d * s.sqrt(uu + vv + (d + d)));
    let (x, y) = (dot::<S, N>(&gradient, &u), dot::<S, N>(&gradient, &v));
    [((vv + d) * x - uv * y) * factor, ((uu + d) * y - uv * x) * factor]
}
