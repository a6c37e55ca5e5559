//! An image of linear radiance, row by row from the top left, and its file encodings.

pub mod content;
pub mod formats;
mod layers;
mod radiance;
pub mod read;
mod samples;
pub mod texture_map;
pub mod tone;

use std::io::{Cursor, Seek, Write};
use std::path::Path;

use exr::prelude::{Encoding, Image as EncodedImage, SpecificChannels, Vec2, WritableImage};
use glam::Vec3;
use image_webp::WebPEncoder;
use png::{BitDepth, ColorType, Encoder, SrgbRenderingIntent};
use rayon::prelude::*;

use crate::{
    failure::Failure,
    image::tone::{filmic, shoulder, srgb_byte},
};

/// Output image formats.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    Png,
    Jpeg,
    WebP,
    Exr,
}

impl Format {
    /// Returns the format of a file by its extension.
    pub fn of(file: &Path) -> Option<Self> {
        match file.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "png" => Some(Self::Png),
            "jpg" | "jpeg" => Some(Self::Jpeg),
            "webp" => Some(Self::WebP),
            "exr" => Some(Self::Exr),
            _ => None,
        }
    }
}

/// Linear RGB pixels.
#[derive(Clone)]
pub struct Image {
    pub width: u32,
    pub height: u32,
    /// `width · height` pixels from the top left.
    pub pixels: Vec<Vec3>,
}

impl Image {
    /// Creates the image whose pixel in column `x` and row `y` is `f(x, y)`.
    ///
    /// Rows are computed on all cores.
    pub fn from_fn(width: u32, height: u32, f: impl Fn(u32, u32) -> Vec3 + Sync) -> Self {
        let row = |y| (0..width).map(|x| f(x, y)).collect::<Vec<_>>();
        let pixels = (0..height).into_par_iter().flat_map_iter(row).collect();
        Self { width, height, pixels }
    }

    /// Multiplies every pixel by `exposure`, then applies [`shoulder`].
    pub fn exposed(self, exposure: f32) -> Self {
        self.map(|p| (p * exposure).map(shoulder))
    }

    /// Multiplies every pixel by `exposure`, then applies [`filmic`].
    pub fn filmic(self, exposure: f32) -> Self {
        self.map(|p| (p * exposure).map(filmic))
    }

    /// Applies a function to every pixel.
    pub fn map(mut self, of: impl Fn(Vec3) -> Vec3) -> Self {
        self.pixels.iter_mut().for_each(|pixel| *pixel = of(*pixel));
        self
    }

    /// Encodes the image, with the bytes that [`write`](Self::write) writes.
    pub fn encode(&self, format: Format) -> Result<Vec<u8>, Failure> {
        let mut bytes = Cursor::new(Vec::new());
        self.write(format, &mut bytes)?;
        Ok(bytes.into_inner())
    }

    /// Writes a file in a format: OpenEXR with unmodified 32-bit floats, or 8-bit sRGB, where NaN
    /// and values outside `[0, 1]` are clamped.
    ///
    /// JPEG has quality 95 without chroma subsampling, and WebP is lossless. OpenEXR and PNG are
    /// written row by row and need no memory beyond the image.
    pub fn write(&self, format: Format, file: &mut (impl Write + Seek)) -> Result<(), Failure> {
        let &Self { width, height, ref pixels } = self;
        match format {
            Format::Png => {
                let mut encoder = Encoder::new(file, width, height);
                encoder.set_color(ColorType::Rgb);
                encoder.set_depth(BitDepth::Eight);
                encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
                let mut writer = encoder.write_header()?;
                let mut rows = writer.stream_writer()?;
                pixels.chunks(width.max(1) as usize).try_for_each(|row| rows.write_all(&srgb_bytes(row)))?;
                rows.finish()?;
            }
            Format::Exr => {
                let size = (width as usize, height as usize);
                let pixel = |Vec2(x, y)| <(f32, f32, f32)>::from(pixels[y * size.0 + x]);
                let image = EncodedImage::from_encoded_channels(
                    size,
                    Encoding::UNCOMPRESSED,
                    SpecificChannels::rgb(pixel),
                );
                image.write().non_parallel().to_buffered(file)?;
            }
            Format::Jpeg => {
                let mut encoder = jpeg_encoder::Encoder::new(file, 95);
                encoder.set_sampling_factor(jpeg_encoder::SamplingFactor::F_1_1);
                let [width, height] = [width, height].map(u16::try_from);
                encoder.encode(&srgb_bytes(pixels), width?, height?, jpeg_encoder::ColorType::Rgb)?;
            }
            Format::WebP => {
                WebPEncoder::new(file).encode(
                    &srgb_bytes(pixels),
                    width,
                    height,
                    image_webp::ColorType::Rgb8,
                )?;
            }
        }
        Ok(())
    }
}

fn srgb_bytes(pixels: &[Vec3]) -> Vec<u8> {
    pixels.iter().flat_map(|p| p.to_array().map(srgb_byte)).collect()
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::*;
    use crate::image::content::Content;
    use crate::image::read::ImageFile;

    #[test]
    fn written_image_reads_back_in_the_format_of_its_extension() {
        let image = Image::from_fn(3, 2, |x, y| Vec3::new(x as f32 / 2.0, y as f32, f32::NAN));
        for (name, first, off) in [
            ("a.png", &b"\x89PNG"[..], 0.0),
            ("b.JPG", &[0xff, 0xd8], 6.0),
            ("c.jpeg", &[0xff, 0xd8], 6.0),
            ("d.webp", b"RIFF", 0.0),
        ] {
            let bytes = image.encode(Format::of(Path::new(name)).unwrap()).unwrap();
            assert!(bytes.starts_with(first), "{name}");
            let planes = ImageFile::decode(&bytes, Content::Colors).unwrap().planes.into_iter().flatten();
            let expected =
                [[0.0, 188.0, 255.0].repeat(2), [[0.0; 3], [255.0; 3]].concat(), vec![0.0; 6]].concat();
            // libjpeg differs by 3 here at this quality.
            for (value, expected) in planes.zip(expected) {
                assert_abs_diff_eq!(value * 255.0, expected, epsilon = off + 1e-4);
            }
        }
        let exr = image.encode(Format::of(Path::new("e.exr")).unwrap()).unwrap();
        let exr = ImageFile::decode(&exr, Content::Colors).unwrap();
        assert_eq!(exr.colors()[0], [0.0, 0.5, 1.0].repeat(2));
        assert_eq!(["x.gif", "png", "x"].map(|name| Format::of(Path::new(name))), [None; 3]);
        assert_eq!(image.pixels[3 + 1].y, 1.0);
    }
}
