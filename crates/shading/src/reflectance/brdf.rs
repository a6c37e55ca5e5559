//! The `Brdf` trait and its samples.

use core::f32::consts::{FRAC_1_PI, TAU};

use glam::{Vec2, Vec3};

use crate::direction::half_vector;
use crate::math::{clamp_to, cos, sin, sqrt};

/// A BRDF or BSDF: value, pdf and importance sampling.
///
/// ```text
/// L_o(ωo) = ∫ f(ωo, ωi) L_i(ωi) cos θ_i dω_i
/// ```
///
/// Directions are unit vectors in the frame of the surface, whose z axis is the normal, and point
/// away from it. `wo` points to the eye, `wi` to the light. Colors are linear RGB. The trait is
/// dyn-compatible. A [`Bsdf`](crate::Bsdf) has the same methods in world space.
///
/// Every implementation in this crate accepts every input. It returns 0 where either direction is
/// not above the horizon or not finite, and never a negative number or NaN. Implementations that
/// transmit, see [`transmits`](Brdf::transmits), also accept directions below the surface. They are
/// BSDFs, whose integrals run over both hemispheres with |cos θ_i|. Each documents its reciprocity,
/// `f(ωo, ωi) = f(ωi, ωo)`, and its albedo, the fraction of the light that it scatters into all
/// directions:
///
/// ```text
/// albedo(ωo) = ∫ f(ωo, ωi) cos θ_i dω_i
/// ```
///
/// ```
/// use asperity_shading::glam::{Vec2, Vec3};
/// use asperity_shading::{Brdf, Lambert};
///
/// let chalk = Lambert::new(Vec3::splat(0.8))?;
/// let wo = Vec3::new(0.6, 0.0, 0.8);
/// let sample = chalk.sample(wo, 0.5, Vec2::new(0.3, 0.7)).unwrap();
/// assert_eq!(sample.pdf, chalk.pdf(wo, sample.wi));
/// assert!((sample.weight() - Vec3::splat(0.8)).length() < 1e-6);
/// # Ok::<(), asperity_shading::ShadingError>(())
/// ```
#[doc(alias = "brdf")]
#[doc(alias = "reflectance")]
pub trait Brdf {
    /// `f(ωo, ωi)` in sr⁻¹, linear RGB; without the cosine.
    #[must_use]
    fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3;

    /// Samples a direction of the light that leaves along `wo`.
    ///
    /// `uc` selects a lobe, and `u` a direction; all are uniform in `[0, 1)`. `None` if there is no
    /// light for these numbers, for example because a facet reflects below the horizon. The default
    /// has the pdf `cos θ / π` (Malley's method).
    #[must_use]
    fn sample(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BsdfSample> {
        let _ = uc;
        BsdfSample::from_direction(self, wo, cosine_hemisphere(u))
    }

    /// The density of [`sample`](Brdf::sample) over solid angle, in sr⁻¹.
    ///
    /// 0 where either direction is not above the horizon. Specular samples do not count.
    #[must_use]
    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
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
    fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        (**self).eval(wo, wi)
    }

    fn sample(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BsdfSample> {
        (**self).sample(wo, uc, u)
    }

    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        (**self).pdf(wo, wi)
    }

    fn transmits(&self) -> bool {
        (**self).transmits()
    }
}

/// A direction sampled from a [`Brdf`] or [`Bsdf`](crate::Bsdf), with its value and pdf.
///
/// The expected [`weight`](Self::weight) over uniform random numbers, where `None` counts as 0, is
/// the albedo seen from `wo`:
///
/// ```text
/// E[weight] = ∫ f(ωo, ωi) |cos θ_i| dω_i + Σ_specular weight
/// ```
///
/// A specular sample is one of a few single directions, for which no density over solid angle
/// exists. Its `eval_cos` is the fraction of radiance that it scatters, and its `pdf` is the
/// probability of the direction. Both are without unit.
#[doc(alias = "BSDFSample")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BsdfSample {
    /// The unit direction towards the light, in the space of `wo`.
    pub wi: Vec3,
    /// `f |cos θ_i|` in sr⁻¹; for a specular sample the scattered fraction of radiance.
    pub eval_cos: Vec3,
    /// The density over solid angle in sr⁻¹; for a specular sample the probability. Positive.
    pub pdf: f32,
    /// The side of the light, and whether the sample is specular.
    pub kind: SampleKind,
}

