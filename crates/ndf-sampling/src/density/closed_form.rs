//! Closed forms of NDFs in SIMD lanes: one lane for a single call, many for arrays.

use crate::density::roughness::Roughness;
use asperity_core::lanes::Arithmetic;

/// `v` in the space where the roughnesses are 1, z at least 0, NaN read as 0.
#[inline(always)]
pub(crate) fn stretched<S: Arithmetic>(s: S, alpha: Roughness, [x, y, z]: [S::F; 3]) -> [S::F; 3] {
    /// Far above the length of a unit vector. Its square times the square of a roughness is finite.
    const LONGEST: f32 = 1e12;
    let x = s.bounded(x, LONGEST) * s.float(alpha.x);
    let y = s.bounded(y, LONGEST) * s.float(alpha.y);
    [x, y, s.at_most(s.at_least(z, 0.0), LONGEST)]
}

/// `(x, y, z)/|(x, y, z)|`.
#[inline(always)]
pub(crate) fn unit<S: Arithmetic>(s: S, [x, y, z]: [S::F; 3]) -> [S::F; 3] {
    let scale = s.float(1.0) / s.sqrt((x * x + y * y) + z * z);
    [x * scale, y * scale, z * scale]
}

/// Uniform numbers in [0, 1 − 2⁻²⁴]; NaN is 0.
#[inline(always)]
pub(crate) fn probabilities<S: Arithmetic>(s: S, [u1, u2]: [S::F; 2]) -> [S::F; 2] {
    const BELOW_ONE: f32 = 1.0 - f32::EPSILON / 2.0;
    [s.at_most(s.at_least(u1, 0.0), BELOW_ONE), s.at_most(s.at_least(u2, 0.0), BELOW_ONE)]
}

/// Implements the methods of `Ndf` for an NDF in closed form by its formulas in one lane.
macro_rules! closed_form {
    ($density:ident) => {
        impl crate::ndf::Ndf for $density {
            #[inline]
            fn d(&self, m: glam::Vec3) -> f32 {
                let [density] = self.density_in_lanes(asperity_core::lanes::Scalar, m.to_array());
                density
            }

            #[inline]
            fn warp_gaussian(&self, z: glam::Vec2) -> glam::Vec3 {
                self.normal(asperity_core::lanes::Scalar, z.to_array()).into()
            }

            #[inline]
            fn invert(&self, m: glam::Vec3) -> glam::Vec2 {
                self.gaussian(asperity_core::lanes::Scalar, m.to_array()).into()
            }

            #[inline]
            fn sample(&self, u: glam::Vec2) -> glam::Vec3 {
                self.polar(asperity_core::lanes::Scalar, u.to_array()).into()
            }

            #[inline]
            fn residual_ndf(&self, h: glam::Vec3, split: crate::coordinates::GaussianSplit) -> f32 {
                let [density] = self.conditional(asperity_core::lanes::Scalar, split, h.to_array());
                density
            }

            fn residual_ndf_batch(
                &self,
                h: &[glam::Vec3],
                split: crate::coordinates::GaussianSplit,
                densities: &mut [f32],
            ) {
                crate::closed_form::residual_ndf_batch(self, h, split, densities);
            }
        }
    };
}
pub(crate) use closed_form;
