//! Maps of a texture as arrays of numbers, without files.

use std::sync::atomic::AtomicBool;

use crate::bake::maps::{Map, heights};
use crate::bake::scratch::{Levels, Scratch};
use crate::bake::set::{MapLevels, Set};
use crate::bake::{fill, options};
use crate::cli::bake::Bake;
use crate::failure::{Interrupted, Result};
use crate::output::Output;
use crate::progress;

/// A map as numbers, from the top left, row by row.
pub struct Array {
    /// Its name, as of its file.
    pub name: &'static str,
    /// Texels along a side.
    pub side: usize,
    /// Numbers per texel.
    pub channels: usize,
    /// Heights in sides of the texture, components of normals in [−1, 1], others in [0, 1].
    pub numbers: Vec<f32>,
}

/// The maps that are returned; the others are combinations of them.
const MAPS: [Map; 6] =
    [Map::BaseColor, Map::NormalOpenGl, Map::Height, Map::Roughness, Map::Metallic, Map::Occlusion];

/// Bakes the request to arrays. Options about files are ignored.
pub(crate) fn arrays(wanted: &Bake, interrupted: &AtomicBool) -> Result<Vec<Array>> {
    let plan = options::plan(wanted, 1)?;
    let folder = tempfile::tempdir()?;
    let output = Output::new(folder.path())?;
    let scratch = Scratch::new(&plan, &output, &[])?;
    fill(&plan, &scratch, plan.some(None)?, interrupted)
        .map_err(|error| if Interrupted::check(interrupted).is_err() { Interrupted.into() } else { error })?;
    let (tops, bar) = (scratch.tops()?, progress::bar("read"));
    let levels = Levels { scratch: &scratch, tops: &tops };
    let set = Set { plan: &plan, levels: &levels, formats: &[], interrupted, bar: &bar };
    let maps = set.maps().into_iter().filter(|map| MAPS.contains(&map.map));
    let arrays = maps.map(|map| array(&map, plan.size as usize)).collect();
    bar.finish_and_clear();
    arrays
}

fn array(map: &MapLevels<'_>, size: usize) -> Result<Array> {
    let (side, channels) = (map.side(0), map.map.channels());
    let numbers: Vec<f32> = if map.map == Map::Height {
        map.planes(0, 0, side)?.iter().flat_map(|plane| heights(plane)).collect()
    } else {
        let (scale, offset) = if map.map == Map::NormalOpenGl { (2.0, -1.0) } else { (1.0, 0.0) };
        let texels = map.rows(0, 0, side)?;
        texels.iter().map(|&word| scale * (f32::from(word) / 65_535.0) + offset).collect()
    };
    // A uniform map has few texels.
    let numbers = if side == size { numbers } else { numbers[..channels].repeat(size * size) };
    Ok(Array { name: map.map.name(), side: size, channels, numbers })
}
