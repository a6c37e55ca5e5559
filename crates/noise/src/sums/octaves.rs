//! Sums of octaves of any noise, with a real number of octaves.

use crate::{
    contract::field::{Field, row_samples, row_values},
    contract::kernel::{Kernel, LaneSample, Row, samples, values},
    contract::point::Point,
    contract::sample::Sample,
    row::scratch::{STRETCH, Scratch},
    simd::lanes::{LANES, Lanes, Scalar},
    sums::frequency_clamp::removed_share,
    sums::octave::{Layer, Rotation},
    sums::shape::{Shape, Signed},
    sums::spectrum::{MAX_OCTAVES, Spectrum},
};

/// What a sum of octaves is divided by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Normalisation {
    /// Σ wᵢ aᵢ: the sum stays in [−1, 1]. Its variance shrinks as octaves are added.
    Range,
    /// σ₁ √Σ (wᵢ aᵢ)²: the sum has variance 1 for every number of octaves, and no bound of 1.
    ///
    /// With a [`Shape`] whose mean is not 0 the mean is taken away first, so that the sum has mean 0.
    #[default]
    Variance,
}

/// A sum of octaves of one kind of noise: fractional Brownian motion, and with another [`Shape`] turbulence and its like.
///
#[cfg_attr(doc, doc = include_str!("../../docs/pictures/octaves.md"))]
///
/// ```text
/// n(p) = Σ wᵢ aᵢ φ(nᵢ(fᵢ Rᵢ p + oᵢ)) / N
/// ```
///
/// with the weights, amplitudes and frequencies of a [`Spectrum`], N by [`Normalisation`], and an own seed, offset oᵢ and
/// rotation Rᵢ for every octave, so that octaves, and sums of different seeds, do not share lattice points. φ is the
/// identity until [`with_shape`](Self::with_shape) gives another.
/// No octaves give 0. As `octaves` → 0⁺ the first octave stays as it is, because it is normalised: fade it by
/// [`Spectrum::share`]. An octave whose coordinates overflow adds φ(0).
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
pub struct Octaves<K, const N: usize, T = Signed> {
    noise: K,
    spectrum: Spectrum,
    normalisation: Normalisation,
    rotation: Rotation,
    seed: u32,
    layers: [Layer<N>; MAX_OCTAVES as usize],
    shape: T,
}

impl<K: Kernel<N>, const N: usize> Octaves<K, N> {
    /// The sum of octaves of `noise` that `seed` selects, each randomly rotated.
    #[must_use]
    pub fn new(noise: K, spectrum: Spectrum, normalisation: Normalisation, seed: u32) -> Self {
        let rotation = Rotation::Random;
        let layers = Layer::all(&spectrum, rotation, seed);
        Self { noise, spectrum, normalisation, rotation, seed, layers, shape: Signed }
    }

    /// The excess kurtosis of the sum, from the measured one of the kind.
    #[must_use]
    pub fn excess_kurtosis(&self, octaves: f32) -> f32 {
        self.noise.statistics().excess_kurtosis * self.spectrum.kurtosis_ratio(octaves)
    }
}

impl<K: Kernel<N>, const N: usize, T: Shape> Octaves<K, N, T> {
    /// The same sum with octaves that are rotated or not.
    #[must_use]
    pub fn with_rotation(self, rotation: Rotation) -> Self {
        Self { rotation, layers: Layer::all(&self.spectrum, rotation, self.seed), ..self }
    }

    /// The same octaves in another shape: [`Turbulence`](crate::Turbulence), [`Plasma`](crate::Plasma) and others.
    #[must_use]
    pub fn with_shape<U: Shape>(self, shape: U) -> Octaves<K, N, U> {
        let Self { noise, spectrum, normalisation, rotation, seed, layers, .. } = self;
        Octaves { noise, spectrum, normalisation, rotation, seed, layers, shape }
    }

    /// The noise of every octave.
    #[must_use]
    pub const fn noise(&self) -> &K {
        &self.noise
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

    /// The sum of the first `octaves` octaves, for a [`Batch`](crate::Batch) or to be clamped to a footprint.
    #[must_use]
    #[inline]
    pub fn first(&self, octaves: f32) -> FirstOctaves<'_, K, N, T> {
        let octaves = lone_whole(octaves);
        let mut amplitudes = [0.0; MAX_OCTAVES as usize];
        let mut count = 0;
        for (amplitude, (_, weighted)) in amplitudes.iter_mut().zip(self.spectrum.active(octaves)) {
            *amplitude = weighted;
            count += 1;
        }
        let mean = match self.normalisation {
            Normalisation::Range => 0.0,
            Normalisation::Variance => self.moments()[0],
        };
        // From 0, so that shapes of mean 0 start from 0 and not from −0.
        let constant = amplitudes.iter().fold(0.0, |sum, amplitude| sum - mean * amplitude);
        FirstOctaves { sum: self, amplitudes, count, constant: constant + 0.0, factor: self.factor(octaves) }
    }

