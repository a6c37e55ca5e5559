//! PNG with 16 bits per channel, written row by row.

use std::io::Write;

use png::{BitDepth, ColorType, Compression, Encoder, SrgbRenderingIntent};

use crate::bake::maps::Map;
use crate::bake::scratch::BAND;
use crate::bake::set::MapLevels;
use crate::failure::Result;

/// Writes the finest level of a map.
pub(crate) fn write(file: impl Write, map: &MapLevels<'_>) -> Result<()> {
    let side = map.side(0) as u32;
    let mut encoder = Encoder::new(file, side, side);
    encoder.set_color(if map.map.channels() == 3 { ColorType::Rgb } else { ColorType::Grayscale });
    encoder.set_depth(BitDepth::Sixteen);
    encoder.set_compression(Compression::Fast);
    if map.map == Map::BaseColor {
        encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
    }
    let mut writer = encoder.write_header()?;
    let mut stream = writer.stream_writer_with_size(1 << 17)?;
    for row in (0..side as usize).step_by(BAND) {
        let texels = map.rows(0, row, BAND.min(side as usize - row))?;
        let bytes: Vec<u8> = texels.into_iter().flat_map(u16::to_be_bytes).collect();
        stream.write_all(&bytes)?;
    }
    stream.finish()?;
    Ok(())
}
