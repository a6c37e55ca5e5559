//! Images from files, PNG of 8 and 16 bits and OpenEXR, as data: no transfer curve, alpha left out.

use std::{fs, io::Cursor, path::Path};

use asperity_ndf_sampling::MAX_TEXELS;
use exr::{
    meta::MetaData,
    prelude::{ReadChannels, ReadLayers},
};

use crate::failure::Failure;

/// No deflated data grows by more than this: a header that claims more than its file could hold is wrong.
const MOST_INFLATED: usize = 1032;

/// An image by planes, each row by row from the top left.
#[derive(Debug, PartialEq)]
pub struct ImageFile {
    pub width: usize,
    pub height: usize,
    /// The channels but alpha, by name: `Y`, or `R`, `G`, `B`; PNG samples in [0, 1], OpenEXR's as they are.
    pub planes: Vec<(String, Vec<f32>)>,
    /// Signed samples, as OpenEXR has them.
    pub signed: bool,
}

impl ImageFile {
    /// Reads a file.
    pub fn open(path: &Path) -> Result<Self, ImageFileError> {
        Self::decode(fs::read(path).map_err(|error| ImageFileError::Unreadable { error })?)
    }

    /// Decodes a file's bytes. Nothing is allocated for pixels that the bytes cannot hold.
    pub fn decode(bytes: Vec<u8>) -> Result<Self, ImageFileError> {
        match bytes[..] {
            [] => Err(ImageFileError::Empty),
            [0x89, b'P', b'N', b'G', ..] => decode_png(&bytes),
            [0x76, 0x2f, 0x31, 0x01, ..] => decode_exr(bytes),
            _ => Err(ImageFileError::UnknownFormat),
        }
    }

    /// The mean of all planes.
    pub fn grey(&self) -> Vec<f32> {
        let count = self.planes.len().max(1) as f32;
        (0..self.width * self.height)
            .map(|i| self.planes.iter().filter_map(|(_, plane)| plane.get(i)).sum::<f32>() / count)
            .collect()
    }

    /// The planes of three components, by the first set of names that the file has.
    pub fn components(&self, names: &[[&str; 3]]) -> Option<[&[f32]; 3]> {
        let plane = |name: &str| {
            let found = self.planes.iter().find(|(own, _)| own.eq_ignore_ascii_case(name))?;
            Some(found.1.as_slice())
        };
        names.iter().find_map(|&[x, y, z]| Some([plane(x)?, plane(y)?, plane(z)?]))
    }
}

/// Refuses sizes that no density has, before anything is allocated.
fn check_size(width: usize, height: usize) -> Result<(), ImageFileError> {
    let right = width.checked_mul(height).is_some_and(|pixels| (1..=MAX_TEXELS).contains(&pixels));
    if right { Ok(()) } else { Err(ImageFileError::Size { width, height }) }
}

fn decode_png(bytes: &[u8]) -> Result<ImageFile, ImageFileError> {
    let broken = |error: png::DecodingError| ImageFileError::Broken { format: "PNG", error: error.into() };
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(broken)?;
    let (width, height) = (reader.info().width as usize, reader.info().height as usize);
    check_size(width, height)?;
    let length = reader.output_buffer_size().ok_or(ImageFileError::Size { width, height })?;
    if length > bytes.len().saturating_mul(MOST_INFLATED) {
        return Err(ImageFileError::Truncated { width, height, bytes: bytes.len() });
    }
    let mut samples = vec![0; length];
    let info = reader.next_frame(&mut samples).map_err(broken)?;
    let channels = info.color_type.samples();
    let wide = info.bit_depth == png::BitDepth::Sixteen;
    let (step, top) = if wide { (2, 65_535.0) } else { (1, 255.0) };
    let names: &[&str] = if channels > 2 { &["R", "G", "B"] } else { &["Y"] };
    let value = |sample: &[u8]| sample.iter().fold(0, |sum, &byte| sum << 8 | u32::from(byte)) as f32 / top;
    let plane = |channel| samples.chunks_exact(step).skip(channel).step_by(channels).map(value).collect();
    let planes = names.iter().enumerate().map(|(k, &name)| (name.to_owned(), plane(k))).collect();
    Ok(ImageFile { width, height, planes, signed: false })
}

fn decode_exr(bytes: Vec<u8>) -> Result<ImageFile, ImageFileError> {
    let broken =
        |error: exr::error::Error| ImageFileError::Broken { format: "OpenEXR file", error: error.into() };
    let meta = MetaData::read_from_buffered(Cursor::new(&bytes), false).map_err(broken)?;
    for header in &meta.headers {
        let (width, height) = (header.layer_size.0, header.layer_size.1);
        check_size(width, height)?;
        // Every chunk has its place in a table of eight bytes each.
        if header.chunk_count.saturating_mul(8) > bytes.len() {
            return Err(ImageFileError::Truncated { width, height, bytes: bytes.len() });
        }
    }
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(bytes))
        .map_err(broken)?;
    let layer = image.layer_data;
    let planes: Vec<(String, Vec<f32>)> = layer
        .channel_data
        .list
        .iter()
        .filter(|channel| !channel.name.eq_case_insensitive("a"))
        .map(|channel| (channel.name.to_string(), channel.sample_data.values_as_f32().collect()))
        .collect();
    if planes.is_empty() {
        return Err(ImageFileError::OnlyAlpha);
    }
    Ok(ImageFile { width: layer.size.0, height: layer.size.1, planes, signed: true })
}

