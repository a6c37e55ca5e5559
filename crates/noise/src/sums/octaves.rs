//! Sums of octaves of any noise, with a real number of octaves.

use core::array;

use asperity_core::math;

use crate::{
    contract::field::{Field, HasHessian},
    contract::hessian::{self, HessianKernel, Jet, mirror},
    contract::kernel::{Anchor, Kernel},
    kinds::gaussian::GaussianNoise,
    lanes::{LaneSample, Scalar},
    lattice::lattice::Lattice,
    lattice::tiled::{TiledError, in_first_tile},
    point::Point,
    row::points::{Points, Target},
    sample::{Sample, SampleHessian},
    sums::anchor::anchored,
    sums::frequency_clamp::filtered_fraction,
    sums::octave::{Layer, Layers, Octave, Rotation},
    sums::pass::Passes,
    sums::point::AtPoint,
    sums::shape::{Shape, Signed},
    sums::spectrum::{FbmSpectrum, MAX_OCTAVES},
};

/// The divisor of a sum of octaves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum Normalization {
    /// Σ wᵢ aᵢ: the sum stays in [−1, 1]. Its variance shrinks as octaves are added.
    UnitRange,
    /// σ₁ √Σ (wᵢ aᵢ)²: the sum has variance 1 for every number of octaves. It is not bounded by 1.
    ///
    /// The mean of a kind or a [`Shape`] is subtracted first, so that the sum has mean 0.
    #[default]
    UnitVariance,
}

/// Fractional Brownian motion: a sum of octaves of one kind of noise.
///
/// Other [`Shape`]s give turbulence, plasma, billow and ridged noise.
///
#[cfg_attr(doc, doc = include_str!("../../docs/pictures/octaves.md"))]
///
/// ```text
/// n(p) = Σ wᵢ aᵢ φ(nᵢ(fᵢ Rᵢ p + oᵢ)) / N
/// ```
///
/// The [`FbmSpectrum`] defines weights, amplitudes and frequencies, and [`Normalization`] defines N.
/// Every octave has its own seed, offset oᵢ and rotation Rᵢ, so that octaves and sums of different
/// seeds have no lattice points in common. φ is the identity unless set by
/// [`with_shape`](Self::with_shape).
///
/// Uses every octave of the spectrum unless limited by [`first`](Self::first). With zero octaves
/// the result is 0. Below one octave the sum does not change, because it is normalized. Fade it by
/// [`share`](Self::share) instead. An octave whose coordinates overflow adds φ(0).
///
/// Nilsson 2008, "Procedural Generation of Natural Variations"; lacunarity after Ebert (ed.) 1994.
///
/// ```
/// use asperity_noise::{Field, Normalization, Fbm, Perlin, FbmSpectrum, glam::Vec3};
///
/// let noise = Fbm::new(Perlin::new(5), FbmSpectrum::default()).with_normalization(Normalization::UnitRange);
/// let sample = noise.first(4.5).sample(Vec3::new(0.4, 0.1, -3.0));
/// assert!(sample.value.abs() <= 1.0);
/// ```
#[doc(alias("fbm", "fractal", "terrain", "clouds"))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fbm<K, const N: usize, T = Signed> {
    terms: Terms<K, N, T>,
    active: Active,
}

/// A sum of octaves of Gaussian noise: N(0, 1) at every point, for every real number of octaves.
///
/// ```text
/// z(p) = Σ wᵢ aᵢ zᵢ(fᵢ Rᵢ p + oᵢ) / √Σ wᵢ² aᵢ²,   zᵢ = nᵢ/√vᵢ ~ N(0, 1)
/// ```
///
/// Each octave is normalized separately, so the fraction of the variance of an octave is the same
/// at every point, wᵢ² aᵢ² / Σ wⱼ² aⱼ².
///
/// ```
/// use asperity_noise::{Field, GaussianNoise, GaussianFbm, FbmSpectrum, glam::Vec3};
///
/// let noise = GaussianFbm::new(GaussianNoise::new(42), FbmSpectrum::default()).first(6.5);
/// let [first, second] = noise.pair(Vec3::new(0.1, 0.2, 0.3));
/// assert_eq!(first, noise.sample(Vec3::new(0.1, 0.2, 0.3)));
/// assert!(first != second && noise.share() < 1.0);
/// ```
#[doc(alias("fbm", "fractal"))]
pub type GaussianFbm<const N: usize> = Fbm<GaussianNoise, N>;

