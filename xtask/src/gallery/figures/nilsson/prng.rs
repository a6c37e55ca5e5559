//! Random numbers of the cells of a lattice: the thesis's texture, a permutation and a hash.

use asperity_render::image::{Image, tone::hex};
use asperity_shading::noise::lattice::{ChainedTable, PermutationTable};
use asperity_shading::noise::{IntegerHash, Lattice};

use crate::failure::Result;
use crate::gallery::figure::{Context, Drawn};

/// Cells along a side.
const CELLS: u32 = 32;

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn> {
    let table = PermutationTable::new(context.seed);
    let printed = ChainedTable(table);
    let side = context.size;
    let place = |x: u32, y: u32| [x, y].map(|k| (f64::from(k) + 0.5) as f32 * CELLS as f32 / side as f32);
    let cell = |x: u32, y: u32| place(x, y).map(|k| k as i32);
    let word = |w: u32| w as f32 / 4_294_967_296.0;
    let columns = "Cells of random brightness in columns that are shifted against one another";
    let square = "Square cells of random brightness";
    let numbers: [([&str; 3], &dyn Fn(u32, u32) -> f32); 3] = [
        (["printed", "The texture, once for each axis, as printed", columns], &|x, y| {
            printed.prng(place(x, y), 1.0)
        }),
        (["permutation", "A permutation of 256", square], &|x, y| word(table.word(cell(x, y), 0))),
        (["hash", "An integer hash", square], &|x, y| word(IntegerHash.word(cell(x, y), context.seed))),
    ];
    let colour = |v: f32| hex(0x20_3a5c).lerp(hex(0xf4_dfb0), v);
    let drawn =
        Drawn::pictures(3, numbers, |number| Ok(Image::from_fn(side, side, |x, y| colour(number(x, y)))))?;
    Ok(drawn.fact("cells", CELLS))
}
