//! An image of linear radiance, row by row from the top left, and its way to an sRGB PNG.

use crate::{figure::Failure, tables::formats::exr};
use glam::Vec3;
use png::{BitDepth, ColorType, Encoder, EncodingError, SrgbRenderingIntent};

/// Linear RGB pixels.
#[derive(Clone)]
pub(crate) struct Image {
    pub(crate) width: u32,
    pub(crate) height: u32,
    /// `width · height` pixels from the top left.
    pub(crate) pixels: Vec<Vec3>,
}

impl Image {
    /// The image whose pixel in column `x` and row `y` is `f(x, y)`.
    pub(crate) fn from_fn(width: u32, height: u32, mut f: impl FnMut(u32, u32) -> Vec3) -> Self {
        let pixels =
            (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| f(x, y)).collect();
        Self { width, height, pixels }
    }

    /// The pixel in column `x` and row `y`; black outside the image.
    #[cfg(test)]
    pub(crate) fn at(&self, x: u32, y: u32) -> Vec3 {
        let inside = x < self.width && y < self.height;
        let index = y as usize * self.width as usize + x as usize;
        if inside { self.pixels.get(index).copied().unwrap_or(Vec3::ZERO) } else { Vec3::ZERO }
    }

    /// Every pixel times `exposure`, then through [`shoulder`].
    pub(crate) fn exposed(mut self, exposure: f32) -> Self {
        for pixel in &mut self.pixels {
            let p = *pixel * exposure;
            *pixel = Vec3::new(shoulder(p.x), shoulder(p.y), shoulder(p.z));
        }
        self
    }

    /// Every pixel times `exposure`, then through [`filmic`].
    pub(crate) fn filmic(mut self, exposure: f32) -> Self {
        for pixel in &mut self.pixels {
            let p = *pixel * exposure;
            *pixel = Vec3::new(filmic(p.x), filmic(p.y), filmic(p.z));
        }
        self
    }

    /// Every pixel times `exposure`.
    pub(crate) fn scaled(mut self, exposure: f32) -> Self {
        for pixel in &mut self.pixels {
            *pixel *= exposure;
        }
        self
    }

    /// The bytes of an OpenEXR file of 32-bit floats, as they are.
    pub(crate) fn exr(&self) -> Result<Vec<u8>, Failure> {
        let plane = |axis: usize| self.pixels.iter().map(|p| p[axis]).collect::<Vec<f32>>();
        exr(self.width as usize, self.height as usize, &[("R", plane(0)), ("G", plane(1)), ("B", plane(2))])
    }

    /// The bytes of an 8-bit sRGB PNG; values outside `[0, 1]` and NaN are clamped.
    pub(crate) fn png(&self) -> Result<Vec<u8>, EncodingError> {
        let mut bytes = Vec::new();
        let mut encoder = Encoder::new(&mut bytes, self.width, self.height);
        encoder.set_color(ColorType::Rgb);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
        let samples: Vec<u8> =
            self.pixels.iter().flat_map(|p| [srgb_byte(p.x), srgb_byte(p.y), srgb_byte(p.z)]).collect();
        encoder.write_header()?.write_image_data(&samples)?;
        Ok(bytes)
    }
}

/// A soft shoulder: the identity up to 0.7, then an exponential approach to 1 with the same slope.
///
/// ```text
/// x ≤ k: x        x > k: k + (1 − k)(1 − exp(−(x − k)/(1 − k))),  k = 0.7
/// ```
pub(crate) fn shoulder(x: f32) -> f32 {
    const KNEE: f32 = 0.7;
    if x <= KNEE { x.max(0.0) } else { KNEE - (1.0 - KNEE) * (-(x - KNEE) / (1.0 - KNEE)).exp_m1() }
}

/// A curve with a toe and a shoulder, as film has: dark parts a little darker, lights rolled off towards 1.
///
/// ```text
/// x (a x + b)/(x (c x + d) + e),   a = 2.51, b = 0.03, c = 2.43, d = 0.59, e = 0.14,   of 0.6 times the radiance
/// ```
///
/// Narkowicz 2016, "ACES Filmic Tone Mapping Curve".
pub(crate) fn filmic(radiance: f32) -> f32 {
    let x = (0.6 * radiance).clamp(0.0, 1e6);
    (x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)).min(1.0)
}

/// Linear `[0, 1]` to the sRGB transfer curve, IEC 61966-2-1.
pub(crate) fn srgb(linear: f32) -> f32 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// The inverse of [`srgb`].
pub(crate) fn linear(srgb: f32) -> f32 {
    if srgb <= 0.040_45 { srgb / 12.92 } else { ((srgb + 0.055) / 1.055).powf(2.4) }
}

/// The linear colour of an sRGB hexadecimal, `0xRRGGBB`.
pub(crate) fn hex(rgb: u32) -> Vec3 {
    let [_, r, g, b] = rgb.to_be_bytes();
    Vec3::new(linear(f32::from(r) / 255.0), linear(f32::from(g) / 255.0), linear(f32::from(b) / 255.0))
}

fn srgb_byte(value: f32) -> u8 {
    let clamped = if value > 0.0 { value.min(1.0) } else { 0.0 };
    (srgb(clamped) * 255.0 + 0.5) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_written_png_reads_back() {
        let image = Image::from_fn(3, 2, |x, y| Vec3::new(x as f32 / 2.0, y as f32, f32::NAN));
        let bytes = image.png().unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        let mut buffer = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut buffer).unwrap();
        assert_eq!(&buffer[..9], [0, 0, 0, 188, 0, 0, 255, 0, 0]);
        assert_eq!(&buffer[9..], [0, 255, 0, 188, 255, 0, 255, 255, 0]);
        assert_eq!(image.at(1, 1).y, 1.0);
    }

    #[test]
    fn the_film_s_curve_increases_from_black_to_white() {
        assert_eq!([filmic(0.0), filmic(-1.0), filmic(f32::INFINITY)], [0.0, 0.0, 1.0]);
        let mut last = 0.0;
        for i in 1..200 {
            let y = filmic(i as f32 * 0.05);
            assert!(y >= last && y <= 1.0, "filmic({}) = {y}", i as f32 * 0.05);
            last = y;
        }
        // The middle grey of photographers stays about where it is.
        assert!((filmic(0.18) - 0.18).abs() < 0.05, "{}", filmic(0.18));
    }

    #[test]
    fn every_srgb_byte_survives_the_way_to_linear_and_back() {
        for byte in 0..=255_u8 {
            assert_eq!(srgb_byte(linear(f32::from(byte) / 255.0)), byte);
        }
    }

    #[test]
    fn the_shoulder_is_continuous_increasing_and_below_one() {
        assert!((shoulder(0.700_01) - shoulder(0.699_99) - 0.000_02).abs() < 1e-6);
        let mut last = 0.0;
        for i in 1..100 {
            let y = shoulder(i as f32 * 0.02);
            assert!(y > last && y < 1.0, "shoulder({}) = {y}", i as f32 * 0.02);
            last = y;
        }
    }
}
