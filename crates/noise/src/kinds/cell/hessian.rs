//! The Hessian of noises that blend one linear function per corner of a cell.

use crate::{
    contract::hessian::{CurvedKernel, Jet, mirror},
    kinds::cell::blend::ends,
    kinds::cell::corner::{CellNoise, Corner, normalised},
    kinds::cell::corners::Place,
    kinds::cell::variance::axis_variance,
    lanes::lanes::Scalar,
    lattice::fade::Fade,
};

impl<K: CellNoise<N>, const N: usize> CurvedKernel<N> for K {
    /// ∂ᵢⱼ Σ W f = Σ (Wᵢⱼ f + Wᵢ gⱼ + Wⱼ gᵢ) over the corners, f = value + g·d and W the product of the axes' weights.
    #[inline]
    fn near_jet(&self, p: [f32; N], seed: u32) -> Jet<N> {
        let place = Place::<Scalar, N>::new(Scalar, self, &p, 0);
        let corners =
            place.corners(Scalar, self, seed, Corner::nothing(Scalar), |word| self.corner(Scalar, word));
        let (sample, variance) = place.parts::<K, true>(Scalar, &place.drawn_edges(Scalar, self, seed));

        let mut hessian = [[0.0; N]; N];
        for c in 0..1 << N {
            let corner = &corners[c & 1][c >> 1 & (ends::<N>() - 1)][c >> 2];
            // The corner's function, and every axis' weight with its derivatives.
            let (mut f, mut weights) = (corner.value, [[0.0; 3]; N]);
            for axis in 0..N {
                let along = &place.along[axis];
                let (t, bend) = (along.place, K::FADE.curvature(Scalar, along.place));
                (f, weights[axis]) = if c >> axis & 1 == 0 {
                    (f + corner.gradient[axis] * t, [1.0 - along.weight, -along.slope, -bend])
                } else {
                    (f + corner.gradient[axis] * (t - 1.0), [along.weight, along.slope, bend])
                };
            }
            // The product of the weights, derived as often along each axis as it is named.
            let product = |axes: &[usize]| {
                (0..N).fold(1.0, |product, axis| {
                    product * weights[axis][axes.iter().filter(|&&derived| derived == axis).count().min(2)]
                })
            };
            for i in 0..N {
                for j in i..N {
                    let turn = product(&[i]) * corner.gradient[j] + product(&[j]) * corner.gradient[i];
                    hessian[i][j] += product(&[i, j]) * f + turn;
                }
            }
        }
        if !K::HAS_GRADIENT {
            hessian = hessian.map(|row| row.map(|h| h * K::UNIT));
        }
        if K::NORMALISED {
            hessian = normalised_hessian(sample, hessian, variance, variance_hessian(K::FADE, &place));
        }
        mirror(&mut hessian);
        let (value, gradient) =
            if K::NORMALISED { normalised::<_, N, true>(Scalar, sample, variance) } else { sample };
        Jet { value, gradient, hessian }
    }
}

/// The upper half of the Hessian of v.
///
/// P + εQ = Π (pᵢ + ε qᵢ) with ε² = 0, so that derivatives are products of the axes' own; v = P + 4Q.
fn variance_hessian<const N: usize>(fade: Fade, place: &Place<Scalar, N>) -> [[f32; N]; N] {
    // p and q of every axis and their first and second derivatives.
    let mut factors = [[[0.0; 2]; 3]; N];
    for axis in 0..N {
        let along = &place.along[axis];
        let (t, w, slope) = (along.place, along.weight, along.slope);
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
fn normalised_hessian<const N: usize>(
    (n, dn): (f32, [f32; N]),
    ddn: [[f32; N]; N],
    (v, dv): (f32, [f32; N]),
    ddv: [[f32; N]; N],
) -> [[f32; N]; N] {
    let inverse = 1.0 / v;
    let root = crate::math::sqrt(inverse);
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
