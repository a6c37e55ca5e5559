//! Fields: values and gradients at single points, in lists and on grids.

use core::{array, marker::PhantomData, mem, ops::Range};

use asperity_core::BatchError;

use crate::{
    contract::kernel::{FillList, Kernel, Measured},
    contract::many,
    lanes::level::{Instructions, Level},
    lanes::{LANES, LaneSample, Lanes, Scalar, lane_of},
    lattice::integer_hash::IntegerHash,
    lattice::lattice::Lattice,
    point::{Dimension, InDimension, Point},
    row::grid::Grid,
    row::points::{Points, Target},
    row::row::Row,
    sample::{Sample, SampleHessian},
    statistics::statistics::{Moments, Statistics},
};

/// A function of points `V` with its gradient: a noise, a sum of octaves, a warp, or your own.
///
/// The trait is dyn-compatible. `Box<dyn Field<Vec3>>` and `&dyn Field<Vec3>` are fields too, and
/// evaluate grids as fast as the inner field. The fields of this crate evaluate grids and lists
/// with SIMD. A custom field implements only [`sample`](Self::sample) and is evaluated point by
/// point. All methods return the same bits for a point.
///
/// Fields of this crate are total. At a point with an infinite or NaN coordinate a kind has value 0
/// and gradient 0. From |x| = 2²³ on, `f32` holds only integers, so noise is evaluated at lattice
/// points only. From 2³¹ on, cells wrap modulo 2³².
///
/// ```
/// use asperity_noise::{Field, Grid, Fbm, Perlin, Sample, FbmSpectrum, glam::Vec2, ops::Add};
///
/// /// A custom field: dunes along x.
/// struct Dunes;
///
/// impl Field<Vec2> for Dunes {
///     fn sample(&self, p: Vec2) -> Sample<Vec2> {
///         let t = p.x - p.x.floor();
///         Sample { value: t * (1.0 - t), gradient: Vec2::new(1.0 - 2.0 * t, 0.0) }
///     }
/// }
///
/// fn land(seed: u32, rough: bool) -> Box<dyn Field<Vec2>> {
///     let noise = Fbm::new(Perlin::new(seed), FbmSpectrum::default());
///     if rough { Box::new(Add(Dunes, noise)) } else { Box::new(Dunes) }
/// }
///
/// let (land, p) = (land(42, true), Vec2::new(0.5, 0.25));
/// assert_eq!(land.value(p), land.sample(p).value);
///
/// let grid = Grid { origin: Vec2::ZERO, step: Vec2::splat(0.25), size: [64, 48] };
/// let mut heights = vec![0.0; grid.len()];
/// land.grid_values(&grid, &mut heights)?;
/// assert_eq!(heights[64 + 2], land.value(p));
/// # Ok::<(), asperity_noise::BatchError>(())
/// ```
#[doc(alias("noise", "heightmap", "terrain", "NoiseFn"))]
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a field over points `{V}`",
    note = "kinds, sums and transforms are fields over `f32` and over `Vec2`, `Vec3` and `Vec4` of `asperity_noise::glam`",
    note = "convert an array with `Vec3::from(array)`, a vector of another glam version with `Vec3::from(v.to_array())`",
    note = "a field of your own implements `fn sample(&self, p: V) -> Sample<V>`"
)]
pub trait Field<V: Point> {
    /// Returns value and gradient at a point.
    #[must_use]
    fn sample(&self, p: V) -> Sample<V>;

    /// Returns the value at a point, with the same bits as [`sample`](Self::sample).
    #[must_use]
    #[inline]
    fn value(&self, p: V) -> f32 {
        self.sample(p).value
    }

    /// Returns lower and upper bound of all values, or ±∞ if unknown.
    ///
    /// Every value of a field of this crate is within the range, including rounding, so the value
    /// can be scaled to an index.
    #[must_use]
    fn range(&self) -> [f32; 2] {
        [f32::NEG_INFINITY, f32::INFINITY]
    }

    /// Returns the moments of the values over all points and seeds, or `None` if unknown.
    ///
    /// Sums of octaves use them for [`Normalization::UnitVariance`](crate::Normalization), and the
    /// mean for [`Fbm::band_limited`](crate::Fbm::band_limited).
    #[must_use]
    fn moments(&self) -> Option<Moments> {
        None
    }

    /// Returns the seed of a random field, and 0 for other fields.
    #[must_use]
    fn seed(&self) -> u32 {
        0
    }