/// A sum with another number of octaves, returned by [`Fbm::detail`].
#[derive(Clone, Copy, Debug)]
pub struct Detail<'a, K, const N: usize, T = Signed> {
    terms: &'a Terms<K, N, T>,
    active: Active,
}

/// All octaves of a sum.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Terms<K, const N: usize, T> {
    noise: K,
    spectrum: FbmSpectrum,
    normalisation: Normalization,
    rotation: Rotation,
    seed: u32,
    layers: Layers<N>,
    shape: T,
}

/// The active octaves and their divisor, computed once instead of at every point.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Active {
    octaves: f32,
    /// wᵢ aᵢ, reduced by frequency clamping.
    amplitudes: [f32; MAX_OCTAVES as usize],
    /// The number of active octaves.
    count: usize,
    /// A constant that is added to the sum before normalization.
    constant: f32,
    factor: f32,
    /// Lower and upper bound of the sum.
    range: [f32; 2],
}

impl Active {
    /// The sum if every octave is at this bound.
    ///
    /// It is a bound of the sum, as rounded additions and products are monotonic.
    #[inline]
    fn of_bound(&self, bound: f32) -> f32 {
        let amplitudes = self.amplitudes.iter().take(self.count);
        amplitudes.fold(self.constant, |sum, amplitude| sum + amplitude * bound) * self.factor
    }
}

/// The number of octaves, with a lone octave made whole.
///
/// The weight of a lone octave cancels against the normalization, or underflows in it.
#[inline]
fn lone_whole(octaves: f32) -> f32 {
    if octaves > 0.0 { octaves.max(1.0) } else { 0.0 }
}

impl Active {
    /// The first `octaves` octaves of a spectrum.
    ///
    /// The variance is 1 if there are `moments`, the mean and deviation of one octave. `bounds` are
    /// the bounds of one octave.
    fn new(spectrum: &FbmSpectrum, octaves: f32, bounds: [f32; 2], moments: Option<[f32; 2]>) -> Self {
        let mut active = Self {
            octaves: if octaves > 0.0 { octaves } else { 0.0 },
            amplitudes: [0.0; MAX_OCTAVES as usize],
            count: 0,
            constant: 0.0,
            factor: 0.0,
            range: bounds,
        };
        let (mut norm, mut squares) = (0.0, 0.0);
        for (amplitude, (_, weighted)) in
            active.amplitudes.iter_mut().zip(spectrum.active(lone_whole(octaves)))
        {
            *amplitude = weighted;
            active.count += 1;
            norm += weighted;
            squares += weighted * weighted;
        }
        if let Some([mean, deviation]) = moments {
            // Starts from 0, so that shapes of mean 0 start from 0 and not from −0.
            let amplitudes = active.amplitudes.iter().take(active.count);
            let constant = amplitudes.fold(0.0, |sum, amplitude| sum - mean * amplitude);
            active.constant = constant + 0.0;
            norm = deviation * math::sqrt(squares);
        }
        active.factor = if norm > 0.0 { 1.0 / norm } else { 0.0 };
        active.range = active.range.map(|bound| active.of_bound(bound));
        active
    }

    /// Replaces the octaves that a footprint removes by the mean of one octave, within the `bounds`
    /// of one octave.
    fn clamped(mut self, footprint: f32, lacunarity: f32, mean: f32, bounds: [f32; 2]) -> Self {
        let mut frequency = 1.0;
        for amplitude in self.amplitudes.iter_mut().take(self.count) {
            let removed = filtered_fraction(footprint, frequency);
            self.constant += *amplitude * removed * mean;
            *amplitude *= 1.0 - removed;
            frequency *= lacunarity;
        }
        self.count = self.amplitudes.iter().take_while(|&&amplitude| amplitude > 0.0).count();
        // The range of the whole sum is kept, so that it does not depend on the footprint. Rounding
        // may add to it.
        let [low, high] = self.range;
        let [lower, upper] = bounds.map(|bound| self.of_bound(bound));
        self.range = [low.min(lower), high.max(upper)];
        self
    }
}

