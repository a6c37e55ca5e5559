//! An image on a surface, as a glTF texture.

use std::sync::{Arc, LazyLock};

use glam::{Affine2, Vec2, Vec4};

use crate::image::{
    content::ImageFileError,
    samples::{OpenedSamples, Samples},
    tone::linear,
};

/// The texels of an image, row by row from the top left.
pub struct Texels {
    width: usize,
    height: usize,
    /// Gray or red, green, blue; then alpha, if the number is even.
    channels: usize,
    bytes: Vec<u8>,
}

/// An image file whose header is decoded.
pub struct OpenedTexels<'a>(OpenedSamples<'a>);

/// What a texture shows beyond a side of its image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wrap {
    Repeat,
    Mirror,
    Clamp,
}

/// An image with its place on the surface.
#[derive(Clone)]
pub struct TextureMap {
    pub texels: Arc<Texels>,
    /// The set of texture coordinates, 0 or 1.
    pub set: usize,
    /// Applied to the texture coordinates, whose v points down.
    pub transform: Affine2,
    /// Along u and v.
    pub wrap: [Wrap; 2],
    /// Whether the nearest texel is shown, instead of a bilinear blend of four.
    pub nearest: bool,
}

/// Linear values of sRGB bytes.
static LINEAR: LazyLock<[f32; 256]> =
    LazyLock::new(|| std::array::from_fn(|byte| linear(byte as f32 / 255.0)));

impl Texels {
    /// Decodes the header of a PNG, JPEG or WebP file. Nothing is allocated for texels.
    pub fn open(file: &[u8]) -> Result<OpenedTexels<'_>, ImageFileError> {
        Samples::open(file)?.map(OpenedTexels).ok_or(ImageFileError::UnknownTexture)
    }

    /// Returns a white texel.
    pub fn white() -> Self {
        Self { width: 1, height: 1, channels: 1, bytes: vec![255] }
    }

    /// Returns red, green, blue and alpha of a texel.
    fn texel(&self, index: usize) -> [u8; 4] {
        match self.bytes[index * self.channels..][..self.channels] {
            [gray] => [gray, gray, gray, 255],
            [gray, alpha] => [gray, gray, gray, alpha],
            [r, g, b] => [r, g, b, 255],
            [r, g, b, alpha, ..] => [r, g, b, alpha],
            [] => [0; 4],
        }
    }
}

impl OpenedTexels<'_> {
    /// Returns the number of texels that the header claims.
    pub const fn count(&self) -> usize {
        self.0.width * self.0.height
    }

    /// Decodes the texels, in 8 bits. The memory is that of the channels in the file, and three
    /// times as much for 16 bits.
    pub fn decode(self) -> Result<Texels, ImageFileError> {
        let Samples { width, height, channels, step, mut bytes } = self.0.decode()?;
        if step == 2 {
            // ⌊255 x / 65535 + ½⌋.
            let byte = |&sample: &[u8; 2]| (u32::from(u16::from_be_bytes(sample)) * 255 + 32_767) / 65_535;
            bytes = bytes.as_chunks::<2>().0.iter().map(|sample| byte(sample) as u8).collect();
        }
        Ok(Texels { width, height, channels, bytes })
    }
}

#[cfg(test)]
impl Texels {
    /// Returns an image of one texel.
    pub fn constant(texel: [u8; 4]) -> Self {
        Self { width: 1, height: 1, channels: 4, bytes: texel.into() }
    }
}

impl Wrap {
    /// Returns the texel of an index that may be outside the image.
    pub fn index(self, i: i64, count: usize) -> usize {
        let n = count as i64;
        let inside = match self {
            Self::Repeat => i.rem_euclid(n),
            Self::Mirror => {
                let i = i.rem_euclid(2 * n);
                i.min(2 * n - 1 - i)
            }
            Self::Clamp => i.clamp(0, n - 1),
        };
        inside as usize
    }
}

impl TextureMap {
    /// Returns linear red, green and blue of an image in sRGB, and its alpha.
    pub fn color(&self, uv: [Vec2; 2]) -> Vec4 {
        self.blended(uv, |[r, g, b, a]| {
            let [r, g, b] = [r, g, b].map(|byte| LINEAR[usize::from(byte)]);
            Vec4::new(r, g, b, f32::from(a) / 255.0)
        })
    }

    /// Returns the channels as they are, in `[0, 1]`.
    pub fn data(&self, uv: [Vec2; 2]) -> Vec4 {
        self.blended(uv, |texel| Vec4::from(texel.map(f32::from)) / 255.0)
    }

