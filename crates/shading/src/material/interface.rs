//! Materials: BSDFs that differ from point to point.

use crate::material::surface_point::SurfacePoint;
use crate::reflectance::Bsdf;
use glam::Vec3;

/// A material: the [`Bsdf`] of every point of a surface, as a pixel sees it.
///
/// It needs of a point its position and texture coordinates with the derivatives of the position by these, the normal without bumps, and
/// the width of the pixel on the surface. What the pixel does not resolve of the material is in the BSDF, as facets and roughness, so
/// that the mean radiance of a surface is the same at every zoom. A pixel that is longer than wide is the mean of several points,
/// [`PixelEllipse::taps`](crate::pixel::PixelEllipse::taps).
///
/// `wo` is the unit direction to the eye in the frame of the surface, [`SurfacePoint::frame`], as are all directions of the BSDF.
///
/// # Light
///
/// - A lamp of no extent in the direction `wi` adds `bsdf.scattered(wi, wo)` times its irradiance, which is `value · cos θ_i`.
/// - Light from all around is `value cos θ_i radiance/density` at a direction by `sample`, or
///   [`reflected_radiance`](crate::environment::reflected_radiance), which weighs samples of both.
/// - Smooth coats, panes and metals send light from single directions, which neither `value` nor `sample` know: a path tracer adds
///   `weight · radiance` of both [`deltas`](Bsdf::deltas), or of one by chance; below the surface they are transmitted.
/// - [`emitted`](Bsdf::emitted) is added whatever the light.
///
/// The trait is dyn-compatible. Reflectances are materials that are alike everywhere.
///
/// ```
/// use asperity_shading::glam::{Vec2, Vec3};
/// use asperity_shading::material::Material;
/// use asperity_shading::{Brdf, Carpet, CarpetParameters, Footprint, SurfacePoint};
///
/// let carpet = Carpet::new(CarpetParameters::default())?;
/// let point = SurfacePoint::new(Vec3::new(0.3, 0.2, 0.0), Vec3::Z, Footprint::from_width(1e-4))
///     .with_uv(Vec2::new(0.3, 0.2), [Vec3::X, Vec3::Y]);
/// let frame = point.frame();
/// let wo = frame.to_local(Vec3::new(0.6, 0.0, 0.8));
/// let bsdf = carpet.bsdf(&point, wo);
/// let wi = bsdf.sample(wo, Vec2::new(0.3, 0.7));
/// assert!(bsdf.density(wi, wo) > 0.0 && bsdf.value(wi, wo).min_element() > 0.0);
/// # Ok::<(), asperity_shading::ParameterError>(())
/// ```
pub trait Material {
    /// BSDF of a point that is seen from the unit direction `wo`, in the frame of the surface; total.
    #[must_use]
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_>;

    /// The height above the surface without bumps, as the pixel sees it; total.
    ///
    /// The facets of the BSDF have its slopes. It is in the unit of positions, where texture coordinates are in that unit too; 0 of a
    /// material without [heights](Self::height_range).
    #[must_use]
    fn height(&self, _point: &SurfacePoint) -> f32 {
        0.0
    }

    /// Bounds of all heights; none of a material that is flat, or whose normals are those of no height.
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
            let lobe = EnergyPreservingOrenNayar::clamped(Vec3::splat(point.position.x), 0.5);
            Bsdf::new(wo).with([Facet::FLAT], [lobe.into()])
        }

        fn height(&self, point: &SurfacePoint) -> f32 {
            0.25 * point.position.x
        }

        fn height_range(&self) -> Option<[f32; 2]> {
            Some([0.0, 0.25])
        }
    }

    #[test]
    fn references_and_boxes_are_the_material_with_its_heights() {
        fn seen(
            material: impl Material,
            point: &SurfacePoint,
            wi: Vec3,
            wo: Vec3,
        ) -> (Vec3, f32, Option<[f32; 2]>) {
            let scattered = material.bsdf(point, wo).scattered(wi, wo);
            (scattered, material.height(point), material.height_range())
        }
        let (wo, wi) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.0, -0.6, 0.8));
        let point = SurfacePoint::new(Vec3::new(0.5, 0.0, 0.0), Vec3::Z, Footprint::from_width(0.0));
        let expected = Ramp.bsdf(&point, wo).scattered(wi, wo);
        assert!(expected.min_element() > 0.0);
        let of = (expected, 0.125, Some([0.0, 0.25]));
        assert_eq!(seen(&Ramp, &point, wi, wo), of);
        assert_eq!(seen(&Ramp as &dyn Material, &point, wi, wo), of);
        #[cfg(feature = "alloc")]
        assert_eq!(seen(alloc::boxed::Box::new(Ramp) as alloc::boxed::Box<dyn Material>, &point, wi, wo), of);
    }
}
