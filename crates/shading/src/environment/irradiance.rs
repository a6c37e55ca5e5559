//! The irradiance of an environment as nine coefficients.

use core::f32::consts::{FRAC_1_PI, PI};

use glam::{Vec2, Vec3};

use crate::environment::interface::{Environment, is_direction, uniform_sphere};
use crate::math::sqrt;

/// Irradiance of an environment by surface normal: spherical harmonics up to order 2.
///
/// ```text
/// E(n) = ∫ L(ω) max(0, n·ω) dω ≈ Σ A_l L_lm Y_lm(n),   L_lm = ∫ L Y_lm dω,   A₀ = π, A₁ = 2π/3, A₂ = π/4,   l ≤ 2
/// ```
///
/// [`Lambert`](crate::Lambert) with albedo ρ reflects `ρ E(n)/π`.
///
/// - **Error:** the higher orders of the light are omitted. The deviation is 0.5 % of the mean
///   irradiance for a soft sky and 5.5 % where a sun brings most of the light, at most 1 % and 13
///   %, measured against sampled light over all normals. Values below 0 are clamped to 0.
/// - **Domain:** the length of the normal is ignored; 0 for an invalid normal.
///
/// Ramamoorthi, Hanrahan 2001, *An Efficient Representation for Irradiance Environment Maps*, eq. 5
/// to 9.
///
/// ```
/// use asperity_shading::{Irradiance, glam::Vec3};
///
/// let even = Irradiance::new(&Vec3::splat(0.5), 64);
/// assert!((even.at(Vec3::X) - Vec3::splat(0.5 * core::f32::consts::PI)).length() < 1e-3);
/// ```
#[doc(alias = "spherical harmonics")]
#[doc(alias = "ibl")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Irradiance {
    /// `A_l L_lm` for the polynomials of [`harmonics`].
    coefficients: [Vec3; 9],
}

impl Irradiance {
    /// Computes the irradiance of an environment from `2 rows²` directions of equal solid angle.
    ///
    /// For an image use at least twice its rows. 0 rows are read as 1.
    #[must_use]
    pub fn new<E: Environment + ?Sized>(environment: &E, rows: u32) -> Self {
        let rows = rows.max(1);
        let mut coefficients = [Vec3::ZERO; 9];
        let weight = 2.0 * PI / (rows as f32 * rows as f32);
        for row in 0..rows {
            // By rows, so that few terms are added to a much larger sum.
            let mut sums = [Vec3::ZERO; 9];
            for column in 0..2 * rows {
                let w = uniform_sphere(Vec2::new(
                    (column as f32 + 0.5) / (2.0 * rows as f32),
                    (row as f32 + 0.5) / rows as f32,
                ));
                let radiance = environment.radiance(w);
                for (sum, y) in sums.iter_mut().zip(harmonics(w)) {
                    *sum += radiance * y;
                }
            }
            for (total, sum) in coefficients.iter_mut().zip(sums) {
                *total += sum * weight;
            }
        }
        for (coefficient, band) in coefficients.iter_mut().zip([0, 1, 1, 1, 2, 2, 2, 2, 2]) {
            *coefficient *= [PI, 2.0 * PI / 3.0, 0.25 * PI][band];
        }
        Self { coefficients }
    }

    /// The irradiance `E(n)`, at least 0.
    #[must_use]
    pub fn at(&self, normal: Vec3) -> Vec3 {
        if !is_direction(normal) {
            return Vec3::ZERO;
        }
        let n = (normal / normal.abs().max_element()).normalize_or_zero();
        let sum = self.coefficients.iter().zip(harmonics(n)).fold(Vec3::ZERO, |sum, (c, y)| sum + *c * y);
        sum.max(Vec3::ZERO)
    }
}

/// The real spherical harmonics `Y₀₀, Y₁₋₁ … Y₂₂`, orthonormal on the sphere.
fn harmonics(Vec3 { x, y, z }: Vec3) -> [f32; 9] {
    // ½√(1/π) and its multiples: ½√(3/π), ½√(15/π), ¼√(5/π), ¼√(15/π).
    let [one, three, five, fifteen] = [1.0, 3.0, 5.0, 15.0].map(|k: f32| 0.5 * sqrt(k * FRAC_1_PI));
    [
        one,
        three * y,
        three * z,
        three * x,
        fifteen * x * y,
        fifteen * y * z,
        0.5 * five * (3.0 * z * z - 1.0),
        fifteen * x * z,
        0.5 * fifteen * (x * x - y * y),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    /// Light that is linear or quadratic in the direction.
    struct Tinted;

    impl Environment for Tinted {
        fn radiance(&self, w: Vec3) -> Vec3 {
            Vec3::new(1.0 + w.x, 1.0 + w.y * w.z, 2.0 * w.z * w.z)
        }
    }

    #[test]
    fn irradiance_of_low_order_light_is_exact() {
        let irradiance = Irradiance::new(&Tinted, 64);
        for k in 0..50 {
            let n = uniform_sphere(Vec2::new(0.37 * k as f32 % 1.0, k as f32 / 49.0));
            // ∫ x max(0, n·ω) = 2π/3 n_x; of yz π/4 n_y n_z; of z² − ⅓ the same.
            let z2 = 0.25 * PI * (n.z * n.z - 1.0 / 3.0) + PI / 3.0;
            let expected = Vec3::new(PI + 2.0 * PI / 3.0 * n.x, PI + 0.25 * PI * n.y * n.z, 2.0 * z2);
            // Measured: 2.2e-3, from the midpoint rule in z.
            assert_abs_diff_eq!(irradiance.at(3.0 * n), expected, epsilon = 3e-3, "{n}");
        }
    }

    #[test]
    fn accepts_every_input() {
        let bright = Irradiance::new(&Tinted, 0);
        for bad in [Vec3::ZERO, Vec3::NAN, Vec3::INFINITY] {
            assert_eq!(bright.at(bad), Vec3::ZERO);
        }
        assert!(bright.at(Vec3::splat(1e-40)).is_finite() && bright.at(Vec3::MAX).min_element() >= 0.0);
    }
}
