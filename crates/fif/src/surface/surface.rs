//! Any surface over a rectangle: what bounds and rays need of it.

use glam::DVec2;

use crate::numeric::interval::{Bounded, Interval};
use crate::ray::quadtree::{self, Unbounded};
use crate::ray::ray::{Hit, Ray};
use crate::surface::height_field::axis::Axis;
use crate::surface::height_field::cover::covered;
use crate::surface::height_field::height_field::HeightField;
use crate::surface::self_affine::folded::FoldedSurface;
use crate::surface::self_affine::folded_node::FoldedNode;
use crate::surface::self_affine::torus::TorusSurface;
use crate::surface::self_affine::torus_node::TorusNode;

/// Enclosures of the heights and slopes of a surface over a rectangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceBounds {
    /// Of the heights.
    pub height: Interval,
    /// Of `∂f/∂x` and `∂f/∂y`.
    pub slopes: [Interval; 2],
}

/// A surface `z = f(x, y)` over a rectangle: what bounds and rays need of it, and the rays.
///
/// Implemented by [`TorusSurface`] over one period, the unit square, by [`FoldedSurface`] over its grid, by [`HeightField`]
/// with its own rays, and by [`Pyramid`](crate::Pyramid) over any of them, which makes hits of the first two fast.
///
/// ```
/// use asperity_fif::{FixedTorus, Ray, Surface, glam::DVec3};
/// let z = [0.0, 1.0, -0.5, 0.25];
/// let surface = FixedTorus::<4>::new(2, [[2, -1], [1, 2]], 0.375, &z, &[[3.0, -1.0]; 4])?;
/// let ray = Ray { origin: DVec3::new(0.1, 0.2, 4.0), direction: DVec3::new(0.1, 0.15, -1.0) };
/// let hit = surface.first_hit(&ray).unwrap();
/// assert!((ray.at(hit.t).z - hit.height).abs() < 1e-10 && hit.normal.unwrap().z > 0.0);
/// # Ok::<(), asperity_fif::TorusError>(())
/// ```
pub trait Surface {
    /// The rectangle.
    #[must_use]
    fn domain(&self) -> [Interval; 2];

    /// A rigorous enclosure of the heights.
    #[must_use]
    fn range(&self) -> Interval;

    /// The height with a bound of its error, to `tolerance` or the rounding error. A point that rounding has put outside the
    /// domain stands for the nearest of it.
    #[must_use]
    fn evaluate(&self, x: f64, y: f64, tolerance: f64) -> Bounded;

    /// Rigorous enclosures of heights and slopes over a rectangle, [`Interval::ENTIRE`] for unknown slopes.
    #[must_use]
    fn bounds(&self, x: Interval, y: Interval) -> SurfaceBounds;

    /// The gradient at a point that is known to `distance`, or `None` where there is none: what changes over less may be left out.
    #[must_use]
    fn gradient_near(&self, x: f64, y: f64, distance: f64) -> Option<DVec2>;

    /// The first point of the ray on the surface, `t ≥ 0`; a ray that starts on the surface hits at `t = 0`.
    ///
    /// ```text
    /// least t ≥ 0 with o_z + t d_z = f(o_x + t d_x, o_y + t d_y) over the closed domain
    /// ```
    ///
    /// Guarantees and limits are those of [`HeightField::first_hit`]: no hit is passed by but a pair of roots within one
    /// stretch of 10⁻¹² of the domain, and none is invented; rays that are no rays hit nothing.
    #[must_use]
    fn first_hit(&self, ray: &Ray) -> Option<Hit> {
        self.first_hit_within(ray, Interval::new(0.0, f64::INFINITY), 0.0)
    }

    /// The first hit with `t` in the interval, to a tolerance: a length in the domain's unit along the ray.
    ///
    /// ```text
    /// f stays away from the ray over [t, t + |z − f|/r],   r ≥ |d/dt (z − f)| over a cell
    /// ```
    ///
    /// Rigorous boxes are visited in the order of the ray. Within one, bounds of the slopes say from both ends how far the nearest
    /// root must be; where they exclude 0, two evaluations decide, and an interval Newton search finds the root. What is left
    /// is split and bounded anew, until a stretch is no longer than the tolerance: a change of sign there is a hit. So a
    /// hit lies within `tolerance` of a root before which there is none, but for a pair of roots within one such
    /// stretch: a ray that dips in and out again. 0, negative and NaN stand for 10⁻¹² of the domain and a root to the
    /// rounding error. A ray takes at most 2¹⁶ evaluations; beyond, a stretch is decided by its ends.
    ///
    /// A negative or NaN lower end of `t` stands for 0; `None` when the upper end is NaN or less.
    #[must_use]
    fn first_hit_within(&self, ray: &Ray, t: Interval, tolerance: f64) -> Option<Hit> {
        quadtree::first(self, &Unbounded(self), ray, t, tolerance)
    }

