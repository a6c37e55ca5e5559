//! The closed forms in lanes, as [`Batch`](crate::Batch) runs them.

use core::f32::consts::{FRAC_1_SQRT_2, PI, SQRT_2};

use crate::elementary::{cos_sin_turns, exp, ln_1p, one_minus_exp_ratio};
use crate::gaussian_lanes::{LEAST_U, inverse_phi, visible_slope};
use crate::lanes::Lanes;
use crate::ndf::{FARTHEST, Ndf};
use crate::{Beckmann, Ggx};

/// A density whose closed forms can be evaluated in lanes; sealed.
pub trait InLanes: Ndf + ClosedForm {}

impl<N: Ndf + ClosedForm> InLanes for N {}

/// What a batch computes of a density.
pub trait ClosedForm {
    /// `T(z)`.
    fn normal<S: Lanes>(&self, s: S, z: [S::F; 2]) -> [S::F; 3];
    /// `T⁻¹(m)`.
    fn coordinates<S: Lanes>(&self, s: S, m: [S::F; 3]) -> [S::F; 2];
    /// `D(m)`.
    fn density_in_lanes<S: Lanes>(&self, s: S, m: [S::F; 3]) -> S::F;
    /// The polar map of uniform numbers.
    fn polar<S: Lanes>(&self, s: S, u: [S::F; 2]) -> [S::F; 3];
    /// A visible normal for `[v_x, v_y, v_z, u₁, u₂]`.
    fn visible<S: Lanes>(&self, s: S, view: [S::F; 5]) -> [S::F; 3];
}

/// A function of `I` numbers to `O`, in lanes.
pub(crate) trait Kernel<const I: usize, const O: usize> {
    fn apply<S: Lanes>(&self, s: S, x: [S::F; I]) -> [S::F; O];
}

/// `T`.
pub(crate) struct Normal<'a, N>(pub(crate) &'a N);
/// `T⁻¹`.
pub(crate) struct Coordinates<'a, N>(pub(crate) &'a N);
/// `D`.
pub(crate) struct Density<'a, N>(pub(crate) &'a N);
/// The polar map.
pub(crate) struct Sample<'a, N>(pub(crate) &'a N);
/// Visible normals.
pub(crate) struct Visible<'a, N>(pub(crate) &'a N);

impl<N: ClosedForm> Kernel<2, 3> for Normal<'_, N> {
    #[inline(always)]
    fn apply<S: Lanes>(&self, s: S, z: [S::F; 2]) -> [S::F; 3] {
        self.0.normal(s, z)
    }
}

impl<N: ClosedForm> Kernel<3, 2> for Coordinates<'_, N> {
    #[inline(always)]
    fn apply<S: Lanes>(&self, s: S, m: [S::F; 3]) -> [S::F; 2] {
        self.0.coordinates(s, m)
    }
}

impl<N: ClosedForm> Kernel<3, 1> for Density<'_, N> {
    #[inline(always)]
    fn apply<S: Lanes>(&self, s: S, m: [S::F; 3]) -> [S::F; 1] {
        [self.0.density_in_lanes(s, m)]
    }
}

impl<N: ClosedForm> Kernel<2, 3> for Sample<'_, N> {
    #[inline(always)]
    fn apply<S: Lanes>(&self, s: S, u: [S::F; 2]) -> [S::F; 3] {
        self.0.polar(s, u)
    }
}

impl<N: ClosedForm> Kernel<5, 3> for Visible<'_, N> {
    #[inline(always)]
    fn apply<S: Lanes>(&self, s: S, view: [S::F; 5]) -> [S::F; 3] {
        self.0.visible(s, view)
    }
}

