//! Sums of octaves of any noise, with a real number of octaves.

use crate::{
    field::{Field, row_samples, row_values},
    kernel::{Kernel, LaneSample, Row, samples, values},
    lanes::{Lanes, Scalar},
    layer::{Layer, Rotation},
    point::Point,
    sample::Sample,
    scratch::{STRETCH, Scratch},
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

/// A sum of octaves of one kind of noise: fractional Brownian motion.
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
pub struct Octaves<K, const N: usize> {
    noise: K,
    spectrum: Spectrum,
    normalisation: Normalisation,
    rotation: Rotation,
    seed: u32,
    layers: [Layer<N>; MAX_OCTAVES as usize],
}

impl<K: Kernel<N>, const N: usize> Octaves<K, N> {
    /// The sum of octaves of `noise` that `seed` selects, each randomly rotated.
    #[must_use]
    pub fn new(noise: K, spectrum: Spectrum, normalisation: Normalisation, seed: u32) -> Self {
        let rotation = Rotation::Random;
        let layers = Layer::all(&spectrum, rotation, seed);
        Self { noise, spectrum, normalisation, rotation, seed, layers }
    }

    /// The same sum with octaves that are rotated or not.
    #[must_use]
    pub fn with_rotation(self, rotation: Rotation) -> Self {
        Self { rotation, layers: Layer::all(&self.spectrum, rotation, self.seed), ..self }
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
    pub fn sample<V: Point<N>>(&self, p: V, octaves: f32) -> Sample<V> {
        let (value, gradient) = self.first(octaves).lane_samples(Scalar, p.coordinates());
        Sample { value, gradient: V::from_coordinates(gradient) }
    }

    /// The value alone, the same bits as [`sample`](Self::sample)'s.
    #[must_use]
    #[inline]
    pub fn value<V: Point<N>>(&self, p: V, octaves: f32) -> f32 {
        self.first(octaves).lane_values(Scalar, p.coordinates())
    }

    /// The sum of the first `octaves` octaves, for a [`Batch`](crate::Batch).
    #[must_use]
    pub fn first(&self, octaves: f32) -> FirstOctaves<'_, K, N> {
        let octaves = lone_whole(octaves);
        FirstOctaves { sum: self, octaves, factor: self.factor(octaves) }
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

/// A sum of octaves with its number of octaves, as [`Octaves::first`] gives it.
///
/// ```
/// use asperity_noise::{Batch, Octaves, Perlin2002, Spectrum, glam::Vec2};
///
/// let noise = Octaves::new(Perlin2002::default(), Spectrum::default(), Default::default(), 5);
/// let mut row = [0.0; 100];
/// Batch::new().fill_row(&noise.first(6.5), Vec2::new(0.0, 0.7), 0.125, &mut row);
/// assert_eq!(row[8], noise.value(Vec2::new(1.0, 0.7), 6.5));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct FirstOctaves<'a, K, const N: usize> {
    sum: &'a Octaves<K, N>,
    octaves: f32,
    factor: f32,
}

impl<K: Kernel<N>, const N: usize> FirstOctaves<'_, K, N> {
    #[inline(always)]
    fn active(&self) -> impl Iterator<Item = (f32, &Layer<N>)> {
        self.sum.spectrum.active(self.octaves).zip(&self.sum.layers).map(|((_, a), layer)| (a, layer))
    }
}

impl<K: Kernel<N>, const N: usize> Field<N> for FirstOctaves<'_, K, N> {
    #[inline(always)]
    fn lane_values<S: Lanes>(&self, s: S, p: [S::F; N]) -> S::F {
        let mut sum = s.float(0.0);
        for (amplitude, layer) in self.active() {
            let p = match self.sum.rotation {
                Rotation::Random => layer.points(s, p),
                Rotation::Aligned => layer.aligned(s, p),
            };
            sum = sum + s.float(amplitude) * values(&self.sum.noise, s, p, layer.seed);
        }
        sum * s.float(self.factor)
    }

    #[inline(always)]
    fn lane_samples<S: Lanes>(&self, s: S, p: [S::F; N]) -> LaneSample<S, N> {
        let mut sum = (s.float(0.0), [s.float(0.0); N]);
        for (amplitude, layer) in self.active() {
            let amplitude = s.float(amplitude);
            match self.sum.rotation {
                Rotation::Random => {
                    let sample = samples(&self.sum.noise, s, layer.points(s, p), layer.seed);
                    layer.accumulate(s, &mut sum, amplitude, sample);
                }
                Rotation::Aligned => {
                    let sample = samples(&self.sum.noise, s, layer.aligned(s, p), layer.seed);
                    layer.accumulate_aligned(s, &mut sum, amplitude, sample);
                }
            }
        }
        let factor = s.float(self.factor);
        scaled(s, sum, factor)
    }

    #[inline(always)]
    fn passes(&self) -> usize {
        match self.sum.rotation {
            Rotation::Random => 1,
            Rotation::Aligned => self.active().count().max(1),
        }
    }

    #[inline(always)]
    fn pass_values<S: Lanes>(
        &self,
        s: S,
        pass: usize,
        row: &Row<N, false>,
        scratch: &mut Scratch<N>,
        out: &mut [f32],
    ) {
        let octave = self.active().nth(pass);
        let (Rotation::Aligned, Some((amplitude, layer))) = (self.sum.rotation, octave) else {
            self.row_values(s, row, scratch, out);
            return;
        };
        let last = pass + 1 == self.passes();
        let Scratch { columns, octave, .. } = scratch;
        let frequencies = layer.frequencies();
        for (stretch, out) in out.chunks_mut(STRETCH).enumerate() {
            let octave = &mut octave[..out.len()];
            let row = row.after(stretch * STRETCH).scaled(frequencies, layer.offset);
            row_values(&self.sum.noise, s, &row, layer.seed, columns, octave);
            accumulate(s, pass, last.then_some(self.factor), out, amplitude, None, octave);
        }
    }

    #[inline(always)]
    fn pass_samples<S: Lanes>(
        &self,
        s: S,
        pass: usize,
        row: &Row<N, false>,
        scratch: &mut Scratch<N>,
        out: &mut [f32],
        gradients: &mut [&mut [f32]; N],
    ) {
        let octave = self.active().nth(pass);
        let (Rotation::Aligned, Some((amplitude, layer))) = (self.sum.rotation, octave) else {
            self.row_samples(s, row, scratch, out, gradients);
            return;
        };
        let factor = (pass + 1 == self.passes()).then_some(self.factor);
        let Scratch { columns, octave, slopes } = scratch;
        let frequencies = layer.frequencies();
        for (stretch, out) in out.chunks_mut(STRETCH).enumerate() {
            let (start, count) = (stretch * STRETCH, out.len());
            let octave = &mut octave[..count];
            let row = row.after(start).scaled(frequencies, layer.offset);
            let mut slopes = slopes.each_mut().map(|slope| &mut slope[..count]);
            row_samples(&self.sum.noise, s, &row, layer.seed, columns, octave, &mut slopes);
            accumulate(s, pass, factor, out, amplitude, None, octave);
            for axis in 0..N {
                let out = gradients[axis].get_mut(start..start + count).unwrap_or_default();
                accumulate(s, pass, factor, out, amplitude, Some(frequencies[axis]), slopes[axis]);
            }
        }
    }
}

/// (sum + amplitude · octave) · factor, the octave times its frequency if it is a slope; the first pass has no sum yet.
#[inline(always)]
fn accumulate<S: Lanes>(
    s: S,
    pass: usize,
    factor: Option<f32>,
    sum: &mut [f32],
    amplitude: f32,
    frequency: Option<f32>,
    octave: &[f32],
) {
    let amplitude = s.float(amplitude);
    for (sum, octave) in sum.chunks_mut(S::LEN).zip(octave.chunks(S::LEN)) {
        let mut octave = s.load(octave);
        if let Some(frequency) = frequency {
            octave = s.float(frequency) * octave;
        }
        let before = if pass == 0 { s.float(0.0) } else { s.load(sum) };
        let mut total = before + amplitude * octave;
        if let Some(factor) = factor {
            total = total * s.float(factor);
        }
        s.store(total, sum);
    }
}

/// factor · sample.
#[inline(always)]
pub(crate) fn scaled<S: Lanes, const N: usize>(
    _: S,
    sample: LaneSample<S, N>,
    factor: S::F,
) -> LaneSample<S, N> {
    let (value, mut gradient) = sample;
    for axis in 0..N {
        gradient[axis] = gradient[axis] * factor;
    }
    (value * factor, gradient)
}
