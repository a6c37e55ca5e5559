//! An image on a surface, as a glTF texture.

use std::sync::{Arc, LazyLock};

use glam::{Affine2, Vec2, Vec4};

use crate::image::{read::ImageFile, tone::linear};

/// Red, green, blue and alpha of an image, row by row from the top left.
pub struct Texels {
    width: usize,
    height: usize,
    texels: Vec<[u8; 4]>,
}

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
    /// Returns the texels of an image, in 8 bits.
    pub fn new(image: &ImageFile) -> Self {
        let byte = |x: f32| (x.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
        let ([r, g, b], alpha) = (image.colors(), image.alpha.as_deref());
        let texel =
            |i: usize| [byte(r[i]), byte(g[i]), byte(b[i]), alpha.map_or(255, |alpha| byte(alpha[i]))];
        let (width, height) = (image.width, image.height);
        Self { width, height, texels: (0..width * height).map(texel).collect() }
    }
}

#[cfg(test)]
impl Texels {
    /// Returns an image of one texel.
    pub fn constant(texel: [u8; 4]) -> Self {
        Self { width: 1, height: 1, texels: vec![texel] }
    }
}

impl Wrap {
    /// Returns the texel of an index that may be outside the image.
    fn index(self, i: i64, count: usize) -> usize {
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
        let Texels { width, height, texels } = self.texels.as_ref();
        let uv = self.transform.transform_point2(uv[self.set]);
        let size = Vec2::new(*width as f32, *height as f32);
        // `as` saturates, and turns NaN into 0.
        let at = |x: i64, y: i64| {
            let (x, y) = (self.wrap[0].index(x, *width), self.wrap[1].index(y, *height));
            value(texels[y * width + x])
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
        let texels = Arc::new(Texels { width: 2, height: 2, texels });
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

    #[test]
    fn color_is_linear_and_the_transform_and_set_apply() {
        let mut map = map(Wrap::Repeat);
        map.texels = Arc::new(Texels { width: 1, height: 1, texels: vec![[188, 0, 255, 128]] });
        let got = map.color([Vec2::ZERO; 2]);
        assert_abs_diff_eq!(got, Vec4::new(0.503, 0.0, 1.0, 128.0 / 255.0), epsilon = 1e-3);
        let mut map = self::map(Wrap::Repeat);
        (map.set, map.nearest) = (1, true);
        map.transform = Affine2::from_translation(Vec2::new(0.5, 0.0));
        assert_eq!(map.data([Vec2::splat(0.3), Vec2::splat(0.1)]).x, 1.0);
        assert_eq!(map.data([Vec2::splat(0.1), Vec2::splat(0.6)]).x, 0.0);
    }
}
