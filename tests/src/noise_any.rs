//! Type-erased noise, one type per dimension, so that a test is compiled once per dimension instead
//! of once per noise.

use std::any::Any;

use asperity_noise::{
    Fbm, FbmSpectrum, Field, Lattice, Moments, Normalization, Point, Rotation, Sample, Statistics,
};

use crate::noise_kinds::{AnyKind, Testable, Visit, every_dimension, every_kind, every_variant};

/// Value and gradient as arrays.
pub type At<const N: usize> = Sample<[f32; N]>;

/// A noise evaluated at single points.
pub trait AnyNoise<const N: usize>: Sync {
    /// Returns value and gradient.
    fn sample(&self, p: [f32; N], seed: u32) -> At<N>;
    /// Returns the value.
    fn value(&self, p: [f32; N], seed: u32) -> f32;
    /// Returns the tabulated statistics.
    fn statistics(&self) -> &'static Statistics;
    /// Returns σ₁ of this noise.
    fn standard_deviation(&self) -> f32;
    /// Returns E|n|ᵏ, k = 1 … 4.
    fn absolute_moments(&self) -> [f32; 4];
    /// Returns a sum of its octaves.
    fn octaves(&self, normalisation: Normalization, rotation: Rotation, seed: u32) -> Box<dyn AnySum<N>>;
}

/// A sum of octaves with the default spectrum, evaluated at single points.
pub trait AnySum<const N: usize> {
    /// Returns value and gradient of the first octaves.
    fn sample(&self, p: [f32; N], octaves: f32) -> At<N>;
    /// Returns the value.
    fn value(&self, p: [f32; N], octaves: f32) -> f32;
}

/// Converts a sample to arrays.
#[must_use]
pub fn at<V: Point<Coordinates = [f32; N]>, const N: usize>(sample: Sample<V>) -> At<N> {
    Sample { value: sample.value, gradient: sample.gradient.coordinates() }
}

/// A noise or sum at points `V`.
struct Points<T, V>(T, std::marker::PhantomData<fn(V)>);

impl<V: Point<Coordinates = [f32; N]>, K: Testable<V, N>, const N: usize> AnyNoise<N> for Points<K, V> {
    fn sample(&self, p: [f32; N], seed: u32) -> At<N> {
        at(self.0.with_seed(seed).sample(V::from_coordinates(p)))
    }

    fn value(&self, p: [f32; N], seed: u32) -> f32 {
        self.0.with_seed(seed).value(V::from_coordinates(p))
    }

    fn statistics(&self) -> &'static Statistics {
        self.0.statistics(N)
    }

    fn standard_deviation(&self) -> f32 {
        self.0.moments().map_or(f32::NAN, |moments| moments.standard_deviation)
    }

    fn absolute_moments(&self) -> [f32; 4] {
        self.0.moments().map_or([f32::NAN; 4], |moments| moments.absolute)
    }

    fn octaves(&self, normalisation: Normalization, rotation: Rotation, seed: u32) -> Box<dyn AnySum<N>> {
        let octaves = Fbm::<K, V>::new(self.0.with_seed(seed), FbmSpectrum::default());
        let octaves = octaves.with_normalization(normalisation).with_rotation(rotation);
        Box::new(Points::<_, V>(octaves, std::marker::PhantomData))
    }
}

impl<V: Point<Coordinates = [f32; N]>, K: Testable<V, N>, const N: usize> AnySum<N> for Points<Fbm<K, V>, V> {
    fn sample(&self, p: [f32; N], octaves: f32) -> At<N> {
        at(self.0.sample_with_octaves(V::from_coordinates(p), octaves))
    }

    fn value(&self, p: [f32; N], octaves: f32) -> f32 {
        self.0.value_with_octaves(V::from_coordinates(p), octaves)
    }
}

/// A type-erased noise with a seed, for sums that are compiled once.
#[derive(Clone, Copy)]
pub struct AnyField<'a, const N: usize>(pub &'a dyn AnyNoise<N>, pub u32);

impl<const N: usize> Field<Coordinates<N>> for AnyField<'_, N> {
    fn sample(&self, Coordinates(p): Coordinates<N>) -> Sample<Coordinates<N>> {
        let Sample { value, gradient } = self.0.sample(p, self.1);
        Sample { value, gradient: Coordinates(gradient) }
    }

    fn value(&self, Coordinates(p): Coordinates<N>) -> f32 {
        self.0.value(p, self.1)
    }

    fn range(&self) -> [f32; 2] {
        let range = self.0.statistics().range;
        [-range, range]
    }

    fn moments(&self) -> Option<Moments> {
        let (standard_deviation, absolute) = (self.0.standard_deviation(), self.0.absolute_moments());
        Some(Moments { mean: 0.0, standard_deviation, absolute })
    }

    fn with_octave_seed(&self, seed: u32) -> Option<Self> {
        Some(Self(self.0, seed))
    }
}

