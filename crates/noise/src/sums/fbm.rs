//! Sums of octaves of any field, with a real number of octaves.

use core::array;

use asperity_core::math;

use crate::{
    contract::field::{Field, HasHessian, OctaveOf, Visit},
    contract::hessian::{Jet, mirror},
    contract::kernel::{Anchor, Kernel},
    contract::noise::Noise,
    error::NoiseError,
    kinds::cell::gradient_covariance::SLOPE_UNIT,
    kinds::gaussian::GaussianNoise,
    lanes::{LaneSample, Scalar},
    lattice::lattice::Lattice,
    lattice::tiled::{MAX_PERIOD, Tile, in_first_tile},
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
    /// Σ wᵢ aᵢ: the sum stays in the range of one octave, [−1, 1] for most kinds.
    ///
    /// Its variance shrinks as octaves are added.
    UnitRange,
    /// σ₁ √Σ (wᵢ aᵢ)²: the sum has variance 1 for every number of octaves. It is not bounded by 1.
    ///
    /// The mean of a kind or a [`Shape`] is subtracted first, so that the sum has mean 0.
    #[default]
    UnitVariance,
}

/// Fractional Brownian motion: a sum of octaves of any field.
///
/// Other [`Shape`]s give turbulence, plasma, billow and ridged noise.
///
#[cfg_attr(doc, doc = include_str!("../../docs/pictures/octaves.md"))]
///
/// ```text
/// n(p) = Σ wᵢ aᵢ φ(nᵢ(fᵢ Rᵢ p + oᵢ)) / N
/// ```
///
/// The [`FbmSpectrum`] defines weights, amplitudes and frequencies, and [`Normalization`] defines
/// N. Every octave has its own offset oᵢ and rotation Rᵢ. φ is the identity unless set by
/// [`with_shape`](Self::with_shape).
///
/// - **Kinds of this crate** also get a seed for each octave, so that octaves and sums of different
///   seeds have no lattice points in common. An octave whose coordinates overflow adds φ(0).
/// - **Other fields**, including borrowed and boxed kinds, have no seed. Their octaves are the same
///   function at offsets up to 64, unless they implement
///   [`with_octave_seed`](Field::with_octave_seed). The normalization is
///   [`Normalization::UnitRange`] unless the field states its [`moments`](Field::moments).
///
/// Uses every octave of the spectrum unless limited by [`with_octaves`](Self::with_octaves). With
/// zero octaves the result is 0. Below one octave the sum does not change, because it is
/// normalized. Fade it by [`resolved_variance`](Self::resolved_variance) instead.
///
/// Nilsson 2008, "Procedural Generation of Natural Variations"; lacunarity after Ebert (ed.) 1994.
///
/// ```
/// use asperity_noise::{Fbm, FbmSpectrum, Field, Normalization, Perlin, Sample, glam::{Vec2, Vec3}};
///
/// let noise = Fbm::new(Perlin::new(5), FbmSpectrum::default()).with_normalization(Normalization::UnitRange);
/// let sample = noise.with_octaves(4.5).sample(Vec3::new(0.4, 0.1, -3.0));
/// assert!(sample.value.abs() <= 1.0);
///
/// /// A field of your own.
/// struct Waves;
///
/// impl Field<Vec2> for Waves {
///     fn sample(&self, p: Vec2) -> Sample<Vec2> {
///         let ([sx, cx], [sy, cy]) = ([p.x.sin(), p.x.cos()], [p.y.sin(), p.y.cos()]);
///         Sample { value: sx * sy, gradient: Vec2::new(cx * sy, sx * cy) }
///     }
/// }
///
/// assert!(Fbm::new(Waves, FbmSpectrum::default()).value(Vec2::new(0.4, 0.1)).abs() <= 1.0);
/// ```
#[doc(alias("fbm", "fractal", "terrain", "clouds"))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fbm<F, V: Point, T = Signed> {
    field: F,
    spectrum: FbmSpectrum,
    normalization: Normalization,
    rotation: Rotation,
    seed: u32,
    layers: Layers<V::Coordinates>,
    shape: T,
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
/// let noise = GaussianFbm::new(GaussianNoise::new(42), FbmSpectrum::default()).with_octaves(6.5);
/// let [first, second] = noise.pair(Vec3::new(0.1, 0.2, 0.3));
/// assert_eq!(first, noise.sample(Vec3::new(0.1, 0.2, 0.3)));
/// assert!(first != second && noise.resolved_variance() < 1.0);
/// ```
#[doc(alias("fbm", "fractal"))]
pub type GaussianFbm<V> = Fbm<GaussianNoise, V>;

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
    /// No octave.
    const NONE: Self = Self {
        octaves: 0.0,
        amplitudes: [0.0; MAX_OCTAVES as usize],
        count: 0,
        constant: 0.0,
        factor: 0.0,
        range: [0.0; 2],
    };

    /// The first `octaves` octaves of a spectrum.
    ///
    /// The variance is 1 if there are `moments`, the mean and deviation of one octave. `bounds` are
    /// the bounds of one octave.
    fn new(spectrum: &FbmSpectrum, octaves: f32, bounds: [f32; 2], moments: Option<[f32; 2]>) -> Self {
        let mut active =
            Self { octaves: if octaves > 0.0 { octaves } else { 0.0 }, range: bounds, ..Self::NONE };
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
    fn band_limited(mut self, footprint: f32, lacunarity: f32, mean: f32, bounds: [f32; 2]) -> Self {
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

/// A sum with the noise that it sums as a kernel.
pub(crate) struct Sum<'a, K, const N: usize, T> {
    noise: &'a K,
    layers: &'a Layers<[f32; N]>,
    shape: T,
    active: &'a Active,
}

/// What is evaluated of a [`Sum`].
pub(crate) trait Query<V: Point, T> {
    /// The result.
    type Output;

    /// Evaluates the sum.
    fn of<K: Kernel<N>, const N: usize>(self, sum: &Sum<'_, K, N, T>) -> Self::Output
    where
        V: Point<Coordinates = [f32; N]>;
}

/// The value at a point.
struct Value<V>(V);

impl<V: Point, T: Shape> Query<V, T> for Value<V> {
    type Output = f32;

    #[inline(always)]
    fn of<K: Kernel<N>, const N: usize>(self, sum: &Sum<'_, K, N, T>) -> f32
    where
        V: Point<Coordinates = [f32; N]>,
    {
        sum.value(self.0.coordinates())
    }
}

/// Value and gradient at a point.
struct SampleAt<V>(V);

impl<V: Point, T: Shape> Query<V, T> for SampleAt<V> {
    type Output = Sample<V>;

    #[inline(always)]
    fn of<K: Kernel<N>, const N: usize>(self, sum: &Sum<'_, K, N, T>) -> Sample<V>
    where
        V: Point<Coordinates = [f32; N]>,
    {
        let (value, gradient) = sum.sample(self.0.coordinates());
        Sample { value, gradient: V::from_coordinates(gradient) }
    }
}

/// A list or a grid.
struct Batch<'p, 'a, 't, V: Point>(&'p Points<'a, V>, Target<'t, V>);

impl<V: Point, T: Shape> Query<V, T> for Batch<'_, '_, '_, V> {
    type Output = ();

    fn of<K: Kernel<N>, const N: usize>(self, sum: &Sum<'_, K, N, T>)
    where
        V: Point<Coordinates = [f32; N]>,
    {
        sum.passes().fill(self.0, self.1);
    }
}

/// A query of a sum, for the field that it sums.
struct SumVisitor<'a, V: Point, T, Q> {
    layers: &'a Layers<V::Coordinates>,
    shape: T,
    active: &'a Active,
    query: Q,
}

impl<V: Point, T: Shape, Q: Query<V, T>> Visit<V> for SumVisitor<'_, V, T, Q> {
    type Output = Q::Output;

    #[inline(always)]
    fn kernel<K: Kernel<N>, const N: usize>(self, noise: &K) -> Q::Output
    where
        V: Point<Coordinates = [f32; N]>,
    {
        let Self { layers, shape, active, query } = self;
        query.of(&Sum { noise, layers, shape, active })
    }
}

/// Computes the layers of a sum.
struct LayersVisitor<'a, const ROTATED: bool> {
    spectrum: &'a FbmSpectrum,
    rotation: Rotation,
    /// The seed of the noise if `None`.
    seed: Option<u32>,
    /// Whether octaves have their own seeds and offsets.
    moved: bool,
}

