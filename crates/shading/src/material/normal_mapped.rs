//! Authored normal maps as a material.

use asperity_ndf_sampling::Beckmann;
use glam::{Vec2, Vec3};

use crate::bump::Facet;
use crate::level_of_detail::ResolvedBumps;
use crate::material::interface::Material;
use crate::material::surface_point::SurfacePoint;
use crate::normal_map::{SlopeLobes, SlopePyramid};
use crate::reflectance::{Bsdf, Lobe};

/// A glossy surface with an authored normal map, with the slopes within a pixel in up to 16 groups.
///
/// ```text
/// f_r = color · p(h) min(1, h_z/(ωo·h))/(4 max(cos θ_i, cos θ_o)),   p(h) of SlopeLobes::density
/// ```
///
/// The map is aligned with the tangents of the surface: texture coordinates of the points are those
/// of the map.
///
/// The example needs the feature `alloc`.
///
#[cfg_attr(feature = "alloc", doc = "```")]
#[cfg_attr(not(feature = "alloc"), doc = "```ignore")]
/// use asperity_shading::glam::{Vec2, Vec3};
/// use asperity_shading::material::NormalMapped;
/// use asperity_shading::{Beckmann, Footprint, Material, SlopePyramid, SurfacePoint};
///
/// // Ridges of two flanks, each 32 texels wide.
/// let side = |k: usize| if k % 64 < 32 { 0.6 } else { -0.6 };
/// let ridges: Vec<Vec3> = (0..64 * 8).map(|k| Vec3::new(side(k), 0.0, 0.8)).collect();
/// let map = SlopePyramid::<4>::from_normals(64, 8, &ridges)?;
/// let stone = NormalMapped { map: map.view(), roughness: Beckmann::isotropic(0.2)?, color: Vec3::ONE };
/// let seen = |width: f32, wi: Vec3| {
///     let point = SurfacePoint::new(Vec3::ZERO, Vec3::Z, Footprint::from_width(width)).with_uv(Vec2::splat(0.3), [Vec3::X, Vec3::Y]);
///     stone.bsdf(&point, Vec3::Z).eval_cos(Vec3::Z, wi).x
/// };
/// // From afar they shine to both sides and not straight up, where their mean normal points.
/// let (left, right) = (Vec3::new(-0.96, 0.0, 0.28), Vec3::new(0.96, 0.0, 0.28));
/// assert!(seen(10.0, left) > 5.0 * seen(10.0, Vec3::Z) && seen(10.0, right) > 5.0 * seen(10.0, Vec3::Z));
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalMapped<'a, const K: usize> {
    /// The slopes of the map at every zoom.
    pub map: SlopePyramid<K, &'a [Vec2], &'a [SlopeLobes<K>]>,
    /// The NDF of the surface between the slopes of the map.
    pub roughness: Beckmann,
    /// The reflectance of the facets; non-positive components are read as 0.
    pub color: Vec3,
}

impl<const K: usize> Material for NormalMapped<'_, K> {
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        let seen = self.map.sample_along(point.uv, &point.uv_pixel(), 8);
        let lobes = seen.lobes().iter().filter(|lobe| lobe.weight > 0.0).map(|lobe| {
            let slopes = lobe.moments.add_detail(self.roughness, ResolvedBumps::FAR);
            Lobe::from(slopes).weighted(self.color * lobe.weight)
        });
        Bsdf::new(point.frame(), wo).with([Facet::FLAT], lobes)
    }
}
