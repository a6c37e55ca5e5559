//! Maps of a set: names, and texels as stored in scratch files.

use asperity_render::image::tone::srgb;

use crate::bake::source::{Source, Varies};
use crate::bake::texel::Texel;

/// A property of the surface as stored in scratch files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Plane {
    /// Base color: three 16-bit numbers, sRGB encoded.
    Color,
    /// The normal's x and y, each within [−1, 1], in 16 bits.
    Normal,
    /// The height in units of the side, `f32`.
    Height,
    /// √α, 16 bits.
    Roughness,
    /// Metallic, 16 bits.
    Metallic,
    /// Ambient occlusion, 16 bits.
    Occlusion,
}

impl Plane {
    pub(crate) const ALL: [Self; 6] =
        [Self::Color, Self::Normal, Self::Height, Self::Roughness, Self::Metallic, Self::Occlusion];

    /// Bytes per texel.
    pub(crate) const fn bytes(self) -> usize {
        match self {
            Self::Color => 6,
            Self::Normal | Self::Height => 4,
            Self::Roughness | Self::Metallic | Self::Occlusion => 2,
        }
    }

    /// Whether the property varies between texels.
    pub(crate) const fn differs(self, varies: Varies) -> bool {
        match self {
            Self::Color => varies.color,
            Self::Normal | Self::Roughness => true,
            Self::Metallic => varies.metallic,
            Self::Height | Self::Occlusion => varies.height,
        }
    }

    /// Appends the bytes of a texel.
    pub(crate) fn write(self, source: &dyn Source, texel: &Texel, out: &mut Vec<u8>) {
        let mut unit = |x: f32| out.extend_from_slice(&unorm(x).to_le_bytes());
        match self {
            Self::Color => texel.color.to_array().into_iter().for_each(|x| unit(srgb(x.clamp(0.0, 1.0)))),
            Self::Normal => {
                let (normal, _) = source.shown(texel);
                [normal.x, normal.y].into_iter().for_each(|x| unit(0.5 + 0.5 * x));
            }
            Self::Height => out.extend_from_slice(&texel.height.to_le_bytes()),
            Self::Roughness => unit(source.shown(texel).1.clamp(0.0, 1.0).sqrt().sqrt()),
            Self::Metallic => unit(texel.metallic),
            Self::Occlusion => unit(texel.occlusion),
        }
    }
}

/// Quantizes a number within [0, 1] to 16 bits.
pub(crate) fn unorm(x: f32) -> u16 {
    (x.clamp(0.0, 1.0) * 65_535.0).round() as u16
}

/// A map of the set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Map {
    BaseColor,
    /// Green points up the image.
    NormalOpenGl,
    /// Green points down the image.
    NormalDirectX,
    /// Normalized from the lowest to the highest point.
    Height,
    Roughness,
    Metallic,
    Occlusion,
    /// Occlusion, roughness and metallic in red, green and blue: the packing of glTF.
    Packed,
}

impl Map {
    pub(crate) const ALL: [Self; 8] = [
        Self::BaseColor,
        Self::NormalOpenGl,
        Self::NormalDirectX,
        Self::Height,
        Self::Roughness,
        Self::Metallic,
        Self::Occlusion,
        Self::Packed,
    ];

