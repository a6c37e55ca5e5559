//! The thesis's materials, and bumps of a density, from afar to ten thousand times nearer.

use std::f32::consts::PI;

use asperity_render::{image::tone::hex, integrator::pixels::Sampling, sampling::low_discrepancy::r2};
use asperity_shading::material::{BumpMapped, Material, PaintFlakes};
use asperity_shading::noise::{Gaussian, GaussianOctaves, Spectrum};
use asperity_shading::{
    BumpField, Carpet, CarpetParameters, Footprint, Ggx, LevelOfDetail, MetallicPaint,
    MetallicPaintParameters, Scratches, ScratchesParameters, SurfacePoint, TemperedGlass,
    TemperedGlassParameters, Variations, VariationsParameters, reflect,
};
use glam::{Vec2, Vec3};

use crate::failure::Result;
use crate::gallery::figure::{Context, Drawn};

/// Widths of the pictures in metres, and their labels.
const WIDTHS: [(f32, &str); 5] =
    [(4.0, "4 m"), (0.4, "×10"), (0.04, "×100"), (0.004, "×1000"), (0.0004, "×10,000")];

/// The middle of every picture.
const CENTRE: Vec2 = Vec2::new(1.371, 0.843);

/// Cells of the bumps in a metre.
const CELLS: f32 = 60.0;

/// A material with its exposure and the half vector of the eye and its lamp.
struct Surface {
    name: &'static str,
    exposure: f32,
    half: Vec3,
    /// The place that its material is told positions from.
    anchor: Vec2,
    material: Box<dyn Material + Sync>,
}

/// The direction to the eye.
fn eye() -> Vec3 {
    Vec3::new(0.1, -0.25, 0.96).normalize()
}

fn surfaces() -> Result<[Surface; 6]> {
    let surface = |name, exposure, [x, y]: [f32; 2], material| Surface {
        name,
        exposure,
        half: Vec3::new(x, y, 1.0).normalize(),
        anchor: Vec2::ZERO,
        material,
    };
    let carpet = Carpet::new(CarpetParameters {
        diffuse: Vec3::new(0.24, 0.21, 0.19),
        diffuse_thread_strength: 0.17,
        ..Default::default()
    })?;
    let paint = MetallicPaint::new(MetallicPaintParameters {
        specular: 0.16 * Vec3::new(0.35, 0.55, 0.95),
        pigment: Vec3::new(0.02, 0.05, 0.14),
        flakes: PaintFlakes::Counted { spacing: 4e-5, bin: 0.12 },
        flake_roughness: 0.3,
        passive_flake_strength: 0.0,
        coat_index: 1.0,
        seed: 3,
        ..Default::default()
    })?;
    let scratches = Scratches::new(ScratchesParameters {
        scratch_size: 0.005,
        scratch_width: 0.012,
        scratch_strength: 0.4,
        scratch_cover: 4.0,
        specular: hex(0xc8_ccd2),
        roughness: 0.2,
        ..Default::default()
    })?;
    let plastic = Variations::new(VariationsParameters {
        diffuse: Vec3::new(0.34, 0.12, 0.06),
        small_blemish_bump_strength: 0.06,
        gloss_roughness: 0.25,
        ..Default::default()
    })?;
    let glass = TemperedGlass::new(TemperedGlassParameters { wave_amplitude: 6e-4, ..Default::default() })?;
    let noise = GaussianOctaves::<3>::new(Gaussian::new(5), Spectrum::new(2.17, 0.8, 16)?);
    // Octaves so fine that f32 has no digits left for them at the middle.
    let noise = noise.anchored(CENTRE.extend(0.0).as_dvec3() * f64::from(CELLS));
    let (ndf, bumps, rule) = (Ggx::new(0.2, 0.4)?, BumpField::new(noise, CELLS)?, LevelOfDetail::Exact);
    let bumps = BumpMapped { ndf, bumps, rule, colour: hex(0xf2_b184) };
    // Of all but scratches the lamp is near the highlight; they catch the light that the surface mirrors past the eye.
    Ok([
        surface("carpet", 2.4, [-0.134, 0.094], Box::new(carpet)),
        surface("paint", 1.0, [-0.134, 0.094], Box::new(paint)),
        surface("scratches", 0.26, [0.2, 0.25], Box::new(scratches)),
        surface("plastic", 0.45, [-0.134, 0.094], Box::new(plastic)),
        surface("glass", 14.0, [0.0, 0.0], Box::new(glass)),
        Surface { anchor: CENTRE, ..surface("bumps", 0.38, [0.14, 0.2], Box::new(bumps)) },
    ])
}

impl Surface {
    /// Light of the one lamp, and of tubes that a smooth surface mirrors, so far from the middle.
    fn radiance(&self, from: Vec2, pixel: Footprint) -> Vec3 {
        const DIRECTIONS: u32 = 4;
        let (wo, wi) = (eye(), reflect(eye(), self.half));
        let p = CENTRE + from;
        let position = (from + (CENTRE - self.anchor)).extend(0.0);
        let point = SurfacePoint::new(position, Vec3::Z, pixel).with_uv(p, [Vec3::X, Vec3::Y]);
        let bsdf = self.material.bsdf(&point, wo);
        let deltas = (0..DIRECTIONS).flat_map(|k| bsdf.deltas(wo, Vec2::from(r2(k).map(|u| u as f32))));
        let mirrored = deltas.filter(|delta| delta.wi.z > 0.0).fold(Vec3::ZERO, |sum, delta| {
            // Tubes along x, seen at the distance of a few metres.
            let tube = (3.0 * ((delta.wi.y + 0.06 * p.y) * 55.0).sin()).tanh();
            sum + delta.weight * Vec3::new(0.50, 0.56, 0.60) * (0.55 + 0.42 * tube)
        });
        self.exposure * (PI * bsdf.scattered(wi, wo) + bsdf.emitted() + mirrored / DIRECTIONS as f32)
    }
}

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn> {
    let side = context.size * 3 / 5;
    let sampling = Sampling { width: side, height: side, ..context.square() };
    let side = side as f32;
    let surfaces = surfaces()?;
    let pictures = surfaces.iter().flat_map(|surface| {
        WIDTHS.into_iter().zip(0..).map(move |((width, label), k)| {
            let name = surface.name;
            let label = if k == 0 { format!("{name}, {label}") } else { label.to_owned() };
            let alt = format!("A patch of {name}, {} mm wide", width * 1000.0);
            ([format!("{name}-{k}"), label, alt], (surface, width))
        })
    });
    let drawn = Drawn::pictures(5, pictures, |(surface, width)| {
        let pixel = Footprint::from_width(width / side);
        let image = context.render(sampling, |x, y| {
            surface.radiance(Vec2::new(x / side - 0.5, 0.5 - y / side) * width, pixel)
        })?;
        Ok(image.exposed(1.0))
    })?;
    Ok(drawn.fact("widths", WIDTHS.map(|(width, _)| format!("{width} m")).join(", ")))
}
