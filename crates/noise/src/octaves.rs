//! Sums of octaves of any noise, with a real number of octaves.

use crate::{
    layer::Layer,
    noise::Noise,
    sample::Sample,
    space::Point,
    spectrum::{MAX_OCTAVES, Spectrum},
};

/// What a sum of octaves is divided by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Normalisation {
    /// Σ wᵢ aᵢ: the sum stays in [−1, 1]. Its variance shrinks as octaves are added.
    Range,
    /// σ₁ √Σ (wᵢ aᵢ)²: the sum has variance 1 for every number of octaves, and no bound of 1.
    #[default]
    Variance,
}

/// A sum of octaves of one kind of noise.
///
/// ```text
/// n(p) = Σ wᵢ aᵢ nᵢ(fᵢ Rᵢ p + oᵢ) / N
/// ```
///
/// with the weights, amplitudes and frequencies of a [`Spectrum`], N by [`Normalisation`], and an own seed, offset oᵢ and
/// rotation Rᵢ for every octave, so that octaves, and sums of different seeds, do not share lattice points.
/// No octaves give 0. As `octaves` → 0⁺ the first octave stays as it is, because it is normalised: fade it by
/// [`Spectrum::share`]. An octave whose coordinates overflow adds 0.
///
/// Nilsson 2008, "Procedural Generation of Natural Variations"; lacunarity after Ebert (ed.) 1994.
///
/// ```
/// use asperity_noise::{Normalisation, Octaves, Perlin2002, Spectrum, glam::Vec3};
///
/// let noise = Octaves::new(Perlin2002::default(), Spectrum::default(), Normalisation::Range, 5);
/// let sample = noise.sample(Vec3::new(0.4, 0.1, -3.0), 4.5);
/// assert!(sample.value.abs() <= 1.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Octaves<N, V: Point> {
    noise: N,
    spectrum: Spectrum,
    normalisation: Normalisation,
    layers: [Layer<V>; MAX_OCTAVES as usize],
}

impl<V: Point, N: Noise<V>> Octaves<N, V> {
    /// The sum of octaves of `noise` that `seed` selects.
    #[must_use]
    pub fn new(noise: N, spectrum: Spectrum, normalisation: Normalisation, seed: u32) -> Self {
        Self { noise, spectrum, normalisation, layers: Layer::all(&spectrum, seed) }
    }

    /// The spectrum of the sum.
    #[must_use]
    pub const fn spectrum(&self) -> &Spectrum {
        &self.spectrum
    }

    /// What the sum is divided by.
    #[must_use]
    pub const fn normalisation(&self) -> Normalisation {
        self.normalisation
    }

    /// Value and gradient of the first `octaves` octaves at `p`.
    #[must_use]
    #[inline]
    pub fn sample(&self, p: V, octaves: f32) -> Sample<V> {
        let octaves = lone_whole(octaves);
        let mut sum = Sample::default();
        for ((_, amplitude), layer) in self.spectrum.active(octaves).zip(&self.layers) {
            layer.accumulate(&mut sum, amplitude, self.noise.sample(layer.point(p), layer.seed));
        }
        let factor = self.factor(octaves);
        Sample { value: sum.value * factor, gradient: sum.gradient.scaled(factor) }
    }

    /// The measured standard deviation of the sum: 1 under [`Normalisation::Variance`], 0 without octaves.
    #[must_use]
    pub fn standard_deviation(&self, octaves: f32) -> f32 {
        let octaves = lone_whole(octaves);
        self.factor(octaves)
            * self.noise.statistics().standard_deviation
            * self.spectrum.root_sum_of_squares(octaves)
    }

    /// The excess kurtosis of the sum, from the measured one of the kind.
    #[must_use]
    pub fn excess_kurtosis(&self, octaves: f32) -> f32 {
        self.noise.statistics().excess_kurtosis * self.spectrum.kurtosis_ratio(octaves)
    }

    /// 1/N, or 0 without octaves.
    #[inline]
    fn factor(&self, octaves: f32) -> f32 {
        let norm = match self.normalisation {
            Normalisation::Range => self.spectrum.sum_of_amplitudes(octaves),
            Normalisation::Variance => {
                self.noise.statistics().standard_deviation * self.spectrum.root_sum_of_squares(octaves)
            }
        };
        if norm > 0.0 { 1.0 / norm } else { 0.0 }
    }
}

/// The count with a lone octave made whole: its weight cancels against the normalisation, or underflows in it.
#[inline]
pub(crate) fn lone_whole(octaves: f32) -> f32 {
    if octaves > 0.0 { octaves.max(1.0) } else { 0.0 }
}
