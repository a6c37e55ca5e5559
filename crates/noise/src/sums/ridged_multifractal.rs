//! Ridged multifractals: octaves weighted by the previous octave.

use asperity_core::lanes::Task;

use crate::{
    contract::field::Field,
    contract::kernel::Kernel,
    contract::kernel::LIST,
    error::NoiseError,
    lanes::{Lanes, Scalar},
    lattice::tiled::in_first_tile,
    point::Point,
    row::points::{Points, Target},
    sample::Sample,
    sums::fbm::{Fbm, Normalization, Query, Sum},
    sums::octave::Layer,
    sums::pass::{Lists, copy_out},
    sums::shape::Shape,
    sums::spectrum::FbmSpectrum,
    sums::turbulence::Ridged,
};

/// A sum of ridged octaves in which an octave is strong only where the previous octave is.
///
#[cfg_attr(doc, doc = include_str!("../../docs/pictures/ridged_multifractal.md"))]
///
/// ```text
/// n(p) = Σ wᵢ aᵢ sᵢ / Σ wᵢ aᵢ,   sᵢ = vᵢ (1 − |nᵢ|)²,   v₀ = 1,   vᵢ₊₁ = min(1, feedback · sᵢ)
/// ```
///
/// Valleys stay smooth and ridges are rough. The gradient includes the gradients of the weights. At
/// a crease of |nᵢ| sign(0) = 0. Where a weight is clamped to 1 its gradient is 0.
///
/// - **Range:** [0, 1] for kinds of range 1. The mean depends on the feedback and is unknown.
///
/// Musgrave in Ebert (ed.) 1994, the ridged multifractal with offset 1, divided here by Σ wᵢ aᵢ.
///
/// ```
/// use asperity_noise::{Field, Perlin, RidgedMultifractal, FbmSpectrum, glam::Vec2};
///
/// let mountains = RidgedMultifractal::new(Perlin::new(1), FbmSpectrum::CLOUD, 2.0)?;
/// let sample = mountains.with_octaves(7.5).sample(Vec2::new(0.3, 0.8));
/// assert!((0.0..=1.0).contains(&sample.value));
/// # Ok::<(), asperity_noise::NoiseError>(())
/// ```
#[doc(alias("ridged", "terrain", "mountains"))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RidgedMultifractal<F, V: Point> {
    octaves: Fbm<F, V, Ridged>,
    feedback: f32,
}

impl<F: Field<V>, V: Point> RidgedMultifractal<F, V> {
    /// Creates the sum of octaves of `field`, each randomly rotated.
    ///
    /// # Errors
    ///
    /// If `feedback` is negative or not finite.
    pub fn new(field: F, spectrum: FbmSpectrum, feedback: f32) -> Result<Self, NoiseError> {
        Self::from_fbm(Fbm::new(field, spectrum), feedback)
    }

    /// Creates a ridged multifractal from the octaves of another sum.
    ///
    /// The sum may be [tiled](Fbm::tiled) or [anchored](Fbm::anchored).
    ///
    /// # Errors
    ///
    /// If `feedback` is negative or not finite.
    pub fn from_fbm(octaves: Fbm<F, V>, feedback: f32) -> Result<Self, NoiseError> {
        if !(feedback >= 0.0 && feedback.is_finite()) {
            let rule = "finite and at least 0";
            return Err(NoiseError::Invalid { parameter: "feedback", value: feedback, rule });
        }
        let octaves = octaves.with_normalization(Normalization::UnitRange).with_shape(Ridged);
        Ok(Self { octaves, feedback })
    }

    /// Limits the sum to the first `octaves` octaves; a fraction reduces the amplitude of the last.
    #[must_use]
    pub fn with_octaves(self, octaves: f32) -> Self {
        Self { octaves: self.octaves.with_octaves(octaves), ..self }
    }

    /// Returns the factor from an octave to the weight of the next.
    #[must_use]
    pub const fn feedback(&self) -> f32 {
        self.feedback
    }
}

impl<F: Field<V>, V: Point> Field<V> for RidgedMultifractal<F, V> {
    fn sample(&self, p: V) -> Sample<V> {
        self.octaves.ask(SampleAt(p, self.feedback))
    }

    fn value(&self, p: V) -> f32 {
        self.octaves.ask(Value(p, self.feedback))
    }

    fn range(&self) -> [f32; 2] {
        let ([low, high], zero) = (self.octaves.range(), self.octaves.of_zeros());
        // A weak octave adds less than a lone octave, and at least 0.
        [low.min(zero), high]
    }

    fn fill(&self, points: &Points<'_, V>, target: Target<'_, V>) {
        self.octaves.ask(Batch { points, target, feedback: self.feedback });
    }
}

/// Value and gradient at a point, with the feedback.
struct SampleAt<V>(V, f32);

impl<V: Point> Query<V, Ridged> for SampleAt<V> {
    type Output = Sample<V>;

