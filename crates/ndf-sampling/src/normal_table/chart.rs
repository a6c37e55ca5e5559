//! Charts of the hemisphere: the two numbers of a normal that a table stores and interpolates.

use glam::{Vec2, Vec3};

use asperity_core::math;

/// The two numbers that represent a normal of the upper hemisphere.
///
/// ```text
/// Projected      p = (n_x, n_y)                      n = (p, √(1 − |p|²))
/// Slopes         p = (n_x, n_y)/n_z                  n = (p, 1)/√(1 + |p|²)
/// Stereographic  p = (n_x, n_y)/(1 + n_z)            n = (2p, 1 − |p|²)/(1 + |p|²)
/// ```
///
/// Between the entries of a table `p` is interpolated, so the chart determines the error:
///
/// - **Projected** bends at the horizon, where the root has an infinite slope, and loses tilt: a
///   fifteenth of the far tail of GGX with roughness 1 at 128².
/// - **Slopes** are exact for [`Beckmann`](crate::Beckmann), whose slopes are linear in `z`, but
///   unbounded. Near the horizon they overflow half floats, and the midpoint between a tilted
///   normal and a normal at the horizon is at the horizon.
/// - **Stereographic** coordinates are bounded, smooth up to the horizon, keep small roughness to
///   full relative precision and need no root. They are as accurate as the better of the other two
///   at every roughness, and recommended.
///
/// The stereographic `p` is also the minimal rotation from (0, 0, 1) to `n`, as the quaternion
/// `(−p_y, p_x, 0, 1)/√(1 + |p|²)`.
///
/// ```
/// use asperity_ndf_sampling::{glam::{Vec2, Vec3}, normal_table::Chart};
///
/// let n = Vec3::new(0.48, -0.6, 0.64);
/// for chart in [Chart::Projected, Chart::Slopes, Chart::Stereographic] {
///     assert!(chart.to_normal(chart.to_point(n)).abs_diff_eq(n, 3e-7));
/// }
/// assert!(Chart::Slopes.to_point(n).abs_diff_eq(Vec2::new(0.75, -0.9375), 1e-6));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum Chart {
    /// `(n_x, n_y)`, in the unit disk.
    Projected,
    /// `(n_x, n_y)/n_z`, the slopes.
    Slopes,
    /// `(n_x, n_y)/(1 + n_z)`, in the unit disk.
    #[default]
    Stereographic,
}

/// The steepest representable slope, tan 89.9999999°; half floats hold 65504.
const STEEPEST: f32 = 1e9;

impl Chart {
    /// The coordinates of the unit normal `n`.
    ///
    /// A normal below the horizon is moved to the horizon; NaN is read as (0, 0, 1).
    #[inline]
    #[must_use]
    pub fn to_point(self, n: Vec3) -> Vec2 {
        let up = n.z.max(0.0);
        let p = match self {
            Self::Projected => Vec2::new(n.x, n.y),
            Self::Slopes => {
                let up = up.max(f32::MIN_POSITIVE);
                Vec2::new((n.x / up).clamp(-STEEPEST, STEEPEST), (n.y / up).clamp(-STEEPEST, STEEPEST))
            }
            Self::Stereographic => Vec2::new(n.x / (1.0 + up), n.y / (1.0 + up)),
        };
        if p.is_finite() { p } else { Vec2::ZERO }
    }

    /// The unit normal with the coordinates `p`, with `n.z ≥ 0`.
    ///
    /// Points outside the disk are moved to the nearest point on its rim, slopes are clamped to
    /// 10⁹, NaN is read as 0. Unit to 2e-7.
    #[inline]
    #[must_use]
    pub fn to_normal(self, p: Vec2) -> Vec3 {
        if self.holds(p) { self.inside(p) } else { self.repaired(p) }
    }

    /// Whether the point is valid in the chart.
    #[inline]
    pub(crate) fn holds(self, p: Vec2) -> bool {
        let end = if matches!(self, Self::Slopes) { STEEPEST * STEEPEST } else { 1.0 };
        p.x * p.x + p.y * p.y <= end
    }

    /// [`Chart::to_normal`] of a valid point; without branches.
    #[inline]
    pub(crate) fn inside(self, p: Vec2) -> Vec3 {
        let r2 = p.x * p.x + p.y * p.y;
        match self {
            Self::Projected => Vec3::new(p.x, p.y, math::sqrt(1.0 - r2)),
            Self::Slopes => {
                let up = 1.0 / math::sqrt(1.0 + r2);
                Vec3::new(p.x * up, p.y * up, up)
            }
            Self::Stereographic => {
                let a = 1.0 / (1.0 + r2);
                Vec3::new(2.0 * p.x * a, 2.0 * p.y * a, (1.0 - r2) * a)
            }
        }
    }

    /// [`Chart::to_normal`] of an invalid point.
    #[cold]
    fn repaired(self, p: Vec2) -> Vec3 {
        let bounded = |c: f32| if c.is_nan() { 0.0 } else { c.clamp(-STEEPEST, STEEPEST) };
        let (x, y) = (bounded(p.x), bounded(p.y));
        let (r2, up) = (x * x + y * y, if matches!(self, Self::Slopes) { 1.0 } else { 0.0 });
        if up == 0.0 && r2 <= 1.0 {
            return self.to_normal(Vec2::new(x, y));
        }
        let length = math::sqrt(r2 + up);
        Vec3::new(x / length, y / length, up / length)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    const CHARTS: [Chart; 3] = [Chart::Projected, Chart::Slopes, Chart::Stereographic];

    #[test]
    fn flat_normal_is_the_origin_and_back() {
        for chart in CHARTS {
            assert_eq!(chart.to_point(Vec3::Z), Vec2::ZERO);
            assert_eq!(chart.to_normal(Vec2::ZERO), Vec3::Z);
            assert_abs_diff_eq!(chart.to_normal(chart.to_point(Vec3::NEG_X)), Vec3::NEG_X, epsilon = 2e-9);
        }
    }

    #[test]
    fn small_tilts_keep_their_digits() {
        let n = Vec3::new(3e-6, -1.7e-5, 1.0);
        for chart in CHARTS {
            let back = chart.to_normal(chart.to_point(n));
            assert_abs_diff_eq!(back.x / n.x, 1.0, epsilon = 3e-7, "{chart:?}");
            assert_abs_diff_eq!(back.y / n.y, 1.0, epsilon = 3e-7, "{chart:?}");
        }
    }

    #[test]
    fn accepts_every_input() {
        let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0, -1.0, 1e38, 1e-40, 1.000_1, 1e10];
        for (chart, x) in CHARTS.into_iter().flat_map(|chart| bad.map(|x| (chart, x))) {
            for y in bad {
                let n = chart.to_normal(Vec2::new(x, y));
                assert_abs_diff_eq!(n.length(), 1.0, epsilon = 3e-7, "{chart:?} {x} {y}");
                assert!(n.z >= 0.0, "{chart:?} {x} {y}: {n}");
                assert!(bad.iter().all(|&z| chart.to_point(Vec3::new(x, y, z)).is_finite()));
            }
        }
    }
}
