//! Rasterization in `f64`: the visible triangle of a pixel.

use glam::{DMat3, DVec2, DVec3};

use crate::picture::scene::{Corner, Scene};

/// The visible triangle of a pixel and the weights of its corners.
#[derive(Clone, Copy)]
pub(crate) struct Seen {
    pub(crate) triangle: usize,
    weights: DVec3,
    depth: f64,
}

impl Seen {
    /// Returns the surface point, with unnormalized normal and tangent.
    pub(crate) fn corner(&self, scene: &Scene) -> Corner {
        let corners = &scene.triangles[self.triangle];
        let sum = |of: fn(&Corner) -> DVec3| {
            corners.iter().zip(self.weights.to_array()).map(|(corner, w)| w * of(corner)).sum()
        };
        let uv = corners.iter().zip(self.weights.to_array()).map(|(corner, w)| w * corner.uv).sum();
        Corner { position: sum(|c| c.position), normal: sum(|c| c.normal), tangent: sum(|c| c.tangent), uv }
    }
}

/// Returns the center of a pixel, with the image sides at ±1 and y up.
pub(crate) fn middle(x: u32, y: u32, size: u32) -> DVec2 {
    let at = |i: u32| (f64::from(i) + 0.5) / f64::from(size) * 2.0 - 1.0;
    DVec2::new(at(x), -at(y))
}

/// Returns the triangles visible at pixel centers, row by row.
///
/// Edge functions are rows of the inverse of the corners' homogeneous coordinates, so nothing is
/// clipped: Olano, Greer 1997.
pub(crate) fn seen(scene: &Scene, size: u32) -> Vec<Option<Seen>> {
    let mut pixels: Vec<Option<Seen>> = vec![None; (size * size) as usize];
    for (triangle, corners) in scene.triangles.iter().enumerate() {
        let corners = corners.map(|corner| scene.view.project(corner.position));
        let matrix = DMat3::from_cols(corners[0], corners[1], corners[2]);
        let inverse = matrix.inverse();
        if !inverse.is_finite() {
            continue;
        }
        let [columns, rows] = [0, 1].map(|axis| {
            if corners.iter().any(|corner| corner.z <= 0.0) {
                return 0..size;
            }
            let sign = if axis == 0 { 1.0 } else { -1.0 };
            let places = corners.map(|corner| (sign * corner[axis] / corner.z + 1.0) * 0.5 * f64::from(size));
            let least = places.into_iter().fold(f64::INFINITY, f64::min).floor().max(0.0);
            let most = places.into_iter().fold(0.0, f64::max).ceil().min(f64::from(size));
            least as u32..most as u32
        });
        for y in rows {
            for x in columns.clone() {
                let edges = inverse * middle(x, y, size).extend(1.0);
                let per_depth = edges.element_sum();
                let pixel = &mut pixels[(y * size + x) as usize];
                let depth = 1.0 / per_depth;
                if edges.min_element() >= 0.0
                    && per_depth > 0.0
                    && pixel.is_none_or(|seen| depth < seen.depth)
                {
                    *pixel = Some(Seen { triangle, weights: edges * depth, depth });
                }
            }
        }
    }
    pixels
}
