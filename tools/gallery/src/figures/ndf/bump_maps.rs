//! Existing normal maps: added detail that preserves their density, and bump maps from their
//! estimated density.

use std::f32::consts::PI;

use asperity_ndf_sampling::normal_map::NormalMapFormat;
use asperity_ndf_sampling::{Ggx, Ndf, NdfEstimator, NdfMap, add_detail_normal, estimate_ndf};
use asperity_noise::{FbmSpectrum, GaussianFbm, GaussianNoise};
use asperity_render::image::tone::{hex, linear};
use asperity_render::{image::Image, light::lamps::direction, materials::chalk, materials::cobbles::cobbles};
use asperity_shading::Frame;
use asperity_shading::{Brdf, CookTorrance, bump::Facet, reflectance::Lobe};
use glam::{Vec2, Vec3};
use rayon::prelude::*;

use crate::figure::{Context, Drawn, Panel};
use crate::panels::density_panel;
use crate::plot::{Axis, Names, Plot, Stroke};
use asperity::failure::Result;

/// Texels along a side of the normal map.
const SIZE: usize = 256;
/// Strength of the noise with all octaves resolved.
const AMOUNT: f32 = 0.35;
const ZOOMS: [f32; 3] = [1.0, 4.0, 16.0];
/// Lattice cells of the first octave of detail per texel.
const CELLS_PER_TEXEL: f32 = 0.35;
const LACUNARITY: f32 = 2.17;

/// An 8-bit normal map and its density.
struct NormalMap {
    normals: Vec<Vec3>,
    ndf: NdfMap,
}

impl NormalMap {
    fn cobbles() -> Result<Self> {
        let format = NormalMapFormat::default();
        let normals: Vec<_> =
            cobbles(SIZE).into_iter().map(|n| format.decode_u8(format.encode_u8(n))).collect();
        let ndf = estimate_ndf(&normals)?;
        Ok(Self { normals, ndf })
    }

    /// Returns the blended normal at a point of the unit square, periodic.
    fn at(&self, p: Vec2) -> Vec3 {
        let place = p * SIZE as f32 - Vec2::splat(0.5);
        let (cell, t) = (place.floor(), place - place.floor());
        let texel = |i: i32, j: i32| {
            let wrap = |k: i32| k.rem_euclid(SIZE as i32) as usize;
            self.normals[wrap(cell.y as i32 + j) * SIZE + wrap(cell.x as i32 + i)]
        };
        let across = |j: i32| texel(0, j).lerp(texel(1, j), t.x);
        across(0).lerp(across(1), t.y).normalize_or(Vec3::Z)
    }
}

pub(crate) fn draw_detail(context: &Context<'_>) -> Result<Drawn> {
    let map = NormalMap::cobbles()?;
    let noise =
        GaussianFbm::<Vec2>::new(GaussianNoise::new(context.seed), FbmSpectrum::new(LACUNARITY, 0.8, 8)?);
    let pictures = [("plain", "original"), ("detail", "with detail")].into_iter().flat_map(|(stem, word)| {
        ZOOMS.map(|zoom| {
            let alt = format!("Worn cobbles at a magnification of {zoom}, {word}.");
            ([format!("{stem}-{zoom}"), format!("×{zoom}, {word}"), alt], (stem == "detail", zoom))
        })
    });
    let drawn = Drawn::pictures(3, pictures, |(with_detail, zoom)| {
        let side = 1.0 / zoom;
        let pixel = side / context.size as f32;
        // An octave is resolved when its cells are two pixels wide.
        let cells = CELLS_PER_TEXEL * SIZE as f32;
        let octaves = (0.5 / (pixel * cells)).ln() / LACUNARITY.ln() + 1.0;
        let amount = AMOUNT * noise.spectrum().resolved_variance(octaves.max(0.0)).sqrt();
        let corner = Vec2::new(0.437, 0.552) - Vec2::splat(0.5 * side);
        context.render(context.square(), |x, y| {
            let p = corner + Vec2::new(x, context.size as f32 - y) * pixel;
            let n = map.at(p);
            if with_detail && octaves > 0.0 {
                let [a, b] = noise.pair_with_octaves(p * cells, octaves);
                lit(add_detail_normal(&map.ndf, n, Vec2::new(a.value, b.value), amount))
            } else {
                lit(n)
            }
        })
    })?;
    Ok(drawn
        .fact("normal map", "256 × 256, 8 bits, OpenGL")
        .fact("amount ε", AMOUNT)
        .fact("first octave", format!("{CELLS_PER_TEXEL} cells per texel")))
}

/// Shades a normal under one lamp and a sky, seen from above: matte with a faint gloss.
fn lit(n: Vec3) -> Vec3 {
    let (lamp, color) = (direction(135.0, 42.0), hex(0xb0_9a84));
    let gloss = CookTorrance::new(Ggx::new_clamped(0.3, 0.3), Vec3::splat(0.045));
    let surface = chalk(Frame::IDENTITY, Vec3::Z, n, color, 0.16 * color)
        .with([Facet::new(1.0, n)], [Lobe::from(&gloss as &dyn Brdf)]);
    surface.emitted() + 0.95 * PI * surface.eval_cos(Vec3::Z, lamp)
}

