//! Scenes of materials: objects, light from all around with shadows, mirrors, glass, and one bounce from object to object.

use std::{f32::consts::TAU, sync::atomic::AtomicBool};

use asperity_shading::{Beckmann, Brdf, Dielectric, Environment, Frame, Ndf, PixelEllipse, SurfacePoint};
use glam::{Vec2, Vec3};
use indicatif::ProgressBar;

use crate::{failure::Failure, image::Image};
use crate::{
    geometry::{
        camera::Camera,
        ray::Ray,
        shape::{Hit, Shape},
    },
    integrator::pixels::{Sampling, render_paths},
    sampling::sampler::Sampler,
};

/// What a pixel sees of an object, before its material.
pub struct Seen {
    pub point: SurfacePoint,
    /// Unit, towards the eye.
    pub view: Vec3,
    /// Unit, orthogonal to the normal.
    pub tangent: Vec3,
}

/// What a material is at a point.
#[derive(Default)]
pub struct Appearance {
    /// Reflectances that are added, each about a normal of its own.
    pub layers: Vec<Layer>,
    /// Radiance that is added whatever the light.
    pub glow: Vec3,
    /// A smooth surface over the layers.
    pub coat: Option<Coat>,
}

/// A reflectance about a bump normal.
pub struct Layer {
    pub normal: Vec3,
    pub brdf: Box<dyn Brdf>,
}

/// A smooth surface that mirrors, and what becomes of the rest.
#[derive(Clone, Copy)]
pub struct Coat {
    pub normal: Vec3,
    /// The variance along each axis of slopes too fine for the pixel: each sample is mirrored by another.
    pub slope_variance: f32,
    pub fresnel: Dielectric,
    pub behind: Behind,
}

/// What is behind a smooth surface.
#[derive(Clone, Copy)]
pub enum Behind {
    /// The layers, which are darkened by what the coat mirrors.
    Layers,
    /// A thin pane, through which one looks straight, tinted.
    Pane(Vec3),
    /// A body of glass, which refracts; light is tinted over a unit of length.
    Body(Vec3),
    /// A polished metal of this colour: all is mirrored.
    Metal(Vec3),
}

/// The material of an object.
pub type Finish<'a> = dyn Fn(&Seen) -> Appearance + Sync + 'a;

/// A shape with its material.
pub struct Object<'a> {
    pub shape: Shape,
    pub finish: Box<Finish<'a>>,
    pub shadow: Shadow,
}

/// Whether an object keeps light from others.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Shadow {
    Cast,
    /// Glass: light goes through.
    None,
}

impl<'a> Object<'a> {
    /// An object that casts a shadow.
    pub fn new(shape: Shape, finish: impl Fn(&Seen) -> Appearance + Sync + 'a) -> Self {
        Self { shape, finish: Box::new(finish), shadow: Shadow::Cast }
    }
}

/// A scene.
pub struct Stage<'a> {
    pub objects: Vec<Object<'a>>,
    pub surroundings: &'a (dyn Environment + Sync),
    /// What the camera sees where there is no object; the surroundings if none.
    pub backdrop: Option<Vec3>,
    /// Samples of the light and of the material for each of the pixel's samples.
    pub splits: u32,
}

/// How far rays start from what they leave, over its distance from the eye.
const START: f32 = 3e-4;
/// The most round footprints of a pixel.
const TAPS: u32 = 16;
/// Mirrors in mirrors.
const MIRRORS: u32 = 6;
/// Light that comes by way of another object is cut off here: what is brighter would be speckles.
const BRIGHTEST: f32 = 2.5;