/// g times a factor.
#[inline(always)]
fn scaled<const N: usize>(mut g: [f32; N], factor: f32) -> [f32; N] {
    for axis in 0..N {
        g[axis] *= factor;
    }
    g
}

impl<K: Kernel<N>, const N: usize, T: Shape> Terms<K, N, T> {
    #[inline]
    fn active(&self, octaves: f32) -> Active {
        let moments = (self.normalisation == Normalization::UnitVariance).then(|| self.moments());
        Active::new(&self.spectrum, octaves, self.bounds(), moments)
    }

    /// Lower and upper bound of one octave of amplitude 1.
    #[inline]
    fn bounds(&self) -> [f32; 2] {
        let [low, high] = self.noise.bounds();
        if T::IS_IDENTITY { [low, high] } else { self.shape.range(high.max(-low)) }
    }

    /// Mean and standard deviation of one octave of amplitude 1.
    #[inline]
    fn moments(&self) -> [f32; 2] {
        if T::IS_IDENTITY {
            return [self.noise.mean(), self.noise.standard_deviation()];
        }
        self.shape.mean_and_deviation(self.noise.standard_deviation(), self.noise.absolute_moments())
    }

    fn clamped(&self, active: Active, footprint: f32) -> Active {
        active.clamped(footprint, self.spectrum.lacunarity(), self.moments()[0], self.bounds())
    }

    /// The active octaves, each with its amplitude.
    #[inline(always)]
    fn octaves(&self, active: &Active) -> impl Iterator<Item = (f32, Layer<N>)> {
        active.amplitudes.iter().copied().take(active.count).zip(self.layers.iter())
    }

    /// The octaves of a point that is evaluated in lanes.
    #[inline(always)]
    fn at_point<'a>(&'a self, active: &'a Active, p: [f32; N]) -> AtPoint<'a, N> {
        AtPoint { layers: &self.layers, amplitudes: &active.amplitudes, count: active.count, p }
    }

    /// The sum from one octave per lane, where this is faster.
    #[inline(always)]
    fn in_lanes(&self, active: &Active, p: [f32; N]) -> Option<LaneSample<Scalar, N>> {
        if K::OCTAVES_IN_LANES == usize::MAX || active.count < K::OCTAVES_IN_LANES {
            return None;
        }
        let mut sum = (active.constant, [0.0; N]);
        self.at_point(active, p).add(&self.noise, self.shape, &mut sum)?;
        Some((sum.0 * active.factor, scaled(sum.1, active.factor)))
    }

    #[inline(always)]
    fn value(&self, active: &Active, p: [f32; N]) -> f32 {
        if let Some((value, _)) = self.in_lanes(active, p) {
            return value;
        }
        let (p, mut own, mut sum) = (self.in_first_tile(p), None, active.constant);
        for (amplitude, layer) in self.octaves(active) {
            let (p, noise) = (layer.points(Scalar, p), layer.noise(&self.noise, &mut own));
            let n = noise.value_at(p, layer.seed);
            sum += amplitude * self.shape.value(n);
        }
        sum * active.factor
    }

    #[inline(always)]
    fn sample(&self, active: &Active, p: [f32; N]) -> LaneSample<Scalar, N> {
        if let Some(sample) = self.in_lanes(active, p) {
            return sample;
        }
        let (p, mut own, mut sum) = (self.in_first_tile(p), None, (active.constant, [0.0; N]));
        for (amplitude, layer) in self.octaves(active) {
            let (p, noise) = (layer.points(Scalar, p), layer.noise(&self.noise, &mut own));
            let (n, gradient) = noise.sample_at(p, layer.seed);
            let slope = self.shape.slope(n);
            let sample = (self.shape.value(n), scaled(gradient, slope));
            layer.accumulate(Scalar, &mut sum, amplitude, sample);
        }
        (sum.0 * active.factor, scaled(sum.1, active.factor))
    }

    /// The point itself, or its image in the first tile if the noise is tileable.
    #[inline(always)]
    fn in_first_tile(&self, p: [f32; N]) -> [f32; N] {
        if K::TILED { in_first_tile(Scalar, p, &periods(&self.noise)) } else { p }
    }

