//! The basic noise patterns of Nilsson's thesis, and two of Musgrave's.

use asperity_noise::{
    Billow, Field, Normalisation, Octaves, Plasma, Power, RidgedMultifractal, Simplex, Spectrum, Turbulence,
};

use crate::{
    failure::Failure,
    gallery::{
        figure::{Context, Drawn, Figure, Panel},
        figures::noise::plane::{Window, grey, slanted},
        panels::{fact, raster},
    },
};

/// The figure.
pub(crate) const PATTERNS: Figure = Figure {
    name: "noise-sum-patterns",
    title: "Patterns from sums of octaves",
    source: "after Nilsson 2008, figures 4.1, 4.2, 4.3, 4.5, 4.7 and 4.8; last two after Musgrave in Ebert (ed.) 1994",
    caption: "One simplex noise, eight ways to add its octaves. Clouds are the plain sum. Turbulence adds absolute \
              values and has dark veins where an octave is 0; plasma is 1 minus that. With three octaves of equal \
              strength the sum is rough as a carpet's pile from afar, and the same plasma to the seventh power keeps \
              nothing but single threads. Billow is turbulence over the whole range; in the ridged multifractal \
              ridges bear ridges and valleys stay smooth.",
    draw,
};

/// Cells of the first octave along a side.
const CELLS: f32 = 4.0;
/// The same for the threads, which have three octaves only.
const THREAD_CELLS: f32 = 8.0;
const OCTAVES: f32 = 8.0;

fn draw(context: &Context<'_>) -> Result<Drawn, Failure> {
    context.progress.inc_length(8);
    let noise = Simplex::WIDE;
    let sum = |spectrum| Octaves::<_, 3>::new(noise, spectrum, Normalisation::Range, context.seed);
    let (clouds, threads) = (sum(Spectrum::CLOUD), sum(Spectrum::THREADS));
    let ridges = RidgedMultifractal::<_, 3>::new(noise, Spectrum::CLOUD, 2.0, context.seed)?;
    let show = Show { context };
    let panels = vec![
        show.panel(
            CELLS,
            &clouds.first(OCTAVES),
            [-0.5, 0.5],
            ["cloud", "cloud: Σ aᵢ nᵢ", "Soft light and dark patches at all sizes."],
        )?,
        show.panel(
            CELLS,
            &clouds.with_shape(Turbulence).first(OCTAVES),
            [0.0, 0.6],
            ["turbulence", "turbulence: Σ aᵢ |nᵢ|", "Bright billows parted by dark veins."],
        )?,
        show.panel(
            CELLS,
            &clouds.with_shape(Plasma).first(OCTAVES),
            [0.4, 1.0],
            [
                "plasma",
                "plasma: 1 \u{2212} turbulence",
                "Bright branching veins on dark ground, like discharges.",
            ],
        )?,
        show.panel(
            THREAD_CELLS,
            &threads.first(3.0),
            [-0.6, 0.6],
            ["pile", "pile: cloud with gain 1", "A rough, even surface, as of tufts of wool."],
        )?,
        show.panel(
            THREAD_CELLS,
            &threads.with_shape(Plasma).first(3.0),
            [0.2, 1.0],
            ["entangled", "plasma with gain 1", "Dense entangled light veins."],
        )?,
        show.panel(
            THREAD_CELLS,
            &Power(threads.with_shape(Plasma).first(3.0), 7),
            [0.0, 0.6],
            ["threads", "threads: its seventh power", "Single light threads on black."],
        )?,
        show.panel(
            CELLS,
            &clouds.with_shape(Billow).first(OCTAVES),
            [-1.0, 0.2],
            ["billow", "billow: Σ aᵢ (2|nᵢ| \u{2212} 1)", "Round bright pads with creases between them."],
        )?,
        show.panel(
            CELLS,
            &ridges.first(OCTAVES),
            [0.0, 0.8],
            [
                "ridged",
                "ridged multifractal, feedback 2",
                "Bright rough ridges around smooth dark valleys, like mountains from above.",
            ],
        )?,
    ];
    let parameters = vec![
        fact("noise", "simplex, r² = 0.6, on a slanted plane through space"),
        fact("octaves", &format!("{OCTAVES}, gain 0.5; threads 3, gain 1; lacunarity 2")),
        fact(
            "picture",
            &format!("{CELLS} cells a side, threads {THREAD_CELLS}; grey stretched over the values"),
        ),
    ];
    Ok(Drawn { columns: 4, panels, parameters, table: None })
}

struct Show<'a> {
    context: &'a Context<'a>,
}

impl Show<'_> {
    /// A field with what is black and what is white.
    fn panel<F: Field<3> + Sync>(
        &self,
        cells: f32,
        field: &F,
        [black, white]: [f32; 2],
        [stem, label, alt]: [&str; 3],
    ) -> Result<Panel, Failure> {
        let window = Window::new(self.context, cells);
        let values = window.map(self.context, |p| field.value(slanted(p)))?;
        self.context.progress.inc(1);
        Ok(raster(stem, label, alt, window.picture(|i| grey((values[i] - black) / (white - black)))))
    }
}
