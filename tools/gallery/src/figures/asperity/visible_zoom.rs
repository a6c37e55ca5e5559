//! A microfacet model whose facets become bumps: gold at four zooms, and the light of single
//! points.

use asperity_render::geometry::{camera::Camera, shape::Shape};
use asperity_render::light::environments::Studio;
use asperity_render::materials::field::{Bumps, NoiseKind};
use asperity_render::sampling::low_discrepancy::r2;
use asperity_render::scene::{Backdrop, Light, Object, Scene};
use asperity_shading::level_of_detail::ResolvedBumps;
use asperity_shading::material::BumpMappedBrdf;
use asperity_shading::ndf_sampling::inverse_gaussian_cdf;
use asperity_shading::reflectance::{BumpFacets, FacetBrdf};
use asperity_shading::{Conductor, CookTorrance, Ggx};
use glam::{DVec3, Vec2, Vec3};

use crate::figure::{Context, Drawn, Panel};
use crate::figures::kautz::objects::ggx;
use crate::plot::{Axis, Names, Plot, Stroke};
use asperity::failure::Result;
use asperity::quality::EXPOSURE;

const ZOOMS: [f32; 4] = [1.0, 4.0, 16.0, 64.0];
const ALPHA: [f32; 2] = [0.2, 0.4];

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn> {
    let bumps = Bumps { kind: NoiseKind::Gaussian, frequency: 150.0, octaves: 16, gain: 0.5 };
    let gold = [Conductor::new(0.18, 3.42)?, Conductor::new(0.42, 2.35)?, Conductor::new(1.37, 1.77)?];
    let gold = CookTorrance::new(Ggx::new(ALPHA[0], ALPHA[1])?, gold);
    let (sampling, studio) = (context.sampling([10, 10], 1), Studio::new(1.0));
    let (mut panels, mut grains) = (Vec::new(), Vec::new());
    for zoom in ZOOMS {
        let bumps = bumps.field(context.seed, DVec3::ZERO)?;
        let ball = Object::new(Shape::Sphere, BumpMappedBrdf { brdf: gold, bumps });
        let scene = Scene::new(vec![ball], Light::Around(&studio), Backdrop::Studio);
        // Past the reflection of the main lamp.
        let target = Vec3::new(0.3, -0.85, 0.35) * (1.0 - 1.0 / zoom);
        let camera =
            Camera::new(Vec3::new(0.0, -6.0, 1.6), target, 0.4 / zoom, sampling.width, sampling.height);
        let (image, grain) = context.still(&scene, sampling, &camera)?;
        grains.push(grain);
        let alt = format!("A sphere of rough gold at zoom {zoom}.");
        panels.push(Panel::new(format!("gold-{zoom}"), format!("×{zoom}"), alt, image.filmic(EXPOSURE)));
    }
    for (stem, degrees) in [("0", 0.0_f32), ("60", 60.0), ("80", 80.0)] {
        panels.push(energies(stem, degrees)?);
    }
    Ok(Drawn::new(4, panels).fact("density", ggx(ALPHA)).grain(&grains))
}

/// Plots the albedo of single points of a white surface in descending order.
fn energies(stem: &str, degrees: f32) -> Result<Panel> {
    const POINTS: u32 = 600;
    const SAMPLES: u32 = 400;
    const RESOLVED: f32 = 0.8;
    let white = CookTorrance::new(Ggx::isotropic(0.5)?, Vec3::ONE);
    let wo = Vec3::new(degrees.to_radians().sin(), 0.0, degrees.to_radians().cos());
    let mut plot = Plot::new(
        [420.0, 300.0],
        Axis::linear("fraction of the surface", [0.0, 1.0], 0.25),
        Axis::log2("", [1.0 / 16.0, 64.0]),
        Names::Above,
    );
    for (series, facets, name) in
        [(1, BumpFacets::Visible, "visible facets"), (2, BumpFacets::All, "by area")]
    {
        let brdf = white.with_bump_facets(facets);
        let mut albedos: Vec<f64> = (0..POINTS)
            .map(|k| {
                let z = Vec2::from(r2(k).map(|u| inverse_gaussian_cdf(u) as f32));
                let bumps = ResolvedBumps { z, variance: RESOLVED, blend: 1.0 };
                let weight = |j: u32| {
                    let u = Vec2::from(r2(j).map(|u| u as f32));
                    let sample = brdf.sample_resolved(wo, 0.5, u, bumps);
                    sample.map_or(0.0, |sample| f64::from(sample.weight().x))
                };
                (0..SAMPLES).map(weight).sum::<f64>() / f64::from(SAMPLES)
            })
            .collect();
        albedos.sort_by(|a, b| b.total_cmp(a));
        let points = albedos
            .iter()
            .enumerate()
            .map(|(k, albedo)| [(k as f64 + 0.5) / f64::from(POINTS), albedo.max(1.0 / 16.0)]);
        plot = plot.curve(name, points, Stroke::solid(series));
    }
    let label = format!("albedo of points, from {degrees}°");
    let alt = format!("{label}: at most 1 for visible facets; far above 1 for some points by area");
    plot.panel(format!("albedo-{stem}"), label, alt)
}
