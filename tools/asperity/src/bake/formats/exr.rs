//! Tiled OpenEXR with all mip levels, written tile by tile.

use std::io::{Seek, Write};

use asperity_render::image::tone::linear;
use exr::block::writer::SequentialBlocksCompressor;
use exr::block::{UncompressedBlock, enumerate_ordered_header_block_indices};
use exr::math::RoundingMode;
use exr::meta::attribute::{ChannelDescription, LevelMode, LineOrder, SampleType, Text, TileDescription};
use exr::meta::{BlockDescription, header::Header};
use exr::prelude::{Compression, SmallVec, Vec2, f16};

use crate::bake::maps::{Map, heights};
use crate::bake::scratch::BAND;
use crate::bake::set::MapLevels;
use crate::failure::{Failure, Result};

/// Writes all levels of a map: linear half floats, and `f32` for heights in units of the side.
pub(crate) fn write(file: &mut (impl Write + Seek), map: &MapLevels<'_>) -> Result<()> {
    let side = map.side(0);
    let sample = if map.map == Map::Height { SampleType::F32 } else { SampleType::F16 };
    // The format requires alphabetical order.
    let names: &[&str] = if map.map.channels() == 3 { &["B", "G", "R"] } else { &["Y"] };
    let channels: SmallVec<[ChannelDescription; 5]> = names
        .iter()
        .map(|name| ChannelDescription::new(Text::new_or_panic(name), sample, map.map == Map::BaseColor))
        .collect();
    let tile = side.min(BAND);
    let blocks = BlockDescription::Tiles(TileDescription {
        tile_size: Vec2(tile, tile),
        level_mode: LevelMode::MipMap,
        rounding_mode: RoundingMode::Down,
    });
    let header = Header::new(Text::new_or_panic(map.map.name()), (side, side), channels).with_encoding(
        Compression::ZIP16,
        blocks,
        LineOrder::Increasing,
    );
    let mut stopped: Option<Failure> = None;
    let written = exr::block::write(file, SmallVec::from_iter([header]), true, |meta, chunks| {
        let mut compressor = SequentialBlocksCompressor::new(&meta, chunks);
        let mut band = Band::default();
        for (index, block) in enumerate_ordered_header_block_indices(&meta.headers) {
            let (level, Vec2(column, row)) = (block.level.x() as u32, block.pixel_position);
            let Vec2(width, rows) = block.pixel_size;
            if band.place != Some((level, row)) {
                match Band::new(map, level, row, rows) {
                    Ok(next) => band = next,
                    Err(error) => {
                        stopped = Some(error);
                        return Err(exr::error::Error::Aborted);
                    }
                }
            }
            let data = band.block(column, width, names.len());
            compressor.compress_block(index, UncompressedBlock { index: block, data })?;
        }
        Ok(())
    });
    match (stopped, written) {
        (Some(error), _) => Err(error),
        (None, Err(exr::error::Error::Io(cause))) => Err(cause.into()),
        (None, written) => Ok(written?),
    }
}

/// Rows of a level in the file's number type, channel after channel.
#[derive(Default)]
struct Band {
    /// The level and the first row.
    place: Option<(u32, usize)>,
    side: usize,
    /// All rows of each channel, in native byte order.
    channels: Vec<Vec<u8>>,
    /// Bytes per number.
    width: usize,
}

impl Band {
    fn new(map: &MapLevels<'_>, level: u32, row: usize, rows: usize) -> Result<Self> {
        let (side, place) = (map.side(level), Some((level, row)));
        if map.map == Map::Height {
            let planes = map.planes(level, row, rows)?;
            let channel = planes.first().map(|plane| heights(plane).flat_map(f32::to_ne_bytes).collect());
            return Ok(Self { place, side, channels: channel.into_iter().collect(), width: 4 });
        }
        let (texels, count) = (map.rows(level, row, rows)?, map.map.channels());
        let number = |word: u16| {
            let share = f32::from(word) / 65_535.0;
            f16::from_f32(if map.map == Map::BaseColor { linear(share) } else { share })
        };
        let channel = |channel: usize| {
            texels.iter().skip(channel).step_by(count).flat_map(|&word| number(word).to_ne_bytes()).collect()
        };
        // Blue first.
        Ok(Self { place, side, channels: (0..count).rev().map(channel).collect(), width: 2 })
    }

    /// Returns the bytes of a block: line by line, the numbers of each channel.
    fn block(&self, column: usize, width: usize, channels: usize) -> Vec<u8> {
        let line = self.side * self.width;
        let rows = self.channels.first().map_or(0, |channel| channel.len() / line);
        let mut bytes = Vec::with_capacity(rows * width * self.width * channels);
        for row in 0..rows {
            for channel in &self.channels {
                let first = row * line + column * self.width;
                bytes.extend_from_slice(&channel[first..first + width * self.width]);
            }
        }
        bytes
    }
}
