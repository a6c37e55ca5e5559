//! Every noise in the plane: its appearance, power spectrum and distribution.

use asperity_noise::{
    Fbm, FbmSpectrum, Field, GaussianNoise, Noise, Perlin, PerlinClassic, Simplex, SparseConvolution,
    ValueCatmullRom, ValueGradient, ValueNoise, WhiteNoise,
};
use asperity_render::image::{Image, tone::ember, tone::hex};
use glam::Vec2;
use rayon::prelude::*;

use crate::figure::{Context, Drawn, Figure, Panel, figure};
use crate::figures::noise::plane::{Window, gray};
use crate::plot::{Axis, Ink, Names, Plot, Stroke};
use crate::power_spectrum::PowerSpectrum;
use asperity::failure::Result;

/// One figure per noise.
pub(crate) const KINDS: &[Figure] = &[
    figure("noise-kind-white", |context| draw(context, WhiteNoise::default())),
    figure("noise-kind-value", |context| draw(context, ValueNoise::default())),
    figure("noise-kind-value-catmull-rom", |context| draw(context, ValueCatmullRom::default())),
    figure("noise-kind-perlin-1985", |context| draw(context, PerlinClassic::default())),
    figure("noise-kind-perlin-2002", |context| draw(context, Perlin::default())),
    figure("noise-kind-value-gradient", |context| draw(context, ValueGradient::default())),
    figure("noise-kind-simplex", |context| draw(context, Simplex::new(0))),
    figure("noise-kind-simplex-wide", |context| draw(context, Simplex::new(0).with_classic_radius())),
    figure("noise-kind-sparse", |context| draw(context, SparseConvolution::default())),
    figure("noise-kind-gaussian", |context| draw(context, GaussianNoise::default())),
];

/// Cells along a side of the image.
const CELLS: f32 = 8.0;
/// Values of black and white, in standard deviations.
const CONTRAST: f32 = 2.5;
/// Octaves of the distribution, equal to the number for which G was measured.
const OCTAVES: f32 = 8.0;

/// Spectrum samples along an axis, per cell, and number of sample pairs.
const SAMPLES: usize = 512;
const SAMPLES_PER_CELL: f32 = 8.0;
const PAIRS: usize = 6;
/// The spectrum image: cycles per cell at its border, decibels from darkest to brightest.
const BORDER: f64 = 2.5;
const DECIBELS: f64 = 60.0;

/// Seeds of the histogram, and grid points per side for each seed.
const SEEDS: u32 = 64;
const POINTS: usize = 128;

fn draw<K: Noise + Field<Vec2> + Copy + Sync>(context: &Context<'_>, noise: K) -> Result<Drawn> {
    let statistics = noise.statistics(2);
    let sigma = statistics.standard_deviation;
    let window = Window::new(context, CELLS);
    let words = ["value", "the noise", "The noise in gray: dark and bright blobs about a cell wide."];
    let seeded = noise.with_seed(context.seed);
    let look =
        window.draw(context, words, |p: Vec2| gray(0.5 + 0.5 * seeded.value(p) / (CONTRAST * sigma)))?;
    let (corner, cells) = (Vec2::new(0.37, 0.61), SAMPLES as f32 / SAMPLES_PER_CELL);
    let wide = Window { corner, cells, side: SAMPLES };
    let spectrum = wide.spectrum(context, PAIRS, |k| {
        let seeded = noise.with_seed(context.seed.wrapping_add(1 + k));
        move |p: Vec2| seeded.value(p)
    })?;
    let [octaves, one] = [OCTAVES, 1.0].map(|octaves| {
        measured(context, |seed| {
            let sum = Fbm::<K, Vec2>::new(noise.with_seed(seed), FbmSpectrum::default());
            move |p: Vec2| sum.value_with_octaves(p, octaves)
        })
    });
    let (octaves, one) = (octaves?, one?);
    let g: Vec<f64> = statistics.cdf.iter().copied().map(f64::from).collect();
    let apart = octaves.iter().zip(&g).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let power = format!("power, ±{BORDER} cycles per cell; ring at 1");
    let alt =
        "The power spectrum in the plane of frequencies, brightest where the noise has the most variance.";
    let panels = vec![
        look,
        Panel::new("spectrum", power, alt, spectrum_picture(context, &spectrum)),
        radial(&spectrum, f64::from(sigma).powi(2))?,
        distribution(&octaves, &one, &g)?,
    ];
    Ok(Drawn::new(4, panels)
        .fact("image", format!("{CELLS} × {CELLS} cells, black to white ±{CONTRAST} σ₁"))
        .fact("σ₁", format!("{sigma:.4}"))
        .fact("κ₁", format!("{:+.3}", statistics.excess_kurtosis).replace('-', "\u{2212}"))
        .fact("range", format!("±{:.3}", statistics.range))
        .fact("KS to G, 8 octaves", format!("{apart:.4}")))
}

