//! What a closed form computes in lanes: for a single call in one, for a [`Batch`](crate::Batch) in many.

use crate::density::roughness::Roughness;
use crate::ndf::Ndf;
use crate::simd::lanes::Lanes;

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
    /// Whether it is so long that four registers in step are faster than two.
    #[cfg(feature = "simd")]
    const LONG: bool = false;

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
    #[cfg(feature = "simd")]
    const LONG: bool = true;

    #[inline(always)]
    fn apply<S: Lanes>(&self, s: S, view: [S::F; 5]) -> [S::F; 3] {
        self.0.visible(s, view)
    }
}

/// `v` in the space where the roughnesses are 1, z at least 0, NaN read as 0.
#[inline(always)]
pub(crate) fn stretched<S: Lanes>(s: S, alpha: Roughness, [x, y, z]: [S::F; 3]) -> [S::F; 3] {
    /// Far above the length of a unit vector; its square times that of a roughness is finite.
    const LONGEST: f32 = 1e12;
    let x = s.bounded(x, LONGEST) * s.float(alpha.x);
    let y = s.bounded(y, LONGEST) * s.float(alpha.y);
    [x, y, s.at_most(s.at_least(z, 0.0), LONGEST)]
}

/// `(x, y, z)/|(x, y, z)|`.
#[inline(always)]
pub(crate) fn unit<S: Lanes>(s: S, [x, y, z]: [S::F; 3]) -> [S::F; 3] {
    let scale = s.float(1.0) / s.sqrt((x * x + y * y) + z * z);
    [x * scale, y * scale, z * scale]
}

/// Uniform numbers in [0, 1 − 2⁻²⁴]; NaN is 0.
#[inline(always)]
pub(crate) fn probabilities<S: Lanes>(s: S, [u1, u2]: [S::F; 2]) -> [S::F; 2] {
    const BELOW_ONE: f32 = 1.0 - f32::EPSILON / 2.0;
    [s.at_most(s.at_least(u1, 0.0), BELOW_ONE), s.at_most(s.at_least(u2, 0.0), BELOW_ONE)]
}

/// The calls of [`Ndf`] for a density in closed form: its formulas in one lane.
macro_rules! in_one_lane {
    ($density:ident) => {
        impl crate::ndf::Ndf for $density {
            #[inline]
            fn density(&self, m: glam::Vec3) -> f32 {
                self.density_in_lanes(crate::simd::lanes::Scalar, m.to_array())
            }

            #[inline]
            fn from_gaussian(&self, z: glam::Vec2) -> glam::Vec3 {
                self.normal(crate::simd::lanes::Scalar, z.to_array()).into()
            }

            #[inline]
            fn to_gaussian(&self, m: glam::Vec3) -> glam::Vec2 {
                self.coordinates(crate::simd::lanes::Scalar, m.to_array()).into()
            }

            #[inline]
            fn sample(&self, u: glam::Vec2) -> glam::Vec3 {
                self.polar(crate::simd::lanes::Scalar, u.to_array()).into()
            }
        }
    };
}
pub(crate) use in_one_lane;
