//! Gas as a density in space, steam, and light through it.

use asperity_noise::{Fbm, FbmSpectrum, Field, Normalization, Perlin, Turbulence};
use glam::Vec3;

use crate::error::ShadingError;
use crate::math::{clamp_to, exp, floor, pow, sin, sqrt};
use crate::parameter::positive;
use crate::pixel::Footprint;

/// Gas: turbulence raised to a power.
///
/// ```text
/// density(p) = (max_density · t(p))^exponent,   t = Σ |nᵢ(fᵢ p)|/fᵢ / Σ 1/fᵢ
/// ```
///
/// or with `t` replaced by `(1 + sin πt)/2`, for veins. Cohen, *Procedural Bump Mapping and Noise*,
/// listings `turbulence` and `gas`. There the sum is not divided, which only scales `max_density`.
///
/// ```
/// use asperity_shading::texture::Gas;
/// use asperity_shading::glam::Vec3;
///
/// let gas = Gas::default();
/// let density = gas.density(Vec3::new(0.3, 1.2, -0.4));
/// assert!(density >= 0.0 && density <= gas.densest());
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Gas<K = Perlin> {
    turbulence: Fbm<K, Vec3, Turbulence>,
    max_density: f32,
    exponent: f32,
    veins: bool,
}

/// Five octaves of Perlin noise at lacunarity 2.17, maximum density 2, exponent 3.
impl Default for Gas {
    fn default() -> Self {
        let octaves =
            Fbm::new(Perlin::new(0), FbmSpectrum::default()).with_normalization(Normalization::UnitRange);
        Self {
            turbulence: octaves.with_shape(Turbulence).with_octaves(5.0),
            max_density: 2.0,
            exponent: 3.0,
            veins: false,
        }
    }
}

impl<K: Field<Vec3>> Gas<K> {
    /// Creates gas from the octaves of a turbulence.
    ///
    /// # Errors
    /// [`ShadingError`] unless `max_density` and `exponent` are finite and positive.
    pub fn new(
        turbulence: Fbm<K, Vec3, Turbulence>,
        max_density: f32,
        exponent: f32,
    ) -> Result<Self, ShadingError> {
        positive("max_density", max_density)?;
        positive("exponent", exponent)?;
        Ok(Self { turbulence, max_density, exponent, veins: false })
    }

    /// Adds veins: the sine of the turbulence.
    #[must_use]
    pub fn with_veins(self) -> Self {
        Self { veins: true, ..self }
    }

    /// The turbulence; octaves, maximum density, exponent; whether there are veins.
    pub(crate) const fn parts(&self) -> (&Fbm<K, Vec3, Turbulence>, [f32; 3], bool) {
        (&self.turbulence, [self.turbulence.octaves(), self.max_density, self.exponent], self.veins)
    }

    /// The density at a point, at least 0; the density without turbulence if the point is not
    /// finite.
    #[must_use]
    pub fn density(&self, p: Vec3) -> f32 {
        self.of(self.turbulence.value(p))
    }

    /// The density as seen by a pixel: the mean over unresolved octaves.
    ///
    /// The turbulence of the resolved octaves, with the mean of the others, is evaluated at three
    /// points of the distribution of the unresolved sum (Gauss–Hermite quadrature). The density of
    /// the mean is less than the mean density, by 36 % for the gas of the lecture. This
    /// approximation errs by 1.4 %.
    #[must_use]
    pub fn clamped_density(&self, p: Vec3, footprint: Footprint) -> f32 {
        let mean = self.turbulence.value_band_limited(p, footprint.width());
        let apart = sqrt(3.0 * self.removed(footprint));
        if apart > 0.0 {
            let sides = self.of((mean - apart).max(0.0)) + self.of(mean + apart);
            (2.0 / 3.0) * self.of(mean) + sides / 6.0
        } else {
            self.of(mean)
        }
    }

