//! The height field of a tensor product, its gradient and its normal.

use asperity_core::Interval;
use glam::{DVec2, DVec3};

use crate::numeric::estimate::Bounded;
use crate::surface::bounds::{Surface, SurfaceBounds, upward_normal};
#[cfg(feature = "alloc")]
use crate::surface::height_field::axis_tables::BothAxes;
use crate::surface::height_field::cover::covered;
use crate::surface::height_field::curve::Curve;
use crate::surface::height_field::function::Function;

/// The surface `z = f(x) g(y)`; `f` and `g` may be different systems on different knots.
///
/// ```text
/// h(x, y) = f(x) g(y)      ∂h/∂x = f′(x) g(y)      ∂h/∂y = f(x) g′(y)      N = (−∂h/∂x, −∂h/∂y, 1) / |…|
/// ```
///
/// If both functions are continuously differentiable, it has gradients and normals, which the
/// constructor detects. Functions that are only continuous have heights and hits. Points outside
/// the domain are clamped to it; NaN returns NaN.
///
/// Cochran, Lewis, Hart 2000, eq. 41–45. The normal there is not of unit length; here it is.
///
/// ```
/// use asperity_fif::{HeightField, cochran_2000};
/// let surface = HeightField::new(cochran_2000::f_hat()?, cochran_2000::f_hat()?);
/// assert_eq!(surface.height(1.0, 1.0), 1.0);
/// let gradient = surface.gradient(1.0, 1.0).unwrap();
/// assert_eq!((gradient.x, gradient.y), (1.0, 1.0));
/// assert!((surface.normal(0.3, 1.7).unwrap().length() - 1.0).abs() < 1e-15);
/// # Ok::<(), asperity_fif::FifError>(())
/// ```
#[derive(Clone, Debug)]
#[doc(alias = "heightmap")]
#[doc(alias = "terrain")]
pub struct HeightField<F: Function, G: Function> {
    pub(crate) x: Curve<F>,
    pub(crate) y: Curve<G>,
    /// Constants for rays, if both axes have tables.
    #[cfg(feature = "alloc")]
    pub(crate) both: Option<BothAxes>,
}

impl<F: Function, G: Function> HeightField<F, G> {
    /// Creates the tensor product of `f` and `g`.
    ///
    /// Each is a [`Fif`](crate::Fif), a [`FixedFif`](crate::FixedFif) or a
    /// [`FifRef`](crate::FifRef), of up to eight coefficients.
    ///
    /// For a function of at most 64 maps that is only continuous, bounds of its cells are
    /// precomputed: 0.06 ms for two maps.
    #[must_use]
    pub fn new(f: F, g: G) -> Self {
        Self {
            x: Curve::new(f),
            y: Curve::new(g),
            #[cfg(feature = "alloc")]
            both: None,
        }
    }

    /// `f`, along x.
    #[must_use]
    pub const fn x(&self) -> &Curve<F> {
        &self.x
    }

    /// `g`, along y.
    #[must_use]
    pub const fn y(&self) -> &Curve<G> {
        &self.y
    }

    /// Adds tables along both axes, for hits that are an order of magnitude faster.
    ///
    /// The product of two tables bounds every box of the top levels, with `2 N^K` numbers instead
    /// of `N^{2K}`, and at most 1024 cells per axis. The ranges are hulls of those of finer cells,
    /// tighter than those computed during a descent. Smooth functions on equally spaced knots also
    /// have values and slopes in their tables; less than 0.5 MB per axis.
    ///
    /// ```
    /// use asperity_fif::{HeightField, Intersect, Ray, glam::DVec3, cochran_2000};
    /// let surface = HeightField::new(cochran_2000::f_hat()?, cochran_2000::f_hat()?).tabulated();
    /// let down = Ray { origin: DVec3::new(0.3, 1.2, 9.0), direction: DVec3::NEG_Z };
    /// let hit = surface.intersect(&down).unwrap();
    /// assert!((hit.t - (9.0 - surface.height(0.3, 1.2))).abs() < 1e-12);
    /// # Ok::<(), asperity_fif::FifError>(())
    /// ```
    #[cfg(feature = "alloc")]
    #[must_use]
    pub fn tabulated(self) -> Self {
        self.tabulated_with(1024)
    }

    /// Adds tables with at most `cells` cells per axis; 0 and 1 keep only the bounds of the domain.
    #[cfg(feature = "alloc")]
    #[must_use]
    pub fn tabulated_with(self, cells: usize) -> Self {
        let (x, y) = (self.x.tabulated(cells), self.y.tabulated(cells));
        let both = x.top().zip(y.top()).map(|(x, y)| BothAxes::new(x, y));
        Self { x, y, both }
    }

    /// `h` with an error bound; `tolerance` applies to each factor, relative to the magnitude of
    /// the other.
    ///
    /// ```text
    /// |h − f g| ≤ |f| δ_g + |g| δ_f + δ_f δ_g
    /// ```
    pub fn evaluate(&self, x: f64, y: f64, tolerance: f64) -> Bounded {
        let tolerance_for = |other: Interval| 0.5 * tolerance / other.magnitude().max(f64::MIN_POSITIVE);
        self.x
            .evaluate(x, tolerance_for(self.y.range()))
            .product(self.y.evaluate(y, tolerance_for(self.x.range())))
    }

    /// `h` to the rounding error of the point.
    pub(crate) fn near(&self, x: f64, y: f64) -> Bounded {
        self.x.near(x).product(self.y.near(y))
    }

    /// `h` to the rounding error; the value of [`HeightField::evaluate`] at tolerance 0.
    #[must_use]
    pub fn height(&self, x: f64, y: f64) -> f64 {
        self.evaluate(x, y, 0.0).value
    }

    /// `(∂h/∂x, ∂h/∂y)`, or `None` unless both axes are differentiable.
    #[must_use]
    pub fn gradient(&self, x: f64, y: f64) -> Option<DVec2> {
        let (f_slope, g_slope) = (self.x.slope(x)?, self.y.slope(y)?);
        let (f, g) = (self.x.evaluate(x, 0.0).value, self.y.evaluate(y, 0.0).value);
        Some(DVec2::new(f_slope * g, f * g_slope))
    }

    /// The unit normal, upward, or `None` unless both axes are differentiable.
    #[must_use]
    pub fn normal(&self, x: f64, y: f64) -> Option<DVec3> {
        self.gradient(x, y).map(upward_normal)
    }
}

impl<F: Function, G: Function> Surface for HeightField<F, G> {
    fn domain(&self) -> [Interval; 2] {
        [self.x.domain(), self.y.domain()]
    }

    fn range(&self) -> Interval {
        self.x.range().product(self.y.range())
    }

    fn evaluate(&self, x: f64, y: f64, tolerance: f64) -> Bounded {
        self.evaluate(x, y, tolerance)
    }

    fn bounds(&self, x: Interval, y: Interval) -> SurfaceBounds {
        let ([f, f_slope], [g, g_slope]) = (covered(&self.x, x), covered(&self.y, y));
        SurfaceBounds { height: f.product(g), slopes: [f_slope.product(g), f.product(g_slope)] }
    }

    fn gradient_near(&self, x: f64, y: f64, _: f64) -> Option<DVec2> {
        self.gradient(x, y)
    }
}
