//! Detail on an existing bump map: convert normals to Gaussian coordinates, add noise, convert
//! back.

use glam::{Vec2, Vec3};

use crate::coordinates::bounded;
use crate::ndf::Ndf;
use crate::noise_distribution::distribution::NoiseDistribution;
use crate::numeric::normal_distribution::phi;
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
/// # Ok::<(), asperity_ndf_sampling::RangeError>(())
/// ```
#[inline]
#[must_use]
pub fn add_detail_normal<N: Ndf + ?Sized>(ndf: &N, n: Vec3, z_n: Vec2, amount: f32) -> Vec3 {
    ndf.warp_gaussian(add_detail(ndf.invert(n), z_n, amount))
}

/// Conversion from noise values through uniform numbers to normals, and back.
///
/// ```text
/// r → u = G(r) → n = T(Φ⁻¹(u)),        n → u = Φ(T⁻¹(n)) → r = G⁻¹(u)
/// ```
///
/// The second converts an existing bump map to noise values. More noise can be added to these
/// before the first is applied. A sum of two noises does not have the distribution of one noise,
/// unless they are Gaussian. To keep the NDF, add them in Gaussian coordinates with [`add_detail`].
///
/// ```
/// use asperity_ndf_sampling::{Beckmann, NoiseCdfRef, glam::Vec3, normal_map::NoiseChain};
///
/// // A noise that is uniform on ±1.
/// let chain = NoiseChain { ndf: Beckmann::isotropic(0.3)?, noise: NoiseCdfRef::new(1.0, &[0.0, 1.0])? };
/// assert_eq!(chain.normal([0.0, 0.0]), Vec3::Z);
/// let n = chain.normal([0.5, -0.8]);
/// let [r1, r2] = chain.noise_values(n);
/// assert!((r1 - 0.5).abs() < 1e-6 && (r2 + 0.8).abs() < 1e-6);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
///
/// Kautz, Heidrich, Seidel 2001, sections 4 and 7.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoiseChain<N, G> {
    /// The NDF of the normals.
    pub ndf: N,
    /// The distribution `G` of both noises.
    pub noise: G,
}

impl<N: Ndf, G: NoiseDistribution> NoiseChain<N, G> {
    /// `r → n`; accepts every input.
    #[inline]
    #[must_use]
    pub fn normal(&self, r: [f32; 2]) -> Vec3 {
        self.ndf.warp_gaussian(Vec2::from(r.map(|r| self.noise.gaussian(r))))
    }

    /// `n → u`, the uniform numbers of a normal, in `f64`, whose precision the upper tail near 1
    /// needs.
    #[inline]
    #[must_use]
    pub fn uniform(&self, n: Vec3) -> [f64; 2] {
        self.ndf.invert(n).to_array().map(|z| phi(f64::from(z)))
    }

    /// `n → r`, the noise values of a normal.
    #[inline]
    #[must_use]
    pub fn noise_values(&self, n: Vec3) -> [f32; 2] {
        self.ndf.invert(n).to_array().map(|z| self.noise.warp_gaussian(z))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Beckmann, Ggx, NoiseCdfRef};
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
    fn noise_chain_round_trips() {
        let table: [f32; 9] = core::array::from_fn(|k| (k * k) as f32 / 64.0);
        let noise = NoiseCdfRef::new(2.0, &table).unwrap();
        let chain = NoiseChain { ndf: Beckmann::new(0.2, 0.6).unwrap(), noise };
        for k in 1..40 {
            let r = [k as f32 * 0.1 - 2.0, 1.95 - k as f32 * 0.07];
            let back = chain.noise_values(chain.normal(r));
            assert_abs_diff_eq!(back[0], r[0], epsilon = 1e-5, "{r:?}");
            assert_abs_diff_eq!(back[1], r[1], epsilon = 1e-5, "{r:?}");
            let u = chain.uniform(chain.normal(r));
            assert_abs_diff_eq!(u[0], f64::from(noise.uniform(r[0])), epsilon = 1e-6, "{r:?}");
        }
    }
}
