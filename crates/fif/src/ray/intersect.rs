//! The `Intersect` trait: first hits of rays on any surface.

use asperity_core::{BatchError, Interval};

use crate::ray::ray::{Hit, Ray};
use crate::ray::traversal::{Context, Unbounded};
use crate::surface::bounds::Surface;

/// Ray intersection with a [`Surface`]; `impl Intersect for X {}` enables it for your own surface.
///
/// [`HeightField`](crate::HeightField) and [`Tabulated`](crate::Tabulated) have specialized
/// implementations; the latter is much faster. `tabulated()` creates either. The example needs the
/// feature `alloc`.
///
#[cfg_attr(feature = "alloc", doc = "```")]
#[cfg_attr(not(feature = "alloc"), doc = "```ignore")]
/// use asperity_fif::{Intersect, PeriodicSurface, Ray, glam::DVec3};
/// let z = [0.0, 1.0, -0.5, 0.25];
/// let surface = PeriodicSurface::new(2, [[2, -1], [1, 2]], 0.375, &z, &[[3.0, -1.0]; 4])?;
/// let ray = Ray { origin: DVec3::new(0.1, 0.2, 4.0), direction: DVec3::new(0.1, 0.15, -1.0) };
/// let hit = surface.intersect(&ray).unwrap();
/// assert!((ray.at(hit.t).z - hit.height).abs() < 1e-10 && hit.normal.unwrap().z > 0.0);
/// # Ok::<(), asperity_fif::FifError>(())
/// ```
#[doc(alias = "intersection")]
#[doc(alias = "raycast")]
pub trait Intersect: Surface {
    /// The first point of the ray on the surface, `t ≥ 0`; a ray that starts on the surface hits at
    /// `t = 0`.
    ///
    /// ```text
    /// smallest t ≥ 0 with o_z + t d_z = f(o_x + t d_x, o_y + t d_y) over the closed domain
    /// ```
    ///
    /// Returns `None` only if the ray misses the surface. If [`Hit::certain`] is true, the surface
    /// has no intersection before the hit, except within 10⁻¹² of the domain. If it is false, an
    /// earlier intersection may exist. A ray with a zero or non-finite component
    /// where none is allowed returns `None`.
    #[must_use]
    fn intersect(&self, ray: &Ray) -> Option<Hit> {
        self.intersect_within(ray, Interval::new(0.0, f64::INFINITY), 0.0)
    }

    /// The first hit with `t` in the interval, to a tolerance.
    ///
    /// The tolerance is a length along the ray, in the unit of the domain.
    ///
    /// ```text
    /// f stays away from the ray over [t, t + |z − f|/r],   r ≥ |d/dt (z − f)| over a cell
    /// ```
    ///
    /// Rigorous boxes are visited in the order of the ray. Within a box, bounds of the slopes give
    /// a minimum distance of the nearest root from both ends. If they exclude 0, two evaluations
    /// decide, and an interval Newton search finds the root. The rest is split and bounded again.
    /// If an interval is at most as long as the tolerance, a change of sign is a hit. An interval
    /// without a change of sign is split further, down to 10⁻¹² of the domain, until its
    /// bounds exclude that the ray dips in and out again. Over a surface without slopes every half
    /// is bounded again, down to 1.6·10⁻¹⁴ of the domain. If the bounds do not exclude a dip, a hit
    /// more than 10⁻¹² of the domain behind is not certain, or the interval itself is an uncertain
    /// hit. Therefore a certain hit lies within `tolerance` of a root, and no root lies before it
    /// except within 10⁻¹² of the domain. A tolerance of 0, negative or NaN means a root to the
    /// rounding error, which is up to 1.6·10⁻¹¹ of the domain where rounding hides the side of the
    /// surface for that long. A ray takes at most 2¹⁶ evaluations, where bounds of an interval
    /// count as two; beyond, no hit is certain.
    ///
    /// A negative or NaN lower end of `t` is read as 0. Returns `None` if the upper end is NaN or
    /// less than the lower end.
    #[must_use]
    fn intersect_within(&self, ray: &Ray, t: Interval, tolerance: f64) -> Option<Hit> {
        Context::new(self).first(&Unbounded(self), ray, t, tolerance)
    }

    /// Whether the ray hits the surface at any `t` in the interval; for shadows, faster than the
    /// first hit.
    ///
    /// `false` is a proof; `true` may be an uncertain hit.
    #[must_use]
    fn occluded(&self, ray: &Ray, t: Interval) -> bool {
        Context::new(self).any(&Unbounded(self), ray, t)
    }

    /// The first hit of every ray, see [`Intersect::intersect_within`].
    ///
    /// # Errors
    /// [`BatchError`] if the lengths of `hits` and `rays` differ. Nothing is written in this case.
    fn intersect_batch(
        &self,
        rays: &[Ray],
        t: Interval,
        tolerance: f64,
        hits: &mut [Option<Hit>],
    ) -> Result<(), BatchError> {
        BatchError::check("hits", rays.len(), hits.len())?;
        for (ray, hit) in rays.iter().zip(hits) {
            *hit = self.intersect_within(ray, t, tolerance);
        }
        Ok(())
    }
}
