//! Bump mapping: the normals of a surface displaced along its normal, by surface gradients.

use asperity_ndf_sampling::Frame;
use glam::{Vec2, Vec3};

use crate::direction::{along, near_one, reflect};
use crate::math::sqrt;

/// The gradient along a surface of a height that is given by its derivatives in two parameters.
///
/// ```text
/// ∇F = (F_u (P_v × n) + F_v (n × P_u)) / (n · (P_u × P_v)),   ∇F·P_u = F_u,   ∇F·P_v = F_v
/// ```
///
/// - **Domain:** unit normal `n`; `p = [P_u, P_v]`, the derivatives of the position, which span the tangent plane in any
///   orientation, at any angle and length; `slope = (F_u, F_v)`. The parameters may be texture coordinates or the axes of the
///   screen, with the differences between neighbouring pixels for derivatives.
/// - **Range:** a vector across `n`; zero where `P_u` and `P_v` are parallel, and for NaN and infinity.
///
/// Gradients of several heights on one surface are added before [`bumped_normal`] turns the normal once.
///
/// Cohen's lecture (after Blinn 1978, *Simulation of Wrinkled Surfaces*) adds `U + V = F_u (n × P_v) − F_v (n × P_u)` to a unit
/// normal, which is `−∇F` where `P_u` and `P_v` are of unit length, at right angles and right-handed. Mikkelsen 2020, *Surface Gradient-Based Bump Mapping Framework*, eq. 1–3, has this one.
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

/// The part along a surface of a gradient in space: of a noise that the surface cuts.
///
/// ```text
/// ∇F = g − n (n·g)
/// ```
///
/// - **Domain:** unit normal `n`, gradient `g` by position: of `noise(frequency · P)` it is `frequency` times the noise's own.
/// - **Range:** a vector across `n`; zero for NaN and infinity.
///
/// ```
/// use asperity_shading::bump::tangential;
/// use asperity_shading::glam::Vec3;
///
/// assert_eq!(tangential(Vec3::Z, Vec3::new(0.3, -0.2, 5.0)), Vec3::new(0.3, -0.2, 0.0));
/// ```
#[must_use]
pub fn tangential(n: Vec3, g: Vec3) -> Vec3 {
    let gradient = g - n * n.dot(g);
    if gradient.is_finite() { gradient } else { Vec3::ZERO }
}

/// The gradient of the height whose normal in a tangent frame is `m`: a normal map's texel, or a facet.
///
/// ```text
/// ∇F = −(m_x t + m_y b) / m_z
/// ```
///
/// - **Domain:** unit `m`, whose z component points away from the surface; below 2⁻¹⁰ it counts as that, so that texels at and
///   below the horizon are steep and not upside down.
/// - **Range:** a vector across the frame's normal; zero for NaN and infinity.
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

/// The normal of a surface whose height above it has this gradient.
///
/// ```text
/// n′ = (n − ∇F) / |n − ∇F|
/// ```
///
/// - **Domain:** unit normal `n`, gradient across it; a part along `n` is taken out.
/// - **Range:** a unit vector less than 90° from `n`: `n·n′ = 1/√(1 + |∇F|²)`, where slopes above 10⁴ count as that; `n` itself
///   for NaN and infinity.
///
/// Exact for a plane. On a curved surface it leaves out the height times the curvature, as Blinn 1978 does;
/// [`displace`](crate::bump::displace) does not.
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
    // Beyond this slope the rounding of the gradient's own part along n would outweigh n.
    let g = if steepest > MAX_SLOPE { gradient * (MAX_SLOPE / steepest) } else { gradient };
    let bumped = (n - (g - n * n.dot(g))).normalize_or_zero();
    if bumped.is_finite() && bumped != Vec3::ZERO { bumped } else { n }
}

const MAX_SLOPE: f32 = 1e4;

/// The derivatives of a height by its neighbours, where they are not known otherwise.
///
/// ```text
/// F_u ≈ (F(u + h, v) − F(u − h, v)) / 2h,   F_v likewise
/// ```
///
/// Four evaluations; the error is `h²/6` times the third derivative, and the rounding of `F` over `h`. A step of 0 or NaN
/// gives zero.
///
/// ```
/// use asperity_shading::bump::differences;
/// use asperity_shading::glam::Vec2;
///
/// let slope = differences(|uv| uv.x * uv.x + 3.0 * uv.y, Vec2::new(0.5, 0.0), 0.01);
/// assert!((slope - Vec2::new(1.0, 3.0)).length() < 1e-4);
/// ```
#[must_use]
pub fn differences(height: impl Fn(Vec2) -> f32, uv: Vec2, step: f32) -> Vec2 {
    let along = |by: Vec2| (height(uv + by) - height(uv - by)) / (2.0 * step);
    let slope = Vec2::new(along(Vec2::new(step, 0.0)), along(Vec2::new(0.0, step)));
    if slope.is_finite() { slope } else { Vec2::ZERO }
}

