//! The marginal distribution of an NDF on the disk, from which a map is packed.

use alloc::vec::Vec;

use crate::map::breakpoints::Breakpoints;
use crate::map::columns::Columns;
use crate::map::piece::Piece;
use crate::map::pieces::pieces;
use crate::numeric::compensated_sum::CompensatedSums;
use crate::numeric::guide_table::GuideTable;

/// The largest `f64` below 1.
const BELOW_ONE: f64 = 1.0 - f64::EPSILON / 2.0;

/// The marginal of an NDF on the (x, y) map of normals, in `f64` with compensated sums.
///
/// ```text
/// x = (n_x + 1)/2, y = (n_y + 1)/2;   f(x, y) = 4 D inside the disk, 0 outside;   m(x) = ∫ f dy,   M(x) = ∫₀ˣ m
/// ```
///
/// The rim of the disk is cut where it crosses a grid line, and every 2√3/1024 of angle. At these
/// breakpoints `M` is the integral over the circle. Between two breakpoints the rim is a straight
/// chord, and `m` is a polynomial of degree 3 (1 for constant texels). The chords omit less than
/// 1.91e-6 of the area of the disk. The weight of this area is spread over the piece.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Marginal {
    pub(crate) columns: Columns,
    /// The scale factor by which the integral over the disk is 1.
    pub(crate) scale: f64,
    pub(crate) pieces: Vec<Piece>,
    /// `M` at the beginning of each piece, and 1.
    pub(crate) cumulative: Vec<f64>,
    pub(crate) by_place: GuideTable,
    pub(crate) by_weight: GuideTable,
}

impl Marginal {
    /// Creates the marginal of columns of finite, non-negative values; `None` if the disk has no
    /// weight.
    pub(crate) fn new(columns: Columns) -> Option<Self> {
        let height = columns.height as f64;
        let breakpoints = Breakpoints::new(columns.width, columns.height, columns.kind);
        let (pieces, masses) = pieces(&columns, &breakpoints);
        let places = breakpoints.places;
        let mut sum = CompensatedSums::default();
        let mut cumulative = Vec::with_capacity(places.len());
        cumulative.push(0.0);
        cumulative.extend(masses.iter().map(|&mass| {
            sum.add([mass]);
            sum.values()[0]
        }));
        let [total] = sum.values();
        if !(total > 0.0 && (1.0 / total).is_finite()) {
            return None;
        }
        let per_total = 1.0 / total;
        for sum in &mut cumulative {
            *sum = (*sum * per_total).min(1.0);
        }
        // Every piece after the last weight ends at exactly 1.
        for sum in cumulative.iter_mut().rev().take_while(|sum| **sum >= BELOW_ONE) {
            *sum = 1.0;
        }
        if let Some(last) = cumulative.last_mut() {
            *last = 1.0;
        }
        let (by_place, by_weight) = (GuideTable::new(&places), GuideTable::new(&cumulative));
        let scale = height * per_total;
        Some(Self { columns, scale, pieces, cumulative, by_place, by_weight })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::reconstruction::Reconstruction;
    use crate::map::texels::{Measure, columns_of_texels, texel_meets};
    use alloc::vec;
    use asperity_core::assert_abs_diff_eq;

    fn marginal(width: usize, height: usize, texels: &[f32], kind: Reconstruction) -> Option<Marginal> {
        Marginal::new(columns_of_texels(width, height, texels, Measure::ProjectedSolidAngle, kind).unwrap())
    }

    #[test]
    fn marginal_of_uniform_disk() {
        for kind in [Reconstruction::Constant, Reconstruction::Bilinear] {
            let Marginal { pieces, cumulative, scale, .. } = marginal(1, 1, &[7.0], kind).unwrap();
            assert_abs_diff_eq!(7.0 * scale, 4.0 / core::f64::consts::PI, epsilon = 1e-13);
            for (piece, sum) in pieces.iter().zip(cumulative) {
                let theta = (1.0 - 2.0 * piece.x[0]).acos();
                let circle = (theta - theta.sin() * theta.cos()) / core::f64::consts::PI;
                assert_abs_diff_eq!(sum, circle, epsilon = 1e-14, "{piece:?}");
            }
        }
    }

    #[test]
    fn every_texel_overlapping_the_disk_has_weight() {
        for (width, height) in [(1, 1), (3, 2), (8, 8), (10, 10), (13, 64)] {
            for texel in 0..width * height {
                let mut texels = vec![0.0; width * height];
                texels[texel] = 1.0;
                let meets = texel_meets(texel % width, width, texel / width, height);
                assert_eq!(
                    marginal(width, height, &texels, Reconstruction::Constant).is_some(),
                    meets,
                    "{texel} of {width} × {height}"
                );
            }
        }
    }
}