    /// Returns the field that another seed selects, or `None` if the field has no seed.
    ///
    /// Override it and [`seed`](Self::seed) in a random field of your own, so that the octaves of
    /// its sum are independent. Sums pass one seed for each octave.
    #[must_use]
    fn with_octave_seed(&self, _seed: u32) -> Option<Self>
    where
        Self: Sized,
    {
        None
    }

    /// Evaluates the values at a list of points.
    ///
    /// # Errors
    ///
    /// If the lengths of `values` and `points` differ.
    fn values(&self, points: &[V], values: &mut [f32]) -> Result<(), BatchError> {
        many::values(Level::best(), &|points, target| self.fill(points, target), points, values)
    }

    /// Evaluates values and gradients at a list of points.
    ///
    /// # Errors
    ///
    /// If the lengths of `samples` and `points` differ.
    fn samples(&self, points: &[V], samples: &mut [Sample<V>]) -> Result<(), BatchError> {
        many::samples(Level::best(), &|points, target| self.fill(points, target), points, samples)
    }

    /// Evaluates the values on a grid, with the first axis fastest.
    ///
    /// # Errors
    ///
    /// If the length of `values` is not the number of grid points.
    fn grid_values(&self, grid: &Grid<V>, values: &mut [f32]) -> Result<(), BatchError> {
        many::grid(Level::best(), &|points, target| self.fill(points, target), grid, values, None)
    }

    /// Evaluates values and gradients on a grid, with the first axis fastest.
    ///
    /// `gradients` has one slice per component.
    ///
    /// ```
    /// use asperity_noise::{Field, Grid, Perlin, glam::Vec2};
    ///
    /// let noise = Perlin::new(1);
    /// let grid = Grid { origin: Vec2::new(-3.0, 5.0), step: Vec2::splat(0.05), size: [100, 80] };
    /// let (mut values, mut dx, mut dy) = ([0.0; 8000], [0.0; 8000], [0.0; 8000]);
    /// noise.grid_samples(&grid, &mut values, [&mut dx, &mut dy])?;
    ///
    /// let sample = noise.sample(grid.point([7, 3]));
    /// assert_eq!((values[307], dx[307], dy[307]), (sample.value, sample.gradient.x, sample.gradient.y));
    /// # Ok::<(), asperity_noise::BatchError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// If the length of `values` or of a component of `gradients` is not the number of grid points.
    fn grid_samples<'a>(
        &self,
        grid: &Grid<V>,
        values: &'a mut [f32],
        gradients: V::Array<&'a mut [f32]>,
    ) -> Result<(), BatchError> {
        many::grid(Level::best(), &|points, target| self.fill(points, target), grid, values, Some(gradients))
    }

    /// Evaluates the values on some rows of a grid, with the bits of the whole grid.
    ///
    /// Threads can share a grid in this way. Rows are counted over all axes but the first; those
    /// after the last do not exist.
    ///
    /// ```
    /// use asperity_noise::{Field, Grid, Perlin, glam::Vec3};
    ///
    /// let noise = Perlin::new(1);
    /// let grid = Grid { origin: Vec3::ZERO, step: Vec3::splat(0.1), size: [50, 40, 3] };
    /// let (mut all, mut part) = ([0.0; 6000], [0.0; 1000]);
    /// noise.grid_values(&grid, &mut all)?;
    /// noise.grid_row_values(&grid, 30..50, &mut part)?;
    /// assert_eq!(all[1500..2500], part);
    /// # Ok::<(), asperity_noise::BatchError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// If the length of `values` is not the number of points of these rows.
    fn grid_row_values(
        &self,
        grid: &Grid<V>,
        rows: Range<usize>,
        values: &mut [f32],
    ) -> Result<(), BatchError> {
        many::rows(&|points, target| self.fill(points, target), grid, rows, values, None)
    }

    /// Evaluates values and gradients on some rows of a grid, with the bits of the whole grid.
    ///
    /// As [`grid_row_values`](Self::grid_row_values), with one slice of `gradients` per component.
    ///
    /// # Errors
    ///
    /// If the length of `values` or of a component of `gradients` is not the number of points of
    /// these rows.
    fn grid_row_samples<'a>(
        &self,
        grid: &Grid<V>,
        rows: Range<usize>,
        values: &'a mut [f32],
        gradients: V::Array<&'a mut [f32]>,
    ) -> Result<(), BatchError> {
        many::rows(&|points, target| self.fill(points, target), grid, rows, values, Some(gradients))
    }

    /// Evaluates lists and grids, by default point by point.
    ///
    /// All batch methods call it. A wrapper of a field forwards it to keep the speed of the field.
    fn fill(&self, points: &Points<'_, V>, mut target: Target<'_, V>) {
        let width = points.width();
        for row in 0..points.rows() {
            let (values, mut gradients) = target.row(row, width);
            for (column, value) in values.iter_mut().enumerate() {
                let p = points.point(row, column);
                if let Some(gradients) = &mut gradients {
                    let sample = self.sample(p);
                    *value = sample.value;
                    let components = sample.gradient.coordinates();
                    for (g, x) in gradients.as_mut().iter_mut().zip(components.as_ref()) {
                        g[column] = *x;
                    }
                } else {
                    *value = self.value(p);
                }
            }
        }
    }

    /// Shows the kernel of the field to a sum of its octaves.
    #[doc(hidden)]
    #[inline(always)]
    fn visit<R: Visit<V>>(&self, visitor: R) -> R::Output
    where
        Self: Sized,
    {
        V::Coordinates::run(Seedless { field: self, visitor })
    }
}