    fn passes<'a>(&'a self, active: &'a Active) -> Passes<'a, K, N, T> {
        Passes {
            noise: &self.noise,
            periods: periods(&self.noise),
            shape: self.shape,
            layers: &self.layers,
            amplitudes: active.amplitudes.get(..active.count).unwrap_or_default(),
            constant: active.constant,
            factor: active.factor,
        }
    }

    fn mean(&self, active: &Active) -> f32 {
        match self.normalisation {
            Normalization::UnitRange if active.octaves > 0.0 => self.moments()[0],
            _ => 0.0,
        }
    }

    fn standard_deviation(&self, active: &Active) -> f32 {
        active.factor * self.moments()[1] * self.spectrum.root_sum_of_squares(lone_whole(active.octaves))
    }
}

/// The periods along all axes, 0 if there is none.
#[inline(always)]
fn periods<K: Kernel<N>, const N: usize>(noise: &K) -> [f32; N] {
    let mut periods = [0.0; N];
    for axis in 0..N {
        periods[axis] = noise.period(axis) as f32;
    }
    periods
}

impl<K: HessianKernel<N>, const N: usize, T> Terms<K, N, T> {
    /// factor · Σ amplitude · octave.
    fn jet(&self, active: &Active, p: [f32; N]) -> Jet<N> {
        let (p, mut own) = (in_first_tile(Scalar, p, &periods(&self.noise)), None);
        let (mut sum, mut hessian) = ((0.0, [0.0; N]), [[0.0; N]; N]);
        for (amplitude, layer) in active.amplitudes.iter().copied().take(active.count).zip(self.layers.iter())
        {
            let (p, noise) = (layer.points(Scalar, p), layer.noise(&self.noise, &mut own));
            let octave = hessian::at(noise, p, layer.seed);
            layer.accumulate(Scalar, &mut sum, amplitude, (octave.value, octave.gradient));
            // M as the rows of what it makes of the axes: H M, then Mᵀ (H M).
            let mut turned = octave.hessian;
            for row in &mut turned {
                *row = layer.pull_back(Scalar, *row);
            }
            for i in 0..N {
                for j in i..N {
                    let entry = (0..N).fold(0.0, |entry, k| entry + layer.matrix[k][i] * turned[k][j]);
                    hessian[i][j] += amplitude * entry;
                }
            }
        }
        mirror(&mut hessian);
        let factor = active.factor;
        for row in &mut hessian {
            *row = scaled(*row, factor);
        }
        Jet { value: sum.0 * factor, gradient: scaled(sum.1, factor), hessian }
    }
}

impl<L: Lattice, const N: usize> Terms<GaussianNoise<L>, N, Signed> {
    #[inline]
    fn pair<V: Point<Coordinates = [f32; N]>>(&self, active: &Active, p: V) -> [Sample<V>; 2] {
        let mut sums = [(0.0, [0.0; N]); 2];
        let at_point = self.at_point(active, p.coordinates());
        if !(L::SHARED && at_point.add_pair(&self.noise, &mut sums).is_some()) {
            let (p, mut own) = (self.in_first_tile(p.coordinates()), None);
            for (amplitude, layer) in self.octaves(active) {
                let (p, noise) = (layer.points(Scalar, p), layer.noise(&self.noise, &mut own));
                for (sum, sample) in sums.iter_mut().zip(noise.channels(p, layer.seed)) {
                    layer.accumulate(Scalar, sum, amplitude, sample);
                }
            }
        }
        sums.map(|(value, gradient)| Sample {
            value: value * active.factor,
            gradient: V::from_coordinates(scaled(gradient, active.factor)),
        })
    }
}

impl<K: Kernel<N>, const N: usize> Fbm<K, N> {
    /// Creates the sum of octaves of `noise`, each randomly rotated, with variance 1.
    ///
    /// Tileable noises do not compile here. With one period for all, the octaves would repeat
    /// within it. With rotations, they would not repeat at all. [`Fbm::tiled`] gives each
    /// octave its own period.
    #[must_use]
    pub fn new(noise: K, spectrum: FbmSpectrum) -> Self {
        const { assert!(!K::TILED, "use `Octaves::tiled` for octaves of a tileable noise") };
        Self::with_layers(noise, spectrum, Rotation::Random)
    }

