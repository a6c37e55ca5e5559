//! Spectra: frequency and amplitude per octave, and the fade of a fractional octave.

use crate::error::NoiseError;

/// [`FbmSpectrum::MAX_OCTAVES`].
pub(crate) const MAX_OCTAVES: u32 = FbmSpectrum::MAX_OCTAVES;

/// Lacunarity, gain and maximum number of octaves of a sum of noises.
///
/// ```text
/// fᵢ = lacunarityⁱ,   aᵢ = gainⁱ,   wᵢ = clamp(octaves − i, 0, 1),   i = 0, 1, …
/// ```
///
/// Amplitudes are proportional to f^−H, where H = −ln gain / ln lacunarity is the Hurst exponent of
/// fractional Brownian motion if 0 < H < 1. Above 1 the sum becomes smooth. At H ≤ 0 its finest
/// octave is at least as strong as any other.
///
/// The number of octaves is a real number. The last octave has a weight between 0 and 1 and fades
/// in as the number grows. Every method accepts this number. Negative and NaN numbers are taken as
/// 0, and numbers above the maximum as the maximum.
///
/// ```
/// use asperity_noise::FbmSpectrum;
///
/// let spectrum = FbmSpectrum::default();
/// assert_eq!(spectrum.resolved_variance(1.0), 0.75);
/// assert!(FbmSpectrum::new(2.17, -1.5, 8).is_err());
/// ```
#[doc(alias("hurst", "fbm"))]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "Arguments"))]
pub struct FbmSpectrum {
    lacunarity: f32,
    gain: f32,
    max_octaves: u32,
}

/// The serialized spectrum, which is deserialized through the constructor.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Arguments {
    lacunarity: f32,
    gain: f32,
    max_octaves: u32,
}

#[cfg(feature = "serde")]
impl TryFrom<Arguments> for FbmSpectrum {
    type Error = NoiseError;

    fn try_from(read: Arguments) -> Result<Self, NoiseError> {
        Self::new(read.lacunarity, read.gain, read.max_octaves)
    }
}

impl Default for FbmSpectrum {
    /// Lacunarity 2.17, gain 0.5, ten octaves.
    ///
    /// The lacunarity is not a round number, so that the lattices of neighboring octaves do not
    /// coincide.
    fn default() -> Self {
        Self { lacunarity: 2.17, gain: 0.5, max_octaves: 10 }
    }
}

impl FbmSpectrum {
    /// The maximum number of octaves of a sum.
    pub const MAX_OCTAVES: u32 = 16;

    /// Clouds: lacunarity 2, gain 0.5, ten octaves.
    ///
    /// After Nilsson 2008, section 4.1.5, which leaves the number of octaves open.
    pub const CLOUD: Self = Self { lacunarity: 2.0, gain: 0.5, max_octaves: 10 };

    /// Threads of a carpet: lacunarity 2, gain 1, three octaves.
    ///
    /// After Nilsson 2008, section 4.2.2. Use [`Signed`](crate::Signed) for all threads together,
    /// and [`Plasma`](crate::Plasma) to the seventh [`Power`](crate::ops::Power) for single
    /// threads.
    pub const THREADS: Self = Self { lacunarity: 2.0, gain: 1.0, max_octaves: 3 };

    /// One octave.
    pub(crate) const SINGLE: Self = Self { lacunarity: 2.0, gain: 0.5, max_octaves: 1 };

    /// Creates a spectrum of at most `max_octaves` octaves.
    ///
    /// With a gain below 1 these octaves are the first of an infinite spectrum. With a gain of 1 or
    /// more finer octaves are as strong or stronger, so the infinite spectrum has no sum, and the
    /// spectrum consists of these octaves only.
    ///
    /// # Errors
    ///
    /// If `lacunarity` is not above 1 or overflows the highest frequency, if `gain` is not positive
    /// and finite or overflows the fourth powers of the amplitudes, or if `max_octaves` is not in
    /// 1..=[`MAX_OCTAVES`](Self::MAX_OCTAVES).
    pub fn new(lacunarity: f32, gain: f32, max_octaves: u32) -> Result<Self, NoiseError> {
        let invalid = |parameter, value, rule| Err(NoiseError::Invalid { parameter, value, rule });
        if !(lacunarity > 1.0 && lacunarity.is_finite()) {
            return invalid("lacunarity", lacunarity, "finite and above 1");
        }
        if !(gain > 0.0 && gain.is_finite()) {
            return invalid("gain", gain, "finite and above 0");
        }
        if !(1..=MAX_OCTAVES).contains(&max_octaves) {
            let (parameter, value) = ("max_octaves", max_octaves);
            return Err(NoiseError::Count { parameter, value, min: 1, max: MAX_OCTAVES });
        }
        let spectrum = Self { lacunarity, gain, max_octaves };
        if !spectrum.frequency(max_octaves - 1).is_finite() {
            return invalid("lacunarity", lacunarity, "small enough for a finite highest frequency");
        }
        let squares = spectrum.sum_of_squares(max_octaves as f32);
        if !(squares * squares).is_finite() {
            return invalid("gain", gain, "small enough for finite fourth powers of amplitudes");
        }
        Ok(spectrum)
    }