    /// The measured mean of the sum: that of the shape under [`Normalisation::Range`], else 0; 0 without octaves.
    #[must_use]
    pub fn mean(&self, octaves: f32) -> f32 {
        match self.normalisation {
            Normalisation::Range if octaves > 0.0 => self.moments()[0],
            _ => 0.0,
        }
    }

    /// The measured standard deviation of the sum: 1 under [`Normalisation::Variance`], 0 without octaves.
    #[must_use]
    pub fn standard_deviation(&self, octaves: f32) -> f32 {
        let octaves = lone_whole(octaves);
        self.factor(octaves) * self.moments()[1] * self.spectrum.root_sum_of_squares(octaves)
    }

    /// Mean and standard deviation of one octave of amplitude 1.
    #[inline]
    fn moments(&self) -> [f32; 2] {
        let deviation = self.noise.standard_deviation();
        self.shape.mean_and_deviation(deviation, self.noise.absolute_moments())
    }

    /// 1/N, or 0 without octaves.
    #[inline]
    fn factor(&self, octaves: f32) -> f32 {
        let norm = match self.normalisation {
            Normalisation::Range => self.spectrum.sum_of_amplitudes(octaves),
            Normalisation::Variance => self.moments()[1] * self.spectrum.root_sum_of_squares(octaves),
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
pub struct FirstOctaves<'a, K, const N: usize, T = Signed> {
    sum: &'a Octaves<K, N, T>,
    /// wᵢ aᵢ, less what a footprint has removed.
    amplitudes: [f32; MAX_OCTAVES as usize],
    /// How many octaves take part.
    count: usize,
    /// What is added to the sum before it is normalised.
    constant: f32,
    factor: f32,
}

impl<K: Kernel<N>, const N: usize, T: Shape> FirstOctaves<'_, K, N, T> {
    /// The sum as a pixel of this footprint resolves it: octaves that are too fine give way to their mean.
    ///
    /// ```text
    /// φ(nᵢ) becomes φ(nᵢ) + kᵢ (μ − φ(nᵢ)),   kᵢ = smoothstep(0.2, 0.6, footprint·fᵢ)
    /// ```
    ///
    /// μ is the mean of the shape, 0 for signed noise and measured for the others. The sum keeps its mean and loses the variance
    /// of what is removed; the normalisation stays that of all octaves. Octaves that are removed altogether are not evaluated.
    /// The gradient is that for a footprint that is the same at all points, see [`removed_share`] and
    /// [`pixel_footprint`](crate::pixel_footprint).
    ///
    /// Nilsson 2008, section 4.1.6, with the means of the noises here: 0 is the mean of signed noise only.
    ///
    /// ```
    /// use asperity_noise::{Field, Normalisation, Octaves, Simplex, Spectrum, Turbulence, glam::Vec2};
    ///
    /// let noise = Octaves::new(Simplex::CONTINUOUS, Spectrum::CLOUD, Normalisation::Range, 5).with_shape(Turbulence);
    /// let p = Vec2::new(0.3, 4.1);
    /// assert_eq!(noise.first(6.0).clamped(1e-3).sample(p), noise.sample(p, 6.0));
    ///
    /// let far = noise.first(6.0).clamped(1.0).sample(p);
    /// assert!((far.value - noise.mean(6.0)).abs() < 1e-6 && far.gradient == Vec2::ZERO);
    /// ```
    #[must_use]
    pub fn clamped(mut self, footprint: f32) -> Self {
        let [mean, _] = self.sum.moments();
        let mut frequency = 1.0;
        for amplitude in self.amplitudes.iter_mut().take(self.count) {
            let removed = removed_share(footprint, frequency);
            self.constant += *amplitude * removed * mean;
            *amplitude *= 1.0 - removed;
            frequency *= self.sum.spectrum.lacunarity();
        }
        self.count = self.amplitudes.iter().take_while(|&&amplitude| amplitude > 0.0).count();
        self
    }

    /// Octave i with its amplitude, if it takes part.
    #[inline(always)]
    pub(crate) fn octave(&self, i: usize) -> Option<(f32, &Layer<N>)> {
        if i < self.count { self.amplitudes.get(i).copied().zip(self.sum.layers.get(i)) } else { None }
    }

    /// The octaves that take part, each with its amplitude.
    #[inline(always)]
    pub(crate) fn active(&self) -> impl Iterator<Item = (f32, &Layer<N>)> {
        self.amplitudes.iter().copied().take(self.count).zip(&self.sum.layers)
    }

    #[inline(always)]
    pub(crate) fn noise(&self) -> &K {
        &self.sum.noise
    }

    #[inline(always)]
    pub(crate) fn rotation(&self) -> Rotation {
        self.sum.rotation
    }

    #[inline(always)]
    pub(crate) fn factor(&self) -> f32 {
        self.factor
    }
}

impl<K: Kernel<N>, const N: usize, T: Shape> Field<N> for FirstOctaves<'_, K, N, T> {
    #[inline(always)]
    fn lane_values<S: Lanes>(&self, s: S, p: [S::F; N]) -> S::F {
        let mut sum = s.float(self.constant);
        for (amplitude, layer) in self.active() {
            let p = match self.sum.rotation {
                Rotation::Random => layer.points(s, p),
                Rotation::Aligned => layer.aligned(s, p),
            };
            let value = self.sum.shape.value(s, values(&self.sum.noise, s, p, layer.seed));
            sum = sum + s.float(amplitude) * value;
        }
        sum * s.float(self.factor)
    }