/// What a sum of octaves does with the kernel of a field.
pub trait Visit<V: Point> {
    /// The result.
    type Output;

    /// Does it.
    fn kernel<K: Kernel<N>, const N: usize>(self, kernel: &K) -> Self::Output
    where
        V: Point<Coordinates = [f32; N]>;
}

/// A visitor of a field that is not a kind of this crate.
struct Seedless<'a, F, R> {
    field: &'a F,
    visitor: R,
}

impl<V: Point, F: Field<V>, R: Visit<V>> InDimension<V> for Seedless<'_, F, R> {
    type Output = R::Output;

    #[inline(always)]
    fn run<const N: usize>(self) -> R::Output
    where
        V: Point<Coordinates = [f32; N]>,
    {
        self.visitor.kernel(&Custom(self.field, PhantomData))
    }
}

/// A field as a kernel. It is evaluated at all points, near and far.
struct Custom<'a, F, V>(&'a F, PhantomData<V>);

impl<F: Field<V>, V: Point<Coordinates = [f32; N]>, const N: usize> Measured<N> for Custom<'_, F, V> {
    fn seed(&self) -> u32 {
        self.0.seed()
    }

    fn statistics(&self) -> &'static Statistics {
        &Statistics::UNKNOWN
    }
}

impl<F: Field<V>, V: Point<Coordinates = [f32; N]>, const N: usize> Kernel<N> for Custom<'_, F, V> {
    type RowScratch = ();

    /// The key of a kind that evaluates the octave elsewhere.
    fn key(&self, seed: u32) -> u32 {
        IntegerHash.key(seed)
    }

    /// Octaves of one function would look alike near the origin.
    fn spread(&self) -> f32 {
        if self.0.with_octave_seed(0).is_some() { 1.0 } else { 64.0 }
    }

    fn evaluate<S: Lanes, const GRADIENTS: bool>(&self, s: S, p: [S::F; N], seed: u32) -> LaneSample<S, N> {
        let lanes: [_; LANES] = array::from_fn(|lane| self.sample_at(lane_of(s, &p, lane % S::LEN), seed));
        let mut gradient = p;
        for axis in 0..N {
            gradient[axis] = s.floats(|lane| lanes[lane % LANES].1[axis]);
        }
        (s.floats(|lane| lanes[lane % LANES].0), gradient)
    }

    #[inline]
    fn value_at(&self, p: [f32; N], seed: u32) -> f32 {
        let p = V::from_coordinates(p);
        self.0.with_octave_seed(seed).map_or_else(|| self.0.value(p), |octave| octave.value(p))
    }

    #[inline]
    fn sample_at(&self, p: [f32; N], seed: u32) -> LaneSample<Scalar, N> {
        let p = V::from_coordinates(p);
        let octave = self.0.with_octave_seed(seed);
        let sample = octave.map_or_else(|| self.0.sample(p), |octave| octave.sample(p));
        (sample.value, sample.gradient.coordinates())
    }

    fn fill_list(call: FillList<'_, Self, N>, instructions: Instructions) {
        let FillList { kernel, seed, points, values, mut gradients } = call;
        let stride = values.len();
        let gradients = gradients.as_mut().map(|g| V::array(|axis| mem::take(&mut g[axis])));
        let points = Points::lists(V::array(|axis| points[axis]));
        let target = Target { instructions, values, gradients, stride };
        match kernel.0.with_octave_seed(seed) {
            Some(octave) => octave.fill(&points, target),
            None => kernel.0.fill(&points, target),
        }
    }

    #[inline(always)]
    fn reuses(&self, _: &Row<N>, _: usize, _: bool) -> bool {
        false
    }
}

