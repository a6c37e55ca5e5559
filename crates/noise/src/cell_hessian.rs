//! The Hessian of noises that blend one linear function per corner of a cell.
//!
//! It is blended like the value: along every axis after the first, second derivatives of A and B come from the ends' first ones.

use crate::{
    cell_noise::{CORNERS, CellNoise, Column, Place, Section, normalised},
    fade::Fade,
    hessian::{Curved, Jet, mirror},
    lanes::Scalar,
    span::{Span, lerp},
    variance::axis_variance,
};

/// A blend of corners with the second derivatives of its A and B along all axes but the first, i ≤ j.
#[derive(Clone, Copy)]
struct Bent<const N: usize> {
    column: Column<Scalar, N>,
    a: [[f32; N]; N],
    b: [[f32; N]; N],
}

impl<const N: usize> Bent<N> {
    /// The blend of two ends along `axis`; the axes before it have been blended.
    #[inline(always)]
    fn blend<K: CellNoise<N>>(
        section: &Section<Scalar, N>,
        bend: &[f32; N],
        [low, high]: [&Self; 2],
        axis: usize,
    ) -> Self {
        let (w, slope) = (section.weight[axis], section.slope[axis]);
        let mut blend = Self { column: section.blend::<K>(low.column, high.column, axis), ..*low };
        for i in 1..N {
            for j in i..N {
                blend.a[i][j] = lerp::<Scalar>(low.a[i][j], high.a[i][j], w);
                blend.b[i][j] = lerp::<Scalar>(low.b[i][j], high.b[i][j], w);
            }
        }
        let (low, high) = (&low.column, &high.column);
        for i in 1..N {
            let (first, second) = (i.min(axis), i.max(axis));
            blend.a[first][second] += slope * (high.da[i] - low.da[i]);
            blend.b[first][second] += slope * (high.db[i] - low.db[i]);
        }
        blend.a[axis][axis] += slope * (high.da[axis] - low.da[axis]) + bend[axis] * (high.a - low.a);
        blend.b[axis][axis] += slope * (high.db[axis] - low.db[axis]) + bend[axis] * (high.b - low.b);
        blend
    }
}

impl<K: CellNoise<N>, const N: usize> Curved<N> for K {
    #[inline]
    fn near_jet(&self, p: [f32; N], seed: u32) -> Jet<[f32; N], N> {
        let (section, terms, t) = Place::<Scalar, N>::section(Scalar, self, p);
        let mut bend = [0.0; N];
        for axis in 1..N {
            bend[axis] = K::FADE.curvature(Scalar, section.place[axis]);
        }
        let [low, high] = terms.map(|term| {
            let empty = Bent { column: Column::empty(Scalar), a: [[0.0; N]; N], b: [[0.0; N]; N] };
            let mut ends = [empty; 8];
            for (k, end) in ends.iter_mut().enumerate().take(CORNERS[N]) {
                end.column = section.leaf::<K>(Scalar, section.corner(Scalar, self, term, k, seed), k);
            }
            for axis in 1..N {
                for i in 0..CORNERS[N] >> axis {
                    ends[i] = Bent::blend::<K>(&section, &bend, [&ends[2 * i], &ends[2 * i + 1]], axis);
                }
            }
            ends[0]
        });
        let place = Place { section, columns: [low.column, high.column], t };
        let (sample, variance) = place.parts::<K>(Scalar);

        let (w, slope) = (K::FADE.weight(Scalar, t), K::FADE.slope(Scalar, t));
        let mut hessian = [[0.0; N]; N];
        hessian[0][0] = place.span::<K>(0).second_derivative::<K, N>(t, slope, K::FADE.curvature(Scalar, t));
        for i in 1..N {
            hessian[0][i] = place.span::<K>(i).derivative::<K, N>(t, w, slope);
            for j in i..N {
                let (low, high) = ([low.a[i][j], low.b[i][j]], [high.a[i][j], high.b[i][j]]);
                let span = if K::HAS_GRADIENT {
                    Span::<Scalar>::new::<true>(low, high)
                } else {
                    Span::new::<false>(low, high)
                };
                hessian[i][j] = span.value::<K, N>(t, w);
            }
        }
        if K::NORMALISED {
            hessian = normalised_hessian(sample, hessian, variance, variance_hessian(K::FADE, &place));
        }
        mirror(&mut hessian);
        let (value, gradient) = if K::NORMALISED { normalised(Scalar, sample, variance) } else { sample };
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
        let t = if axis == 0 { place.t } else { place.section.place[axis] };
        let (w, slope, bend) = (fade.weight(Scalar, t), fade.slope(Scalar, t), fade.curvature(Scalar, t));
        let [p, q, dp, dq] = axis_variance(Scalar, t, w, slope);
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
