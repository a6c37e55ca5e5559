//! The Hessian of noises that blend one linear function per corner of a cell.

use crate::{
    contract::hessian::{HessianKernel, Jet, mirror},
    kinds::cell::blend::ends,
    kinds::cell::corner::{CellNoise, Corner, normalized},
    kinds::cell::corners::CellPosition,
    kinds::cell::variance::axis_variance,
    lanes::{LaneSample, Lanes, Scalar},
    lattice::fade::{Along, Fade},
};

#[cfg(feature = "simd")]
use crate::{
    kinds::cell::at_ends::{Ends, at_ends_of},
    kinds::cell::corners::CORNERS,
    kinds::cell::kernel::of_lane,
    lanes::level::four,
};

impl<K: CellNoise<N>, const N: usize> HessianKernel<N> for K {
    /// ∂ᵢⱼ Σ W f = Σ (Wᵢⱼ f + Wᵢ gⱼ + Wⱼ gᵢ) over the corners, f = value + g·d and W the product of
    /// the axes' weights.
    #[inline]
    fn near_jet(&self, p: [f32; N], seed: u32) -> Jet<N> {
        #[cfg(feature = "simd")]
        if N > 1
            && let Some(s) = four()
        {
            return by_corners(s, self, p, seed);
        }
        one_by_one(self, p, seed)
    }
}

/// The jet of a point, corner by corner.
#[inline(always)]
fn one_by_one<K: CellNoise<N>, const N: usize>(noise: &K, p: [f32; N], seed: u32) -> Jet<N> {
    let position = CellPosition::<Scalar, N>::new(Scalar, noise, &p, 0);
    let corners =
        position.corners(Scalar, noise, seed, Corner::nothing(Scalar), |word| noise.corner(Scalar, word));
    let (sample, variance) = position.parts::<K, true>(Scalar, &position.drawn_edges(Scalar, noise, seed));

    let mut hessian = [[0.0; N]; N];
    for c in 0..1 << N {
        let corner = &corners[c & 1][c >> 1 & (ends::<N>() - 1)][c >> 2];
        let mut ends = [End::NOWHERE; N];
        for axis in 0..N {
            ends[axis] = End::new(Scalar, K::FADE, &position.along[axis], |_| c >> axis & 1 == 1);
        }
        add_bends::<K, Scalar, N>(Scalar, &ends, corner, |i, j, bend| hessian[i][j] += bend);
    }
    jet::<K, N>(&position, sample, variance, hessian)
}

/// The jet of a point in lanes, one corner each.
#[cfg(feature = "simd")]
#[inline(always)]
fn by_corners<K: CellNoise<N>, S: Lanes, const N: usize>(s: S, noise: &K, p: [f32; N], seed: u32) -> Jet<N> {
    let Ends { position, words, parts: (sample, variance) } = at_ends_of::<K, S, N, true>(s, noise, p, seed);
    let mut ends = [End::new(s, K::FADE, &position.along[0], |lane| lane >> 1 & 1 == 1); N];
    ends[1 % N] = End::new(s, K::FADE, &position.along[1 % N], |lane| lane & 1 == 1);
    // Four consecutive entries of the upper half, row by row.
    let mut sums = [s.float(0.0); 3];
    for k in 0..CORNERS[N] {
        for axis in 2..N {
            ends[axis] = End::new(s, K::FADE, &position.along[axis], |_| k >> (axis - 2) & 1 == 1);
        }
        let (mut entries, mut e) = ([[s.float(0.0); 4]; 3], 0);
        add_bends::<K, S, N>(s, &ends, &noise.corner(s, words[k]), |_, _, bend| {
            entries[e / 4][e % 4] = bend;
            e += 1;
        });
        for q in 0..(N * (N + 1) / 2).div_ceil(4) {
            // Corners are first added by the ends of the second axis.
            for lane in [0, 2, 1, 3] {
                sums[q] = sums[q] + s.floats(|entry| s.lane(entries[q][entry & 3], lane));
            }
        }
    }
    let (mut hessian, mut e) = ([[0.0; N]; N], 0);
    for i in 0..N {
        for j in i..N {
            hessian[i][j] = s.lane(sums[e / 4], e % 4);
            e += 1;
        }
    }
    let mut first = CellPosition::<Scalar, N>::NOWHERE;
    for axis in 0..N {
        first.along[axis] = position.along[axis].lane(s, 0);
    }
    let (sample, variance) = (of_lane::<S, N, true>(s, sample, 0), of_lane::<S, N, true>(s, variance, 0));
    jet::<K, N>(&first, sample, variance, hessian)
}

