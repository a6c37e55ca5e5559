//! Roughness: the valid range of `alpha_x` and `alpha_y`.

use glam::Vec3;

use crate::error::{NdfError, in_range};
use crate::microfacet::above;
use asperity_core::math;

/// The smallest roughness.
pub(crate) const MIN_ALPHA: f32 = 1e-6;

/// The largest roughness.
pub(crate) const MAX_ALPHA: f32 = 1e6;

/// Both roughnesses of an NDF, checked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Roughness {
    /// Along x.
    pub(crate) x: f32,
    /// Along y.
    pub(crate) y: f32,
}

impl Roughness {
    pub(crate) fn new(alpha_x: f32, alpha_y: f32) -> Result<Self, NdfError> {
        let check = |parameter, alpha| in_range(parameter, alpha, [MIN_ALPHA, MAX_ALPHA]);
        Ok(Self { x: check("alpha_x", alpha_x)?, y: check("alpha_y", alpha_y)? })
    }

    pub(crate) fn new_clamped(alpha_x: f32, alpha_y: f32) -> Self {
        // NaN becomes 1, dull rather than a mirror.
        let clamp = |alpha: f32| if alpha.is_nan() { 1.0 } else { alpha.clamp(MIN_ALPHA, MAX_ALPHA) };
        Self { x: clamp(alpha_x), y: clamp(alpha_y) }
    }

    /// `v` in the space where the roughnesses are 1.
    #[inline]
    pub(crate) fn stretch(self, v: Vec3) -> Vec3 {
        Vec3::new(self.x * v.x, self.y * v.y, v.z)
    }

    /// The standard deviation of Beckmann's slopes along `v`, times the length of `v` in the plane.
    fn spread(self, v: Vec3) -> f64 {
        let (x, y) = (f64::from(self.x) * f64::from(v.x), f64::from(self.y) * f64::from(v.y));
        math::sqrt_f64(0.5 * (x * x + y * y))
    }

    /// Smith's `Λ(v) = E(z)/z` from the mean excess of the slopes over `z`, in units of their
    /// [`spread`](Self::spread).
    pub(crate) fn lambda(self, v: Vec3, excess: impl Fn(f64) -> f64) -> f32 {
        // In f64, since Λ may decrease like exp(−z²/2). At the zenith z is infinite and the excess
        // 0.
        let z = f64::from(v.z) / self.spread(v);
        if z > 0.0 { (excess(z) / z) as f32 } else { f32::INFINITY }
    }

    /// The projected area `σ(v)` from the same excess.
    pub(crate) fn projected_area(self, v: Vec3, excess: impl Fn(f64) -> f64) -> f32 {
        let v = above(v);
        let (spread, up) = (self.spread(v), f64::from(v.z));
        if spread > 0.0 { (up + spread * excess(up / spread)) as f32 } else { v.z }
    }

    /// The normal whose slope in the stretched space is `(x, y)/z`, for `z > 0`.
    #[inline]
    pub(crate) fn normal(self, x: f32, y: f32, z: f32) -> Vec3 {
        let (x, y) = (self.x * x, self.y * y);
        let length = math::sqrt(x * x + y * y + z * z);
        Vec3::new(x / length, y / length, z / length)
    }
}

/// The constructors and accessors of an NDF whose only parameters are `alpha: Roughness`.
macro_rules! roughness_parameters {
    ($density:ident) => {
        impl $density {
            /// Creates the NDF with the roughnesses `alpha_x` and `alpha_y`.
            ///
            /// # Errors
            /// A roughness outside
            /// [`MIN_ALPHA`](Self::MIN_ALPHA)`..=`[`MAX_ALPHA`](Self::MAX_ALPHA). The error
            /// contains its name and value.
            #[inline]
            pub fn new(alpha_x: f32, alpha_y: f32) -> Result<Self, $crate::error::NdfError> {
                $crate::density::roughness::Roughness::new(alpha_x, alpha_y).map(|alpha| Self { alpha })
            }

            /// Creates the isotropic NDF with the roughness `alpha`.
            ///
            /// # Errors
            /// See [`Self::new`]; the error contains the name `alpha_x`.
            #[inline]
            pub fn isotropic(alpha: f32) -> Result<Self, $crate::error::NdfError> {
                Self::new(alpha, alpha)
            }

            /// Creates the NDF with roughnesses clamped to the valid range; NaN becomes 1.
            #[inline]
            #[must_use]
            pub fn new_clamped(alpha_x: f32, alpha_y: f32) -> Self {
                Self { alpha: $crate::density::roughness::Roughness::new_clamped(alpha_x, alpha_y) }
            }
        }

        $crate::density::roughness::roughness_accessors!($density);
        #[cfg(feature = "approx")]
        asperity_core::impl_approx! { f32; $density: density => density.alpha.x, density.alpha.y; }
        $crate::serde::written!($density, |density| { alpha_x: density.alpha.x, alpha_y: density.alpha.y });
    };
}
pub(crate) use roughness_parameters;

/// The accessors of an NDF with a field `alpha: Roughness`.
macro_rules! roughness_accessors {
    ($density:ident) => {
        impl $density {
            /// The smallest roughness, below which `1/(π α²)` and its products leave the range of
            /// `f32`.
            pub const MIN_ALPHA: f32 = $crate::density::roughness::MIN_ALPHA;

            /// The largest roughness, above which normals at the horizon leave the range of `f32`.
            pub const MAX_ALPHA: f32 = $crate::density::roughness::MAX_ALPHA;

            /// The roughness along x.
            #[inline]
            #[must_use]
            pub const fn alpha_x(self) -> f32 {
                self.alpha.x
            }

            /// The roughness along y.
            #[inline]
            #[must_use]
            pub const fn alpha_y(self) -> f32 {
                self.alpha.y
            }
        }
    };
}
pub(crate) use roughness_accessors;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clamped_accepts_every_value() {
        for (dirty, clean) in
            [(f32::NAN, 1.0), (f32::INFINITY, MAX_ALPHA), (-1.0, MIN_ALPHA), (0.0, MIN_ALPHA), (0.3, 0.3)]
        {
            assert_eq!(Roughness::new_clamped(dirty, 0.5), Roughness { x: clean, y: 0.5 }, "{dirty}");
        }
    }
}
