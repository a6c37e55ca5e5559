//! Panels of rendered objects and of densities over the disk of normals.

use std::sync::Arc;

use asperity_render::geometry::shape::Shape;
use asperity_render::image::Image;
use asperity_render::integrator::hemisphere::hemisphere;
use asperity_render::materials::{Facets, SharedNdf};
use asperity_render::scenes::{RenderRequest, peak};
use asperity_shading::LevelOfDetail;
use glam::Vec3;

use crate::failure::Failure;
use crate::gallery::figure::{Context, Panel};

/// A function over the disk of normals, in colours up to its peak.
pub(crate) fn disk(
    context: &Context<'_>,
    peak: f32,
    value: impl Fn(Vec3) -> f32 + Sync,
) -> Result<Image, Failure> {
    hemisphere(context.square(), peak, context.progress, context.interrupted, value)
}

/// The density over the map of normals.
pub(crate) fn density_panel(context: &Context<'_>, ndf: &SharedNdf, name: &str) -> Result<Panel, Failure> {
    let image = disk(context, peak(ndf), |m| ndf.density(m))?;
    let alt = format!("The density {name} over the disk of normals, brightest at its peak.");
    Ok(Panel::raster("density", format!("the NDF: {name}"), alt, image))
}

/// One picture of an object.
pub(crate) fn object_panel(
    context: &Context<'_>,
    request: &RenderRequest<'_>,
    shape: &Arc<Shape>,
    words: [&str; 3],
) -> Result<Panel, Failure> {
    let image = context.draw(&request.scene(shape)?, request.sampling, &request.camera())?.exposed(1.0);
    let [stem, label, alt] = words;
    Ok(Panel::raster(stem, label, alt, image))
}

/// The rule's name in a sentence and in a file name.
pub(crate) fn rule_words(rule: LevelOfDetail) -> [&'static str; 2] {
    match rule {
        LevelOfDetail::Exact => ["Exact", "exact"],
        LevelOfDetail::Fractal => ["Fractal", "fractal"],
    }
}

/// Parameters that every rendered object has.
pub(crate) fn common_parameters(request: &RenderRequest<'_>) -> Vec<(String, String)> {
    let bumps = request.bumps;
    let rule = match request.facets {
        Facets::Consistent(rule) => rule_words(rule)[0],
        Facets::Table(_) => "table L, whole density",
    };
    [
        ("rule", rule.to_owned()),
        (
            "noise",
            format!("{:?}, first octave {} cells per unit, gain {}", bumps.kind, bumps.frequency, bumps.gain),
        ),
        ("samples per pixel", request.sampling.samples_per_pixel.to_string()),
    ]
    .map(|(name, value)| (name.to_owned(), value))
    .to_vec()
}
