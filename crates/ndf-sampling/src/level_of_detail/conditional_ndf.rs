//! The NDF of the unresolved facets: evaluated, sampled, and resolved further.

use glam::{Vec2, Vec3};

use crate::coordinates::GaussianSplit;
use crate::ndf::Ndf;

/// The NDF `p_s(h | z_b)` of the facets that a pixel does not resolve.
///
/// It has its own bijection from Gaussian numbers:
///
/// ```text
/// D(h) = p_s(h | z_b),      T_s(ξ) = T(√s z_b + √(1 − s) ξ),      T_s⁻¹(m) = (T⁻¹(m) − √s z_b)/√(1 − s)
/// ```
///
/// Here `T` and `D` are those of any [`Ndf`]. See
/// [`residual_ndf`](crate::residual_ndf) for the formula and its limits.
/// [`Ndf::sample`] draws the remaining facets, with the density [`Ndf::pdf`]. A
/// `ConditionalNdf` of a `ConditionalNdf` resolves more of the remainder.
///
/// - **Mean over the surface:** for standard Gaussian `z_b` the mean of `D` is the original
///   density, for every `s`.
/// - **Domain:** as for [`residual_ndf`](crate::residual_ndf) and [`Ndf`]. `T_s` at
///   `s → 1` is `T(z_b)` except for 10⁻³ ξ.
/// - **Accuracy:** `T_s⁻¹(T_s(ξ)) = ξ` within the accuracy of `T⁻¹ ∘ T` over `√(1 − s)`.
///
/// ```
/// use asperity_ndf_sampling::{ConditionalNdf, Ggx, Ndf, glam::{Vec2, Vec3}};
///
/// let ggx = Ggx::new(0.2, 0.4)?;
/// let seen = ConditionalNdf::new(ggx, Vec2::new(0.5, 1.5), 0.75);
/// let facet = seen.sample(Vec2::new(0.3, 0.8));
/// assert!(seen.d(facet) > 1.2 * ggx.d(facet) && seen.pdf(facet) > 0.0);
/// // With nothing resolved it is the far field, exactly.
/// let far = ConditionalNdf::new(ggx, Vec2::new(0.5, 1.5), 0.0);
/// assert_eq!(far.d(facet), ggx.d(facet));
/// assert_eq!(far.warp_gaussian(Vec2::ONE), ggx.warp_gaussian(Vec2::ONE));
/// # Ok::<(), asperity_ndf_sampling::NdfError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias = "toksvig")]
#[doc(alias = "lean")]
pub struct ConditionalNdf<N> {
    ndf: N,
    split: GaussianSplit,
}

impl<N: Ndf> ConditionalNdf<N> {
    /// Creates the rest of `ndf` where `z_b` is resolved with the fraction `s` of the variance.
    ///
    /// Accepts every input.
    #[inline]
    #[must_use]
    pub fn new(ndf: N, z_b: Vec2, s: f32) -> Self {
        Self { ndf, split: GaussianSplit::new(z_b, s) }
    }

    /// The resolved part.
    #[inline]
    #[must_use]
    pub const fn split(&self) -> GaussianSplit {
        self.split
    }
}

impl<N: Ndf> Ndf for ConditionalNdf<N> {
    #[inline]
    fn d(&self, m: Vec3) -> f32 {
        self.ndf.residual_ndf(m, self.split)
    }

    #[inline]
    fn warp_gaussian(&self, z: Vec2) -> Vec3 {
        self.ndf.warp_gaussian(self.split.join(z))
    }

    #[inline]
    fn invert(&self, m: Vec3) -> Vec2 {
        self.split.rest(self.ndf.invert(m))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ndf::totality;
    use crate::{Beckmann, GaussianSplit, Ggx, residual_ndf};
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn round_trip() {
        let ggx = Ggx::new(0.2, 0.4).unwrap();
        for s in [0.0, 0.1, 0.5, 0.9, 0.99] {
            let seen = ConditionalNdf::new(ggx, Vec2::new(0.7, -1.4), s);
            for k in -12..=12 {
                let xi = Vec2::new(k as f32 * 0.25, 1.0 - k as f32 * 0.2);
                let back = seen.invert(seen.warp_gaussian(xi));
                assert_abs_diff_eq!(back, xi, epsilon = 4e-6 / (1.0 - s).sqrt(), "{s}");
            }
        }
    }

    #[test]
    fn fully_resolved_is_a_single_facet() {
        let beckmann = Beckmann::isotropic(0.3).unwrap();
        let z_b = Vec2::new(1.0, -0.5);
        for s in [1.0, 7.0, f32::INFINITY] {
            let seen = ConditionalNdf::new(beckmann, z_b, s);
            assert_eq!(seen.split().resolved_variance(), GaussianSplit::MAX_RESOLVED_VARIANCE);
            for xi in [Vec2::ZERO, Vec2::ONE, Vec2::new(-3.0, 2.0)] {
                // At most 4 · 10⁻³ standard deviations of slope.
                let facet = seen.warp_gaussian(xi);
                assert_abs_diff_eq!(facet, beckmann.warp_gaussian(z_b), epsilon = 1.5e-3, "{s} {xi}");
                assert!(seen.d(facet).is_finite());
            }
        }
    }

    #[test]
    fn nested_conditional_resolves_both_fractions() {
        // √s₁ z₁ + √(1 − s₁)(√s₂ z₂ + √(1 − s₂) ξ) has resolved 1 − (1 − s₁)(1 − s₂).
        let ggx = Ggx::new(0.3, 0.6).unwrap();
        let (z1, s1, z2, s2) = (Vec2::new(0.4, 1.0), 0.5_f32, Vec2::new(-1.1, 0.3), 0.6_f32);
        let twice = ConditionalNdf::new(ConditionalNdf::new(ggx, z1, s1), z2, s2);
        let s = 1.0 - (1.0 - s1) * (1.0 - s2);
        let z = (z1 * s1.sqrt() + z2 * ((1.0 - s1) * s2).sqrt()) / s.sqrt();
        for k in 0..20 {
            let h = ggx.warp_gaussian(Vec2::new(0.1 * k as f32 - 1.0, 0.5 - 0.07 * k as f32));
            let (got, expected) = (twice.d(h), residual_ndf(&ggx, h, z, s));
            assert_abs_diff_eq!(got / expected, 1.0, epsilon = 1e-4, "{h}");
        }
    }

    #[test]
    fn accepts_every_input() {
        for (s, z) in totality::BAD.into_iter().flat_map(|s| totality::BAD.map(|z| (s, z))) {
            totality::check(&ConditionalNdf::new(Ggx::isotropic(0.2).unwrap(), Vec2::new(z, 0.5), s));
        }
    }
}