impl<V: Point, const ROTATED: bool> Visit<V> for LayersVisitor<'_, ROTATED> {
    type Output = (u32, Layers<V::Coordinates>);

    fn kernel<K: Kernel<N>, const N: usize>(self, noise: &K) -> Self::Output
    where
        V: Point<Coordinates = [f32; N]>,
    {
        const { assert!(!(ROTATED && K::TILED), "call `tiled` on the sum, and give it a noise that is not tiled") };
        let seed = self.seed.unwrap_or(noise.seed());
        let mut layers = Layer::all(self.spectrum, self.rotation, seed);
        for layer in &mut layers {
            layer.offset = scaled(layer.offset, noise.spread());
            if !self.moved {
                (layer.seed, layer.offset) = (seed, [0.0; N]);
            }
        }
        (seed, Layers::of(noise, &layers))
    }
}

/// Moves a point into the first tile of a tileable noise.
struct InFirstTile<V>(V);

impl<V: Point> Visit<V> for InFirstTile<V> {
    type Output = V;

    fn kernel<K: Kernel<N>, const N: usize>(self, noise: &K) -> V
    where
        V: Point<Coordinates = [f32; N]>,
    {
        V::from_coordinates(in_first_tile(Scalar, self.0.coordinates(), &periods(noise)))
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

impl<'a, K: Kernel<N>, const N: usize, T: Shape> Sum<'a, K, N, T> {
    /// The sum from one octave per lane, where this is faster.
    #[inline(always)]
    fn in_lanes(&self, p: [f32; N]) -> Option<LaneSample<Scalar, N>> {
        let active = self.active;
        if K::OCTAVES_IN_LANES == usize::MAX || active.count < K::OCTAVES_IN_LANES {
            return None;
        }
        let mut sum = (active.constant, [0.0; N]);
        at_point(self.layers, active, p).add(self.noise, self.shape, &mut sum)?;
        Some((sum.0 * active.factor, scaled(sum.1, active.factor)))
    }

    #[inline(always)]
    fn value(&self, p: [f32; N]) -> f32 {
        if let Some((value, _)) = self.in_lanes(p) {
            return value;
        }
        let (p, mut own, mut sum) = (self.in_first_tile(p), None, self.active.constant);
        for (amplitude, layer) in octaves(self.layers, self.active) {
            let (p, noise) = (layer.points(Scalar, p), layer.noise(self.noise, &mut own));
            let n = noise.value_at(p, layer.seed);
            sum += amplitude * self.shape.value(n);
        }
        sum * self.active.factor
    }

    #[inline(always)]
    fn sample(&self, p: [f32; N]) -> LaneSample<Scalar, N> {
        if let Some(sample) = self.in_lanes(p) {
            return sample;
        }
        let (p, mut own, mut sum) = (self.in_first_tile(p), None, (self.active.constant, [0.0; N]));
        for (amplitude, layer) in octaves(self.layers, self.active) {
            let (p, noise) = (layer.points(Scalar, p), layer.noise(self.noise, &mut own));
            let (n, gradient) = noise.sample_at(p, layer.seed);
            let slope = self.shape.slope(n);
            let sample = (self.shape.value(n), scaled(gradient, slope));
            layer.accumulate(Scalar, &mut sum, amplitude, sample);
        }
        (sum.0 * self.active.factor, scaled(sum.1, self.active.factor))
    }

    /// The point itself, or its image in the first tile if the noise is tileable.
    #[inline(always)]
    fn in_first_tile(&self, p: [f32; N]) -> [f32; N] {
        if K::TILED { in_first_tile(Scalar, p, &periods(self.noise)) } else { p }
    }

    /// The active octaves, for lists and grids and for sums with other weights.
    pub(crate) fn passes(&self) -> Passes<'a, K, N, T> {
        let active = self.active;
        Passes {
            noise: self.noise,
            periods: periods(self.noise),
            shape: self.shape,
            layers: self.layers,
            amplitudes: active.amplitudes.get(..active.count).unwrap_or_default(),
            constant: active.constant,
            factor: active.factor,
        }
    }
}

/// The active octaves, each with its amplitude.
#[inline(always)]
fn octaves<const N: usize>(
    layers: &Layers<[f32; N]>,
    active: &Active,
) -> impl Iterator<Item = (f32, Layer<N>)> {
    active.amplitudes.iter().copied().take(active.count).zip(layers.iter())
}

/// The octaves of a point that is evaluated in lanes.
#[inline(always)]
fn at_point<'a, const N: usize>(
    layers: &'a Layers<[f32; N]>,
    active: &'a Active,
    p: [f32; N],
) -> AtPoint<'a, N> {
    AtPoint { layers, amplitudes: &active.amplitudes, count: active.count, p }
}

