//! KTX2 with all mip levels in GPU block compression.

use std::io::Write;

use block_compression::encode::compress_rgba8;
use block_compression::{BC7Settings, CompressionVariant};
use exr::prelude::f16;
use ktx2::Format;
use ktx2::dfd::Basic;
use rayon::prelude::*;

use crate::bake::maps::Map;
use crate::bake::scratch::BAND;
use crate::bake::set::MapLevels;
use crate::failure::Result;
use crate::ktx2_layout::{Layout, Texture};

/// The texel format on the GPU.
#[derive(Clone, Copy)]
enum Texels {
    /// Blocks of 4 × 4 texels.
    Blocks(CompressionVariant),
    /// Half floats. Eight bits would quantize slopes of heights into steps, and web loaders do not
    /// read `R16_UNORM`.
    Halves,
}

/// Returns the format of a map, and its texels.
fn form(map: Map) -> (Format, Texels) {
    let bc7 = CompressionVariant::BC7(BC7Settings::opaque_very_fast());
    match map {
        Map::BaseColor => (Format::BC7_SRGB_BLOCK, Texels::Blocks(bc7)),
        Map::Packed => (Format::BC7_UNORM_BLOCK, Texels::Blocks(bc7)),
        // z is computed from x and y.
        Map::NormalOpenGl | Map::NormalDirectX => {
            (Format::BC5_UNORM_BLOCK, Texels::Blocks(CompressionVariant::BC5))
        }
        Map::Roughness | Map::Metallic | Map::Occlusion => {
            (Format::BC4_UNORM_BLOCK, Texels::Blocks(CompressionVariant::BC4))
        }
        Map::Height => (Format::R16_SFLOAT, Texels::Halves),
    }
}

impl Texels {
    /// Returns the bytes of a level of this side.
    fn bytes(self, side: usize) -> u64 {
        match self {
            Self::Blocks(variant) => {
                let padded = side.next_multiple_of(4) as u32;
                variant.blocks_byte_size(padded, padded) as u64
            }
            Self::Halves => 2 * (side * side) as u64,
        }
    }

    /// Returns the alignment of levels, a multiple of 4 and of the block size.
    fn alignment(self) -> u64 {
        match self {
            Self::Blocks(_) => self.bytes(4),
            Self::Halves => 4,
        }
    }
}

/// Writes all levels of a map.
pub(crate) fn write(file: &mut impl Write, map: &MapLevels<'_>) -> Result<()> {
    let (format, texels) = form(map.map);
    let (description, type_size) = Basic::from_format(format).map_err(|error| format!("{error:?}"))?;
    let count = map.last() + 1;
    let lengths: Vec<_> = (0..count).map(|level| [texels.bytes(map.side(level)); 2]).collect();
    let texture = Texture {
        format: Some(format),
        type_size,
        description,
        size: [map.side(0); 2],
        scheme: None,
        alignment: texels.alignment(),
    };
    let Layout { head, places } = texture.layout(&lengths);
    file.write_all(&head)?;
    let mut at = head.len() as u64;
    for (level, place) in (0..count).rev().zip(&places) {
        file.write_all(&vec![0; (place.byte_offset - at) as usize])?;
        at = place.byte_offset + place.byte_length;
        let side = map.side(level);
        for row in (0..side).step_by(BAND) {
            let rows = map.rows(level, row, BAND.min(side - row))?;
            match texels {
                Texels::Halves => {
                    let half = |&word: &u16| f16::from_f32(f32::from(word) / 65_535.0).to_le_bytes();
                    let bytes: Vec<u8> = rows.iter().flat_map(half).collect();
                    file.write_all(&bytes)?;
                }
                Texels::Blocks(variant) => {
                    file.write_all(&compressed(&rows, map.map.channels(), side, variant))?;
                }
            }
        }
    }
    Ok(())
}

/// Compresses rows of texels. Levels smaller than a block are padded with their last texel.
fn compressed(words: &[u16], channels: usize, side: usize, variant: CompressionVariant) -> Vec<u8> {
    let rows = words.len() / channels / side;
    let width = side.next_multiple_of(4);
    let of_row = |first: usize| {
        let texel = |k: usize| {
            let [row, column] = [first + k / width, k % width].map(|i| i.min(side - 1));
            let at = (row.min(rows - 1) * side + column) * channels;
            let byte =
                |channel: usize| ((u32::from(words[at + channel.min(channels - 1)]) + 128) / 257) as u8;
            [byte(0), byte(1), byte(2), 255]
        };
        let rgba: Vec<u8> = (0..4 * width).flat_map(texel).collect();
        let mut blocks = vec![0; variant.blocks_byte_size(width as u32, 4)];
        compress_rgba8(variant, &rgba, &mut blocks, width as u32, 4, 4 * width as u32);
        blocks
    };
    (0..rows.div_ceil(4)).into_par_iter().flat_map_iter(|row| of_row(4 * row)).collect()
}
