//! Ray intersection of height fields, by ordered descent of boxes or by tables.

#[cfg(feature = "alloc")]
use glam::{DVec2, DVec3};
#[cfg(all(feature = "alloc", feature = "simd"))]
use {
    crate::ray::packet::Packet,
    crate::ray::tables::{Division, keeps_sign},
    asperity_core::lanes::best_level,
};

use crate::ray::intersect::Intersect;
#[cfg(feature = "alloc")]
use crate::ray::ray::Root;
use crate::ray::ray::{Aim, Hit, Ray};
#[cfg(feature = "alloc")]
use crate::ray::tables::{Path, Tracer};
use crate::ray::traversal::Context;
#[cfg(feature = "alloc")]
use crate::surface::bounds::upward_normal;
use crate::surface::height_field::function::Function;
use crate::surface::height_field::height_field::HeightField;
use asperity_core::BatchError;
use asperity_core::Interval;
#[cfg(feature = "alloc")]
use asperity_core::math::sqrt_f64;

#[doc = include_str!("../../docs/rays-of-height-fields.md")]
impl<F: Function, G: Function> Intersect for HeightField<F, G> {
    fn intersect_within(&self, ray: &Ray, t: Interval, tolerance: f64) -> Option<Hit> {
        #[cfg(feature = "alloc")]
        if let Some(tracer) = Tracer::new(self, tolerance) {
            return self.first(&tracer, ray, t);
        }
        // Without tables every value is as accurate as possible.
        let _ = tolerance;
        hit_by_boxes(&Context::new(self), ray, t, Aim::First)
    }

    fn occluded(&self, ray: &Ray, t: Interval) -> bool {
        #[cfg(feature = "alloc")]
        if let Some(tracer) = Tracer::new(self, 0.0)
            && let Some(path) = tracer.path(ray, t)
        {
            return path.search(Aim::Any).is_some();
        }
        hit_by_boxes(&Context::new(self), ray, t, Aim::Any).is_some()
    }

    /// With tables and the feature `simd`, rays are searched in packets of eight.
    ///
    /// Results are bit-identical to [`Intersect::intersect_within`].
    fn intersect_batch(
        &self,
        rays: &[Ray],
        t: Interval,
        tolerance: f64,
        hits: &mut [Option<Hit>],
    ) -> Result<(), BatchError> {
        BatchError::check("hits", rays.len(), hits.len())?;
        #[cfg(feature = "alloc")]
        if let Some(tracer) = Tracer::new(self, tolerance) {
            #[cfg(feature = "simd")]
            self.trace(&tracer, rays, t, hits);
            #[cfg(not(feature = "simd"))]
            rays.iter().zip(hits).for_each(|(ray, hit)| *hit = self.first(&tracer, ray, t));
            return Ok(());
        }
        let (_, context) = (tolerance, Context::new(self));
        for (ray, hit) in rays.iter().zip(hits) {
            *hit = hit_by_boxes(&context, ray, t, Aim::First);
        }
        Ok(())
    }
}

impl<F: Function, G: Function> HeightField<F, G> {
    /// Rays that approach the surface monotonically are searched together, others one by one.
    #[cfg(all(feature = "alloc", feature = "simd"))]
    fn trace(&self, tracer: &Tracer<'_, F, G>, rays: &[Ray], t: Interval, hits: &mut [Option<Hit>]) {
        let (level, one_by_one) = (best_level(), |ray: &Ray| self.first(tracer, ray, t));
        let mut packet = Packet::EMPTY;
        for (number, ray) in rays.iter().enumerate() {
            let Some(place) = hits.get_mut(number) else { break };
            let Some(path) = tracer.path(ray, t) else {
                *place = hit_by_boxes(&Context::new(self), ray, t, Aim::First);
                continue;
            };
            let (span, rate) = path.approach();
            let mut parts = Division::new(span, rate);
            *place = match parts.next(&path) {
                Some((span, rate)) if keeps_sign(rate) => {
                    packet.push(number, &path, span, rate, parts.is_done());
                    if packet.is_full() {
                        tracer.finish(level, &mut packet, rays, hits, &one_by_one);
                    }
                    continue;
                }
                Some((span, _)) => {
                    let root = path.descend(span).or_else(|| path.rest(&mut parts, Aim::First));
                    root.map(|root| Self::met(&path, root))
                }
                None => None,
            };
        }
        tracer.finish(level, &mut packet, rays, hits, &one_by_one);
    }

    /// The first hit of one ray with tables.
    #[cfg(feature = "alloc")]
    fn first(&self, tracer: &Tracer<'_, F, G>, ray: &Ray, t: Interval) -> Option<Hit> {
        match tracer.path(ray, t) {
            Some(path) => path.search(Aim::First).map(|root| Self::met(&path, root)),
            None => hit_by_boxes(&Context::new(self), ray, t, Aim::First),
        }
    }

