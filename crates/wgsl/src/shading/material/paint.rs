//! Metallic paint.

use asperity_shading::MetallicPaint;
use asperity_shading::material::Elimination;

use super::surface::{FBM, SURFACE_POINT, fbm_words, octaves_of};
use crate::ndf::ELEMENTARY;
use crate::noise::sums::OctavesUniform;
use crate::noise::{INTEGER_HASH, key};
use crate::part::{Binding, Part, part};
use crate::shading::DIRECTION;
use crate::shading::reflectance::{COAT, ENERGY_PRESERVING};

/// Patches of space, one per flake, [`flake_patch`](fn@asperity_shading::material::flake_patch).
pub static FLAKE_PATCH: Part =
    part!("shading/material/paint/flake_patch", INTEGER_HASH, DIRECTION, ELEMENTARY);

/// Flakes over pigment under a clearcoat with orange peel, the common part of both kinds of
/// [`MetallicPaint`].
pub static COATED_FLAKES: Part =
    part!("shading/material/paint/coated_flakes", SURFACE_POINT, FBM, ENERGY_PRESERVING, COAT);

/// Metallic paint with passive flakes, sparkles and a clearcoat with orange peel,
/// [`MetallicPaint`].
pub static METALLIC_PAINT: Part = part!("shading/material/paint/metallic_paint", COATED_FLAKES, FLAKE_PATCH)
    .with_bindings(&[Binding::Uniform { name: "metallic_paint_uniform", of: "MetallicPaint" }]);

/// Metallic paint with sparkling flakes as the words of the structure `MetallicPaint`, and its sums
/// of octaves.
///
/// | words | |
/// |---|---|
/// | 0–7 | for orange peel and passive flakes: cells per unit of length, highest frequency over lowest, octaves, index of the sum |
/// | 8–15 | seven keys of sparkles, 0 |
/// | 16–27 | specular color, Beckmann's α of flakes; pigment, strength of orange peel; target of the boost, boost |
/// | 28–31 | sparkles: width in pixels, maximum width, variation, fraction that is left out |
/// | 32–35 | 1/unit of adaptive elimination or 0; strength of passive flakes; relative IOR of the coat; its α |
///
/// ```
/// use asperity_wgsl::shading::material::MetallicPaintUniform;
/// use asperity_shading::{MetallicPaint, MetallicPaintParameters};
///
/// let words = MetallicPaintUniform::new(&MetallicPaint::new(MetallicPaintParameters::default())?, 0).words();
/// assert_eq!([words[32], words[34]].map(f32::from_bits), [1.0 / 0.002, 1.5]);
/// # Ok::<(), asperity_shading::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MetallicPaintUniform {
    words: [u32; Self::WORDS],
    sums: [OctavesUniform<3>; 2],
}

impl MetallicPaintUniform {
    /// Words of the structure.
    pub const WORDS: usize = 36;

    /// Packs paint whose sums of octaves have the indices from `first` on in the uniform of sums.
    #[must_use]
    pub fn new(paint: &MetallicPaint, first: u32) -> Self {
        let (p, (peel, sparkles, passive)) = (paint.parameters(), paint.parts());
        let [[a, b, c], [d, e, f], [g, h, i]] =
            [p.specular, p.pigment, p.flake_sparkle_boost_target].map(|colour| colour.to_array());
        let per_unit = match p.smart_flake_sparkle {
            Elimination::Fixed => 0.0,
            Elimination::Adaptive { unit } => 1.0 / unit,
        };
        let colours =
            [a, b, c, p.flake_roughness, d, e, f, p.orange_peel_strength, g, h, i, p.flake_sparkle_boost];
        let sparkling = [
            p.flake_sparkle_pixel_size,
            p.flake_sparkle_physical_size,
            p.flake_sparkle_variation,
            p.flake_sparkle_elimination,
            per_unit,
            p.passive_flake_strength,
            p.coat_index,
            p.coat_roughness,
        ];
        let mut words = [0; Self::WORDS];
        words[..4].copy_from_slice(&fbm_words(peel.noise(), first));
        words[4..8].copy_from_slice(&fbm_words(passive.noise(), first.wrapping_add(1)));
        for (word, k) in words[8..15].iter_mut().zip(0_u32..) {
            *word = key(sparkles.seed() ^ k.wrapping_mul(0x9e37_79b9));
        }
        words[16..28].copy_from_slice(&colours.map(f32::to_bits));
        words[28..].copy_from_slice(&sparkling.map(f32::to_bits));
        Self { words, sums: [octaves_of(peel.noise()), octaves_of(passive.noise())] }
    }

    /// Returns the words, in the layout of `MetallicPaint`.
    #[must_use]
    pub const fn words(&self) -> [u32; Self::WORDS] {
        self.words
    }

    /// Returns the sums of octaves of orange peel and passive flakes for the uniform of sums, from
    /// index `first` on.
    #[must_use]
    pub const fn sums(&self) -> [OctavesUniform<3>; 2] {
        self.sums
    }
}