    /// The variance of the turbulence that a pixel of this footprint does not resolve.
    fn removed(&self, footprint: Footprint) -> f32 {
        let spectrum = self.turbulence.spectrum();
        let absolute = self.turbulence.field().moments().map_or([0.0; 4], |moments| moments.absolute);
        let [first, second, ..] = absolute;
        let mut sum = 0.0;
        for i in 0..spectrum.max_octaves() {
            let kept = footprint.kept(spectrum.frequency(i));
            let amplitude = spectrum.weight(self.turbulence.octaves(), i) * spectrum.amplitude(i);
            sum += amplitude * amplitude * (1.0 - kept * kept);
        }
        let total = spectrum.sum_of_amplitudes(self.turbulence.octaves());
        if total > 0.0 { sum * (second - first * first) / (total * total) } else { 0.0 }
    }

    /// An upper bound of the density.
    #[must_use]
    pub fn densest(&self) -> f32 {
        pow(self.max_density, self.exponent).min(f32::MAX)
    }

    fn of(&self, turbulence: f32) -> f32 {
        let t = clamp_to(turbulence, 1.0);
        let t = if self.veins { 0.5 + 0.5 * sin(core::f32::consts::PI * t) } else { t };
        let base = self.max_density * t;
        // A few factors in place of a logarithm and an exponential.
        let power = match self.exponent {
            2.0 => base * base,
            3.0 => base * base * base,
            4.0 => (base * base) * (base * base),
            8.0 => {
                let square = base * base;
                (square * square) * (square * square)
            }
            exponent => pow(base, exponent),
        };
        power.min(f32::MAX)
    }
}

/// Steam over a cup: a slab of gas that thins out with the distance from its axis and the height.
///
/// ```text
/// share(p) = (1 − smoothstep(0, 1, d/radius)) · (1 − z/height)   for 0 ≤ z ≤ height, else 0
/// ```
///
/// with `z` the height above the surface of the tea and `d` the distance from its axis. Cohen,
/// *Procedural Bump Mapping and Noise*, "Placing and Shaping Gas": attenuated by the distance from
/// the center of the surface of the tea and by the height above it.
///
/// ```
/// use asperity_shading::texture::Steam;
/// use asperity_shading::glam::Vec3;
///
/// let steam = Steam::new(Vec3::new(0.0, 0.0, 0.8), 0.5, 1.5)?;
/// assert_eq!(steam.share(Vec3::new(0.0, 0.0, 0.8)), 1.0);
/// assert_eq!(steam.share(Vec3::new(0.6, 0.0, 1.0)), 0.0);
/// # Ok::<(), asperity_shading::ShadingError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steam {
    center: Vec3,
    radius: f32,
    height: f32,
}

impl Steam {
    /// Creates steam over a surface of tea with this center; z points up.
    ///
    /// # Errors
    /// [`ShadingError`] unless radius and height are finite and positive.
    pub fn new(center: Vec3, radius: f32, height: f32) -> Result<Self, ShadingError> {
        Ok(Self { center, radius: positive("radius", radius)?, height: positive("height", height)? })
    }

    /// The interval of a ray inside the slab, in units of the length of the direction.
    ///
    /// An interval with reversed ends means that the ray misses.
    ///
    /// Outside of it [`share`](Self::share) is 0. A [`march`] through it, extended by a step at
    /// both ends, returns the same bits as one along the whole ray.
    ///
    /// ```
    /// use asperity_shading::texture::Steam;
    /// use asperity_shading::glam::Vec3;
    ///
    /// let steam = Steam::new(Vec3::ZERO, 0.5, 2.0)?;
    /// assert_eq!(steam.interval(Vec3::new(-3.0, 0.0, 1.0), Vec3::X), [2.5, 3.5]);
    /// let [near, far] = steam.interval(Vec3::new(-3.0, 0.0, 2.5), Vec3::X);
    /// assert!(near > far);
    /// # Ok::<(), asperity_shading::ShadingError>(())
    /// ```
    #[must_use]
    pub fn interval(&self, origin: Vec3, direction: Vec3) -> [f32; 2] {
        const NOWHERE: [f32; 2] = [f32::INFINITY, f32::NEG_INFINITY];
        let from = origin - self.center;
        let (p, d) = (from.truncate(), direction.truncate());
        // |p + t d|² = radius², in halves of its coefficients.
        let (square, half) = (d.dot(d), p.dot(d));
        let root = sqrt(half * half - square * (p.dot(p) - self.radius * self.radius));
        let round = if square > 0.0 {
            [(-half - root) / square, (-half + root) / square]
        } else if p.dot(p) < self.radius * self.radius {
            [f32::NEG_INFINITY, f32::INFINITY]
        } else {
            NOWHERE
        };
        let [bottom, top] = [0.0, self.height].map(|z| (z - from.z) / direction.z);
        let upright = if direction.z != 0.0 {
            [bottom.min(top), bottom.max(top)]
        } else if (0.0..=self.height).contains(&from.z) {
            [f32::NEG_INFINITY, f32::INFINITY]
        } else {
            NOWHERE
        };
        let [near, far] = [round[0].max(upright[0]), round[1].min(upright[1])];
        // The root of a negative number is NaN, which comparisons detect.
        if near <= far && round[0] <= round[1] { [near, far] } else { NOWHERE }
    }

