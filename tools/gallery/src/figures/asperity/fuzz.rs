//! Cloth: a fuzz over a diffuse base that receives the remaining light.

use asperity_render::geometry::{camera::Camera, shape::Shape};
use asperity_render::image::tone::hex;
use asperity_render::light::environments::Studio;
use asperity_render::scene::{Backdrop, Light, Object, Scene};
use asperity_shading::bump::Facet;
use asperity_shading::material::Material;
use asperity_shading::reflectance::{Bsdf, CharlieSheen, Lobe, ZeltnerFuzz};
use asperity_shading::{Brdf, Lambert, SurfacePoint};
use glam::Vec3;

use crate::figure::{Context, Drawn};
use asperity::failure::Result;
use asperity::quality::EXPOSURE;

const ALPHAS: [f32; 3] = [0.15, 0.4, 0.8];

/// A fuzz, the fraction of light it transmits at a cosine, and the cloth beneath.
struct Cloth {
    fuzz: Option<Fuzz>,
    base: Lambert,
}

type Fuzz = (Box<dyn Brdf + Sync>, Box<dyn Fn(f32) -> f32 + Sync>);

impl Material for Cloth {
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        let frame = point.frame();
        let base = Lobe::from(&self.base as &dyn Brdf);
        let cloth = Bsdf::new(frame, wo);
        let Some((fuzz, transmittance)) = &self.fuzz else { return cloth.with([Facet::FLAT], [base]) };
        let base = base.weighted(Vec3::splat(transmittance(frame.normal.dot(wo))));
        cloth.with([Facet::FLAT], [base, Lobe::from(fuzz.as_ref() as &dyn Brdf)])
    }
}

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn> {
    let (base, fibers) = (Lambert::new(hex(0x3a_1420))?, hex(0xf0_c8c0));
    let mut cloths = vec![("base".to_owned(), "Without fuzz".to_owned(), None)];
    for alpha in ALPHAS {
        let fuzz = ZeltnerFuzz::new(fibers, alpha)?;
        let transmittance = Box::new(move |cosine| fuzz.transmittance(cosine));
        let layer: Fuzz = (Box::new(fuzz), transmittance);
        cloths.push((format!("zeltner-{alpha}"), format!("Zeltner, α = {alpha}"), Some(layer)));
    }
    for alpha in ALPHAS {
        let sheen = CharlieSheen::new(fibers, alpha)?;
        let transmittance = Box::new(move |cosine| sheen.transmittance(cosine));
        let layer: Fuzz = (Box::new(sheen), transmittance);
        cloths.push((format!("charlie-{alpha}"), format!("Charlie, α = {alpha}"), Some(layer)));
    }
    let (sampling, studio) = (context.sampling([8, 8], 1), Studio::new(1.0));
    let camera = Camera::new(Vec3::new(0.0, -6.0, 1.6), Vec3::ZERO, 0.4, sampling.width, sampling.height);
    let mut grains = Vec::new();
    let cloths = cloths.into_iter().map(|(stem, label, fuzz)| {
        let alt = format!("A sphere of dark red cloth: {label}");
        ([stem, label, alt], fuzz)
    });
    let drawn = Drawn::pictures(4, cloths, |fuzz| {
        let ball = Object::new(Shape::Sphere, Cloth { fuzz, base });
        let scene = Scene::new(vec![ball], Light::Around(&studio), Backdrop::Studio);
        let (image, grain) = context.still(&scene, sampling, &camera)?;
        grains.push(grain);
        Ok(image.filmic(EXPOSURE))
    })?;
    Ok(drawn.grain(&grains))
}
