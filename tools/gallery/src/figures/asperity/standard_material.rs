//! The standard materials from afar and near by.

use asperity_render::geometry::{camera::Camera, shape::Shape};
use asperity_render::light::environments::Studio;
use asperity_render::materials::field::{Bumps, NoiseKind};
use asperity_render::scene::{Backdrop, Light, Object, Scene};
use asperity_shading::material::BumpMappedBrdf;
use asperity_shading::reflectance::FacetBrdf;
use asperity_shading::{OpenPbr, OpenPbrParameters, StandardMaterial, StandardMaterialParameters};
use glam::{DVec3, Vec3};

use crate::figure::{Context, Drawn, Panel};
use asperity::failure::Result;
use asperity::quality::EXPOSURE;

const ZOOMS: [f32; 2] = [1.0, 20.0];

type Brdf = Box<dyn FacetBrdf + Sync>;

fn materials() -> Result<Vec<(&'static str, &'static str, Brdf)>> {
    let p = StandardMaterialParameters { roughness: 0.5, ..Default::default() };
    let plastic = StandardMaterialParameters { metallic: 0.0, ..p };
    let gltf = |p| StandardMaterial::new(p).map(|material| Box::new(material) as Brdf);
    Ok(vec![
        (
            "brushed",
            "brushed copper",
            gltf(StandardMaterialParameters {
                base_color: Vec3::new(0.93, 0.62, 0.52),
                roughness: 0.4,
                anisotropy: 0.7,
                ..p
            })?,
        ),
        (
            "plastic",
            "plastic",
            gltf(StandardMaterialParameters { base_color: Vec3::new(0.02, 0.2, 0.4), ..plastic })?,
        ),
        (
            "car",
            "clearcoat",
            gltf(StandardMaterialParameters {
                base_color: Vec3::new(0.6, 0.02, 0.03),
                metallic: 0.6,
                roughness: 0.6,
                clearcoat: 1.0,
                clearcoat_roughness: 0.1,
                ..p
            })?,
        ),
        (
            "velvet",
            "sheen",
            gltf(StandardMaterialParameters {
                base_color: Vec3::new(0.2, 0.02, 0.15),
                roughness: 0.9,
                sheen_color: Vec3::new(0.9, 0.5, 0.8),
                sheen_roughness: 0.5,
                ..plastic
            })?,
        ),
        (
            "glass",
            "transmission",
            gltf(StandardMaterialParameters {
                base_color: Vec3::new(0.7, 0.95, 0.85),
                roughness: 0.35,
                transmission: 1.0,
                thickness: 1.0,
                ..plastic
            })?,
        ),
        (
            "stone",
            "OpenPBR coat",
            OpenPbr::new(OpenPbrParameters {
                base_color: Vec3::new(0.35, 0.3, 0.22),
                base_diffuse_roughness: 0.8,
                specular_roughness: 0.6,
                coat_weight: 1.0,
                coat_color: Vec3::new(0.95, 0.8, 0.5),
                coat_roughness: 0.2,
                ..Default::default()
            })
            .map(|material| Box::new(material) as Brdf)?,
        ),
    ])
}

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn> {
    let bumps = Bumps { kind: NoiseKind::Gaussian, frequency: 100.0, octaves: 12, gain: 0.5 };
    let (sampling, studio) = (context.sampling([8, 8], 1), Studio::new(1.0));
    let materials = materials()?;
    let (mut panels, mut grains) = (Vec::new(), Vec::new());
    for zoom in ZOOMS {
        for (stem, name, material) in &materials {
            let bumps = bumps.field(context.seed, DVec3::ZERO)?;
            let ball = Object::new(Shape::Sphere, BumpMappedBrdf { brdf: &**material, bumps });
            let scene = Scene::new(vec![ball], Light::Around(&studio), Backdrop::Studio);
            let target = Vec3::new(0.3, -0.85, 0.35) * (1.0 - 1.0 / zoom);
            let camera =
                Camera::new(Vec3::new(0.0, -6.0, 1.6), target, 0.4 / zoom, sampling.width, sampling.height);
            let (image, grain) = context.still(&scene, sampling, &camera)?;
            grains.push(grain);
            let (label, alt) = (format!("{name}, ×{zoom}"), format!("A sphere of {name} at zoom {zoom}."));
            panels.push(Panel::new(format!("{stem}-{zoom}"), label, alt, image.filmic(EXPOSURE)));
        }
    }
    Ok(Drawn::new(6, panels).grain(&grains))
}