    #[inline(always)]
    fn lane_samples<S: Lanes>(&self, s: S, p: [S::F; N]) -> LaneSample<S, N> {
        let mut sum = (s.float(self.constant), [s.float(0.0); N]);
        for (amplitude, layer) in self.active() {
            let amplitude = s.float(amplitude);
            match self.sum.rotation {
                Rotation::Random => {
                    let sample = samples(&self.sum.noise, s, layer.points(s, p), layer.seed);
                    layer.accumulate(s, &mut sum, amplitude, self.sum.shape.sample(s, sample));
                }
                Rotation::Aligned => {
                    let sample = samples(&self.sum.noise, s, layer.aligned(s, p), layer.seed);
                    layer.accumulate_aligned(s, &mut sum, amplitude, self.sum.shape.sample(s, sample));
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
            Rotation::Aligned => self.count.max(1),
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
        let (Rotation::Aligned, Some((amplitude, layer))) = (self.sum.rotation, self.octave(pass)) else {
            self.row_values(s, row, scratch, out);
            return;
        };
        let Scratch { columns, octave, .. } = scratch;
        let frequencies = layer.frequencies();
        for (stretch, out) in out.chunks_mut(STRETCH).enumerate() {
            let octave = &mut octave[..out.len()];
            let row = row.after(stretch * STRETCH).scaled(frequencies, layer.offset);
            row_values(&self.sum.noise, s, &row, layer.seed, columns, octave);
            let (octaves, octave) = octave.as_chunks::<LANES>();
            let (blocks, rest) = out.as_chunks_mut::<LANES>();
            // Registers that are known to be whole take no checks.
            for (octave, sum) in octaves.iter().zip(blocks) {
                for k in (0..LANES).step_by(S::LEN) {
                    let octave = self.sum.shape.value(s, s.load(&octave[k..]));
                    self.accumulate(s, pass, &mut sum[k..k + S::LEN], self.constant, amplitude, octave);
                }
            }
            for (octave, sum) in octave.chunks(S::LEN).zip(rest.chunks_mut(S::LEN)) {
                let octave = self.sum.shape.value(s, s.load_part(octave));
                self.accumulate(s, pass, sum, self.constant, amplitude, octave);
            }
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
        let (Rotation::Aligned, Some((amplitude, layer))) = (self.sum.rotation, self.octave(pass)) else {
            self.row_samples(s, row, scratch, out, gradients);
            return;
        };
        let Scratch { columns, octave, slopes } = scratch;
        let frequencies = layer.frequencies();
        for (stretch, out) in out.chunks_mut(STRETCH).enumerate() {
            let (start, count) = (stretch * STRETCH, out.len());
            let octave = &mut octave[..count];
            let row = row.after(start).scaled(frequencies, layer.offset);
            let mut rows = slopes.each_mut().map(|slope| &mut slope[..count]);
            row_samples(&self.sum.noise, s, &row, layer.seed, columns, octave, &mut rows);
            let mut i = 0;
            for (sum, octave) in out.chunks_mut(S::LEN).zip(octave.chunks(S::LEN)) {
                let mut sample = (s.load_part(octave), [s.float(0.0); N]);
                for axis in 0..N {
                    sample.1[axis] = s.load_part(slopes[axis].get(i..).unwrap_or_default());
                }
                let (value, gradient) = self.sum.shape.sample(s, sample);
                self.accumulate(s, pass, sum, self.constant, amplitude, value);
                let end = start + count.min(i + S::LEN);
                for axis in 0..N {
                    let slope = s.float(frequencies[axis]) * gradient[axis];
                    let sum = gradients[axis].get_mut(start + i..end).unwrap_or_default();
                    self.accumulate(s, pass, sum, 0.0, amplitude, slope);
                }
                i += S::LEN;
            }
        }
    }
}

impl<K: Kernel<N>, const N: usize, T: Shape> FirstOctaves<'_, K, N, T> {
    /// sum + amplitude · octave, times the factor in the last pass; before the first pass the sum is `constant`.
    #[inline(always)]
    fn accumulate<S: Lanes>(
        &self,
        s: S,
        pass: usize,
        sum: &mut [f32],
        constant: f32,
        amplitude: f32,
        octave: S::F,
    ) {
        let before = if pass == 0 { s.float(constant) } else { s.load_part(sum) };
        let mut total = before + s.float(amplitude) * octave;
        if pass + 1 == self.count {
            total = total * s.float(self.factor);
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
