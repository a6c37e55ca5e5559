//! The microfacet model over grooves of the shape of a V, for any density of normals.

use asperity_ndf_sampling::Ndf;
use glam::{Vec2, Vec3};

use crate::direction::{half_vector, reflect};
use crate::reflectance::brdf::{Brdf, are_above, finite, mirrored_density};
use crate::reflectance::fresnel::Fresnel;

/// The microfacet model of Torrance and Sparrow, whose facets are the walls of V-shaped grooves: any density will do.
///
/// ```text
/// f_r = D(h) F(ωo·h) G / (4 cos θ_i cos θ_o)
/// G   = min(1, 2 h_z cos θ_o / (ωo·h), 2 h_z cos θ_i / (ωo·h))
/// ```
///
/// - **Domain:** any [`Ndf`], tables and painted densities too: the masking does not depend on it.
/// - **Range:** at least 0, finite; reciprocal to the bit.
/// - **Energy:** the albedo is at most that of the facets for densities that are symmetric about the normal, whose grooves
///   the masking is made for (Heitz 2014, §3.3.2). Of others it may pass 1 near the horizon.
/// - **Sampling:** `D(h) h_z`, mirrored.
///
/// Torrance, Sparrow 1967, *Theory for Off-Specular Reflection From Roughened Surfaces*; Blinn 1977, *Models of Light Reflection
/// for Computer Synthesized Pictures*; Cook, Torrance 1982, eq. 2.
///
/// ```
/// use asperity_shading::ndf_sampling::BlinnPhong;
/// use asperity_shading::{Brdf, TorranceSparrow, glam::Vec3};
///
/// let plaster = TorranceSparrow::new(BlinnPhong::new(20.0)?, Vec3::splat(0.6));
/// assert!(plaster.value(Vec3::Z, Vec3::Z).x > 0.0);
/// # Ok::<(), asperity_shading::ndf_sampling::RangeError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TorranceSparrow<D, F> {
    density: D,
    fresnel: F,
}

impl<D: Ndf, F: Fresnel> TorranceSparrow<D, F> {
    /// The surface whose facets have this density and reflect so much.
    #[must_use]
    pub const fn new(density: D, fresnel: F) -> Self {
        Self { density, fresnel }
    }

    /// The density of normals.
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
    fn value(&self, wi: Vec3, wo: Vec3) -> Vec3 {
        if !are_above(wi, wo) {
            return Vec3::ZERO;
        }
        let h = half_vector(wi, wo);
        // ωo·h = ωi·h, which the rounding of either product would tell apart: by 5 % at 89.9°.
        let cosine = 0.5 * (wi + wo).length();
        // G/(cos θ_i cos θ_o), with the cosine that is the lesser cancelled.
        let (low, high) = if wi.z < wo.z { (wi.z, wo.z) } else { (wo.z, wi.z) };
        let masked = (1.0 / low).min(2.0 * h.z / cosine) / high;
        finite(self.density.density(h) * masked * 0.25) * self.fresnel.reflectance_rgb(cosine)
    }

    fn sample(&self, wo: Vec3, u: Vec2) -> Vec3 {
        reflect(wo, self.density.sample(u))
    }

    fn density(&self, wi: Vec3, wo: Vec3) -> f32 {
        mirrored_density(wi, wo, |h| self.density.sample_density(h))
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
            assert!(grooves.value(wi, wo).x > 0.0);
            assert_eq!(grooves.value(wi, wo), grooves.value(wo, wi), "{wi}, {wo}");
        }
    }
}