/// Renders the frequency plane in decibels, with a ring at the lattice frequency.
fn spectrum_picture(context: &Context<'_>, spectrum: &PowerSpectrum) -> Image {
    let scale = 2.0 * BORDER / f64::from(context.size);
    let place = |x: u32| (f64::from(x) + 0.5) * scale - BORDER;
    let peak = (0..=400).fold(0.0_f64, |peak, i| {
        let (x, y) = (f64::from(i % 21) * BORDER / 40.0, f64::from(i / 21) * BORDER / 40.0);
        peak.max(spectrum.at(x, y))
    });
    Image::from_fn(context.size, context.size, |x, y| {
        let (fx, fy) = (place(x), place(y));
        let decibels = 10.0 * (spectrum.at(fx, fy) / peak).max(1e-30).log10();
        let color = ember((1.0 + decibels / DECIBELS) as f32);
        let on_ring = (1.0 - (fx.hypot(fy) - 1.0).abs() / scale).clamp(0.0, 1.0) as f32;
        color.lerp(hex(0x9f_b4c8), 0.55 * on_ring)
    })
}

/// Plots the mean density over rings, and along the axes and the diagonals alone.
fn radial(spectrum: &PowerSpectrum, variance: f64) -> Result<Panel> {
    const RANGE: [f64; 2] = [1.0 / 16.0, 4.0];
    const FLOOR: f64 = 80.0;
    let curve = |wanted: fn(f64) -> bool| {
        let rings = spectrum.rings(RANGE, wanted).into_iter();
        let decibels = rings.map(|[f, s]| [f, 10.0 * (s / variance).max(1e-30).log10()]);
        decibels.map(|[f, s]| [f, if s < -FLOOR { f64::NAN } else { s }])
    };
    let alt = "Power against frequency: mean over all directions, along axes, along diagonals";
    let (x, y) = (Axis::log2("cycles per cell", RANGE), Axis::linear("dB", [-FLOOR, 10.0], 20.0));
    Plot::new(SIZE, x, y, Names::Above)
        .curve("axes", curve(|cos| cos > 0.87), Stroke::solid(2).wide(1.0))
        .curve("diagonals", curve(|cos| cos < -0.87), Stroke::dashed(3).wide(1.0))
        .curve("mean", curve(|_| true), Stroke::solid(1).wide(2.0))
        .panel("power", "power per σ₁², against frequency", alt)
}

const SIZE: [f64; 2] = [330.0, 330.0];

/// Gaps between the knots of G, spaced evenly from −4 to 4.
const GAPS: usize = 256;
/// The outermost knots, in standard deviations.
const REACH: f64 = 4.0;

fn knot(k: usize) -> f64 {
    REACH * (2.0 * k as f64 / GAPS as f64 - 1.0)
}

/// Returns the fraction of the values of many fields below each knot.
fn measured<F: Fn(Vec2) -> f32 + Sync>(
    context: &Context<'_>,
    field: impl Fn(u32) -> F + Sync,
) -> Result<Vec<f64>> {
    // So far apart that neighbors are nearly independent.
    let window = Window { corner: Vec2::new(-171.3, -209.2), cells: 2.618 * POINTS as f32, side: POINTS };
    let count = |k| -> Result<Vec<u64>> {
        let mut bins = vec![0; GAPS + 2];
        for value in window.map(context, field(context.seed.wrapping_mul(1000).wrapping_add(k)))? {
            let place = (f64::from(value) / REACH + 1.0) * 0.5 * GAPS as f64;
            bins[(place.floor() + 1.0).clamp(0.0, (GAPS + 1) as f64) as usize] += 1;
        }
        Ok(bins)
    };
    let sum = |a: Vec<u64>, b: Vec<u64>| Ok(a.into_iter().zip(b).map(|(a, b)| a + b).collect());
    let bins = (0..SEEDS).into_par_iter().map(count).try_reduce(|| vec![0; GAPS + 2], sum)?;
    let total = bins.iter().sum::<u64>() as f64;
    Ok((0..=GAPS).map(|k| bins[..=k].iter().sum::<u64>() as f64 / total).collect())
}

/// Plots the measured density of eight octaves and the density of G, with the normal density and
/// one octave.
fn distribution(octaves: &[f64], one: &[f64], g: &[f64]) -> Result<Panel> {
    const STEP: usize = 4;
    const TOP: f64 = 0.6;
    let density = |below: &[f64], low, high| ((below[high] - below[low]) / (knot(high) - knot(low))).min(TOP);
    let stair = |below, k| [k, k + STEP].map(|end| [knot(end), density(below, k, k + STEP)]);
    let stairs = |below| (0..GAPS).step_by(STEP).flat_map(move |k| stair(below, k)).collect::<Vec<_>>();
    let slope = |k: usize| [knot(k), density(g, k.saturating_sub(STEP / 2), (k + STEP / 2).min(GAPS))];
    let normal = |k| [knot(k), (-0.5 * knot(k).powi(2)).exp() / std::f64::consts::TAU.sqrt()];
    let steps = (0..=GAPS).step_by(STEP);
    let (x, y) = (Axis::linear("r = n/σ", [-REACH, REACH], 2.0), Axis::linear("", [0.0, TOP], 0.2));
    let label = "distribution, with the tabulated G of eight octaves";
    let alt = "Histogram of eight octaves under the density of the tabulated G, with one octave and the normal density";
    Plot::new(SIZE, x, y, Names::Above)
        .area(stairs(octaves), 1, 0.16)
        .curve("1 octave", stairs(one), Stroke::solid(3).wide(0.9))
        .curve("normal", steps.clone().map(normal), Stroke::dashed(Ink::Muted).wide(1.2))
        .curve("8 octaves", stairs(octaves), Stroke::solid(1).wide(0.9))
        .curve("G\u{2032}", steps.map(slope), Stroke::solid(2).wide(1.6))
        .panel("distribution", label, alt)
}
