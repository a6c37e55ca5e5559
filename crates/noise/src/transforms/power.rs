//! A field to an integer power, which emphasizes high values.

use crate::{
    contract::field::Field,
    point::Point,
    row::points::{Points, Target},
    sample::Sample,
    transforms::arithmetic::combined,
    transforms::pointwise::{self, Combine},
};

/// fᵏ with the gradient k fᵏ⁻¹ ∇f.
///
#[cfg_attr(doc, doc = include_str!("../../docs/pictures/power.md"))]
///
/// The mean of a power is not the power of the mean. If the octaves of the inner sum fade to their
/// means, the power does not fade to its mean.
///
/// ```
/// use asperity_noise::{Field, Normalization, Fbm, Plasma, Simplex, FbmSpectrum, glam::Vec2, ops::Power};
///
/// // Threads: plasma of three equal octaves to the seventh power (Nilsson 2008, section 4.2.2).
/// let plasma = Fbm::new(Simplex::new(3), FbmSpectrum::THREADS).with_shape(Plasma);
/// let threads = Power(plasma.with_normalization(Normalization::UnitRange), 7);
/// assert!((0.0..=1.0).contains(&threads.value(Vec2::new(0.2, 0.7))));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Power<F>(
    /// f.
    pub F,
    /// k; f⁰ = 1.
    pub u8,
);

impl<F> Power<F> {
    /// xᵏ⁻¹ and xᵏ.
    #[inline(always)]
    fn powers(&self, x: f32) -> [f32; 2] {
        (0..self.1).fold([0.0, 1.0], |[_, power], _| [power, power * x])
    }
}

impl<F> Combine<0> for Power<F> {
    #[inline(always)]
    fn combined(&self, x: f32, _: [f32; 0]) -> f32 {
        self.powers(x)[1]
    }
    #[inline(always)]
    fn slope(&self, x: f32, _: [f32; 0], dx: f32, _: [f32; 0]) -> f32 {
        f32::from(self.1) * self.powers(x)[0] * dx
    }
}

combined!([F] Power<F>, |self| self.0, [], {
    let [low, high] = self.0.range();
    let [a, b] = [low, high].map(|bound| Combine::combined(self, bound, []));
    let through_zero = self.1 > 0 && self.1.is_multiple_of(2) && low < 0.0 && high > 0.0;
    [if through_zero { 0.0 } else { a.min(b) }, a.max(b)]
});
