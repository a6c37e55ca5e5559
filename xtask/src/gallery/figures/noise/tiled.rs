//! Tiles: a noise that repeats, laid out two by two.

use asperity_noise::{
    Field, Gaussian, IntegerHash, Perlin2002, Seeded, Simplex, Sparse, Tiled, TiledSimplex, Value,
};
use glam::Vec2;

use crate::{
    failure::Failure,
    gallery::{
        figure::{Context, Drawn, Figure, Panel},
        figures::noise::plane::{Window, grey},
        panels::{fact, raster},
    },
};

/// The figure.
pub(crate) const TILED: Figure = Figure {
    name: "noise-tiled",
    title: "Noises that tile",
    source: "Asperity",
    caption: "Every picture is one square of noise, laid out two by two. The first is ordinary noise, with seams where \
              the squares meet. The others are on lattices that repeat after six cells: pixels on both sides of the \
              border fit, since a point and the same point a period further have the same bits. A period may be any number of \
              cells, and another one along every axis.",
    draw,
};

/// Cells of a tile along its side.
const PERIOD: u32 = 6;

fn draw(context: &Context<'_>) -> Result<Drawn, Failure> {
    context.progress.inc_length(6);
    let lattice = Tiled::new(IntegerHash, [PERIOD; 2])?;
    let (seed, show) = (context.seed, Show { context });
    let space = TiledSimplex::new(Simplex::CONTINUOUS, [PERIOD; 3])?;
    let panels = vec![
        show.plane(
            &Seeded(Perlin2002::default(), seed),
            0.76,
            ["seams", "Perlin 2002, not tiled", "with a cross of seams"],
        )?,
        show.plane(
            &Seeded(Perlin2002(lattice), seed),
            0.76,
            ["perlin-2002", "Perlin 2002, tiled", "without a seam"],
        )?,
        show.plane(&Seeded(Value(lattice), seed), 0.9, ["value", "value, tiled", "without a seam"])?,
        show.plane(
            &Seeded(Sparse::default().with_lattice(lattice), seed),
            2.5,
            ["sparse", "sparse convolution, tiled", "without a seam"],
        )?,
        show.plane(&Seeded(Gaussian(lattice), seed), 2.5, ["gaussian", "Gaussian, tiled", "without a seam"])?,
        show.slice(
            &Seeded(space, seed),
            1.0,
            ["simplex", "simplex in space, tiled, a slice", "without a seam"],
        )?,
    ];
    let parameters = vec![
        fact(
            "period",
            &format!("{PERIOD} \u{d7} {PERIOD} cells, {PERIOD} \u{d7} {PERIOD} \u{d7} {PERIOD} in space"),
        ),
        fact("picture", "2 \u{d7} 2 copies of one tile"),
    ];
    Ok(Drawn { columns: 3, panels, parameters, table: None })
}

struct Show<'a> {
    context: &'a Context<'a>,
}

impl Show<'_> {
    /// The window of one tile, half as wide as the picture.
    fn tile(&self) -> Window {
        let side = (self.context.size / 2) as usize;
        Window { corner: Vec2::new(0.21, 0.35), cells: PERIOD as f32, side }
    }

    /// One tile of a noise in the plane.
    fn plane<F: Field<2> + Sync>(&self, field: &F, white: f32, words: [&str; 3]) -> Result<Panel, Failure> {
        let values = self.tile().map(self.context, |p| field.value(p))?;
        Ok(self.panel(&values, white, words))
    }

    /// One tile of a slice of a noise in space.
    fn slice<F: Field<3> + Sync>(&self, field: &F, white: f32, words: [&str; 3]) -> Result<Panel, Failure> {
        let values = self.tile().map(self.context, |p| field.value(p.extend(0.4)))?;
        Ok(self.panel(&values, white, words))
    }

    /// One tile, four times.
    fn panel(&self, values: &[f32], white: f32, [stem, label, alt]: [&str; 3]) -> Panel {
        self.context.progress.inc(1);
        let side = self.tile().side;
        let window = Window { side: 2 * side, ..self.tile() };
        let image = window.picture(|i| {
            let (x, y) = (i % (2 * side) % side, i / (2 * side) % side);
            grey(0.5 + 0.5 * values[y * side + x] / white)
        });
        raster(stem, label, &format!("Four copies of a square of noise, {alt}."), image)
    }
}
