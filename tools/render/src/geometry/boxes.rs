//! Boxes about triangles, four beside one another: which triangles a ray may meet.

use std::time::Duration;

use glam::{BVec4A, Vec3, Vec3A, Vec4};
use obvhs::{
    Boundable, BvhBuildParams,
    aabb::Aabb,
    bvh2::{Bvh2, builder::build_bvh2, node::Bvh2Node},
};

/// Boxes of a node.
const WIDE: usize = 4;

/// Nodes that a search puts aside; a deeper one goes on in a search of its own.
const ASIDE: usize = 16;

/// The most triangles of a leaf.
const MOST: u32 = 2;

/// Boxes with what is in them.
#[derive(Clone, Copy)]
struct Node {
    /// The least and the greatest coordinates of the boxes along each axis.
    bounds: [[Vec4; 3]; 2],
    /// The node in each box, or the first triangle.
    inside: [u32; WIDE],
    /// The number of triangles in each box; 0 of a node.
    count: [u32; WIDE],
}

/// A tree of boxes.
#[derive(Default)]
pub(super) struct Boxes {
    nodes: Vec<Node>,
    /// The triangles in the order of the leaves.
    pub(super) order: Vec<u32>,
}

/// A ray that is prepared for boxes.
#[derive(Clone, Copy)]
pub(super) struct Line {
    origin: Vec3,
    pub(super) direction: Vec3,
    inverse: Vec3,
}

impl Line {
    pub(super) fn new(origin: Vec3, direction: Vec3) -> Self {
        // Finite, so that what lies on the side of a box is no 0 · ∞.
        let inverse = direction.map(|d| if d.abs() < 1e-30 { 1e30_f32.copysign(d) } else { 1.0 / d });
        Self { origin, direction, inverse }
    }
}

impl Boxes {
    pub(super) fn new(triangles: &[[Vec3; 3]]) -> Self {
        let padded: Vec<Padded> = triangles.iter().map(|t| Padded(t.map(Vec3A::from))).collect();
        let config = BvhBuildParams { max_prims_per_leaf: MOST, ..BvhBuildParams::medium_build() };
        let pairs = build_bvh2(&padded, config, &mut Duration::default());
        let mut boxes = Self { nodes: Vec::new(), order: pairs.primitive_indices.clone() };
        if let Some(root) = pairs.nodes.first() {
            boxes.widen(&pairs, vec![*root]);
        }
        boxes
    }

    /// Adds a node of boxes, the largest of which are opened while there is room; returns its name.
    fn widen(&mut self, pairs: &Bvh2, mut children: Vec<Bvh2Node>) -> u32 {
        while children.len() < WIDE {
            let inner = children.iter().enumerate().filter(|(_, child)| !child.is_leaf());
            let largest =
                inner.max_by(|(_, a), (_, b)| a.aabb().half_area().total_cmp(&b.aabb().half_area()));
            let Some((k, opened)) = largest else { break };
            let first = opened.first_index as usize;
            children[k] = pairs.nodes[first];
            children.push(pairs.nodes[first + 1]);
        }
        let name = self.nodes.len();
        // A box of nothing is met by no unit direction, and by any other holds what the first does.
        let mut node = Node { bounds: [[Vec4::MAX; 3], [Vec4::MIN; 3]], inside: [0; WIDE], count: [0; WIDE] };
        self.nodes.push(node);
        for (k, child) in children.iter().enumerate() {
            for axis in 0..3 {
                node.bounds[0][axis][k] = child.aabb().min[axis];
                node.bounds[1][axis][k] = child.aabb().max[axis];
            }
            node.count[k] = child.prim_count;
            node.inside[k] = if child.is_leaf() {
                child.first_index
            } else {
                let first = child.first_index as usize;
                self.widen(pairs, vec![pairs.nodes[first], pairs.nodes[first + 1]])
            };
        }
        for k in children.len()..WIDE {
            (node.inside[k], node.count[k]) = (node.inside[0], node.count[0]);
        }
        self.nodes[name] = node;
        name as u32
    }

    /// The nearest meeting before `farthest`, by the distances of triangles in their order; with `any`, the first that is found.
    pub(super) fn search(
        &self,
        line: &Line,
        farthest: f32,
        any: bool,
        distance: impl Fn(usize) -> f32,
    ) -> Option<(f32, u32)> {
        let mut nearest = (farthest, u32::MAX);
        if !self.nodes.is_empty() {
            self.search_from(0, line, any, &distance, &mut nearest);
        }
        (nearest.1 != u32::MAX).then_some(nearest)
    }

