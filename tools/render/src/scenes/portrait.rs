//! One picture of one object: everything that decides it, with defaults that look well.

use std::sync::Arc;

use asperity_shading::LevelOfDetail;
use glam::Vec3;

use crate::{
    failure::Failure,
    geometry::{camera::Camera, shape::Shape},
    image::tone::hex,
    integrator::pixels::Sampling,
    light::lamps::studio,
    materials::{
        Facets, Printed, SharedNdf,
        field::{Bumps, NoiseKind},
        share_beyond,
    },
    scene::{Backdrop, Light, Object, Scene},
    scenes::sets::{Set, TEAPOT, View},
};

/// The share of the tint that is diffuse.
const DIFFUSE: f32 = 0.13;

/// Radius of every lamp of the studio, twice their distance from one another.
const LAMP: f32 = 0.25;

/// Direction of the point that pictures of the sphere come close to.
const SPHERE_FOCUS: Vec3 = Vec3::new(-0.30, -0.80, 0.52);

/// Request for one picture.
#[derive(Clone, Copy)]
pub struct RenderRequest<'a> {
    pub view: View,
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
        let (view, frequency) = match set {
            Set::Sphere => {
                (View::new([0.0, -4.9, 1.2], [0.0; 3], 27.0).towards(SPHERE_FOCUS.normalize()), 55.0)
            }
            Set::Teapot => (set.view(), 16.0),
            _ => (View::new([0.0, -3.0, 3.0], [0.0; 3], 27.0), 24.0),
        };
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
        match set {
            Set::Sphere => Arc::new(Shape::Sphere),
            Set::Teapot => Arc::clone(&TEAPOT),
            _ => Arc::new(Shape::Plane),
        }
    }

    /// The camera of the picture.
    pub fn camera(&self) -> Camera {
        self.view.camera(self.zoom, self.sampling)
    }

    /// The object with its material under the lamps.
    pub fn scene(&self, shape: &Arc<Shape>) -> Result<Scene<'a, 'a>, Failure> {
        let focus = self.view.focus.as_dvec3();
        let bumps = self.bumps.field(self.sampling.seed, focus)?;
        let peak = peak(|m| self.ndf.density(m));
        let lamps = studio(self.tint * (self.exposure / peak));
        let (ndf, facets) = (self.ndf, self.facets);
        let (most, diffuse) = (share_beyond(peak, LAMP), self.tint * DIFFUSE);
        let material = Printed { ndf, facets, bumps, lamps, most, diffuse };
        let objects = vec![Object::new(Arc::clone(shape), material).anchored(focus)];
        Ok(Scene::new(objects, Light::lamps(Vec::new()), Backdrop::Studio).about(focus))
    }
}

/// The greatest density on a fine grid over the unit disk.
pub fn peak(density: impl Fn(Vec3) -> f32) -> f32 {
    const SIDE: i32 = 160;
    let grid =
        (-SIDE..=SIDE).flat_map(|j| (-SIDE..=SIDE).map(move |i| [i, j].map(|k| k as f32 / SIDE as f32)));
    let directions = grid.map(|[x, y]| (x, y, 1.0 - x * x - y * y)).filter(|(.., z2)| *z2 > 1e-4);
    directions.map(|(x, y, z2)| density(Vec3::new(x, y, z2.sqrt()))).fold(density(Vec3::Z), f32::max)
}