impl Stage<'_> {
    /// Draws it, in linear radiance.
    pub fn draw(
        &self,
        sampling: Sampling,
        camera: &Camera,
        progress: &ProgressBar,
        interrupted: &AtomicBool,
    ) -> Result<Image, Failure> {
        render_paths(sampling, progress, interrupted, |x, y, sampler| {
            let ray = camera.ray(x, y);
            match self.first_hit(ray.origin, ray.direction) {
                Some(meeting) => self.shade(&ray, meeting, sampler, 0, 1),
                None => self.backdrop.unwrap_or_else(|| self.surroundings.radiance(ray.direction)),
            }
        })
    }

    /// The radiance along a ray of the camera and how far it comes, for a caller that puts something before it.
    pub fn seen(&self, ray: &Ray, sampler: &mut Sampler) -> (Vec3, f32) {
        match self.first_hit(ray.origin, ray.direction) {
            Some(meeting) => (self.shade(ray, meeting, sampler, 0, 1), meeting.1.t),
            None => {
                (self.backdrop.unwrap_or_else(|| self.surroundings.radiance(ray.direction)), f32::INFINITY)
            }
        }
    }

    fn first_hit(&self, origin: Vec3, direction: Vec3) -> Option<(usize, Hit)> {
        let hits = self.objects.iter().enumerate();
        hits.filter_map(|(k, object)| Some((k, object.shape.first_hit(origin, direction)?)))
            .min_by(|a, b| a.1.t.total_cmp(&b.1.t))
    }

    fn hidden(&self, origin: Vec3, direction: Vec3) -> bool {
        let casting = self.objects.iter().filter(|object| object.shadow == Shadow::Cast);
        casting.into_iter().any(|object| object.shape.first_hit(origin, direction).is_some())
    }

    fn radiance(&self, ray: &Ray, sampler: &mut Sampler, mirrors: u32, bounces: u32) -> Vec3 {
        match self.first_hit(ray.origin, ray.direction) {
            Some(meeting) => self.shade(ray, meeting, sampler, mirrors, bounces),
            None => self.surroundings.radiance(ray.direction),
        }
    }

    fn shade(
        &self,
        ray: &Ray,
        (object, hit): (usize, Hit),
        sampler: &mut Sampler,
        mirrors: u32,
        bounces: u32,
    ) -> Vec3 {
        let outside = hit.normal.dot(ray.direction) <= 0.0;
        let hit = hit.facing(ray.direction);
        let [dx, dy] = ray.spread(&hit);
        let seen = Seen {
            point: tap(&hit, [dx, dy], sampler.point().x),
            view: -ray.direction,
            tangent: hit.tangent,
        };
        let appearance = (self.objects[object].finish)(&seen);
        let Some(coat) = appearance.coat else {
            return appearance.glow + self.lit(&seen, ray, &hit, &appearance.layers, sampler, bounces);
        };
        let normal = coat.facet(sampler.point(), &hit, ray.direction);
        let cosine = -ray.direction.dot(normal);
        let share = match coat.behind {
            Behind::Body(_) if !outside => coat.fresnel.reversed(),
            _ => coat.fresnel,
        }
        .reflectance(cosine);
        let start = START * hit.t.max(1e-3);
        let mut sum = appearance.glow;
        let mirrored = |share: Vec3, sampler: &mut Sampler| {
            if mirrors >= MIRRORS || share.max_element() < 0.004 {
                return share * 0.2;
            }
            let next = ray.mirrored(&hit, normal, hit.position + start * hit.normal);
            // What a bump mirrors into the surface would be mirrored out again.
            let down = next.direction.dot(hit.normal).min(0.0);
            let direction = (next.direction - 2.0 * down * hit.normal).normalize();
            share * self.radiance(&Ray { direction, ..next }, sampler, mirrors + 1, bounces)
        };
        match coat.behind {
            Behind::Metal(colour) => sum + mirrored(colour, sampler),
            Behind::Layers => {
                sum += (1.0 - share) * self.lit(&seen, ray, &hit, &appearance.layers, sampler, bounces);
                sum + mirrored(Vec3::splat(share), sampler)
            }
            Behind::Pane(tint) => {
                // Both of its surfaces, with all that goes back and forth.
                let both = 2.0 * share / (1.0 + share);
                let through = Ray {
                    origin: hit.position - start * hit.normal,
                    direction: ray.direction,
                    origin_by: [dx, dy],
                    direction_by: ray.direction_by,
                };
                sum += (1.0 - both) * tint * self.radiance(&through, sampler, mirrors + 1, bounces);
                sum + mirrored(Vec3::splat(both), sampler)
            }
            Behind::Body(tint) => {
                let eta = coat.fresnel.relative_index();
                let eta = if outside { 1.0 / eta } else { eta };
                let kept = if outside { Vec3::ONE } else { tint.powf(hit.t) };
                let refracted = ray.refracted(&hit, normal, eta, hit.position - start * hit.normal);
                let Some(next) = refracted.filter(|_| mirrors < MIRRORS) else {
                    return sum + kept * mirrored(Vec3::splat(share), sampler);
                };
                // Both ways once; further in one of them, as likely as there is light in it.
                if mirrors > 0 {
                    return if sampler.point().x < share {
                        sum + kept * mirrored(Vec3::ONE, sampler)
                    } else {
                        sum + kept * self.radiance(&next, sampler, mirrors + 1, bounces)
                    };
                }
                sum += kept * (1.0 - share) * self.radiance(&next, sampler, mirrors + 1, bounces);
                sum + kept * mirrored(Vec3::splat(share), sampler)
            }
        }
    }

    /// The light that layers send towards the ray: samples of the surroundings and of the layers, weighted by the balance heuristic.
    ///
    /// Veach 1997, §9.2.
    fn lit(
        &self,
        seen: &Seen,
        ray: &Ray,
        hit: &Hit,
        layers: &[Layer],
        sampler: &mut Sampler,
        bounces: u32,
    ) -> Vec3 {
        if layers.is_empty() {
            return Vec3::ZERO;
        }
        let layers = Lit::new(layers, seen);
        let start = hit.position + START * hit.t.max(1e-3) * hit.normal;
        let mut sum = Vec3::ZERO;
        for _ in 0..self.splits {
            let wi = self.surroundings.sample(sampler.point());
            let reflected = layers.reflected(hit.normal, wi);
            // Seen by way of another object, samples of the light alone will do.
            let other = if bounces > 0 { layers.density(wi) } else { 0.0 };
            if reflected.max_element() > 0.0 && !self.hidden(start, wi) {
                let density = self.surroundings.density(wi) + other;
                sum += reflected * self.surroundings.radiance(wi) / density;
            }
            if bounces == 0 {
                continue;
            }
            let wi = layers.sample(sampler);
            let reflected = layers.reflected(hit.normal, wi);
            if reflected.max_element() <= 0.0 {
                continue;
            }
            let density = layers.density(wi);
            match self.first_hit(start, wi) {
                None => {
                    let both = density + self.surroundings.density(wi);
                    sum += reflected * self.surroundings.radiance(wi) / both;
                }
                Some(meeting) => {
                    let next = ray.scattered(hit, wi, (1.0 / density).sqrt().min(0.5), start);
                    let light = self.shade(&next, meeting, sampler, MIRRORS, bounces - 1);
                    sum += reflected / density * light.min(Vec3::splat(BRIGHTEST));
                }
            }
        }
        sum / self.splits as f32
    }
}

