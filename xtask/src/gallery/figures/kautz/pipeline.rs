//! The steps of the method: noise, look-up, shading.

use std::sync::Arc;

use asperity_ndf_sampling::{Ggx, NormalTable, phi};
use asperity_render::geometry::shape::Shape;
use asperity_render::image::Image;
use asperity_render::image::tone::hex;
use asperity_render::materials::{Facets, sky};
use asperity_render::scene::{Backdrop, Light, Object, Scene};
use asperity_render::scenes::{RenderRequest, Set};
use asperity_shading::{SurfacePoint, reflectance::Bsdf};
use glam::{Vec2, Vec3};

use crate::failure::Failure;
use crate::gallery::figure::{Context, Drawn, Panel};
use crate::gallery::panels::{common_parameters, object_panel};

const ALPHA: [f32; 2] = [0.22, 0.44];

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn, Failure> {
    let ndf = Ggx::new(ALPHA[0], ALPHA[1])?;
    let table = NormalTable::standard(&ndf);
    let shape = RenderRequest::shape(Set::Teapot);
    let mut request = RenderRequest::new(Set::Teapot, &ndf, context.sampling([12, 12], 2));
    request.facets = Facets::Table(&table);
    request.bumps.frequency = 4.0;
    request.exposure *= 1.5;
    let noise = steps(context, &request, &shape, &table, |z, _| pair_colour(z))?;
    let normals = steps(context, &request, &shape, &table, |_, m| normal_colour(m))?;
    let panels = vec![
        Panel::raster("noise", "two channels of noise", "The teapot, mottled in four hues.", noise),
        Panel::raster(
            "table",
            "the table L, over ±4.5 standard deviations",
            "A square of smoothly changing normals; the flat normal in its centre.",
            Image::from_fn(context.size, context.size, |x, y| {
                let place = |k: u32| 9.0 * (k as f32 + 0.5) / context.size as f32 - 4.5;
                normal_colour(table.bilinear(Vec2::new(place(x), -place(y))).normal)
            }),
        ),
        Panel::raster(
            "normals",
            "the normals that L gives",
            "The teapot, coloured by its bump normals.",
            normals,
        ),
        object_panel(
            context,
            &request,
            &shape,
            ["shaded", "shaded with the density", "The teapot as embossed copper."],
        )?,
    ];
    let mut parameters = common_parameters(&request);
    parameters.insert(0, ("density".into(), format!("GGX, α = {}, {}", ALPHA[0], ALPHA[1])));
    Ok(Drawn::new(4, panels).facts(parameters))
}

/// The object with each point in the colour of its noise pair or its normal in the surface's frame.
fn steps(
    context: &Context<'_>,
    request: &RenderRequest<'_>,
    shape: &Arc<Shape>,
    table: &NormalTable,
    colour: impl Fn(Vec2, Vec3) -> Vec3 + Sync,
) -> Result<Image, Failure> {
    let bumps = request.bumps.field(context.seed)?;
    let colours = |point: &SurfacePoint, wo: Vec3| {
        let coordinates = bumps.coordinates(point.position, point.footprint());
        let z = coordinates.z * coordinates.fade;
        // Some light from the sky, so that the shape stays readable.
        let glow = colour(z, table.bilinear(z).normal) * (0.35 + 0.65 * sky(point.normal));
        Bsdf::new(wo).with_emitted(glow)
    };
    let objects = vec![Object::shaded(Arc::clone(shape), colours)];
    let scene = Scene::new(objects, Light::lamps(Vec::new()), Backdrop::Studio);
    Ok(context.draw(&scene, request.sampling, &request.camera())?.exposed(1.0))
}

/// A pair of Gaussian numbers, made uniform, between four colours at the corners of the unit square.
fn pair_colour(z: Vec2) -> Vec3 {
    let (u, v) = (phi(f64::from(z.x)) as f32, phi(f64::from(z.y)) as f32);
    let low = hex(0x1f_4e79).lerp(hex(0xe8_6a4a), u);
    let high = hex(0x2f_9e8f).lerp(hex(0xf8_e3a1), u);
    low.lerp(high, v)
}

/// A normal as the colour that normal maps have, in sRGB: (x, y, z) from ±1 to 0 … 255.
fn normal_colour(m: Vec3) -> Vec3 {
    let byte = |c: f32| asperity_render::image::tone::linear(0.5 + 0.5 * c);
    Vec3::new(byte(m.x), byte(m.y), byte(m.z))
}
