//! Tiles: a noise that repeats, laid out two by two.

use asperity_noise::{Field, Gaussian, IntegerHash, Perlin2002, Simplex, Sparse, Tiled, TiledSimplex, Value};
use glam::Vec2;

use crate::failure::Failure;
use crate::gallery::figure::{Context, Drawn};
use crate::gallery::figures::noise::plane::{Window, grey};

/// Cells of a tile along its side.
const PERIOD: u32 = 6;

type Tile<'a> = &'a (dyn Fn(Vec2) -> f32 + Sync);

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn, Failure> {
    let lattice = Tiled::new(IntegerHash, [PERIOD; 2])?;
    let seed = context.seed;
    let space = TiledSimplex::new(Simplex::new(seed), [PERIOD; 3])?;
    let sparse = Sparse::new(seed).with_lattice(lattice);
    let side = (context.size / 2) as usize;
    let tile = Window { corner: Vec2::new(0.21, 0.35), cells: PERIOD as f32, side };
    let whole = Window { side: 2 * side, ..tile };
    let noises: [(&str, &str, Tile<'_>, f32); 6] = [
        ("seams", "Perlin 2002, not tiled", &|p| Perlin2002::new(seed).value(p), 0.76),
        (
            "perlin-2002",
            "Perlin 2002, tiled",
            &|p| Perlin2002::new(seed).with_lattice(lattice).value(p),
            0.76,
        ),
        ("value", "value, tiled", &|p| Value::new(seed).with_lattice(lattice).value(p), 0.9),
        ("sparse", "sparse convolution, tiled", &|p| sparse.value(p), 2.5),
        ("gaussian", "Gaussian, tiled", &|p| Gaussian::new(seed).with_lattice(lattice).value(p), 2.5),
        ("simplex", "simplex in space, tiled, a slice", &|p| space.value(p.extend(0.4)), 1.0),
    ];
    let mut panels = Vec::new();
    for (stem, label, value, white) in noises {
        let values = tile.map(context, value)?;
        let seam = if stem == "seams" { "with a cross of seams" } else { "without a seam" };
        let alt = format!("Four copies of a square of noise, {seam}.");
        panels.push(whole.panel([stem, label, &alt], |i| {
            let (x, y) = (i % (2 * side) % side, i / (2 * side) % side);
            grey(0.5 + 0.5 * values[y * side + x] / white)
        }));
    }
    let period = format!("{PERIOD} \u{d7} {PERIOD} cells, {PERIOD} \u{d7} {PERIOD} \u{d7} {PERIOD} in space");
    Ok(Drawn::new(3, panels).fact("period", period).fact("picture", "2 \u{d7} 2 copies of one tile"))
}