/// One of the round footprints that cover the pixel, by a random number: each of the pixel's samples sees another.
fn tap(hit: &Hit, [dx, dy]: [Vec3; 2], u: f32) -> SurfacePoint {
    let pixel = PixelEllipse::from_derivatives(dx, dy);
    let count = pixel.taps(TAPS).count();
    let (offset, footprint) =
        pixel.taps(TAPS).nth((u * count as f32) as usize).unwrap_or((Vec3::ZERO, pixel.long()));
    let point = hit.point(footprint);
    let [u, v] = point.tangents;
    let (e, f, g) = (u.length_squared(), u.dot(v), v.length_squared());
    let (a, b) = (offset.dot(u), offset.dot(v));
    let uv = Vec2::new(g * a - f * b, e * b - f * a) / (e * g - f * f);
    let uv = if uv.is_finite() { point.uv + uv } else { point.uv };
    SurfacePoint { position: point.position + offset, uv, ..point }
}

impl Coat {
    /// The normal of a facet of the slopes that are too fine for the pixel, towards the ray.
    fn facet(&self, u: Vec2, hit: &Hit, direction: Vec3) -> Vec3 {
        let alpha = (2.0 * self.slope_variance).sqrt();
        let normal = if alpha > 1e-4 {
            let radius = (-2.0 * (1.0 - u.x).ln()).sqrt();
            let (sin, cos) = (TAU * u.y).sin_cos();
            let facet = Beckmann::clamped(alpha, alpha).from_gaussian(radius * Vec2::new(cos, sin));
            Frame::from_normal(self.normal).to_world(facet)
        } else {
            self.normal
        };
        if normal.dot(direction) < -0.01 { normal } else { hit.normal }
    }
}

/// Layers in the light of one view.
pub struct Lit<'a> {
    layers: Vec<(Frame, Vec3, &'a dyn Brdf)>,
}

impl<'a> Lit<'a> {
    pub fn new(layers: &'a [Layer], seen: &Seen) -> Self {
        let layers = layers.iter().map(|layer| {
            let frame = Frame::from_normal_tangent(layer.normal, seen.tangent);
            // A bump that faces away is seen along it.
            let local = frame.to_local(seen.view);
            let wo = Vec3::new(local.x, local.y, local.z.max(0.02)).normalize();
            (frame, wo, layer.brdf.as_ref())
        });
        Self { layers: layers.collect() }
    }

    /// Σ f_r cos θ, none from below the surface of this normal.
    pub fn reflected(&self, normal: Vec3, wi: Vec3) -> Vec3 {
        if wi.dot(normal) <= 0.0 {
            return Vec3::ZERO;
        }
        self.layers.iter().fold(Vec3::ZERO, |sum, (frame, wo, brdf)| {
            let local = frame.to_local(wi);
            sum + brdf.value(local, *wo) * local.z.max(0.0)
        })
    }

