//! Triplanar mapping for surfaces without texture coordinates.

use asperity_shading::{SurfacePoint, material::Material, reflectance::Bsdf};
use glam::{Vec2, Vec3};

use crate::sampling::sampler::of_position;

/// A material with texture coordinates, taken from the plane that the surface faces.
///
/// Each point uses one of the three planes, selected by a hash of its position with probability
///
/// ```text
/// |n_k|⁸ / Σ |n_k|⁸
/// ```
///
/// so that the samples of a pixel blend the planes. The texture's up direction is up in two of the
/// three planes.
pub struct Projected<M>(pub M);

impl<M> Projected<M> {
    /// Returns the point with the texture coordinates of its plane.
    fn placed(point: &SurfacePoint) -> SurfacePoint {
        let shares = point.normal.abs().powf(8.0);
        let u = of_position(point.position) * shares.element_sum();
        let axis = if u < shares.x { 0 } else { 1 + usize::from(u >= shares.x + shares.y) };
        let [across, up] = [[Vec3::Y, Vec3::Z], [Vec3::X, Vec3::Z], [Vec3::X, Vec3::Y]][axis];
        // Along the surface, over a unit step of the plane.
        let along = |step: Vec3| step - Vec3::AXES[axis] * (point.normal.dot(step) / point.normal[axis]);
        let uv = Vec2::new(point.position.dot(across), point.position.dot(up));
        // Behind the plane, the texture would be mirrored.
        let side = point.normal[axis].signum() * if axis == 1 { -1.0 } else { 1.0 };
        point.with_uv(Vec2::new(side * uv.x, uv.y), [side * along(across), along(up)])
    }
}

impl<M: Material> Material for Projected<M> {
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        self.0.bsdf(&Self::placed(point), wo)
    }

    fn height(&self, point: &SurfacePoint) -> f32 {
        self.0.height(&Self::placed(point))
    }

    fn height_range(&self) -> Option<[f32; 2]> {
        self.0.height_range()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;

    use approx::assert_abs_diff_eq;
    use asperity_shading::Footprint;

    use super::*;

    /// Records the points at which it is evaluated.
    struct Kept(Mutex<Vec<SurfacePoint>>);

    impl Material for Kept {
        fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
            self.0.lock().unwrap().push(*point);
            Bsdf::new(point.frame(), wo)
        }
    }

    #[test]
    fn planes_have_their_probability_and_follow_the_surface() {
        for (normal, share) in
            [(Vec3::X, 1.0), (Vec3::NEG_Y, 0.0), (Vec3::Z, 0.0), (Vec3::new(0.8, -0.6, 0.0), 0.909)]
        {
            let kept = Projected(Kept(Mutex::default()));
            for k in 0..2000_u16 {
                let position = Vec3::new(f32::from(k) * 0.37, 1.5, f32::from(k) * -0.11);
                let _ = kept.bsdf(&SurfacePoint::new(position, normal, Footprint::from_width(0.0)), Vec3::Z);
            }
            let points = kept.0.0.into_inner().unwrap();
            for point in &points {
                let [u, v] = point.tangents;
                assert_abs_diff_eq!(Vec2::new(u.dot(normal), v.dot(normal)), Vec2::ZERO, epsilon = 1e-5);
                assert!(u.cross(v).dot(normal) > 0.0, "mirrored on {normal}");
            }
            let along_x = points.iter().filter(|point| point.uv.x.abs() == 1.5).count();
            // 0.8⁸ / (0.8⁸ + 0.6⁸), and three standard errors of 2000 choices.
            assert_abs_diff_eq!(along_x as f64 / 2000.0, share, epsilon = 0.02);
        }
    }
}
