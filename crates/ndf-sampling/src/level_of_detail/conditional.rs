//! Exact level of detail: the distribution of facet normals when a part of the bump map is
//! resolved.

use glam::{Vec2, Vec3};

use crate::coordinates::GaussianSplit;
use crate::ndf::Ndf;

/// The density of facet normals given the resolved part of the bump map, in sr⁻¹.
///
/// The Gaussian coordinates of a normal split into `z = √s z_b + √(1 − s) ξ`. Here `z_b` is the
/// noise of the octaves that the pixel resolves, `s` is their fraction of the variance, and `ξ` is
/// the rest. The density of `T(z)` given `z_b` is
///
/// ```text
/// p_s(h | z_b) = D(h) · Π_k N(z_k; √s z_b,k, 1 − s) / N(z_k; 0, 1),     z = T⁻¹(h),  k = 1, 2
///              = D(h) · exp(|z_b|²/2 − |√s z − z_b|² / (2(1 − s))) / (1 − s)
/// ```
///
/// The second line follows from `|z − √s z_b|²/(1 − s) − |z|² = |√s z − z_b|²/(1 − s) − |z_b|²`. It
/// does not subtract two large values of `|z|²`, and at `s = 0` the exponent is exactly 0.
///
/// Because `∫ N(z; √s z_b, 1 − s) N(z_b; 0, 1) dz_b = N(z; 0, 1)`, **the mean over the surface is
/// `D(h)`, for every NDF and every `s`**. The rule is a martingale in `s`: when more octaves are
/// resolved, the mean of the new view is the previous view, without popping.
///
/// - **Domain:** unit `h` in the frame of the macro surface; 0 for `h.z ≤ 0` and NaN. `s` is
///   clamped to `0..=`[`GaussianSplit::MAX_RESOLVED_VARIANCE`], NaN is read as 0. `z_b` is
///   clamped to ±13, NaN is read as 0.
/// - **Limits:** `s = 0` returns `D(h)` exactly; `s → 1` a lobe around `T(z_b)` of standard
///   deviation `√(1 − s)` in `z`.
/// - **Accuracy:** 2e-5 relative for `|z|, |z_b| ≤ 4` and `s ≤ 0.9`. The rounding of `h` itself
///   contributes `|√s z − z_b|/(1 − s)` times the error of `T⁻¹(h)`.
///
/// ```
/// use asperity_ndf_sampling::{Ggx, Ndf, residual_ndf, glam::{Vec2, Vec3}};
///
/// let ggx = Ggx::new(0.2, 0.4)?;
/// let (h, z_b) = (Vec3::new(0.1, -0.2, 0.97).normalize(), Vec2::new(0.5, 1.5));
/// assert_eq!(residual_ndf(&ggx, h, z_b, 0.0), ggx.d(h));
/// let facet = ggx.warp_gaussian(z_b);
/// assert!(residual_ndf(&ggx, facet, z_b, 0.9) > 5.0 * ggx.d(facet));
/// # Ok::<(), asperity_ndf_sampling::NdfError>(())
/// ```
///
/// Kautz, Heidrich, Seidel 2001, section 5, evaluates `D` itself in the frame of the resolved facet
/// instead. This convolves `D` with itself, so the mean over a surface is not the far field.
#[inline]
#[must_use]
#[doc(alias = "toksvig")]
#[doc(alias = "lean")]
#[doc(alias = "filtering")]
#[doc(alias = "antialiasing")]
pub fn residual_ndf<N: Ndf + ?Sized>(ndf: &N, h: Vec3, z_b: Vec2, s: f32) -> f32 {
    ndf.residual_ndf(h, GaussianSplit::new(z_b, s))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Beckmann, Ggx};

    #[test]
    fn conditional_density_at_s_zero_is_the_far_field() {
        let ggx = Ggx::new(0.2, 0.4).unwrap();
        let h = Vec3::new(0.3, -0.2, 0.9).normalize();
        for z_b in [Vec2::ZERO, Vec2::new(1.3, -0.7), Vec2::new(1e9, f32::NAN)] {
            assert_eq!(residual_ndf(&ggx, h, z_b, 0.0).to_bits(), ggx.d(h).to_bits());
            assert_eq!(residual_ndf(&ggx, h, z_b, f32::NAN).to_bits(), ggx.d(h).to_bits());
        }
    }

    /// `p_s(h | z_b)` in `f64`, with the relative bound of the error in `f32`.
    fn reference([alpha_x, alpha_y]: [f64; 2], ggx: bool, h: Vec3, z_b: Vec2, s: f32) -> [f64; 2] {
        let [x, y, z] = h.to_array().map(f64::from);
        let (sx, sy, s) = (x / (alpha_x * z), y / (alpha_y * z), f64::from(s));
        let a = sx * sx + sy * sy;
        // T⁻¹: P(a' > a) is 1/(1 + a) for GGX, exp(−a) for Beckmann, and exp(−|z|²/2) for the
        // coordinates.
        let (square, shape) = if ggx { (2.0 * a.ln_1p(), (1.0 + a).powi(-2)) } else { (2.0 * a, (-a).exp()) };
        let density = shape / (core::f64::consts::PI * alpha_x * alpha_y * z.powi(4));
        let scale = (square / a).sqrt();
        let [bx, by] = z_b.to_array().map(f64::from);
        let b = bx * bx + by * by;
        let off: f64 = (sx * scale * s.sqrt() - bx).hypot(sy * scale * s.sqrt() - by);
        let near = off * off / (1.0 - s);
        let value = density * (0.5 * (b - near)).exp() / (1.0 - s);
        // The coordinates err by about eight roundings of 6e-8, which the exponent multiplies by
        // its slope. Then it is rounded itself.
        let coordinates = 5e-7 * (1.0 + square.sqrt()) * off / (1.0 - s);
        [value, 2e-6 + 2e-7 * (b + near + square) + coordinates]
    }

    #[test]
    fn conditional_density_closed_forms_match_the_general_formula() {
        let ggx = Ggx::new(0.2, 0.4).unwrap();
        let beckmann = Beckmann::new(0.2, 0.4).unwrap();
        let ndfs: [(&dyn Ndf, bool); 2] = [(&ggx, true), (&beckmann, false)];
        let mut compared = 0;
        for k in 0..4000_u16 {
            let turn = |step: f32| (f32::from(k + 1) * step).fract();
            let z = 4.0 * Vec2::new(2.0 * turn(0.754_877_7) - 1.0, 2.0 * turn(0.569_840_3) - 1.0);
            let z_b = 3.0 * Vec2::new(2.0 * turn(0.819_172_5) - 1.0, 2.0 * turn(0.671_043_6) - 1.0);
            let s = [0.1, 0.5, 0.75, 0.97][usize::from(k % 4)];
            for (ndf, ggx) in ndfs {
                let h = ndf.warp_gaussian(z);
                let [expected, bound] = reference([0.2_f32, 0.4].map(f64::from), ggx, h, z_b, s);
                let got = f64::from(residual_ndf(ndf, h, z_b, s));
                // Smaller densities are irrelevant to any sum of lights, and are subnormal.
                if expected > 1e-20 && bound < 0.01 {
                    assert!(
                        (got / expected - 1.0).abs() <= bound,
                        "{ggx} {h} {z_b} {s}: {got:e}, {expected:e}, {bound:e}"
                    );
                    compared += 1;
                }
            }
        }
        assert!(compared > 5500, "{compared}");
    }
}
