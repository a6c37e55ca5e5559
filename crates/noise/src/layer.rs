//! The place of one octave: its own seed, offset and rotation, times its frequency.

use crate::{
    integer_hash::mix,
    sample::Sample,
    space::Point,
    spectrum::{MAX_OCTAVES, Spectrum},
};

/// The seed of an octave's lattice and the affine map into it.
///
/// A lattice shared between octaves or channels makes them dependent, other seeds or not: their variances peak at the
/// same points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Layer<V: Point> {
    pub(crate) seed: u32,
    matrix: V::Matrix,
    offset: V,
}

impl<V: Point> Layer<V> {
    /// All layers of a spectrum; those beyond its maximum are there and unused.
    pub(crate) fn all(spectrum: &Spectrum, seed: u32) -> [Self; MAX_OCTAVES as usize] {
        let mut i = 0;
        [(); MAX_OCTAVES as usize].map(|()| {
            let word = |k: u64| mix((u64::from(seed) << 32) | u64::from(i) << 2 | k);
            let frequency = if i < spectrum.max_octaves() { spectrum.frequency(i) } else { 0.0 };
            let layer = Self {
                seed: (word(0) >> 32) as u32,
                matrix: V::rotation([word(1), word(2)], frequency),
                offset: V::offset(word(3)),
            };
            i += 1;
            layer
        })
    }

    /// The octave's own coordinates of a point.
    #[inline(always)]
    pub(crate) fn point(&self, p: V) -> V {
        V::transform(&self.matrix, p, self.offset)
    }

    /// sum + factor · sample, with the gradient turned back to the coordinates of the sum.
    #[inline(always)]
    pub(crate) fn accumulate(&self, sum: &mut Sample<V>, factor: f32, sample: Sample<V>) {
        sum.value += factor * sample.value;
        sum.gradient = sum.gradient.add_scaled(factor, V::pull_back(&self.matrix, sample.gradient));
    }
}
