//! A rough diffuse surface with gloss, for carpets and plastic panels.

use asperity_ndf_sampling::{Beckmann, Frame};
use glam::Vec3;

use crate::bump::slope_facets::facets_along;
use crate::math::sqrt;
use crate::reflectance::{Bsdf, CookTorrance, EnergyPreservingOrenNayar};

/// A rough diffuse surface with gloss, as seen by a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct GlossySurface {
    /// The diffuse color, in [0, 1]³.
    pub diffuse: Vec3,
    /// The specular color, in [0, 1]³.
    pub specular: Vec3,
    /// The unit normal with bumps.
    pub normal: Vec3,
    /// The slope variance along each axis that the footprint removed from the bumps.
    pub slope_variance: f32,
    /// The standard deviation of the slope that it removed from ridges, across the ridges; zero
    /// without ridges.
    pub ridges: Vec3,
}

impl GlossySurface {
    /// Adds a layer of facets of this roughness under a gloss of the width α to a BSDF.
    ///
    /// The BSDF is in the frame of the surface without bumps.
    pub(crate) fn add_to(&self, bsdf: &mut Bsdf<'_>, frame: &Frame, roughness: f32, alpha: f32) {
        // Specular light reduces the diffuse light.
        let diffuse = self.diffuse.min(Vec3::ONE - self.specular);
        let base = EnergyPreservingOrenNayar::new_clamped(diffuse, roughness);
        let gloss = CookTorrance::new(Beckmann::new_clamped(alpha, alpha), self.specular);
        let (across, normal) = (frame.to_local(self.ridges), frame.to_local(self.normal));
        let ridge = across.dot(across);
        let axes = if ridge > 0.0 {
            let deviations = [ridge, 0.0].map(|more| sqrt(self.slope_variance.max(0.0) + more));
            let across = across / sqrt(ridge);
            [across * deviations[0], Vec3::Z.cross(across) * deviations[1]]
        } else {
            [Vec3::X, Vec3::Y].map(|axis| axis * sqrt(self.slope_variance.max(0.0)))
        };
        let facets = facets_along(Vec3::Z, normal, axes, 0.5);
        bsdf.add_layer(facets, [base.into(), gloss.into()]);
    }
}
