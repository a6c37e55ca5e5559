//! The reflectances on spheres.

use asperity_render::geometry::camera::Camera;
use asperity_render::integrator::adaptive::Goal;
use asperity_render::materials::Layers;
use asperity_render::scene::{Backdrop, Light, Object, Scene};
use asperity_render::{geometry::shape::Shape, image::tone::hex, light::environments::Studio};
use asperity_shading::reflectance::{
    Absorption, BlinnPhongBrdf, BlinnPhongNormalization, OrenNayar, OrenNayarVariant, RoughDielectric,
    WardBrdf, WardNormalization,
};
use asperity_shading::{
    Brdf, Conductor, CookTorrance, Dielectric, EnergyPreservingOrenNayar, Ggx, Lambert, Phong,
    TorranceSparrow, ndf_sampling::Isotropic,
};
use glam::Vec3;

use crate::figure::{Context, Drawn};
use asperity::failure::Result;
use asperity::quality::EXPOSURE;

type Lobes = Vec<Box<dyn Brdf + Sync>>;

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn> {
    let clay = hex(0xd9_8a5f);
    let lacquer = |lobe: Box<dyn Brdf + Sync>| -> Result<Lobes> {
        Ok(vec![Box::new(Lambert::new(hex(0x8a_2a2a))?), lobe])
    };
    let gold = [Conductor::new(0.18, 3.42)?, Conductor::new(0.42, 2.35)?, Conductor::new(1.37, 1.77)?];
    let groove: Vec<f32> = (0..64).map(|k| (k as f32 / 63.0).powi(24)).collect();
    let lambert = Lambert::new(clay)?;
    let full = OrenNayar::new(clay, 0.6, OrenNayarVariant::Full)?;
    let fujii = OrenNayar::new(clay, 1.0, OrenNayarVariant::Fujii)?;
    let preserving = EnergyPreservingOrenNayar::new(clay, 1.0)?;
    let phong = lacquer(Box::new(Phong::new(Vec3::splat(0.25), 40.0)?))?;
    let blinn = BlinnPhongBrdf::new(Vec3::splat(0.25), 160.0, BlinnPhongNormalization::Albedo)?;
    let ward = WardBrdf::new(hex(0xb8_bdc4), 0.08, 0.35, WardNormalization::Bounded)?;
    let smooth = CookTorrance::new(Ggx::isotropic(0.25)?, gold);
    let grooves = TorranceSparrow::new(Isotropic::new(&groove)?, gold);
    let frosted = |alpha| -> Result<Lobes> {
        Ok(vec![Box::new(RoughDielectric::new(Ggx::isotropic(alpha)?, Dielectric::new(1.5)?))])
    };
    let sheet = RoughDielectric::thin(Ggx::isotropic(0.3)?, Dielectric::new(1.5)?, hex(0xc4_e0ea));
    let balls: [(&str, &str, Lobes); 12] = [
        ("lambert", "Lambert", vec![Box::new(lambert)]),
        ("oren-nayar", "Oren–Nayar, full, σ = 0.6", vec![Box::new(full)]),
        ("fujii", "Fujii, σ = 1", vec![Box::new(fujii)]),
        ("preserving", "Energy-preserving, r = 1", vec![Box::new(preserving)]),
        ("phong", "Phong, n = 40", phong),
        ("blinn-phong", "Blinn–Phong, n = 160", lacquer(Box::new(blinn))?),
        ("ward", "Ward, 0.08 and 0.35", vec![Box::new(ward)]),
        ("gold", "Cook–Torrance, GGX 0.25, gold", vec![Box::new(smooth)]),
        ("grooves", "Torrance–Sparrow, a table, gold", vec![Box::new(grooves)]),
        ("glass", "Rough glass, GGX 0.05", frosted(0.05)?),
        ("frosted", "Rough glass, GGX 0.3", frosted(0.3)?),
        ("thin", "Thin wall, GGX 0.3", vec![Box::new(sheet)]),
    ];
    let inside = Absorption::of_color(Vec3::new(0.86, 0.95, 0.92), 1.0)?;
    let words = |label| format!("A sphere in a room with three lamps: {label}");
    let balls = balls
        .map(|(stem, label, layers)| ([stem.to_owned(), label.to_owned(), words(label)], (stem, layers)));
    let (sampling, studio) = (context.sampling([10, 10], 1), Studio::new(1.0));
    let mut grains = Vec::new();
    let drawn = Drawn::pictures(3, balls, |(stem, layers)| {
        let ball = Object::new(Shape::Sphere, Layers(layers));
        let body = ["glass", "frosted"].contains(&stem).then_some(inside);
        let ball = Object { body, passes: if body.is_some() { 1.0 } else { 0.0 }, ..ball };
        let scene = Scene::new(vec![ball], Light::Around(&studio), Backdrop::Studio);
        let camera = Camera::new(Vec3::new(0.0, -6.0, 1.6), Vec3::ZERO, 0.4, sampling.width, sampling.height);
        // Few samples hit light refracted twice by rough glass.
        let [least, most] = context.goal.samples;
        let samples = [least, if body.is_some() { 2 * most } else { most }];
        let context = Context { goal: Goal { samples, ..context.goal }, ..*context };
        let (image, grain) = context.still(&scene, sampling, &camera)?;
        grains.push(grain);
        Ok(image.filmic(EXPOSURE))
    })?;
    Ok(drawn.grain(&grains))
}
