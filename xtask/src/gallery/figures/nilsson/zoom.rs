//! The thesis's materials, and bumps of a density, from afar to ten thousand times nearer.

use std::f32::consts::PI;

use asperity_render::{image::tone::hex, integrator::pixels::Sampling};
use asperity_shading::{
    Beckmann, Brdf, BumpField, Carpet, CarpetParameters, CookTorrance, EnergyPreservingOrenNayar, Footprint,
    Frame, Ggx, GlintField, LevelOfDetail, Ndf, Scratches, ScratchesParameters, SurfacePoint, TemperedGlass,
    TemperedGlassParameters, Variations, VariationsParameters, half_vector,
    noise::{GaussianOctaves, Spectrum},
    reflect,
};
use glam::{Vec2, Vec3};

use crate::{
    failure::Failure,
    gallery::figure::{Context, Drawn, Panel},
};

/// Widths of the pictures in metres.
const WIDTHS: [f32; 5] = [4.0, 0.4, 0.04, 0.004, 0.0004];

const NAMES: [&str; 5] = ["4 m", "×10", "×100", "×1000", "×10,000"];

/// Directions to the light and to the eye: 17 degrees apart, so that the half vector is near the normal.
fn light() -> [Vec3; 2] {
    [Vec3::new(-0.34, 0.42, 0.84).normalize(), Vec3::new(0.1, -0.25, 0.96).normalize()]
}

type Radiance = dyn Fn(Vec2, Footprint) -> Vec3 + Sync;

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn, Failure> {
    let surfaces: [(&str, Box<Radiance>); 6] = [
        ("carpet", Box::new(carpet()?)),
        ("paint", Box::new(paint()?)),
        ("scratches", Box::new(scratches()?)),
        ("plastic", Box::new(plastic()?)),
        ("glass", Box::new(glass()?)),
        ("bumps", Box::new(bumps()?)),
    ];
    let side = context.size * 3 / 5;
    let sampling = Sampling { width: side, height: side, ..context.square() };
    let side = sampling.width as f32;
    let mut panels = Vec::new();
    for (name, radiance) in &surfaces {
        for ((k, width), label) in WIDTHS.into_iter().enumerate().zip(NAMES) {
            let pixel = Footprint::from_width(width / side);
            let image = context.render(sampling, |x, y| {
                radiance(CENTRE + Vec2::new(x / side - 0.5, 0.5 - y / side) * width, pixel)
            })?;
            let alt = format!("A patch of {name}, {} mm wide", width * 1000.0);
            let label = if k == 0 { format!("{name}, {label}") } else { label.to_owned() };
            panels.push(Panel::raster(&format!("{name}-{k}"), &label, &alt, image.exposed(1.0)));
        }
    }
    Ok(Drawn::new(5, panels).fact("widths", WIDTHS.map(|width| format!("{width} m")).join(", ")))
}

const CENTRE: Vec2 = Vec2::new(1.371, 0.843);

fn point(p: Vec2, pixel: Footprint) -> SurfacePoint {
    SurfacePoint::new(p.extend(0.0), Vec3::Z, pixel).with_uv(p, [Vec3::X, Vec3::Y])
}

/// The radiance of a reflectance whose surface has this normal.
fn lit(brdf: &dyn Brdf, normal: Vec3) -> Vec3 {
    let [l, v] = light();
    let frame = Frame::from_normal_tangent(normal, Vec3::X);
    let (wi, wo) = (frame.to_local(l), frame.to_local(v));
    PI * brdf.value(wi, wo) * wi.z.max(0.0)
}

/// A density as wide as facets and unresolved slopes together.
fn widened(alpha: f32, variance: f32) -> Beckmann {
    let alpha = (alpha * alpha + 2.0 * variance).sqrt();
    Beckmann::clamped(alpha, alpha)
}

fn carpet() -> Result<impl Fn(Vec2, Footprint) -> Vec3 + Sync, Failure> {
    let carpet = Carpet::new(CarpetParameters {
        diffuse: Vec3::new(0.24, 0.21, 0.19),
        diffuse_thread_strength: 0.17,
        ..Default::default()
    })?;
    Ok(move |p: Vec2, pixel: Footprint| {
        let surface = carpet.surface(&point(p, pixel), light()[1]);
        let Ok(threads) = surface.reflectance() else { return Vec3::ZERO };
        2.4 * (lit(&threads, surface.normal) + 0.5 * surface.specular)
    })
}

