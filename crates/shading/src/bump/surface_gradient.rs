//! Bump mapping: normals of a surface displaced along its normal, from surface gradients.

use asperity_ndf_sampling::Frame;
use glam::{Vec2, Vec3};

use crate::direction::{along, near_one, reflect};
use crate::math::sqrt;

/// The surface gradient of a height, from its derivatives in two parameters.
///
/// ```text
/// ∇F = (F_u (P_v × n) + F_v (n × P_u)) / (n · (P_u × P_v)),   ∇F·P_u = F_u,   ∇F·P_v = F_v
/// ```
///
/// - **Domain:** unit normal `n`; `p = [P_u, P_v]`, the derivatives of the position, which span the
///   tangent plane in any orientation, at any angle and length; `slope = (F_u, F_v)`. The
///   parameters may be texture coordinates, or screen coordinates with differences between
///   neighboring pixels as derivatives.
/// - **Range:** a vector perpendicular to `n`; zero where `P_u` and `P_v` are parallel, and for NaN
///   and infinity.
///
/// Add the gradients of several heights on one surface, then call [`bumped_normal`] once.
///
/// Cohen's lecture (after Blinn 1978, *Simulation of Wrinkled Surfaces*) adds `U + V = F_u (n ×
/// P_v) − F_v (n × P_u)` to a unit normal. This is `−∇F` if `P_u` and `P_v` are orthonormal and
/// right-handed. The general form is Mikkelsen 2020, *Surface Gradient-Based Bump Mapping
/// Framework*, eq. 1–3.
///
/// ```
/// use asperity_shading::bump::{bumped_normal, surface_gradient};
/// use asperity_shading::glam::{Vec2, Vec3};
///
/// // Height 0.5 u over a plane whose texture is stretched to twice its width: a slope of 1/4.
/// let gradient = surface_gradient(Vec3::Z, [2.0 * Vec3::X, Vec3::Y], Vec2::new(0.5, 0.0));
/// assert_eq!(gradient, Vec3::new(0.25, 0.0, 0.0));
/// let normal = bumped_normal(Vec3::Z, gradient);
/// assert!((normal - Vec3::new(-0.25, 0.0, 1.0).normalize()).length() < 1e-6);
/// ```
#[must_use]
pub fn surface_gradient(n: Vec3, p: [Vec3; 2], slope: Vec2) -> Vec3 {
    let [p_u, p_v] = p;
    let gradient = (slope.x * p_v.cross(n) + slope.y * n.cross(p_u)) / n.dot(p_u.cross(p_v));
    if gradient.is_finite() { gradient } else { Vec3::ZERO }
}

/// The surface part of a gradient in space, e.g. of a solid noise.
///
/// ```text
/// ∇F = g − n (n·g)
/// ```
///
/// - **Domain:** unit normal `n`, gradient `g` by position. For `noise(frequency · P)` it is
///   `frequency` times the gradient of the noise.
/// - **Range:** a vector perpendicular to `n`; zero for NaN and infinity.
///
/// ```
/// use asperity_shading::bump::project_to_tangent_plane;
/// use asperity_shading::glam::Vec3;
///
/// assert_eq!(project_to_tangent_plane(Vec3::Z, Vec3::new(0.3, -0.2, 5.0)), Vec3::new(0.3, -0.2, 0.0));
/// ```
#[must_use]
pub fn project_to_tangent_plane(n: Vec3, g: Vec3) -> Vec3 {
    let gradient = g - n * n.dot(g);
    if gradient.is_finite() { gradient } else { Vec3::ZERO }
}

/// The gradient of the height with normal `m` in a tangent frame, e.g. a texel of a normal map.
///
/// ```text
/// ∇F = −(m_x t + m_y b) / m_z
/// ```
///
/// - **Domain:** unit `m`, whose z component points away from the surface. Components below 2⁻¹⁰
///   are clamped to 2⁻¹⁰, so texels at and below the horizon are steep and not upside down.
/// - **Range:** a vector perpendicular to the normal of the frame; zero for NaN and infinity.
///
/// ```
/// use asperity_shading::bump::{bumped_normal, gradient_of_normal};
/// use asperity_shading::{Frame, glam::Vec3};
///
/// let frame = Frame::from_normal_tangent(Vec3::X, Vec3::Y);
/// let m = Vec3::new(0.28, 0.0, 0.96);
/// let normal = bumped_normal(frame.normal, gradient_of_normal(&frame, m));
/// assert!((normal - frame.to_world(m)).length() < 1e-6);
/// ```
#[must_use]
pub fn gradient_of_normal(frame: &Frame, m: Vec3) -> Vec3 {
    let steepest = 1.0 / 1024.0;
    let gradient = (m.x * frame.tangent + m.y * frame.bitangent) / -m.z.max(steepest);
    if gradient.is_finite() && !m.z.is_nan() { gradient } else { Vec3::ZERO }
}

