//! Reads images as data: PNG of 8 and 16 bits, JPEG, WebP, Radiance HDR and OpenEXR, without a
//! transfer curve.

use std::path::Path;

use crate::{
    image::content::{Content, ImageFileError, check_size},
    image::{layers, radiance, samples::Samples},
    input_file,
};

/// The size of the largest image as `f32`.
const MOST_BYTES: u64 = 1 << 31;
/// An image in planes, each row by row from the top left.
#[derive(Debug, PartialEq)]
pub struct ImageFile {
    pub width: usize,
    pub height: usize,
    /// One plane of gray, two of x and y, or three. Integers are scaled to [0, 1], floats are
    /// unchanged.
    pub planes: Vec<Vec<f32>>,
    /// Whether samples are floats: linear light, or signed components of normals.
    pub floats: bool,
}

impl ImageFile {
    /// Reads a file.
    pub fn open(path: &Path, content: Content) -> Result<Self, ImageFileError> {
        let bytes = input_file::read(path, MOST_BYTES);
        Self::decode(&bytes.map_err(|error| ImageFileError::Unreadable { error })?, content)
    }

    /// Decodes a file. Nothing is allocated for pixels that the bytes cannot hold.
    pub fn decode(bytes: &[u8], content: Content) -> Result<Self, ImageFileError> {
        match *bytes {
            [] => Err(ImageFileError::Empty),
            [0x76, 0x2f, 0x31, 0x01, ..] => {
                let ([width, height], planes) = layers::decode(bytes, content)?;
                Ok(Self { width, height, planes, floats: true })
            }
            [b'#', b'?', ..] => decode_radiance(bytes),
            _ => Samples::open(bytes)?.map_or(Err(ImageFileError::UnknownFormat), |opened| {
                Ok(Self::of_integers(&opened.decode()?))
            }),
        }
    }

    fn of_integers(samples: &Samples) -> Self {
        let &Samples { width, height, channels, step, ref bytes } = samples;
        let top = if step == 2 { 65_535.0 } else { 255.0 };
        let value =
            |sample: &[u8]| sample.iter().fold(0, |sum, &byte| sum << 8 | u32::from(byte)) as f32 / top;
        let plane = |channel| bytes.chunks_exact(step).skip(channel).step_by(channels).map(value).collect();
        let planes = (0..if channels > 2 { 3 } else { 1 }).map(plane).collect();
        Self { width, height, planes, floats: false }
    }

    /// Returns red, green and blue, which are equal for a gray image.
    pub fn colors(&self) -> [&[f32]; 3] {
        [0, 1, 2].map(|k| self.planes.get(k).or(self.planes.first()).map_or(&[][..], Vec::as_slice))
    }

    /// Returns the mean of red, green and blue.
    pub fn gray(&self) -> Vec<f32> {
        let [r, g, b] = self.colors();
        if self.planes.len() == 1 {
            return r.to_vec();
        }
        r.iter().zip(g).zip(b).map(|((r, g), b)| (r + g + b) / 3.0).collect()
    }
}

fn decode_radiance(bytes: &[u8]) -> Result<ImageFile, ImageFileError> {
    let mut size = Ok(());
    let check = |width, height| {
        size = check_size(width, height, 4, bytes.len());
        size.is_ok()
    };
    let read = radiance::decode(bytes, check);
    let broken = |error: &str| ImageFileError::Broken { format: "Radiance HDR", error: error.into() };
    let ([width, height], pixels) = read.map_err(broken)?;
    size?;
    let planes = [0, 1, 2].map(|k| pixels.iter().map(|pixel| pixel[k]).collect()).into();
    Ok(ImageFile { width, height, planes, floats: true })
}

#[cfg(test)]
mod tests {
    use png::{BitDepth, ColorType};

    use super::*;
    use crate::image::formats::exr;

