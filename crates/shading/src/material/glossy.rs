//! A rough diffuse surface with gloss: what carpets and plastic panels are to a pixel.

use asperity_ndf_sampling::{Beckmann, Frame};
use glam::Vec3;

use crate::bump::slope_facets;
use crate::reflectance::{Bsdf, CookTorrance, EnergyPreservingOrenNayar};

/// A rough diffuse surface with gloss, as a pixel sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct GlossySurface {
    /// The diffuse colour, in [0, 1]³.
    pub diffuse: Vec3,
    /// The specular colour, in [0, 1]³.
    pub specular: Vec3,
    /// The unit normal with bumps.
    pub normal: Vec3,
    /// The variance of the slope along each axis that the footprint took from the bumps.
    pub slope_variance: f32,
}

impl GlossySurface {
    /// Layer of facets of this roughness under a gloss of the width α, from `wo` in the frame of the surface without bumps.
    pub(crate) fn bsdf<'a>(&self, frame: &Frame, wo: Vec3, roughness: f32, alpha: f32) -> Bsdf<'a> {
        // What shines is at the cost of what is scattered.
        let diffuse = self.diffuse.min(Vec3::ONE - self.specular);
        let base = EnergyPreservingOrenNayar::clamped(diffuse, roughness);
        let gloss = CookTorrance::new(Beckmann::clamped(alpha, alpha), self.specular);
        let facets = slope_facets(Vec3::Z, frame.to_local(self.normal), self.slope_variance);
        Bsdf::new(wo).with(facets, [base.into(), gloss.into()])
    }
}