    /// Whether the ray meets the surface at any `t` in the interval; for shadows, and quicker than the first hit.
    #[must_use]
    fn hits_any(&self, ray: &Ray, t: Interval) -> bool {
        quadtree::any(self, &Unbounded(self), ray, t)
    }

    /// The first hit of every ray, as [`Surface::first_hit_within`], into `hits`; rays and places without a partner are left.
    fn first_hits(&self, rays: &[Ray], t: Interval, tolerance: f64, hits: &mut [Option<Hit>]) {
        for (ray, hit) in rays.iter().zip(hits) {
            *hit = self.first_hit_within(ray, t, tolerance);
        }
    }
}

impl<S: Surface> Surface for &S {
    fn domain(&self) -> [Interval; 2] {
        S::domain(self)
    }

    fn range(&self) -> Interval {
        S::range(self)
    }

    fn evaluate(&self, x: f64, y: f64, tolerance: f64) -> Bounded {
        S::evaluate(self, x, y, tolerance)
    }

    fn bounds(&self, x: Interval, y: Interval) -> SurfaceBounds {
        S::bounds(self, x, y)
    }

    fn gradient_near(&self, x: f64, y: f64, distance: f64) -> Option<DVec2> {
        S::gradient_near(self, x, y, distance)
    }

    fn first_hit_within(&self, ray: &Ray, t: Interval, tolerance: f64) -> Option<Hit> {
        S::first_hit_within(self, ray, t, tolerance)
    }

    fn hits_any(&self, ray: &Ray, t: Interval) -> bool {
        S::hits_any(self, ray, t)
    }
}

impl<X: Axis, Y: Axis> Surface for HeightField<X, Y> {
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

    fn first_hit_within(&self, ray: &Ray, t: Interval, tolerance: f64) -> Option<Hit> {
        self.first_hit_within(ray, t, tolerance)
    }

    fn hits_any(&self, ray: &Ray, t: Interval) -> bool {
        self.hits_any(ray, t)
    }
}

/// A tolerance that leaves out the repetitions whose cells are smaller than `distance`.
fn left_out(distance: f64, cell: f64, steepest: f64, [stretch, contraction]: [f64; 2]) -> f64 {
    const STEPS: u32 = 1 << 10;
    if distance.is_nan() || distance <= 0.0 {
        return 0.0;
    }
    let (mut cell, mut tolerance) = (cell, 2.0 * steepest);
    for _ in 0..STEPS {
        if cell < distance {
            break;
        }
        (cell, tolerance) = (cell / stretch, tolerance * contraction);
    }
    tolerance
}

const PERIOD: Interval = Interval::new(0.0, 1.0);

/// Over one period, the unit square.
impl<S: AsRef<[TorusNode]>> Surface for TorusSurface<S> {
    fn domain(&self) -> [Interval; 2] {
        [PERIOD; 2]
    }

    fn range(&self) -> Interval {
        self.range()
    }

    #[inline]
    fn evaluate(&self, x: f64, y: f64, tolerance: f64) -> Bounded {
        self.evaluate(x, y, tolerance)
    }

    fn bounds(&self, x: Interval, y: Interval) -> SurfaceBounds {
        self.bounds(x, y)
    }

    fn gradient_near(&self, x: f64, y: f64, distance: f64) -> Option<DVec2> {
        let limits = &self.limits;
        let tolerance =
            left_out(distance, 1.0 / self.side() as f64, limits.steepest, [limits.norm, limits.contraction]);
        let [x, y] = self.evaluate_gradient(x, y, tolerance);
        Some(DVec2::new(x.value, y.value))
    }
}

impl<S: AsRef<[FoldedNode]>> Surface for FoldedSurface<S> {
    fn domain(&self) -> [Interval; 2] {
        self.domain()
    }

    fn range(&self) -> Interval {
        self.range()
    }

    #[inline]
    fn evaluate(&self, x: f64, y: f64, tolerance: f64) -> Bounded {
        self.evaluate(x, y, tolerance)
    }

    fn bounds(&self, x: Interval, y: Interval) -> SurfaceBounds {
        self.bounds(x, y)
    }

    fn gradient_near(&self, x: f64, y: f64, distance: f64) -> Option<DVec2> {
        let limits = &self.limits;
        let [wide, deep] = self.domain().map(Interval::width);
        let cell = if wide < deep { wide } else { deep } / limits.stretch;
        let steepest = limits.steepest() / if wide < deep { wide } else { deep };
        let tolerance = left_out(distance, cell, steepest, [limits.stretch, limits.contraction]);
        let [x, y] = self.evaluate_gradient(x, y, tolerance);
        Some(DVec2::new(x.value, y.value))
    }
}
