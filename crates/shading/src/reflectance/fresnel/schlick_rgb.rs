//! Schlick's approximation with colors at both ends and a dip, the Fresnel term of layered models.

use glam::Vec3;

use crate::math::clamp_to;
use crate::reflectance::fresnel::interface::Fresnel;

/// `F₀ + (F₉₀ − F₀) (1 − c)⁵ − a c (1 − c)⁶` in each channel; mixtures of it have the same form.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SchlickRgb {
    pub f0: Vec3,
    pub f90: Vec3,
    /// The weight `a` of [`SchlickF82::dip`](crate::reflectance::SchlickF82::dip).
    pub dip: Vec3,
}

impl SchlickRgb {
    /// `(1 − t) self + t other`.
    pub(crate) fn lerp(self, other: Self, t: f32) -> Self {
        Self {
            f0: self.f0.lerp(other.f0, t),
            f90: self.f90.lerp(other.f90, t),
            dip: self.dip.lerp(other.dip, t),
        }
    }

    /// `2 ∫ F(c) c dc` over `[0, 1]`, without the clamp of each value.
    pub(crate) fn mean(&self) -> Vec3 {
        (self.f0 * (20.0 / 21.0) + self.f90 * (1.0 / 21.0) - self.dip * (1.0 / 126.0))
            .clamp(Vec3::ZERO, Vec3::ONE)
    }
}

impl Fresnel for SchlickRgb {
    #[inline]
    fn reflectance_rgb(&self, cos_theta: f32) -> Vec3 {
        let c = clamp_to(cos_theta, 1.0);
        let x = 1.0 - c;
        let x2 = x * x;
        let x5 = x2 * x2 * x;
        (self.f0 + (self.f90 - self.f0) * x5 - self.dip * (c * x5 * x)).clamp(Vec3::ZERO, Vec3::ONE)
    }
}
