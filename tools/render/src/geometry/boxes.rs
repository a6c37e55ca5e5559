//! A bounding volume hierarchy over triangles.

use std::time::Duration;

use glam::{Vec3, Vec3A};
use obvhs::{
    Boundable, BvhBuildParams,
    aabb::Aabb,
    cwbvh::{CwBvh, builder::build_cwbvh},
    ray::{Ray, RayHit},
};

/// Maximum number of triangles in a leaf.
const MOST: u32 = 2;

/// A tree of bounding boxes.
pub(super) struct Boxes(Option<CwBvh>);

/// A ray prepared for box tests.
#[derive(Clone, Copy)]
pub(super) struct Line(Ray);

impl Line {
    pub(super) fn new(origin: Vec3, direction: Vec3) -> Self {
        // Finite, so that a ray in the side of a box does not compute 0 · ∞. The reciprocal of −0
        // is positive, as the traversal expects.
        let finite = |d: f32| if d < 0.0 { -1e30 } else { 1e30 };
        let inverse = direction.map(|d| if d.abs() < 1e-30 { finite(d) } else { 1.0 / d });
        Self(Ray {
            origin: origin.into(),
            direction: direction.into(),
            inv_direction: inverse.into(),
            tmin: 0.0,
            tmax: f32::INFINITY,
        })
    }

    pub(super) fn direction(&self) -> Vec3 {
        self.0.direction.into()
    }
}

impl Boxes {
    pub(super) fn new(triangles: &[[Vec3; 3]]) -> Self {
        let padded: Vec<Padded> = triangles.iter().map(|t| Padded(t.map(Vec3A::from))).collect();
        let config = BvhBuildParams { max_prims_per_leaf: MOST, ..BvhBuildParams::medium_build() };
        // Empty: a tree without triangles would have no root.
        if padded.is_empty() {
            return Self(None);
        }
        Self(Some(build_cwbvh(&padded, config, &mut Duration::default())))
    }

    /// Returns the triangles in leaf order.
    pub(super) fn order(&self) -> &[u32] {
        self.0.as_ref().map_or(&[], |tree| &tree.primitive_indices)
    }

    /// Returns the nearest intersection before `farthest`, from the distances of triangles in leaf
    /// order.
    pub(super) fn nearest(
        &self,
        line: &Line,
        farthest: f32,
        distance: impl Fn(usize) -> f32,
    ) -> Option<(f32, u32)> {
        let mut hit = RayHit::none();
        self.0
            .as_ref()?
            .ray_traverse(Ray { tmax: farthest, ..line.0 }, &mut hit, |_, triangle| distance(triangle));
        (hit.primitive_id != u32::MAX).then_some((hit.t, hit.primitive_id))
    }

    /// Whether any triangle is hit.
    pub(super) fn meets_any(&self, line: &Line, distance: impl Fn(usize) -> f32) -> bool {
        self.0.as_ref().is_some_and(|tree| !tree.ray_traverse_miss(line.0, |_, triangle| distance(triangle)))
    }
}

/// A triangle whose box is enlarged by 2⁻¹⁸ of its distance from the origin. The box test rounds,
/// and without the margin a ray along a face of a box could miss the triangle inside.
struct Padded([Vec3A; 3]);

impl Boundable for Padded {
    fn aabb(&self) -> Aabb {
        let exact = Aabb::from_points(&self.0);
        let pad = (exact.min.abs().max(exact.max.abs())).max_element() / 262_144.0;
        Aabb { min: exact.min - Vec3A::splat(pad), max: exact.max + Vec3A::splat(pad) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearest_of_many_boxes_in_line() {
        // Sheets perpendicular to a ray along x, numbered in another order than their positions.
        let sheets = 5000_u32;
        let place = |k: u32| 1.0 + (k * 1777 % sheets) as f32;
        let triangles: Vec<_> = (0..sheets)
            .map(|k| [[-1.0, -1.0], [1.0, -1.0], [0.0, 1.0]].map(|[y, z]| Vec3::new(place(k), y, z)))
            .collect();
        let boxes = Boxes::new(&triangles);
        let distance = |k: usize| place(boxes.order()[k]);
        for direction in [Vec3::X, Vec3::new(1.0, -0.0, 1e-7)] {
            let line = Line::new(Vec3::ZERO, direction);
            // The last sheet becomes the nearest once all others are excluded.
            for least in [1.0, 17.0, 4999.0, 5000.0] {
                let beyond = |k: usize| if distance(k) < least { f32::INFINITY } else { distance(k) };
                assert_eq!(boxes.nearest(&line, f32::INFINITY, beyond).unwrap().0, least);
                assert!(boxes.meets_any(&line, beyond));
            }
            assert_eq!(boxes.nearest(&line, 1.0, distance), None);
        }
        assert_eq!(boxes.nearest(&Line::new(Vec3::ZERO, Vec3::NEG_X), f32::INFINITY, distance), None);
        assert!(!Boxes::new(&[]).meets_any(&Line::new(Vec3::ZERO, Vec3::X), distance));
    }
}