    /// The hit at a root, from tables.
    #[cfg(feature = "alloc")]
    #[inline(always)]
    fn met(path: &Path<'_, F, G>, Root { t, certain }: Root) -> Hit {
        let [f, g] = path.jets(t);
        let [x, y] = path.tracer.place(&path.ray, t);
        let gradient = DVec2::new(f[1] * g[0], f[0] * g[1]);
        // One division and one square root suffice, unless squares overflow.
        let square = gradient.x * gradient.x + gradient.y * gradient.y + 1.0;
        let normal = if square < f64::MAX {
            let scale = 1.0 / sqrt_f64(square);
            DVec3::new(-gradient.x * scale, -gradient.y * scale, scale)
        } else {
            upward_normal(gradient)
        };
        Hit { t, x, y, height: f[0] * g[0], gradient: Some(gradient), normal: Some(normal), certain }
    }
}

/// The first hit by boxes, or any.
fn hit_by_boxes<F: Function, G: Function>(
    context: &Context<'_, HeightField<F, G>>,
    ray: &Ray,
    t: Interval,
    aim: Aim,
) -> Option<Hit> {
    let (mut traversal, span) = context.ray(ray, t, 0.0)?;
    let root = if traversal.is_vertical() { traversal.vertical(span) } else { traversal.boxes(span, aim) }?;
    traversal.hit(root, 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{FixedFif, cochran_2000};
    use approx::assert_abs_diff_eq;
    use glam::DVec3;

    fn mirror() -> HeightField<FixedFif<2, 3>, FixedFif<2, 3>> {
        HeightField::new(cochran_2000::f_hat().unwrap(), cochran_2000::f_hat().unwrap())
    }

    fn between(surface: &impl Intersect, ray: &Ray, lo: f64, hi: f64) -> Option<Hit> {
        surface.intersect_within(ray, Interval::new(lo, hi), 0.0)
    }

    fn ray(o: [f64; 3], d: [f64; 3]) -> Ray {
        Ray { origin: DVec3::from_array(o), direction: DVec3::from_array(d) }
    }

    #[test]
    fn ray_starting_on_the_surface_hits_at_zero() {
        let surface = mirror();
        // h(1, 1) = 1 exactly.
        for d in [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [1.0, 0.5, 0.3], [-0.2, 1.0, 3.0], [1.0, 0.0, 0.0]] {
            let hit = surface.intersect(&ray([1.0, 1.0, 1.0], d)).unwrap();
            assert!(hit.t.abs() < 1e-15, "{d:?}: {hit:?}");
        }
        let away = ray([1.0, 1.0, 1.0], [-0.2, 0.3, 3.0]);
        assert_eq!(between(&surface, &away, 1e-9, f64::INFINITY), None);
    }

    #[test]
    fn vertical_rays_hit_at_the_height() {
        let surface = mirror();
        for (x, y) in [(0.3, 1.7), (0.0, 0.0), (2.0, 2.0), (2.0, 0.4)] {
            let h = surface.height(x, y);
            let hit = surface.intersect(&ray([x, y, 9.0], [0.0, 0.0, -2.0])).unwrap();
            assert_abs_diff_eq!(hit.t, (9.0 - h) / 2.0, epsilon = 1e-14);
            assert_eq!(hit.height, h, "({x}, {y}): {hit:?}");
            assert_eq!(surface.intersect(&ray([x, y, 9.0], [0.0, 0.0, 1.0])), None);
            assert!(surface.intersect(&ray([x, y, -9.0], [0.0, 0.0, 1.0])).is_some());
        }
        assert_eq!(surface.intersect(&ray([2.1, 1.0, 9.0], [0.0, 0.0, -1.0])), None);
    }

    #[test]
    fn hits_respect_the_interval_of_the_ray() {
        let surface = mirror();
        let down = ray([1.0, 1.0, 3.0], [0.0, 0.0, -1.0]);
        assert_eq!(between(&surface, &down, 0.0, 1.9), None);
        assert_eq!(between(&surface, &down, 2.1, 9.0), None);
        assert_eq!(between(&surface, &down, 0.0, f64::NAN), None);
        assert!(between(&surface, &down, f64::NAN, 9.0).is_some());
        let below = ray([1.0, 1.0, 0.5], [0.0, 0.0, -1.0]);
        for t_min in [-5.0, f64::NAN, f64::NEG_INFINITY] {
            assert_eq!(between(&surface, &below, t_min, 9.0), None, "behind, {t_min}");
        }
        let slanted = ray([-1.0, -1.0, 3.0], [1.0, 1.0, -1.0]);
        // h(1, 1) = 1 at t = 2: the end of the interval is included.
        assert_eq!(between(&surface, &slanted, 0.0, 2.0).map(|hit| hit.t), Some(2.0));
        let t = surface.intersect(&slanted).unwrap().t;
        assert_eq!(between(&surface, &slanted, 0.0, t - 1e-9), None);
        assert!(between(&surface, &slanted, t - 1e-9, t + 1e-9).is_some());
    }
}
