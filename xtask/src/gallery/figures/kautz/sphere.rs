//! A bump mapped sphere at four zooms beside its density, by both rules of level of detail.

use asperity_ndf_sampling::Ggx;
use asperity_render::integrator::hemisphere::hemisphere;
use asperity_render::materials::Facets;
use asperity_render::scenes::{RenderRequest, Set, peak};
use asperity_shading::LevelOfDetail;
use asperity_shading::ndf_sampling::conditional_density;
use glam::Vec2;

use crate::failure::Failure;
use crate::gallery::figure::{Context, Drawn, Panel};
use crate::gallery::panels::{common_parameters, density_panel, object_panel, rule_words};

const ALPHA: [f32; 2] = [0.18, 0.5];
const ZOOMS: [f32; 4] = [1.0, 4.0, 16.0, 64.0];

/// A facet whose remaining density stands at the left of the second row, and the share of the variance resolved.
const FACET: (Vec2, f32) = (Vec2::new(0.9, -1.1), 0.8);

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn, Failure> {
    let ndf = Ggx::new(ALPHA[0], ALPHA[1])?;
    let shape = RenderRequest::shape(Set::Sphere);
    let mut request = RenderRequest::new(Set::Sphere, &ndf, context.sampling([12, 12], 2));
    let mut panels = Vec::new();
    for rule in [LevelOfDetail::Fractal, LevelOfDetail::Exact] {
        panels.push(match rule {
            LevelOfDetail::Fractal => density_panel(context, &ndf, "GGX 0.18, 0.5")?,
            LevelOfDetail::Exact => remaining(context, &ndf)?,
        });
        request.facets = Facets::Consistent(rule);
        let [name, stem] = rule_words(rule);
        for zoom in ZOOMS {
            request.zoom = zoom;
            let label = format!("{name}, ×{zoom}");
            let alt = format!("The sphere at zoom {zoom} by the rule {name}.");
            let words = [&format!("{stem}-{zoom}") as &str, &label, &alt];
            panels.push(object_panel(context, &request, &shape, words)?);
        }
    }
    let mut parameters = common_parameters(&request);
    parameters[0] = ("density".into(), format!("GGX, α = {}, {}", ALPHA[0], ALPHA[1]));
    Ok(Drawn::new(5, panels).facts(parameters))
}

/// The conditional density below one resolved facet, by the exact rule.
fn remaining(context: &Context<'_>, ndf: &Ggx) -> Result<Panel, Failure> {
    let (z, share) = FACET;
    // Its own peak is 1/(1 − s) times higher; on the scale of the whole density it would be a white spot.
    let top = peak(ndf) / (1.0 - share);
    let image = hemisphere(context.square(), top, context.progress, context.interrupted, |h| {
        conditional_density(ndf, h, z, share)
    })?;
    let alt = "A small part of the density, around the normal of one facet.";
    Ok(Panel::raster("remaining", "what is left of it below one facet", alt, image))
}
