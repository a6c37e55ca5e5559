//! Texels of normal maps: conversion between unsigned integers and unit normals.

use glam::Vec3;

use asperity_core::math;

/// Direction of the second coordinate of a normal map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum TangentSpace {
    /// Up the image; tangent, bitangent and normal are a right-handed frame, the frame of this
    /// crate. A bump is bright at its top in the green channel.
    #[default]
    OpenGl,
    /// Down the image: the green channel is inverted.
    DirectX,
}

/// The integer that represents 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum Zero {
    /// `c = 2v/(2ᵇ − 1) − 1`, as a GPU decodes an unsigned normalized texture. 0 is between two
    /// integers, and a flat texel of 8 bits is tilted by 0.22° in each coordinate.
    #[default]
    Between,
    /// `c = max(−1, (v − 2ᵇ⁻¹)/(2ᵇ⁻¹ − 1))`: the number 128 (or 32768) is 0 exactly.
    Half,
}

/// Content of the third channel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum Blue {
    /// `n_z`; the three are normalized together, so only their ratios matter.
    #[default]
    Read,
    /// Nothing, as in two-channel textures: `n_z = √(1 − n_x² − n_y²)`.
    Reconstructed,
}

/// Encoding of the texels of a normal map.
///
/// ```text
/// c = 2v/(2ᵇ − 1) − 1 or (v − 2ᵇ⁻¹)/(2ᵇ⁻¹ − 1);   n_y = ∓c_g;   n_z = c_b or √(1 − n_x² − n_y²);   n/|n|
/// ```
///
/// Every input is valid. A texel below the horizon is moved to the horizon. A texel without a
/// direction is the flat normal. A texel outside the disk is the nearest point on its rim.
///
/// ```
/// use asperity_ndf_sampling::{glam::Vec3, normal_map::{NormalMapFormat, TangentSpace, Zero}};
///
/// let format = NormalMapFormat { zero: Zero::Half, ..NormalMapFormat::default() };
/// assert_eq!(format.decode_u8([128, 128, 255]), Vec3::Z);
/// let directx = NormalMapFormat { tangent_space: TangentSpace::DirectX, ..format };
/// let n = Vec3::new(0.0, 0.6, 0.8);
/// assert_eq!(format.encode_u8(n), [128, 204, 230]);
/// assert_eq!(directx.encode_u8(n), [128, 52, 230]);
/// assert!(directx.decode_u16(directx.encode_u16(n)).abs_diff_eq(n, 4e-5));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[doc(alias = "opengl")]
#[doc(alias = "directx")]
#[doc(alias = "unpack")]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NormalMapFormat {
    /// Direction of the green channel.
    pub tangent_space: TangentSpace,
    /// The integer that represents 0.
    pub zero: Zero,
    /// Content of the blue channel.
    pub blue: Blue,
}

impl NormalMapFormat {
    /// Decodes a texel of 8 bits per channel to a unit normal.
    #[must_use]
    pub fn decode_u8(self, texel: [u8; 3]) -> Vec3 {
        self.decode(texel.map(f32::from), 8)
    }

    /// Decodes a texel of 16 bits per channel to a unit normal.
    #[must_use]
    pub fn decode_u16(self, texel: [u16; 3]) -> Vec3 {
        self.decode(texel.map(f32::from), 16)
    }

    /// Encodes a unit normal as the nearest texel of 8 bits per channel.
    #[must_use]
    pub fn encode_u8(self, n: Vec3) -> [u8; 3] {
        // A cast from float to integer saturates, and NaN becomes 0.
        self.encode(n, 8).map(|v| v as u8)
    }

    /// Encodes a unit normal as the nearest texel of 16 bits per channel.
    #[must_use]
    pub fn encode_u16(self, n: Vec3) -> [u16; 3] {
        self.encode(n, 16).map(|v| v as u16)
    }

    /// Decodes three numbers in [−1, 1], e.g. of a float texture, to a unit normal.
    ///
    /// Numbers out of range are clamped.
    #[must_use]
    pub fn decode_signed(self, [x, y, z]: [f32; 3]) -> Vec3 {
        // A square beyond this range would overflow. NaN passes through and is handled below.
        let [x, y, z] = [x, y, z].map(|c| c.clamp(-1.0, 1.0));
        let y = self.upright(y);
        let r2 = x * x + y * y;
        let z = match self.blue {
            Blue::Read => z.max(0.0),
            Blue::Reconstructed => math::sqrt((1.0 - r2).max(0.0)),
        };
        let squared = r2 + z * z;
        // Squares of small numbers lose their digits. A power of two preserves them.
        let scale = if squared < 1e-30 { (1_u128 << 100) as f32 } else { 1.0 };
        let v = Vec3::new(x, y, z) * scale;
        let length = math::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
        let n = Vec3::new(v.x / length, v.y / length, v.z / length);
        if n.is_finite() { n } else { Vec3::Z }
    }