/// `v` in the space where the roughnesses are 1, z at least 0, NaN read as 0; unit where it has a direction.
#[inline(always)]
fn stretched<S: Lanes>(s: S, [alpha_x, alpha_y]: [f32; 2], [x, y, z]: [S::F; 3]) -> [S::F; 3] {
    /// Far above the length of a unit vector; its square times that of a roughness is finite.
    const LONGEST: f32 = 1e12;
    let x = s.bounded(x, LONGEST) * s.float(alpha_x);
    let y = s.bounded(y, LONGEST) * s.float(alpha_y);
    let z = s.at_most(s.at_least(z, 0.0), LONGEST);
    let length2 = (x * x + y * y) + z * z;
    let scale = s.float(1.0) / s.sqrt(length2);
    let directed = s.less(s.float(1e-37), length2);
    let zero = s.float(0.0);
    [
        s.select(directed, x * scale, zero),
        s.select(directed, y * scale, zero),
        s.select(directed, z * scale, s.float(1.0)),
    ]
}

/// `(x, y, z)/|(x, y, z)|`.
#[inline(always)]
fn unit<S: Lanes>(s: S, [x, y, z]: [S::F; 3]) -> [S::F; 3] {
    let scale = s.float(1.0) / s.sqrt((x * x + y * y) + z * z);
    [x * scale, y * scale, z * scale]
}

/// Uniform numbers in [0, 1 − 2⁻²⁴]; NaN is 0.
#[inline(always)]
fn probabilities<S: Lanes>(s: S, [u1, u2]: [S::F; 2]) -> [S::F; 2] {
    const BELOW_ONE: f32 = 1.0 - f32::EPSILON / 2.0;
    [s.at_most(s.at_least(u1, 0.0), BELOW_ONE), s.at_most(s.at_least(u2, 0.0), BELOW_ONE)]
}

impl ClosedForm for Beckmann {
    #[inline(always)]
    fn normal<S: Lanes>(&self, s: S, [z1, z2]: [S::F; 2]) -> [S::F; 3] {
        let x = s.bounded(z1, FARTHEST) * s.float(self.alpha_x() * FRAC_1_SQRT_2);
        let y = s.bounded(z2, FARTHEST) * s.float(self.alpha_y() * FRAC_1_SQRT_2);
        unit(s, [x, y, s.float(1.0)])
    }

    #[inline(always)]
    fn coordinates<S: Lanes>(&self, s: S, [x, y, z]: [S::F; 3]) -> [S::F; 2] {
        let up = s.float(SQRT_2) / s.at_least(z, f32::MIN_POSITIVE);
        let z1 = (x / s.float(self.alpha_x())) * up;
        let z2 = (y / s.float(self.alpha_y())) * up;
        [s.bounded(z1, FARTHEST), s.bounded(z2, FARTHEST)]
    }

    #[inline(always)]
    fn density_in_lanes<S: Lanes>(&self, s: S, [x, y, z]: [S::F; 3]) -> S::F {
        let (x, y) = (x / s.float(self.alpha_x()) / z, y / s.float(self.alpha_y()) / z);
        let falloff = exp(s, -(x * x + y * y));
        let z2 = z * z;
        let peak = s.float(1.0 / (PI * self.alpha_x() * self.alpha_y()));
        let density = s.at_most(falloff * peak / (z2 * z2), f32::MAX);
        // Next to the horizon the exponential is 0 long before z⁴ underflows.
        let zero = s.float(0.0);
        s.select(s.less(zero, z), s.select(s.less(zero, falloff), density, zero), zero)
    }

    #[inline(always)]
    fn polar<S: Lanes>(&self, s: S, u: [S::F; 2]) -> [S::F; 3] {
        let [u1, u2] = probabilities(s, u);
        let slope = s.sqrt(-ln_1p(s, -u1));
        let [cos, sin] = cos_sin_turns(s, u2);
        let (x, y) = (slope * cos * s.float(self.alpha_x()), slope * sin * s.float(self.alpha_y()));
        unit(s, [x, y, s.float(1.0)])
    }

    #[inline(always)]
    fn visible<S: Lanes>(&self, s: S, [x, y, z, u1, u2]: [S::F; 5]) -> [S::F; 3] {
        let [u1, u2] = probabilities(s, [u1, u2]);
        let [x, y, z] = stretched(s, [self.alpha_x(), self.alpha_y()], [x, y, z]);
        let lateral = s.sqrt(x * x + y * y);
        let per_lateral = s.float(1.0) / lateral;
        let aside = s.less(s.float(0.0), lateral);
        let cos = s.select(aside, x * per_lateral, s.float(1.0));
        let sin = s.select(aside, y * per_lateral, s.float(0.0));
        let along = visible_slope(s, z * per_lateral * s.float(SQRT_2), u1);
        let across = inverse_phi(s, s.at_least(u2, LEAST_U));
        let x = (along * cos - across * sin) * s.float(self.alpha_x() * FRAC_1_SQRT_2);
        let y = (along * sin + across * cos) * s.float(self.alpha_y() * FRAC_1_SQRT_2);
        unit(s, [x, y, s.float(1.0)])
    }
}

