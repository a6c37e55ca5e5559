//! KTX2 files of color data with explicit mip levels: UASTC, ETC1S, or uncompressed.

use std::io::Read;

use asperity_render::image::read::ImageFile;
use basisu::{DecodeFlags, TargetFormat, Transcoder};
use ktx2::dfd::{Basic, ChannelTypeQualifiers, DataFormatFlags, SampleInformation};
use ktx2::{ColorModel, Format, Reader, SupercompressionScheme, TransferFunction};
use ruzstd::decoding::StreamingDecoder;
use ruzstd::encoding::{CompressionLevel, compress_to_vec};

use crate::cli::filter::FilteredFormat;
use crate::failure::Result;
use crate::ktx2_layout::{Layout, Texture};

/// A mip level in RGBA.
pub(super) struct Level {
    pub(super) size: [usize; 2],
    pub(super) rgba: Vec<u8>,
}

/// Encodes mip levels, the largest first.
pub(super) fn encode(levels: &[Level], format: FilteredFormat) -> Result<Vec<u8>> {
    let (vulkan, description) = match format {
        FilteredFormat::Uastc => (None, uastc()?),
        FilteredFormat::Zstd => {
            let format = Format::R8G8B8A8_UNORM;
            let (mut basic, _) = Basic::from_format(format).map_err(|error| format!("{error:?}"))?;
            // Required for data that are not colors.
            basic.color_primaries = None;
            (Some(format), basic)
        }
    };
    let stored = levels.iter().map(|level| {
        let texels = match format {
            FilteredFormat::Uastc => &blocks(level)?,
            FilteredFormat::Zstd => &level.rgba,
        };
        Ok((compress_to_vec(&texels[..], CompressionLevel::Fastest), texels.len()))
    });
    let stored = stored.collect::<Result<Vec<_>>>()?;
    let size = levels.first().map_or([0; 2], |level| level.size);
    Ok(container(vulkan, description, size, Some(SupercompressionScheme::Zstandard), &stored))
}

#[cfg(feature = "basis")]
fn blocks(level: &Level) -> Result<Vec<u8>> {
    let [width, height] = level.size.map(|side| side as u32);
    let threads = rayon::current_num_threads() as u32;
    Ok(asperity_uastc::encode(&level.rgba, width, height, threads)?)
}

#[cfg(not(feature = "basis"))]
fn blocks(_: &Level) -> Result<Vec<u8>> {
    Err("`--format uastc` needs a program with the feature `basis` (`cargo install --features basis`)".into())
}

/// Returns the description of linear UASTC without alpha.
fn uastc() -> Result<Basic> {
    let [one, four, bits] = [1, 4, 128].map(std::num::NonZeroU8::new);
    let (Some(one), Some(four), Some(bits)) = (one, four, bits) else { return Err("".into()) };
    Ok(Basic {
        color_model: Some(ColorModel::UASTC),
        color_primaries: None,
        transfer_function: Some(TransferFunction::Linear),
        flags: DataFormatFlags::empty(),
        texel_block_dimensions: [four, four, one, one],
        bytes_planes: [16, 0, 0, 0, 0, 0, 0, 0],
        sample_information: vec![SampleInformation {
            bit_offset: 0,
            bit_length: bits,
            // `KHR_DF_CHANNEL_UASTC_RGB`.
            channel_type: 0,
            channel_type_qualifiers: ChannelTypeQualifiers::empty(),
            sample_positions: [0; 4],
            lower: 0,
            upper: u32::MAX,
        }],
    })
}

/// Encodes a file from the bytes of its levels, each with its length before supercompression.
fn container(
    format: Option<Format>,
    description: Basic,
    size: [usize; 2],
    scheme: Option<SupercompressionScheme>,
    levels: &[(Vec<u8>, usize)],
) -> Vec<u8> {
    let alignment = if scheme.is_some() { 1 } else { 16 };
    let lengths = levels.iter().map(|(bytes, length)| [bytes.len(), *length].map(|length| length as u64));
    let texture = Texture { format, type_size: 1, description, size, scheme, alignment };
    let Layout { head: mut file, places } = texture.layout(&lengths.collect::<Vec<_>>());
    for ((bytes, _), place) in levels.iter().rev().zip(places) {
        file.resize(place.byte_offset as usize, 0);
        file.extend_from_slice(bytes);
    }
    file
}

/// Texels that any file may claim: 8192 on a side.
const MOST_TEXELS: usize = 1 << 26;