    fn sample(&self, sampler: &mut Sampler) -> Vec3 {
        let mut u = sampler.point();
        let place = u.x * self.layers.len() as f32;
        let index = (place as usize).min(self.layers.len() - 1);
        u.x = place - index as f32;
        let (frame, wo, brdf) = &self.layers[index];
        frame.to_world(brdf.sample(*wo, u)).normalize()
    }

    fn density(&self, wi: Vec3) -> f32 {
        let all: f32 =
            self.layers.iter().map(|(frame, wo, brdf)| brdf.density(frame.to_local(wi), *wo)).sum();
        all / self.layers.len() as f32
    }
}

#[cfg(test)]
mod tests {
    use std::f32::consts::PI;

    use asperity_shading::Lambert;

    use super::*;

    fn mean(stage: &Stage<'_>) -> Vec3 {
        let camera = Camera::new(Vec3::new(0.0, -5.0, 1.0), Vec3::ZERO, 0.2, 16, 16);
        let sampling = Sampling { width: 16, height: 16, samples_per_pixel: 16, seed: 1 };
        let image = stage.draw(sampling, &camera, &ProgressBar::hidden(), &AtomicBool::new(false)).unwrap();
        image.pixels.iter().sum::<Vec3>() / 256.0
    }

    fn sphere(finish: impl Fn(&Seen) -> Appearance + Sync + 'static) -> Vec3 {
        mean(&Stage {
            objects: vec![Object::new(Shape::Sphere, finish)],
            surroundings: &Vec3::ONE,
            backdrop: Some(Vec3::ZERO),
            splits: 1,
        })
    }

    #[test]
    fn nothing_white_is_seen_in_a_furnace() {
        let chalk = sphere(|seen| Appearance {
            layers: vec![Layer {
                normal: seen.point.normal,
                brdf: Box::new(Lambert::new(Vec3::new(1.0, 0.5, 0.2)).unwrap()),
            }],
            ..Default::default()
        });
        // Standard error of 4096 samples, half of them weighted away from the cosine: 0.01.
        assert!((chalk - Vec3::new(1.0, 0.5, 0.2)).abs().max_element() < 0.03, "{chalk}");
        for behind in [Behind::Pane(Vec3::ONE), Behind::Body(Vec3::ONE), Behind::Metal(Vec3::ONE)] {
            let clear = sphere(move |seen| Appearance {
                coat: Some(Coat {
                    normal: seen.point.normal,
                    slope_variance: 0.0,
                    fresnel: Dielectric::new(1.5).unwrap(),
                    behind,
                }),
                ..Default::default()
            });
            assert!((clear - Vec3::ONE).abs().max_element() < 0.02, "{clear}");
        }
    }

    #[test]
    fn a_lid_over_a_plane_takes_its_light() {
        let chalk = |seen: &Seen| Appearance {
            layers: vec![Layer {
                normal: seen.point.normal,
                brdf: Box::new(Lambert::new(Vec3::splat(0.5)).expect("a share")),
            }],
            ..Default::default()
        };
        let mut stage = Stage {
            objects: vec![
                Object::new(Shape::Plane, chalk),
                Object::new(Shape::Sphere, |_: &Seen| Appearance::default()),
            ],
            surroundings: &Vec3::ONE,
            backdrop: Some(Vec3::ZERO),
            splits: 1,
        };
        let camera = Camera::new(Vec3::new(0.0, -4.0, 6.0), Vec3::new(0.0, -1.15, 0.0), 0.002, 8, 8);
        let at = |stage: &Stage<'_>| {
            let sampling = Sampling { width: 8, height: 8, samples_per_pixel: 64, seed: 1 };
            let image =
                stage.draw(sampling, &camera, &ProgressBar::hidden(), &AtomicBool::new(false)).unwrap();
            image.pixels.iter().sum::<Vec3>().x / 64.0
        };
        let shadowed = at(&stage);
        stage.objects[1].shadow = Shadow::None;
        stage.objects.truncate(1);
        let open = at(&stage);
        assert!((open - 0.5).abs() < 0.01, "{open}");
        // The share of the sky, by the cosine, that a ball takes whose centre is on the plane, h of its radii away.
        let h: f32 = 1.15;
        let root = (h * h - 1.0).sqrt();
        let hidden = ((1.0 / root).atan() - root / (h * h)) / PI;
        assert!((shadowed - 0.5 * (1.0 - hidden)).abs() < 0.01, "{shadowed}, {hidden}");
    }
}
