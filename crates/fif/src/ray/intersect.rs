//! The first hit of a ray with any surface.

use asperity_core::{BatchError, Interval};

use crate::ray::ray::{Hit, Ray};
use crate::ray::traversal::{Context, Unbounded};
use crate::surface::bounds::Surface;

/// Rays against a [`Surface`]; an `impl Intersect for X {}` gives them to one of your own.
///
/// [`HeightField`](crate::HeightField) and [`Tabulated`](crate::Tabulated) have rays of their own, the latter much faster;
/// `tabulated()` makes either. The example needs the feature `alloc`.
///
#[cfg_attr(feature = "alloc", doc = "```")]
#[cfg_attr(not(feature = "alloc"), doc = "```ignore")]
/// use asperity_fif::{Intersect, Ray, Torus, glam::DVec3};
/// let z = [0.0, 1.0, -0.5, 0.25];
/// let surface = Torus::new(2, [[2, -1], [1, 2]], 0.375, &z, &[[3.0, -1.0]; 4])?;
/// let ray = Ray { origin: DVec3::new(0.1, 0.2, 4.0), direction: DVec3::new(0.1, 0.15, -1.0) };
/// let hit = surface.first_hit(&ray).unwrap();
/// assert!((ray.at(hit.t).z - hit.height).abs() < 1e-10 && hit.normal.unwrap().z > 0.0);
/// # Ok::<(), asperity_fif::SelfAffineError>(())
/// ```
#[doc(alias = "intersection")]
#[doc(alias = "raycast")]
pub trait Intersect: Surface {
    /// The first point of the ray on the surface, `t ≥ 0`; a ray that starts on the surface hits at `t = 0`.
    ///
    /// ```text
    /// least t ≥ 0 with o_z + t d_z = f(o_x + t d_x, o_y + t d_y) over the closed domain
    /// ```
    ///
    /// `None` is a proof that there is none. If a hit is [`certain`](Hit::certain), no earlier intersection exists beyond
    /// rounding error, which is 10⁻¹² of the domain before the hit. Otherwise an earlier one may have been missed. A ray with
    /// a zero or non-finite component where none is allowed returns `None`.
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
    /// is split and bounded anew, until a stretch is no longer than the tolerance: a change of sign there is a hit. A stretch
    /// without one is split on, down to 10⁻¹² of the domain, until its bounds exclude that the ray dips in and out
    /// again. Over a surface without slopes every half is bounded again, down to 1.6·10⁻¹⁴ of the domain. Where the bounds do
    /// not exclude it, a hit more than 10⁻¹² of the domain behind is not certain, or the stretch itself is an uncertain one.
    /// So a certain hit lies within `tolerance` of a root before which there is none but within 10⁻¹² of the domain. 0,
    /// negative and NaN stand for a root to the rounding error, which is up to 1.6·10⁻¹¹ of the domain where rounding hides
    /// the side of the surface for that long. A ray takes at most 2¹⁶ evaluations, of which bounds of a stretch count as two; beyond, no hit is certain.
    ///
    /// A negative or NaN lower end of `t` stands for 0; `None` when the upper end is NaN or less.
    #[must_use]
    fn first_hit_within(&self, ray: &Ray, t: Interval, tolerance: f64) -> Option<Hit> {
        Context::new(self).first(&Unbounded(self), ray, t, tolerance)
    }

    /// Whether the ray meets the surface at any `t` in the interval; for shadows, and quicker than the first hit. `false` is a
    /// proof; `true` may stand for a hit that is not certain.
    #[must_use]
    fn hits_any(&self, ray: &Ray, t: Interval) -> bool {
        Context::new(self).any(&Unbounded(self), ray, t)
    }

    /// The first hit of every ray, as [`Intersect::first_hit_within`].
    ///
    /// # Errors
    /// [`BatchError`] when `hits` has another length than `rays`; nothing is written then.
    fn first_hits(
        &self,
        rays: &[Ray],
        t: Interval,
        tolerance: f64,
        hits: &mut [Option<Hit>],
    ) -> Result<(), BatchError> {
        BatchError::check("hits", rays.len(), hits.len())?;
        for (ray, hit) in rays.iter().zip(hits) {
            *hit = self.first_hit_within(ray, t, tolerance);
        }
        Ok(())
    }
}
