//! Fields mapped to [0, 1].

use crate::{
    contract::field::Field,
    point::Point,
    row::points::{Points, Target},
    sample::Sample,
    transforms::pointwise::{self, Combine},
};

/// A field mapped to [0, 1] by its documented range.
///
/// ```text
/// (f − low)/(high − low),   clamped to [0, 1], which rounding may leave
/// ```
///
/// A field without a finite [range](Field::range) is mapped to ½ everywhere.
///
/// ```
/// use asperity_noise::{Field, Perlin, glam::Vec2, ops::Unit};
///
/// let (noise, p) = (Perlin::new(1), Vec2::new(0.3, 1.4));
/// assert_eq!(Unit(noise).value(p), 0.5 + 0.5 * noise.value(p));
/// ```
#[doc(alias("normalise", "normalize", "01", "grey"))]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Unit<F>(
    /// The field.
    pub F,
);

/// offset + factor · f.
struct Mapped {
    offset: f32,
    factor: f32,
}

impl<F> Unit<F> {
    #[inline(always)]
    fn mapped<V: Point>(&self) -> Mapped
    where
        F: Field<V>,
    {
        let [low, high] = self.0.range();
        let width = high - low;
        if width > 0.0 && width.is_finite() {
            Mapped { offset: -low / width, factor: 1.0 / width }
        } else {
            Mapped { offset: 0.5, factor: 0.0 }
        }
    }
}

impl Combine<0> for Mapped {
    #[inline(always)]
    fn combined(&self, x: f32, _: [f32; 0]) -> f32 {
        (self.offset + self.factor * x).clamp(0.0, 1.0)
    }
    #[inline(always)]
    fn slope(&self, _: f32, _: [f32; 0], dx: f32, _: [f32; 0]) -> f32 {
        self.factor * dx
    }
}

impl<V: Point, F: Field<V>> Field<V> for Unit<F> {
    #[inline]
    fn sample(&self, p: V) -> Sample<V> {
        let (mapped, Sample { value, gradient }) = (self.mapped(), self.0.sample(p));
        let gradient = gradient.coordinates();
        let gradient = V::from_axes(|axis| mapped.factor * gradient.as_ref()[axis]);
        Sample { value: Combine::combined(&mapped, value, []), gradient }
    }

    #[inline]
    fn value(&self, p: V) -> f32 {
        Combine::combined(&self.mapped(), self.0.value(p), [])
    }

    fn range(&self) -> [f32; 2] {
        [0.0, 1.0]
    }

    fn fill(&self, points: &Points<'_, V>, target: Target<'_, V>) {
        pointwise::fill(&self.mapped(), &self.0, [], points, target);
    }
}