    fn decode(self, texel: [f32; 3], bits: i32) -> Vec3 {
        let (scale, zero) = self.scale(bits);
        self.decode_signed(texel.map(|v| ((v - zero) / scale).max(-1.0)))
    }

    fn encode(self, n: Vec3, bits: i32) -> [f32; 3] {
        let (scale, zero) = self.scale(bits);
        [n.x, self.upright(n.y), n.z].map(|c| c * scale + zero + 0.5)
    }

    /// Converts the second coordinate between the two tangent spaces.
    fn upright(self, y: f32) -> f32 {
        match self.tangent_space {
            TangentSpace::OpenGl => y,
            TangentSpace::DirectX => -y,
        }
    }

    /// The step between 0 and 1, and the integer that represents 0.
    fn scale(self, bits: i32) -> (f32, f32) {
        let half = (1_u32 << (bits - 1)) as f32;
        match self.zero {
            Zero::Between => (half - 0.5, half - 0.5),
            Zero::Half => (half - 1.0, half),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    fn formats() -> impl Iterator<Item = NormalMapFormat> {
        let spaces = [TangentSpace::OpenGl, TangentSpace::DirectX];
        let zeros = [Zero::Between, Zero::Half];
        let blues = [Blue::Read, Blue::Reconstructed];
        (0..8).map(move |k| NormalMapFormat {
            tangent_space: spaces[k & 1],
            zero: zeros[(k >> 1) & 1],
            blue: blues[k >> 2],
        })
    }

    #[test]
    fn decode_signed_of_tiny_numbers_is_unit() {
        let read = NormalMapFormat { blue: Blue::Read, ..Default::default() };
        for size in [f32::from_bits(1), 1e-40, 1e-22, 1e-15, 1e-3] {
            for texel in [[1.0, 0.0, 0.0], [1.0, -1.0, 1.0], [0.0, 0.0, 1.0]] {
                let n = read.decode_signed(texel.map(|c: f32| c * size));
                assert_abs_diff_eq!(n, Vec3::from_array(texel).normalize(), epsilon = 2e-7, "{size}");
            }
        }
        assert_eq!(read.decode_signed([0.0; 3]), Vec3::Z);
    }

    #[test]
    fn texels_round_trip() {
        for format in formats() {
            for (r, g) in (0..=20).flat_map(|r| (0..=20).map(move |g| (r, g))) {
                let n = Vec3::new(r as f32 * 0.08 - 0.8, g as f32 * 0.05 - 0.5, 0.0);
                let n = Vec3::new(n.x, n.y, (1.0 - n.length_squared()).max(0.0).sqrt()).normalize();
                let [small, large] =
                    [format.decode_u8(format.encode_u8(n)), format.decode_u16(format.encode_u16(n))];
                // Half a step of each channel. Near the horizon the reconstructed root magnifies
                // it.
                let magnified = if format.blue == Blue::Reconstructed { 1.0 / n.z.max(0.1) } else { 1.0 };
                assert_abs_diff_eq!(small, n, epsilon = 0.006 * magnified, "{format:?}");
                assert_abs_diff_eq!(large, n, epsilon = 0.006 / 256.0 * magnified, "{format:?}");
            }
        }
    }

    #[test]
    fn flat_texel_of_unsigned_normalized_textures_is_tilted() {
        let n = NormalMapFormat::default().decode_u8([128, 128, 255]);
        assert_abs_diff_eq!(n.x, 0.003_921_5, epsilon = 1e-6);
        assert_abs_diff_eq!(n.y, 0.003_921_5, epsilon = 1e-6);
    }

    #[test]
    fn every_texel_decodes_to_a_unit_normal() {
        let values = [0, 1, 127, 128, 200, 255];
        for format in formats() {
            for (r, g) in values.into_iter().flat_map(|r| values.map(|g| (r, g))) {
                for b in values {
                    let n = format.decode_u8([r, g, b]);
                    assert_abs_diff_eq!(n.length(), 1.0, epsilon = 1e-6, "{format:?} {r} {g} {b}");
                    assert!(n.z >= 0.0, "{format:?} {r} {g} {b}: {n}");
                }
            }
            for bad in [f32::NAN, f32::INFINITY, 1e38, -1e38, 0.0] {
                let n = format.decode_signed([bad, 0.5, bad]);
                assert_abs_diff_eq!(n.length(), 1.0, epsilon = 1e-6, "{format:?} {bad}");
                assert!(n.z >= 0.0, "{format:?} {bad}: {n}");
                assert!(format.encode_u8(Vec3::splat(bad)).len() == 3);
            }
        }
    }
}
