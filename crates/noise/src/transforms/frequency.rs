//! A field at another frequency: its points are scaled.

use crate::{
    contract::field::Field,
    point::Point,
    row::points::{Buffer, Points, Target, buffers},
    sample::Sample,
};

/// A field with its points multiplied by a frequency, f(ν p).
///
/// - **Gradient:** ν ∇f(ν p).
/// - **Range:** the range of f.
/// - **Speed:** a grid is evaluated as a list of points. A grid with another step is faster.
///
/// ```
/// use asperity_noise::{Field, Perlin, glam::Vec2, ops::{Add, Frequency, ScaleBias}};
///
/// let detail = ScaleBias(Frequency(Perlin::new(2), 4.0), 0.25, 0.0);
/// let (land, p) = (Add(Perlin::new(1), detail), Vec2::new(0.3, 1.4));
/// assert_eq!(land.value(p), Perlin::new(1).value(p) + 0.25 * Perlin::new(2).value(4.0 * p));
/// ```
#[doc(alias("scale", "zoom", "wavelength"))]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Frequency<F>(
    /// f.
    pub F,
    /// ν.
    pub f32,
);

/// The number of points that are scaled at once.
const BLOCK: usize = 512;

impl<F> Frequency<F> {
    #[inline]
    fn scaled<V: Point>(&self, p: V) -> V {
        let x = p.coordinates();
        V::from_axes(|axis| self.1 * x.as_ref()[axis])
    }
}

impl<V: Point, F: Field<V>> Field<V> for Frequency<F> {
    #[inline]
    fn sample(&self, p: V) -> Sample<V> {
        let Sample { value, gradient } = self.0.sample(self.scaled(p));
        Sample { value, gradient: self.scaled(gradient) }
    }

    #[inline]
    fn value(&self, p: V) -> f32 {
        self.0.value(self.scaled(p))
    }

    fn range(&self) -> [f32; 2] {
        self.0.range()
    }

    fn fill(&self, points: &Points<'_, V>, mut target: Target<'_, V>) {
        let (instructions, wanted) = (target.instructions, target.gradients.is_some());
        let mut scaled = buffers::<V, BLOCK>();
        let mut inner = Buffer::<V, BLOCK>::empty();
        for block in points.blocks(BLOCK) {
            let (points, width, count) = (points.part(&block), block.width(), block.len());
            points.write(scaled.as_mut());
            for x in scaled.as_mut().iter_mut().flat_map(|list| &mut list[..count]) {
                *x *= self.1;
            }
            self.0.fill(&Points::buffered(&scaled, count), inner.target(instructions, count, wanted));
            let mut target = target.part(&block);
            for row in 0..block.rows.len() {
                let part = row * width..(row + 1) * width;
                let (values, gradients) = target.row(row, width);
                values.copy_from_slice(&inner.values[part.clone()]);
                let Some(mut gradients) = gradients else { continue };
                for (to, from) in gradients.as_mut().iter_mut().zip(inner.gradients.as_ref()) {
                    for (to, from) in to.iter_mut().zip(&from[part.clone()]) {
                        *to = self.1 * from;
                    }
                }
            }
        }
    }
}
