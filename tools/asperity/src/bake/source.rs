//! The interface of bakeable surfaces: a surface over the unit square that returns means over
//! texels.

use asperity_shading::normal_map::SlopeMoments;
use glam::Vec3;
use serde_json::Value;

use crate::bake::texel::Texel;

/// A row of texels, or a part of a row.
///
/// The surface covers the unit square, x to the right and y up. The first row of texels is the top
/// row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row {
    /// Texels along the side of the square.
    pub(crate) size: u32,
    /// Samples along the side of a texel: 1, or an even number.
    pub(crate) samples: u32,
    /// The row and the first column. Both may lie outside the square, for the surroundings of a
    /// texel.
    pub(crate) row: i64,
    pub(crate) column: i64,
}

impl Row {
    /// The side of a texel.
    pub(crate) fn texel(&self) -> f32 {
        1.0 / self.size as f32
    }

    /// The side of the square that a sample represents.
    pub(crate) fn sample(&self) -> f32 {
        self.texel() / self.samples as f32
    }

    /// The center of a texel.
    pub(crate) fn middle(&self, index: usize) -> [f64; 2] {
        self.at(index, [0.5; 2])
    }

    /// Sample points whose mean approximates the mean over the texel. For polynomials of degree
    /// three in each quarter the result is exact.
    pub(crate) fn points(&self, index: usize) -> impl Iterator<Item = [f64; 2]> + use<> {
        let (row, samples) = (*self, self.samples);
        (0..samples * samples)
            .map(move |k| row.at(index, [k % samples, k / samples].map(|place| place_of(place, samples))))
    }

    fn at(&self, index: usize, [right, down]: [f64; 2]) -> [f64; 2] {
        let size = f64::from(self.size);
        let (x, y) = ((self.column + index as i64) as f64 + right, self.row as f64 + down);
        [x / size, (size - y) / size]
    }
}

/// Position of a sample along the side of a texel: the two-point Gauss rule on each pair of
/// samples.
fn place_of(k: u32, samples: u32) -> f64 {
    if samples == 1 {
        return 0.5;
    }
    let offset = 0.5 / 3_f64.sqrt();
    let within = if k.is_multiple_of(2) { 0.5 - offset } else { 0.5 + offset };
    (f64::from(k / 2) + within) / f64::from(samples / 2)
}

/// Which properties of a surface vary between texels. The others are uniform.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Varies {
    pub(crate) color: bool,
    pub(crate) metallic: bool,
    /// Whether the surface has heights, and therefore ambient occlusion.
    pub(crate) height: bool,
}

/// A surface that can be baked.
pub(crate) trait Source: Sync {
    /// Parameters, for the record.
    fn describe(&self) -> Value;

    /// Properties that vary between texels.
    fn varies(&self) -> Varies;

    /// The reason why opposite edges differ, if they do.
    fn why_not(&self) -> &'static str {
        "the surface is not periodic"
    }

    /// Bounds of the height in units of the side, if known.
    fn range(&self) -> Option<[f32; 2]> {
        None
    }

    /// α of a clear coat over the surface.
    fn coat(&self) -> Option<f32> {
        None
    }

    /// Computes the means over texels, except ambient occlusion.
    fn texels(&self, row: &Row, texels: &mut [Texel]);

    /// Computes the heights at texel centers.
    fn heights(&self, _row: &Row, heights: &mut [f32]) {
        heights.fill(0.0);
    }

    /// The surface at a point, used to compare opposite edges.
    fn point(&self, at: [f64; 2]) -> Texel;

    /// Returns the unit normal of a texel, and the α² of everything that the texel does not
    /// resolve.
    ///
    /// ```text
    /// α² = mean α² + tr Σ,   Σ the covariance of slopes: Beckmann's α² is twice the variance along each axis
    /// ```
    fn shown(&self, texel: &Texel) -> (Vec3, f32) {
        let SlopeMoments { covariance: [xx, _, yy], .. } = texel.slopes;
        (texel.slopes.normal(), texel.alpha2 + xx + yy)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_have_the_moments_of_a_texel() {
        for samples in [2, 4, 6] {
            let row = Row { size: 4, samples, row: 1, column: 2 };
            let (mut mean, mut square) = ([0.0; 2], [0.0; 2]);
            for p in row.points(1) {
                for axis in 0..2 {
                    mean[axis] += p[axis] / f64::from(samples * samples);
                    square[axis] += p[axis] * p[axis] / f64::from(samples * samples);
                }
            }
            // The texel [3/4, 1] × [1/2, 3/4].
            assert!((mean[0] - 0.875).abs() < 1e-15 && (mean[1] - 0.625).abs() < 1e-15, "{mean:?}");
            for axis in 0..2 {
                let variance = square[axis] - mean[axis] * mean[axis];
                assert!((variance - 0.0625 / 12.0).abs() < 1e-15, "{samples}: {variance}");
            }
            assert_eq!(row.middle(1), [0.875, 0.625]);
        }
    }
}