    fn with_layers(noise: K, spectrum: FbmSpectrum, rotation: Rotation) -> Self {
        let (seed, normalisation) = (noise.seed(), Normalization::UnitVariance);
        let layers = Layers::of(&noise, &Layer::all(&spectrum, rotation, seed));
        Terms { noise, spectrum, normalisation, rotation, seed, layers, shape: Signed }.all()
    }

    /// Creates the sum of octaves of a tileable noise with its periods, with variance 1.
    ///
    /// Octave i has periods ℓⁱ times as long in its own cells, so that no octave repeats within the
    /// tile. Octaves are not rotated. Points are moved into the first tile by whole periods,
    /// without rounding. Values and gradients at p and p + period therefore have the same bits if
    /// both points are exact in `f32`. Grids are evaluated point by point in lanes, without the row
    /// reuse of other aligned sums.
    ///
    /// # Errors
    ///
    /// If the noise does not repeat along some axis, or if a period times ℓⁱ is not an integer up
    /// to 2²¹ for some octave of the spectrum with lacunarity ℓ. Lacunarities 2 and 3 accept every
    /// period. Lacunarity 1.5 accepts powers of 2 for a limited number of octaves.
    ///
    /// ```
    /// use asperity_noise::{Field, IntegerHash, Fbm, Perlin, FbmSpectrum, Tiled, TiledError, glam::Vec2};
    ///
    /// let noise = Perlin::new(1).with_lattice(Tiled::new(IntegerHash, [8, 5])?);
    /// let tile = Fbm::tiled(noise, FbmSpectrum::CLOUD)?;
    /// let p = Vec2::new(1.25, -0.5);
    /// assert_eq!(tile.sample(p), tile.sample(p + Vec2::new(8.0, -5.0)));
    /// assert_ne!(tile.value(p), tile.value(p + Vec2::new(4.0, 0.0)));
    ///
    /// // The default lacunarity is 2.17, and 8 · 2.17 is not an integer.
    /// assert!(matches!(Fbm::<_, 2>::tiled(noise, FbmSpectrum::default()), Err(TiledError::NoOctavePeriod { octave: 1, .. })));
    /// # Ok::<(), TiledError>(())
    /// ```
    #[doc(alias("seamless", "tileable", "periodic"))]
    pub fn tiled(noise: K, spectrum: FbmSpectrum) -> Result<Self, TiledError> {
        let lacunarity = spectrum.lacunarity();
        for axis in 0..N {
            let period = noise.period(axis);
            if !K::TILED || period == 0 {
                return Err(TiledError::NoPeriod);
            }
            for octave in 0..spectrum.max_octaves() {
                // Exact: 22 bits times 24.
                let exact = f64::from(period) * f64::from(spectrum.frequency(octave));
                let whole = exact as u32;
                if f64::from(whole) != exact || whole > 1 << 21 {
                    return Err(TiledError::NoOctavePeriod { axis, period, lacunarity, octave });
                }
            }
        }
        Ok(Self::with_layers(noise, spectrum, Rotation::Aligned))
    }

    /// Creates a sum of one octave, the noise itself, for use with [`anchored`](Self::anchored).
    ///
    /// ```
    /// use asperity_noise::{Field, Fbm, Perlin, glam::Vec2};
    ///
    /// let (noise, p) = (Perlin::new(3), Vec2::new(0.3, 1.4));
    /// assert_eq!(Fbm::single(noise).sample(p), noise.sample(p));
    /// ```
    #[must_use]
    pub fn single(noise: K) -> Self {
        let (seed, spectrum) = (noise.seed(), FbmSpectrum::SINGLE);
        let mut layers = Layer::all(&spectrum, Rotation::Aligned, seed);
        for layer in &mut layers {
            (layer.seed, layer.offset) = (seed, [0.0; N]);
        }
        let layers = Layers::of(&noise, &layers);
        let (normalisation, rotation) = (Normalization::UnitRange, Rotation::Aligned);
        Terms { noise, spectrum, normalisation, rotation, seed, layers, shape: Signed }.all()
    }
}