fn paint() -> Result<impl Fn(Vec2, Footprint) -> Vec3 + Sync, Failure> {
    let flakes = GlintField::new(Beckmann::new(0.3, 0.3)?, 4e-5, 0.12, 3)?;
    let base = EnergyPreservingOrenNayar::new(Vec3::new(0.02, 0.05, 0.14), 0.2)?;
    let [l, v] = light();
    let h = half_vector(l, v);
    Ok(move |p: Vec2, pixel: Footprint| {
        let colour = Vec3::new(0.35, 0.55, 0.95);
        0.12 * colour * flakes.density(h, p.extend(0.0), pixel) + lit(&base, Vec3::Z)
    })
}

fn scratches() -> Result<impl Fn(Vec2, Footprint) -> Vec3 + Sync, Failure> {
    let scratches = Scratches::new(ScratchesParameters {
        scratch_size: 0.005,
        scratch_width: 0.012,
        scratch_strength: 0.4,
        scratch_cover: 4.0,
        ..Default::default()
    })?;
    // Beside the highlight, where grooves catch the light that the surface mirrors past the eye.
    let h = Vec3::new(0.2, 0.25, 1.0).normalize();
    let metal = widened(0.2, 0.0);
    Ok(move |p: Vec2, pixel: Footprint| {
        let facets = scratches.surface(&point(p, pixel)).facets(Vec3::Z);
        let density = facets.map(|facet| {
            facet.share * metal.density(Frame::from_normal_tangent(facet.normal, Vec3::X).to_local(h))
        });
        hex(0xc8_ccd2) * 0.2 * density.sum::<f32>()
    })
}

fn plastic() -> Result<impl Fn(Vec2, Footprint) -> Vec3 + Sync, Failure> {
    let panel = Variations::new(VariationsParameters {
        diffuse: Vec3::new(0.34, 0.12, 0.06),
        small_blemish_bump_strength: 0.06,
        ..Default::default()
    })?;
    Ok(move |p: Vec2, pixel: Footprint| {
        let surface = panel.surface(&point(p, pixel));
        let Ok(diffuse) = EnergyPreservingOrenNayar::new(surface.diffuse, surface.roughness) else {
            return Vec3::ZERO;
        };
        let coat = CookTorrance::new(widened(0.25, surface.slope_variance), surface.specular);
        0.45 * (lit(&diffuse, surface.normal) + lit(&coat, surface.normal))
    })
}

fn glass() -> Result<impl Fn(Vec2, Footprint) -> Vec3 + Sync, Failure> {
    let glass = TemperedGlass::new(TemperedGlassParameters { wave_amplitude: 6e-4, ..Default::default() })?;
    let [_, v] = light();
    Ok(move |p: Vec2, pixel: Footprint| {
        let surface = glass.surface(&point(p, pixel));
        let lamps = |m: Vec3| {
            // Tubes along x, seen at the distance of a few metres.
            let across = (reflect(v, m).y + 0.06 * p.y) * 55.0;
            let tube = (3.0 * across.sin()).tanh();
            Vec3::new(0.50, 0.56, 0.60) * (0.55 + 0.42 * tube)
        };
        surface.facets(Vec3::Z).fold(Vec3::ZERO, |sum, facet| sum + facet.share * lamps(facet.normal))
    })
}

fn bumps() -> Result<impl Fn(Vec2, Footprint) -> Vec3 + Sync, Failure> {
    let ndf = Ggx::new(0.2, 0.4)?;
    let field = BumpField::new(GaussianOctaves::<3>::new(Spectrum::new(2.17, 0.8, 16)?, 5), 60.0)?;
    let h = Vec3::new(0.14, 0.2, 1.0).normalize();
    Ok(move |p: Vec2, pixel: Footprint| {
        let coordinates = field.coordinates(p.extend(0.0), pixel);
        hex(0xf2_b184) * 0.3 * LevelOfDetail::Exact.radiance(&ndf, h, coordinates)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_and_eye_are_unit() {
        for w in light() {
            assert!((w.length() - 1.0).abs() < 1e-6 && w.z > 0.5);
        }
    }
}
