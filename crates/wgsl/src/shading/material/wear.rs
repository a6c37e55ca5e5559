//! Wear of surfaces.

use asperity_shading::material::{Segments, half_mean};
use asperity_shading::{Scratches, Variations};

use super::surface::{FBM, GLOSSY, LATTICE_KEY, SEGMENTS, SURFACE_POINT, fbm_words, octaves_of};
use crate::noise::sums::{FREQUENCY_CLAMP, OctavesUniform, octaves_3d};
use crate::noise::{SIMPLEX, key};
use crate::part::{Binding, Part, part, uniform};
use crate::shading::bump::SLOPE_FACETS;
use crate::shading::reflectance::{COOK_TORRANCE_BECKMANN, FACET};

/// Scratches on metal, [`Scratches`].
pub static SCRATCHES: Part = part!(
    "shading/material/wear/scratches",
    SEGMENTS,
    SURFACE_POINT,
    FREQUENCY_CLAMP,
    SLOPE_FACETS,
    FACET,
    COOK_TORRANCE_BECKMANN,
)
.with_bindings(&[Binding::Uniform { name: "scratches_uniform", of: "Scratches" }]);

/// The words of the structure `Segments`, the segments of scratches or fibers.
pub(super) fn segment_words(segments: &Segments) -> [u32; 8] {
    let floats = [
        segments.direction.x,
        segments.direction.y,
        segments.cell,
        segments.length,
        segments.cover,
        segments.spread,
    ];
    let [x, y, cell, length, cover, spread] = floats.map(f32::to_bits);
    [x, y, cell, length, cover, spread, key(segments.seed), 0]
}

uniform! {
    /// Scratches as the words of the structure `Scratches`.
    ///
    /// | words | |
    /// |---|---|
    /// | 0–7 | direction, cell, length of a scratch, number in a cell, spread, key of the lattice, 0 |
    /// | 8–11 | specular color; half the width |
    /// | 12–15 | far-field mean squares of slopes, and the fraction that is covered |
    /// | 16–19 | depth over half the width; Beckmann's α; 0, 0 |
    ///
    /// Lengths are in texture coordinates.
    ///
    /// ```
    /// use asperity_wgsl::shading::material::ScratchesUniform;
    /// use asperity_shading::{Scratches, ScratchesParameters};
    ///
    /// let words = ScratchesUniform::new(&Scratches::new(ScratchesParameters::default())?).words();
    /// assert_eq!(f32::from_bits(words[2]), 0.05);
    /// assert_eq!(f32::from_bits(words[16]), 0.5);
    /// # Ok::<(), asperity_shading::ParameterError>(())
    /// ```
    ScratchesUniform: 20, "Scratches";
}

impl ScratchesUniform {
    /// Packs scratches.
    #[must_use]
    pub fn new(scratches: &Scratches) -> Self {
        let (p, (covered, removed)) = (scratches.parameters(), scratches.far());
        let [x, y, z] = p.specular.to_array();
        let floats = [
            x,
            y,
            z,
            scratches.half_width(),
            removed.x,
            removed.y,
            removed.z,
            covered,
            p.scratch_strength,
            p.roughness,
        ];
        let mut words = [0; Self::WORDS];
        words[..8].copy_from_slice(&segment_words(scratches.segments()));
        words[8..18].copy_from_slice(&floats.map(f32::to_bits));
        Self(words)
    }
}

/// Small variations of color, [`Blemishes`](asperity_shading::material::Blemishes).
pub static BLEMISHES: Part = part!("shading/material/wear/blemishes", FBM);

/// Noise with some of its gradients dropped, [`Dents`](asperity_shading::material::Dents).
pub static DENTS: Part = part!("shading/material/wear/dents", FBM, LATTICE_KEY, SIMPLEX, octaves_3d::TOTAL);

/// Any material with blemishes and dents, [`Variations`].
pub static VARIATIONS: Part =
    part!("shading/material/wear/variations", BLEMISHES, DENTS, GLOSSY, SURFACE_POINT)
        .with_bindings(&[Binding::Uniform { name: "variations_uniform", of: "Variations" }]);

/// Variations as the words of the structure `Variations`, and their sums of octaves.
///
/// | words | |
/// |---|---|
/// | 0–7 | for blemishes and dents: cells per unit of length, highest frequency over lowest, octaves, index of the sum |
/// | 8–15 | diffuse color, roughness of the facets; specular color, Beckmann's α of the gloss |
/// | 16–19 | tilt by blemishes, variation of color by them, tilt by dents, fraction of the gradients of dents that is kept |
/// | 20–23 | gradients of words below are dropped; half the mean of simplex noise's magnitude; 0, 0 |
///
/// ```
/// use asperity_wgsl::shading::material::VariationsUniform;
/// use asperity_shading::{Variations, VariationsParameters};
///
/// let variations = VariationsUniform::new(&Variations::new(VariationsParameters::default())?, 3);
/// // Its sums have the indices 3 and 4 in the uniform of sums.
/// assert_eq!([variations.words()[3], variations.words()[7]], [3, 4]);
/// assert_eq!(variations.sums().len(), 2);
/// # Ok::<(), asperity_shading::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VariationsUniform {
    words: [u32; Self::WORDS],
    sums: [OctavesUniform<3>; 2],
}

impl VariationsUniform {
    /// Words of the structure.
    pub const WORDS: usize = 24;

    /// Packs variations whose sums of octaves have the indices from `first` on in the uniform of
    /// sums.
    #[must_use]
    pub fn new(variations: &Variations, first: u32) -> Self {
        let (p, (blemishes, dents)) = (variations.parameters(), variations.parts());
        let [[a, b, c], [d, e, f]] = [p.diffuse, p.specular].map(|colour| colour.to_array());
        let (bump, colour) = (p.small_blemish_bump_strength, p.small_blemish_color_strength);
        let floats =
            [a, b, c, p.roughness, d, e, f, p.gloss_roughness, bump, colour, p.dent_strength, p.dent_cover];
        let mut words = [0; Self::WORDS];
        words[..4].copy_from_slice(&fbm_words(blemishes.noise(), first));
        words[4..8].copy_from_slice(&fbm_words(dents.noise(), first.wrapping_add(1)));
        words[8..20].copy_from_slice(&floats.map(f32::to_bits));
        words[20..22].copy_from_slice(&[dents.dropped(), half_mean().to_bits()]);
        Self { words, sums: [octaves_of(blemishes.noise()), octaves_of(dents.noise())] }
    }

    /// Returns the words, in the layout of `Variations`.
    #[must_use]
    pub const fn words(&self) -> [u32; Self::WORDS] {
        self.words
    }

    /// Returns the sums of octaves of blemishes and dents for the uniform of sums, from index
    /// `first` on.
    #[must_use]
    pub const fn sums(&self) -> [OctavesUniform<3>; 2] {
        self.sums
    }
}
