//! Rays against height fields: by ordered descent of boxes, or by their tables.

#[cfg(feature = "alloc")]
use glam::{DVec2, DVec3};
#[cfg(all(feature = "alloc", feature = "simd"))]
use {
    crate::numeric::level::best_level,
    crate::ray::packet::Packet,
    crate::ray::tables::{Division, keeps_sign},
    fearless_simd::{Simd, dispatch},
};

use crate::evaluate::batch_error::BatchError;
#[cfg(feature = "alloc")]
use crate::math::sqrt;
use crate::numeric::interval::Interval;
use crate::ray::intersect::Intersect;
#[cfg(feature = "alloc")]
use crate::ray::ray::Root;
use crate::ray::ray::{Aim, Hit, Ray};
#[cfg(feature = "alloc")]
use crate::ray::tables::{Path, Tracer};
use crate::ray::traversal::Context;
use crate::surface::height_field::function::Function;
use crate::surface::height_field::height_field::HeightField;
#[cfg(feature = "alloc")]
use crate::surface::normal::upward_normal;

/// Boxes of rigorous value ranges are visited in the order of the ray, split along one axis at a time. Where the
/// slope ranges show that the ray comes nearer to the surface all along, there is one root at most: two evaluations
/// decide, and a bracketed secant finds it to the last places of `t`. A surface that is only continuous is followed down to
/// stretches of 10⁻¹² of the domain, where a change of sign is a root; heights at 17 places of such a stretch look for one. One
/// without is split on, by places that are followed to 2⁻⁹⁶: a rough surface has spikes far narrower than an `f64` can tell, that
/// of the source's g one of 9·10⁻⁴ over 10⁻¹³.
///
/// With the tables of two smooth functions on equal knots stretches of the ray take the place of boxes: rigorous ranges over
/// the cells under a stretch cut off what lies above or below the surface, a height in the middle what is too near to it for a
/// root, and Newton's steps find the one root where the ray comes nearer all along. After 256 divisions boxes decide the rest.
///
/// No hit is passed by: `None` and `false` are proofs. A hit is [`certain`](Hit::certain) unless the ray grazes nearer than the
/// rounding error of `h`, or a limit binds: a ray, or what tables leave of one stretch, visits 2¹⁶ boxes, 2¹³ of
/// these below 10⁻¹² of the domain (2¹⁴ for a ray along an axis), and a box is split 192 times per axis. Rough surfaces of Hölder
/// exponents near 1/4 reach them: one of twenty slanted rays at g(x) g(y) hits without being certain that nothing lies
/// before, most rays along an axis are certain. The height of the hit differs from that of the ray by up to what the surface
/// changes over 10⁻¹² of the domain, see [`System::modulus`](crate::System::modulus): measured 4·10⁻⁴ of the range for g(x) g(y),
/// under 10⁻⁹ for smooth axes. Certain there means that nothing lies before it that is as wide as 2⁻⁹⁴ of the
/// ray's way, where times are no longer told apart; a ray that comes that near and is found to hit nowhere else hits there,
/// uncertain. Whether a ray hits at all is asked of 2⁷ boxes below 10⁻¹², and is `true` where they leave it open. Over smooth
/// axes, and on unequal knots, rounding counts as that of the ray: the result belongs to one within a few units in the last place.
///
/// `None` too for a ray that misses, a zero direction, one so short that `t` overflows, and any component that is NaN or
/// infinite.
///
/// The hit is within `tolerance`, a length in the domain's unit, of the exact one along the ray, and its gradient that over a
/// stretch of this length. It is certified: a rigorous bound of the height above the surface, over the least rate at which
/// the ray comes nearer. Nothing changes in which rays hit: at the ends of the stretch and of the domain values are
/// as good as `f64` allows, whatever the tolerance. 0, negative and NaN stand for the rounding error.
///
/// Only smooth functions on equal knots with tables gain; for others the tolerance is 0.
///
/// Cochran, Lewis, Hart 2000, §4 and Algorithm 3, corrected: the intervals of eq. 50 are sorted and clipped to
/// `t ≥ 0`, `t = 0` is a hit, the boxes' heights count and not their contraction alone, and the hit lies on the
/// surface and not amid a box.
///
/// ```
/// use asperity_fif::{HeightField, Interval, Intersect, Ray, glam::DVec3, paper};
/// let rough = HeightField::new(paper::f()?, paper::f()?);
/// let ray = Ray { origin: DVec3::new(-1.0, -0.9, 3.0), direction: DVec3::new(1.0, 1.0, -1.0) };
/// let hit = rough.first_hit(&ray).unwrap();
/// assert!((ray.at(hit.t).z - hit.height).abs() < 1e-9);
/// # #[cfg(feature = "alloc")] {
/// let smooth = HeightField::new(paper::f_hat()?, paper::f_hat()?).tabulated();
/// let exact = smooth.first_hit(&ray).unwrap();
/// let near = smooth.first_hit_within(&ray, Interval::new(0.0, 9.0), 1e-4).unwrap();
/// assert!((near.t - exact.t).abs() * ray.direction.length() <= 1e-4);
/// assert!(smooth.hits_any(&ray, Interval::new(0.0, 9.0)) && !smooth.hits_any(&ray, Interval::new(0.0, 1.0)));
/// # }
/// # Ok::<(), asperity_fif::SystemError>(())
/// ```
impl<F: Function, G: Function> Intersect for HeightField<F, G> {
    fn first_hit_within(&self, ray: &Ray, t: Interval, tolerance: f64) -> Option<Hit> {
        #[cfg(feature = "alloc")]
        if let Some(tracer) = Tracer::new(self, tolerance) {
            return self.first(&tracer, ray, t);
        }
        // Without tables every value is as good as it can be.
        let _ = tolerance;
        hit_by_boxes(&Context::new(self), ray, t, Aim::First)
    }

