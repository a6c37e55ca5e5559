//! Directions of reflection: the half vector of two directions, and the mirror of one.

use glam::Vec3;

/// The half vector **h**: the facet normal that mirrors `wi` into `wo`.
///
/// ```text
/// h = (wi + wo) / |wi + wo|
/// ```
///
/// - **Domain:** unit `wi` and `wo`, both pointing away from the surface, in any one frame.
/// - **Range:** a unit vector in the same frame; [`Vec3::ZERO`] where it does not exist: opposite
///   directions, zero vectors, NaN or infinite components. Every density is 0 there, so such a
///   pixel is dark.
///
/// Kautz, Heidrich, Seidel 2001, *Real-Time Bump Map Synthesis*, §3.1.
///
/// ```
/// use asperity_shading::{glam::Vec3, half_vector, reflect};
///
/// let (wi, wo) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.0, 0.6, 0.8));
/// let h = half_vector(wi, wo);
/// assert!((h.length() - 1.0).abs() < 1e-6);
/// assert!((reflect(wi, h) - wo).length() < 1e-6);
/// ```
#[must_use]
pub fn half_vector(wi: Vec3, wo: Vec3) -> Vec3 {
    let sum = wi + wo;
    // Opposite directions leave only rounding errors, whose direction is meaningless.
    if sum.length_squared() > 1e-12 { sum.normalize_or_zero() } else { Vec3::ZERO }
}

/// Mirrors a direction `w` at a facet with normal `m`.
///
/// ```text
/// reflect(w, m) = 2 (w·m) m − w
/// ```
///
/// - **Domain:** `w` of any length, pointing away from the surface; unit `m`, whose sign does not
///   matter.
/// - **Range:** a vector as long as `w`, also pointing away from the surface. A zero `m` returns
///   `−w`; NaN and infinity pass through.
/// - **Symmetry:** `reflect(reflect(w, m), m) = w`.
///
/// ```
/// use asperity_shading::{glam::Vec3, reflect};
///
/// let w = Vec3::new(0.6, 0.0, 0.8);
/// assert_eq!(reflect(w, Vec3::Z), Vec3::new(-0.6, 0.0, 0.8));
/// ```
#[must_use]
#[inline]
pub fn reflect(w: Vec3, m: Vec3) -> Vec3 {
    2.0 * w.dot(m) * m - w
}

/// Scales `v` by a power of two so that its longest component is near 1.
///
/// The digits do not change, and products stay in range.
pub(crate) fn near_one(v: Vec3) -> Vec3 {
    const EXPONENT: u32 = 0xff << 23;
    let longest = v.abs().max_element().to_bits() & EXPONENT;
    // The exponents add up to the exponent of 1, except for the largest, whose partner is
    // subnormal.
    v * f32::from_bits((254 << 23) - longest.min(253 << 23))
}

/// Normalizes `v` of any length; `None` for zero, NaN and infinity.
pub(crate) fn along(v: Vec3) -> Option<Vec3> {
    let v = near_one(v);
    (v.is_finite() && v != Vec3::ZERO).then(|| v.normalize())
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn along_normalizes_vectors_of_any_length() {
        for length in [f32::from_bits(1), 1e-40, 1e-23, 1e-15, 1.0, 1e15, 1e23, 0.5 * f32::MAX] {
            for v in [Vec3::new(0.6, 0.0, -0.8), Vec3::new(1.0, -1.0, 1.0), Vec3::X] {
                let unit = along(length * v).unwrap();
                assert_abs_diff_eq!(unit.length(), 1.0, epsilon = 2e-7);
                // A subnormal number has too few digits for a direction.
                let few = if length < 1e-38 { 1.0 } else { 1e-6 };
                assert_abs_diff_eq!(unit, v.normalize(), epsilon = few);
            }
        }
        for v in
            [Vec3::ZERO, -Vec3::ZERO, Vec3::NAN, Vec3::new(f32::NAN, 1.0, 0.0), f32::INFINITY * Vec3::ONE]
        {
            assert_eq!(along(v), None, "{v}");
        }
    }

    #[test]
    fn half_vector_bisects_the_angle() {
        for i in 1..100 {
            let (sin, cos) = (i as f32 / 100.0 * core::f32::consts::PI).sin_cos();
            let (wi, wo) = (Vec3::Z, Vec3::new(sin, 0.0, cos));
            let h = half_vector(wi, wo);
            assert_abs_diff_eq!(h.length(), 1.0, epsilon = 1e-6, "i = {i}");
            assert_abs_diff_eq!(h.dot(wi), h.dot(wo), epsilon = 1e-5, "i = {i}");
            assert_eq!(h, half_vector(wo, wi));
        }
    }

    #[test]
    fn half_vector_of_degenerate_directions_is_zero() {
        let w = Vec3::new(0.6, 0.0, 0.8);
        let nearly = Vec3::new(-0.6, 1e-7, -0.8);
        for (wi, wo) in [
            (w, -w),
            (w, nearly),
            (Vec3::ZERO, Vec3::ZERO),
            (w, Vec3::NAN),
            (Vec3::NAN, w),
            (w, Vec3::INFINITY),
            (Vec3::splat(f32::MAX), Vec3::splat(f32::MAX)),
        ] {
            assert_eq!(half_vector(wi, wo), Vec3::ZERO, "{wi} and {wo}");
        }
    }

    #[test]
    fn reflect_is_an_involution_and_keeps_the_length() {
        let m = Vec3::new(0.48, -0.6, 0.64);
        for w in [Vec3::new(0.0, 0.6, 0.8), Vec3::new(3.0, -2.0, 5.0), Vec3::ZERO] {
            let r = reflect(w, m);
            assert_abs_diff_eq!(r.length(), w.length(), epsilon = 1e-5, "{w} to {r}");
            assert_abs_diff_eq!(reflect(r, m), w, epsilon = 1e-5, "{w} to {r}");
            assert_abs_diff_eq!(r.dot(m), w.dot(m), epsilon = 1e-5, "{w} to {r}");
            assert_eq!(r, reflect(w, -m));
        }
        assert_eq!(reflect(Vec3::X, Vec3::ZERO), Vec3::NEG_X);
    }
}
