//! Fields: values and gradients at single points, in lists and on grids.

use asperity_core::BatchError;

use crate::{
    contract::many,
    lanes::level::Level,
    point::Point,
    row::grid::Grid,
    row::points::{Points, Target},
    sample::{Sample, SampleHessian},
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
/// use asperity_noise::{Add, Field, Grid, Fbm, Perlin, Sample, FbmSpectrum, glam::Vec2};
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

    /// Evaluates lists and grids, by default point by point.
    #[doc(hidden)]
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
}

/// A field with second derivatives.
///
/// Implemented for [`PerlinClassic`](crate::PerlinClassic), [`Perlin`](crate::Perlin),
/// [`Simplex`](crate::Simplex), [`GaussianNoise`](crate::GaussianNoise), [`ValueNoise`](crate::ValueNoise) and
/// [`ValueGradient`](crate::ValueGradient) in 1 to 4 dimensions, and for the sums of their octaves.
/// Value and gradient have the bits of [`Field::sample`].
///
/// ```text
/// H = Σ wᵢ aᵢ Mᵢᵀ Hᵢ(Mᵢ p + oᵢ) Mᵢ / N,   Mᵢ = fᵢ Rᵢ,   of a sum of octaves
/// ```
///
/// - **Continuity:** quintic weights are C², so the Hessians of Perlin noise of 2002 and of
///   Gaussian noise are continuous. The Hessian of simplex noise with r² = ½ is smooth. Cubic
///   weights are only C¹: the Hessian of [`PerlinClassic`](crate::PerlinClassic) is discontinuous at cell
///   borders, where w″ jumps from −6 to 6. On a border it is the Hessian of the cell above. Wide
///   simplex noise is itself discontinuous.
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
