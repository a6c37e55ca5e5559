//! Random numbers of lattice cells: the thesis's texture, a permutation and a hash.

use asperity_render::image::{Image, tone::hex};
use asperity_shading::noise::lattice::{ChainedTable, PermutationTable};
use asperity_shading::noise::{IntegerHash, Lattice};
use glam::UVec2;

use crate::figure::{Context, Drawn, Shown};
use asperity::failure::Result;

/// Cells along a side.
const CELLS: u32 = 32;

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn> {
    let table = PermutationTable::new(context.seed);
    let printed = ChainedTable(table);
    let side = context.size;
    let place =
        |pixel: UVec2| pixel.to_array().map(|k| (f64::from(k) + 0.5) as f32 * CELLS as f32 / side as f32);
    let cell = |pixel| place(pixel).map(|k| k as i32);
    let word = |w: u32| w as f32 / 4_294_967_296.0;
    let columns = "Cells of random brightness in columns shifted against each other";
    let square = "Square cells of random brightness";
    let numbers: [([&str; 3], Shown<'_, UVec2, f32>); 3] = [
        (["printed", "The texture, once for each axis, as printed", columns], &|pixel| {
            printed.prng(place(pixel), 1.0)
        }),
        (["permutation", "A permutation of 256", square], &|pixel| word(table.word(cell(pixel), 0))),
        (["hash", "An integer hash", square], &|pixel| word(IntegerHash.word(cell(pixel), context.seed))),
    ];
    let color = |v: f32| hex(0x20_3a5c).lerp(hex(0xf4_dfb0), v);
    let drawn = Drawn::pictures(3, numbers, |number| {
        Ok(Image::from_fn(side, side, |x, y| color(number(UVec2::new(x, y)))))
    })?;
    Ok(drawn.fact("cells", CELLS))
}