    fn hits_any(&self, ray: &Ray, t: Interval) -> bool {
        #[cfg(feature = "alloc")]
        if let Some(tracer) = Tracer::new(self, 0.0)
            && let Some(path) = tracer.path(ray, t)
        {
            return path.search(Aim::Any).is_some();
        }
        hit_by_boxes(&Context::new(self), ray, t, Aim::Any).is_some()
    }

    /// With tables and the feature `simd` rays are searched in packets of eight, each with the bits of
    /// [`Intersect::first_hit_within`].
    fn first_hits(
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
            dispatch!(best_level(), simd => self.trace(simd, &tracer, rays, t, hits));
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
    /// Rays that come nearer to the surface all along are searched together, the others one by one.
    #[cfg(all(feature = "alloc", feature = "simd"))]
    #[inline(always)]
    fn trace<I: Simd>(
        &self,
        simd: I,
        tracer: &Tracer<'_, F, G>,
        rays: &[Ray],
        t: Interval,
        hits: &mut [Option<Hit>],
    ) {
        let one_by_one = |ray: &Ray| self.first(tracer, ray, t);
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
                        tracer.finish(simd, &mut packet, rays, hits, &one_by_one);
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
        tracer.finish(simd, &mut packet, rays, hits, &one_by_one);
    }

    /// The first hit of one ray with tables.
    #[cfg(feature = "alloc")]
    fn first(&self, tracer: &Tracer<'_, F, G>, ray: &Ray, t: Interval) -> Option<Hit> {
        match tracer.path(ray, t) {
            Some(path) => path.search(Aim::First).map(|root| Self::met(&path, root)),
            None => hit_by_boxes(&Context::new(self), ray, t, Aim::First),
        }
    }

    /// The hit at a root, by tables.
    #[cfg(feature = "alloc")]
    #[inline(always)]
    fn met(path: &Path<'_, F, G>, Root { t, certain }: Root) -> Hit {
        let [f, g] = path.jets(t);
        let [x, y] = path.tracer.place(&path.ray, t);
        let gradient = DVec2::new(f[1] * g[0], f[0] * g[1]);
        // One division and one root do, unless squares overflow.
        let square = gradient.x * gradient.x + gradient.y * gradient.y + 1.0;
        let normal = if square < f64::MAX {
            let scale = 1.0 / sqrt(square);
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
    use crate::{FixedFif, paper};
    use approx::assert_abs_diff_eq;
    use glam::DVec3;

    fn mirror() -> HeightField<FixedFif<2, 3>, FixedFif<2, 3>> {
        HeightField::new(paper::f_hat().unwrap(), paper::f_hat().unwrap())
    }

    fn between(surface: &impl Intersect, ray: &Ray, lo: f64, hi: f64) -> Option<Hit> {
        surface.first_hit_within(ray, Interval::new(lo, hi), 0.0)
    }

    fn ray(o: [f64; 3], d: [f64; 3]) -> Ray {
        Ray { origin: DVec3::from_array(o), direction: DVec3::from_array(d) }
    }

    #[test]
    fn a_ray_that_starts_on_the_surface_hits_at_once() {
        let surface = mirror();
        // h(1, 1) = 1 exactly.
        for d in [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [1.0, 0.5, 0.3], [-0.2, 1.0, 3.0], [1.0, 0.0, 0.0]] {
            let hit = surface.first_hit(&ray([1.0, 1.0, 1.0], d)).unwrap();
            assert!(hit.t.abs() < 1e-15, "{d:?}: {hit:?}");
        }
        let away = ray([1.0, 1.0, 1.0], [-0.2, 0.3, 3.0]);
        assert_eq!(between(&surface, &away, 1e-9, f64::INFINITY), None);
    }

    #[test]
    fn vertical_rays_hit_the_height() {
        let surface = mirror();
        for (x, y) in [(0.3, 1.7), (0.0, 0.0), (2.0, 2.0), (2.0, 0.4)] {
            let h = surface.height(x, y);
            let hit = surface.first_hit(&ray([x, y, 9.0], [0.0, 0.0, -2.0])).unwrap();
            assert_abs_diff_eq!(hit.t, (9.0 - h) / 2.0, epsilon = 1e-14);
            assert_eq!(hit.height, h, "({x}, {y}): {hit:?}");
            assert_eq!(surface.first_hit(&ray([x, y, 9.0], [0.0, 0.0, 1.0])), None);
            assert!(surface.first_hit(&ray([x, y, -9.0], [0.0, 0.0, 1.0])).is_some());
        }
        assert_eq!(surface.first_hit(&ray([2.1, 1.0, 9.0], [0.0, 0.0, -1.0])), None);
    }

    #[test]
    fn rays_parallel_to_an_axis_hit_where_the_factor_takes_the_value() {
        let surface = mirror();
        // Along y at x = 1: f̂(1) ĝ(y) = ĝ(y) = 1 at y = 1.
        let hit = surface.first_hit(&ray([1.0, -3.0, 1.0], [0.0, 1.0, 0.0])).unwrap();
        assert_abs_diff_eq!(hit.t, 4.0, epsilon = 1e-12);
        assert_abs_diff_eq!(hit.y, 1.0, epsilon = 1e-12);
        let hit = surface.first_hit(&ray([4.0, 1.0, 1.0], [-2.0, 0.0, 0.0])).unwrap();
        assert_abs_diff_eq!(hit.t, 1.5, epsilon = 1e-12);
        assert_eq!(surface.first_hit(&ray([1.0, -3.0, 2.5], [0.0, 1.0, 0.0])), None);
    }

    #[test]
    fn a_ray_within_the_surface_hits_where_it_enters() {
        // h = 0 along the border y = 0.
        let hit = mirror().first_hit(&ray([-1.0, 0.0, 0.0], [1.0, 0.0, 0.0])).unwrap();
        assert_abs_diff_eq!(hit.t, 1.0, epsilon = 1e-12);
    }

    #[test]
    fn rays_from_below_and_from_within_the_box_hit() {
        let surface = mirror();
        let below = surface.first_hit(&ray([1.5, 1.5, 0.1], [0.1, -0.2, 1.0])).unwrap();
        assert_abs_diff_eq!(0.1 + below.t, below.height, epsilon = 1e-13);
        let within = surface.first_hit(&ray([0.2, 0.2, 0.5], [1.0, 1.0, 0.1])).unwrap();
        assert_abs_diff_eq!(0.5 + 0.1 * within.t, within.height, epsilon = 1e-13);
    }

    #[test]
    fn the_stretch_of_the_ray_is_respected() {
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
        // h(1, 1) = 1 at t = 2: the end of the stretch belongs to it.
        assert_eq!(between(&surface, &slanted, 0.0, 2.0).map(|hit| hit.t), Some(2.0));
        let t = surface.first_hit(&slanted).unwrap().t;
        assert_eq!(between(&surface, &slanted, 0.0, t - 1e-9), None);
        assert!(between(&surface, &slanted, t - 1e-9, t + 1e-9).is_some());
    }

    #[test]
    fn many_rays_hit_what_each_hits_alone() {
        /// By reference: two surfaces and their copies would not lie on a test's stack.
        fn check(surface: &impl Intersect) {
            let rays = [
                ray([-1.0, -0.9, 3.0], [1.0, 1.0, -1.0]),
                ray([0.3, 1.7, 9.0], [0.0, 0.0, -2.0]),
                ray([1.0, -3.0, 1.0], [0.0, 1.0, 0.0]),
                ray([1.0, 1.0, 3.0], [0.0; 3]),
                ray([1.5, 1.5, 0.1], [0.1, -0.2, 1.0]),
                ray([5.0, 5.0, 3.0], [1.0, 1.0, -1.0]),
            ];
            let mut hits = [None; 6];
            surface.first_hits(&rays, Interval::new(0.0, 9.0), 0.0, &mut hits).unwrap();
            for (ray, hit) in rays.iter().zip(hits) {
                assert_eq!(hit, between(surface, ray, 0.0, 9.0), "{ray:?}");
            }
            assert_eq!(hits.map(|hit| hit.is_some()), [true, true, true, false, true, false]);
            let mut few = [None; 5];
            let error = surface.first_hits(&rays, Interval::new(0.0, 9.0), 0.0, &mut few).unwrap_err();
            assert_eq!((error.parameter, error.expected, error.got), ("hits", 6, 5));
            assert_eq!(few, [None; 5]);
        }
        check(&mirror());
        #[cfg(feature = "alloc")]
        check(&mirror().tabulated());
    }

    #[test]
    fn extreme_rays_end() {
        let surface = mirror();
        let mut found = 0;
        for scale in [1e-320, 1e-308, 1e-300, 1e-12, 1e12, 1e300, f64::MAX] {
            for ray in [
                ray([1.0, 1.0, 3.0], [0.0, 0.0, -scale]),
                ray([-1.0, -1.0, 3.0], [scale, scale, -scale]),
                ray([scale, -scale, scale], [-1.0, 1.0, -1.0]),
                ray([1.0, -1.0, 1.0], [scale, 1.0, -scale]),
                ray([scale; 3], [-scale; 3]),
                ray([0.5, 0.5, 1.0], [scale, 0.0, -scale]),
            ] {
                let Some(hit) = surface.first_hit(&ray) else { continue };
                let at = ray.at(hit.t);
                let rounding = 1e-9 + 64.0 * f64::EPSILON * ray.origin.abs().max_element();
                assert!(hit.t.is_finite() && at.is_finite(), "{ray:?}: {hit:?}");
                assert!(
                    (at.x - hit.x).abs() < rounding && (at.y - hit.y).abs() < rounding,
                    "{ray:?}: {hit:?}"
                );
                assert!((at.z - hit.height).abs() < rounding, "{ray:?}: {hit:?}");
                found += 1;
            }
        }
        assert!(found > 10, "{found}");
    }
}
