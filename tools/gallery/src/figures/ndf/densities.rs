//! Every normal density: its map, its lobe, its slopes, and the residual of normals sampled from
//! it.

use std::f64::consts::FRAC_2_PI;

use asperity_ndf_sampling::{
    AshikhminShirley, Beckmann, BlinnPhong, Ggx, Isotropic, Mixture, StudentT, Ward,
};
use asperity_render::{image::tone::hex, light::background, materials::SharedNdf, sampling::random::Random};
use glam::{Vec2, Vec3};
use rayon::prelude::*;

use crate::figure::{Context, Drawn, Figure, Panel, figure};
use crate::figures::kautz::ndf::lobe_panel;
use crate::panels::density_panel;
use crate::plot::{Axis, Names, Plot, Stroke};
use asperity::failure::Result;
use asperity::input::density::painted;

/// One figure per density.
pub(crate) const DENSITIES: &[Figure] = &[
    figure("ndf-density-ggx", |context| draw(context, "GGX 0.2, 0.4", &Ggx::new(0.2, 0.4)?)),
    figure("ndf-density-beckmann", |context| draw(context, "Beckmann 0.2, 0.4", &Beckmann::new(0.2, 0.4)?)),
    figure("ndf-density-student-t", |context| {
        draw(context, "Student-t 0.2, 0.4, γ = 1.6", &StudentT::new(0.2, 0.4, 1.6)?)
    }),
    figure("ndf-density-blinn-phong", |context| {
        draw(context, "Blinn–Phong, n = 20", &BlinnPhong::new(20.0)?)
    }),
    figure("ndf-density-ashikhmin-shirley", |context| {
        draw(context, "Ashikhmin–Shirley 80, 12", &AshikhminShirley::new(80.0, 12.0)?)
    }),
    figure("ndf-density-ward", |context| draw(context, "Ward 0.35, 0.15", &Ward::new(0.35, 0.15)?)),
    figure("ndf-density-mixture", |context| {
        let mixture = Mixture::new(Ggx::isotropic(0.12)?, BlinnPhong::new(0.0)?, 0.2)?;
        draw(context, "0.2 GGX 0.12 + 0.8 diffuse", &mixture)
    }),
    figure("ndf-density-isotropic", |context| {
        let ring = |cos: f32| {
            let tilt = cos.acos();
            (-(tilt / 0.12).powi(2)).exp() + 0.35 * (-((tilt - 0.6) / 0.09).powi(2)).exp()
        };
        draw(context, "table, 513 cosines", &Isotropic::from_fn(513, ring)?)
    }),
    figure("ndf-density-painted", |context| draw(context, "painted, 256 × 256", &painted()?)),
];

/// Normals sampled for the residual.
const NORMALS: u32 = 1 << 22;
/// Bins along a side of the square around the disk.
const BINS: usize = 64;
/// Full blue and full red of the residual, in standard deviations of the count.
const CONTRAST: f64 = 4.0;

fn draw(context: &Context<'_>, name: &str, ndf: &SharedNdf) -> Result<Drawn> {
    let bins = counted(context, ndf)?;
    let panels = vec![
        density_panel(context, ndf, "density", name)?,
        lobe_panel(context, ndf, &format!("The lobe of {name} above a disk."))?,
        slopes(ndf)?,
        residual(context, &bins)?,
    ];
    let sum = |term: fn([f64; 2]) -> f64| bins.iter().flatten().map(|&bin| term(bin)).sum::<f64>();
    let chi_square = sum(|[count, expected]| (count - expected).powi(2) / expected);
    let freedom = bins.iter().flatten().count().max(1) as f64;
    // Half the sum of the differences, relative to the number of normals. Random numbers alone give
    // ½ Σ √(2/π) √expected.
    let variation = 0.5 * sum(|[count, expected]| (count - expected).abs()) / f64::from(NORMALS);
    let floor = 0.5 * sum(|[_, expected]| (expected * FRAC_2_PI).sqrt()) / f64::from(NORMALS);
    Ok(Drawn::new(4, panels)
        .fact("density", name)
        .fact("sampled normals", format!("{} million", NORMALS >> 20))
        .fact("χ² per degree of freedom", format!("{:.3}", chi_square / freedom))
        .fact("total variation", format!("{variation:.5}"))
        .fact("expected from sampling alone", format!("{floor:.5}")))
}

