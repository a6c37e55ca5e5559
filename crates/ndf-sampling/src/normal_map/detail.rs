//! Detail on an existing bump map: convert normals to Gaussian coordinates, add noise, convert
//! back.

use glam::{Vec2, Vec3};

use crate::coordinates::bounded;
use crate::ndf::Ndf;
use asperity_core::math;

/// Adds noise to the Gaussian coordinates of a bump map and keeps their variance.
///
/// ```text
/// z = (z_b + ε z_n)/√(1 + ε²)
/// ```
///
/// If `z_b` and `z_n` are independent standard Gaussians, so is `z` for every amount `ε`. Therefore
/// `T(z)` has the NDF of the original bump map. Without the root the variance would grow.
///
/// - **Domain:** coordinates are clamped to ±13, NaN is read as 0. `ε` is its absolute value
///   clamped to 10¹⁸, NaN is read as 0.
/// - **Limits:** `ε = 0` returns `z_b`, bit for bit.
///
/// ```
/// use asperity_ndf_sampling::{add_detail, glam::Vec2};
///
/// assert_eq!(add_detail(Vec2::new(1.0, -0.5), Vec2::new(9.0, 9.0), 0.0), Vec2::new(1.0, -0.5));
/// assert!(add_detail(Vec2::X, Vec2::Y, 1.0).abs_diff_eq(Vec2::splat(0.5_f32.sqrt()), 1e-7));
/// ```
///
/// Kautz, Heidrich, Seidel 2001, section 7, adds noise to the indices without the root.
#[inline]
#[must_use]
pub fn add_detail(z_b: Vec2, z_n: Vec2, amount: f32) -> Vec2 {
    let amount = if amount.is_nan() { 0.0 } else { amount.abs().min(1e18) };
    let root = math::sqrt(1.0 + amount * amount);
    bounded((bounded(z_b) + bounded(z_n) * amount) / root)
}

/// Adds noise to a normal of a bump map: `T(add_detail(T⁻¹(n), z_n, ε))`.
///
/// `ndf` is the NDF of the bump map, e.g. from [`estimate_ndf`](crate::estimate_ndf). Without noise
/// the normal is returned up to the accuracy of `T ∘ T⁻¹`. If a bump map is evaluated often, store
/// `T⁻¹(n)` as its texels and look up `T` in a [`NormalLut`](crate::NormalLut).
///
/// ```
/// use asperity_ndf_sampling::{Ggx, add_detail_normal, glam::{Vec2, Vec3}};
///
/// let ggx = Ggx::new(0.2, 0.4)?;
/// let n = Vec3::new(0.1, -0.3, 0.95).normalize();
/// assert!(add_detail_normal(&ggx, n, Vec2::ONE, 0.0).abs_diff_eq(n, 1e-6));
/// assert!(add_detail_normal(&ggx, n, Vec2::ONE, 0.3).dot(n) < 0.9999);
/// # Ok::<(), asperity_ndf_sampling::NdfError>(())
/// ```
#[inline]
#[must_use]
pub fn add_detail_normal<N: Ndf + ?Sized>(ndf: &N, n: Vec3, z_n: Vec2, amount: f32) -> Vec3 {
    ndf.warp_gaussian(add_detail(ndf.invert(n), z_n, amount))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Beckmann, Ggx, NoiseCdfRef, NoiseDistribution, gaussian_cdf};
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn accepts_every_input() {
        let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e38, -1e38, 0.0, 1e-40];
        let ggx = Ggx::isotropic(0.3).unwrap();
        for (a, b) in bad.into_iter().flat_map(|a| bad.map(|b| (a, b))) {
            for amount in bad {
                assert!(add_detail(Vec2::new(a, b), Vec2::new(b, a), amount).is_finite(), "{a} {b} {amount}");
                let n = add_detail_normal(&ggx, Vec3::new(a, b, amount), Vec2::splat(a), b);
                assert_abs_diff_eq!(n.length(), 1.0, epsilon = 1e-6, "{a} {b} {amount}");
            }
        }
    }

    #[test]
    fn detailed_tends_to_pure_noise_for_large_amounts() {
        let z_n = Vec2::new(0.3, -1.2);
        assert_abs_diff_eq!(add_detail(Vec2::new(5.0, -9.0), z_n, f32::INFINITY), z_n, epsilon = 1e-6);
        assert_abs_diff_eq!(add_detail(Vec2::ZERO, z_n, -1.0), z_n * 0.5_f32.sqrt(), epsilon = 1e-7);
    }

    #[test]
    fn noise_values_of_normals_round_trip() {
        let table: [f32; 9] = core::array::from_fn(|k| (k * k) as f32 / 64.0);
        let noise = NoiseCdfRef::new(2.0, &table).unwrap();
        let ndf = Beckmann::new(0.2, 0.6).unwrap();
        for k in 1..40 {
            let r = Vec2::new(k as f32 * 0.1 - 2.0, 1.95 - k as f32 * 0.07);
            let z = ndf.invert(ndf.warp_gaussian(r.map(|r| noise.invert(r))));
            assert_abs_diff_eq!(z.map(|z| noise.warp_gaussian(z)), r, epsilon = 1e-5, "{r}");
            assert_abs_diff_eq!(
                gaussian_cdf(f64::from(z.x)),
                f64::from(noise.cdf(r.x)),
                epsilon = 1e-6,
                "{r}"
            );
        }
    }
}
