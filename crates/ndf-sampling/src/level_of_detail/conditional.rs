//! Exact level of detail: the density of facet normals that remains when a part of the bump map is resolved.

use glam::{Vec2, Vec3};

use crate::coordinates::GaussianSplit;
use crate::ndf::Ndf;

/// The density of facet normals that a pixel sees, given what it resolves of the bump map, in sr⁻¹.
///
/// The Gaussian coordinates of a normal split into `z = √s z_b + √(1 − s) ξ`: `z_b` is the noise of the octaves that the
/// pixel resolves, `s` their share of the variance, `ξ` the rest. The density of `T(z)` given `z_b` is
///
/// ```text
/// p_s(h | z_b) = D(h) · Π_k N(z_k; √s z_b,k, 1 − s) / N(z_k; 0, 1),     z = T⁻¹(h),  k = 1, 2
///              = D(h) · exp(|z_b|²/2 − |√s z − z_b|² / (2(1 − s))) / (1 − s)
/// ```
///
/// The second line follows from `|z − √s z_b|²/(1 − s) − |z|² = |√s z − z_b|²/(1 − s) − |z_b|²`. It cannot lose a small
/// difference of two large `|z|²`, and at `s = 0` the exponent is exactly 0.
///
/// Because `∫ N(z; √s z_b, 1 − s) N(z_b; 0, 1) dz_b = N(z; 0, 1)`, **the mean over the surface is `D(h)`, for every NDF and
/// every `s`**; and resolving more octaves keeps the mean of what was seen before (a martingale in `s`), so nothing pops.
///
/// - **Domain:** unit `h` in the frame of the macro surface; 0 for `h.z ≤ 0` and NaN. `s` is clamped to
///   `0..=`[`MAX_SHARE`](crate::level_of_detail::MAX_SHARE), NaN counts as 0. `z_b` beyond ±13 counts as ±13, NaN as 0.
/// - **Limits:** `s = 0` gives `D(h)` exactly; `s → 1` a lobe around `T(z_b)` of standard deviation `√(1 − s)` in `z`.
/// - **Accuracy:** 2e-5 relative for `|z|, |z_b| ≤ 4` and `s ≤ 0.9`; the rounding of `h` itself enters as
///   `|√s z − z_b|/(1 − s)` times the error of `T⁻¹(h)`.
///
/// ```
/// use asperity_ndf_sampling::{Ggx, Ndf, conditional_density, glam::{Vec2, Vec3}};
///
/// let ggx = Ggx::new(0.2, 0.4)?;
/// let (h, z_b) = (Vec3::new(0.1, -0.2, 0.97).normalize(), Vec2::new(0.5, 1.5));
/// assert_eq!(conditional_density(&ggx, h, z_b, 0.0), ggx.density(h));
/// let facet = ggx.from_gaussian(z_b);
/// assert!(conditional_density(&ggx, facet, z_b, 0.9) > 5.0 * ggx.density(facet));
/// # Ok::<(), asperity_ndf_sampling::RangeError>(())
/// ```
///
/// Kautz, Heidrich, Seidel 2001, section 5, evaluates `D` itself in the frame of the resolved facet instead. That convolves
/// `D` with itself: the mean over a surface is not the far field.
#[inline]
#[must_use]
#[doc(alias = "toksvig")]
#[doc(alias = "lean")]
#[doc(alias = "filtering")]
#[doc(alias = "antialiasing")]
pub fn conditional_density<N: Ndf + ?Sized>(ndf: &N, h: Vec3, z_b: Vec2, s: f32) -> f32 {
    ndf.conditional_density(h, GaussianSplit::new(z_b, s))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Ggx;

    #[test]
    fn nothing_resolved_is_the_far_field_exactly() {
        let ggx = Ggx::new(0.2, 0.4).unwrap();
        let h = Vec3::new(0.3, -0.2, 0.9).normalize();
        for z_b in [Vec2::ZERO, Vec2::new(1.3, -0.7), Vec2::new(1e9, f32::NAN)] {
            assert_eq!(conditional_density(&ggx, h, z_b, 0.0).to_bits(), ggx.density(h).to_bits());
            assert_eq!(conditional_density(&ggx, h, z_b, f32::NAN).to_bits(), ggx.density(h).to_bits());
        }
    }
}
