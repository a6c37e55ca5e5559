//! One picture of one object: everything that decides it, with defaults that look well.

use std::sync::Arc;

use asperity_shading::LevelOfDetail;
use glam::Vec3;

use crate::{
    failure::Failure,
    geometry::{camera::Camera, mesh::TracedMesh, shape::Shape, teapot::teapot},
    image::tone::hex,
    integrator::pixels::Sampling,
    light::lamps::studio,
    materials::{
        Facets, Printed, SharedNdf,
        field::{Bumps, NoiseKind},
    },
    scene::{Backdrop, Light, Object, Scene},
    scenes::sets::Set,
};

/// The share of the tint that is diffuse.
const DIFFUSE: f32 = 0.13;

/// One picture.
#[derive(Clone, Copy)]
pub struct RenderRequest<'a> {
    view: Approach,
    pub ndf: &'a SharedNdf,
    pub facets: Facets<'a>,
    /// Magnification over the view of the whole object.
    pub zoom: f32,
    pub bumps: Bumps,
    /// Reflectance of the surface in linear RGB.
    pub tint: Vec3,
    /// Multiplies the exposure at which the density's peak, under the key light alone, is just short of white.
    pub exposure: f32,
    pub sampling: Sampling,
}

impl<'a> RenderRequest<'a> {
    /// A copper-coloured picture of the whole subject of a set by the `Exact` rule.
    pub fn new(set: Set, ndf: &'a SharedNdf, sampling: Sampling) -> Self {
        let frequency = match set {
            Set::Sphere => 55.0,
            Set::Teapot => 16.0,
            _ => 24.0,
        };
        Self::seen(Approach::of(set), frequency, ndf, sampling)
    }

    /// A copper-coloured picture of a mesh in the unit ball.
    pub fn of_mesh(mesh: &TracedMesh, ndf: &'a SharedNdf, sampling: Sampling) -> Self {
        Self::seen(Approach::of_mesh(mesh), 24.0, ndf, sampling)
    }

    fn seen(view: Approach, frequency: f32, ndf: &'a SharedNdf, sampling: Sampling) -> Self {
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

    /// The sphere, the teapot, or else the plane, to be shared between pictures.
    pub fn shape(set: Set) -> Arc<Shape> {
        Arc::new(match set {
            Set::Sphere => Shape::Sphere,
            Set::Teapot => Shape::Mesh(TracedMesh::new(teapot())),
            _ => Shape::Plane,
        })
    }

    /// The camera of the picture.
    pub fn camera(&self) -> Camera {
        self.view.camera(self.zoom, self.sampling)
    }

    /// The object with its material under the lamps.
    pub fn scene(&self, shape: &Arc<Shape>) -> Result<Scene<'a, 'a>, Failure> {
        let bumps = self.bumps.field(self.sampling.seed)?;
        let lamps = studio(self.tint * (self.exposure / peak(self.ndf)));
        let (ndf, facets) = (self.ndf, self.facets);
        let material = Printed { ndf, facets, bumps, lamps, diffuse: self.tint * DIFFUSE };
        let objects = vec![Object::new(Arc::clone(shape), material)];
        Ok(Scene::new(objects, Light::lamps(Vec::new()), Backdrop::Studio))
    }
}

/// Way of a camera from the whole object to a point of its surface.
#[derive(Clone, Copy)]
pub struct Approach {
    eye: Vec3,
    centre: Vec3,
    focus: Vec3,
    /// Full angle in degrees.
    field: f32,
}

impl Approach {
    fn of(set: Set) -> Self {
        match set {
            Set::Sphere => Self {
                eye: Vec3::new(0.0, -4.9, 1.2),
                centre: Vec3::ZERO,
                focus: Vec3::new(-0.30, -0.80, 0.52).normalize(),
                field: 27.0,
            },
            Set::Teapot => Self {
                eye: Vec3::new(4.4, -12.6, 5.6),
                centre: Vec3::new(0.25, 0.0, 1.42),
                focus: Vec3::new(-0.45, -1.85, 1.45),
                field: 29.0,
            },
            _ => Self { eye: Vec3::new(0.0, -3.0, 3.0), centre: Vec3::ZERO, focus: Vec3::ZERO, field: 27.0 },
        }
    }

    /// The unit ball from the front, a little from the right and from above, just inside the picture; nearby, the
    /// point that is in its middle, or else the corner that is nearest to the eye.
    pub fn of_mesh(mesh: &TracedMesh) -> Self {
        let eye = Vec3::new(1.3, -4.0, 1.7);
        let field = 27.0_f32;
        let eye = eye.normalize() / (0.48 * field.to_radians()).sin();
        let focus = match mesh.first_hit(eye, -eye.normalize()) {
            Some(hit) => hit.position,
            None => mesh.nearest_corner(eye),
        };
        Self { eye, centre: Vec3::ZERO, focus, field }
    }

    /// The camera: towards the whole object at zoom 1, and from there straight to a point of its surface.
    pub fn camera(&self, zoom: f32, sampling: Sampling) -> Camera {
        let near = 1.0 / zoom;
        // The aim swings to the point faster than the eye comes closer, so that the point stays in the picture.
        let aim = self.focus + (self.centre - self.focus) * near * near;
        let eye = self.focus + (self.eye - self.focus) * near;
        Camera::new(eye, aim, self.field.to_radians(), sampling.width, sampling.height)
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
