//! fBm of simplex noise by position, filtered by the footprint.

use asperity_noise::{
    Fbm, FbmSpectrum, Field, Noise, NoiseError, Normalization, Sample, Simplex, filtered_fraction,
};
use glam::Vec3;

use crate::error::ShadingError;
use crate::parameter::within;
use crate::pixel::Footprint;

/// The variance of each component of ∇N of one octave, per cell squared: measured over 1.6·10⁷
/// points.
pub(crate) const SLOPE_VARIANCE: f32 = 3.08;

/// The maximum number of octaves of flakes and dents.
pub(crate) const DETAIL: [f32; 2] = [1.0, 8.0];

/// A spectrum of `detail` octaves.
pub(crate) fn spectrum(
    parameter: &'static str,
    [lacunarity, gain]: [f32; 2],
    detail: u32,
) -> Result<FbmSpectrum, ShadingError> {
    // Octaves are few, so the cast is exact; invalid counts are rejected anyway.
    let value = within(parameter, detail as f32, DETAIL)?;
    FbmSpectrum::new(lacunarity, gain, detail).map_err(|_: NoiseError| ShadingError::OutOfRange {
        parameter,
        value,
        min: DETAIL[0],
        max: DETAIL[1],
    })
}

/// A sum of octaves Σ aᵢ N(fᵢ p/size)/Σ aᵢ of continuous simplex noise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SizedFbm<K = Simplex> {
    /// The whole sum.
    octaves: Fbm<K, Vec3>,
    frequency: f32,
    /// The frequency of the last octave over the frequency of the first.
    highest: f32,
}

impl SizedFbm {
    /// Creates the sum of all octaves of a spectrum, the first of this size.
    pub(crate) fn new(spectrum: FbmSpectrum, size: f32, seed: u32) -> Self {
        Self::of(Simplex::new(0), spectrum, size, seed)
    }

    /// Creates a single octave.
    pub(crate) fn single(size: f32, seed: u32) -> Self {
        let cloud = Self::new(FbmSpectrum::CLOUD, size, seed);
        Self { octaves: cloud.octaves.with_octaves(1.0), highest: 1.0, ..cloud }
    }
}

impl<K: Field<Vec3>> SizedFbm<K> {
    /// The sum of octaves.
    pub(crate) const fn octaves(&self) -> &Fbm<K, Vec3> {
        &self.octaves
    }

    /// Cells of the first octave per unit of length, and the frequency ratio of the last and the
    /// first octave.
    pub(crate) const fn frequencies(&self) -> [f32; 2] {
        [self.frequency, self.highest]
    }

    /// Creates the sum of octaves of a spectrum for any noise.
    pub(crate) fn of(noise: K, spectrum: FbmSpectrum, size: f32, seed: u32) -> Self {
        let octaves = Fbm::new(noise, spectrum).with_seed(seed).with_normalization(Normalization::UnitRange);
        Self { octaves, frequency: 1.0 / size, highest: spectrum.frequency(spectrum.max_octaves() - 1) }
    }

    /// Value and gradient by p/size, with unresolved octaves faded to 0, their mean.
    pub(crate) fn sample(&self, position: Vec3, footprint: Footprint) -> Sample<Vec3> {
        let p = position * self.frequency;
        match self.faded(footprint) {
            None => self.octaves.sample(p),
            Some(width) => self.octaves.sample_band_limited(p, width),
        }
    }

    /// The value of [`sample`](Self::sample).
    pub(crate) fn seen(&self, position: Vec3, footprint: Footprint) -> f32 {
        let p = position * self.frequency;
        match self.faded(footprint) {
            None => self.octaves.value(p),
            Some(width) => self.octaves.value_band_limited(p, width),
        }
    }

    /// The footprint in cells of a pixel that does not resolve all octaves.
    fn faded(&self, footprint: Footprint) -> Option<f32> {
        let width = footprint.width() * self.frequency;
        (filtered_fraction(width, self.highest) > 0.0).then_some(width)
    }

    /// The value without fading.
    pub(crate) fn value(&self, position: Vec3) -> f32 {
        self.octaves.value(position * self.frequency)
    }

    /// The fraction of the first octave that the pixel cannot resolve.
    pub(crate) fn removed(&self, footprint: Footprint) -> f32 {
        filtered_fraction(footprint.width(), self.frequency)
    }

    /// The variance of each component of the gradient by p/size that fading removes.
    ///
    /// ```text
    /// Σ (aᵢ fᵢ/Σ a)² (1 − (1 − kᵢ)²) · slope_variance
    /// ```
    pub(crate) fn removed_slope(&self, footprint: Footprint, slope_variance: f32) -> f32 {
        let (spectrum, count) = (self.octaves.spectrum(), self.octaves.octaves());
        if filtered_fraction(footprint.width() * self.frequency, self.highest) <= 0.0 {
            return 0.0;
        }
        let mut sum = 0.0;
        for i in 0..spectrum.max_octaves() {
            let slope = spectrum.weight(count, i) * spectrum.amplitude(i) * spectrum.frequency(i);
            let kept = footprint.kept(self.frequency * spectrum.frequency(i));
            sum += slope * slope * (1.0 - kept * kept);
        }
        let total = spectrum.sum_of_amplitudes(count);
        sum * slope_variance / (total * total)
    }
}

/// E max(N, 0) = E|N|/2 of continuous simplex noise.
pub(crate) fn half_mean() -> f32 {
    0.5 * Simplex::new(0).statistics(3).absolute_moments[0]
}

/// `t² (3 − 2t)`, `t = clamp((x − low)/(high − low), 0, 1)`.
///
/// A step at `high` if the interval is empty. NaN returns 0.
pub(crate) fn smoothstep(low: f32, high: f32, x: f32) -> f32 {
    if x >= high {
        1.0
    } else if x > low {
        let t = (x - low) / (high - low);
        // The quotient of two infinities is NaN, which `max` drops.
        let t = t.max(0.0);
        t * t * (3.0 - 2.0 * t)
    } else {
        0.0
    }
}

/// The mean of a function of positions over random points of a plane through space, and its
/// standard error.
#[cfg(test)]
pub(super) fn mean_on_plane(seed: u64, count: usize, f: impl Fn(Vec3) -> f32) -> [f64; 2] {
    let mut random = asperity_core::SplitMix64 { state: seed };
    let mut side = || ((random.word() >> 11) as f64 * (-53_f64).exp2()) as f32 * 4.0;
    let frame = asperity_ndf_sampling::Frame::from_normal(Vec3::new(0.36, 0.48, 0.8));
    let (mut sum, mut squares) = (0.0, 0.0);
    for _ in 0..count {
        let x = f64::from(f(frame.tangent * side() + frame.bitangent * side()));
        sum += x;
        squares += x * x;
    }
    let n = count as f64;
    let mean = sum / n;
    [mean, ((squares / n - mean * mean).max(0.0) / n).sqrt()]
}
