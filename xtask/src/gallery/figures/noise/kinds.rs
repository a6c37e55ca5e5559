//! Every kind of noise in the plane: its look, its power spectrum and its distribution.

use asperity_noise::{
    Field, Gaussian, Noise, Octaves, Perlin1985, Perlin2002, Simplex, Sparse, Spectrum, Statistics, Value,
    ValueCatmullRom, ValueGradient, White, simd::Kernel,
};
use asperity_render::image::Image;
use asperity_render::image::tone::hex;
use asperity_render::integrator::hemisphere::ember;
use glam::Vec2;
use rayon::prelude::*;

use crate::failure::Failure;
use crate::gallery::figure::{Context, Drawn, Figure, Panel};
use crate::gallery::figures::noise::plane::{Window, grey};
use crate::gallery::plot::{Axis, Ink, Names, Plot, Stroke};
use crate::gallery::power_spectrum::PowerSpectrum;

/// One figure for each kind; a new kind is one entry here.
pub(crate) const KINDS: &[Figure] = &[
    Figure { name: "noise-kind-white", draw: |context| draw(context, White::default()) },
    Figure { name: "noise-kind-value", draw: |context| draw(context, Value::default()) },
    Figure {
        name: "noise-kind-value-catmull-rom",
        draw: |context| draw(context, ValueCatmullRom::default()),
    },
    Figure { name: "noise-kind-perlin-1985", draw: |context| draw(context, Perlin1985::default()) },
    Figure { name: "noise-kind-perlin-2002", draw: |context| draw(context, Perlin2002::default()) },
    Figure { name: "noise-kind-value-gradient", draw: |context| draw(context, ValueGradient::default()) },
    Figure { name: "noise-kind-simplex", draw: |context| draw(context, Simplex::new(0)) },
    Figure { name: "noise-kind-simplex-wide", draw: |context| draw(context, Simplex::wide(0)) },
    Figure { name: "noise-kind-sparse", draw: |context| draw(context, Sparse::default()) },
    Figure { name: "noise-kind-gaussian", draw: |context| draw(context, Gaussian::default()) },
];

/// Cells along a side of the picture.
const CELLS: f32 = 8.0;
/// Values of black and white, in standard deviations.
const CONTRAST: f32 = 2.5;
/// Octaves of the distribution, as many as G was measured for.
const OCTAVES: f32 = 8.0;

/// Samples of the spectrum along an axis, per cell, and how many pairs of them.
const SAMPLES: usize = 512;
const SAMPLES_PER_CELL: f64 = 8.0;
const PAIRS: usize = 6;
/// The picture of the spectrum: cycles per cell at its border, decibels from its darkest to its brightest.
const BORDER: f64 = 2.5;
const DECIBELS: f64 = 60.0;

/// Seeds of the histogram, and points along a side of the grid that is laid out for each.
const SEEDS: u32 = 64;
const POINTS: usize = 128;

fn draw<K: Kernel<2> + Noise<Vec2> + Copy + Sync>(context: &Context<'_>, noise: K) -> Result<Drawn, Failure> {
    let statistics = Kernel::<2>::statistics(&noise);
    let sigma = statistics.standard_deviation;
    let window = Window::new(context, CELLS);
    let values = window.map(context, |p: Vec2| noise.with_seed(context.seed).value(p))?;
    let words = ["value", "the noise", "The noise in grey, dark and bright blobs about a cell wide."];
    let look = window.panel(words, |i| grey(0.5 + 0.5 * values[i] / (CONTRAST * sigma)));
    let spectrum = spectrum(context, noise)?;
    let [octaves, one] = [OCTAVES, 1.0].map(|octaves| Histogram::measure(context, noise, octaves));
    let (octaves, one) = (octaves?, one?);
    let panels = vec![
        look,
        Panel::raster(
            "spectrum",
            format!("power, \u{b1}{BORDER} cycles per cell; the ring is 1"),
            "The power spectrum in the plane of frequencies, brightest where the noise has its variance.",
            spectrum_picture(context, &spectrum),
        ),
        radial(&spectrum, f64::from(sigma).powi(2))?,
        distribution(&octaves, &one, statistics)?,
    ];
    Ok(Drawn::new(4, panels)
        .fact("picture", format!("{CELLS} \u{d7} {CELLS} cells, black to white \u{b1}{CONTRAST} σ₁"))
        .fact("σ₁", format!("{sigma:.4}"))
        .fact("κ₁", format!("{:+.3}", statistics.excess_kurtosis).replace('-', "\u{2212}"))
        .fact("range", format!("\u{b1}{:.3}", statistics.range))
        .fact("KS to G, 8 octaves", format!("{:.4}", octaves.distance(statistics))))
}

