//! Counted flakes.

use asperity_shading::material::GlintField;
use asperity_shading::{MetallicPaint, Ndf};

use super::paint::{COATED_FLAKES, MetallicPaintUniform};
use super::surface::LATTICE_KEY;
use crate::ndf::{ELEMENTARY, NORMAL_DISTRIBUTION};
use crate::noise::{INTEGER_HASH, key};
use crate::part::{Binding, Part, part, uniform};
use crate::shading::{DIRECTION, MATH};

/// Flakes counted within pixels, with any normal distribution as their mean, [`GlintField`].
pub static GLINT_FIELD: Part = part!(
    "shading/material/paint/glint_field",
    INTEGER_HASH,
    LATTICE_KEY,
    NORMAL_DISTRIBUTION,
    ELEMENTARY,
    DIRECTION,
    MATH,
);

/// Metallic paint with counted flakes,
/// [`PaintFlakes::Counted`](asperity_shading::material::PaintFlakes::Counted).
pub static COUNTED_FLAKES: Part = part!("shading/material/paint/counted_flakes", COATED_FLAKES, GLINT_FIELD)
    .with_bindings(&[Binding::Uniform { name: "counted_flakes_uniform", of: "CountedFlakes" }]);

uniform! {
    /// Counted flakes as the words of the structure `GlintField`.
    ///
    /// Distance between flakes in units of positions, standard deviations of their tilt that mirror
    /// a light source; key of the lattice, 0; two keys of tilts, 0, 0.
    ///
    /// ```
    /// use asperity_wgsl::shading::material::GlintFieldUniform;
    /// use asperity_shading::{Beckmann, material::GlintField};
    ///
    /// let flakes = GlintField::new(Beckmann::new(0.3, 0.3)?, 1e-4, 0.1, 7)?;
    /// assert_eq!(GlintFieldUniform::new(&flakes).words()[..2], [1e-4_f32, 0.1].map(f32::to_bits));
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    GlintFieldUniform: 8, "GlintField";
}

impl GlintFieldUniform {
    /// Packs flakes.
    #[must_use]
    pub fn new<N: Ndf>(field: &GlintField<N>) -> Self {
        let ([spacing, bin], seed) = field.parts();
        let [x, y] = GlintField::<N>::TILTS.map(|tilt| key(seed ^ tilt));
        Self([spacing.to_bits(), bin.to_bits(), key(seed), 0, x, y, 0, 0])
    }
}

uniform! {
    /// Paint with counted flakes as the words of the structure `CountedFlakes`.
    ///
    /// The 36 words of [`MetallicPaintUniform`], which also contains its sums of octaves, and the
    /// eight words of [`GlintFieldUniform`].
    ///
    /// ```
    /// use asperity_wgsl::shading::material::CountedFlakesUniform;
    /// use asperity_shading::{MetallicPaint, MetallicPaintParameters, material::PaintFlakes};
    ///
    /// let flakes = PaintFlakes::Counted { spacing: 2e-4, bin: 0.1 };
    /// let paint = MetallicPaint::new(MetallicPaintParameters { flakes, ..Default::default() })?;
    /// let words = CountedFlakesUniform::new(&paint, 0).map(|counted| counted.words()[36]);
    /// assert_eq!(words, Some(2e-4_f32.to_bits()));
    /// # Ok::<(), asperity_shading::ParameterError>(())
    /// ```
    CountedFlakesUniform: MetallicPaintUniform::WORDS + GlintFieldUniform::WORDS, "CountedFlakes";
}

impl CountedFlakesUniform {
    /// Packs paint whose sums of octaves have the indices from `first` on in the uniform of sums.
    ///
    /// Returns `None` for paint with sparkling flakes.
    #[must_use]
    pub fn new(paint: &MetallicPaint, first: u32) -> Option<Self> {
        let field = GlintFieldUniform::new(paint.glints()?).words();
        let mut words = [0; Self::WORDS];
        words[..MetallicPaintUniform::WORDS]
            .copy_from_slice(&MetallicPaintUniform::new(paint, first).words());
        words[MetallicPaintUniform::WORDS..].copy_from_slice(&field);
        Some(Self(words))
    }
}
