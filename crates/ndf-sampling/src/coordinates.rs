//! Gaussian coordinates: their range, and their split into a resolved part and the rest.

use glam::Vec2;

use asperity_core::math;

/// The largest Gaussian coordinate that the maps distinguish, in standard deviations.
///
/// A Gaussian exceeds it with probability 10⁻³⁸, and `exp(−ρ²/4)` of the farthest corner is still a
/// normal `f32`.
pub(crate) const FARTHEST: f32 = 13.0;

/// `z` with NaN read as 0 and both coordinates clamped to ±[`FARTHEST`].
#[inline]
pub(crate) fn bounded(z: Vec2) -> Vec2 {
    Vec2::new(bounded_coordinate(z.x), bounded_coordinate(z.y))
}

/// `z` clamped to ±[`FARTHEST`]; NaN is read as 0.
#[inline]
pub(crate) fn bounded_coordinate(z: f32) -> f32 {
    if z.is_nan() { 0.0 } else { z.clamp(-FARTHEST, FARTHEST) }
}

/// A split of a Gaussian coordinate into its resolved part and the rest.
///
/// It is prepared once for many half vectors at one point.
///
/// [`residual_ndf`](crate::residual_ndf) builds one for each call.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GaussianSplit {
    pub(crate) z_b: Vec2,
    /// √s
    pub(crate) root: f32,
    /// 1 − s
    pub(crate) rest: f32,
}

#[cfg(feature = "approx")]
asperity_core::impl_approx! { f32; GaussianSplit: split => split.z_b.x, split.z_b.y, split.resolved_variance(); }

impl GaussianSplit {
    /// The largest resolved fraction of the variance.
    ///
    /// The rest of the lobe is then 10⁻³ standard deviations wide. Closer to 1 the lobe would be as
    /// narrow as the rounding of `T⁻¹(h)` in `f32`.
    pub const MAX_RESOLVED_VARIANCE: f32 = 1.0 - 1.0 / (1u32 << 20) as f32;

    /// Creates the split for the resolved coordinates `z_b` with the fraction `s` of the variance.
    ///
    /// Accepts every input, see [`residual_ndf`](crate::residual_ndf).
    #[inline]
    #[must_use]
    pub fn new(z_b: Vec2, s: f32) -> Self {
        let s = if s.is_nan() { 0.0 } else { s.clamp(0.0, Self::MAX_RESOLVED_VARIANCE) };
        Self { z_b: bounded(z_b), root: math::sqrt(s), rest: 1.0 - s }
    }

    /// The resolved fraction of the variance, after clamping.
    #[inline]
    #[must_use]
    pub fn resolved_variance(self) -> f32 {
        1.0 - self.rest
    }

    /// `√s z_b + √(1 − s) ξ`: the full coordinates, where `ξ` is the unresolved part.
    ///
    /// Accepts every input.
    #[inline]
    #[must_use]
    pub fn join(self, xi: Vec2) -> Vec2 {
        self.z_b * self.root + bounded(xi) * math::sqrt(self.rest)
    }

    /// `(z − √s z_b)/√(1 − s)`: the unresolved part of the coordinates `z`.
    ///
    /// Accepts every input. The result is clamped to ±13 on each axis.
    #[inline]
    #[must_use]
    pub fn rest(self, z: Vec2) -> Vec2 {
        bounded((bounded(z) - self.z_b * self.root) / math::sqrt(self.rest))
    }

    /// `p_s(h | z_b)` from the density `D(h)` and the coordinates `z = T⁻¹(h)`.
    ///
    /// The result has the unit of `density`, and is 0 where `density` is not positive.
    ///
    /// ```text
    /// density · exp(|z_b|²/2 − |√s z − z_b|² / (2(1 − s))) / (1 − s)
    /// ```
    #[inline]
    #[must_use]
    pub fn weigh(self, density: f32, z: Vec2) -> f32 {
        let z = bounded(z);
        let (x, y) = (self.root * z.x - self.z_b.x, self.root * z.y - self.z_b.y);
        let near = (x * x + y * y) / self.rest;
        let b = self.z_b.x * self.z_b.x + self.z_b.y * self.z_b.y;
        // Half of the exponent twice: the whole could overflow where the density is small and the
        // product is not.
        let half = math::exp(0.25 * (b - near));
        if density > 0.0 { (density * half * half / self.rest).min(f32::MAX) } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_are_bounded() {
        assert_eq!(bounded(Vec2::new(f32::NAN, f32::INFINITY)), Vec2::new(0.0, 13.0));
        assert_eq!(bounded(Vec2::new(-1e30, 0.5)), Vec2::new(-13.0, 0.5));
    }
}