    /// Returns the value at a point, given its sets of texture coordinates.
    fn blended(&self, uv: [Vec2; 2], value: impl Fn([u8; 4]) -> Vec4) -> Vec4 {
        let texels = self.texels.as_ref();
        let Texels { width, height, .. } = texels;
        let uv = self.transform.transform_point2(uv[self.set]);
        let size = Vec2::new(*width as f32, *height as f32);
        // `as` saturates, and turns NaN into 0.
        let at = |x: i64, y: i64| {
            let (x, y) = (self.wrap[0].index(x, *width), self.wrap[1].index(y, *height));
            value(texels.texel(y * width + x))
        };
        if self.nearest {
            let corner = (uv * size).floor();
            return at(corner.x as i64, corner.y as i64);
        }
        let place = uv * size - 0.5;
        let (corner, part) = (place.floor(), (place - place.floor()).clamp(Vec2::ZERO, Vec2::ONE));
        let part = if part.is_finite() { part } else { Vec2::ZERO };
        let (x, y) = (corner.x as i64, corner.y as i64);
        let (right, below) = (x.saturating_add(1), y.saturating_add(1));
        let row = |y| at(x, y).lerp(at(right, y), part.x);
        row(y).lerp(row(below), part.y)
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::*;

    /// A texture of two columns, black and white, and two rows of blue, 0 and 255.
    fn map(wrap: Wrap) -> TextureMap {
        let texels = [[0, 0, 0, 255], [255, 255, 0, 255], [0, 0, 255, 0], [255, 255, 255, 0]].to_vec();
        let texels = Arc::new(Texels { width: 2, height: 2, channels: 4, bytes: texels.concat() });
        TextureMap { texels, set: 0, transform: Affine2::IDENTITY, wrap: [wrap; 2], nearest: false }
    }

    #[test]
    fn data_is_bilinear_and_wraps() {
        let at = |wrap, u, v| map(wrap).data([Vec2::new(u, v), Vec2::ZERO]);
        for (wrap, u, red) in [
            (Wrap::Repeat, 0.25, 0.0),
            (Wrap::Repeat, 0.375, 0.25),
            (Wrap::Repeat, 0.75, 1.0),
            (Wrap::Repeat, 1.0, 0.5),
            (Wrap::Repeat, -0.75, 0.0),
            (Wrap::Clamp, 1.0, 1.0),
            (Wrap::Clamp, -8.0, 0.0),
            (Wrap::Mirror, 1.0, 1.0),
            (Wrap::Mirror, 1.75, 0.0),
            (Wrap::Mirror, -0.75, 1.0),
        ] {
            assert_abs_diff_eq!(at(wrap, u, 0.25).x, red, epsilon = 1e-6);
        }
        // The first row is the upper one, where v is small.
        assert_eq!(
            [0.25, 0.75].map(|v| at(Wrap::Repeat, 0.25, v).to_array()),
            [[0.0, 0.0, 0.0, 1.0], [0.0, 0.0, 1.0, 0.0]]
        );
        for uv in [f32::NAN, f32::INFINITY, -f32::MAX, f32::MAX] {
            for wrap in [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror] {
                for nearest in [false, true] {
                    let got = TextureMap { nearest, ..map(wrap) }.data([Vec2::splat(uv); 2]);
                    assert!(
                        got.is_finite() && got.min_element() >= 0.0 && got.max_element() <= 1.0,
                        "{uv} {got}"
                    );
                }
            }
        }
    }

    /// Returns the first texel of a PNG with these samples per pixel.
    fn decoded(color: png::ColorType, depth: png::BitDepth, samples: &[u8]) -> [u8; 4] {
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, 1, 1);
        encoder.set_color(color);
        encoder.set_depth(depth);
        encoder.write_header().unwrap().write_image_data(samples).unwrap();
        let opened = Texels::open(&file).unwrap();
        assert_eq!(opened.count(), 1);
        opened.decode().unwrap().texel(0)
    }

    #[test]
    fn texels_of_every_number_of_channels_and_bits() {
        use png::{BitDepth::*, ColorType::*};
        assert_eq!(decoded(Grayscale, Eight, &[7]), [7, 7, 7, 255]);
        assert_eq!(decoded(GrayscaleAlpha, Eight, &[7, 8]), [7, 7, 7, 8]);
        assert_eq!(decoded(Rgb, Eight, &[7, 8, 9]), [7, 8, 9, 255]);
        assert_eq!(decoded(Rgba, Eight, &[7, 8, 9, 10]), [7, 8, 9, 10]);
        // The nearest byte of 0, 65535, 128.4 and 128.6 times 257.
        let deep = [[0, 0], [255, 255], [128, 231], [129, 26]].concat();
        assert_eq!(decoded(Rgba, Sixteen, &deep), [0, 255, 128, 129]);
        let error = |file: &[u8]| Texels::open(file).err().unwrap().to_string();
        assert_eq!(error(b"#?RGBE\n"), "unsupported texture format (expected PNG, JPEG or WebP)");
        assert_eq!(error(b""), "the file is empty");
    }

    #[test]
    fn color_is_linear_and_the_transform_and_set_apply() {
        let mut map = map(Wrap::Repeat);
        map.texels = Arc::new(Texels::constant([188, 0, 255, 128]));
        let got = map.color([Vec2::ZERO; 2]);
        assert_abs_diff_eq!(got, Vec4::new(0.503, 0.0, 1.0, 128.0 / 255.0), epsilon = 1e-3);
        let mut map = self::map(Wrap::Repeat);
        (map.set, map.nearest) = (1, true);
        map.transform = Affine2::from_translation(Vec2::new(0.5, 0.0));
        assert_eq!(map.data([Vec2::splat(0.3), Vec2::splat(0.1)]).x, 1.0);
        assert_eq!(map.data([Vec2::splat(0.1), Vec2::splat(0.6)]).x, 0.0);
    }
}
