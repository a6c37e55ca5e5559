//! Spacing of the entries of a normal table along a Gaussian coordinate.

use crate::numeric::normal_distribution::{gaussian_cdf, inverse_gaussian_cdf};
use asperity_core::math;

/// The coordinate `w(z)` in [0, 1] along which the entries of a table are equally spaced.
///
/// ```text
/// Coordinates  w = (z/R + 1)/2                                          R = RANGE
/// Quantiles    w = Φ(z)
/// Warped       w = (A z/√(z² + c²) + 1)/2,   A = √(R² + c²)/R,   c = WARP
/// ```
///
/// - **Coordinates** need one multiply-add, and are the texture coordinate of a GPU: recommended.
/// - **Quantiles** are the index by uniform numbers of Kautz, Heidrich, Seidel 2001, for
///   reproduction. The farthest entry of 256 is at `z = 2.9`, which reduces the tails to a fifth.
/// - **Warped** puts more entries where there are more normals. Its density is between a uniform
///   one and the Gaussian of three times the variance, which is optimal for linear interpolation of
///   constant curvature. It needs one root and one division. At equal size the error of the nearest
///   entry is 0.75 (GGX 0.2, 0.4) to 0.62 (GGX 1) of the error with coordinates, and half in total
///   variation. The error of interpolation is 0.5 (GGX 1), 0.3 (two painted lobes) and 1 (GGX 0.2,
///   0.4) of it. It is 1.7 for Beckmann, whose curvature is all in the tail, where the largest
///   error doubles.
///
/// ```
/// use asperity_ndf_sampling::normal_table::Spacing;
///
/// for spacing in [Spacing::Coordinates, Spacing::Quantiles, Spacing::Warped] {
///     assert_eq!(spacing.place(0.0), 0.5);
///     assert!((spacing.coordinate(spacing.place(1.3)) - 1.3).abs() < 1e-5);
/// }
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum Spacing {
    /// Uniform in `z`.
    #[default]
    Coordinates,
    /// Uniform in `Φ(z)`.
    Quantiles,
    /// Denser in the middle.
    Warped,
}

impl Spacing {
    /// Tables end at this many standard deviations on each side, except for [`Spacing::Quantiles`].
    ///
    /// The fraction of a Gaussian beyond it is 7·10⁻⁶.
    pub const RANGE: f32 = 4.5;

    /// The scale `c` of [`Spacing::Warped`].
    pub const WARP: f32 = 3.0;

    /// The position of `z` in [0, 1], nondecreasing.
    ///
    /// NaN is read as 0, and values out of range are clamped.
    #[inline]
    #[must_use]
    pub fn place(self, z: f32) -> f32 {
        let z = if z.is_nan() { 0.0 } else { z.clamp(-Self::RANGE, Self::RANGE) };
        match self {
            Self::Coordinates => z * (0.5 / Self::RANGE) + 0.5,
            Self::Quantiles => gaussian_cdf(f64::from(z)) as f32,
            Self::Warped => {
                (0.5 * STRETCH * z / math::sqrt(z * z + Self::WARP * Self::WARP) + 0.5).clamp(0.0, 1.0)
            }
        }
    }

    /// The `z` at position `w`, the inverse of [`Spacing::place`].
    ///
    /// `w` is clamped to [0, 1], NaN is read as ½.
    #[must_use]
    pub fn coordinate(self, w: f32) -> f32 {
        let w = if w.is_nan() { 0.5 } else { f64::from(w.clamp(0.0, 1.0)) };
        let range = f64::from(Self::RANGE);
        let z = match self {
            Self::Coordinates => (2.0 * w - 1.0) * range,
            Self::Quantiles => inverse_gaussian_cdf(w),
            Self::Warped => {
                let t = (2.0 * w - 1.0) / f64::from(STRETCH);
                f64::from(Self::WARP) * t / math::sqrt_f64(1.0 - t * t)
            }
        };
        z.clamp(-range, range) as f32
    }
}

/// `A = √(R² + c²)/R`, for the range 4.5 and the scale 3 the root of 13/9.
const STRETCH: f32 = 1.201_850_4;

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    const SPACINGS: [Spacing; 3] = [Spacing::Coordinates, Spacing::Quantiles, Spacing::Warped];

    #[test]
    fn warp_ends_at_the_range() {
        let (r, c) = (f64::from(Spacing::RANGE), f64::from(Spacing::WARP));
        assert_abs_diff_eq!(f64::from(STRETCH), (r * r + c * c).sqrt() / r, epsilon = 1e-7);
        for spacing in [Spacing::Coordinates, Spacing::Warped] {
            assert_abs_diff_eq!(spacing.place(4.5), 1.0, epsilon = 1e-6);
            assert_abs_diff_eq!(spacing.place(-4.5), 0.0, epsilon = 1e-6);
            assert_abs_diff_eq!(spacing.coordinate(1.0), 4.5, epsilon = 1e-5);
            assert_abs_diff_eq!(spacing.coordinate(0.0), -4.5, epsilon = 1e-5);
        }
    }

    #[test]
    fn places_increase_and_round_trip() {
        for spacing in SPACINGS {
            let mut before = -1.0;
            for k in -450..=450 {
                let z = k as f32 * 0.01;
                let w = spacing.place(z);
                assert!(w >= before, "{spacing:?} at {z}");
                before = w;
                // An f32 next to 1 resolves 6e-8, which the slope of the quantiles magnifies.
                let rounding = if spacing == Spacing::Quantiles { 2e-7 * (0.5 * z * z).exp() } else { 5e-6 };
                assert_abs_diff_eq!(spacing.coordinate(w), z, epsilon = 5e-6 + rounding, "{spacing:?} at");
            }
        }
    }

    #[test]
    fn accepts_every_input() {
        for spacing in SPACINGS {
            assert_eq!((spacing.place(f32::NAN), spacing.coordinate(f32::NAN)), (0.5, 0.0));
            for bad in [f32::INFINITY, f32::NEG_INFINITY, 1e38, -1e38, 2.0, -1.0] {
                assert!((0.0..=1.0).contains(&spacing.place(bad)), "{spacing:?} {bad}");
                assert!(spacing.coordinate(bad).abs() <= 4.5, "{spacing:?} {bad}");
            }
        }
    }
}
