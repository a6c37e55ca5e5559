//! A density turned about the macro normal.

use glam::{Vec2, Vec3};

use crate::math;
use crate::microfacet::Microfacet;
use crate::ndf::Ndf;
use crate::radial::Radial;
use crate::range_error::RangeError;

/// The density `N`, turned about the z axis by an angle.
///
/// ```text
/// D(m) = D_N(R⁻¹ m),   T(z) = R T_N(R⁻¹ z),   Λ(v) = Λ_N(R⁻¹ v)          R: the rotation from x towards y by the angle
/// ```
///
/// The Gaussian coordinates are turned as well, so that a density which depends on the tilt alone stays as it is. Turning
/// rounds the shorter slope like the longer: `T⁻¹(T(z)) = z` within 4e-7 times the ratio of the roughnesses.
///
/// ```
/// use asperity_ndf_sampling::{Ggx, Ndf, Rotated, glam::Vec3};
///
/// let ggx = Ggx::new(0.2, 0.4)?;
/// let turned = Rotated::new(ggx, core::f32::consts::FRAC_PI_2)?;
/// assert!((turned.density(Vec3::new(0.0, 0.6, 0.8)) - ggx.density(Vec3::new(0.6, 0.0, 0.8))).abs() < 1e-5);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotated<N> {
    ndf: N,
    cos: f32,
    sin: f32,
}

impl<N> Rotated<N> {
    /// `ndf`, turned by `angle` radians from x towards y.
    ///
    /// # Errors
    /// An angle that is not finite.
    pub fn new(ndf: N, angle: f32) -> Result<Self, RangeError> {
        let angle = f64::from(RangeError::check("angle", angle, [f32::MIN, f32::MAX])?);
        Ok(Self { ndf, cos: math::cos_f64(angle) as f32, sin: math::sin_f64(angle) as f32 })
    }

    /// The density that is turned.
    pub const fn ndf(&self) -> &N {
        &self.ndf
    }

    fn turn(&self, x: f32, y: f32) -> Vec2 {
        Vec2::new(self.cos * x - self.sin * y, self.sin * x + self.cos * y)
    }

    fn back(&self, x: f32, y: f32) -> Vec2 {
        Vec2::new(self.cos * x + self.sin * y, self.cos * y - self.sin * x)
    }

    fn back3(&self, m: Vec3) -> Vec3 {
        self.back(m.x, m.y).extend(m.z)
    }

    fn turn3(&self, m: Vec3) -> Vec3 {
        self.turn(m.x, m.y).extend(m.z)
    }
}

impl<N: Ndf> Ndf for Rotated<N> {
    #[inline]
    fn density(&self, m: Vec3) -> f32 {
        self.ndf.density(self.back3(m))
    }

    #[inline]
    fn from_gaussian(&self, z: Vec2) -> Vec3 {
        // Bounded before, for ∞ − ∞ is NaN.
        let z = crate::ndf::bounded(z);
        self.turn3(self.ndf.from_gaussian(self.back(z.x, z.y)))
    }

    #[inline]
    fn to_gaussian(&self, m: Vec3) -> Vec2 {
        let z = self.ndf.to_gaussian(self.back3(m));
        self.turn(z.x, z.y)
    }

    #[inline]
    fn sample(&self, u: Vec2) -> Vec3 {
        self.turn3(self.ndf.sample(u))
    }
}

impl<N: Microfacet> Microfacet for Rotated<N> {
    #[inline]
    fn lambda(&self, v: Vec3) -> f32 {
        self.ndf.lambda(self.back3(v))
    }

    #[inline]
    fn projected_area(&self, v: Vec3) -> f32 {
        self.ndf.projected_area(self.back3(v))
    }

    #[inline]
    fn sample_visible(&self, v: Vec3, u: Vec2) -> Vec3 {
        self.turn3(self.ndf.sample_visible(self.back3(v), u))
    }
}

impl<N: Radial> Radial for Rotated<N> {
    #[inline]
    fn exponent(&self, slope: f64) -> Option<f64> {
        self.ndf.exponent(slope)
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::Ggx;
    use crate::microfacet::totality;
    use std::string::ToString;

    #[test]
    fn quarter_turns_swap_the_axes() {
        let (ggx, swapped) = (Ggx::new(0.2, 0.4).unwrap(), Ggx::new(0.4, 0.2).unwrap());
        let turned = Rotated::new(ggx, core::f32::consts::FRAC_PI_2).unwrap();
        let (z, v) = (Vec2::new(0.7, -1.2), Vec3::new(0.5, -0.3, 0.4));
        let m = swapped.from_gaussian(z);
        assert_abs_diff_eq!(turned.from_gaussian(z), m, epsilon = 1e-6);
        assert_abs_diff_eq!(turned.to_gaussian(m), z, epsilon = 1e-5);
        assert_abs_diff_eq!(turned.density(m) / swapped.density(m), 1.0, epsilon = 1e-5);
        assert_abs_diff_eq!(turned.lambda(v) / swapped.lambda(v), 1.0, epsilon = 1e-5);
        assert_abs_diff_eq!(turned.projected_area(v) / swapped.projected_area(v), 1.0, epsilon = 1e-6);
        let m = turned.sample_visible(v, Vec2::new(0.3, 0.8));
        assert_abs_diff_eq!(
            turned.visible_density(v, m) / swapped.visible_density(v, m),
            1.0,
            epsilon = 1e-5
        );
        assert_eq!((turned.exponent(0.3), turned.ndf()), (None, &ggx));
    }

    #[test]
    fn inputs_are_total_and_angles_finite() {
        let turned = Rotated::new(Ggx::isotropic(0.3).unwrap(), -1e30).unwrap();
        totality::check(&turned);
        let error = Rotated::new(turned, f32::NAN).unwrap_err();
        assert_eq!(error.to_string(), "angle must be between -3.4028235e38 and 3.4028235e38, got NaN");
    }
}