/// The periods along all axes, 0 for axes without a period.
#[inline(always)]
fn periods<K: Kernel<N>, const N: usize>(noise: &K) -> [f32; N] {
    let mut periods = [0.0; N];
    for axis in 0..N {
        periods[axis] = noise.period(axis) as f32;
    }
    periods
}

impl<F: Field<V>, V: Point> Fbm<F, V> {
    /// Creates the sum of octaves of `field`, each randomly rotated, with variance 1.
    ///
    /// The variance of a field without [`moments`](Field::moments) is unknown. Its sum is divided
    /// by Σ wᵢ aᵢ and stays in the range of the field.
    ///
    /// A noise that is already tiled does not compile here, because its octaves would repeat within
    /// the tile. Call [`tiled`](Self::tiled) on the sum instead.
    #[must_use]
    pub fn new(field: F, spectrum: FbmSpectrum) -> Self {
        let rotation = Rotation::Random;
        let (seed, layers) =
            field.visit(LayersVisitor::<true> { spectrum: &spectrum, rotation, seed: None, moved: true });
        let normalization = match field.moments() {
            Some(_) => Normalization::UnitVariance,
            None => Normalization::UnitRange,
        };
        let active = Active::NONE;
        Self { field, spectrum, normalization, rotation, seed, layers, shape: Signed, active }.all()
    }