impl<K: Anchor<N>, const N: usize, T: Shape> Fbm<K, N, T> {
    /// Moves the origin of the sum to an anchor, without loss of precision far from the origin.
    ///
    /// The value at p is the value of the original sum at anchor + p. The cell of the anchor in
    /// each octave is computed from `f64` without rounding, and the octave is evaluated near it.
    /// The only rounding is the rounding of p and of the anchor itself, 2⁻⁵³ of its distance. From
    /// 2³¹ on, cells repeat modulo 2³², as everywhere. Use one anchor per chunk of a world or one
    /// at the camera, and pass differences to it as points. An anchor at the origin gives the bits
    /// of the original sum.
    ///
    /// - **Accuracy:** every octave resolves 1e-3 of a cell at 10¹². The sums of two anchors 1000
    ///   cells apart agree within the precision of points there.
    /// - **Domain:** an octave is 0 if a coordinate of the anchor in its cells is 2⁵⁸ or more, or
    ///   not finite.
    ///
    /// An anchor is an array of `f64`, or `DVec2` to `DVec4` of glam if your glam has its feature
    /// `f64`.
    ///
    /// The octaves of an anchored sum are fixed. Choose seed and rotation before anchoring.
    /// Tileable noises do not compile here: move their anchor by whole periods instead.
    ///
    /// ```
    /// use asperity_noise::{Field, Fbm, Simplex, FbmSpectrum, glam::Vec3};
    ///
    /// let sum = Fbm::new(Simplex::new(7), FbmSpectrum::default());
    /// let [here, there] = [1e12, 1e12 + 1.0].map(|x| sum.anchored([x, -3e11, 5e10]));
    /// // Both anchors give the same point. A point 1/1000 of a cell away has another value.
    /// let p = Vec3::new(0.25, 0.5, 0.75);
    /// assert!((here.value(p + Vec3::X) - there.value(p)).abs() < 1e-3);
    /// assert_ne!(here.value(p), here.value(p + Vec3::new(1e-3, 0.0, 0.0)));
    /// ```
    #[doc(alias("floating origin", "large world", "double precision", "f64"))]
    #[must_use]
    pub fn anchored(self, at: impl Into<[f64; N]>) -> Fbm<K::Shifted, N, T> {
        const { assert!(!K::TILED, "move the anchor of a tileable sum by whole periods instead") };
        let at = at.into();
        let Terms { noise, spectrum, normalisation, rotation, seed, layers, shape } = self.terms;
        let mut layers = array::from_fn(|i| layers.layer(i));
        for layer in &mut layers {
            (layer.cell, layer.offset) =
                anchored(&layer.matrix, &at, &layer.offset, K::SIMPLICIAL).unwrap_or(([0; N], [f32::NAN; N]));
        }
        let noise = noise.shifted();
        let layers = Layers::of(&noise, &layers);
        let terms = Terms { noise, spectrum, normalisation, rotation, seed, layers, shape };
        Fbm { terms, active: self.active }
    }
}

impl<K: Kernel<N>, const N: usize, T: Shape> Terms<K, N, T> {
    /// The sum of all octaves.
    fn all(self) -> Fbm<K, N, T> {
        let octaves = self.spectrum.max_octaves() as f32;
        Fbm { active: self.active(octaves), terms: self }
    }
}

impl<K: Kernel<N>, const N: usize, T: Shape> Fbm<K, N, T> {
    /// Sets whether octaves are rotated.
    ///
    /// Tileable noises do not compile here, since their octaves are never rotated.
    #[must_use]
    pub fn with_rotation(self, rotation: Rotation) -> Self {
        const { assert!(!K::TILED, "octaves of a tileable noise cannot be rotated") };
        let layers = Layer::all(&self.terms.spectrum, rotation, self.terms.seed);
        let layers = Layers::of(&self.terms.noise, &layers);
        Self { terms: Terms { rotation, layers, ..self.terms }, ..self }
    }

    /// Sets the seed.
    #[must_use]
    pub fn with_seed(self, seed: u32) -> Self {
        let layers = Layer::all(&self.terms.spectrum, self.terms.rotation, seed);
        let layers = Layers::of(&self.terms.noise, &layers);
        Self { terms: Terms { seed, layers, ..self.terms }, ..self }
    }

    /// Sets the normalization and keeps the number of octaves; call before
    /// [`clamped`](Self::clamped).
    #[must_use]
    pub fn with_normalization(self, normalisation: Normalization) -> Self {
        Terms { normalisation, ..self.terms }.all().first(self.active.octaves)
    }