impl ClosedForm for Ggx {
    #[inline(always)]
    fn normal<S: Lanes>(&self, s: S, [z1, z2]: [S::F; 2]) -> [S::F; 3] {
        let (z1, z2) = (s.bounded(z1, FARTHEST), s.bounded(z2, FARTHEST));
        let half = (z1 * z1 + z2 * z2) * s.float(0.5);
        let up = exp(s, half * s.float(-0.5));
        let scale = s.sqrt(one_minus_exp_ratio(s, half, up) * s.float(0.5));
        let x = z1 * scale * s.float(self.alpha_x());
        let y = z2 * scale * s.float(self.alpha_y());
        unit(s, [x, y, up])
    }

    #[inline(always)]
    fn coordinates<S: Lanes>(&self, s: S, [x, y, z]: [S::F; 3]) -> [S::F; 2] {
        let up = s.at_least(z, f32::MIN_POSITIVE);
        let (x, y) = (x / s.float(self.alpha_x()), y / s.float(self.alpha_y()));
        let length = s.sqrt(x * x + y * y);
        // Beyond 10¹⁹ the square would overflow; the coordinate is at its bound long before.
        let t = s.at_most(length / up, 1e19);
        let rho = s.sqrt(ln_1p(s, t * t) * s.float(2.0));
        // Below 10⁻⁵ ln(1 + t²) is t² to the last bit, and t² may underflow.
        let rho = s.select(s.less(t, s.float(1e-5)), t * s.float(SQRT_2), rho);
        let per_length = rho / length;
        [s.bounded(x * per_length, FARTHEST), s.bounded(y * per_length, FARTHEST)]
    }

    #[inline(always)]
    fn density_in_lanes<S: Lanes>(&self, s: S, [x, y, z]: [S::F; 3]) -> S::F {
        let (x, y) = (x / s.float(self.alpha_x()), y / s.float(self.alpha_y()));
        let t = (x * x + y * y) + z * z;
        let peak = s.float(PI * self.alpha_x() * self.alpha_y());
        let zero = s.float(0.0);
        let density = s.at_most(s.float(1.0) / (peak * t * t), f32::MAX);
        let finite = s.less(t, s.float(f32::INFINITY));
        s.select(s.less(zero, z), s.select(finite, density, zero), zero)
    }

    #[inline(always)]
    fn polar<S: Lanes>(&self, s: S, u: [S::F; 2]) -> [S::F; 3] {
        let [u1, u2] = probabilities(s, u);
        let slope = s.sqrt(u1);
        let [cos, sin] = cos_sin_turns(s, u2);
        let (x, y) = (slope * cos * s.float(self.alpha_x()), slope * sin * s.float(self.alpha_y()));
        unit(s, [x, y, s.sqrt(s.float(1.0) - u1)])
    }

    #[inline(always)]
    fn visible<S: Lanes>(&self, s: S, [x, y, z, u1, u2]: [S::F; 5]) -> [S::F; 3] {
        let [u1, u2] = probabilities(s, [u1, u2]);
        let [x, y, z] = stretched(s, [self.alpha_x(), self.alpha_y()], [x, y, z]);
        // The cap of `Ggx::sample_visible`.
        let one = s.float(1.0);
        let below = u2 * (one + z);
        let sin = s.sqrt(below * s.at_least(s.float(2.0) - below, 0.0));
        let [cos_phi, sin_phi] = cos_sin_turns(s, u1);
        let x = (sin * cos_phi + x) * s.float(self.alpha_x());
        let y = (sin * sin_phi + y) * s.float(self.alpha_y());
        unit(s, [x, y, (one - u2) * (one + z)])
    }
}
