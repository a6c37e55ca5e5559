//! A weighted sum of two isotropic NDFs with a map from Gaussian coordinates.

use glam::{Vec2, Vec3};

use crate::coordinates::bounded;
use crate::density::blend::Blend;
use crate::error::NdfError;
use crate::microfacet::Microfacet;
use crate::ndf::{Ndf, forward};
use crate::radial::Radial;
use asperity_core::math;

/// The density `w D_a + (1 − w) D_b` of two isotropic NDFs.
///
/// ```text
/// D = w D_a + (1 − w) D_b
/// T(z): the slope t where −ln(w exp(−E_a(t)) + (1 − w) exp(−E_b(t))) = ρ²/2, direction of z;    ρ² = z₁² + z₂²
/// ```
///
/// There is one such slope between the slopes of the two NDFs at `ρ`. It is found by the rule of
/// false position, to 1e-9 relative, in 6 evaluations of both exponents on average.
/// [`BlinnPhong`](crate::BlinnPhong) with the exponent 0 is a diffuse lobe.
///
/// ```
/// use asperity_ndf_sampling::{BlinnPhong, Ggx, Mixture, Ndf, glam::Vec2};
///
/// // A glossy lobe on a third of the surface, a diffuse one on the rest.
/// let mixture = Mixture::new(Ggx::isotropic(0.1)?, BlinnPhong::new(0.0)?, 1.0 / 3.0)?;
/// let z = Vec2::new(0.7, -1.2);
/// assert!(mixture.invert(mixture.warp_gaussian(z)).abs_diff_eq(z, 1e-5));
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
///
/// Kautz, Heidrich, Seidel 2001, section 6. For NDFs that depend on the azimuth see [`Blend`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mixture<A, B> {
    blend: Blend<A, B>,
}

impl<A: Radial, B: Radial> Mixture<A, B> {
    /// Creates the sum of `weight · a` and `(1 − weight) · b`.
    ///
    /// # Errors
    /// A weight that is not between 0 and 1; an NDF that depends on the azimuth.
    pub fn new(a: A, b: B, weight: f32) -> Result<Self, NdfError> {
        for (parameter, exponent) in [("a", a.exponent(1.0)), ("b", b.exponent(1.0))] {
            if exponent.is_none() {
                return Err(NdfError::NotRadial { parameter });
            }
        }
        Ok(Self { blend: Blend::new(a, b, weight)? })
    }

    /// `E(t)` of the sum.
    fn sum(&self, slope: f64) -> f64 {
        let w = f64::from(self.blend.weight);
        // Radial, as checked by the constructor.
        let a = self.blend.a.exponent(slope).unwrap_or(0.0);
        let b = self.blend.b.exponent(slope).unwrap_or(0.0);
        if w >= 1.0 {
            a
        } else if w <= 0.0 {
            b
        } else if a.min(b) < 0.5 {
            // Where the weights are near 1.
            -math::ln_1p_f64(w * math::exp_m1_f64(-a) + (1.0 - w) * math::exp_m1_f64(-b))
        } else {
            let least = a.min(b);
            least - math::ln_f64(w * math::exp_f64(least - a) + (1.0 - w) * math::exp_f64(least - b))
        }
    }

    /// The slope `t` at which the exponent is `exponent`, between two slopes that enclose it.
    fn slope(&self, exponent: f64, low: f64, high: f64) -> f64 {
        // Both in logarithms, because near the zenith and in the tails of power laws the exponent
        // is a power of the slope.
        let at = |x: f64| math::ln_f64(self.sum(math::exp_f64(x)).max(f64::MIN_POSITIVE) / exponent);
        let (mut low, mut high) = (math::ln_f64(low), math::ln_f64(high));
        let (mut below, mut above) = (at(low), at(high));
        // Whether the last step moved the lower end.
        let mut moved_low = None;
        for _ in 0..MOST_STEPS {
            if high - low < 1e-9 || below >= 0.0 || above <= 0.0 {
                break;
            }
            let x = (low * above - high * below) / (above - below);
            // Near an end the rule is slow where the function bends. The middle is the safeguard.
            let x = if x > low && x < high { x } else { 0.5 * (low + high) };
            let value = at(x);
            if value.abs() < 1e-9 {
                return math::exp_f64(x);
            }
            // The Illinois rule: an end that stays twice counts half, so that it moves the next
            // time.
            if value < 0.0 {
                if moved_low == Some(true) {
                    above *= 0.5;
                }
                (low, below, moved_low) = (x, value, Some(true));
            } else {
                if moved_low == Some(false) {
                    below *= 0.5;
                }
                (high, above, moved_low) = (x, value, Some(false));
            }
        }
        math::exp_f64(if below >= 0.0 {
            low
        } else if above <= 0.0 {
            high
        } else {
            0.5 * (low + high)
        })
    }
}