/// The jet of n, or of n/√v if the noise is normalized.
#[inline(always)]
fn jet<K: CellNoise<N>, const N: usize>(
    position: &CellPosition<Scalar, N>,
    sample: LaneSample<Scalar, N>,
    variance: LaneSample<Scalar, N>,
    mut hessian: [[f32; N]; N],
) -> Jet<N> {
    if !K::HAS_GRADIENT {
        for entry in hessian.as_flattened_mut() {
            *entry *= K::UNIT;
        }
    }
    if K::NORMALIZED {
        hessian = normalized_hessian(sample, hessian, variance, variance_hessian(K::FADE, position));
    }
    mirror(&mut hessian);
    let (value, gradient) =
        if K::NORMALIZED { normalized::<_, N, true>(Scalar, sample, variance) } else { sample };
    Jet { value, gradient, hessian }
}

/// A corner along one axis: the offset from it, its weight and the first and second derivative of
/// the weight.
#[derive(Clone, Copy)]
struct End<S: Lanes> {
    offset: S::F,
    weights: [S::F; 3],
}

impl End<Scalar> {
    const NOWHERE: Self = Self { offset: 0.0, weights: [0.0; 3] };
}

impl<S: Lanes> End<S> {
    /// The upper end in the lanes selected by `high`, the lower end in the others.
    #[inline(always)]
    fn new(s: S, fade: Fade, along: &Along<S>, high: impl Fn(usize) -> bool) -> Self {
        let one = s.floats(|lane| f32::from(u8::from(!high(lane))));
        let sign = s.words(|lane| u32::from(!high(lane)) << 31);
        let bend = fade.curvature(s, along.position);
        Self {
            offset: along.position - s.floats(|lane| f32::from(u8::from(high(lane)))),
            weights: [one + s.flip(along.weight, sign), s.flip(along.slope, sign), s.flip(bend, sign)],
        }
    }
}

/// Adds the contributions of a corner to the entries of the upper half, row by row.
#[inline(always)]
fn add_bends<K: CellNoise<N>, S: Lanes, const N: usize>(
    s: S,
    ends: &[End<S>; N],
    corner: &Corner<S, N>,
    mut add: impl FnMut(usize, usize, S::F),
) {
    let mut f = corner.value;
    for axis in 0..if K::HAS_GRADIENT { N } else { 0 } {
        f = f + corner.gradient[axis] * ends[axis].offset;
    }
    // The product of the weights, differentiated along the axes i and j; N stands for no axis.
    let product = |i: usize, j: usize| {
        let mut product = s.float(1.0);
        for axis in 0..N {
            product = product * ends[axis].weights[usize::from(axis == i) + usize::from(axis == j)];
        }
        product
    };
    for i in 0..N {
        for j in i..N {
            let bend = product(i, j) * f;
            add(
                i,
                j,
                if K::HAS_GRADIENT {
                    bend + (product(i, N) * corner.gradient[j] + product(j, N) * corner.gradient[i])
                } else {
                    bend
                },
            );
        }
    }
}

