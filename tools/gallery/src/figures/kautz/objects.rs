//! Objects with bumps of a density, at several zooms and with several rules, and the steps of the
//! method.

use std::sync::Arc;

use asperity_ndf_sampling::{Beckmann, BlinnPhong, Ggx, Ndf, NormalLut, gaussian_cdf, residual_ndf};
use asperity_render::image::tone::{hex, linear};
use asperity_render::materials::field::NoiseKind;
use asperity_render::materials::{Facets, SharedNdf, sky};
use asperity_render::scene::{Backdrop, Light, Object, Scene};
use asperity_render::scenes::{RenderRequest, Set, peak};
use asperity_render::{geometry::shape::Shape, image::Image};
use asperity_shading::{LevelOfDetail, SurfacePoint, reflectance::Bsdf};
use glam::{DVec3, Vec2, Vec3};

use crate::figure::{Context, Drawn, Panel};
use crate::panels::{density_panel, disk};
use asperity::failure::Result;

/// Renders an object.
pub(in crate::figures) fn object(
    context: &Context<'_>,
    request: &RenderRequest<'_>,
    shape: &Arc<Shape>,
    [stem, label, alt]: [&str; 3],
) -> Result<Panel> {
    let image = context.draw(&request.scene(shape)?, request.sampling, &request.camera())?.filmic(1.0);
    Ok(Panel::new(stem, label, alt, image))
}

/// Formats a density.
pub(in crate::figures) fn ggx([alpha_x, alpha_y]: [f32; 2]) -> String {
    format!("GGX, α = {alpha_x}, {alpha_y}")
}

/// Adds the rule of an image.
fn ruled(drawn: Drawn, request: &RenderRequest<'_>) -> Drawn {
    let rule = match request.facets {
        Facets::Consistent(rule) => format!("{rule:?}"),
        Facets::Table(_) => "table L, whole density".to_owned(),
    };
    described(drawn.fact("rule", rule), request)
}

/// Adds the parameters common to all images.
fn described(drawn: Drawn, request: &RenderRequest<'_>) -> Drawn {
    let bumps = request.bumps;
    let noise =
        format!("{:?}, first octave {} cells per unit, gain {}", bumps.kind, bumps.frequency, bumps.gain);
    drawn.fact("noise", noise).fact("samples per pixel", request.sampling.samples_per_pixel)
}

/// A sphere at four zooms next to its density, with both level-of-detail rules.
pub(crate) fn draw_sphere(context: &Context<'_>) -> Result<Drawn> {
    const ALPHA: [f32; 2] = [0.18, 0.5];
    const ZOOMS: [f32; 4] = [1.0, 4.0, 16.0, 64.0];
    let ndf = Ggx::new(ALPHA[0], ALPHA[1])?;
    let shape = RenderRequest::shape(Set::Sphere);
    let mut request = RenderRequest::new(Set::Sphere, &ndf, context.sampling([12, 12], 2));
    let mut panels = Vec::new();
    for rule in [LevelOfDetail::Fractal, LevelOfDetail::Exact] {
        panels.push(match rule {
            LevelOfDetail::Fractal => density_panel(context, &ndf, "density", "GGX 0.18, 0.5")?,
            LevelOfDetail::Exact => remaining(context, &ndf)?,
        });
        request.facets = Facets::Consistent(rule);
        let name = format!("{rule:?}");
        let stem = name.to_lowercase();
        for zoom in ZOOMS {
            request.zoom = zoom;
            let (label, alt) =
                (format!("{name}, ×{zoom}"), format!("The sphere at zoom {zoom} with the rule {name}."));
            panels.push(object(context, &request, &shape, [&format!("{stem}-{zoom}"), &label, &alt])?);
        }
    }
    Ok(described(Drawn::new(5, panels).fact("density", ggx(ALPHA)), &request))
}

/// The conditional density below one resolved facet, with the exact rule.
fn remaining(context: &Context<'_>, ndf: &Ggx) -> Result<Panel> {
    /// The facet, and the resolved fraction of the variance.
    const FACET: (Vec2, f32) = (Vec2::new(0.9, -1.1), 0.8);
    let (z, share) = FACET;
    // Its peak is 1/(1 − s) times higher. On the scale of the whole density it would be a white
    // spot.
    let image = disk(context, peak(|m| ndf.d(m)) / (1.0 - share), |h| residual_ndf(ndf, h, z, share))?;
    let alt = "A small part of the density, around the normal of one facet.";
    Ok(Panel::new("remaining", "the remaining density below one facet", alt, image))
}

/// The steps of the method: noise, lookup, shading.
pub(crate) fn draw_pipeline(context: &Context<'_>) -> Result<Drawn> {
    const ALPHA: [f32; 2] = [0.22, 0.44];
    let ndf = Ggx::new(ALPHA[0], ALPHA[1])?;
    let table = NormalLut::standard(&ndf);
    let shape = RenderRequest::shape(Set::Teapot);
    let mut request = RenderRequest::new(Set::Teapot, &ndf, context.sampling([12, 12], 2));
    request.facets = Facets::Table(&table);
    request.bumps.kind = NoiseKind::Channels;
    request.bumps.frequency = 4.0;
    request.exposure *= 1.5;
    let noise = step(context, &request, &shape, pair_color)?;
    // Encoded like normal maps, in sRGB: (x, y, z) from ±1 to 0 … 255.
    let normal = |z| table.bilinear(z).normal.map(|c| linear(0.5 + 0.5 * c));
    let normals = step(context, &request, &shape, normal)?;
    let square = Image::from_fn(context.size, context.size, |x, y| {
        let place = |k: u32| 9.0 * (k as f32 + 0.5) / context.size as f32 - 4.5;
        normal(Vec2::new(place(x), -place(y)))
    });
    let deviations = "the table L, over ±4.5 standard deviations";
    let alt = "A square of smoothly changing normals; the flat normal in its center.";
    let words = ["shaded", "shaded with the density", "The teapot as embossed copper."];
    let panels = vec![
        Panel::new("noise", "two channels of noise", "The teapot, mottled in four hues.", noise),
        Panel::new("table", deviations, alt, square),
        Panel::new("normals", "the normals from L", "The teapot, colored by its bump normals.", normals),
        object(context, &request, &shape, words)?,
    ];
    Ok(ruled(Drawn::new(4, panels).fact("density", ggx(ALPHA)), &request))
}