fn spectrum<K: Kernel<2> + Noise<Vec2> + Copy + Sync>(
    context: &Context<'_>,
    noise: K,
) -> Result<PowerSpectrum, Failure> {
    let spacing = 1.0 / SAMPLES_PER_CELL;
    let cells = (SAMPLES as f64 * spacing) as f32;
    let window = Window { corner: Vec2::new(0.37, 0.61), cells, side: SAMPLES };
    let sample = |k: usize| {
        let seed = context.seed.wrapping_add(1 + k as u32);
        // An interruption is reported after the sum.
        window
            .map(context, |p: Vec2| noise.with_seed(seed).value(p))
            .unwrap_or_else(|_| vec![0.0; SAMPLES * SAMPLES])
    };
    let spectrum = PowerSpectrum::mean(SAMPLES, spacing, PAIRS, sample);
    context.checkpoint()?;
    Ok(spectrum)
}

/// The plane of frequencies in decibels, with a ring at the lattice's frequency.
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
        let colour = ember((1.0 + decibels / DECIBELS) as f32);
        let on_ring = (1.0 - (fx.hypot(fy) - 1.0).abs() / scale).clamp(0.0, 1.0) as f32;
        colour.lerp(hex(0x9f_b4c8), 0.55 * on_ring)
    })
}

/// The mean density over rings, and along the axes and the diagonals alone.
fn radial(spectrum: &PowerSpectrum, variance: f64) -> Result<Panel, Failure> {
    const RANGE: [f64; 2] = [1.0 / 16.0, 4.0];
    const FLOOR: f64 = 80.0;
    let curve = |wanted: fn(f64) -> bool| {
        let rings = spectrum.rings(RANGE, wanted).into_iter();
        rings
            .map(|[f, s]| [f, 10.0 * (s / variance).max(1e-30).log10()])
            .map(|[f, s]| [f, if s < -FLOOR { f64::NAN } else { s }])
    };
    let (x, y) = (Axis::log2("cycles per cell", RANGE, 1), Axis::linear("dB", [-FLOOR, 10.0], 20.0));
    Plot::new(SIZE, x, y, Names::Above)
        .curve("axes", curve(|cos| cos > 0.87), Stroke::solid(2).wide(1.0))
        .curve("diagonals", curve(|cos| cos < -0.87), Stroke::dashed(3).wide(1.0))
        .curve("mean", curve(|_| true), Stroke::solid(1).wide(2.0))
        .panel(
            "power",
            "power per σ₁², against frequency",
            "Power against frequency: mean over all directions, along axes, along diagonals",
        )
}

const SIZE: [f64; 2] = [330.0, 330.0];

/// Histogram between the knots of G of the sum of octaves over its standard deviation.
struct Histogram {
    /// One for every gap between the fine knots, which include those of G.
    bins: Vec<u64>,
}

/// Knots of the histogram from −4 to 4, as G has them.
const GAPS: usize = 256;
/// The outermost knots, in standard deviations.
const REACH: f64 = 4.0;

impl Histogram {
    fn measure<K: Kernel<2> + Noise<Vec2> + Copy + Sync>(
        context: &Context<'_>,
        noise: K,
        octaves: f32,
    ) -> Result<Self, Failure> {
        let spectrum = Spectrum::default();
        // Wide enough that neighbours hardly know of one another.
        let window = Window { corner: Vec2::new(-171.3, -209.2), cells: 2.618 * POINTS as f32, side: POINTS };
        let counts: Result<Vec<Vec<u64>>, Failure> = (0..SEEDS)
            .into_par_iter()
            .map(|k| {
                let seed = context.seed.wrapping_mul(1000).wrapping_add(k);
                let sum = Octaves::<K, 2>::new(noise.with_seed(seed), spectrum);
                let values = window.map(context, |p: Vec2| sum.detail(octaves).value(p))?;
                let mut bins = vec![0; GAPS + 2];
                for value in values {
                    let place = (f64::from(value) / REACH + 1.0) * 0.5 * GAPS as f64;
                    bins[(place.floor() + 1.0).clamp(0.0, (GAPS + 1) as f64) as usize] += 1;
                }
                Ok(bins)
            })
            .collect();
        let mut bins = vec![0; GAPS + 2];
        for count in counts? {
            for (sum, n) in bins.iter_mut().zip(count) {
                *sum += n;
            }
        }
        Ok(Self { bins })
    }

    fn total(&self) -> f64 {
        self.bins.iter().sum::<u64>() as f64
    }

    /// The greatest difference between the measured distribution and G, at the knots.
    fn distance(&self, statistics: &Statistics) -> f64 {
        let (mut below, mut greatest) = (0, 0.0_f64);
        for k in 0..=GAPS {
            below += self.bins[k];
            greatest = greatest.max((below as f64 / self.total() - shipped(statistics, knot(k))).abs());
        }
        greatest
    }

