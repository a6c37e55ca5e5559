//! One picture of one object: everything that decides it, with defaults that look well.

use std::sync::atomic::AtomicBool;

use asperity_shading::{BumpField, LevelOfDetail};
use glam::{Vec2, Vec3};
use indicatif::ProgressBar;

use crate::{
    failure::Failure,
    image::{Image, tone::hex},
};
use crate::{
    geometry::{
        camera::Camera,
        mesh::TracedMesh,
        shape::{Hit, Shape},
        teapot::teapot,
    },
    integrator::{
        direct::{Facets, Material, SharedNdf},
        pixels::{Sampling, render},
    },
    light::{background::background, lamps::studio},
    materials::field::{Field, NoiseKind},
};

/// The share of the tint that is diffuse.
const DIFFUSE: f32 = 0.13;

/// What is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// The unit sphere; the tangents go around its upright axis.
    Sphere,
    /// The Utah teapot.
    Teapot,
    /// A plane, seen at a slant.
    Plane,
}

/// The noise that the bumps are made of.
#[derive(Clone, Copy, Debug)]
pub struct Bumps {
    pub kind: NoiseKind,
    /// Lattice cells of the first octave per unit of length.
    pub frequency: f32,
    /// The most octaves, up to 16.
    pub octaves: u32,
    /// Each octave's amplitude over the last one's.
    pub gain: f32,
}

impl Bumps {
    /// The bump map in space.
    pub fn field(&self, seed: u32) -> Result<BumpField<Field>, Failure> {
        Ok(BumpField::new(Field::new(self.kind, self.octaves, self.gain, seed)?, self.frequency)?)
    }
}

/// One picture.
#[derive(Clone, Copy)]
pub struct RenderRequest<'a> {
    view: View,
    pub ndf: &'a SharedNdf,
    pub facets: Facets<'a>,
    /// How many times closer than the view of the whole object.
    pub zoom: f32,
    pub bumps: Bumps,
    /// Reflectance of the surface in linear RGB.
    pub tint: Vec3,
    /// Multiplies the exposure at which the density's peak, under the key light alone, is just short of white.
    pub exposure: f32,
    pub sampling: Sampling,
}

impl<'a> RenderRequest<'a> {
    /// A copper-coloured picture of the whole subject by the `Exact` rule.
    pub fn new(subject: Subject, ndf: &'a SharedNdf, sampling: Sampling) -> Self {
        let frequency = match subject {
            Subject::Sphere => 55.0,
            Subject::Teapot => 16.0,
            Subject::Plane => 24.0,
        };
        Self::seen(View::of(subject), frequency, ndf, sampling)
    }

    /// The same of a mesh in the unit ball.
    pub fn of_mesh(mesh: &TracedMesh, ndf: &'a SharedNdf, sampling: Sampling) -> Self {
        Self::seen(View::of_mesh(mesh), 24.0, ndf, sampling)
    }

    fn seen(view: View, frequency: f32, ndf: &'a SharedNdf, sampling: Sampling) -> Self {
        Self {
            view,
            ndf,
            facets: Facets::Consistent(LevelOfDetail::Exact),
            zoom: 1.0,
            bumps: Bumps { kind: NoiseKind::Gaussian, frequency, octaves: 16, gain: 0.8 },
            tint: hex(0xf2_b184),
            exposure: 1.45,
            sampling,
        }
    }

    /// The subject as the ray caster takes it; to be shared between pictures.
    pub fn shape(subject: Subject) -> Shape {
        match subject {
            Subject::Sphere => Shape::Sphere,
            Subject::Plane => Shape::Plane,
            Subject::Teapot => Shape::Mesh(TracedMesh::new(teapot())),
        }
    }

    /// The camera: towards the whole object at zoom 1, and from there straight to a point of its surface.
    pub fn camera(&self) -> Camera {
        let view = self.view;
        let near = 1.0 / self.zoom;
        // The aim swings to the point faster than the eye comes closer, so that the point stays in the picture.
        let aim = view.focus + (view.centre - view.focus) * near * near;
        let eye = view.focus + (view.eye - view.focus) * near;
        Camera::new(eye, aim, view.field.to_radians(), self.sampling.width, self.sampling.height)
    }

