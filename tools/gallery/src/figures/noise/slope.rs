//! The spectral slope of fractal sums against gain and lacunarity.

use asperity_noise::{Fbm, FbmSpectrum, Perlin};
use glam::Vec2;

use crate::figure::{Context, Drawn, Panel};
use crate::figures::noise::plane::Window;
use crate::plot::{Axis, Names, Plot, Stroke, decimal};
use asperity::failure::Result;

/// Cells of the first octave along a sample, and values along it.
const CELLS: f64 = 12.0;
const SAMPLES: usize = 1024;
const PAIRS: usize = 2;
/// Range of the fitted slope, in cycles per cell of the first octave: within the octaves, below the
/// highest frequency.
const FITTED: [f64; 2] = [1.0, 21.0];
/// Range of the plots.
const SHOWN: [f64; 2] = [0.25, 32.0];

const GAINS: [(f32, f32); 3] = [(2.17, 0.7), (2.17, 0.5), (2.17, 0.3)];
const LACUNARITIES: [(f32, f32); 3] = [(1.6, 0.5), (2.17, 0.5), (3.2, 0.5)];

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn> {
    let (gains, mut rows) = panel(context, &GAINS, ["gain", "gain, at lacunarity 2.17"], |s| s.1)?;
    let (lacunarities, lacunarity_rows) =
        panel(context, &LACUNARITIES, ["lacunarity", "lacunarity, at gain 0.5"], |s| s.0)?;
    // The middle pair is in both plots.
    rows.extend(lacunarity_rows.into_iter().enumerate().filter(|(k, _)| *k != 1).map(|(_, row)| row));
    Ok(Drawn::new(2, vec![gains, lacunarities])
        .fact("noise", "Perlin 2002, octaves up to twice the highest frequency shown")
        .fact("samples", format!("{} of {SAMPLES}², {CELLS} cells a side, Hann window", 2 * PAIRS))
        .fact("slope", format!("least squares from {} to {} cycles per cell", FITTED[0], FITTED[1]))
        .table(["lacunarity", "gain", "H", "exponent in theory", "measured"], rows))
}

/// Plots three spectra, and returns their table rows.
fn panel(
    context: &Context<'_>,
    settings: &[(f32, f32); 3],
    [stem, title]: [&str; 2],
    varied: impl Fn((f32, f32)) -> f32,
) -> Result<(Panel, Vec<[String; 5]>)> {
    let x = Axis::log2("cycles per cell of the first octave", SHOWN);
    let y = Axis::linear(&format!("dB, by {title}"), [-95.0, 0.0], 20.0);
    let mut plot = Plot::new([520.0, 380.0], x, y, Names::AtEnds);
    let mut rows = Vec::new();
    for (k, &(lacunarity, gain)) in settings.iter().enumerate() {
        let rings = rings(context, lacunarity, gain)?;
        let hurst = -f64::from(gain).ln() / f64::from(lacunarity).ln();
        let exponent = -2.0 * hurst - 2.0;
        let fitted: Vec<_> = rings.iter().filter(|r| (FITTED[0]..FITTED[1]).contains(&r[0])).collect();
        let mean = |f: &dyn Fn(&[f64; 2]) -> f64| {
            fitted.iter().map(|r| f(r)).sum::<f64>() / fitted.len().max(1) as f64
        };
        let (x, y) = (mean(&|r| r[0].log2()), mean(&|r| r[1].log2()));
        let slope = mean(&|r| (r[0].log2() - x) * (r[1].log2() - y)) / mean(&|r| (r[0].log2() - x).powi(2));
        let decibels = |power: f64| 10.0 * power.log10();
        let line = |f: f64| [f, decibels((y + exponent * (f.log2() - x)).exp2())];
        let series = k as u8 + 1;
        let curve = rings.iter().map(|r| [r[0], decibels(r[1])]);
        plot = plot.line(FITTED.map(line), Stroke::dashed(series).wide(1.2));
        plot = plot.curve(varied((lacunarity, gain)).to_string(), curve, Stroke::solid(series));
        let [exponent, slope] = [exponent, slope].map(|value| decimal(value, 2));
        rows.push([lacunarity.to_string(), gain.to_string(), format!("{hurst:.2}"), exponent, slope]);
    }
    let alt = format!(
        "Power of the sum against frequency, by {title}: three falling curves along dashed lines, steeper for smaller \
         {stem}"
    );
    Ok((plot.panel(stem, format!("by {stem}"), alt)?, rows))
}

fn rings(context: &Context<'_>, lacunarity: f32, gain: f32) -> Result<Vec<[f64; 2]>> {
    let window = Window { corner: Vec2::new(0.2, 0.9), cells: CELLS as f32, side: SAMPLES };
    // Enough octaves that the spectrum extends beyond the displayed range.
    let octaves = ((2.0 * SHOWN[1]).log2() / f64::from(lacunarity).log2()).ceil().clamp(1.0, 16.0);
    let spectrum = FbmSpectrum::new(lacunarity, gain, 16)?;
    let power = window.spectrum(context, PAIRS, |k| {
        let seed = context.seed.wrapping_mul(100).wrapping_add(k);
        let sum = Fbm::<_, Vec2>::new(Perlin::new(seed), spectrum);
        move |p: Vec2| sum.value_with_octaves(p, octaves as f32)
    })?;
    Ok(power.rings(SHOWN, |_| true))
}