    /// The measured density in steps of `gaps` knots, as a staircase.
    fn stairs(&self, gaps: usize) -> Vec<[f64; 2]> {
        let width = 2.0 * REACH * gaps as f64 / GAPS as f64;
        let mut points = Vec::new();
        for (k, bins) in self.bins[1..=GAPS].chunks(gaps).enumerate() {
            let height = bins.iter().sum::<u64>() as f64 / self.total() / width;
            points.extend([[knot(k * gaps), height], [knot((k + 1) * gaps), height]]);
        }
        points
    }
}

fn knot(k: usize) -> f64 {
    REACH * (2.0 * k as f64 / GAPS as f64 - 1.0)
}

/// G at a point, linear between its knots.
fn shipped(statistics: &Statistics, r: f64) -> f64 {
    let gaps = statistics.cdf.len().saturating_sub(1);
    let place = ((r / REACH + 1.0) * 0.5 * gaps as f64).clamp(0.0, gaps as f64);
    let at = |k: usize| f64::from(statistics.cdf[k.min(gaps)]);
    let low = at(place as usize);
    low + (at(place as usize + 1) - low) * place.fract()
}

/// The measured density of eight octaves under that of G, with the normal one and that of one octave.
fn distribution(octaves: &Histogram, one: &Histogram, statistics: &Statistics) -> Result<Panel, Failure> {
    const GAPS_PER_STEP: usize = 4;
    const TOP: f64 = 0.6;
    let cut = |points: Vec<[f64; 2]>| points.into_iter().map(|[r, y]| [r, y.min(TOP)]).collect::<Vec<_>>();
    let steps = 0..=GAPS / GAPS_PER_STEP;
    let step = 2.0 * REACH * GAPS_PER_STEP as f64 / GAPS as f64;
    let slope = |r: f64| {
        let (low, high) = ((r - 0.5 * step).max(-REACH), (r + 0.5 * step).min(REACH));
        [r, (shipped(statistics, high) - shipped(statistics, low)) / (high - low)]
    };
    let normal = |r: f64| [r, (-0.5 * r * r).exp() / std::f64::consts::TAU.sqrt()];
    let place = |k: usize| knot(k * GAPS_PER_STEP);
    let stairs = cut(octaves.stairs(GAPS_PER_STEP));
    let (x, y) = (Axis::linear("r = n/σ", [-REACH, REACH], 2.0), Axis::linear("", [0.0, TOP], 0.2));
    let slopes = cut(steps.clone().map(|k| slope(place(k))).collect());
    Plot::new(SIZE, x, y, Names::Above)
        .area(stairs.clone(), 0.0, 1, 0.16)
        .curve("1 octave", cut(one.stairs(GAPS_PER_STEP)), Stroke::solid(3).wide(0.9))
        .curve("normal", steps.map(|k| normal(place(k))), Stroke::dashed(Ink::Muted).wide(1.2))
        .curve("8 octaves", stairs, Stroke::solid(1).wide(0.9))
        .curve("G\u{2032}", slopes, Stroke::solid(2).wide(1.6))
        .panel(
            "distribution",
            "distribution, and the shipped G of eight octaves",
            "Histogram of eight octaves under the density of the shipped G, with one octave and the normal density",
        )
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::*;

    #[test]
    fn g_is_read_at_and_between_its_knots() {
        let statistics = Noise::<Vec2>::statistics(&Gaussian::default());
        assert_eq!(shipped(statistics, 0.0), 0.5);
        assert_eq!(shipped(statistics, knot(GAPS)), f64::from(statistics.cdf[statistics.cdf.len() - 1]));
        assert_abs_diff_eq!(shipped(statistics, 1.01), 0.843_75, epsilon = 1e-4);
    }

    #[test]
    fn a_histogram_of_the_right_kind_is_near_g_and_of_a_wrong_one_is_not() {
        let statistics = Noise::<Vec2>::statistics(&Gaussian::default());
        let mut histogram = Histogram { bins: vec![0; GAPS + 2] };
        for (k, bin) in histogram.bins[1..=GAPS].iter_mut().enumerate() {
            *bin = (1e6 * (shipped(statistics, knot(k + 1)) - shipped(statistics, knot(k)))) as u64;
        }
        assert!(histogram.distance(statistics) < 1e-3);
        let area: f64 = histogram.stairs(4).chunks(2).map(|s| (s[1][0] - s[0][0]) * s[0][1]).sum();
        assert_abs_diff_eq!(area, 1.0, epsilon = 1e-9);
        histogram.bins[GAPS / 2] += 100_000;
        assert!(histogram.distance(statistics) > 0.02);
    }
}
