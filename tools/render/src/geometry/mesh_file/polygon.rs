//! Polygon triangulation in space.

use glam::{DVec2, DVec3};

use crate::geometry::mesh_file::error::{MOST_CORNERS, MeshFileError};

/// Triangulates a polygon into index triples in the polygon's orientation. Their number is two
/// fewer than the number of corners that differ from the previous corner.
///
/// Convex polygons become a fan around the first corner. Concave polygons are ear clipped (Meisters
/// 1975, "Polygons have ears") in the plane that is nearest to the polygon. A self-intersecting
/// polygon always loses a corner, though not always an ear.
pub(super) fn triangulate(corners: &[DVec3]) -> Result<Vec<[usize; 3]>, MeshFileError> {
    let flat = flattened(corners);
    let turn = |[a, b, c]: [usize; 3]| (flat[b] - flat[a]).perp_dot(flat[c] - flat[b]);
    // A repeated corner would hide the turning direction there.
    let count = corners.len();
    let mut left: Vec<usize> = (0..count).filter(|&i| flat[i] != flat[(i + count - 1) % count]).collect();
    let n = left.len();
    if n < 3 {
        return Ok(Vec::new());
    }
    if (0..n).all(|i| turn([left[i], left[(i + 1) % n], left[(i + 2) % n]]) >= 0.0) {
        return Ok((2..n).map(|i| [left[0], left[i - 1], left[i]]).collect());
    }
    if n > MOST_CORNERS {
        return Err(MeshFileError::PolygonTooLarge { corners: n });
    }
    let mut triangles = Vec::new();
    while left.len() > 3 {
        let m = left.len();
        let around = |i: usize| [left[(i + m - 1) % m], left[i], left[(i + 1) % m]];
        let ear = (0..m).find(|&i| {
            let [a, b, c] = around(i);
            turn([a, b, c]) >= 0.0
                && left.iter().all(|&p| {
                    [a, b, c].iter().any(|&own| flat[own] == flat[p])
                        || [[a, b, p], [b, c, p], [c, a, p]].into_iter().any(|side| turn(side) < 0.0)
                })
        });
        let i = ear.unwrap_or(0);
        triangles.push(around(i));
        left.remove(i);
    }
    triangles.push([left[0], left[1], left[2]]);
    Ok(triangles)
}

/// Returns the triangles of a strip, all in the orientation of the first.
pub(super) fn strip(corners: &[u32]) -> Vec<[u32; 3]> {
    let triangle = |(i, &[a, b, c]): (usize, &[u32; 3])| if i % 2 == 0 { [a, b, c] } else { [b, a, c] };
    corners.array_windows().enumerate().map(triangle).collect()
}

/// Returns the triangles of a fan around the first corner.
pub(super) fn fan(corners: &[u32]) -> Vec<[u32; 3]> {
    let Some((&first, others)) = corners.split_first() else { return Vec::new() };
    others.array_windows().map(|&[b, c]| [b, c, first]).collect()
}

/// Projects the corners along the dominant axis of Newell's normal, counterclockwise.
fn flattened(corners: &[DVec3]) -> Vec<DVec2> {
    let next = corners.iter().cycle().skip(1);
    let normal = corners.iter().zip(next).fold(DVec3::ZERO, |sum, (&a, &b)| {
        // Differences first: far from the origin the products would cancel the area.
        sum + (a - corners[0]).cross(b - corners[0])
    });
    let axis = normal.abs().max_position();
    let (x, y) = ((axis + 1) % 3, (axis + 2) % 3);
    corners
        .iter()
        .map(|p| if normal[axis] < 0.0 { DVec2::new(p[y], p[x]) } else { DVec2::new(p[x], p[y]) })
        .collect()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use approx::assert_abs_diff_eq;

    use super::*;

    fn area(corners: &[DVec3]) -> DVec3 {
        let halves = triangulate(corners).unwrap().into_iter().map(|[a, b, c]| {
            let cross = (corners[b] - corners[a]).cross(corners[c] - corners[a]);
            // In the orientation of the whole.
            assert!(cross.dot(DVec3::new(1.0, -2.0, 3.0)) >= -1e-12, "{a} {b} {c}");
            0.5 * cross
        });
        halves.sum()
    }

    /// Points of a plane with normal (1, −2, 3), a fifth of U × V.
    fn lifted(points: &[[f64; 2]]) -> Vec<DVec3> {
        points.iter().map(|p| U * p[0] + V * p[1] + DVec3::splat(1000.0)).collect()
    }

    const U: DVec3 = DVec3::new(2.0, 1.0, 0.0);
    const V: DVec3 = DVec3::new(-3.0, 6.0, 5.0);

    #[test]
    fn triangulate_covers_a_polygon_once() {
        let scale = U.cross(V).length();
        let cases: [(&[[f64; 2]], f64); 4] = [
            (&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]], 2.0),
            // An arrowhead: a fan around the first corner would leave it.
            (&[[0.0, 0.0], [2.0, -1.0], [0.5, 0.0], [2.0, 1.0]], 0.5),
            // A crown, with two reflex corners.
            (&[[0.0, 0.0], [3.0, 0.0], [3.0, 3.0], [2.0, 1.0], [1.0, 1.0], [0.0, 3.0]], 5.0),
            // A repeated corner, and a corner on a straight edge.
            (&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 0.5], [1.0, 0.5], [0.0, 2.0]], 2.5),
        ];
        for (points, expected) in cases {
            let mut corners = lifted(points);
            for _ in points {
                let got = area(&corners).length() / scale;
                assert_abs_diff_eq!(got, expected, epsilon = 1e-9);
                corners.rotate_left(1);
            }
        }
    }

    #[test]
    fn triangulate_terminates_for_self_intersections() {
        let bow = [DVec3::ZERO, DVec3::new(1.0, 1.0, 0.0), DVec3::X, DVec3::Y];
        for (corners, count) in [(&bow[..], 2), (&[DVec3::ONE; 7], 0), (&[DVec3::ONE; 2], 0), (&[], 0)] {
            assert_eq!(triangulate(corners).unwrap().len(), count);
        }
        let star = |n: usize| {
            let point = |k| DVec2::from_angle(k as f64 / n as f64 * TAU) * if k % 2 == 0 { 1.0 } else { 0.4 };
            triangulate(&(0..n).map(|k| point(k).extend(0.0)).collect::<Vec<_>>())
        };
        assert!(star(MOST_CORNERS).is_ok());
        assert!(matches!(star(MOST_CORNERS + 2), Err(MeshFileError::PolygonTooLarge { .. })));
    }
}