    /// Returns the ratio of the frequencies of successive octaves.
    #[must_use]
    pub const fn lacunarity(&self) -> f32 {
        self.lacunarity
    }

    /// Returns the ratio of the amplitudes of successive octaves.
    #[doc(alias("hurst", "persistence", "roughness"))]
    #[must_use]
    pub const fn gain(&self) -> f32 {
        self.gain
    }

    /// Returns the maximum number of octaves.
    #[must_use]
    pub const fn max_octaves(&self) -> u32 {
        self.max_octaves
    }

    /// Returns fᵢ, the frequency of octave i relative to the first.
    #[must_use]
    pub fn frequency(&self, i: u32) -> f32 {
        power(self.lacunarity, i)
    }

    /// Returns aᵢ, the amplitude of octave i relative to the first.
    #[must_use]
    pub fn amplitude(&self, i: u32) -> f32 {
        power(self.gain, i)
    }

    /// Returns wᵢ, the weight of octave i in [0, 1].
    #[inline]
    #[must_use]
    pub fn weight(&self, octaves: f32, i: u32) -> f32 {
        (self.clamped(octaves) - i as f32).clamp(0.0, 1.0)
    }

    /// Returns Σ wᵢ aᵢ, the bound of a sum of noises of range 1.
    #[must_use]
    pub fn sum_of_amplitudes(&self, octaves: f32) -> f32 {
        self.active(octaves).fold(0.0, |sum, (_, a)| sum + a)
    }

    /// Returns √Σ (wᵢ aᵢ)², the standard deviation of a sum of independent noises of standard
    /// deviation 1.
    #[must_use]
    pub fn root_sum_of_squares(&self, octaves: f32) -> f32 {
        asperity_core::math::sqrt(self.sum_of_squares(octaves))
    }

    #[inline]
    fn sum_of_squares(&self, octaves: f32) -> f32 {
        self.active(octaves).fold(0.0, |sum, (_, a)| sum + a * a)
    }

    /// Returns the fraction of the spectrum's variance that the octaves carry, in [0, 1).
    ///
    /// ```text
    /// gain < 1:   resolved = Σ wᵢ² aᵢ² / Σ_{i ≥ 0} aᵢ² = (1 − gain²) Σ wᵢ² aᵢ²
    /// gain ≥ 1:   resolved = Σ wᵢ² aᵢ² / Σ_{i < max_octaves} aᵢ²
    /// ```
    ///
    /// The remaining octaves carry the rest. For a gain below 1 the spectrum is infinite and
    /// includes octaves beyond the maximum. Otherwise it ends at the maximum. The fraction grows
    /// continuously from 0 at `octaves` = 0 and is at most 1 − 2⁻²⁴.
    #[inline]
    #[must_use]
    pub fn resolved_variance(&self, octaves: f32) -> f32 {
        const BELOW_ONE: f32 = 1.0 - f32::EPSILON / 2.0;
        let sum = self.sum_of_squares(octaves);
        if self.gain < 1.0 {
            (sum * (1.0 - self.gain * self.gain)).min(BELOW_ONE)
        } else {
            (sum / self.sum_of_squares(self.max_octaves as f32)).min(BELOW_ONE)
        }
    }

    /// Returns the excess kurtosis of the sum relative to one octave.
    ///
    /// ```text
    /// κ/κ₁ = Σ wᵢ⁴ aᵢ⁴ / (Σ wᵢ² aᵢ²)²
    /// ```
    ///
    /// 1 where `octaves` ≤ 1.
    #[must_use]
    pub fn kurtosis_ratio(&self, octaves: f32) -> f32 {
        if self.clamped(octaves) <= 1.0 {
            return 1.0;
        }
        let (second, fourth) = self
            .active(octaves)
            .fold((0.0, 0.0), |(second, fourth), (_, a)| (second + a * a, fourth + a * a * a * a));
        fourth / (second * second)
    }

    /// The active octaves, each with wᵢ aᵢ.
    #[inline(always)]
    pub(crate) fn active(&self, octaves: f32) -> impl Iterator<Item = (usize, f32)> {
        let octaves = self.clamped(octaves);
        let gain = self.gain;
        let mut amplitude = 1.0;
        (0..self.max_octaves as usize).map_while(move |i| {
            let weight = (octaves - i as f32).min(1.0);
            let weighted = weight * amplitude;
            amplitude *= gain;
            (weight > 0.0).then_some((i, weighted))
        })
    }

    #[inline(always)]
    fn clamped(&self, octaves: f32) -> f32 {
        if octaves > 0.0 { octaves.min(self.max_octaves as f32) } else { 0.0 }
    }
}

