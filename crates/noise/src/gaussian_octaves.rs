//! Sums of octaves of Gaussian noise: N(0, 1) at every point, for every real number of octaves.

use crate::{
    integer_hash::IntegerHash,
    layer::Layer,
    math,
    octaves::lone_whole,
    sample::Sample,
    space::Point,
    spectrum::{MAX_OCTAVES, Spectrum},
};

/// A sum of octaves of Gaussian noise whose value at every point is N(0, 1), for every real number of octaves.
///
/// ```text
/// z(p) = Σ wᵢ aᵢ zᵢ(fᵢ Rᵢ p + oᵢ) / √Σ wᵢ² aᵢ²,   zᵢ = nᵢ/√vᵢ ~ N(0, 1)
/// ```
///
/// with the weights, amplitudes and frequencies of a [`Spectrum`], and an own seed, offset oᵢ and rotation Rᵢ for every
/// octave. Each octave is normalised by itself, so the share of the variance that an octave has is the same at every
/// point, wᵢ² aᵢ² / Σ wⱼ² aⱼ².
///
/// No octaves give value 0 and gradient 0. For 0 < `octaves` ≤ 1 the sum is the first octave, unattenuated: a fade comes
/// from [`share`](Self::share). Points that are not finite give 0.
///
/// ```
/// use asperity_noise::{GaussianOctaves, Spectrum, glam::Vec3};
///
/// let noise = GaussianOctaves::new(Spectrum::default(), 42);
/// let [first, second] = noise.pair(Vec3::new(0.1, 0.2, 0.3), 6.5);
/// assert_eq!(first, noise.sample(Vec3::new(0.1, 0.2, 0.3), 6.5));
/// assert!(first != second && noise.share(6.5) < 1.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GaussianOctaves<V: Point> {
    spectrum: Spectrum,
    layers: [Layer<V>; MAX_OCTAVES as usize],
}

impl<V: Point> GaussianOctaves<V> {
    /// The sum that `seed` selects.
    #[must_use]
    pub fn new(spectrum: Spectrum, seed: u32) -> Self {
        Self { spectrum, layers: Layer::all(&spectrum, seed) }
    }

    /// The spectrum of the sum.
    #[must_use]
    pub const fn spectrum(&self) -> &Spectrum {
        &self.spectrum
    }

    /// Value and gradient of the first `octaves` octaves at `p`.
    #[must_use]
    #[inline]
    pub fn sample(&self, p: V, octaves: f32) -> Sample<V> {
        let [sample] = self.channels::<1>(p, octaves);
        sample
    }

    /// Two channels from one walk of the lattices, independent of each other; the first is [`sample`](Self::sample)'s.
    #[must_use]
    #[inline]
    pub fn pair(&self, p: V, octaves: f32) -> [Sample<V>; 2] {
        self.channels::<2>(p, octaves)
    }

    /// The share in [0, 1) of the endless spectrum's variance that `octaves` octaves resolve, [`Spectrum::share`].
    #[must_use]
    #[inline]
    pub fn share(&self, octaves: f32) -> f32 {
        self.spectrum.share(octaves)
    }

    #[inline(always)]
    fn channels<const C: usize>(&self, p: V, octaves: f32) -> [Sample<V>; C] {
        let octaves = lone_whole(octaves);
        let mut sums = [Sample::default(); C];
        let mut variance = 0.0;
        for ((_, amplitude), layer) in self.spectrum.active(octaves).zip(&self.layers) {
            let samples = V::linear::<IntegerHash, C>(&IntegerHash, layer.point(p), layer.seed).normalised();
            for (sum, sample) in sums.iter_mut().zip(samples) {
                layer.accumulate(sum, amplitude, sample);
            }
            variance += amplitude * amplitude;
        }
        if variance == 0.0 {
            return sums;
        }
        let factor = 1.0 / math::sqrt(variance);
        sums.map(|sum| Sample { value: sum.value * factor, gradient: sum.gradient.scaled(factor) })
    }
}