/// Why a file is not an image of data.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ImageFileError {
    #[error("the file cannot be read: {error}")]
    Unreadable {
        #[source]
        error: std::io::Error,
    },
    #[error("the file is empty")]
    Empty,
    #[error("the file is neither PNG nor OpenEXR")]
    UnknownFormat,
    #[error("an image must have 1 to {MAX_TEXELS} pixels, got {width} × {height}")]
    Size { width: usize, height: usize },
    #[error("{bytes} bytes cannot hold the {width} × {height} pixels that the header claims")]
    Truncated { width: usize, height: usize, bytes: usize },
    #[error("the image has no channel but alpha")]
    OnlyAlpha,
    /// The file breaks its format, as the decoder has it.
    #[error("the {format} cannot be decoded: {error}")]
    Broken {
        format: &'static str,
        #[source]
        error: Failure,
    },
}

#[cfg(test)]
mod tests {
    use png::{BitDepth, ColorType};

    use super::*;
    use crate::image::formats::exr;

    /// A PNG; without samples its header alone tells a size.
    fn encode(size: [u32; 2], color: ColorType, depth: BitDepth, samples: &[u8]) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, size[0], size[1]);
        encoder.set_color(color);
        encoder.set_depth(depth);
        let mut writer = encoder.write_header().unwrap();
        let written = match samples {
            [] => writer.write_chunk(png::chunk::IDAT, &[]),
            samples => writer.write_image_data(samples),
        };
        written.unwrap();
        drop(writer);
        bytes
    }

    #[test]
    fn grey_with_alpha_keeps_its_grey_and_colours_their_planes() {
        let grey = encode([2, 1], ColorType::GrayscaleAlpha, BitDepth::Eight, &[255, 0, 51, 9]);
        assert_eq!(ImageFile::decode(grey).unwrap().planes, [("Y".to_owned(), vec![1.0, 0.2])]);
        let rgba = [[255, 0], [0, 0], [0, 51], [7, 7]].concat();
        let image = ImageFile::decode(encode([1, 1], ColorType::Rgba, BitDepth::Sixteen, &rgba)).unwrap();
        let [r, g, b] = image.components(&[["n.X", "n.Y", "n.Z"], ["R", "G", "B"]]).unwrap();
        assert_eq!((r[0], g[0], b[0]), (65_280.0 / 65_535.0, 0.0, 51.0 / 65_535.0));
        assert_eq!(image.grey(), [(r[0] + b[0]) / 3.0]);
    }

    #[test]
    fn headers_without_data_are_refused_before_anything_is_allocated() {
        for (size, message) in [
            ([10_000, 10_000], "an image must have 1 to 16777216 pixels, got 10000 × 10000"),
            ([4096, 4096], "cannot hold the 4096 × 4096 pixels"),
            ([8, 9], "the PNG cannot be decoded"),
        ] {
            let header = encode(size, ColorType::Grayscale, BitDepth::Eight, &[]);
            let error = ImageFile::decode(header).unwrap_err().to_string();
            assert!(error.contains(message), "{error}");
        }
    }

    #[test]
    fn textures_read_back_and_without_data_are_refused() {
        let texels = vec![0.25, f32::MAX, 0.0, -1.0, 1.0, 2.0, 3.0, 4.0];
        let good = exr(4, 2, &[("Y", texels.clone()), ("A", vec![1.0; 8])]).unwrap();
        let image = ImageFile::decode(good.clone()).unwrap();
        assert_eq!((image.width, image.height, image.planes), (4, 2, vec![("Y".to_owned(), texels)]));
        let claiming = |width: i32, height: i32| {
            let mut bytes = good.clone();
            for name in [&b"dataWindow\0box2i\0"[..], b"displayWindow\0box2i\0"] {
                let at = bytes.windows(name.len()).position(|w| w == name).unwrap() + name.len() + 12;
                bytes[at..at + 4].copy_from_slice(&(width - 1).to_le_bytes());
                bytes[at + 4..at + 8].copy_from_slice(&(height - 1).to_le_bytes());
            }
            bytes
        };
        let alpha = exr(1, 1, &[("A", vec![1.0])]).unwrap();
        for (bytes, message) in [
            (claiming(10_000, 10_000), "an image must have 1 to 16777216 pixels"),
            (claiming(4, 4_000_000), "cannot hold the 4 × 4000000 pixels"),
            (good[..20].to_vec(), "the OpenEXR file cannot be decoded"),
            (alpha, "the image has no channel but alpha"),
            (b"GIF89a".to_vec(), "the file is neither PNG nor OpenEXR"),
            (Vec::new(), "the file is empty"),
        ] {
            let error = ImageFile::decode(bytes).unwrap_err().to_string();
            assert!(error.contains(message), "{error}");
        }
    }
}