    /// Sets the shape and keeps the number of octaves; call before [`clamped`](Self::clamped).
    ///
    /// Shapes include [`Turbulence`](crate::Turbulence) and [`Plasma`](crate::Plasma).
    #[must_use]
    pub fn with_shape<U: Shape>(self, shape: U) -> Fbm<K, N, U> {
        let Terms { noise, spectrum, normalisation, rotation, seed, layers, .. } = self.terms;
        Terms { noise, spectrum, normalisation, rotation, seed, layers, shape }
            .all()
            .first(self.active.octaves)
    }

    /// Limits the sum to the first `octaves` octaves; a fraction reduces the amplitude of the last.
    ///
    /// ```
    /// use asperity_noise::{Field, Grid, Fbm, Perlin, FbmSpectrum, glam::Vec2};
    ///
    /// let noise = Fbm::new(Perlin::new(5), FbmSpectrum::default()).first(6.5);
    /// let grid = Grid { origin: Vec2::new(0.0, 0.7), step: Vec2::splat(0.125), size: [100, 3] };
    /// let mut values = [0.0; 300];
    /// noise.grid_values(&grid, &mut values)?;
    /// assert_eq!(values[8], noise.value(Vec2::new(1.0, 0.7)));
    /// # Ok::<(), asperity_noise::BatchError>(())
    /// ```
    #[must_use]
    pub fn first(self, octaves: f32) -> Self {
        Self { active: self.terms.active(octaves), ..self }
    }

    /// Borrows the sum with the first `octaves` octaves, for a number that varies from point to
    /// point.
    #[doc(alias("lod", "level of detail"))]
    #[must_use]
    #[inline]
    pub fn detail(&self, octaves: f32) -> Detail<'_, K, N, T> {
        Detail { terms: &self.terms, active: self.terms.active(octaves) }
    }
}

/// Methods of [`Fbm`] and [`Detail`].
macro_rules! sum {
    ($sum:ty) => {
        impl<K: Kernel<N>, const N: usize, T: Shape> $sum {
            /// Returns the noise of every octave.
            #[must_use]
            pub const fn noise(&self) -> &K {
                &self.terms.noise
            }

            /// Returns the spectrum of the sum.
            #[must_use]
            pub const fn spectrum(&self) -> &FbmSpectrum {
                &self.terms.spectrum
            }

            /// Returns the divisor of the sum.
            #[must_use]
            pub const fn normalisation(&self) -> Normalization {
                self.terms.normalisation
            }

            /// Returns octave i of the spectrum, whether it is active or not.
            ///
            /// Numbers from [`FbmSpectrum::MAX_OCTAVES`] on wrap.
            #[must_use]
            pub fn octave(&self, i: u32) -> Octave<N> {
                self.terms.layers.octave(i as usize)
            }

            /// Returns mean and standard deviation of one octave of amplitude 1, after its shape.
            #[doc(hidden)]
            #[must_use]
            pub fn octave_moments(&self) -> [f32; 2] {
                self.terms.moments()
            }

            /// Returns the number of octaves, at least 0; a fraction below 1 counts as one octave.
            #[must_use]
            pub const fn octaves(&self) -> f32 {
                self.active.octaves
            }

            /// Replaces octaves that are too fine for a pixel of this footprint by their mean.
            ///
            /// ```text
            /// φ(nᵢ) becomes φ(nᵢ) + kᵢ (μ − φ(nᵢ)),   kᵢ = smoothstep(0.2, 0.6, footprint·fᵢ)
            /// ```
            ///
            /// μ is the mean of the shape, which is 0 for signed noise and measured for other
            /// shapes. The sum keeps its mean and loses the variance of the removed octaves. The
            /// normalization stays the normalization of all octaves. Octaves that are removed
            /// completely are not evaluated. The gradient assumes that the footprint is the same at
            /// all points, see [`filtered_fraction`] and [`pixel_footprint`](crate::pixel_footprint).
            ///
            /// Frequency clamping after Nilsson 2008, section 4.1.6, with the measured means of
            /// these noises. 0 is the mean of signed noise only.
            ///
            /// ```
            /// use asperity_noise::{Field, Normalization, Fbm, Simplex, FbmSpectrum, Turbulence, glam::Vec2};
            ///
            /// let noise = Fbm::new(Simplex::new(5), FbmSpectrum::CLOUD).with_shape(Turbulence);
            /// let noise = noise.with_normalization(Normalization::UnitRange).first(6.0);
            /// let p = Vec2::new(0.3, 4.1);
            /// assert_eq!(noise.clamped(1e-3).sample(p), noise.sample(p));
            ///
            /// let far = noise.clamped(1.0).sample(p);
            /// assert!((far.value - noise.mean()).abs() < 1e-6 && far.gradient == Vec2::ZERO);
            /// ```
            #[doc(alias("antialiasing", "anti-aliasing"))]
            #[must_use]
            pub fn clamped(self, footprint: f32) -> Self {
                Self { active: self.terms.clamped(self.active, footprint), ..self }
            }

            /// Returns the mean of the sum: the measured mean of the shape under
            /// [`Normalization::UnitRange`], otherwise 0.
            ///
            /// Without octaves the mean is 0.
            #[must_use]
            pub fn mean(&self) -> f32 {
                self.terms.mean(&self.active)
            }

            /// Returns the measured standard deviation of the sum before it is
            /// [`clamped`](Self::clamped).
            ///
            /// It is 1 under [`Normalization::UnitVariance`], and 0 without octaves.
            #[must_use]
            pub fn standard_deviation(&self) -> f32 {
                self.terms.standard_deviation(&self.active)
            }

            /// Returns the fraction in
            /// [0, 1) of the spectrum's variance that the octaves resolve, [`FbmSpectrum::share`].
            #[must_use]
            #[inline]
            pub fn share(&self) -> f32 {
                self.terms.spectrum.share(self.active.octaves)
            }
        }

        impl<V, K, const N: usize, T> Field<V> for $sum
        where
            V: Point<Coordinates = [f32; N]>,
            K: Kernel<N>,
            T: Shape,
        {
            #[inline]
            fn sample(&self, p: V) -> Sample<V> {
                let (value, gradient) = self.terms.sample(&self.active, p.coordinates());
                Sample { value, gradient: V::from_coordinates(gradient) }
            }

            #[inline]
            fn value(&self, p: V) -> f32 {
                self.terms.value(&self.active, p.coordinates())
            }

            fn range(&self) -> [f32; 2] {
                self.active.range
            }

            fn fill(&self, points: &Points<'_, V>, target: Target<'_, V>) {
                self.terms.passes(&self.active).fill(points, target);
            }
        }
    };
}