    /// Creates a sum of one octave, the field itself, for use with [`anchored`](Self::anchored).
    ///
    /// ```
    /// use asperity_noise::{Field, Fbm, Perlin, glam::Vec2};
    ///
    /// let (noise, p) = (Perlin::new(3), Vec2::new(0.3, 1.4));
    /// assert_eq!(Fbm::single(noise).sample(p), noise.sample(p));
    /// ```
    #[must_use]
    pub fn single(field: F) -> Self {
        let (spectrum, rotation) = (FbmSpectrum::SINGLE, Rotation::Aligned);
        let visitor = LayersVisitor::<false> { spectrum: &spectrum, rotation, seed: None, moved: false };
        let (seed, layers) = field.visit(visitor);
        let (normalization, active) = (Normalization::UnitRange, Active::NONE);
        Self { field, spectrum, normalization, rotation, seed, layers, shape: Signed, active }.all()
    }
}

impl<F, V: Point, T> Fbm<F, V, T> {
    /// The same sum of another field with its layers.
    fn map_field<G>(self, map: impl FnOnce(F) -> (G, Layers<V::Coordinates>)) -> Fbm<G, V, T> {
        let Self { field, spectrum, normalization, rotation, seed, shape, active, .. } = self;
        let (field, layers) = map(field);
        Fbm { field, spectrum, normalization, rotation, seed, layers, shape, active }
    }

    /// Returns the field of every octave.
    #[must_use]
    pub const fn field(&self) -> &F {
        &self.field
    }

    /// Returns the spectrum of the sum.
    #[must_use]
    pub const fn spectrum(&self) -> &FbmSpectrum {
        &self.spectrum
    }

    /// Returns the divisor of the sum.
    #[must_use]
    pub const fn normalization(&self) -> Normalization {
        self.normalization
    }

    /// Returns the number of octaves, at least 0; a fraction below 1 counts as one octave.
    #[must_use]
    pub const fn octaves(&self) -> f32 {
        self.active.octaves
    }

    /// Returns the fraction in [0, 1) of the spectrum's variance that the octaves resolve,
    /// [`FbmSpectrum::resolved_variance`].
    #[must_use]
    #[inline]
    pub fn resolved_variance(&self) -> f32 {
        self.spectrum.resolved_variance(self.active.octaves)
    }
}

impl<F: Anchor<N>, V: Point<Coordinates = [f32; N]>, T: Shape, const N: usize> Fbm<F, V, T> {
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
    pub fn anchored(self, at: impl Into<[f64; N]>) -> Fbm<F::Shifted, V, T> {
        const { assert!(!F::TILED, "move the anchor of a tileable sum by whole periods instead") };
        let at = at.into();
        let mut layers = array::from_fn(|i| self.layers.layer(i));
        for layer in &mut layers {
            (layer.cell, layer.offset) =
                anchored(&layer.matrix, &at, &layer.offset, F::SIMPLICIAL).unwrap_or(([0; N], [f32::NAN; N]));
        }
        self.map_field(|field| {
            let shifted = field.shifted();
            let layers = Layers::of(&shifted, &layers);
            (shifted, layers)
        })
    }
}

impl<F: Tile<N>, V: Point<Coordinates = [f32; N]>, T, const N: usize> Fbm<F, V, T> {
    /// Makes the sum periodic along each axis.
    ///
    /// Octave i has periods ℓⁱ times as long in its own cells, so that no octave repeats within the
    /// tile. Octaves are not rotated. Points are moved into the first tile by whole periods,
    /// without rounding. Values and gradients at p and p + period therefore have the same bits if
    /// both points are exact in `f32`. Grids are evaluated point by point in lanes, without the row
    /// reuse of other aligned sums.
    ///
    /// # Errors
    ///
    /// If the noise does not have these periods, or if a period times ℓⁱ is not an integer up to
    /// 2²¹ for some octave of the spectrum with lacunarity ℓ. Lacunarities 2 and 3 accept every
    /// period. Lacunarity 1.5 accepts powers of 2 for a limited number of octaves.
    ///
    /// ```
    /// use asperity_noise::{Field, Fbm, Perlin, FbmSpectrum, NoiseError, glam::Vec2};
    ///
    /// let tile = Fbm::new(Perlin::new(1), FbmSpectrum::CLOUD).tiled([8, 5])?;
    /// let p = Vec2::new(1.25, -0.5);
    /// assert_eq!(tile.sample(p), tile.sample(p + Vec2::new(8.0, -5.0)));
    /// assert_ne!(tile.value(p), tile.value(p + Vec2::new(4.0, 0.0)));
    ///
    /// // The default lacunarity is 2.17, and 8 · 2.17 is not an integer.
    /// let error = Fbm::<_, Vec2>::new(Perlin::new(1), FbmSpectrum::default()).tiled([8, 5]).unwrap_err();
    /// assert!(matches!(error, NoiseError::OctavePeriod { octave: 1, .. }));
    /// # Ok::<(), NoiseError>(())
    /// ```
    #[doc(alias("seamless", "tileable", "periodic"))]
    pub fn tiled(self, periods: [u32; N]) -> Result<Fbm<F::Tiled, V, T>, NoiseError>
    where
        F::Tiled: Field<V>,
    {
        let (spectrum, rotation, seed) = (self.spectrum, Rotation::Aligned, Some(self.seed));
        let lacunarity = spectrum.lacunarity();
        let field = self.field.tiled(periods)?;
        for (axis, period) in periods.into_iter().enumerate() {
            for octave in 0..spectrum.max_octaves() {
                // Exact: 22 bits times 24.
                let exact = f64::from(period) * f64::from(spectrum.frequency(octave));
                let whole = exact as u32;
                if f64::from(whole) != exact || whole > MAX_PERIOD {
                    return Err(NoiseError::OctavePeriod { axis, period, lacunarity, octave });
                }
            }
        }
        let (_, layers) =
            field.visit(LayersVisitor::<false> { spectrum: &spectrum, rotation, seed, moved: true });
        let Self { normalization, seed, shape, active, .. } = self;
        Ok(Fbm { field, spectrum, normalization, rotation, seed, layers, shape, active })
    }
}

