//! An NDF rotated around the macro normal.

use glam::{Vec2, Vec3};

use crate::error::{NdfError, in_range};
use crate::microfacet::{Microfacet, VisibleWarp};
use crate::ndf::Ndf;
use crate::radial::Radial;
use asperity_core::math;

/// The NDF `N`, rotated around the z axis by an angle.
///
/// ```text
/// D(m) = D_N(R⁻¹ m),   T(z) = R T_N(R⁻¹ z),   Λ(v) = Λ_N(R⁻¹ v)          R: the rotation from x towards y by the angle
/// ```
///
/// The Gaussian coordinates are rotated as well, so isotropic NDFs are unchanged. The rotation
/// rounds the shorter slope as much as the longer one: `T⁻¹(T(z)) = z` within 4e-7 times the ratio
/// of the roughnesses.
///
/// ```
/// use asperity_ndf_sampling::{Ggx, Ndf, Rotated, glam::Vec3};
///
/// let ggx = Ggx::new(0.2, 0.4)?;
/// let turned = Rotated::new(ggx, core::f32::consts::FRAC_PI_2)?;
/// assert!((turned.d(Vec3::new(0.0, 0.6, 0.8)) - ggx.d(Vec3::new(0.6, 0.0, 0.8))).abs() < 1e-5);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotated<N> {
    ndf: N,
    cos: f32,
    sin: f32,
}

impl<N> Rotated<N> {
    /// Creates `ndf` rotated by `angle` radians from x towards y.
    ///
    /// # Errors
    /// An angle that is not finite.
    pub fn new(ndf: N, angle: f32) -> Result<Self, NdfError> {
        let angle = f64::from(in_range("angle", angle, [f32::MIN, f32::MAX])?);
        Ok(Self { ndf, cos: math::cos_f64(angle) as f32, sin: math::sin_f64(angle) as f32 })
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
    fn d(&self, m: Vec3) -> f32 {
        self.ndf.d(self.back3(m))
    }

    #[inline]
    fn warp_gaussian(&self, z: Vec2) -> Vec3 {
        // Clamped before, because ∞ − ∞ is NaN.
        let z = crate::coordinates::bounded(z);
        self.turn3(self.ndf.warp_gaussian(self.back(z.x, z.y)))
    }

    #[inline]
    fn invert(&self, m: Vec3) -> Vec2 {
        let z = self.ndf.invert(self.back3(m));
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

    #[inline]
    fn sample_reflecting(&self, v: Vec3, u: Vec2) -> Vec3 {
        self.turn3(self.ndf.sample_reflecting(self.back3(v), u))
    }

    #[inline]
    fn reflecting_pdf(&self, v: Vec3, m: Vec3) -> f32 {
        self.ndf.reflecting_pdf(self.back3(v), self.back3(m))
    }
}

impl<N: VisibleWarp> VisibleWarp for Rotated<N> {
    #[inline]
    fn warp_visible(&self, v: Vec3, z: Vec2) -> Vec3 {
        let z = crate::coordinates::bounded(z);
        self.turn3(self.ndf.warp_visible(self.back3(v), self.back(z.x, z.y)))
    }

    #[inline]
    fn invert_visible(&self, v: Vec3, m: Vec3) -> Vec2 {
        let z = self.ndf.invert_visible(self.back3(v), self.back3(m));
        self.turn(z.x, z.y)
    }

    #[inline]
    fn warp_visible_pdf(&self, v: Vec3, m: Vec3) -> f32 {
        self.ndf.warp_visible_pdf(self.back3(v), self.back3(m))
    }
}

impl<N: Radial> Radial for Rotated<N> {
    #[inline]
    fn exponent(&self, slope: f64) -> Option<f64> {
        self.ndf.exponent(slope)
    }
}