    /// Returns the name of its files.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::BaseColor => "base_color",
            Self::NormalOpenGl => "normal_opengl",
            Self::NormalDirectX => "normal_directx",
            Self::Height => "height",
            Self::Roughness => "roughness",
            Self::Metallic => "metallic",
            Self::Occlusion => "ambient_occlusion",
            Self::Packed => "occlusion_roughness_metallic",
        }
    }

    /// Returns the properties that the map contains.
    pub(crate) const fn planes(self) -> &'static [Plane] {
        match self {
            Self::BaseColor => &[Plane::Color],
            Self::NormalOpenGl | Self::NormalDirectX => &[Plane::Normal],
            Self::Height => &[Plane::Height],
            Self::Roughness => &[Plane::Roughness],
            Self::Metallic => &[Plane::Metallic],
            Self::Occlusion => &[Plane::Occlusion],
            Self::Packed => &[Plane::Occlusion, Plane::Roughness, Plane::Metallic],
        }
    }

    /// Returns the number of channels.
    pub(crate) const fn channels(self) -> usize {
        match self {
            Self::BaseColor | Self::NormalOpenGl | Self::NormalDirectX | Self::Packed => 3,
            Self::Height | Self::Roughness | Self::Metallic | Self::Occlusion => 1,
        }
    }

    /// Converts the bytes of its planes to texels with 16 bits per channel. `range` is the range of
    /// heights.
    pub(crate) fn texels(self, planes: &[&[u8]], range: [f32; 2], out: &mut Vec<u16>) {
        let words = |bytes: &'_ [u8]| {
            bytes.chunks_exact(2).map(|b| u16::from_le_bytes([b[0], b[1]])).collect::<Vec<_>>()
        };
        match self {
            Self::NormalOpenGl | Self::NormalDirectX => {
                for xy in planes[0].chunks_exact(4) {
                    let [x, y] = [u16::from_le_bytes([xy[0], xy[1]]), u16::from_le_bytes([xy[2], xy[3]])];
                    let z = third(x, y);
                    out.extend([x, if self == Self::NormalOpenGl { y } else { u16::MAX - y }, z]);
                }
            }
            Self::Height => {
                let [low, high] = range;
                let scale = if high > low { 1.0 / (high - low) } else { 0.0 };
                out.extend(heights(planes[0]).map(|height| unorm((height - low) * scale)));
            }
            Self::BaseColor | Self::Roughness | Self::Metallic | Self::Occlusion => {
                out.extend(words(planes[0]));
            }
            Self::Packed => {
                let [o, r, m] = [0, 1, 2].map(|k| words(planes[k]));
                out.extend(o.into_iter().zip(r).zip(m).flat_map(|((o, r), m)| [o, r, m]));
            }
        }
    }
}

/// Decodes heights from scratch bytes.
pub(crate) fn heights(bytes: &[u8]) -> impl Iterator<Item = f32> {
    bytes.chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]]))
}

/// Computes the normal's z from x and y.
fn third(x: u16, y: u16) -> u16 {
    let [x, y] = [x, y].map(|word| f32::from(word) / 32_767.5 - 1.0);
    unorm(0.5 + 0.5 * (1.0 - x * x - y * y).max(0.0).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_green_directions_are_mirrored() {
        let xy: Vec<u8> = [40_000_u16, 20_000].into_iter().flat_map(u16::to_le_bytes).collect();
        let texel = |map: Map| {
            let mut out = Vec::new();
            map.texels(&[&xy], [0.0; 2], &mut out);
            out
        };
        let ([x, up, z], [same, down, _]) =
            (texel(Map::NormalOpenGl).try_into().unwrap(), texel(Map::NormalDirectX).try_into().unwrap());
        let (x, up, z, same, down): (u16, u16, u16, u16, u16) = (x, up, z, same, down);
        assert_eq!((x, up, same, u32::from(up) + u32::from(down)), (40_000, 20_000, 40_000, 65_535));
        let length: f32 = [x, up, z].map(|w| (f32::from(w) / 32_767.5 - 1.0).powi(2)).iter().sum();
        assert!((length - 1.0).abs() < 1e-4, "{length}");
    }

    #[test]
    fn height_spans_lowest_to_highest() {
        let bytes: Vec<u8> = [-2.0_f32, 0.0, 2.0].into_iter().flat_map(f32::to_le_bytes).collect();
        let mut out = Vec::new();
        Map::Height.texels(&[&bytes], [-2.0, 2.0], &mut out);
        assert_eq!(out, [0, 32_768, 65_535]);
        // A plane has no relief.
        Map::Height.texels(&[&bytes[..4]], [-2.0, -2.0], &mut out);
        assert_eq!(out[3], 0);
    }
}
