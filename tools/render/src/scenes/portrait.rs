//! An image of one object: all parameters, with good defaults.

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

/// The diffuse fraction of the tint.
const DIFFUSE: f32 = 0.13;

/// Radius of every studio lamp, twice the distance between lamps.
const LAMP: f32 = 0.25;

/// Direction of the point into which images of the sphere zoom.
const SPHERE_FOCUS: Vec3 = Vec3::new(-0.30, -0.80, 0.52);

/// A request for one image.
#[derive(Clone, Copy)]
pub struct RenderRequest<'a> {
    pub view: View,
    pub ndf: &'a SharedNdf,
    pub facets: Facets<'a>,
    /// Magnification relative to the view of the whole object.
    pub zoom: f32,
    pub bumps: Bumps,
    /// Reflectance of the surface in linear RGB.
    pub tint: Vec3,
    /// Factor for the exposure at which the density's peak, under the key light alone, is just
    /// below white.
    pub exposure: f32,
    pub sampling: Sampling,
}

impl<'a> RenderRequest<'a> {
    /// Creates a copper-colored image of the whole subject of a set, with the `Exact` rule.
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

    /// Returns the sphere, the teapot, or otherwise the plane, for sharing between images.
    pub fn shape(set: Set) -> Arc<Shape> {
        match set {
            Set::Sphere => Arc::new(Shape::Sphere),
            Set::Teapot => Arc::clone(&TEAPOT),
            _ => Arc::new(Shape::Plane),
        }
    }

    /// Returns the camera of the image.
    pub fn camera(&self) -> Camera {
        self.view.camera(self.zoom, self.sampling)
    }

    /// Returns the object with its material under the lamps.
    pub fn scene(&self, shape: &Arc<Shape>) -> Result<Scene<'a, 'a>, Failure> {
        let focus = self.view.focus.as_dvec3();
        let bumps = self.bumps.field(self.sampling.seed, focus)?;
        let peak = peak(|m| self.ndf.d(m));
        let lamps = studio(self.tint * (self.exposure / peak));
        let (ndf, facets) = (self.ndf, self.facets);
        let (most, diffuse) = (share_beyond(peak, LAMP), self.tint * DIFFUSE);
        let material = Printed { ndf, facets, bumps, lamps, most, diffuse };
        let objects = vec![Object::new(Arc::clone(shape), material).anchored(focus)];
        Ok(Scene::new(objects, Light::lamps(Vec::new()), Backdrop::Studio).about(focus))
    }
}

/// Returns the maximum density on a fine grid over the unit disk.
pub fn peak(density: impl Fn(Vec3) -> f32) -> f32 {
    const SIDE: i32 = 160;
    let grid =
        (-SIDE..=SIDE).flat_map(|j| (-SIDE..=SIDE).map(move |i| [i, j].map(|k| k as f32 / SIDE as f32)));
    let directions = grid.map(|[x, y]| (x, y, 1.0 - x * x - y * y)).filter(|(.., z2)| *z2 > 1e-4);
    directions.map(|(x, y, z2)| density(Vec3::new(x, y, z2.sqrt()))).fold(density(Vec3::Z), f32::max)
}
