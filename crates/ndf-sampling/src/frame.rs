//! Orthonormal tangent frames, by the minimal rotation from (0, 0, 1).

use glam::Vec3;

use asperity_core::math;

/// An orthonormal, right-handed frame: `tangent × bitangent = normal`.
///
/// ```
/// use asperity_ndf_sampling::{Frame, glam::Vec3};
///
/// let frame = Frame::from_normal(Vec3::new(0.36, 0.48, 0.8));
/// let h = Vec3::new(0.0, 0.6, 0.8);
/// assert!(frame.to_world(frame.to_local(h)).abs_diff_eq(h, 1e-6));
/// assert_eq!(Frame::from_normal(Vec3::Z).to_local(h), h);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias = "tangent space")]
#[doc(alias = "orthonormal basis")]
#[doc(alias = "onb")]
#[doc(alias = "tbn")]
pub struct Frame {
    /// Unit tangent **t**, the local x axis.
    pub tangent: Vec3,
    /// Unit bitangent **b**, the local y axis.
    pub bitangent: Vec3,
    /// Unit normal **n**, the local z axis.
    pub normal: Vec3,
}

#[cfg(feature = "approx")]
asperity_core::impl_approx! { f32; Frame: frame => frame.tangent, frame.bitangent, frame.normal; }

impl Frame {
    /// The frame of the axes x, y, z.
    pub const IDENTITY: Self = Self { tangent: Vec3::X, bitangent: Vec3::Y, normal: Vec3::Z };

    /// The frame with normal `n`, by the minimal rotation of the axes that takes (0, 0, 1) to `n`.
    ///
    /// ```text
    /// t = (1 − nx²/(1 + nz), −nx ny/(1 + nz), −nx)
    /// b = (−nx ny/(1 + nz), 1 − ny²/(1 + nz), −ny)
    /// ```
    ///
    /// - **Domain:** any vector; it is normalized. Vectors that are zero, NaN, shorter than 10⁻¹⁹
    ///   or longer than 10¹⁹ return [`Frame::IDENTITY`].
    /// - **At (0, 0, −1)** the minimal rotation is not unique. The half turn about x is used, `t =
    ///   x`, `b = −y`. Around it the frame turns twice per turn of `n`, because every such field of
    ///   rotations has a singularity.
    /// - **Accuracy:** orthonormal to 1e-6 everywhere, also next to (0, 0, −1), where `1 + nz`
    ///   would cancel.
    ///
    /// Kautz, Heidrich, Seidel 2001 do not specify the tangents of table L, but anisotropic shading
    /// depends on them. This choice is continuous over the upper hemisphere and the identity for a
    /// flat bump map.
    #[inline]
    #[must_use]
    pub fn from_normal(n: Vec3) -> Self {
        let Some(n) = normalized(n) else {
            return Self::IDENTITY;
        };
        let a = if n.z >= 0.0 {
            1.0 / (1.0 + n.z)
        } else {
            let r2 = n.x * n.x + n.y * n.y;
            if r2 < 1e-30 {
                return Self { tangent: Vec3::X, bitangent: Vec3::NEG_Y, normal: n };
            }
            (1.0 - n.z) / r2
        };
        let xy = -n.x * n.y * a;
        Self {
            tangent: Vec3::new(1.0 - n.x * n.x * a, xy, -n.x),
            bitangent: Vec3::new(xy, 1.0 - n.y * n.y * a, -n.y),
            normal: n,
        }
    }

    /// The frame of `n` whose tangent is the component of `t` perpendicular to `n`.
    ///
    /// `n` is normalized as in [`Frame::from_normal`]. The function returns [`Frame::from_normal`]
    /// if `t` is zero, NaN or parallel to `n` within 10⁻³ rad, so it accepts every input.
    #[inline]
    #[must_use]
    pub fn from_normal_tangent(n: Vec3, t: Vec3) -> Self {
        let given = n;
        let n = normalized(n).unwrap_or(Vec3::Z);
        let across = |t: Vec3| t - n * n.dot(t);
        let steep = normalized(t).map(across).filter(|across| across.length_squared() >= 1e-6);
        // Project again: the first projection leaves a component along n that 1e-3 rad magnifies to
        // 1e-4.
        let tangent = steep.and_then(normalized).map(across).and_then(normalized);
        match tangent {
            Some(tangent) => Self { tangent, bitangent: n.cross(tangent), normal: n },
            None => Self::from_normal(given),
        }
    }

    /// `v` in this frame: `(v·t, v·b, v·n)`.
    #[inline]
    #[must_use]
    pub fn to_local(&self, v: Vec3) -> Vec3 {
        Vec3::new(v.dot(self.tangent), v.dot(self.bitangent), v.dot(self.normal))
    }

    /// The vector whose coordinates in this frame are `v`: `v.x t + v.y b + v.z n`.
    #[inline]
    #[must_use]
    pub fn to_world(&self, v: Vec3) -> Vec3 {
        self.tangent * v.x + self.bitangent * v.y + self.normal * v.z
    }
}

/// `v/|v|`, or `None` if that is not a unit vector.
#[inline]
fn normalized(v: Vec3) -> Option<Vec3> {
    let length2 = v.length_squared();
    // A vector that is unit to rounding is returned bit for bit.
    if (length2 - 1.0).abs() < 2.0 * f32::EPSILON {
        return Some(v);
    }
    (length2.is_finite() && length2 > f32::MIN_POSITIVE).then(|| v / math::sqrt(length2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn from_normal_at_the_south_pole_is_the_half_turn_about_x() {
        let frame = Frame::from_normal(Vec3::NEG_Z);
        assert_eq!(frame, Frame { tangent: Vec3::X, bitangent: Vec3::NEG_Y, normal: Vec3::NEG_Z });
    }

    #[test]
    fn from_normal_without_direction_is_identity() {
        for n in [Vec3::ZERO, Vec3::NAN, Vec3::INFINITY, Vec3::splat(1e-30)] {
            assert_eq!(Frame::from_normal(n), Frame::IDENTITY, "{n}");
        }
    }

    #[test]
    fn from_normal_tangent_keeps_the_tangent() {
        let frame = Frame::from_normal_tangent(Vec3::Y, Vec3::new(0.0, 5.0, 2.0));
        assert_eq!(frame.tangent, Vec3::Z);
        assert_eq!(frame.bitangent, Vec3::X);
        for t in [Vec3::ZERO, Vec3::NAN, Vec3::Y, Vec3::NEG_Y] {
            assert_eq!(Frame::from_normal_tangent(Vec3::Y, t), Frame::from_normal(Vec3::Y), "{t}");
        }
    }
}