/// A field with second derivatives.
///
/// Implemented for [`PerlinClassic`](crate::PerlinClassic), [`Perlin`](crate::Perlin),
/// [`Simplex`](crate::Simplex), [`GaussianNoise`](crate::GaussianNoise),
/// [`ValueNoise`](crate::ValueNoise) and [`ValueGradient`](crate::ValueGradient) in 1 to 4
/// dimensions, and for the sums of their octaves. Value and gradient have the bits of
/// [`Field::sample`].
///
/// ```text
/// H = Σ wᵢ aᵢ Mᵢᵀ Hᵢ(Mᵢ p + oᵢ) Mᵢ / N,   Mᵢ = fᵢ Rᵢ,   of a sum of octaves
/// ```
///
/// - **Continuity:** quintic weights are C², so the Hessians of Perlin noise of 2002 and of
///   Gaussian noise are continuous. The Hessian of simplex noise with r² = ½ is smooth. Cubic
///   weights are only C¹: the Hessian of [`PerlinClassic`](crate::PerlinClassic) is discontinuous
///   at cell borders, where w″ jumps from −6 to 6. On a border it is the Hessian of the cell above.
///   Wide simplex noise is itself discontinuous.
/// - **NaN and ∞:** points that are not finite give 0.
///
/// ```
/// use asperity_noise::{HasHessian, Field, Perlin, glam::Vec2};
///
/// let (noise, p, h) = (Perlin::new(1), Vec2::new(0.4, -2.7), 1e-3);
/// let there = noise.sample_with_hessian(p);
/// assert_eq!(there.gradient, noise.sample(p).gradient);
///
/// let [ahead, behind] = [h, -h].map(|h| noise.sample(p + Vec2::new(h, 0.0)).gradient);
/// let difference = (ahead - behind) / (2.0 * h);
/// assert!((there.hessian[0][0] - difference.x).abs() < 0.01 && (there.hessian[0][1] - difference.y).abs() < 0.01);
/// ```
#[doc(alias("hessian", "second derivative"))]
pub trait HasHessian<V: Point>: Field<V> {
    /// Returns value, gradient and Hessian at a point.
    #[must_use]
    fn sample_with_hessian(&self, p: V) -> SampleHessian<V>;

    /// Returns value, gradient and Hessian of an octave of a sum.
    #[doc(hidden)]
    fn octave_with_hessian(&self, p: V, _octave: OctaveOf<'_>) -> SampleHessian<V> {
        self.sample_with_hessian(p)
    }
}

/// What makes a kind the octave of a sum.
#[derive(Clone, Copy, Debug)]
pub struct OctaveOf<'a> {
    pub(crate) seed: u32,
    pub(crate) frequency: f32,
    pub(crate) cell: &'a [i32],
}

macro_rules! pointer {
    ($(#[$attribute:meta])* $pointer:ty) => {
        $(#[$attribute])*
        impl<V: Point, F: Field<V> + ?Sized> Field<V> for $pointer {
            #[inline]
            fn sample(&self, p: V) -> Sample<V> {
                (**self).sample(p)
            }
            #[inline]
            fn value(&self, p: V) -> f32 {
                (**self).value(p)
            }
            fn range(&self) -> [f32; 2] {
                (**self).range()
            }
            fn moments(&self) -> Option<Moments> {
                (**self).moments()
            }
            fn seed(&self) -> u32 {
                (**self).seed()
            }
            fn fill(&self, points: &Points<'_, V>, target: Target<'_, V>) {
                (**self).fill(points, target);
            }
        }

        $(#[$attribute])*
        impl<V: Point, F: HasHessian<V> + ?Sized> HasHessian<V> for $pointer {
            #[inline]
            fn sample_with_hessian(&self, p: V) -> SampleHessian<V> {
                (**self).sample_with_hessian(p)
            }
        }
    };
}

pointer!(&F);
pointer!(#[cfg(feature = "alloc")] alloc::boxed::Box<F>);
pointer!(#[cfg(feature = "alloc")] alloc::rc::Rc<F>);
pointer!(#[cfg(all(feature = "alloc", target_has_atomic = "ptr"))] alloc::sync::Arc<F>);