    #[inline]
    fn of<K: Kernel<N>, const N: usize>(self, sum: &Sum<'_, K, N, Ridged>) -> Sample<V>
    where
        V: Point<Coordinates = [f32; N]>,
    {
        let (Self(p, feedback), passes, mut own) = (self, sum.passes(), None);
        let p = in_first_tile(Scalar, p.coordinates(), &passes.periods);
        let (mut sum, mut weight) = ((0.0, [0.0; N]), (1.0, [0.0; N]));
        for (amplitude, layer) in passes.amplitudes.iter().zip(passes.layers.iter()) {
            let noise = layer.noise(passes.noise, &mut own);
            let (n, slopes) = noise.sample_at(layer.points(Scalar, p), layer.seed);
            let (value, slope) = (Ridged.value(n), Ridged.slope(n));
            let slopes = layer.pull_back(Scalar, slopes.map(|g| slope * g));
            let ridge = weight.0 * value;
            sum.0 += amplitude * ridge;
            let next = feedback * ridge;
            for axis in 0..N {
                let slope = weight.0 * slopes[axis] + weight.1[axis] * value;
                sum.1[axis] += amplitude * slope;
                weight.1[axis] = if next < 1.0 { feedback * slope } else { 0.0 };
            }
            weight.0 = if next < 1.0 { next } else { 1.0 };
        }
        let gradient = V::from_coordinates(sum.1.map(|g| g * passes.factor));
        Sample { value: sum.0 * passes.factor, gradient }
    }
}

/// The value at a point, with the feedback.
struct Value<V>(V, f32);

impl<V: Point> Query<V, Ridged> for Value<V> {
    type Output = f32;

    #[inline]
    fn of<K: Kernel<N>, const N: usize>(self, sum: &Sum<'_, K, N, Ridged>) -> f32
    where
        V: Point<Coordinates = [f32; N]>,
    {
        let (Self(p, feedback), passes, mut own) = (self, sum.passes(), None);
        let p = in_first_tile(Scalar, p.coordinates(), &passes.periods);
        let (mut sum, mut weight) = (0.0, 1.0);
        for (amplitude, layer) in passes.amplitudes.iter().zip(passes.layers.iter()) {
            let noise = layer.noise(passes.noise, &mut own);
            let n = noise.value_at(layer.points(Scalar, p), layer.seed);
            let ridge = weight * Ridged.value(n);
            sum += amplitude * ridge;
            let next = feedback * ridge;
            weight = if next < 1.0 { next } else { 1.0 };
        }
        sum * passes.factor
    }
}

/// A list or a grid.
struct Batch<'p, 'a, 't, V: Point> {
    points: &'p Points<'a, V>,
    target: Target<'t, V>,
    feedback: f32,
}

impl<V: Point> Query<V, Ridged> for Batch<'_, '_, '_, V> {
    type Output = ();

    fn of<K: Kernel<N>, const N: usize>(self, sum: &Sum<'_, K, N, Ridged>)
    where
        V: Point<Coordinates = [f32; N]>,
    {
        let (Self { points, mut target, feedback }, passes) = (self, sum.passes());
        let (instructions, wanted) = (target.instructions, target.gradients.is_some());
        for block in points.blocks(LIST) {
            let count = block.len();
            let mut sums = Sums::empty();
            passes.each_octave(
                &points.part(&block),
                instructions,
                wanted,
                |(_, amplitude, layer), octave, slopes| {
                    let (slopes, sums) = (wanted.then_some(slopes), &mut sums);
                    instructions.run(Add { layer, amplitude, feedback, octave, slopes, sums, count });
                },
            );
            for value in sums.value.iter_mut().chain(sums.gradient.as_flattened_mut()) {
                *value *= passes.factor;
            }
            copy_out(&mut target.part(&block), &block, &sums.value, &sums.gradient);
        }
    }
}

/// The sums at the points of a list, and the weights of the next octave.
struct Sums<const N: usize> {
    value: [f32; LIST],
    gradient: Lists<N>,
    weight: [f32; LIST],
    slope: Lists<N>,
}

impl<const N: usize> Sums<N> {
    #[inline(always)]
    fn empty() -> Self {
        Self { value: [0.0; LIST], gradient: [[0.0; LIST]; N], weight: [1.0; LIST], slope: [[0.0; LIST]; N] }
    }
}

/// Adds a weighted octave and computes the weights of the next.
struct Add<'a, const N: usize> {
    layer: &'a Layer<N>,
    amplitude: f32,
    feedback: f32,
    octave: &'a [f32; LIST],
    slopes: Option<&'a Lists<N>>,
    sums: &'a mut Sums<N>,
    count: usize,
}

impl<const N: usize> Task for Add<'_, N> {
    type Output = ();

    #[inline(always)]
    fn run<S: Lanes>(self, s: S) {
        let Self { layer, octave, slopes, sums, count, .. } = self;
        let [amplitude, feedback] = [self.amplitude, self.feedback].map(|x| s.float(x));
        let (zero, one) = (s.float(0.0), s.float(1.0));
        let (mut ridges, mut bends) = ([0.0; LIST], [0.0; LIST]);
        for (ridge, n) in ridges.iter_mut().zip(octave) {
            *ridge = Ridged.value(*n);
        }
        if slopes.is_some() {
            for (bend, n) in bends.iter_mut().zip(octave) {
                *bend = Ridged.slope(*n);
            }
        }
        for i in (0..count.min(LIST)).step_by(S::LEN) {
            let (value, weight) = (s.load(&ridges[i..]), s.load(&sums.weight[i..]));
            let ridge = weight * value;
            s.store(s.load(&sums.value[i..]) + amplitude * ridge, &mut sums.value[i..]);
            let next = feedback * ridge;
            let below = s.less(next, one);
            if let Some(slopes) = slopes {
                let mut slope = [zero; N];
                for axis in 0..N {
                    slope[axis] = s.load(&bends[i..]) * s.load(&slopes[axis][i..]);
                }
                let slope = layer.pull_back(s, slope);
                for axis in 0..N {
                    let slope = weight * slope[axis] + s.load(&sums.slope[axis][i..]) * value;
                    let gradient = s.load(&sums.gradient[axis][i..]) + amplitude * slope;
                    s.store(gradient, &mut sums.gradient[axis][i..]);
                    s.store(s.select(below, feedback * slope, zero), &mut sums.slope[axis][i..]);
                }
            }
            s.store(s.select(below, next, one), &mut sums.weight[i..]);
        }
    }
}