/// The normal of a surface with this surface gradient of its height.
///
/// ```text
/// n′ = (n − ∇F) / |n − ∇F|
/// ```
///
/// - **Domain:** unit normal `n`, gradient perpendicular to it; a component along `n` is removed.
/// - **Range:** a unit vector less than 90° from `n`: `n·n′ = 1/√(1 + |∇F|²)`. Slopes are clamped
///   to 10⁴. NaN and infinity return `n`.
///
/// Exact for a plane. On a curved surface it omits the height times the curvature, as Blinn 1978
/// does. [`displace`](crate::bump::displace) includes it.
///
/// ```
/// use asperity_shading::bump::bumped_normal;
/// use asperity_shading::glam::Vec3;
///
/// let n = bumped_normal(Vec3::Z, Vec3::new(0.75, 0.0, 0.0));
/// assert!((n - Vec3::new(-0.6, 0.0, 0.8)).length() < 1e-6);
/// assert_eq!(bumped_normal(Vec3::Z, Vec3::NAN), Vec3::Z);
/// ```
#[doc(alias = "bump mapping")]
#[doc(alias = "normal mapping")]
#[must_use]
pub fn bumped_normal(n: Vec3, gradient: Vec3) -> Vec3 {
    let steepest = gradient.abs().max_element();
    // Beyond this slope the rounding of the component of the gradient along n would outweigh n.
    let g = if steepest > MAX_SLOPE { gradient * (MAX_SLOPE / steepest) } else { gradient };
    let bumped = (n - (g - n * n.dot(g))).normalize_or_zero();
    if bumped.is_finite() && bumped != Vec3::ZERO { bumped } else { n }
}

const MAX_SLOPE: f32 = 1e4;

/// The derivatives of a height by finite differences.
///
/// ```text
/// F_u ≈ (F(u + h, v) − F(u − h, v)) / 2h,   F_v likewise
/// ```
///
/// Takes four evaluations. The error is `h²/6` times the third derivative, plus the rounding of `F`
/// over `h`. A step of 0 or NaN returns zero.
///
/// ```
/// use asperity_shading::bump::finite_difference_gradient;
/// use asperity_shading::glam::Vec2;
///
/// let slope = finite_difference_gradient(|uv| uv.x * uv.x + 3.0 * uv.y, Vec2::new(0.5, 0.0), 0.01);
/// assert!((slope - Vec2::new(1.0, 3.0)).length() < 1e-4);
/// ```
#[must_use]
pub fn finite_difference_gradient(height: impl Fn(Vec2) -> f32, uv: Vec2, step: f32) -> Vec2 {
    let along = |by: Vec2| (height(uv + by) - height(uv - by)) / (2.0 * step);
    let slope = Vec2::new(along(Vec2::new(step, 0.0)), along(Vec2::new(0.0, step)));
    if slope.is_finite() { slope } else { Vec2::ZERO }
}

