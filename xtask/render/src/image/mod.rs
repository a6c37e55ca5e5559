//! An image of linear radiance, row by row from the top left, and its way to an sRGB PNG.

pub mod formats;
pub mod read;
pub mod tone;

use glam::Vec3;
use png::{BitDepth, ColorType, Encoder, EncodingError, SrgbRenderingIntent};

use crate::{
    failure::Failure,
    image::{
        formats::exr,
        tone::{filmic, shoulder, srgb_byte},
    },
};

/// Linear RGB pixels.
#[derive(Clone)]
pub struct Image {
    pub width: u32,
    pub height: u32,
    /// `width · height` pixels from the top left.
    pub pixels: Vec<Vec3>,
}

impl Image {
    /// The image whose pixel in column `x` and row `y` is `f(x, y)`.
    pub fn from_fn(width: u32, height: u32, mut f: impl FnMut(u32, u32) -> Vec3) -> Self {
        let pixels =
            (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| f(x, y)).collect();
        Self { width, height, pixels }
    }

    /// Every pixel times `exposure`, then through [`shoulder`].
    pub fn exposed(self, exposure: f32) -> Self {
        self.map(|p| (p * exposure).map(shoulder))
    }

    /// Every pixel times `exposure`, then through [`filmic`].
    pub fn filmic(self, exposure: f32) -> Self {
        self.map(|p| (p * exposure).map(filmic))
    }

    /// Every pixel through a function.
    pub fn map(mut self, of: impl Fn(Vec3) -> Vec3) -> Self {
        self.pixels.iter_mut().for_each(|pixel| *pixel = of(*pixel));
        self
    }

    /// The bytes of an OpenEXR file of 32-bit floats, as they are.
    pub fn exr(&self) -> Result<Vec<u8>, Failure> {
        let plane = |axis: usize| self.pixels.iter().map(|p| p[axis]).collect::<Vec<f32>>();
        exr(self.width as usize, self.height as usize, &[("R", plane(0)), ("G", plane(1)), ("B", plane(2))])
    }

    /// The bytes of an 8-bit sRGB PNG; values outside `[0, 1]` and NaN are clamped.
    pub fn png(&self) -> Result<Vec<u8>, EncodingError> {
        let mut bytes = Vec::new();
        let mut encoder = Encoder::new(&mut bytes, self.width, self.height);
        encoder.set_color(ColorType::Rgb);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
        let samples: Vec<u8> = self.pixels.iter().flat_map(|p| p.to_array().map(srgb_byte)).collect();
        encoder.write_header()?.write_image_data(&samples)?;
        Ok(bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::read::ImageFile;

    #[test]
    fn a_written_png_reads_back() {
        let image = Image::from_fn(3, 2, |x, y| Vec3::new(x as f32 / 2.0, y as f32, f32::NAN));
        let bytes = image.png().unwrap();
        let planes = ImageFile::decode(bytes).unwrap().planes.into_iter().map(|(_, plane)| plane);
        let bytes: Vec<_> = planes.map(|plane| plane.iter().map(|x| x * 255.0).collect::<Vec<_>>()).collect();
        assert_eq!(bytes, [[0.0, 188.0, 255.0].repeat(2), [[0.0; 3], [255.0; 3]].concat(), vec![0.0; 6]]);
        assert_eq!(image.pixels[3 + 1].y, 1.0);
    }
}
