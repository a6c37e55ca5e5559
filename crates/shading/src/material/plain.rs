//! BRDFs as spatially constant materials.

use asperity_ndf_sampling::{Microfacet, Ndf};
use glam::Vec3;

use crate::bump::Facet;
use crate::level_of_detail::ResolvedBumps;
use crate::material::interface::Material;
use crate::material::surface_point::SurfacePoint;
use crate::reflectance::{
    BlinnPhongBrdf, Brdf, Bsdf, Coat, CookTorrance, EnergyPreservingOrenNayar, Fresnel, Lambert, OpenPbr,
    OrenNayar, Phong, StandardMaterial, TorranceSparrow, WardBrdf,
};

macro_rules! alike_everywhere {
    ($($({$($bounds:tt)*})? $reflectance:ty),*) => {
        $(
            impl $(<$($bounds)*>)? Material for $reflectance {
                fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
                    Bsdf::new(point.frame(), wo).with([Facet::FLAT], [(self as &dyn Brdf).into()])
                }
            }
        )*
    };
}

alike_everywhere! {
    Lambert, OrenNayar, EnergyPreservingOrenNayar, Phong, BlinnPhongBrdf, WardBrdf,
    {D: Microfacet, F: Fresnel} CookTorrance<D, F>, {D: Ndf, F: Fresnel} TorranceSparrow<D, F>
}

/// A polished metal, a pane or a body without other layers.
impl Material for Coat {
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        Bsdf::new(point.frame(), wo).with_coat(*self)
    }
}

macro_rules! layered {
    ($($material:ident)*) => {
        $(
            impl Material for $material {
                fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
                    self.bsdf_at(point.frame(), wo, ResolvedBumps::FAR)
                }
            }
        )*
    };
}

layered! { StandardMaterial OpenPbr }
