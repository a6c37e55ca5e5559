//! The basic noise patterns of Nilsson's thesis, and two of Musgrave's.

use asperity_noise::{
    Billow, Field, Normalisation, Octaves, Plasma, Power, RidgedMultifractal, Simplex, Spectrum, Turbulence,
};
use glam::Vec3;

use crate::failure::Failure;
use crate::gallery::figure::{Context, Drawn};
use crate::gallery::figures::noise::plane::{Window, grey, slanted};

/// Cells of the first octave along a side.
const CELLS: f32 = 4.0;
/// Cells along a side of the threads, which have three octaves only.
const THREAD_CELLS: f32 = 8.0;
const OCTAVES: f32 = 8.0;

type Pattern<'a> = &'a (dyn Fn(Vec3) -> f32 + Sync);

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn, Failure> {
    let noise = Simplex::wide(context.seed);
    let sum = |spectrum| Octaves::<_, 3>::new(noise, spectrum).with_normalisation(Normalisation::Range);
    let (clouds, threads) = (sum(Spectrum::CLOUD).first(OCTAVES), sum(Spectrum::THREADS));
    let (turbulence, plasma) = (clouds.with_shape(Turbulence), clouds.with_shape(Plasma));
    let billow = clouds.with_shape(Billow);
    let entangled = threads.with_shape(Plasma);
    let ridges = RidgedMultifractal::<_, 3>::new(noise, Spectrum::CLOUD, 2.0)?.first(OCTAVES);
    let patterns: [(f32, Pattern<'_>, [f32; 2], [&str; 3]); 8] = [
        (
            CELLS,
            &|p| clouds.value(p),
            [-0.5, 0.5],
            ["cloud", "cloud: Σ aᵢ nᵢ", "Soft light and dark patches at all sizes."],
        ),
        (
            CELLS,
            &|p| turbulence.value(p),
            [0.0, 0.6],
            ["turbulence", "turbulence: Σ aᵢ |nᵢ|", "Bright billows parted by dark veins."],
        ),
        (
            CELLS,
            &|p| plasma.value(p),
            [0.4, 1.0],
            [
                "plasma",
                "plasma: 1 \u{2212} turbulence",
                "Bright branching veins on dark ground, like discharges.",
            ],
        ),
        (
            THREAD_CELLS,
            &|p| threads.value(p),
            [-0.6, 0.6],
            ["pile", "pile: cloud with gain 1", "A rough, even surface, as of tufts of wool."],
        ),
        (
            THREAD_CELLS,
            &|p| entangled.value(p),
            [0.2, 1.0],
            ["entangled", "plasma with gain 1", "Dense entangled light veins."],
        ),
        (
            THREAD_CELLS,
            &|p| Power(entangled, 7).value(p),
            [0.0, 0.6],
            ["threads", "threads: its seventh power", "Single light threads on black."],
        ),
        (
            CELLS,
            &|p| billow.value(p),
            [-1.0, 0.2],
            ["billow", "billow: Σ aᵢ (2|nᵢ| \u{2212} 1)", "Round bright pads with creases between them."],
        ),
        (
            CELLS,
            &|p| ridges.value(p),
            [0.0, 0.8],
            [
                "ridged",
                "ridged multifractal, feedback 2",
                "Bright rough ridges around smooth dark valleys, like mountains from above.",
            ],
        ),
    ];
    let mut panels = Vec::new();
    for (cells, value, [black, white], words) in patterns {
        let window = Window::new(context, cells);
        let values = window.map(context, |p| value(slanted(p)))?;
        panels.push(window.panel(words, |i| grey((values[i] - black) / (white - black))));
    }
    Ok(Drawn::new(4, panels)
        .fact("noise", "simplex, r² = 0.6, on a slanted plane through space")
        .fact("octaves", format!("{OCTAVES}, gain 0.5; threads 3, gain 1; lacunarity 2"))
        .fact(
            "picture",
            format!("{CELLS} cells a side, threads {THREAD_CELLS}; grey stretched over the values"),
        ))
}
