//! The `Brdf` trait.

use core::f32::consts::{FRAC_1_PI, TAU};

use glam::{Vec2, Vec3};

use crate::direction::half_vector;
use crate::math::{clamp_to, cos, sin, sqrt};

/// A BRDF or BSDF: value, importance sampling and density.
///
/// ```text
/// L_o(ωo) = ∫ f_r(ωi, ωo) L_i(ωi) cos θ_i dω_i
/// ```
///
/// Directions are unit vectors in the frame of the surface, whose z axis is the normal, and point
/// away from it. Colors are linear RGB. The trait is dyn-compatible.
///
/// Every implementation in this crate accepts every input. It returns 0 where either direction is
/// not above the horizon or not finite, and never a negative number or NaN. Implementations that
/// transmit, see [`transmits`](Brdf::transmits), also accept directions below the surface. They are
/// BSDFs, whose integrals run over both hemispheres with |cos θ_i|. Each documents its reciprocity,
/// `f_r(ωi, ωo) = f_r(ωo, ωi)`, and its albedo, the fraction of the light that it scatters into all
/// directions:
///
/// ```text
/// albedo(ωo) = ∫ f_r(ωi, ωo) cos θ_i dω_i
/// ```
///
/// ```
/// use asperity_shading::glam::{Vec2, Vec3};
/// use asperity_shading::{Brdf, Lambert};
///
/// let chalk = Lambert::new(Vec3::splat(0.8))?;
/// let wo = Vec3::new(0.6, 0.0, 0.8);
/// // One sample of the incident light: f_r cos θ / density is the albedo for every sample.
/// let wi = chalk.sample(wo, Vec2::new(0.3, 0.7));
/// let weight = chalk.value(wi, wo) * wi.z / chalk.density(wi, wo);
/// assert!((weight - Vec3::splat(0.8)).length() < 1e-6);
/// # Ok::<(), asperity_shading::ParameterError>(())
/// ```
#[doc(alias = "brdf")]
#[doc(alias = "reflectance")]
pub trait Brdf {
    /// `f_r(ωi, ωo)` in sr⁻¹, linear RGB; without the cosine.
    #[must_use]
    fn value(&self, wi: Vec3, wo: Vec3) -> Vec3;

    /// Samples a direction `ωi` for light that leaves along `wo`, from a uniform `u` in `[0, 1)²`.
    ///
    /// It may be below the horizon, where `value` is 0: such samples contribute zero. The default
    /// implementation never produces them: its density is `cos θ / π` (Malley's method).
    #[must_use]
    fn sample(&self, wo: Vec3, u: Vec2) -> Vec3 {
        let _ = wo;
        cosine_hemisphere(u)
    }

    /// The density of [`sample`](Brdf::sample) over solid angle, in sr⁻¹.
    ///
    /// 0 where either direction is not above the horizon.
    #[must_use]
    fn density(&self, wi: Vec3, wo: Vec3) -> f32 {
        if are_above(wi, wo) { wi.z * FRAC_1_PI } else { 0.0 }
    }

    /// Whether the BSDF transmits, so that directions below the surface are valid. Default:
    /// `false`.
    #[must_use]
    fn transmits(&self) -> bool {
        false
    }
}

impl<B: Brdf + ?Sized> Brdf for &B {
    fn value(&self, wi: Vec3, wo: Vec3) -> Vec3 {
        (**self).value(wi, wo)
    }

    fn sample(&self, wo: Vec3, u: Vec2) -> Vec3 {
        (**self).sample(wo, u)
    }

    fn density(&self, wi: Vec3, wo: Vec3) -> f32 {
        (**self).density(wi, wo)
    }

    fn transmits(&self) -> bool {
        (**self).transmits()
    }
}

/// Whether both directions are finite and above the horizon.
#[inline]
pub(crate) fn are_above(wi: Vec3, wo: Vec3) -> bool {
    wi.z > 0.0 && wo.z > 0.0 && wi.is_finite() && wo.is_finite()
}

/// Whether both directions are finite and not along the surface.
#[inline]
pub(crate) fn have_sides(wi: Vec3, wo: Vec3) -> bool {
    wi.z != 0.0 && wo.z != 0.0 && wi.is_finite() && wo.is_finite()
}

/// A direction with density `cos θ / π`: a uniform point of the disk, lifted to the hemisphere.
#[inline]
pub(crate) fn cosine_hemisphere(u: Vec2) -> Vec3 {
    let (r2, turn) = (clamp_to(u.x, 1.0), clamp_to(u.y, 1.0));
    let r = sqrt(r2);
    // Never the horizon itself, where the density would be 0.
    let z = sqrt(1.0 - r2).max(1e-4);
    Vec3::new(r * cos(TAU * turn), r * sin(TAU * turn), z)
}

/// The density over `ωi` of reflecting `ωo` at facets sampled with a density over h.
///
/// 0 unless both are above the horizon.
///
/// ```text
/// p(ωi) = p(h) / (4 ωo·h)
/// ```
///
/// Walter, Marschner, Li, Torrance 2007, eq. 14.
#[inline]
pub(crate) fn mirrored_density(wi: Vec3, wo: Vec3, density: impl FnOnce(Vec3) -> f32) -> f32 {
    if !are_above(wi, wo) {
        return 0.0;
    }
    let h = half_vector(wi, wo);
    finite(density(h) / (4.0 * wo.dot(h)))
}

/// A finite non-negative number: NaN becomes 0, and overflow becomes the largest finite number.
#[inline]
pub(crate) fn finite(x: f32) -> f32 {
    if x > 0.0 { x.min(f32::MAX) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Gray;

    impl Brdf for Gray {
        fn value(&self, _: Vec3, _: Vec3) -> Vec3 {
            Vec3::splat(FRAC_1_PI)
        }
    }

    #[test]
    fn default_samples_are_unit_and_above() {
        let brdf: &dyn Brdf = &Gray;
        for x in [f32::NAN, f32::NEG_INFINITY, 0.0, 0.3, 0.999_999_9, 1.0, 7.0] {
            for y in [f32::NAN, 0.0, 0.25, 1.0, f32::INFINITY] {
                let wi = brdf.sample(Vec3::Z, Vec2::new(x, y));
                assert!((wi.length() - 1.0).abs() < 1e-6 && wi.z > 0.0, "{x}, {y}: {wi}");
                assert!(brdf.density(wi, Vec3::Z) > 0.0);
            }
        }
    }
}