/// The kind of scattering of a [`BsdfSample`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SampleKind {
    /// Diffuse or glossy reflection.
    Reflection,
    /// Diffuse or glossy transmission.
    Transmission,
    /// Reflection in a single direction.
    SpecularReflection,
    /// Transmission in a single direction.
    SpecularTransmission,
}

impl BsdfSample {
    /// The sample of a direction that was drawn with the `pdf` of a BRDF.
    ///
    /// Both directions are in the frame of the surface. `None` where the pdf is 0.
    #[must_use]
    pub fn from_direction<B: Brdf + ?Sized>(brdf: &B, wo: Vec3, wi: Vec3) -> Option<Self> {
        Self::with_pdf(wo, wi, brdf.pdf(wo, wi), || brdf.eval(wo, wi) * wi.z.abs())
    }

    /// The sample of a direction with this pdf that is not specular; `None` where the pdf is 0.
    pub(crate) fn with_pdf(wo: Vec3, wi: Vec3, pdf: f32, eval_cos: impl FnOnce() -> Vec3) -> Option<Self> {
        let kind = if wi.z * wo.z < 0.0 { SampleKind::Transmission } else { SampleKind::Reflection };
        (pdf > 0.0).then(|| Self { wi, eval_cos: eval_cos(), pdf, kind })
    }

    /// The factor of the throughput of a path: `f |cos θ_i| / pdf`, finite and at least 0.
    #[must_use]
    pub fn weight(&self) -> Vec3 {
        (self.eval_cos / self.pdf).map(finite)
    }

    /// Whether the direction is a single one, which samples of a light cannot find.
    #[doc(alias = "delta")]
    #[must_use]
    pub const fn is_specular(&self) -> bool {
        matches!(self.kind, SampleKind::SpecularReflection | SampleKind::SpecularTransmission)
    }

    /// Whether the light comes from the other side of the surface.
    #[must_use]
    pub const fn is_transmission(&self) -> bool {
        matches!(self.kind, SampleKind::Transmission | SampleKind::SpecularTransmission)
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

/// The pdf of `ωi`, the reflection of `ωo` at facets sampled with a pdf over h.
///
/// 0 unless both are above the horizon.
///
/// ```text
/// p(ωi) = p(h) / (4 ωo·h)
/// ```
///
/// Walter, Marschner, Li, Torrance 2007, eq. 14.
#[inline]
pub(crate) fn mirrored_pdf(wo: Vec3, wi: Vec3, pdf: impl FnOnce(Vec3) -> f32) -> f32 {
    if !are_above(wi, wo) {
        return 0.0;
    }
    let h = half_vector(wi, wo);
    finite(pdf(h) / (4.0 * wo.dot(h)))
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
        fn eval(&self, _: Vec3, _: Vec3) -> Vec3 {
            Vec3::splat(FRAC_1_PI)
        }
    }

    #[test]
    fn default_samples_are_unit_and_above() {
        let brdf: &dyn Brdf = &Gray;
        for x in [f32::NAN, f32::NEG_INFINITY, 0.0, 0.3, 0.999_999_9, 1.0, 7.0] {
            for y in [f32::NAN, 0.0, 0.25, 1.0, f32::INFINITY] {
                let BsdfSample { wi, pdf, .. } = brdf.sample(Vec3::Z, x, Vec2::new(x, y)).unwrap();
                assert!((wi.length() - 1.0).abs() < 1e-6 && wi.z > 0.0, "{x}, {y}: {wi}");
                assert!(pdf > 0.0);
            }
        }
        assert_eq!(brdf.sample(Vec3::NAN, 0.5, Vec2::ZERO), None);
    }
}
