//! Closed forms of densities in lanes: in one for a single call, in many for arrays.

use crate::density::roughness::Roughness;
use crate::simd::lanes::Lanes;

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

/// The calls of `Ndf` for a density in closed form, its formulas in one lane; and those for arrays, in as many as there are.
macro_rules! closed_form {
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
                self.gaussian(crate::simd::lanes::Scalar, m.to_array()).into()
            }

            #[inline]
            fn sample(&self, u: glam::Vec2) -> glam::Vec3 {
                self.polar(crate::simd::lanes::Scalar, u.to_array()).into()
            }
        }

        // Inline, so that only what is called is compiled: at every SIMD level all of it takes as long as the rest of the crate.
        /// Calls for many points: every array holds one component. Results agree with the single calls within 1e-6 and have
        /// the same bits on every machine, in every number of lanes and under every feature.
        impl $density {
            /// Normals `T(z)` of Gaussian coordinates: [`from_gaussian`](crate::Ndf::from_gaussian) of many.
            ///
            /// # Errors
            /// Arrays of different lengths; nothing is written then.
            #[inline]
            pub fn normals(
                &self,
                z: [&[f32]; 2],
                m: [&mut [f32]; 3],
            ) -> Result<(), crate::batch_error::BatchError> {
                crate::simd::dispatch::Level::best().normals(self, z, m)
            }

            /// Gaussian coordinates `T⁻¹(m)` of normals: [`to_gaussian`](crate::Ndf::to_gaussian) of many.
            ///
            /// # Errors
            /// Arrays of different lengths; nothing is written then.
            #[inline]
            pub fn coordinates(
                &self,
                m: [&[f32]; 3],
                z: [&mut [f32]; 2],
            ) -> Result<(), crate::batch_error::BatchError> {
                crate::simd::dispatch::Level::best().coordinates(self, m, z)
            }

            /// Densities `D(m)` of normals, in sr⁻¹.
            ///
            /// # Errors
            /// Arrays of different lengths; nothing is written then.
            #[inline]
            pub fn densities(
                &self,
                m: [&[f32]; 3],
                density: &mut [f32],
            ) -> Result<(), crate::batch_error::BatchError> {
                crate::simd::dispatch::Level::best().densities(self, m, density)
            }

            /// Normals of uniform numbers `u` in [0, 1)², with the density `D cos θ` over solid angle.
            ///
            /// # Errors
            /// Arrays of different lengths; nothing is written then.
            #[inline]
            pub fn samples(
                &self,
                u: [&[f32]; 2],
                m: [&mut [f32]; 3],
            ) -> Result<(), crate::batch_error::BatchError> {
                crate::simd::dispatch::Level::best().samples(self, u, m)
            }

            /// Visible normals for the views `v` and the uniform numbers `u`, one view for each.
            ///
            /// Views as in [`Microfacet::sample_visible`](crate::Microfacet::sample_visible), of any length up to 10¹². For
            /// [`Beckmann`](crate::Beckmann) the share of slopes below the sample is `u` within 2e-6.
            ///
            /// # Errors
            /// Arrays of different lengths; nothing is written then.
            #[inline]
            pub fn visible_samples(
                &self,
                v: [&[f32]; 3],
                u: [&[f32]; 2],
                m: [&mut [f32]; 3],
            ) -> Result<(), crate::batch_error::BatchError> {
                crate::simd::dispatch::Level::best().visible_samples(self, v, u, m)
            }
        }
    };
}
pub(crate) use closed_form;