/// The words of any lattice by cells of 1 to 4 coordinates, so that a noise is compiled once for
/// all lattices without additional terms.
#[derive(Clone, Copy)]
pub struct AnyLattice<'a>(pub &'a dyn Fn(&[i32], u32) -> u32);

impl Lattice for AnyLattice<'_> {
    fn word<const N: usize>(&self, cell: [i32; N], seed: u32) -> u32 {
        (self.0)(&cell, seed)
    }
}

/// Coordinates as a point of any dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<const N: usize>(pub [f32; N]);

impl<const N: usize> Default for Coordinates<N> {
    fn default() -> Self {
        Self([0.0; N])
    }
}

impl<const N: usize> Point for Coordinates<N> {
    type Coordinates = [f32; N];
    type Matrix = [[f32; N]; N];
    type Array<T> = [T; N];

    fn coordinates(self) -> [f32; N] {
        self.0
    }
    fn from_coordinates(coordinates: [f32; N]) -> Self {
        Self(coordinates)
    }
    fn array<T>(make: impl FnMut(usize) -> T) -> [T; N] {
        std::array::from_fn(make)
    }
    fn from_axes(make: impl FnMut(usize) -> f32) -> Self {
        Self(std::array::from_fn(make))
    }
}

/// Returns the factor by which the number of points is reduced for slow noises, which visit 3ⁿ or
/// 4ⁿ cells in 3-D and 4-D.
#[must_use]
pub fn thinning<const N: usize>(name: &str) -> u32 {
    match N {
        3 if name.contains("sparse") || name.contains("Catmull-Rom") => 2,
        4 if name.contains("sparse") || name.contains("Catmull-Rom") => 8,
        _ => 1,
    }
}

/// A noise with its name, e.g. `Perlin 2002 3-D`.
struct Named<const N: usize>(String, Box<dyn AnyNoise<N>>);

/// Noises of all dimensions.
#[derive(Default)]
pub struct Collection(Vec<Box<dyn Any>>);

impl Visit for Collection {
    fn visit<V: Point<Coordinates = [f32; N]>, K: Testable<V, N>, const N: usize>(
        &mut self,
        name: &str,
        noise: K,
    ) {
        let noise = Box::new(Points::<_, V>(noise, std::marker::PhantomData));
        self.0.push(Box::new(Named(name.to_owned(), noise)));
    }
}

impl Collection {
    /// Returns names and noises in N dimensions.
    ///
    /// # Panics
    ///
    /// If there is none, because the test would be empty.
    pub fn of<const N: usize>(&self) -> impl Iterator<Item = (&str, &dyn AnyNoise<N>)> {
        let mut named = self.0.iter().filter_map(|kind| kind.downcast_ref::<Named<N>>()).peekable();
        assert!(named.peek().is_some(), "no kind has {N} dimensions");
        named.map(|Named(name, noise)| (name.as_str(), noise.as_ref()))
    }
}

/// Calls a function generic over the dimension, with a name, a noise and further arguments, for
/// every noise of a [`Collection`].
#[macro_export]
macro_rules! in_every_dimension {
    ($collection:expr, $test:ident $(, $more:expr)?) => {{
        let collection = $collection;
        collection.of::<1>().for_each(|(name, noise)| $test(name, noise $(, $more)?));
        collection.of::<2>().for_each(|(name, noise)| $test(name, noise $(, $more)?));
        collection.of::<3>().for_each(|(name, noise)| $test(name, noise $(, $more)?));
        collection.of::<4>().for_each(|(name, noise)| $test(name, noise $(, $more)?));
    }};
}

/// Returns a collection of one noise.
#[must_use]
pub fn dimensions<K: AnyKind>(name: &str, noise: K) -> Collection {
    let mut collection = Collection::default();
    every_dimension(&mut collection, name, noise);
    collection
}

// Not generic, so that the noises are compiled with this crate and not with every test.

/// Returns every noise on the integer hash in 1 to 4 dimensions.
#[must_use]
pub fn kinds() -> Collection {
    let mut collection = Collection::default();
    every_kind(&mut collection);
    collection
}

/// Returns the parametric noises with non-default parameters.
#[must_use]
pub fn variants() -> Collection {
    let mut collection = Collection::default();
    every_variant(&mut collection);
    collection
}