impl<F: Field<V>, V: Point, T: Shape> Fbm<F, V, T> {
    /// The sum with all octaves.
    fn all(self) -> Self {
        let octaves = self.spectrum.max_octaves() as f32;
        self.with_octaves(octaves)
    }

    #[inline]
    fn active(&self, octaves: f32) -> Active {
        let moments = (self.normalization == Normalization::UnitVariance).then(|| self.octave_moments());
        Active::new(&self.spectrum, octaves, self.bounds(), moments)
    }

    fn active_band_limited(&self, active: Active, footprint: f32) -> Active {
        active.band_limited(footprint, self.spectrum.lacunarity(), self.octave_moments()[0], self.bounds())
    }

    /// Lower and upper bound of one octave of amplitude 1.
    #[inline]
    fn bounds(&self) -> [f32; 2] {
        let [low, high] = self.field.range();
        if T::IS_IDENTITY { [low, high] } else { self.shape.range(high.max(-low)) }
    }

    /// Evaluates a query.
    #[inline(always)]
    pub(crate) fn ask<Q: Query<V, T>>(&self, query: Q) -> Q::Output {
        self.ask_of(&self.active, query)
    }

    #[inline(always)]
    fn ask_of<Q: Query<V, T>>(&self, active: &Active, query: Q) -> Q::Output {
        self.field.visit(SumVisitor { layers: &self.layers, shape: self.shape, active, query })
    }

    /// The sum if every octave is 0.
    pub(crate) fn of_zeros(&self) -> f32 {
        self.active.constant * self.active.factor
    }

    /// Sets whether octaves are rotated.
    ///
    /// With [`Rotation::Aligned`] and an integer lacunarity, a sum of a field with an integer
    /// period has the same period.
    #[must_use]
    pub fn with_rotation(self, rotation: Rotation) -> Self {
        let seed = self.seed;
        self.placed::<true>(rotation, seed)
    }

    /// Sets the seed of the octaves.
    #[must_use]
    pub fn with_seed(self, seed: u32) -> Self {
        let rotation = self.rotation;
        self.placed::<false>(rotation, seed)
    }

    fn placed<const ROTATED: bool>(self, rotation: Rotation, seed: u32) -> Self {
        let visitor =
            LayersVisitor::<ROTATED> { spectrum: &self.spectrum, rotation, seed: Some(seed), moved: true };
        let (seed, layers) = self.field.visit(visitor);
        Self { rotation, seed, layers, ..self }
    }

    /// Sets the normalization and keeps the number of octaves; call before
    /// [`band_limited`](Self::band_limited).
    ///
    /// A field without [`moments`](Field::moments) counts as a field of standard deviation 1 whose
    /// mean is the middle of its range.
    #[must_use]
    pub fn with_normalization(self, normalization: Normalization) -> Self {
        let octaves = self.active.octaves;
        Self { normalization, ..self }.with_octaves(octaves)
    }

    /// Sets the shape and keeps the number of octaves; call before
    /// [`band_limited`](Self::band_limited).
    ///
    /// Shapes include [`Turbulence`](crate::Turbulence) and [`Plasma`](crate::Plasma).
    #[must_use]
    pub fn with_shape<U: Shape>(self, shape: U) -> Fbm<F, V, U> {
        let Self { field, spectrum, normalization, rotation, seed, layers, active, .. } = self;
        Fbm { field, spectrum, normalization, rotation, seed, layers, shape, active }
            .with_octaves(active.octaves)
    }

