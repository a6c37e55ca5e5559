//! Displacement along the normal, with the exact normal of the displaced surface.

use glam::{Vec2, Vec3};

use crate::direction::{along, near_one};

/// A point of a displaced surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Displaced {
    /// The displaced position.
    pub position: Vec3,
    /// The unit normal there, on the side of the undisplaced normal.
    pub normal: Vec3,
}

/// Displaces a point along its normal and computes the exact normal of the displaced surface.
///
/// ```text
/// P′ = P + F n,   P′_u = P_u + F_u n + F n_u,   P′_v = P_v + F_v n + F n_v,   n′ ∝ ±P′_u × P′_v
/// ```
///
/// - **Domain:** unit `n`; `p = [P_u, P_v]`, `dn = [n_u, n_v]` (zero for a plane, `P_u/R`, `P_v/R`
///   on a sphere), height `F` and its derivatives.
/// - **Range:** the normal is `n` where the displaced surface has none: parallel derivatives,
///   heights beyond a center of curvature, NaN.
///
/// ```
/// use asperity_shading::bump::displace;
/// use asperity_shading::glam::{Vec2, Vec3};
///
/// // A sphere of radius 2, raised by 1 everywhere: its normals do not change.
/// let (n, p) = (Vec3::Z, [Vec3::X, Vec3::Y]);
/// let raised = displace(2.0 * n, n, p, p.map(|p| p / 2.0), 1.0, Vec2::ZERO);
/// assert_eq!((raised.position, raised.normal), (3.0 * n, n));
/// ```
#[must_use]
pub fn displace(position: Vec3, n: Vec3, p: [Vec3; 2], dn: [Vec3; 2], height: f32, slope: Vec2) -> Displaced {
    let [p_u, p_v] = p;
    let [n_u, n_v] = dn;
    let [d_u, d_v] = [p_u + slope.x * n + height * n_u, p_v + slope.y * n + height * n_v].map(near_one);
    let is_left_handed = near_one(p_u).cross(near_one(p_v)).dot(n) < 0.0;
    let oriented = if is_left_handed { d_v.cross(d_u) } else { d_u.cross(d_v) };
    let normal = along(oriented).filter(|normal| normal.dot(n) > 0.0);
    Displaced { position: position + height * n, normal: normal.unwrap_or(n) }
}

#[cfg(test)]
mod tests {
    use asperity_core::assert_abs_diff_eq;
    use glam::Vec2Swizzles;

    use super::*;
    use crate::bump::surface_gradient::{bumped_normal, surface_gradient};

    #[test]
    fn displaced_plane_has_the_bumped_normal() {
        let (p, slope) = ([2.0 * Vec3::X, Vec3::new(0.5, 1.0, 0.0)], Vec2::new(0.3, -0.4));
        for p in [p, [p[1], p[0]]] {
            let exact = displace(Vec3::ZERO, Vec3::Z, p, [Vec3::ZERO; 2], 0.7, slope);
            let bumped = bumped_normal(Vec3::Z, surface_gradient(Vec3::Z, p, slope));
            assert_abs_diff_eq!(exact.normal, bumped, epsilon = 1e-6);
            assert_eq!(exact.position, 0.7 * Vec3::Z);
        }
    }

    #[test]
    fn displace_returns_unit_normals_at_any_scale() {
        let (p, slope) = ([Vec3::new(0.8, 0.1, 0.2), Vec3::new(-0.1, 0.7, 0.3)], Vec2::new(0.3, -0.4));
        // With either handedness.
        for (p, slope) in [(p, slope), ([p[1], p[0]], slope.yx())] {
            let normal = |size: f32| {
                displace(Vec3::ZERO, Vec3::Z, p.map(|p| size * p), [Vec3::ZERO; 2], size, size * slope).normal
            };
            for size in [1e-36, 1e-22, 1e-11, 1e11, 1e22, 1e38] {
                assert_abs_diff_eq!(normal(size).length(), 1.0, epsilon = 2e-7, "{size}");
                assert_abs_diff_eq!(normal(size), normal(1.0), epsilon = 1e-6, "{size}");
            }
        }
    }

    #[test]
    fn displaced_sphere_normal_matches_finite_differences() {
        // r(θ, φ) = 1 + 0.1 sin 3θ cos 2φ.
        let height = |theta: f32, phi: f32| 0.1 * (3.0 * theta).sin() * (2.0 * phi).cos();
        let at =
            |theta: f32, phi: f32| Vec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos());
        let (theta, phi) = (1.1_f32, 0.4_f32);
        let n = at(theta, phi);
        let p_u = Vec3::new(theta.cos() * phi.cos(), theta.cos() * phi.sin(), -theta.sin());
        let p_v = Vec3::new(-theta.sin() * phi.sin(), theta.sin() * phi.cos(), 0.0);
        let slope = Vec2::new(
            0.3 * (3.0 * theta).cos() * (2.0 * phi).cos(),
            -0.2 * (3.0 * theta).sin() * (2.0 * phi).sin(),
        );
        let displaced = displace(n, n, [p_u, p_v], [p_u, p_v], height(theta, phi), slope);
        let moved = |theta, phi| at(theta, phi) * (1.0 + height(theta, phi));
        let h = 1e-2;
        let along = (moved(theta + h, phi) - moved(theta - h, phi)).normalize();
        let across = (moved(theta, phi + h) - moved(theta, phi - h)).normalize();
        // Differences err by h²/6 times third derivatives of up to 3.
        assert_abs_diff_eq!(displaced.normal.dot(along), 0.0, epsilon = 1e-4);
        assert_abs_diff_eq!(displaced.normal.dot(across), 0.0, epsilon = 1e-4);
    }

    #[test]
    fn displace_without_normal_returns_the_original_normal() {
        assert_eq!(
            displace(Vec3::ZERO, Vec3::Z, [Vec3::X; 2], [Vec3::ZERO; 2], 0.0, Vec2::ONE).normal,
            Vec3::Z
        );
        let beyond = displace(Vec3::Z, Vec3::Z, [Vec3::X, Vec3::Y], [Vec3::X, Vec3::Y], f32::NAN, Vec2::ONE);
        assert_eq!(beyond.normal, Vec3::Z);
    }
}