    /// Draws it, toned for the screen.
    pub fn draw(
        &self,
        shape: &Shape,
        progress: &ProgressBar,
        interrupted: &AtomicBool,
    ) -> Result<Image, Failure> {
        Ok(self.radiance(shape, progress, interrupted)?.exposed(1.0))
    }

    /// Draws it, in linear radiance.
    pub fn radiance(
        &self,
        shape: &Shape,
        progress: &ProgressBar,
        interrupted: &AtomicBool,
    ) -> Result<Image, Failure> {
        let bumps = self.bumps.field(self.sampling.seed)?;
        let lights = studio(self.tint * (self.exposure / peak(self.ndf)));
        let material = Material {
            ndf: self.ndf,
            facets: self.facets,
            bumps: &bumps,
            lights: &lights,
            diffuse: self.tint * DIFFUSE,
        };
        let camera = self.camera();
        let shade =
            |direction: Vec3, hit: &Hit| material.radiance(hit, -direction, camera.footprint(direction, hit));
        trace(self.sampling, &camera, shape, progress, interrupted, shade)
    }
}

/// The shape before the background, each hit shaded by `shade(ray's direction, hit)`, in linear radiance.
pub fn trace(
    sampling: Sampling,
    camera: &Camera,
    shape: &Shape,
    progress: &ProgressBar,
    interrupted: &AtomicBool,
    shade: impl Fn(Vec3, &Hit) -> Vec3 + Sync,
) -> Result<Image, Failure> {
    let size = Vec2::new(sampling.width as f32, sampling.height as f32);
    render(sampling, progress, interrupted, |x, y| {
        let direction = camera.direction(x, y);
        match shape.first_hit(camera.eye(), direction) {
            Some(hit) => shade(direction, &hit.facing(direction)),
            None => background(x / size.x, y / size.y),
        }
    })
}

/// Where the camera stands for the whole object, and the point of the surface that it comes close to.
#[derive(Clone, Copy)]
struct View {
    eye: Vec3,
    centre: Vec3,
    focus: Vec3,
    /// Full angle in degrees.
    field: f32,
}

impl View {
    fn of(subject: Subject) -> Self {
        match subject {
            Subject::Sphere => Self {
                eye: Vec3::new(0.0, -4.9, 1.2),
                centre: Vec3::ZERO,
                focus: Vec3::new(-0.30, -0.80, 0.52).normalize(),
                field: 27.0,
            },
            Subject::Teapot => Self {
                eye: Vec3::new(4.4, -12.6, 5.6),
                centre: Vec3::new(0.25, 0.0, 1.42),
                focus: Vec3::new(-0.45, -1.85, 1.45),
                field: 29.0,
            },
            Subject::Plane => {
                Self { eye: Vec3::new(0.0, -3.0, 3.0), centre: Vec3::ZERO, focus: Vec3::ZERO, field: 27.0 }
            }
        }
    }

    /// The unit ball from the front, a little from the right and from above, just inside the picture; nearby, the
    /// point that is in its middle, or else the corner that is nearest to the eye.
    fn of_mesh(mesh: &TracedMesh) -> Self {
        let eye = Vec3::new(1.3, -4.0, 1.7);
        let field = 27.0_f32;
        let eye = eye.normalize() / (0.48 * field.to_radians()).sin();
        let focus = match mesh.first_hit(eye, -eye.normalize()) {
            Some(hit) => hit.position,
            None => mesh.nearest_corner(eye),
        };
        Self { eye, centre: Vec3::ZERO, focus, field }
    }
}

/// The greatest density on a grid over the unit disk.
pub fn peak(ndf: &SharedNdf) -> f32 {
    const SIDE: i32 = 64;
    let mut peak = ndf.density(Vec3::Z);
    for j in -SIDE..=SIDE {
        for i in -SIDE..=SIDE {
            let (x, y) = (i as f32 / SIDE as f32, j as f32 / SIDE as f32);
            let z2 = 1.0 - x * x - y * y;
            if z2 > 1e-4 {
                peak = peak.max(ndf.density(Vec3::new(x, y, z2.sqrt())));
            }
        }
    }
    peak
}