/// More steps than the rule of false position needs (measured: 13).
const MOST_STEPS: u32 = 100;

/// The slope of the normal that `ndf` returns at `ρ`.
fn own_slope(ndf: &impl Ndf, rho: f32) -> f64 {
    let m = ndf.warp_gaussian(Vec2::new(rho, 0.0));
    f64::from(m.x.abs()) / f64::from(m.z.max(f32::MIN_POSITIVE))
}

/// The normal tilted by `slope` towards `z`, which is not 0.
#[inline]
pub(crate) fn tilted(z: Vec2, slope: f64) -> Vec3 {
    let (x, y) = (f64::from(z.x), f64::from(z.y));
    let up = 1.0 / math::sqrt_f64(1.0 + slope * slope);
    let across = slope * up / math::sqrt_f64(x * x + y * y);
    Vec3::new((x * across) as f32, (y * across) as f32, (up as f32).max(f32::MIN_POSITIVE))
}

/// The coordinates of `m` from its exponent as a function of the slope; NaN is read as 0.
#[inline]
pub(crate) fn untilted(m: Vec3, exponent: impl Fn(f64) -> f64) -> Vec2 {
    let (x, y) = (f64::from(m.x), f64::from(m.y));
    let length = math::sqrt_f64(x * x + y * y);
    let rho = math::sqrt_f64(2.0 * exponent(length / f64::from(m.z.max(f32::MIN_POSITIVE))));
    // The zenith is 0/0, which is read as 0.
    bounded(Vec2::new((x / length * rho) as f32, (y / length * rho) as f32))
}

impl<A: Radial, B: Radial> Ndf for Mixture<A, B> {
    forward! { |mixture| mixture.blend; d(m: Vec3) -> f32; sample(u: Vec2) -> Vec3; }

    fn warp_gaussian(&self, z: Vec2) -> Vec3 {
        let z = bounded(z);
        let (x, y) = (f64::from(z.x), f64::from(z.y));
        let exponent = 0.5 * (x * x + y * y);
        if exponent <= 0.0 {
            return Vec3::Z;
        }
        let rho = math::sqrt_f64(2.0 * exponent) as f32;
        let (a, b) = (own_slope(&self.blend.a, rho), own_slope(&self.blend.b, rho));
        // Enclosed, including the rounding of these slopes.
        let slope = self.slope(exponent, a.min(b) * (1.0 - 1e-5), a.max(b) * (1.0 + 1e-5));
        tilted(z, slope)
    }

    fn invert(&self, m: Vec3) -> Vec2 {
        untilted(m, |slope| self.sum(slope))
    }
}

impl<A: Radial + Microfacet, B: Radial + Microfacet> Microfacet for Mixture<A, B> {
    forward! { |mixture| mixture.blend;
        lambda(v: Vec3) -> f32;
        projected_area(v: Vec3) -> f32;
        sample_visible(v: Vec3, u: Vec2) -> Vec3;
    }
}

impl<A: Radial, B: Radial> Radial for Mixture<A, B> {
    fn exponent(&self, slope: f64) -> Option<f64> {
        Some(self.sum(slope))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Beckmann, BlinnPhong, Ggx};
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn mixture_of_equal_ndfs_is_the_same_ndf() {
        let ggx = Ggx::isotropic(0.3).unwrap();
        for weight in [0.0, 0.3, 1.0] {
            let mixture = Mixture::new(ggx, ggx, weight).unwrap();
            for z in [Vec2::new(0.7, -1.2), Vec2::ZERO, Vec2::new(-9.0, 9.0), Vec2::new(1e-6, 1e-7)] {
                let m = ggx.warp_gaussian(z);
                assert_abs_diff_eq!(mixture.warp_gaussian(z), m, epsilon = 1e-6, "{weight} {z}");
                assert_abs_diff_eq!(mixture.invert(m), z, epsilon = 4e-6, "{weight} {z}");
            }
        }
    }

    #[test]
    fn round_trip_and_slopes_between_both_ndfs() {
        let (narrow, wide) = (Beckmann::isotropic(0.02).unwrap(), BlinnPhong::new(0.0).unwrap());
        let mixture = Mixture::new(narrow, wide, 0.7).unwrap();
        let nested = Mixture::new(mixture, Ggx::isotropic(0.4).unwrap(), 0.5).unwrap();
        for k in 1..=240 {
            let z = Vec2::new(0.6, -0.8) * (k as f32 * 0.05);
            for ndf in [&mixture as &dyn Ndf, &nested] {
                let back = ndf.invert(ndf.warp_gaussian(z));
                assert_abs_diff_eq!(back, z, epsilon = 2e-5, "{z}");
            }
            let (m, z1) = (mixture.warp_gaussian(z).z, narrow.warp_gaussian(z).z);
            assert!(m <= z1 + 1e-6 && m >= wide.warp_gaussian(z).z - 1e-6, "{z}");
        }
    }
}
