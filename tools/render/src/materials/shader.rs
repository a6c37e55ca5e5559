//! Materials defined by functions of a point, and materials in other units.

use asperity_shading::{
    Brdf, Dielectric, EnergyPreservingOrenNayar, Frame, SurfacePoint,
    bump::Facet,
    material::Material,
    reflectance::{Bsdf, Coat, Lobe},
};
use glam::Vec3;

/// A material whose BSDF is a function of a point and the direction to the viewer.
pub struct Shaded<F: Fn(&SurfacePoint, Vec3) -> Bsdf<'static>>(pub F);

impl<F: Fn(&SurfacePoint, Vec3) -> Bsdf<'static>> Material for Shaded<F> {
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        (self.0)(point, wo)
    }
}

/// Spatially constant reflectances that are added.
pub struct Layers(pub Vec<Box<dyn Brdf + Sync>>);

impl Material for Layers {
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        Bsdf::new(point.frame(), wo)
            .with([Facet::FLAT], self.0.iter().map(|brdf| Lobe::from(brdf.as_ref() as &dyn Brdf)))
    }
}

/// Returns a matte BSDF about a bump normal in the frame, with additional emission.
pub fn chalk(frame: Frame, wo: Vec3, normal: Vec3, color: Vec3, sent: Vec3) -> Bsdf<'static> {
    let diffuse = EnergyPreservingOrenNayar::new_clamped(color, 0.0);
    Bsdf::new(frame, wo).with([Facet::new(1.0, normal)], [diffuse.into()]).with_emitted(sent)
}

/// A material defined in meters, in a scene whose unit is this many meters.
pub struct InMetres<M>(pub M, pub f32);

impl<M: Material> Material for InMetres<M> {
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        self.0.bsdf(&point.scaled(self.1), wo)
    }

    fn height(&self, point: &SurfacePoint) -> f32 {
        self.0.height(&point.scaled(self.1)) / self.1
    }

    fn height_range(&self) -> Option<[f32; 2]> {
        self.0.height_range().map(|range| range.map(|height| height / self.1))
    }
}

/// Returns a matte color under a glaze of this roughness.
pub fn glazed(roughness: f32, color: Vec3) -> impl Material + Sync {
    let glaze = Coat::clearcoat(Dielectric::new_clamped(1.5)).rough(roughness);
    Shaded(move |point: &SurfacePoint, wo| {
        chalk(point.frame(), wo, Vec3::Z, color, Vec3::ZERO).with_coat(glaze)
    })
}