/// Plots the slope density along both axes, in decades.
fn slopes(ndf: &SharedNdf) -> Result<Panel> {
    const REACH: f64 = 2.0;
    const DECADES: f64 = 5.0;
    let tallest = (-200..=200)
        .flat_map(|k| [Vec2::X, Vec2::Y].map(|axis| axis * (k as f32 * 0.01)))
        .map(|slope| f64::from(ndf.slope_density(slope)))
        .fold(f64::MIN_POSITIVE, f64::max)
        .log10()
        .ceil();
    let cut = |axis: Vec2| {
        (-400..=400)
            .map(|k| f64::from(k) * REACH / 400.0)
            .map(move |s| [s, f64::from(ndf.slope_density(axis * s as f32)).max(1e-30).log10()])
            .map(move |[s, p]| [s, if p < tallest - DECADES { f64::NAN } else { p }])
    };
    let x = Axis::linear("slope", [-REACH, REACH], 1.0);
    let y = Axis::linear("log₁₀ of the density", [tallest - DECADES, tallest], 1.0);
    let alt = "The density of slopes along the two axes, in powers of ten";
    Plot::new([330.0, 330.0], x, y, Names::Above)
        .curve("along y", cut(Vec2::Y), Stroke::dashed(2))
        .curve("along x", cut(Vec2::X), Stroke::solid(1).wide(2.0))
        .panel("slopes", "slopes, along both axes", alt)
}

/// Counted and expected normals in bins of the disk; `None` for bins that the rim crosses or with a
/// low expected count.
type Bins = Vec<Option<[f64; 2]>>;

/// Samples normals with pseudorandom Gaussian numbers and counts them.
fn counted(context: &Context<'_>, ndf: &SharedNdf) -> Result<Bins> {
    const PARTS: u32 = 64;
    let place = |n: f32| (((n * 0.5 + 0.5) * BINS as f32) as usize).min(BINS - 1);
    let part = |mut counts: Vec<u32>, part: u32| {
        let mut random = Random(u64::from(context.seed) << 32 | u64::from(part));
        for _ in 0..NORMALS / PARTS {
            let m = ndf.warp_gaussian(Vec2::from(random.gaussians().map(|z| z as f32)));
            counts[place(m.y) * BINS + place(m.x)] += 1;
        }
        counts
    };
    let none = || vec![0; BINS * BINS];
    let sum = |a: Vec<u32>, b: Vec<u32>| a.into_iter().zip(b).map(|(a, b)| a + b).collect();
    let counts = (0..PARTS).into_par_iter().fold(none, part).reduce(none, sum);
    context.checkpoint()?;
    let bin = |(bin, count)| {
        let expected = f64::from(NORMALS) * integral(ndf, bin % BINS, bin / BINS)?;
        // Smaller counts would not be approximately Gaussian.
        (expected >= 10.0).then_some([f64::from(count), expected])
    };
    Ok(counts.into_par_iter().enumerate().map(bin).collect())
}

/// Displays the differences over their standard deviations, on the disk.
fn residual(context: &Context<'_>, bins: &Bins) -> Result<Panel> {
    const RADIUS: f32 = 0.86;
    let sampling = context.square();
    let half = 0.5 * sampling.width as f32 * RADIUS;
    let (low, middle, high) = (hex(0x4f_8fd0), hex(0x1f_2129), hex(0xe0_7a4a));
    let image = context.render(sampling, |px, py| {
        let (x, y) = (px / half - 1.0 / RADIUS, 1.0 / RADIUS - py / half);
        if x * x + y * y >= 1.0 {
            return background(px / sampling.width as f32, py / sampling.height as f32);
        }
        let place = |n: f32| ((n * 0.5 + 0.5) * BINS as f32) as usize;
        let Some([count, expected]) = bins.get(place(y) * BINS + place(x)).copied().flatten() else {
            return hex(0x2b_2d35);
        };
        let deviation = ((count - expected) / expected.sqrt() / CONTRAST).clamp(-1.0, 1.0) as f32;
        middle.lerp(if deviation < 0.0 { low } else { high }, deviation.abs())
    })?;
    let label = format!("sampled minus expected, ±{CONTRAST} deviations");
    let alt = "Blue and orange specks without a pattern over the disk of normals.";
    Ok(Panel::new("residual", label, alt, image))
}

/// Returns the fraction of normals in a bin, or `None` if the rim crosses it.
fn integral(ndf: &SharedNdf, i: usize, j: usize) -> Option<f64> {
    const POINTS: usize = 24;
    let edge = |k: usize| 2.0 * k as f64 / BINS as f64 - 1.0;
    let corner = |a: usize, b: usize| edge(i + a).hypot(edge(j + b)) < 1.0;
    if ![(0, 0), (0, 1), (1, 0), (1, 1)].into_iter().all(|(a, b)| corner(a, b)) {
        return None;
    }
    let step = 2.0 / BINS as f64 / POINTS as f64;
    let at = |k: usize, m: usize| edge(k) + step * (m as f64 + 0.5);
    let sum: f64 = (0..POINTS * POINTS)
        .map(|k| (at(i, k % POINTS), at(j, k / POINTS)))
        .map(|(x, y)| Vec3::new(x as f32, y as f32, (1.0 - x * x - y * y).sqrt() as f32))
        .map(|m| f64::from(ndf.d(m)))
        .sum();
    Some(sum * step * step)
}