    fn search_from(
        &self,
        from: u32,
        line: &Line,
        any: bool,
        distance: &impl Fn(usize) -> f32,
        nearest: &mut (f32, u32),
    ) {
        let (mut aside, mut count) = ([(0.0_f32, 0_u32); ASIDE], 0_usize);
        let origin = line.origin.to_array().map(Vec4::splat);
        let inverse = line.inverse.to_array().map(Vec4::splat);
        let side = line.inverse.to_array().map(|i| usize::from(i < 0.0));
        let mut name = from;
        loop {
            let node = &self.nodes[name as usize];
            let at = |far: usize, axis: usize| {
                (node.bounds[side[axis] ^ far][axis] - origin[axis]) * inverse[axis]
            };
            let enter = at(0, 0).max(at(0, 1)).max(at(0, 2)).max(Vec4::ZERO);
            let leave = at(1, 0).min(at(1, 1)).min(at(1, 2)).min(Vec4::splat(nearest.0));
            let met: BVec4A = enter.cmple(leave);
            let mut left = met.bitmask();
            let enter = enter.to_array();
            let mut next: Option<(f32, u32)> = None;
            while left != 0 {
                let k = (left.trailing_zeros() & 3) as usize;
                left &= left - 1;
                if node.count[k] > 0 {
                    for triangle in node.inside[k]..node.inside[k] + node.count[k] {
                        let t = distance(triangle as usize);
                        if t < nearest.0 {
                            *nearest = (t, triangle);
                            if any {
                                return;
                            }
                        }
                    }
                    continue;
                }
                let mut later = (enter[k], node.inside[k]);
                if let Some(first) = &mut next {
                    if later.0 < first.0 {
                        std::mem::swap(&mut later, first);
                    }
                    if count < ASIDE {
                        aside[count] = later;
                        count += 1;
                    } else {
                        self.search_from(later.1, line, any, distance, nearest);
                        if any && nearest.1 != u32::MAX {
                            return;
                        }
                    }
                } else {
                    next = Some(later);
                }
            }
            name = match next {
                Some((t, next)) if t <= nearest.0 => next,
                _ => loop {
                    if count == 0 {
                        return;
                    }
                    count -= 1;
                    let (t, next) = aside[count];
                    if t <= nearest.0 {
                        break next;
                    }
                },
            };
        }
    }
}

/// A triangle whose box is widened by 2⁻¹⁸ of its distance from the origin: the test of a box rounds, and a ray along a face of a
/// box would slip past the triangle in it.
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
    fn more_boxes_than_are_put_aside_are_searched() {
        // Sheets behind one another, all of which a ray along x meets; their numbers do not follow their places.
        let sheets = 5000_u32;
        let place = |k: u32| 1.0 + (k * 1777 % sheets) as f32;
        let triangles: Vec<_> = (0..sheets)
            .map(|k| [[-1.0, -1.0], [1.0, -1.0], [0.0, 1.0]].map(|[y, z]| Vec3::new(place(k), y, z)))
            .collect();
        let boxes = Boxes::new(&triangles);
        let distance = |k: usize| place(boxes.order[k]);
        for direction in [Vec3::X, Vec3::new(1.0, -0.0, 1e-7)] {
            let line = Line::new(Vec3::ZERO, direction);
            // The last is the nearest once all others are out of the way.
            for least in [1.0, 17.0, 4999.0, 5000.0] {
                let beyond = |k: usize| if distance(k) < least { f32::INFINITY } else { distance(k) };
                assert_eq!(boxes.search(&line, f32::INFINITY, false, beyond).unwrap().0, least);
                assert!(boxes.search(&line, f32::INFINITY, true, beyond).is_some());
            }
            assert_eq!(boxes.search(&line, 1.0, false, distance), None);
        }
        assert_eq!(boxes.search(&Line::new(Vec3::ZERO, Vec3::NEG_X), f32::INFINITY, false, distance), None);
        assert_eq!(Boxes::new(&[]).search(&Line::new(Vec3::ZERO, Vec3::X), 9.0, true, distance), None);
    }
}