/// The upper half of the Hessian of v.
///
/// P + εQ = Π (pᵢ + ε qᵢ) with ε² = 0, so that derivatives are products of the derivatives of the
/// axes. v = P + 4Q.
fn variance_hessian<const N: usize>(fade: Fade, position: &CellPosition<Scalar, N>) -> [[f32; N]; N] {
    // p and q of every axis and their first and second derivatives.
    let mut factors = [[[0.0; 2]; 3]; N];
    for axis in 0..N {
        let along = &position.along[axis];
        let (t, w, slope) = (along.position, along.weight, along.slope);
        let bend = fade.curvature(Scalar, t);
        let [p, q, dp, dq] = axis_variance(Scalar, along);
        let (low, rest) = (1.0 - w, 1.0 - t);
        let (falling, rising) = (low - slope * t, slope * rest - w);
        let ddp = 2.0 * bend * (w - low) + 4.0 * (slope * slope);
        let ddq = 2.0
            * (falling * falling + rising * rising - low * t * (2.0 * slope + bend * t)
                + w * rest * (bend * rest - 2.0 * slope));
        factors[axis] = [[p, q], [dp, dq], [ddp, ddq]];
    }
    let mut hessian = [[0.0; N]; N];
    for i in 0..N {
        for j in i..N {
            let [mut p, mut q] = [1.0, 0.0];
            for (axis, factor) in factors.iter().enumerate() {
                let [pi, qi] = factor[usize::from(axis == i) + usize::from(axis == j)];
                [p, q] = [p * pi, q * pi + p * qi];
            }
            hessian[i][j] = p + 4.0 * q;
        }
    }
    hessian
}

/// The upper half of the Hessian of z = n/√v.
///
/// ```text
/// zᵢⱼ = nᵢⱼ v^(−1/2) − (nᵢ vⱼ + nⱼ vᵢ + n vᵢⱼ) v^(−3/2)/2 + 3 n vᵢ vⱼ v^(−5/2)/4
/// ```
fn normalized_hessian<const N: usize>(
    (n, dn): (f32, [f32; N]),
    ddn: [[f32; N]; N],
    (v, dv): (f32, [f32; N]),
    ddv: [[f32; N]; N],
) -> [[f32; N]; N] {
    let inverse = 1.0 / v;
    let root = asperity_core::math::sqrt(inverse);
    let mut hessian = ddn;
    for i in 0..N {
        for j in i..N {
            let cross = dn[i] * dv[j] + dn[j] * dv[i] + n * ddv[i][j];
            let square = 0.75 * n * dv[i] * dv[j] * inverse;
            hessian[i][j] = root * (ddn[i][j] - inverse * (0.5 * cross - square));
        }
    }
    hessian
}

#[cfg(all(test, feature = "simd"))]
mod tests {
    use super::*;
    use asperity_core::SplitMix64;

    use crate::{
        kinds::gaussian::GaussianNoise,
        kinds::perlin::{Perlin, PerlinClassic},
        kinds::value::ValueNoise,
        kinds::value_gradient::ValueGradient,
    };

    fn same<K: CellNoise<N>, const N: usize>(noise: &K) {
        for i in 0..200 {
            let mut p = [0.0; N];
            for axis in 0..N {
                let word = SplitMix64::nth(i * 4 + axis as u64) as i32;
                // Lattice points, halves, and coordinates near and far.
                p[axis] = match i % 8 {
                    0 => (word >> 28) as f32,
                    1 => (word >> 27) as f32 * 0.5,
                    2 => word as f32 * 1e-4,
                    _ => word as f32 / 536_870_912.0,
                };
            }
            assert_eq!(noise.near_jet(p, i as u32), one_by_one(noise, p, i as u32), "{p:?}");
        }
    }

    #[test]
    fn hessian_in_lanes_matches_scalar() {
        macro_rules! of {
            ($($noise:expr),*) => { $(same::<_, 2>(&$noise); same::<_, 3>(&$noise); same::<_, 4>(&$noise);)* };
        }
        of!(
            PerlinClassic::new(1),
            Perlin::new(1),
            ValueNoise::new(1),
            ValueGradient::new(1),
            GaussianNoise::new(1)
        );
    }
}