    /// The fraction of gas at a point, in `[0, 1]`; 0 where the point is not finite.
    #[must_use]
    pub fn share(&self, p: Vec3) -> f32 {
        let from = p - self.center;
        let d = sqrt(from.x * from.x + from.y * from.y) / self.radius;
        let z = from.z / self.height;
        // Written so that NaN is outside.
        if !(d < 1.0 && (0.0..=1.0).contains(&z)) {
            return 0.0;
        }
        (1.0 - d * d * (3.0 - 2.0 * d)) * (1.0 - z)
    }
}

/// Light and transmittance along a ray through gas.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// The light that the gas adds, in the unit of the result of `light`.
    pub light: Vec3,
    /// The transmittance, in `[0, 1]`.
    pub transmittance: f32,
}

/// Marches a ray through gas and returns light and transmittance.
///
/// ```text
/// L = Σ_k T_k (1 − e^(−σ_k Δ)) light(x_k),   T_(k+1) = T_k e^(−σ_k Δ),   x_k = origin + (k + offset) Δ direction
/// ```
///
/// - **Steps** are at integer multiples of the step from the origin of the ray, shifted by `offset`
///   in `[0, 1]`, regardless of where the interval begins and ends. The gas of a shape that moves
///   or is clipped therefore does not swim. The first and the last step are weighted by their part
///   inside the interval. There are at most 65,536 steps; a longer interval has longer steps.
/// - `extinction(x)` is σ per unit of length, for scattering and absorption; negative and NaN
///   values are read as 0.
/// - `interval` is an interval of the ray, in units of the length of the direction; empty or NaN
///   intervals are clear.
/// - **Accuracy:** exact where extinction and light are constant; otherwise of second order in the
///   step for an offset of 1/2.
///
/// ```
/// use asperity_shading::texture::march;
/// use asperity_shading::glam::Vec3;
///
/// // Fog of extinction 0.5 over a length of 2 transmits 1/e for any step.
/// let seen = march(Vec3::ZERO, Vec3::X, [1.0, 3.0], 0.3, 0.5, |_| 0.5, |_| Vec3::ONE);
/// assert!((seen.transmittance - (-1.0f32).exp()).abs() < 1e-6);
/// assert!((seen.light.x + seen.transmittance - 1.0).abs() < 1e-6);
/// ```
#[must_use]
pub fn march(
    origin: Vec3,
    direction: Vec3,
    interval: [f32; 2],
    step: f32,
    offset: f32,
    extinction: impl Fn(Vec3) -> f32,
    light: impl Fn(Vec3) -> Vec3,
) -> Seen {
    let mut seen = Seen { light: Vec3::ZERO, transmittance: 1.0 };
    let [near, far] = interval;
    let length = far - near;
    if !(length > 0.0 && length.is_finite() && near.is_finite()) {
        return seen;
    }
    let step = if step > length / MOST_STEPS { step.min(1e30) } else { length / MOST_STEPS };
    let offset = clamp_to(offset, 1.0);
    let mut k = floor(near / step);
    for _ in 0..MOST_STEPS as u32 + 2 {
        let (begin, end) = ((k * step).max(near), ((k + 1.0) * step).min(far));
        if begin >= far || seen.transmittance < 1e-6 {
            break;
        }
        let x = origin + direction * ((k + offset) * step).clamp(near, far);
        let sigma = clamp_to(extinction(x), f32::MAX);
        if sigma > 0.0 && end > begin {
            let through = exp(-sigma * (end - begin));
            seen.light += seen.transmittance * (1.0 - through) * light(x);
            seen.transmittance *= through;
        }
        k += 1.0;
    }
    seen
}

