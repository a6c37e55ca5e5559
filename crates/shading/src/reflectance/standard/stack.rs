//! What the two parameterizations of the layers share.

/// A roughness of facets that `f32` resolves well.
pub(super) fn smoothest(alpha: f32) -> f32 {
    alpha.max(1e-3)
}

/// The traits of a material with a field `layers`.
macro_rules! layered_material {
    ($material:ident) => {
        impl $material {
            /// The BSDF of a point of which a part of the bumps is resolved, with its emission.
            ///
            /// The material is copied into it, so every point may have another material, for example
            /// of textures. [`ResolvedBumps::FAR`] gives a BSDF without bumps. Directions are in world
            /// space.
            ///
            /// [`ResolvedBumps::FAR`]: crate::level_of_detail::ResolvedBumps::FAR
            #[must_use]
            pub fn bsdf_at(
                &self,
                frame: asperity_ndf_sampling::Frame,
                wo: glam::Vec3,
                bumps: crate::level_of_detail::ResolvedBumps,
            ) -> crate::reflectance::bsdf::Bsdf<'static> {
                crate::reflectance::bsdf::Bsdf::of_layers(frame, wo, self.layers, bumps)
            }
        }

        impl crate::reflectance::brdf::Brdf for $material {
            fn eval(&self, wo: glam::Vec3, wi: glam::Vec3) -> glam::Vec3 {
                self.layers.eval(wo, wi)
            }

            fn sample(
                &self,
                wo: glam::Vec3,
                uc: f32,
                u: glam::Vec2,
            ) -> Option<crate::reflectance::brdf::BsdfSample> {
                self.layers.sample(wo, uc, u)
            }

            fn pdf(&self, wo: glam::Vec3, wi: glam::Vec3) -> f32 {
                self.layers.pdf(wo, wi)
            }

            fn transmits(&self) -> bool {
                self.layers.transmits()
            }
        }

        impl crate::reflectance::facet_brdf::FacetBrdf for $material {
            fn eval_resolved(
                &self,
                wo: glam::Vec3,
                wi: glam::Vec3,
                bumps: crate::level_of_detail::ResolvedBumps,
            ) -> glam::Vec3 {
                self.layers.eval_resolved(wo, wi, bumps)
            }

            fn sample_resolved(
                &self,
                wo: glam::Vec3,
                uc: f32,
                u: glam::Vec2,
                bumps: crate::level_of_detail::ResolvedBumps,
            ) -> Option<crate::reflectance::brdf::BsdfSample> {
                self.layers.sample_resolved(wo, uc, u, bumps)
            }

            fn pdf_resolved(
                &self,
                wo: glam::Vec3,
                wi: glam::Vec3,
                bumps: crate::level_of_detail::ResolvedBumps,
            ) -> f32 {
                self.layers.pdf_resolved(wo, wi, bumps)
            }

            fn emitted(&self, wo: glam::Vec3) -> glam::Vec3 {
                self.layers.emitted(wo)
            }
        }
    };
}

pub(super) use layered_material;
