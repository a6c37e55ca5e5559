//! The basic noise patterns of Nilsson's thesis and two of Musgrave's, and 2 × 2 copies of periodic
//! noises.

use asperity_noise::{
    Billow, Fbm, FbmSpectrum, Field, GaussianNoise, Normalization, Perlin, Plasma, RidgedMultifractal,
    Simplex, SparseConvolution, Turbulence, ValueNoise, ops::Power,
};
use glam::{Vec2, Vec3};

use crate::figure::{Context, Drawn, Panel, Shown};
use crate::figures::noise::plane::{Window, gray, slanted};
use asperity::failure::Result;

/// Cells of the first octave along a side.
const CELLS: f32 = 4.0;
/// Cells along a side of the threads, which have only three octaves.
const THREAD_CELLS: f32 = 8.0;
const OCTAVES: f32 = 8.0;

const CLOUD: [&str; 3] = ["cloud", "cloud: Σ aᵢ nᵢ", "Soft light and dark patches at all sizes."];
const TURBULENCE: [&str; 3] =
    ["turbulence", "turbulence: Σ aᵢ |nᵢ|", "Bright billows separated by dark veins."];
const PLASMA: [&str; 3] =
    ["plasma", "plasma: 1 − turbulence", "Bright branching veins on dark ground, like discharges."];
const PILE: [&str; 3] = ["pile", "pile: cloud with gain 1", "A rough, even surface like tufts of wool."];
const ENTANGLED: [&str; 3] = ["entangled", "plasma with gain 1", "Dense entangled light veins."];
const SEVENTH: [&str; 3] = ["threads", "threads: its seventh power", "Single light threads on black."];
const BILLOW: [&str; 3] =
    ["billow", "billow: Σ aᵢ (2|nᵢ| − 1)", "Round bright pads with creases between them."];
const RIDGED: [&str; 3] = [
    "ridged",
    "ridged multifractal, feedback 2",
    "Bright rough ridges around smooth dark valleys, like mountains from above.",
];

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn> {
    let noise = Simplex::new(context.seed).with_classic_radius();
    let sum = |spectrum| Fbm::<_, Vec3>::new(noise, spectrum).with_normalization(Normalization::UnitRange);
    let (clouds, threads) = (sum(FbmSpectrum::CLOUD).with_octaves(OCTAVES), sum(FbmSpectrum::THREADS));
    let (turbulence, plasma) = (clouds.with_shape(Turbulence), clouds.with_shape(Plasma));
    let billow = clouds.with_shape(Billow);
    let entangled = threads.with_shape(Plasma);
    let ridges = RidgedMultifractal::<_, Vec3>::new(noise, FbmSpectrum::CLOUD, 2.0)?.with_octaves(OCTAVES);
    let seventh = Power(entangled, 7);
    let panel = |cells, value: Shown<'_, Vec3, f32>, [black, white]: [f32; 2], words| {
        let shade = |p| gray((value(slanted(p)) - black) / (white - black));
        Window::new(context, cells).draw(context, words, shade)
    };
    let panels = vec![
        panel(CELLS, &|p| clouds.value(p), [-0.5, 0.5], CLOUD)?,
        panel(CELLS, &|p| turbulence.value(p), [0.0, 0.6], TURBULENCE)?,
        panel(CELLS, &|p| plasma.value(p), [0.4, 1.0], PLASMA)?,
        panel(THREAD_CELLS, &|p| threads.value(p), [-0.6, 0.6], PILE)?,
        panel(THREAD_CELLS, &|p| entangled.value(p), [0.2, 1.0], ENTANGLED)?,
        panel(THREAD_CELLS, &|p| seventh.value(p), [0.0, 0.6], SEVENTH)?,
        panel(CELLS, &|p| billow.value(p), [-1.0, 0.2], BILLOW)?,
        panel(CELLS, &|p| ridges.value(p), [0.0, 0.8], RIDGED)?,
    ];
    Ok(Drawn::new(4, panels)
        .fact("noise", "simplex, r² = 0.6, on a tilted plane through space")
        .fact("octaves", format!("{OCTAVES}, gain 0.5; threads 3, gain 1; lacunarity 2"))
        .fact(
            "picture",
            format!("{CELLS} cells per side, threads {THREAD_CELLS}; gray scaled to the range of values"),
        ))
}

/// Cells of a tile along its side.
const PERIOD: u32 = 6;

pub(crate) fn draw_tiles(context: &Context<'_>) -> Result<Drawn> {
    let seed = context.seed;
    let space = Simplex::new(seed).tiled([PERIOD; 3])?;
    let (periods, seams) = ([PERIOD; 2], Perlin::new(seed));
    let (perlin, value) = (seams.tiled(periods)?, ValueNoise::new(seed).tiled(periods)?);
    let sparse = SparseConvolution::new(seed).tiled(periods)?;
    let gaussian = GaussianNoise::new(seed).tiled(periods)?;
    let side = (context.size / 2) as usize;
    let tile = Window { corner: Vec2::new(0.21, 0.35), cells: PERIOD as f32, side };
    let whole = Window { side: 2 * side, ..tile };
    let panel = |stem, label, value: Shown<'_, Vec2, f32>, white: f32| -> Result<Panel> {
        let values = tile.map(context, value)?;
        let seam = if stem == "seams" { "with a cross of seams" } else { "without a seam" };
        let alt = format!("Four copies of a square of noise, {seam}.");
        Ok(whole.panel([stem, label, &alt], |i| {
            let (x, y) = (i % (2 * side) % side, i / (2 * side) % side);
            gray(0.5 + 0.5 * values[y * side + x] / white)
        }))
    };
    let panels = vec![
        panel("seams", "Perlin 2002, not periodic", &|p| seams.value(p), 0.76)?,
        panel("perlin-2002", "Perlin 2002, tiled", &|p| perlin.value(p), 0.76)?,
        panel("value", "value, tiled", &|p| value.value(p), 0.9)?,
        panel("sparse", "sparse convolution, tiled", &|p| sparse.value(p), 2.5)?,
        panel("gaussian", "Gaussian, tiled", &|p| gaussian.value(p), 2.5)?,
        panel("simplex", "simplex in space, tiled, a slice", &|p| space.value(p.extend(0.4)), 1.0)?,
    ];
    let period = format!("{PERIOD} × {PERIOD} cells, {PERIOD} × {PERIOD} × {PERIOD} in space");
    Ok(Drawn::new(3, panels).fact("period", period).fact("image", "2 × 2 copies of one tile"))
}