const MOST_STEPS: f32 = 65536.0;

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn clamped_density_is_the_mean_density() {
        let gas = Gas::default();
        let point = |k: u16| 7.3 * f32::from(k) * Vec3::new(0.819_172_5, 0.671_043_6, 0.549_700_5);
        let mean = (0..20_000).map(|k| gas.density(point(k))).sum::<f32>() / 20_000.0;
        let far = gas.clamped_density(Vec3::ZERO, Footprint::from_width(100.0));
        let of_mean = gas.of(gas.turbulence.band_limited(100.0).value(Vec3::ZERO));
        // Standard deviations of densities are about their mean: 0.7 % of it. The third moment of
        // the turbulence is omitted; measured: 1.4 %.
        assert_abs_diff_eq!(far / mean, 1.0, epsilon = 0.04);
        assert!(of_mean < 0.85 * mean, "{of_mean} for {mean}");
    }

    #[test]
    fn density_matches_the_listing() {
        let gas = Gas::default();
        for i in 0..100 {
            let p = Vec3::new(0.37 * i as f32, 1.1, -0.21 * i as f32);
            let t = gas.turbulence.value_with_octaves(p, 5.0);
            assert_abs_diff_eq!(gas.density(p), (2.0 * t).powi(3), epsilon = 1e-6 * gas.density(p) + 1e-9);
            let veins = gas.with_veins().density(p);
            let expected = (1.0 + (t * core::f32::consts::PI).sin()).powi(3);
            assert_abs_diff_eq!(veins, expected, epsilon = 1e-5 * expected);
        }
    }

    #[test]
    fn density_is_a_power_of_the_turbulence_for_every_exponent() {
        let turbulence = Gas::default().turbulence;
        for exponent in [0.5, 1.0, 2.0, 3.0, 4.0, 5.5, 8.0] {
            let gas = Gas::new(turbulence.with_octaves(3.5), 1.5, exponent).unwrap();
            let (of, numbers, veins) = gas.parts();
            assert_eq!((numbers, veins), ([3.5, 1.5, exponent], false));
            for i in 0..20_u8 {
                let p = Vec3::new(0.37, 1.1, -0.21) * f32::from(i);
                let expected = (1.5 * of.value(p)).powf(exponent);
                assert_abs_diff_eq!(of.value(p), turbulence.value_with_octaves(p, 3.5), epsilon = 1e-6);
                // Roundings of logarithm and exponential, times the exponent.
                assert_abs_diff_eq!(gas.density(p), expected, epsilon = 5e-6 * expected);
                assert!(gas.density(p) <= gas.densest());
            }
            assert!(gas.with_veins().parts().2);
        }
        for bad in [0.0, -1.0, f32::NAN, f32::INFINITY] {
            for [max_density, exponent] in [[bad, 3.0], [2.0, bad]] {
                assert!(Gas::new(turbulence, max_density, exponent).is_err(), "{max_density}, {exponent}");
            }
        }
    }

    #[test]
    fn unresolved_gas_is_uniform() {
        let gas = Gas::default();
        let far = |x: f32| gas.clamped_density(Vec3::splat(x), Footprint::from_width(100.0));
        assert!((far(0.3) - far(7.9)).abs() < 1e-6 && far(0.3) > 0.0);
        assert_eq!(gas.clamped_density(Vec3::ONE, Footprint::from_width(1e-6)), gas.density(Vec3::ONE));
    }

    #[test]
    fn steam_ends_at_its_bounds() {
        let steam = Steam::new(Vec3::ZERO, 1.0, 2.0).unwrap();
        assert_eq!(steam.share(Vec3::new(0.0, 0.0, 2.0)), 0.0);
        assert_eq!(steam.share(Vec3::new(0.0, 0.0, -0.01)), 0.0);
        assert_abs_diff_eq!(steam.share(Vec3::new(0.5, 0.0, 1.0)), 0.25, epsilon = 1e-6);
        for bad in [Vec3::NAN, Vec3::INFINITY, Vec3::new(0.0, f32::NAN, 0.5)] {
            assert_eq!(steam.share(bad), 0.0);
        }
    }

    #[test]
    fn share_is_zero_outside_of_the_interval() {
        let steam = Steam::new(Vec3::new(0.3, -0.2, 0.5), 0.8, 1.9).unwrap();
        let mut inside = 0;
        for i in 0..400_u16 {
            let turn = 0.7 * f32::from(i);
            let origin = Vec3::new(3.0 * turn.cos(), 3.0 * turn.sin(), 0.02 * f32::from(i % 150) - 0.5);
            let aim =
                Vec3::new(0.3 + (2.3 * turn).sin(), -0.2 + (1.7 * turn).cos(), 0.03 * f32::from(i % 97));
            let axes = [(aim - origin).normalize(), Vec3::X, Vec3::Z, Vec3::new(1.0, 1.0, 0.0)];
            let direction = axes[usize::from(i % 4)];
            let origin = if i % 4 == 2 { Vec3::new(aim.x, aim.y, -1.0) } else { origin };
            let interval = steam.interval(origin, direction);
            let [near, far] = interval;
            for k in 0..600_u16 {
                let t = 0.02 * f32::from(k) - 1.0;
                let share = steam.share(origin + direction * t);
                // Roundings of the point.
                assert!(
                    share == 0.0 || (near - 1e-5..=far + 1e-5).contains(&t),
                    "{i}, {t}: {share} {interval:?}"
                );
                inside += u16::from(share > 0.0);
            }
            let step = 0.06;
            let sigma = |p: Vec3| 3.0 * steam.share(p);
            let [whole, part] = [[-1.0, 11.0], [(near - step).max(-1.0), (far + step).min(11.0)]]
                .map(|interval| march(origin, direction, interval, step, 0.3, sigma, |x| x));
            assert_eq!(whole, part, "{i}");
        }
        assert!(inside > 5000, "{inside}");
        for bad in [Vec3::NAN, Vec3::INFINITY, Vec3::ZERO] {
            let [near, far] = steam.interval(bad, bad);
            assert!(near > far, "{bad}: {near}, {far}");
        }
    }

    #[test]
    fn clipping_an_interval_does_not_move_its_steps() {
        let sigma = |x: Vec3| 0.5 + 0.5 * (9.0 * x.x).sin();
        let whole = march(Vec3::ZERO, Vec3::X, [0.0, 4.0], 0.25, 0.5, sigma, |x| x);
        let (a, b) = (
            march(Vec3::ZERO, Vec3::X, [0.0, 1.5], 0.25, 0.5, sigma, |x| x),
            march(Vec3::ZERO, Vec3::X, [1.5, 4.0], 0.25, 0.5, sigma, |x| x),
        );
        assert_abs_diff_eq!(a.transmittance * b.transmittance, whole.transmittance, epsilon = 1e-6);
        assert!((a.light + a.transmittance * b.light - whole.light).length() < 1e-5);
    }

    #[test]
    fn march_converges_with_the_square_of_the_step() {
        let sigma = |x: Vec3| x.x * x.x;
        let error = |step: f32| {
            let seen = march(Vec3::ZERO, Vec3::X, [0.0, 1.0], step, 0.5, sigma, |_| Vec3::ONE);
            (seen.transmittance - (-1.0f32 / 3.0).exp()).abs()
        };
        assert!(
            error(0.125) < 2e-3 && error(0.0625) < 0.3 * error(0.125),
            "{} {}",
            error(0.125),
            error(0.0625)
        );
    }

    #[test]
    fn march_accepts_opaque_and_empty_gas() {
        let murky = march(Vec3::ZERO, Vec3::X, [0.0, 1.0], 0.1, 0.5, |_| f32::INFINITY, |_| Vec3::ONE);
        assert_eq!(murky.transmittance, 0.0);
        let clear = march(Vec3::ZERO, Vec3::X, [0.0, 1.0], 0.1, 0.5, |_| f32::NAN, |_| Vec3::ONE);
        assert_eq!(clear.transmittance, 1.0);
    }
}
