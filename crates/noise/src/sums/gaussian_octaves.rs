//! Sums of octaves of Gaussian noise: N(0, 1) at every point, for every real number of octaves.

use crate::{
    contract::field::Field,
    contract::kernel::{LaneSample, samples, values},
    contract::point::Point,
    contract::sample::Sample,
    kinds::gaussian::Gaussian,
    math,
    simd::lanes::{Lanes, Scalar},
    sums::octave::{Layer, Rotation},
    sums::octaves::{lone_whole, scaled},
    sums::spectrum::{MAX_OCTAVES, Spectrum},
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
pub struct GaussianOctaves<const N: usize> {
    spectrum: Spectrum,
    layers: [Layer<N>; MAX_OCTAVES as usize],
}

impl<const N: usize> GaussianOctaves<N> {
    /// The sum that `seed` selects.
    #[must_use]
    pub fn new(spectrum: Spectrum, seed: u32) -> Self {
        Self { spectrum, layers: Layer::all(&spectrum, Rotation::Random, seed) }
    }

    /// The spectrum of the sum.
    #[must_use]
    pub const fn spectrum(&self) -> &Spectrum {
        &self.spectrum
    }

    /// Value and gradient of the first `octaves` octaves at `p`.
    #[must_use]
    #[inline]
    pub fn sample<V: Point<N>>(&self, p: V, octaves: f32) -> Sample<V> {
        let (value, gradient) = self.first(octaves).lane_samples(Scalar, p.coordinates());
        Sample { value, gradient: V::from_coordinates(gradient) }
    }

    /// The value of the first `octaves` octaves at `p`, the same bits as [`sample`](Self::sample)'s.
    #[must_use]
    #[inline]
    pub fn value<V: Point<N>>(&self, p: V, octaves: f32) -> f32 {
        self.first(octaves).lane_values(Scalar, p.coordinates())
    }

    /// Two channels from one walk of the lattices, independent of each other; the first is [`sample`](Self::sample)'s.
    #[must_use]
    #[inline]
    pub fn pair<V: Point<N>>(&self, p: V, octaves: f32) -> [Sample<V>; 2] {
        let octaves = lone_whole(octaves);
        let mut sums = [(0.0, [0.0; N]); 2];
        for ((_, amplitude), layer) in self.spectrum.active(octaves).zip(&self.layers) {
            let p = layer.points(Scalar, p.coordinates());
            let pair = Gaussian::default().channels(p, layer.seed);
            for (sum, sample) in sums.iter_mut().zip(pair) {
                layer.accumulate(Scalar, sum, amplitude, sample);
            }
        }
        let factor = self.factor(octaves);
        sums.map(|(value, gradient)| Sample {
            value: value * factor,
            gradient: V::from_coordinates(gradient.map(|g| g * factor)),
        })
    }

    /// The sum of the first `octaves` octaves, for a [`Batch`](crate::Batch).
    #[must_use]
    pub fn first(&self, octaves: f32) -> FirstGaussianOctaves<'_, N> {
        let octaves = lone_whole(octaves);
        FirstGaussianOctaves { sum: self, octaves, factor: self.factor(octaves) }
    }

    /// The share in [0, 1) of the endless spectrum's variance that `octaves` octaves resolve, [`Spectrum::share`].
    #[must_use]
    #[inline]
    pub fn share(&self, octaves: f32) -> f32 {
        self.spectrum.share(octaves)
    }

    /// 1/√Σ wᵢ² aᵢ², or 0 without octaves.
    #[inline(always)]
    fn factor(&self, octaves: f32) -> f32 {
        let variance = self.spectrum.active(octaves).fold(0.0, |sum, (_, a)| sum + a * a);
        if variance > 0.0 { 1.0 / math::sqrt(variance) } else { 0.0 }
    }
}

/// A sum of octaves of Gaussian noise with its number of octaves, as [`GaussianOctaves::first`] gives it.
#[derive(Clone, Copy, Debug)]
pub struct FirstGaussianOctaves<'a, const N: usize> {
    sum: &'a GaussianOctaves<N>,
    octaves: f32,
    factor: f32,
}

impl<const N: usize> FirstGaussianOctaves<'_, N> {
    /// The octaves that take part, each with its amplitude.
    #[inline(always)]
    pub(crate) fn active(&self) -> impl Iterator<Item = (f32, &Layer<N>)> {
        self.sum.spectrum.active(self.octaves).zip(&self.sum.layers).map(|((_, a), layer)| (a, layer))
    }

    #[inline(always)]
    pub(crate) fn factor(&self) -> f32 {
        self.factor
    }
}

impl<const N: usize> Field<N> for FirstGaussianOctaves<'_, N> {
    #[inline(always)]
    fn lane_values<S: Lanes>(&self, s: S, p: [S::F; N]) -> S::F {
        let mut sum = s.float(0.0);
        for (amplitude, layer) in self.active() {
            let value = values(&Gaussian::default(), s, layer.points(s, p), layer.seed);
            sum = sum + s.float(amplitude) * value;
        }
        sum * s.float(self.factor)
    }

    #[inline(always)]
    fn lane_samples<S: Lanes>(&self, s: S, p: [S::F; N]) -> LaneSample<S, N> {
        let mut sum = (s.float(0.0), [s.float(0.0); N]);
        for (amplitude, layer) in self.active() {
            let sample = samples(&Gaussian::default(), s, layer.points(s, p), layer.seed);
            layer.accumulate(s, &mut sum, s.float(amplitude), sample);
        }
        let factor = s.float(self.factor);
        scaled(s, sum, factor)
    }
}