    /// Limits the sum to the first `octaves` octaves; a fraction reduces the amplitude of the last.
    ///
    /// ```
    /// use asperity_noise::{Field, Grid, Fbm, Perlin, FbmSpectrum, glam::Vec2};
    ///
    /// let noise = Fbm::new(Perlin::new(5), FbmSpectrum::default()).with_octaves(6.5);
    /// let grid = Grid { origin: Vec2::new(0.0, 0.7), step: Vec2::splat(0.125), size: [100, 3] };
    /// let mut values = [0.0; 300];
    /// noise.grid_values(&grid, &mut values)?;
    /// assert_eq!(values[8], noise.value(Vec2::new(1.0, 0.7)));
    /// # Ok::<(), asperity_noise::BatchError>(())
    /// ```
    #[doc(alias("lod", "level of detail"))]
    #[must_use]
    pub fn with_octaves(self, octaves: f32) -> Self {
        Self { active: self.active(octaves), ..self }
    }

    /// Replaces octaves that are too fine for a pixel of this footprint by their mean.
    ///
    /// ```text
    /// φ(nᵢ) becomes φ(nᵢ) + kᵢ (μ − φ(nᵢ)),   kᵢ = smoothstep(0.2, 0.6, footprint·fᵢ)
    /// ```
    ///
    /// μ is the mean of the shape, which is 0 for signed noise and measured for other shapes. The
    /// sum keeps its mean and loses the variance of the removed octaves. The normalization stays
    /// the normalization of all octaves. Octaves that are removed completely are not evaluated. The
    /// gradient assumes that the footprint is the same at all points, see [`filtered_fraction`] and
    /// [`pixel_footprint`](crate::pixel_footprint).
    ///
    /// Frequency clamping after Nilsson 2008, section 4.1.6, with the measured means of these
    /// noises. 0 is the mean of signed noise only.
    ///
    /// ```
    /// use asperity_noise::{Field, Normalization, Fbm, Simplex, FbmSpectrum, Turbulence, glam::Vec2};
    ///
    /// let noise = Fbm::new(Simplex::new(5), FbmSpectrum::CLOUD).with_shape(Turbulence);
    /// let noise = noise.with_normalization(Normalization::UnitRange).with_octaves(6.0);
    /// let p = Vec2::new(0.3, 4.1);
    /// assert_eq!(noise.band_limited(1e-3).sample(p), noise.sample(p));
    ///
    /// let far = noise.band_limited(1.0).sample(p);
    /// assert!((far.value - noise.mean()).abs() < 1e-6 && far.gradient == Vec2::ZERO);
    /// ```
    #[doc(alias("antialiasing", "anti-aliasing", "frequency clamping"))]
    #[must_use]
    pub fn band_limited(self, footprint: f32) -> Self {
        Self { active: self.active_band_limited(self.active, footprint), ..self }
    }

    /// Returns the value of the first `octaves` octaves at a point.
    ///
    /// The bits of [`with_octaves`](Self::with_octaves), without a copy of the sum.
    #[must_use]
    #[inline]
    pub fn value_with_octaves(&self, p: V, octaves: f32) -> f32 {
        self.ask_of(&self.active(octaves), Value(p))
    }

    /// Returns value and gradient of the first `octaves` octaves at a point.
    ///
    /// The bits of [`with_octaves`](Self::with_octaves), without a copy of the sum.
    #[must_use]
    #[inline]
    pub fn sample_with_octaves(&self, p: V, octaves: f32) -> Sample<V> {
        self.ask_of(&self.active(octaves), SampleAt(p))
    }

    /// Returns the value at a point, [band-limited](Self::band_limited) to a footprint.
    ///
    /// The bits of [`band_limited`](Self::band_limited), without a copy of the sum.
    #[must_use]
    #[inline]
    pub fn value_band_limited(&self, p: V, footprint: f32) -> f32 {
        self.ask_of(&self.active_band_limited(self.active, footprint), Value(p))
    }

    /// Returns value and gradient at a point, [band-limited](Self::band_limited) to a footprint.
    ///
    /// The bits of [`band_limited`](Self::band_limited), without a copy of the sum.
    #[must_use]
    #[inline]
    pub fn sample_band_limited(&self, p: V, footprint: f32) -> Sample<V> {
        self.ask_of(&self.active_band_limited(self.active, footprint), SampleAt(p))
    }

    /// Returns mean and standard deviation of one octave of amplitude 1, after its shape.
    ///
    /// They are the middle of the range and 1 for a field without [`moments`](Field::moments).
    #[must_use]
    #[inline]
    pub fn octave_moments(&self) -> [f32; 2] {
        let Some(moments) = self.field.moments() else {
            let [low, high] = self.bounds();
            let middle = 0.5 * low + 0.5 * high;
            return [if middle.is_finite() { middle } else { 0.0 }, 1.0];
        };
        if T::IS_IDENTITY {
            return [moments.mean, moments.standard_deviation];
        }
        self.shape.mean_and_deviation(moments.standard_deviation, moments.absolute)
    }