/// Renders the object with each point colored by its noise pair.
fn step(
    context: &Context<'_>,
    request: &RenderRequest<'_>,
    shape: &Arc<Shape>,
    color: impl Fn(Vec2) -> Vec3 + Sync,
) -> Result<Image> {
    let bumps = request.bumps.field(context.seed, DVec3::ZERO)?;
    let colors = |point: &SurfacePoint, wo: Vec3| {
        let coordinates = bumps.coordinates(point.position, &point.frame(), point.footprint());
        // Some sky light keeps the shape readable.
        let light = 0.35 + 0.65 * sky(point.normal);
        Bsdf::new(point.frame(), wo).with_emitted(color(coordinates.z * coordinates.blend) * light)
    };
    let objects = vec![Object::shaded(Arc::clone(shape), colors)];
    let scene = Scene::new(objects, Light::lamps(Vec::new()), Backdrop::Studio);
    Ok(context.draw(&scene, request.sampling, &request.camera())?.exposed(1.0))
}

/// Maps a pair of Gaussian numbers to uniform numbers, and interpolates four colors at the corners
/// of the unit square.
fn pair_color(z: Vec2) -> Vec3 {
    let (u, v) = (gaussian_cdf(f64::from(z.x)) as f32, gaussian_cdf(f64::from(z.y)) as f32);
    let low = hex(0x1f_4e79).lerp(hex(0xe8_6a4a), u);
    low.lerp(hex(0x2f_9e8f).lerp(hex(0xf8_e3a1), u), v)
}

/// The teapot with an anisotropic density at three distances, and with normals of another
/// distribution.
pub(crate) fn draw_teapot(context: &Context<'_>) -> Result<Drawn> {
    const ALPHA: [f32; 2] = [0.14, 0.56];
    const ZOOMS: [(f32, &str); 3] = [(1.0, "far"), (3.0, "three times closer"), (9.0, "nine times closer")];
    let ndf = Ggx::new(ALPHA[0], ALPHA[1])?;
    let shape = RenderRequest::shape(Set::Teapot);
    let mut request = RenderRequest::new(Set::Teapot, &ndf, context.sampling([12, 12], 2));
    // So fine that the view of the whole pot resolves almost nothing.
    request.bumps.frequency = 27.0;
    let mut panels = vec![density_panel(context, &ndf, "density", "GGX 0.14, 0.56")?];
    for (zoom, label) in ZOOMS {
        request.zoom = zoom;
        let alt = format!("The teapot, {label}: a highlight along its profile that breaks up into bumps.");
        panels.push(object(context, &request, &shape, [&format!("zoom-{zoom}"), label, &alt])?);
    }
    let uniform = NormalLut::standard(&BlinnPhong::new(0.0)?);
    let mut strange = request;
    (strange.facets, strange.zoom) = (Facets::Table(&uniform), ZOOMS[1].0);
    let alt = "The same view with bumps from uniform normals: a grainy surface without a highlight.";
    let words = ["uniform", "three times closer, uniform normals", alt];
    panels.push(object(context, &strange, &shape, words)?);
    Ok(ruled(Drawn::new(5, panels).fact("density", ggx(ALPHA)), &request))
}

/// Two isotropic densities on the teapot.
pub(crate) fn draw_isotropic(context: &Context<'_>) -> Result<Drawn> {
    let shape = RenderRequest::shape(Set::Teapot);
    let (narrow, wide) = (Beckmann::isotropic(0.22)?, Ggx::isotropic(0.36)?);
    let looks: [(&str, &str, &SharedNdf, u32); 2] =
        [("beckmann", "Beckmann 0.22", &narrow, 0xe6_e8ec), ("ggx", "GGX 0.36", &wide, 0xe0_a36a)];
    // Twice as large as a square panel.
    let mut request = RenderRequest::new(Set::Teapot, &narrow, context.sampling([24, 18], 2));
    request.zoom = 1.2;
    request.bumps.frequency = 9.0;
    let mut panels = Vec::new();
    for (stem, name, ndf, tint) in looks {
        (request.ndf, request.tint) = (ndf, hex(tint));
        panels.push(density_panel(context, ndf, &format!("density-{stem}"), name)?);
        let alt = format!("The teapot with bumps and highlights of the density {name}.");
        let teapot = object(context, &request, &shape, [&format!("teapot-{stem}"), name, &alt])?;
        panels.push(Panel { span: 2, ..teapot });
    }
    let densities = looks.map(|look| look.1).join("; ");
    Ok(ruled(Drawn::new(6, panels).fact("densities", densities), &request))
}
