//! Building blocks of several materials.

use asperity_core::gpu_struct;
use asperity_noise::Field;
use asperity_noise::{IntegerHash, gpu::FbmUniform3d};
use glam::Vec3;

use crate::material::{Segments, SizedFbm};

gpu_struct! {
    /// Octaves of simplex noise by position.
    pub struct SizedFbmUniform as "SizedFbm" {
        /// Cells of the first octave per unit of length.
        frequency: f32,
        /// Ratio of the last to the first frequency.
        highest: f32,
        /// Number of octaves.
        octaves: f32,
        /// Index of the sum in the uniform of sums.
        sum: u32,
    }
}

impl<K: Field<Vec3>> SizedFbm<K> {
    /// The uniform of noise whose sum of octaves has this index.
    pub(super) fn gpu(&self, sum: u32) -> SizedFbmUniform {
        let [frequency, highest] = self.frequencies();
        SizedFbmUniform { frequency, highest, octaves: self.octaves().octaves(), sum }
    }

    /// The sum of octaves.
    pub(super) fn gpu_sum(&self) -> FbmUniform3d {
        self.octaves().gpu()
    }
}

gpu_struct! {
    /// Short oriented segments in the cells of a plane, for scratches and fibers.
    pub struct SegmentsUniform as "Segments" {
        /// Unit direction around which segments are spread.
        direction: [f32; 2],
        /// Side of a cell.
        cell: f32,
        /// Length of a segment, at most the side of a cell.
        length: f32,
        /// Mean number of segments of a cell, at most 8.
        cover: f32,
        /// Spread of directions; 1 is a quarter turn to either side.
        spread: f32,
        /// Key of the lattice.
        key: u32,
        .. padding: u32
    }
}

impl Segments {
    /// The uniform of the segments.
    pub(super) fn gpu(&self) -> SegmentsUniform {
        let Self { direction, cell, length, cover, spread, seed } = *self;
        SegmentsUniform {
            direction: direction.into(),
            cell,
            length,
            cover,
            spread,
            key: IntegerHash::gpu_key(seed),
            padding: 0,
        }
    }
}