/// Decodes the first level.
pub(super) fn decode(bytes: &[u8]) -> Result<ImageFile> {
    let broken = |error: &str| format!("cannot decode the KTX2: {error}");
    let reader = Reader::new(bytes).map_err(|error| broken(&error.to_string()))?;
    let header = reader.header();
    let [width, height] = [header.pixel_width as usize, header.pixel_height as usize];
    let texels = width.checked_mul(height).filter(|texels| *texels > 0);
    let texels = texels
        .filter(|texels| *texels <= MOST_TEXELS.max(bytes.len()))
        .ok_or_else(|| broken(&format!("{} bytes cannot hold {width} × {height} texels", bytes.len())))?;
    if header.face_count != 1 || header.layer_count > 1 || header.pixel_depth > 1 {
        return Err(broken("a texture must be two-dimensional").into());
    }
    let (format, model) = (header.format, reader.color_model());
    let channels = match (format, model) {
        (Some(Format::R8G8B8A8_UNORM | Format::R8G8B8A8_SRGB), _) => 4,
        (Some(Format::R8G8B8_UNORM | Format::R8G8B8_SRGB), _) => 3,
        (None, Some(ColorModel::UASTC | ColorModel::ETC1S)) => 0,
        _ => return Err(broken("expected UASTC, ETC1S, or 8 bits per channel").into()),
    };
    let level = reader.levels().next().ok_or_else(|| broken("it has no levels"))?.data;
    let blocks = width.div_ceil(4) * height.div_ceil(4);
    let length = if channels > 0 { channels * texels } else { 16 * blocks };
    let plain = match header.supercompression_scheme {
        Some(SupercompressionScheme::Zstandard) => {
            let mut plain = Vec::new();
            let mut decoder = StreamingDecoder::new(level).map_err(|error| broken(&error.to_string()))?;
            // Errors of the decoder may have several lines.
            let read = decoder.by_ref().take(length as u64).read_to_end(&mut plain);
            read.map_err(|_| broken("invalid Zstandard data"))?;
            plain
        }
        Some(SupercompressionScheme::BasisLZ) if channels == 0 => Vec::new(),
        None => level.to_vec(),
        Some(_) => return Err(broken("unsupported supercompression").into()),
    };
    let lz = header.supercompression_scheme == Some(SupercompressionScheme::BasisLZ);
    if !lz && plain.len() < length {
        return Err(broken("the file ends within its texels").into());
    }
    let (rgba, step) = if channels > 0 {
        (plain, channels)
    } else if lz {
        (transcode(bytes)?, 4)
    } else {
        (transcode(&container(None, uastc()?, [width, height], None, &[(plain, length)]))?, 4)
    };
    let plane = |channel| rgba.iter().skip(channel).step_by(step).map(|byte| f32::from(*byte) / 255.0);
    let planes = [0, 1, 2].map(|channel| plane(channel).take(texels).collect()).into();
    Ok(ImageFile { width, height, planes, floats: false })
}

/// Decodes UASTC or ETC1S to RGBA.
fn transcode(file: &[u8]) -> Result<Vec<u8>> {
    let broken = |error: basisu::Error| format!("cannot decode the KTX2: {error:?}");
    let decoder = Transcoder::new(file).map_err(broken)?;
    Ok(decoder.transcode(0, TargetFormat::Rgba32, DecodeFlags::NONE).map_err(broken)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn levels() -> Vec<Level> {
        let level = |side: usize| {
            let texel = |k: usize| [255, (k % side * 12) as u8, (k / side * 3) as u8, 255];
            Level { size: [side; 2], rgba: (0..side * side).flat_map(texel).collect() }
        };
        [16, 8, 4, 2, 1].map(level).into()
    }

    /// The formats of this program, with the largest error of a channel.
    fn formats() -> impl Iterator<Item = (FilteredFormat, f32)> {
        let all = [(FilteredFormat::Zstd, 0.0), (FilteredFormat::Uastc, 3.0)];
        all.into_iter().take(if cfg!(feature = "basis") { 2 } else { 1 })
    }

    #[test]
    fn encode_decodes_with_all_levels() {
        for (format, tolerance) in formats() {
            let (levels, file) = (levels(), encode(&levels(), format).unwrap());
            let reader = Reader::new(&file[..]).unwrap();
            assert_eq!((reader.levels().len(), reader.color_primaries()), (5, None));
            assert_eq!(reader.transfer_function(), Some(TransferFunction::Linear));
            let image = decode(&file).unwrap();
            assert_eq!((image.width, image.height, image.planes.len()), (16, 16, 3));
            for (channel, plane) in image.planes.iter().enumerate() {
                for (got, texel) in plane.iter().zip(levels[0].rgba.as_chunks::<4>().0) {
                    let apart = (255.0 * got - f32::from(texel[channel])).abs();
                    assert!(apart <= tolerance, "{format:?}: {apart}");
                }
            }
        }
    }

    #[test]
    fn decode_cut_files_is_an_error() {
        for (format, _) in formats() {
            let file = encode(&levels(), format).unwrap();
            // The largest level is last.
            for length in 0..file.len() {
                let error = decode(&file[..length]).err().map(|error| error.to_string());
                assert!(error.is_some_and(|error| error.lines().count() == 1), "{format:?} {length}");
            }
            for at in 0..file.len() {
                let mut wrong = file.clone();
                wrong[at] ^= 0x55;
                drop(decode(&wrong));
            }
        }
    }
}