    /// Encodes a PNG. Without samples only the header is written.
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
    fn png_gray_with_alpha_and_color_planes() {
        let gray = encode([2, 1], ColorType::GrayscaleAlpha, BitDepth::Eight, &[255, 0, 51, 9]);
        assert_eq!(ImageFile::decode(&gray, Content::Colors).unwrap().planes, [[1.0, 0.2]]);
        let rgba = [[255, 0], [0, 0], [0, 51], [7, 7]].concat();
        let rgba = encode([1, 1], ColorType::Rgba, BitDepth::Sixteen, &rgba);
        let image = ImageFile::decode(&rgba, Content::Normals).unwrap();
        let [r, g, b] = image.colors();
        assert_eq!((r[0], g[0], b[0]), (65_280.0 / 65_535.0, 0.0, 51.0 / 65_535.0));
        assert_eq!(image.gray(), [(r[0] + b[0]) / 3.0]);
    }

    #[test]
    fn radiance_is_linear() {
        let bytes = b"#?RGBE\n\n-Y 1 +X 1\n\x80\x40\x00\x81".to_vec();
        let image = ImageFile::decode(&bytes, Content::Colors).unwrap();
        assert_eq!((image.floats, image.gray().len()), (true, 1));
        assert_eq!(image.colors()[0], [128.5 / 128.0]);
    }

    #[test]
    fn png_headers_are_checked_before_allocation() {
        for (size, message) in [
            ([20_000, 20_000], "an image must have 1 to 134217728 pixels, got 20000 × 20000"),
            ([4096, 4096], "cannot hold the 4096 × 4096 pixels"),
            ([8, 9], "cannot decode the PNG"),
        ] {
            let header = encode(size, ColorType::Grayscale, BitDepth::Eight, &[]);
            let error = ImageFile::decode(&header, Content::Colors).unwrap_err().to_string();
            assert!(error.contains(message), "{error}");
        }
    }

    #[test]
    fn images_read_back_and_errors() {
        let texels = vec![0.25, f32::MAX, 0.0, -1.0, 1.0, 2.0, 3.0, 4.0];
        let good = exr(4, 2, [("Y", texels.clone()), ("A", vec![1.0; 8])]).unwrap();
        let image = ImageFile::decode(&good.clone(), Content::Colors).unwrap();
        assert_eq!((image.width, image.height, image.planes), (4, 2, vec![texels]));
        let claiming = |width: i32, height: i32| {
            let mut bytes = good.clone();
            for name in [&b"dataWindow\0box2i\0"[..], b"displayWindow\0box2i\0"] {
                let at = bytes.windows(name.len()).position(|w| w == name).unwrap() + name.len() + 12;
                bytes[at..at + 4].copy_from_slice(&(width - 1).to_le_bytes());
                bytes[at + 4..at + 8].copy_from_slice(&(height - 1).to_le_bytes());
            }
            bytes
        };
        let alpha = exr(1, 1, [("A", vec![1.0])]).unwrap();
        for (bytes, message) in [
            (claiming(20_000, 20_000), "an image must have 1 to 134217728 pixels"),
            (claiming(4, 4_000_000), "cannot hold the 4 × 4000000 pixels"),
            (good[..20].to_vec(), "cannot decode the OpenEXR file"),
            (alpha, "the image has only an alpha channel"),
            (
                b"GIF89a".to_vec(),
                "unsupported image format (expected PNG, JPEG, WebP, Radiance HDR or OpenEXR)",
            ),
            (vec![0xff, 0xd8, 0xff, 0xe0], "cannot decode the JPEG"),
            (b"RIFF\x04\0\0\0WEBP".to_vec(), "cannot decode the WebP"),
            (b"#?RGBE\n\n-Y 20000 +X 20000\n".to_vec(), "an image must have 1 to 134217728 pixels"),
            (
                b"#?RGBE\n\n-Y 2 +X 2\n".to_vec(),
                "cannot decode the Radiance HDR: file ends within the pixel data",
            ),
            (Vec::new(), "the file is empty"),
        ] {
            let error = ImageFile::decode(&bytes, Content::Colors).unwrap_err().to_string();
            assert!(error.contains(message), "{error}");
        }
    }
}