sum!(Fbm<K, N, T>);
sum!(Detail<'_, K, N, T>);

macro_rules! signed_sum {
    ($sum:ident $(, $lifetime:lifetime)?) => {
        impl<K: Kernel<N>, const N: usize> $sum<$($lifetime,)? K, N> {
            /// Returns the excess kurtosis of the sum, from the measured kurtosis of the kind.
            #[must_use]
            pub fn excess_kurtosis(&self) -> f32 {
                self.terms.noise.statistics().excess_kurtosis * self.terms.spectrum.kurtosis_ratio(self.active.octaves)
            }
        }

        impl<L: Lattice, const N: usize> $sum<$($lifetime,)? GaussianNoise<L>, N> {
            /// Evaluates two independent channels in one pass over the lattices.
            ///
            /// The first channel is [`sample`](Field::sample).
            #[must_use]
            #[inline]
            pub fn pair<V: Point<Coordinates = [f32; N]>>(&self, p: V) -> [Sample<V>; 2] {
                self.terms.pair(&self.active, p)
            }
        }

        impl<V, K, const N: usize> HasHessian<V> for $sum<$($lifetime,)? K, N>
        where
            V: Point<Coordinates = [f32; N], Matrix = [[f32; N]; N]>,
            K: HessianKernel<N>,
        {
            fn sample_with_hessian(&self, p: V) -> SampleHessian<V> {
                self.terms.jet(&self.active, p.coordinates()).at()
            }
        }
    };
}

signed_sum!(Fbm);
signed_sum!(Detail, '_);

impl<K: Kernel<N>, const N: usize, T: Shape> Fbm<K, N, T> {
    /// The active octaves, for sums with other weights.
    pub(crate) fn parts(&self) -> Passes<'_, K, N, T> {
        self.terms.passes(&self.active)
    }
}