/// baseⁱ by repeated multiplication, with the same bits everywhere.
fn power(base: f32, i: u32) -> f32 {
    (0..i).fold(1.0, |product, _| product * base)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn broken_rules_are_named() {
        fn invalid(
            parameter: &'static str,
            value: f32,
            rule: &'static str,
        ) -> Result<FbmSpectrum, NoiseError> {
            Err(NoiseError::Invalid { parameter, value, rule })
        }
        for lacunarity in [1.0, 0.5, 0.0, -2.0, f32::INFINITY] {
            let error = invalid("lacunarity", lacunarity, "finite and above 1");
            assert_eq!(FbmSpectrum::new(lacunarity, 0.5, 8), error);
        }
        assert!(matches!(
            FbmSpectrum::new(f32::NAN, 0.5, 8),
            Err(NoiseError::Invalid { parameter: "lacunarity", .. })
        ));
        for gain in [0.0, -0.5, f32::INFINITY] {
            let error = invalid("gain", gain, "finite and above 0");
            assert_eq!(FbmSpectrum::new(2.0, gain, 8), error);
        }
        assert!(matches!(
            FbmSpectrum::new(2.0, f32::NAN, 8),
            Err(NoiseError::Invalid { parameter: "gain", .. })
        ));
        let error = invalid("gain", 1e3, "small enough for finite fourth powers of amplitudes");
        assert_eq!(FbmSpectrum::new(2.0, 1e3, 8), error);
        assert!(FbmSpectrum::new(2.0, 1e3, 4).is_ok() && FbmSpectrum::new(1.5, 2.7, MAX_OCTAVES).is_ok());
        for value in [0, 17] {
            let error = NoiseError::Count { parameter: "max_octaves", value, min: 1, max: 16 };
            assert_eq!(FbmSpectrum::new(2.0, 0.5, value), Err(error));
        }
        let error = invalid("lacunarity", 1e4, "small enough for a finite highest frequency");
        assert_eq!(FbmSpectrum::new(1e4, 0.5, 16), error);
        assert!(FbmSpectrum::new(1e4, 0.5, 9).is_ok());
    }

    #[test]
    fn the_last_octave_fades_in() {
        let spectrum = FbmSpectrum::default();
        assert_eq!([0, 1, 2, 3].map(|i| spectrum.weight(2.25, i)), [1.0, 1.0, 0.25, 0.0]);
        assert_eq!(spectrum.sum_of_amplitudes(2.5), 1.0 + 0.5 + 0.125);
        assert_eq!(spectrum.root_sum_of_squares(1.0), 1.0);
        assert_eq!(spectrum.kurtosis_ratio(1.0), 1.0);
        assert_eq!(spectrum.kurtosis_ratio(2.0), (1.0 + 0.0625) / (1.25 * 1.25));
        assert_eq!(spectrum.kurtosis_ratio(1e-30), 1.0);
    }

    #[test]
    fn resolved_variance_rises_from_zero_and_stays_below_one() {
        let fractions = [0.0, 0.5, 1.0, 2.0].map(|octaves| FbmSpectrum::default().resolved_variance(octaves));
        assert_eq!(fractions, [0.0, 0.1875, 0.75, 0.9375]);
        for percent in 1..100_u8 {
            let gain = f32::from(percent) / 100.0;
            let spectrum = FbmSpectrum::new(2.0, gain, MAX_OCTAVES).unwrap();
            let mut last = 0.0;
            for step in 1..=160_u8 {
                let fraction = spectrum.resolved_variance(f32::from(step) / 10.0);
                assert!(
                    fraction >= last && fraction < 1.0,
                    "gain {gain}, step {step}: {fraction} after {last}"
                );
                last = fraction;
            }
        }
    }

    #[test]
    fn resolved_variance_of_a_gain_of_at_least_1_is_relative_to_all_octaves() {
        let equal = FbmSpectrum::new(2.0, 1.0, 4).unwrap();
        assert_eq!(
            [0.0, 1.0, 2.5, 3.0].map(|octaves| equal.resolved_variance(octaves)),
            [0.0, 0.25, 0.5625, 0.75]
        );
        let rising = FbmSpectrum::new(2.4, 2.0, 3).unwrap();
        assert_eq!([1.0, 2.0].map(|octaves| rising.resolved_variance(octaves)), [1.0 / 21.0, 5.0 / 21.0]);
        for spectrum in [equal, rising] {
            assert_eq!(spectrum.resolved_variance(9.0), 1.0 - f32::EPSILON / 2.0);
        }
    }

    #[test]
    fn the_named_spectra_keep_the_rules() {
        for FbmSpectrum { lacunarity, gain, max_octaves } in [FbmSpectrum::CLOUD, FbmSpectrum::THREADS] {
            assert!(FbmSpectrum::new(lacunarity, gain, max_octaves).is_ok());
        }
    }

    #[test]
    fn any_count_of_octaves_is_taken() {
        let spectrum = FbmSpectrum::default();
        for nothing in [0.0, -0.0, -3.0, f32::NEG_INFINITY, f32::NAN] {
            assert_eq!(spectrum.resolved_variance(nothing), 0.0, "{nothing}");
            assert_eq!(spectrum.weight(nothing, 0), 0.0, "{nothing}");
        }
        assert_eq!(spectrum.resolved_variance(f32::INFINITY), spectrum.resolved_variance(10.0));
    }
}
