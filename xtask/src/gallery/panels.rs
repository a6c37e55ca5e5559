//! What the figures of rendered objects share: densities as pictures, and pictures as panels.

use asperity_render::{
    geometry::shape::Shape,
    image::Image,
    integrator::{
        direct::{Facets, SharedNdf},
        hemisphere::hemisphere,
        pixels::Sampling,
        request::{RenderRequest, peak},
    },
};
use asperity_shading::LevelOfDetail;

use crate::{
    failure::Failure,
    gallery::{
        figure::{Context, Panel, Picture},
        plot::Plot,
    },
};

/// A square panel of the figure's size.
pub(crate) fn square(context: &Context<'_>) -> Sampling {
    Sampling {
        width: context.size,
        height: context.size,
        samples_per_pixel: context.samples_per_pixel,
        seed: context.seed,
    }
}

/// A square panel that takes half of the page's width, and so half as many pixels again.
pub(crate) fn half_page(context: &Context<'_>) -> Sampling {
    let side = context.size + context.size / 2;
    Sampling { width: side, height: side, ..square(context) }
}

/// A square panel of an object with bumps, which wants twice the samples.
pub(crate) fn fine(context: &Context<'_>) -> Sampling {
    let sampling = square(context);
    Sampling { samples_per_pixel: sampling.samples_per_pixel.saturating_mul(2), ..sampling }
}

/// A picture of pixels with its words.
pub(crate) fn raster(stem: &str, label: &str, alt: &str, image: Image) -> Panel {
    Panel {
        stem: stem.into(),
        label: label.into(),
        alt: alt.into(),
        span: 1,
        picture: Picture::Raster(image),
    }
}

/// The density over the map of normals.
pub(crate) fn density_panel(context: &Context<'_>, ndf: &SharedNdf, name: &str) -> Result<Panel, Failure> {
    let top = peak(ndf);
    let image = hemisphere(square(context), top, context.progress, context.interrupted, |m| ndf.density(m))?;
    let alt = format!("The density {name} over the disk of normals, brightest at its peak.");
    Ok(raster("density", &format!("the NDF: {name}"), &alt, image))
}

/// One picture of an object.
pub(crate) fn object_panel(
    context: &Context<'_>,
    request: &RenderRequest<'_>,
    shape: &Shape,
    words: [&str; 3],
) -> Result<Panel, Failure> {
    let image = request.draw(shape, context.progress, context.interrupted)?;
    let [stem, label, alt] = words;
    Ok(raster(stem, label, alt, image))
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

pub(crate) fn vector(stem: &str, label: &str, alt: &str, plot: &Plot) -> Result<Panel, Failure> {
    Ok(Panel {
        stem: stem.to_owned(),
        label: label.to_owned(),
        alt: alt.to_owned(),
        span: 1,
        picture: Picture::Vector(plot.svg()?),
    })
}

pub(crate) fn fact(name: &str, value: &str) -> (String, String) {
    (name.to_owned(), value.to_owned())
}
