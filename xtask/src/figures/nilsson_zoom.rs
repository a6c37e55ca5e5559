//! The thesis's materials from afar to very near, with their mean radiance.

use std::f32::consts::PI;

use asperity_shading::{
    Beckmann, Brdf, Carpet, CarpetParameters, CookTorrance, EnergyPreservingOrenNayar, Footprint, Frame,
    GlintField, Ndf, Scratches, ScratchesParameters, SurfacePoint, Variations, VariationsParameters,
    half_vector,
};
use glam::{Vec2, Vec3};

use super::panels::raster;
use crate::{
    figure::{Context, Drawn, Failure, Figure, Table},
    image::hex,
    scene::render::{Sampling, render},
};

pub(crate) const ZOOM: Figure = Figure {
    name: "nilsson-zoom",
    title: "Carpet, paint, scratched metal and plastic, from 4 metres wide to 1 millimetre",
    source: "Nilsson 2008, chapters 4 and 6",
    caption: "Each row is one surface in one light, twenty times nearer from picture to picture. The carpet has seams, dark \
              areas and threads, and from very near fibres, where the thesis's noise no longer looked like threads; the \
              flakes of the paint part into single ones, counted by hashes; scratches and blemishes come up. What a pixel \
              does not resolve goes into its roughness: the table has the mean radiance over the whole surface, seen with \
              the pixels of each picture, over that of the first.",
    draw,
};

/// Widths of the pictures in metres.
const WIDTHS: [f32; 4] = [4.0, 0.2, 0.01, 0.0008];

const NAMES: [&str; 4] = ["4 m", "20 cm", "1 cm", "0.8 mm"];

/// Directions to the light and to the eye: 17 degrees apart, so that the half vector is near the normal.
fn light() -> [Vec3; 2] {
    [Vec3::new(-0.34, 0.42, 0.84).normalize(), Vec3::new(0.1, -0.25, 0.96).normalize()]
}

type Radiance = dyn Fn(Vec2, Footprint) -> Vec3 + Sync;

fn draw(context: &Context<'_>) -> Result<Drawn, Failure> {
    let surfaces: [(&str, Box<Radiance>); 4] = [
        ("carpet", Box::new(carpet()?)),
        ("paint", Box::new(paint()?)),
        ("scratches", Box::new(scratches()?)),
        ("plastic", Box::new(plastic()?)),
    ];
    let sampling = Sampling {
        width: context.size * 3 / 4,
        height: context.size * 3 / 4,
        samples_per_pixel: context.samples_per_pixel,
        seed: context.seed,
    };
    let side = sampling.width as f32;
    let (mut panels, mut rows) = (Vec::new(), Vec::new());
    for (name, radiance) in &surfaces {
        let mut row = vec![(*name).to_owned()];
        let mut first = 0.0;
        for (width, label) in WIDTHS.into_iter().zip(NAMES) {
            let pixel = Footprint::from_width(width / side);
            let image = render(sampling, context.progress, context.interrupted, |x, y| {
                radiance(CENTRE + Vec2::new(x / side - 0.5, 0.5 - y / side) * width, pixel)
            })?;
            let alt = format!("A patch of {name}, {label} wide");
            panels.push(raster(
                &format!("{name}-{}", label.replace([' ', '.'], "")),
                label,
                &alt,
                image.exposed(1.0),
            ));
            let mean = mean(radiance, pixel);
            if first == 0.0 {
                first = mean;
            }
            row.push(format!("{:.4}", mean / first));
        }
        rows.push(row);
    }
    let head = std::iter::once("mean radiance").chain(NAMES).map(str::to_owned).collect();
    Ok(Drawn {
        panels,
        columns: 4,
        parameters: vec![("points of each mean".to_owned(), POINTS.to_string())],
        table: Some(Table { head, rows }),
    })
}

const CENTRE: Vec2 = Vec2::new(1.371, 0.843);

const POINTS: u32 = 400_000;

/// The mean luminance over 16 m of the surface, at points of the R₂ sequence.
fn mean(radiance: &Radiance, pixel: Footprint) -> f32 {
    let sum = (0..POINTS).fold(0.0_f64, |sum, k| {
        let k = f64::from(k);
        let p = Vec2::new((0.754_877_666 * k).fract() as f32, (0.569_840_291 * k).fract() as f32);
        sum + f64::from(radiance(4.0 * p, pixel).dot(Vec3::new(0.2126, 0.7152, 0.0722)))
    });
    (sum / f64::from(POINTS)) as f32
}

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
        let density = facets.map(|(share, normal)| {
            share * metal.density(Frame::from_normal_tangent(normal, Vec3::X).to_local(h))
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