/// A shading normal that the viewer can see: the one given, or the nearest whose mirrored view leaves the surface.
///
/// A bumped normal may face away from the viewer, or mirror the view into the surface, where there is nothing to see but
/// black: it is turned towards the geometric normal `n`, in their plane, just as far that the mirrored view is parallel to the
/// surface. Where the view itself comes from below, the bumped normal is returned as it is.
///
/// ```text
/// n″ ∝ ωo + r,   r the mirrored view with its part along n taken out
/// ```
///
/// - **Domain:** unit `n`, `bumped` and view `wo`, away from the surface.
/// - **Range:** a unit vector; a bumped normal that is not finite is `n`.
///
/// ```
/// use asperity_shading::bump::facing;
/// use asperity_shading::{glam::Vec3, reflect};
///
/// let (wo, bumped) = (Vec3::new(0.96, 0.0, 0.28), Vec3::new(-0.6, 0.0, 0.8));
/// let seen = facing(Vec3::Z, bumped, wo);
/// assert!(reflect(wo, bumped).z < 0.0 && reflect(wo, seen).z > -1e-6);
/// ```
#[must_use]
pub fn facing(n: Vec3, bumped: Vec3, wo: Vec3) -> Vec3 {
    if !bumped.is_finite() {
        return n;
    }
    let mirrored = reflect(wo, bumped);
    let cosine = wo.dot(n);
    // Written so that NaN takes the normal as it is.
    if !(cosine > 0.0 && mirrored.dot(n) < 0.0) {
        return bumped;
    }
    // Squares of a view much shorter than 1 would leave the range.
    let level = near_one(tangential(n, mirrored));
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
        // Oblique, of different lengths, in both orientations.
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
    fn what_has_no_gradient_is_flat() {
        let bad = Vec3::new(f32::NAN, 0.0, 1.0);
        assert_eq!(surface_gradient(Vec3::Z, [Vec3::X, 2.0 * Vec3::X], Vec2::ONE), Vec3::ZERO);
        assert_eq!(surface_gradient(Vec3::Z, [Vec3::X, bad], Vec2::ONE), Vec3::ZERO);
        assert_eq!(tangential(Vec3::Z, bad), Vec3::ZERO);
        assert_eq!(gradient_of_normal(&Frame::from_normal(Vec3::Z), bad), Vec3::ZERO);
        assert_eq!(gradient_of_normal(&Frame::from_normal(Vec3::Z), Vec3::NAN), Vec3::ZERO);
        assert_eq!(differences(|_| f32::NAN, Vec2::ZERO, 0.1), Vec2::ZERO);
        assert_eq!(differences(|uv| uv.x, Vec2::ZERO, 0.0), Vec2::ZERO);
        assert_eq!(facing(Vec3::Z, bad, Vec3::Z), Vec3::Z);
    }

    #[test]
    fn seen_normals_mirror_the_view_out_of_the_surface() {
        let n = Vec3::Z;
        for i in 0..200 {
            let (a, b) = (0.031 * i as f32, 0.77 * i as f32);
            let wo = Vec3::new(b.cos() * a.cos().abs(), b.sin() * a.cos().abs(), a.sin().abs().max(1e-3))
                .normalize();
            let bumped = Vec3::new((2.3 * a).sin(), (1.7 * b).cos(), 0.3).normalize();
            let seen = facing(n, bumped, wo);
            assert!((seen.length() - 1.0).abs() < 1e-5 && seen.dot(wo) >= -1e-6, "{wo}, {bumped}: {seen}");
            // At worst the sum of view and mirrored view is as short as the view is low, 1e-3, and errs by 1e-7 of 1.
            assert!(reflect(wo, seen).z >= -1e-4, "{wo}, {bumped}: {seen}");
            if reflect(wo, bumped).z >= 0.0 {
                assert_eq!(seen, bumped);
            } else {
                assert!(reflect(wo, seen).z < 1e-4, "no further than needed: {wo}, {bumped}: {seen}");
            }
        }
    }

    #[test]
    fn views_of_any_length_see_a_unit_normal() {
        let bumped = Vec3::new(-0.8, 0.0, 0.6);
        for length in [f32::from_bits(9), 1e-40, 1e-23, 1e-21, 1e-11, 1.0, 1e11, 1e18] {
            let wo = length * Vec3::new(0.8, 0.0, 0.6);
            let seen = facing(Vec3::Z, bumped, wo);
            assert!(seen != bumped && (seen.length() - 1.0).abs() < 1e-6, "{wo}: {seen}");
        }
    }
}
