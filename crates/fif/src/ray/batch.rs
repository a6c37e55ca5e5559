//! First hits of many rays.

use crate::numeric::interval::Interval;
use crate::ray::range_descent::Tracer;
use crate::ray::ray::{Hit, Ray};
use crate::surface::height_field::axis::Axis;
use crate::surface::height_field::height_field::HeightField;
#[cfg(feature = "simd")]
use {crate::table::uniform_f32_lanes::best_level, fearless_simd::dispatch};

impl<X: Axis, Y: Axis> HeightField<X, Y> {
    /// The first hit of every ray, as [`HeightField::first_hit_within`], into `hits`; rays and places without a partner are left.
    ///
    /// The hits are the same; what all rays share is prepared once, which is worth a fifth of the time with tables.
    ///
    /// ```
    /// use asperity_fif::{Cached, FixedSmooth, HeightField, Interval, Ray, paper};
    /// use glam::DVec3;
    /// let axis = FixedSmooth::<2, 3, 2>::integral(paper::f()?, 0.0)?;
    /// let surface = HeightField::new(Cached::new(axis), Cached::new(axis));
    /// let rays = [0.1, 0.2, 0.3].map(|x| Ray { origin: DVec3::new(x, 0.4, 9.0), direction: DVec3::new(0.1, 0.1, -1.0) });
    /// let mut hits = [None; 3];
    /// surface.first_hits(&rays, Interval::new(0.0, f64::INFINITY), 1e-6, &mut hits);
    /// assert!(hits.iter().all(Option::is_some));
    /// # Ok::<(), asperity_fif::SystemError>(())
    /// ```
    pub fn first_hits(&self, rays: &[Ray], t: Interval, tolerance: f64, hits: &mut [Option<Hit>]) {
        let Some(tracer) = Tracer::new(self, tolerance) else {
            for (ray, hit) in rays.iter().zip(hits) {
                *hit = self.first_box(ray, t);
            }
            return;
        };
        #[cfg(feature = "simd")]
        dispatch!(best_level(), _simd => self.trace(&tracer, rays, t, hits));
        #[cfg(not(feature = "simd"))]
        self.trace(&tracer, rays, t, hits);
    }

    /// Compiled for every level of instructions.
    #[inline(always)]
    fn trace(&self, tracer: &Tracer<'_, X, Y>, rays: &[Ray], t: Interval, hits: &mut [Option<Hit>]) {
        for (ray, hit) in rays.iter().zip(hits) {
            *hit = match tracer.path(ray, t) {
                Some(path) => self.meet(&path),
                None => self.first_box(ray, t),
            };
        }
    }
}
