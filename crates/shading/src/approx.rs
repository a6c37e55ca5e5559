//! The traits of `approx` for surfaces, pixels and light.

use glam::Vec3;

use crate::bump::{Displaced, Facet};
use crate::environment::LightSample;
use crate::level_of_detail::ResolvedBumps;
use crate::material::{Fiber, GlintFlake, Seam, SurfacePoint};
use crate::normal_map::{SlopeLobe, SlopeMoments};
use crate::pixel::{Footprint, PixelEllipse, Tap};
use crate::texture::{BrickSample, Edge, PerturbedLookUp, Seen};

asperity_core::impl_approx! { f32;
    // Infinite widths have no difference.
    Footprint: v => v.width().min(f32::MAX);
    Tap: v => v.offset, v.footprint;
    PixelEllipse: v => v.axes()[0], v.axes()[1], v.long(), v.short();
    SurfacePoint: v => v.position, v.normal, v.uv, v.tangents[0], v.tangents[1], v.pixel;
    Facet: v => v.weight, v.normal;
    Displaced: v => v.position, v.normal;
    ResolvedBumps: v => v.z, v.variance, v.blend;
    LightSample: v => v.direction, v.radiance;
    SlopeMoments: v => v.mean, Vec3::from(v.covariance);
    SlopeLobe: v => v.weight, v.moments;
    BrickSample: v => v.brick, v.height, v.slope, v.cell[0] as f32, v.cell[1] as f32;
    Edge: v => v.distance, v.away;
    PerturbedLookUp: v => v.uv, v.spread;
    Seen: v => v.light, v.transmittance;
    Seam: v => v.amount, v.slope;
    Fiber: v => v.factor, v.direction, v.slope;
    GlintFlake: v => v.normal, v.center;
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::{abs_diff_eq, relative_eq, ulps_eq};
    use glam::Vec2;

    #[test]
    fn approx_compares_every_field() {
        let pixel = PixelEllipse::from_derivatives(Vec3::new(0.25, 0.0, 0.0), Vec3::new(0.0, 0.5, 0.0));
        let point = SurfacePoint::new(Vec3::ONE, Vec3::Z, pixel).with_uv(Vec2::ONE, [Vec3::X, Vec3::Y]);
        let others = [
            SurfacePoint { position: point.position * 1.25, ..point },
            SurfacePoint { normal: Vec3::X, ..point },
            SurfacePoint { uv: Vec2::X, ..point },
            SurfacePoint { tangents: [Vec3::X, Vec3::Z], ..point },
            SurfacePoint { pixel: pixel.scaled(1.5), ..point },
            SurfacePoint { pixel: Footprint::from_width(0.5).into(), ..point },
        ];
        assert!(abs_diff_eq!(point, point) && relative_eq!(point, point) && ulps_eq!(point, point));
        for other in others {
            assert!(!abs_diff_eq!(point, other, epsilon = 0.1), "{other:?}");
            assert!(!relative_eq!(point, other, max_relative = 0.1), "{other:?}");
            assert!(!ulps_eq!(point, other), "{other:?}");
        }
        let near = SurfacePoint { position: point.position + 1e-6, ..point.scaled(1.000_001) };
        assert!(abs_diff_eq!(point, near, epsilon = 1e-5) && relative_eq!(point, near, max_relative = 1e-5));
        // A footprint that resolves nothing equals itself.
        assert!(abs_diff_eq!(Footprint::from_width(f32::NAN), Footprint::from_width(f32::INFINITY)));
    }
}