    /// Returns the mean of the sum: the measured mean of the shape under
    /// [`Normalization::UnitRange`], otherwise 0.
    ///
    /// Without octaves the mean is 0.
    #[must_use]
    pub fn mean(&self) -> f32 {
        match self.normalization {
            Normalization::UnitRange if self.active.octaves > 0.0 => self.octave_moments()[0],
            _ => 0.0,
        }
    }

    /// Returns the measured standard deviation of the sum before it is
    /// [`band_limited`](Self::band_limited).
    ///
    /// It is 1 under [`Normalization::UnitVariance`], and 0 without octaves.
    #[must_use]
    pub fn standard_deviation(&self) -> f32 {
        let squares = self.spectrum.root_sum_of_squares(lone_whole(self.active.octaves));
        self.active.factor * self.octave_moments()[1] * squares
    }
}

impl<F, V: Point<Coordinates = [f32; N]>, T, const N: usize> Fbm<F, V, T> {
    /// Returns octave i of the spectrum, whether it is active or not.
    pub(crate) fn octave(&self, i: usize) -> Octave<N> {
        self.layers.octave(i)
    }
}

impl<F: Field<V>, V: Point, T: Shape> Field<V> for Fbm<F, V, T> {
    #[inline]
    fn sample(&self, p: V) -> Sample<V> {
        self.ask(SampleAt(p))
    }

    #[inline]
    fn value(&self, p: V) -> f32 {
        self.ask(Value(p))
    }

    fn range(&self) -> [f32; 2] {
        self.active.range
    }

    fn fill(&self, points: &Points<'_, V>, target: Target<'_, V>) {
        self.ask(Batch(points, target));
    }
}

impl<F: Noise, V: Point<Coordinates = [f32; N]>, const N: usize> Fbm<F, V> {
    /// Returns the excess kurtosis of the sum, from the measured kurtosis of the kind.
    #[must_use]
    pub fn excess_kurtosis(&self) -> f32 {
        self.field.statistics(N).excess_kurtosis * self.spectrum.kurtosis_ratio(self.active.octaves)
    }
}

impl<L: Lattice, V: Point<Coordinates = [f32; N]>, const N: usize> Fbm<GaussianNoise<L>, V> {
    /// Evaluates two independent channels in one pass over the lattices.
    ///
    /// The first channel is [`sample`](Field::sample).
    #[must_use]
    #[inline]
    pub fn pair(&self, p: V) -> [Sample<V>; 2] {
        self.pair_of(&self.active, p)
    }

    /// Evaluates two independent channels of the first `octaves` octaves.
    #[must_use]
    #[inline]
    pub fn pair_with_octaves(&self, p: V, octaves: f32) -> [Sample<V>; 2] {
        self.pair_of(&self.active(octaves), p)
    }

    /// Returns the whitened gradient in the plane of two tangents: two independent N(0, 1) at every
    /// point, which look like the slopes of a relief.
    ///
    /// ```text
    /// z = Σ wᵢ aᵢ (Bᵀ Cᵢ B)^(−1/2) Bᵀ ∇nᵢ / √Σ wᵢ² aᵢ²,   Cᵢ = Cov(∇nᵢ),   B = (tangents as columns)
    /// ```
    ///
    /// The gradient of one octave at a point is a linear combination of Gaussian variates, with a
    /// covariance in closed form. Its symmetric inverse root makes the gradient standard Gaussian.
    ///
    /// - **Tangents:** an orthonormal basis of the tangent plane at `p`; in 2-D usually the axes.
    ///   The result rotates with the basis. A common factor of both has no effect.
    /// - **Octaves:** aᵢ is the amplitude of the slopes of an octave, not of its height: z has the
    ///   spectrum of [`sample`](Field::sample), and [`resolved_variance`](Self::resolved_variance)
    ///   holds. The two channels of [`pair`](Self::pair) have the same distribution and no relief.
    /// - **Range:** ℝ². Octaves at points that are not finite, or with parallel or non-finite
    ///   tangents, are 0.
    /// - **Continuity:** C¹ in `p` and in the tangents.
    ///
    /// ```
    /// use asperity_noise::{GaussianFbm, GaussianNoise, FbmSpectrum, glam::Vec3};
    ///
    /// let noise = GaussianFbm::new(GaussianNoise::new(1), FbmSpectrum::default());
    /// let square = (0..10_000).map(|i| {
    ///     let [x, y] = noise.whitened_gradient(Vec3::new(i as f32, 0.3, 0.7), [Vec3::X, Vec3::Y]);
    ///     0.5 * (x * x + y * y)
    /// });
    /// assert!((square.sum::<f32>() / 10_000.0 - 1.0).abs() < 0.05);
    /// ```
    #[must_use]
    #[inline]
    pub fn whitened_gradient(&self, p: V, tangents: [V; 2]) -> [f32; 2] {
        self.whitened_of(&self.active, p, tangents)
    }

    /// Returns the [whitened gradient](Self::whitened_gradient) of the first `octaves` octaves.
    #[must_use]
    #[inline]
    pub fn whitened_gradient_with_octaves(&self, p: V, tangents: [V; 2], octaves: f32) -> [f32; 2] {
        self.whitened_of(&self.active(octaves), p, tangents)
    }

