//! The Torrance–Sparrow microfacet model with V-shaped grooves, for any NDF.

use asperity_ndf_sampling::Ndf;
use glam::{Vec2, Vec3};

use crate::direction::{half_vector, reflect};
use crate::reflectance::brdf::{Brdf, BsdfSample, are_above, finite, mirrored_pdf};
use crate::reflectance::fresnel::Fresnel;

/// The Torrance–Sparrow microfacet model with V-shaped grooves, for any NDF.
///
/// ```text
/// f_r = D(h) F(ωo·h) G / (4 cos θ_i cos θ_o)
/// G   = min(1, 2 h_z cos θ_o / (ωo·h), 2 h_z cos θ_i / (ωo·h))
/// ```
///
/// - **Domain:** any [`Ndf`], including tables and painted NDFs, because the masking does not
///   depend on it.
/// - **Range:** at least 0, finite; reciprocal bit for bit.
/// - **Energy:** the albedo is at most that of the facets for NDFs that are symmetric around the
///   normal, for which the masking is derived (Heitz 2014, §3.3.2). For others it may exceed 1 near
///   the horizon.
/// - **Sampling:** `D(h) h_z`, reflected.
///
/// Torrance, Sparrow 1967, *Theory for Off-Specular Reflection From Roughened Surfaces*; Blinn
/// 1977, *Models of Light Reflection for Computer Synthesized Pictures*; Cook, Torrance 1982, eq.
/// 2.
///
/// ```
/// use asperity_shading::ndf_sampling::BlinnPhong;
/// use asperity_shading::{Brdf, TorranceSparrow, glam::Vec3};
///
/// let plaster = TorranceSparrow::new(BlinnPhong::new(20.0)?, Vec3::splat(0.6));
/// assert!(plaster.eval(Vec3::Z, Vec3::Z).x > 0.0);
/// # Ok::<(), asperity_shading::ndf_sampling::NdfError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TorranceSparrow<D, F> {
    density: D,
    fresnel: F,
}

impl<D: Ndf, F: Fresnel> TorranceSparrow<D, F> {
    /// Creates the surface with this NDF and facet reflectance.
    #[must_use]
    pub const fn new(density: D, fresnel: F) -> Self {
        Self { density, fresnel }
    }

    /// The NDF.
    #[must_use]
    pub const fn facets(&self) -> &D {
        &self.density
    }

    /// The reflectance of the facets.
    #[must_use]
    pub const fn fresnel(&self) -> &F {
        &self.fresnel
    }
}

impl<D: Ndf, F: Fresnel> Brdf for TorranceSparrow<D, F> {
    fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        if !are_above(wi, wo) {
            return Vec3::ZERO;
        }
        let h = half_vector(wi, wo);
        // ωo·h = ωi·h, but the rounding of each product would make them different: by 5 % at 89.9°.
        let cosine = 0.5 * (wi + wo).length();
        // G/(cos θ_i cos θ_o), with the smaller cosine cancelled.
        let (low, high) = if wi.z < wo.z { (wi.z, wo.z) } else { (wo.z, wi.z) };
        let masked = (1.0 / low).min(2.0 * h.z / cosine) / high;
        finite(self.density.d(h) * masked * 0.25) * self.fresnel.reflectance_rgb(cosine)
    }

    fn sample(&self, wo: Vec3, _: f32, u: Vec2) -> Option<BsdfSample> {
        BsdfSample::from_direction(self, wo, reflect(wo, self.density.sample(u)))
    }

    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        mirrored_pdf(wo, wi, |h| self.density.pdf(h))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reflectance::fresnel::Dielectric;
    use asperity_ndf_sampling::Ggx;

    #[test]
    fn reciprocity_holds_at_the_horizon() {
        let grooves = TorranceSparrow::new(Ggx::new(0.2, 0.4).unwrap(), Dielectric::new(1.5).unwrap());
        for k in 0..200_u8 {
            let (low, turn) = (1e-4 * f32::from(k + 1), 3.0 + 0.0014 * f32::from(k));
            let across = (1.0 - low * low).sqrt();
            let (wi, wo) =
                (Vec3::new(across, 0.0, low), Vec3::new(turn.cos(), turn.sin(), 0.002).normalize());
            assert!(grooves.eval(wo, wi).x > 0.0);
            assert_eq!(grooves.eval(wo, wi), grooves.eval(wi, wo), "{wi}, {wo}");
        }
    }
}