/// Bends a shading normal until the mirrored view leaves the surface.
///
/// A bumped normal may face away from the viewer, or mirror the view into the surface, which
/// renders black. It is rotated towards the geometric normal `n`, in their plane, until the
/// mirrored view is parallel to the surface. If the view itself comes from below, the bumped normal
/// is returned unchanged.
///
/// ```text
/// n″ ∝ ωo + r,   r the mirrored view with its part along n taken out
/// ```
///
/// - **Domain:** unit `n`, `bumped` and view `wo`, away from the surface.
/// - **Range:** a unit vector; `n` if the bumped normal is not finite.
///
/// ```
/// use asperity_shading::bump::flip_to_visible;
/// use asperity_shading::{glam::Vec3, reflect};
///
/// let (wo, bumped) = (Vec3::new(0.96, 0.0, 0.28), Vec3::new(-0.6, 0.0, 0.8));
/// let seen = flip_to_visible(Vec3::Z, bumped, wo);
/// assert!(reflect(wo, bumped).z < 0.0 && reflect(wo, seen).z > -1e-6);
/// ```
#[must_use]
pub fn flip_to_visible(n: Vec3, bumped: Vec3, wo: Vec3) -> Vec3 {
    if !bumped.is_finite() {
        return n;
    }
    let mirrored = reflect(wo, bumped);
    let cosine = wo.dot(n);
    // Written so that NaN returns the normal unchanged.
    if !(cosine > 0.0 && mirrored.dot(n) < 0.0) {
        return bumped;
    }
    // Squares of a view much shorter than 1 would underflow.
    let level = near_one(project_to_tangent_plane(n, mirrored));
    let length = sqrt(level.dot(level));
    let level = if length > 0.0 { level / length } else { Vec3::ZERO };
    along(wo + level).unwrap_or(n)
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn surface_gradient_has_the_given_slopes() {
        let n = Vec3::new(0.48, 0.6, 0.64);
        // Oblique, with different lengths, in both orientations.
        let frame = Frame::from_normal(n);
        let (t, b) = (frame.tangent, frame.bitangent);
        for p in [[2.0 * t, 0.3 * t + 0.5 * b], [b, t - 0.2 * b], [-3.0 * t, b]] {
            let slope = Vec2::new(0.7, -1.3);
            let g = surface_gradient(n, p, slope);
            let slopes = Vec3::new(g.dot(p[0]), g.dot(p[1]), g.dot(n));
            assert_abs_diff_eq!(slopes, slope.extend(0.0), epsilon = 1e-5, "{p:?}");
        }
    }

    #[test]
    fn surface_gradient_of_degenerate_input_is_zero() {
        let bad = Vec3::new(f32::NAN, 0.0, 1.0);
        assert_eq!(surface_gradient(Vec3::Z, [Vec3::X, 2.0 * Vec3::X], Vec2::ONE), Vec3::ZERO);
        assert_eq!(surface_gradient(Vec3::Z, [Vec3::X, bad], Vec2::ONE), Vec3::ZERO);
        assert_eq!(project_to_tangent_plane(Vec3::Z, bad), Vec3::ZERO);
        assert_eq!(gradient_of_normal(&Frame::from_normal(Vec3::Z), bad), Vec3::ZERO);
        assert_eq!(gradient_of_normal(&Frame::from_normal(Vec3::Z), Vec3::NAN), Vec3::ZERO);
        assert_eq!(finite_difference_gradient(|_| f32::NAN, Vec2::ZERO, 0.1), Vec2::ZERO);
        assert_eq!(finite_difference_gradient(|uv| uv.x, Vec2::ZERO, 0.0), Vec2::ZERO);
        assert_eq!(flip_to_visible(Vec3::Z, bad, Vec3::Z), Vec3::Z);
    }

    #[test]
    fn facing_mirrors_the_view_out_of_the_surface() {
        let n = Vec3::Z;
        for i in 0..200 {
            let (a, b) = (0.031 * i as f32, 0.77 * i as f32);
            let wo = Vec3::new(b.cos() * a.cos().abs(), b.sin() * a.cos().abs(), a.sin().abs().max(1e-3))
                .normalize();
            let bumped = Vec3::new((2.3 * a).sin(), (1.7 * b).cos(), 0.3).normalize();
            let seen = flip_to_visible(n, bumped, wo);
            assert!((seen.length() - 1.0).abs() < 1e-5 && seen.dot(wo) >= -1e-6, "{wo}, {bumped}: {seen}");
            // In the worst case the sum of view and mirrored view is as short as the height of the
            // view, 1e-3, and errs by 1e-7 of 1.
            assert!(reflect(wo, seen).z >= -1e-4, "{wo}, {bumped}: {seen}");
            if reflect(wo, bumped).z >= 0.0 {
                assert_eq!(seen, bumped);
            } else {
                assert!(reflect(wo, seen).z < 1e-4, "no further than needed: {wo}, {bumped}: {seen}");
            }
        }
    }

    #[test]
    fn facing_accepts_views_of_any_length() {
        let bumped = Vec3::new(-0.8, 0.0, 0.6);
        for length in [f32::from_bits(9), 1e-40, 1e-23, 1e-21, 1e-11, 1.0, 1e11, 1e18] {
            let wo = length * Vec3::new(0.8, 0.0, 0.6);
            let seen = flip_to_visible(Vec3::Z, bumped, wo);
            assert!(seen != bumped && (seen.length() - 1.0).abs() < 1e-6, "{wo}: {seen}");
        }
    }
}
