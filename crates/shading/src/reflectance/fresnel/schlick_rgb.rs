//! Schlick's approximation with colors, for mixtures of metals and dielectrics.

use glam::Vec3;

use crate::math::clamp_to;
use crate::reflectance::fresnel::dielectric::Dielectric;
use crate::reflectance::fresnel::interface::Fresnel;

/// Schlick's approximation between two colors, with the dip of metals near 82°.
///
/// ```text
/// F = f0 + (f90 − f0) (1 − c)⁵ − dip c (1 − c)⁶,     c = cos θ
/// ```
///
/// Linear in all three colors, so a mixture of interfaces has the mixed colors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SchlickRgb {
    pub f0: Vec3,
    pub f90: Vec3,
    pub dip: Vec3,
}

impl SchlickRgb {
    /// A dielectric of this color, with its reflectance at normal incidence and, where Schlick's
    /// approximation can, its mean reflectance.
    ///
    /// ```text
    /// f90 = clamp(21 F_avg − 20 f0, 0, 1)
    /// ```
    ///
    /// It is 1 for indices from 1.35 to 2.46, below 1 for others, and 0 for an index of 1, where an f90 of 1 would still
    /// reflect 4.8 % of diffuse light.
    pub(crate) fn of_dielectric(fresnel: Dielectric, color: Vec3) -> Self {
        let f0 = fresnel.reflectance(1.0);
        let f90 = clamp_to(21.0 * fresnel.mean_reflectance_rgb().x - 20.0 * f0, 1.0);
        Self { f0: f0 * color, f90: f90 * color, dip: Vec3::ZERO }
    }

    /// The interface `t` of the way to another.
    pub(crate) fn lerp(self, other: Self, t: f32) -> Self {
        Self {
            f0: self.f0.lerp(other.f0, t),
            f90: self.f90.lerp(other.f90, t),
            dip: self.dip.lerp(other.dip, t),
        }
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

    /// The integral of the formula, which is exact without its clamp.
    fn mean_reflectance_rgb(&self) -> Vec3 {
        ((20.0 * self.f0 + self.f90) / 21.0 - self.dip / 126.0).clamp(Vec3::ZERO, Vec3::ONE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reflectance::fresnel::interface::MEAN_NODES;
    use crate::reflectance::fresnel::{Schlick, SchlickF82};
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn dielectrics_keep_their_mean_reflectance() {
        for index in [1.0, 1.001, 1.05, 1.2, 1.34, 2.5, 3.0] {
            let exact = Dielectric::new(index).unwrap();
            let schlick = SchlickRgb::of_dielectric(exact, Vec3::ONE);
            assert_abs_diff_eq!(
                schlick.mean_reflectance_rgb(),
                exact.mean_reflectance_rgb(),
                epsilon = 1e-6,
                "{index}"
            );
        }
        assert_eq!(SchlickRgb::of_dielectric(Dielectric::new(1.0).unwrap(), Vec3::ONE).f90, Vec3::ZERO);
        for index in [1.35, 1.5, 2.0, 2.4] {
            let exact = Dielectric::new(index).unwrap();
            let schlick = SchlickRgb::of_dielectric(exact, Vec3::ONE);
            assert_eq!(schlick.f90, Vec3::ONE);
            let low = schlick.mean_reflectance_rgb().x / exact.mean_reflectance_rgb().x;
            assert!((0.92..1.0).contains(&low), "{index}: {low}");
        }
    }

    #[test]
    fn schlick_rgb_has_the_values_of_the_gray_forms_and_their_mean() {
        let (plain, tinted) = (Schlick::new(0.04).unwrap(), SchlickF82::new(0.6, 0.7).unwrap());
        let one =
            |f0: f32, dip: f32| SchlickRgb { f0: Vec3::splat(f0), f90: Vec3::ONE, dip: Vec3::splat(dip) };
        let same: [(SchlickRgb, &dyn Fresnel); 2] =
            [(one(0.04, 0.0), &plain), (one(0.6, tinted.dip()), &tinted)];
        for (colored, gray) in same {
            for c in [0.0, 0.02, 1.0 / 7.0, 0.4, 0.9, 1.0, f32::NAN] {
                assert_abs_diff_eq!(colored.reflectance_rgb(c), gray.reflectance_rgb(c), epsilon = 3e-7);
            }
            let mean: Vec3 = MEAN_NODES.into_iter().map(|[c, w]| w * gray.reflectance_rgb(c)).sum();
            assert_abs_diff_eq!(colored.mean_reflectance_rgb(), mean, epsilon = 1e-6);
        }
    }
}
