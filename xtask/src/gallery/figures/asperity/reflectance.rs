//! The reflectances on spheres.

use asperity_render::geometry::camera::Camera;
use asperity_render::geometry::shape::Shape;
use asperity_render::image::tone::hex;
use asperity_render::light::environments::Studio;
use asperity_render::materials::Layers;
use asperity_render::scene::{Backdrop, Light, Object, Scene};
use asperity_shading::reflectance::{
    BlinnPhongFactor, BlinnPhongLobe, OrenNayar, OrenNayarForm, WardForm, WardReflection,
};
use asperity_shading::{
    Brdf, Conductor, CookTorrance, EnergyPreservingOrenNayar, Ggx, Lambert, Phong, TorranceSparrow,
    ndf_sampling::Isotropic,
};
use glam::Vec3;

use crate::failure::Failure;
use crate::gallery::figure::{Context, Drawn, Panel};

type Lobes = Vec<Box<dyn Brdf + Sync>>;

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn, Failure> {
    let clay = hex(0xd9_8a5f);
    let lacquer = |lobe: Box<dyn Brdf + Sync>| -> Result<Lobes, Failure> {
        Ok(vec![Box::new(Lambert::new(hex(0x8a_2a2a))?), lobe])
    };
    let gold = [Conductor::new(0.18, 3.42)?, Conductor::new(0.42, 2.35)?, Conductor::new(1.37, 1.77)?];
    let groove: Vec<f32> = (0..64).map(|k| (k as f32 / 63.0).powi(24)).collect();
    let balls: Vec<(&str, &str, Lobes)> = vec![
        ("lambert", "Lambert", vec![Box::new(Lambert::new(clay)?)]),
        (
            "oren-nayar",
            "Oren\u{2013}Nayar, full, \u{3c3} = 0.6",
            vec![Box::new(OrenNayar::new(clay, 0.6, OrenNayarForm::Full)?)],
        ),
        ("fujii", "Fujii, \u{3c3} = 1", vec![Box::new(OrenNayar::new(clay, 1.0, OrenNayarForm::Fujii)?)]),
        (
            "preserving",
            "Energy-preserving, r = 1",
            vec![Box::new(EnergyPreservingOrenNayar::new(clay, 1.0)?)],
        ),
        ("phong", "Phong, n = 40", lacquer(Box::new(Phong::new(Vec3::splat(0.25), 40.0)?))?),
        (
            "blinn-phong",
            "Blinn\u{2013}Phong, n = 160",
            lacquer(Box::new(BlinnPhongLobe::new(Vec3::splat(0.25), 160.0, BlinnPhongFactor::Albedo)?))?,
        ),
        (
            "ward",
            "Ward, 0.08 and 0.35",
            vec![Box::new(WardReflection::new(hex(0xb8_bdc4), 0.08, 0.35, WardForm::Bounded)?)],
        ),
        (
            "gold",
            "Cook\u{2013}Torrance, GGX 0.25, gold",
            vec![Box::new(CookTorrance::new(Ggx::isotropic(0.25)?, gold))],
        ),
        (
            "grooves",
            "Torrance\u{2013}Sparrow, a table, gold",
            vec![Box::new(TorranceSparrow::new(Isotropic::new(&groove)?, gold))],
        ),
    ];
    let sampling = context.sampling([8, 8], 12);
    let camera = Camera::new(Vec3::new(0.0, -6.0, 1.6), Vec3::ZERO, 0.4, sampling.width, sampling.height);
    let studio = Studio::new(1.0);
    let mut panels = Vec::new();
    for (stem, label, layers) in balls {
        let ball = Object::new(Shape::Sphere, Layers(layers));
        let scene = Scene::new(vec![ball], Light::Around(&studio), Backdrop::Studio);
        let alt = format!("A sphere in a room with three lamps: {label}");
        let image = context.draw(&scene, sampling, &camera)?.exposed(1.0);
        panels.push(Panel::raster(stem, label, &alt, image));
    }
    Ok(Drawn::new(3, panels).fact("samples per pixel", sampling.samples_per_pixel.to_string()))
}