    /// Returns the height whose slopes the [whitened gradient](Self::whitened_gradient) has, up to
    /// its whitening, with its gradient.
    ///
    /// ```text
    /// h = Σ wᵢ aᵢ nᵢ/fᵢ / √(κ Σ wᵢ² aᵢ²),   κ = mean of Var(∂n/∂x) over the cell
    /// ```
    ///
    /// The slopes of h along every direction have variance 1 over the lattice, and 0.2 to 1.9 at a
    /// point in 3-D. The whitened gradient has variance 1 at every point. The correlation of both is
    /// 0.98 (measured in 3-D).
    ///
    /// - **Range:** ℝ, in cells of the first octave. 0 at points that are not finite.
    /// - **Continuity:** C² in `p`.
    ///
    /// ```
    /// use asperity_noise::{GaussianFbm, GaussianNoise, FbmSpectrum, Sample, glam::Vec3};
    ///
    /// let noise = GaussianFbm::new(GaussianNoise::new(1), FbmSpectrum::default());
    /// let p = Vec3::new(0.3, 0.4, 0.5);
    /// let Sample { value, gradient } = noise.height(p);
    /// let step = noise.height(p + Vec3::X * 1e-3).value - value;
    /// assert!((step / 1e-3 - gradient.x).abs() < 0.2);
    /// ```
    #[must_use]
    pub fn height(&self, p: V) -> Sample<V> {
        self.height_of(&self.active, p)
    }

    /// Returns the [height](Self::height) of the first `octaves` octaves.
    #[must_use]
    pub fn height_with_octaves(&self, p: V, octaves: f32) -> Sample<V> {
        self.height_of(&self.active(octaves), p)
    }

    fn height_of(&self, active: &Active, p: V) -> Sample<V> {
        let p = in_first_tile(Scalar, p.coordinates(), &periods::<_, N>(&self.field));
        let (mut own, mut sum, mut frequency) = (None, (0.0, [0.0; N]), 1.0);
        for (amplitude, layer) in octaves(&self.layers, active) {
            let noise = layer.noise(&self.field, &mut own);
            let octave = noise.unnormalized_at(layer.points(Scalar, p), layer.seed);
            layer.accumulate(Scalar, &mut sum, amplitude / frequency, octave);
            frequency *= self.spectrum.lacunarity();
        }
        let factor = active.factor * SLOPE_UNIT[N.min(4)];
        Sample { value: sum.0 * factor, gradient: V::from_coordinates(scaled(sum.1, factor)) }
    }

    #[inline]
    fn whitened_of(&self, active: &Active, p: V, tangents: [V; 2]) -> [f32; 2] {
        let p = in_first_tile(Scalar, p.coordinates(), &periods::<_, N>(&self.field));
        let sums = at_point(&self.layers, active, p).whitened(&self.field, tangents.map(Point::coordinates));
        sums.map(|z| z * active.factor)
    }

    #[inline]
    fn pair_of(&self, active: &Active, p: V) -> [Sample<V>; 2] {
        let mut sums = [(0.0, [0.0; N]); 2];
        let at_point = at_point(&self.layers, active, p.coordinates());
        if !(L::SHARED && at_point.add_pair(&self.field, &mut sums).is_some()) {
            let p = in_first_tile(Scalar, p.coordinates(), &periods::<_, N>(&self.field));
            let mut own = None;
            for (amplitude, layer) in octaves(&self.layers, active) {
                let (p, noise) = (layer.points(Scalar, p), layer.noise(&self.field, &mut own));
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

impl<F, V, const N: usize> HasHessian<V> for Fbm<F, V>
where
    F: HasHessian<V>,
    V: Point<Coordinates = [f32; N], Matrix = [[f32; N]; N]>,
{
    fn sample_with_hessian(&self, p: V) -> SampleHessian<V> {
        let p = self.field.visit(InFirstTile(p)).coordinates();
        let (mut sum, mut hessian) = ((0.0, [0.0; N]), [[0.0; N]; N]);
        for (amplitude, layer) in octaves(&self.layers, &self.active) {
            let key = OctaveOf { seed: layer.seed, frequency: layer.matrix[0][0], cell: &layer.cell };
            let q = V::from_coordinates(layer.points(Scalar, p));
            let octave = match self.field.with_octave_seed(layer.seed) {
                Some(octave) => octave.sample_with_hessian(q),
                None => self.field.octave_with_hessian(q, key),
            };
            let sample = (octave.value, octave.gradient.coordinates());
            layer.accumulate(Scalar, &mut sum, amplitude, sample);
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
        let factor = self.active.factor;
        for row in &mut hessian {
            *row = scaled(*row, factor);
        }
        Jet { value: sum.0 * factor, gradient: scaled(sum.1, factor), hessian }.at()
    }
}
