//! Scenes: triangles about a focus, and a camera that zooms in.

use asperity_render::geometry::{mesh::TracedMesh, teapot::teapot};
use glam::{DVec2, DVec3, Vec3};

/// A triangle corner, positioned relative to the focus.
#[derive(Clone, Copy)]
pub(crate) struct Corner {
    pub(crate) position: DVec3,
    pub(crate) normal: DVec3,
    pub(crate) tangent: DVec3,
    /// Texture coordinates with period 1.
    pub(crate) uv: DVec2,
}

/// A pinhole camera and a light, relative to the focus.
pub(crate) struct View {
    pub(crate) eye: DVec3,
    /// Half the image's width and height at distance 1, along its sides.
    pub(crate) right: DVec3,
    pub(crate) up: DVec3,
    pub(crate) forward: DVec3,
    /// Angle of a center pixel in radians.
    pub(crate) pixel_angle: f64,
    /// The direction to the light.
    pub(crate) light: DVec3,
}

/// Triangles, a camera, and the world position of the origin.
pub(crate) struct Scene {
    pub(crate) triangles: Vec<[Corner; 3]>,
    pub(crate) view: View,
    /// The camera's target, in world coordinates.
    pub(crate) focus: DVec3,
}

impl View {
    fn new(eye: DVec3, forward: DVec3, field: f64, size: u32, light: DVec3) -> Self {
        let forward = forward.normalize();
        let right = forward.cross(DVec3::Z).normalize();
        let half = (0.5 * field).tan();
        let pixel_angle = 2.0 * half / f64::from(size);
        let up = right.cross(forward) * half;
        Self { eye, right: right * half, up, forward, pixel_angle, light: light.normalize() }
    }

    /// Projects a point: coordinates across, up and along the axis, the first two in half image
    /// sizes.
    pub(crate) fn project(&self, p: DVec3) -> DVec3 {
        let v = p - self.eye;
        DVec3::new(
            v.dot(self.right) / self.right.length_squared(),
            v.dot(self.up) / self.up.length_squared(),
            v.dot(self.forward),
        )
    }
}

/// Returns the teapot, zoomed into the point of its body at the image center.
pub(crate) fn teapot_scene(zoom: f64, size: u32) -> Result<Scene, String> {
    let mesh = teapot();
    let (eye, target) = (DVec3::new(4.4, -9.8, 4.8), DVec3::new(0.25, 0.0, 1.35));
    let hit = TracedMesh::new(teapot()).intersect(eye.as_vec3(), (target - eye).as_vec3().normalize());
    let focus = hit.ok_or("the teapot is not in the middle of its picture")?.position.as_dvec3();
    let triangles = mesh.triangles.iter().map(|corners| {
        corners.map(|i| {
            let vertex = mesh.vertices[i as usize];
            let [position, normal, tangent] =
                [vertex.position, vertex.normal, vertex.tangent].map(Vec3::as_dvec3);
            Corner { position: position - focus, normal, tangent, uv: vertex.uv.as_dvec2() }
        })
    });
    let from = (eye - focus) / zoom;
    let view = View::new(from, -from, 0.62, size, DVec3::new(0.0, -0.8, 0.75));
    Ok(Scene { triangles: triangles.collect(), view, focus })
}

/// Periods of the plane's texture per unit: 8 cells of its first octave are one period.
const PER_UNIT: f64 = 0.375;

/// Returns a plane up to the horizon, viewed from a height divided by the zoom.
///
/// Its lines are at doubling distances. Otherwise a triangle's corners would be too far from the
/// camera for `f32` precision.
pub(crate) fn plane_scene(zoom: f64, size: u32) -> Scene {
    const FARTHEST: f64 = 1e4;
    let focus = DVec3::new(0.3, 0.7, 0.0);
    let half: Vec<f64> =
        std::iter::successors(Some(0.25 / zoom), |x| Some(2.0 * x)).take_while(|&x| x < FARTHEST).collect();
    let lines: Vec<f64> = half.iter().rev().map(|x| -x).chain([0.0]).chain(half.iter().copied()).collect();
    let corner = |x: f64, y: f64| {
        let (position, uv) = (DVec3::new(x, y, 0.0), DVec2::new(x, y) * PER_UNIT);
        Corner { position, normal: DVec3::Z, tangent: DVec3::X, uv }
    };
    let triangles = lines.windows(2).flat_map(|xs| {
        lines.windows(2).flat_map(move |ys| {
            let [a, b] = [corner(xs[0], ys[0]), corner(xs[1], ys[0])];
            let [c, d] = [corner(xs[0], ys[1]), corner(xs[1], ys[1])];
            [[a, b, d], [a, d, c]]
        })
    });
    let down = DVec3::new(0.0, 0.93, -0.36).normalize();
    let eye = -down * (1.0 / zoom);
    let view = View::new(eye, down, 0.9, size, DVec3::new(0.1, 0.9, 0.35));
    Scene { triangles: triangles.collect(), view, focus }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn teapot_is_inside_its_image() {
        let scene = teapot_scene(1.0, 256).unwrap();
        for corner in scene.triangles.iter().flatten() {
            let p = scene.view.project(corner.position);
            assert!(p.z > 0.0 && p.x.abs().max(p.y.abs()) < 0.97 * p.z, "{p}");
        }
    }
}
