//! The `Material` trait: BSDFs that vary over a surface.

use crate::material::surface_point::SurfacePoint;
use crate::reflectance::Bsdf;
use glam::Vec3;

/// A material: returns the [`Bsdf`] of every surface point, filtered by the pixel.
///
/// The input is the position, the texture coordinates with the derivatives of the position, the
/// normal without bumps, and the width of the pixel on the surface. Unresolved detail is part of
/// the BSDF as facets and roughness. Bumps under `LevelOfDetail::Exact` keep the mean radiance of a
/// surface at every zoom, other materials approximately. For an elongated pixel average several
/// points, see [`PixelEllipse::taps`](crate::pixel::PixelEllipse::taps).
///
/// Positions, normals and the directions of a BSDF are in one space, the world of the renderer.
/// Materials whose patterns follow an object get positions in the space of the object, with normal
/// and directions in that space too.
///
/// # Light
///
/// - A point or directional light in the direction `wi` adds [`eval_cos`](Bsdf::eval_cos) times its
///   irradiance.
/// - A path continues at [`sample`](Bsdf::sample), with its weight as a factor. Smooth coats, panes
///   and metals reflect and transmit in single directions, which are specular samples.
/// - An environment adds [`reflected_radiance`](crate::reflected_radiance).
/// - [`emitted`](Bsdf::emitted) is added regardless of the light.
///
/// The trait is dyn-compatible. Every `Brdf` of the crate is also a spatially constant `Material`.
///
/// ```
/// use asperity_shading::glam::{Vec2, Vec3};
/// use asperity_shading::material::Material;
/// use asperity_shading::{Carpet, CarpetParameters, Footprint, SurfacePoint};
///
/// let carpet = Carpet::new(CarpetParameters::default())?;
/// let point = SurfacePoint::new(Vec3::new(0.3, 0.2, 0.0), Vec3::Z, Footprint::from_width(1e-4))
///     .with_uv(Vec2::new(0.3, 0.2), [Vec3::X, Vec3::Y]);
/// let wo = Vec3::new(0.6, 0.0, 0.8);
/// let bsdf = carpet.bsdf(&point, wo);
/// let sample = bsdf.sample(wo, 0.5, Vec2::new(0.3, 0.7)).ok_or("no light")?;
/// assert!(sample.pdf > 0.0 && sample.weight().min_element() > 0.0);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
pub trait Material {
    /// The BSDF of a point seen from `wo`, the unit direction to the eye in world space.
    ///
    /// Accepts every input.
    #[must_use]
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_>;

    /// The height above the surface without bumps, as seen by the pixel; accepts every input.
    ///
    /// The facets of the BSDF have its slopes. Its unit is that of the positions if texture
    /// coordinates are in that unit too. 0 for a material without [heights](Self::height_range).
    #[must_use]
    fn height(&self, _point: &SurfacePoint) -> f32 {
        0.0
    }

    /// Bounds of all heights; `None` for a flat material, or if its normals are not those of a
    /// height.
    #[must_use]
    fn height_range(&self) -> Option<[f32; 2]> {
        None
    }
}

impl<M: Material + ?Sized> Material for &M {
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        (**self).bsdf(point, wo)
    }

    fn height(&self, point: &SurfacePoint) -> f32 {
        (**self).height(point)
    }

    fn height_range(&self) -> Option<[f32; 2]> {
        (**self).height_range()
    }
}

#[cfg(feature = "alloc")]
impl<M: Material + ?Sized> Material for alloc::boxed::Box<M> {
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        (**self).bsdf(point, wo)
    }

    fn height(&self, point: &SurfacePoint) -> f32 {
        (**self).height(point)
    }

    fn height_range(&self) -> Option<[f32; 2]> {
        (**self).height_range()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bump::Facet;
    use crate::pixel::Footprint;
    use crate::reflectance::EnergyPreservingOrenNayar;

    /// A slope along x, the brighter the higher.
    struct Ramp;

    impl Material for Ramp {
        fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
            let lobe = EnergyPreservingOrenNayar::new_clamped(Vec3::splat(point.position.x), 0.5);
            Bsdf::new(point.frame(), wo).with([Facet::FLAT], [lobe.into()])
        }

        fn height(&self, point: &SurfacePoint) -> f32 {
            0.25 * point.position.x
        }

        fn height_range(&self) -> Option<[f32; 2]> {
            Some([0.0, 0.25])
        }
    }

    #[test]
    fn references_and_boxes_forward_every_method() {
        fn seen(
            material: impl Material,
            point: &SurfacePoint,
            wi: Vec3,
            wo: Vec3,
        ) -> (Vec3, f32, Option<[f32; 2]>) {
            let scattered = material.bsdf(point, wo).eval_cos(wo, wi);
            (scattered, material.height(point), material.height_range())
        }
        let (wo, wi) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.0, -0.6, 0.8));
        let point = SurfacePoint::new(Vec3::new(0.5, 0.0, 0.0), Vec3::Z, Footprint::from_width(0.0));
        let expected = Ramp.bsdf(&point, wo).eval_cos(wo, wi);
        assert!(expected.min_element() > 0.0);
        let of = (expected, 0.125, Some([0.0, 0.25]));
        assert_eq!(seen(&Ramp, &point, wi, wo), of);
        assert_eq!(seen(&Ramp as &dyn Material, &point, wi, wo), of);
        #[cfg(feature = "alloc")]
        assert_eq!(seen(alloc::boxed::Box::new(Ramp) as alloc::boxed::Box<dyn Material>, &point, wi, wo), of);
    }
}