pub(crate) fn draw_estimate(context: &Context<'_>) -> Result<Drawn> {
    let map = NormalMap::cobbles()?;
    let noise =
        GaussianFbm::<Vec2>::new(GaussianNoise::new(context.seed), FbmSpectrum::new(LACUNARITY, 0.6, 6)?);
    let cells = 24.0 / SIZE as f32;
    let normal = |k: usize| {
        let p = Vec2::new((k % SIZE) as f32 + 0.5, (k / SIZE) as f32 + 0.5) * cells;
        map.ndf.warp_gaussian(Vec2::from(noise.pair_with_octaves(p, 6.0).map(|channel| channel.value)))
    };
    let again: Vec<Vec3> = (0..SIZE * SIZE).into_par_iter().map(normal).collect();
    let ndf_again = estimate_ndf(&again)?;
    let panels = vec![
        texels("map", "the normal map", &map.normals),
        density_panel(context, &map.ndf, "density-map", "of the map")?,
        texels("again", "a bump map from the density alone", &again),
        density_panel(context, &ndf_again, "density-again", "of the new bump map")?,
        cuts(&map.ndf, &ndf_again)?,
    ];
    let kernel = NdfEstimator::suited(&map.normals);
    let row = |name: &str, normals: &[Vec3]| {
        let mean_of =
            |f: &dyn Fn(Vec3) -> f32| normals.iter().map(|n| f(*n)).sum::<f32>() / normals.len() as f32;
        let deviation = |axis: Vec3| {
            let mean = mean_of(&|n| n.dot(axis));
            mean_of(&|n| (n.dot(axis) - mean).powi(2)).sqrt()
        };
        let [x, y, z] =
            [deviation(Vec3::X), deviation(Vec3::Y), mean_of(&|n| n.z)].map(|x| format!("{x:.3}"));
        [name.to_owned(), x, y, z]
    };
    let rows = [row("the normal map", &map.normals), row("from the density alone", &again)];
    Ok(Drawn::new(5, panels)
        .fact("estimate", format!("{0} × {0} texels", kernel.size()))
        .fact("kernel", format!("quadratic B-spline, width {:.3}", kernel.width()))
        .fact("total variation", format!("{:.3}", variation(&map.normals, &again)))
        .table(["", "deviation of n_x", "deviation of n_y", "mean of n_z"], rows))
}

/// Displays normals as the colors of a normal map.
fn texels(stem: &str, label: &str, normals: &[Vec3]) -> Panel {
    let format = NormalMapFormat::default();
    let image = Image::from_fn(SIZE as u32, SIZE as u32, |x, y| {
        // The first row of the map is the lowest row of the image.
        let n = normals[(SIZE - 1 - y as usize) * SIZE + x as usize];
        Vec3::from(format.encode_u8(n).map(|byte| linear(f32::from(byte) / 255.0)))
    });
    Panel::new(stem, label, "A normal map in its usual blue and violet colors.", image)
}

/// Plots the densities of two bump maps along both axes.
fn cuts(first: &NdfMap, second: &NdfMap) -> Result<Panel> {
    let top = f64::from(first.d(Vec3::Z).max(second.d(Vec3::Z)));
    let curve = |ndf: &NdfMap, axis: Vec3| -> Vec<[f64; 2]> {
        let places = (-200..=200).map(|k| k as f32 / 200.0 * 0.99);
        let density = |x: f32| ndf.d(axis * x + Vec3::Z * (1.0 - x * x).sqrt());
        places.map(|x| [x, density(x)].map(f64::from)).collect()
    };
    let x = Axis::linear("n_x, n_y", [-1.0, 1.0], 0.5);
    let y = Axis::linear("sr⁻¹", [0.0, (top * 1.1).ceil()], (top / 4.0).ceil());
    let alt = "The densities of the normal map and of the new bump map along both axes";
    Plot::new([330.0, 330.0], x, y, Names::Above)
        .curve("map, x", curve(first, Vec3::X), Stroke::solid(1).wide(2.0))
        .curve("new, x", curve(second, Vec3::X), Stroke::dashed(1).wide(1.0))
        .curve("map, y", curve(first, Vec3::Y), Stroke::solid(2).wide(2.0))
        .curve("new, y", curve(second, Vec3::Y), Stroke::dashed(2).wide(1.0))
        .panel("cuts", "both densities along x and y", alt)
}

/// Returns the total variation between two sets of normals in 32 × 32 bins.
fn variation(first: &[Vec3], second: &[Vec3]) -> f64 {
    const BINS: usize = 32;
    let shares = |normals: &[Vec3]| {
        let mut shares = vec![0.0_f64; BINS * BINS];
        let place = |n: f32| (((n * 0.5 + 0.5) * BINS as f32) as usize).min(BINS - 1);
        for n in normals {
            shares[place(n.y) * BINS + place(n.x)] += 1.0 / normals.len() as f64;
        }
        shares
    };
    let pairs = shares(first).into_iter().zip(shares(second));
    0.5 * pairs.map(|(a, b)| (a - b).abs()).sum::<f64>()
}
