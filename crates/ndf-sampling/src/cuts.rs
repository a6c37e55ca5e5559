//! Where the marginal of a map goes from one formula to the next.

use alloc::vec::Vec;

use crate::disk::half_chord;
use crate::reconstruction::Reconstruction;

/// Cuts nearer to one another than this are one.
const MERGED: f64 = 1e-12;

/// Pieces of the disk's rim, from −1 to 1, whatever the grid.
const RIM: u32 = 1024;

/// The places, from 0 to 1, at which the rim of the disk is cut for a map of `width × height` texels.
///
/// ```text
/// the grid's own lines;  ½ ± c(y) of its lines across;  3t² − 2t³, t = k/1024
/// ```
///
/// The last are nearly even in the angle, which is 2√3/1024 for the longest piece at most: the chord of that is (2√3/1024)²/8 =
/// 1.43e-6 of the radius away from its arc.
pub(crate) fn cuts(width: usize, height: usize, kind: Reconstruction) -> Vec<f64> {
    let inside = |x: &f64| *x > 0.0 && *x < 1.0;
    // What differs from a line of the grid by rounding alone would leave pieces without a width.
    let apart = |x: &f64| {
        let line = kind.line((x * width as f64 + kind.offset() + 0.5) as usize, width);
        inside(x) && x.min(1.0 - x) > MERGED && (x - line).abs() > MERGED
    };
    let across = (0..=kind.cells(height)).map(|j| kind.line(j, height)).filter(inside);
    let halves: Vec<f64> = across.map(half_chord).collect();
    let mut cuts: Vec<f64> = Vec::with_capacity(2 * halves.len() + width + RIM as usize + 2);
    cuts.extend(halves.iter().map(|c| 0.5 - c).filter(apart));
    cuts.extend(halves.iter().map(|c| 0.5 + c).filter(apart));
    cuts.extend(
        (0..RIM).map(|k| f64::from(k) / f64::from(RIM)).map(|t| t * t * (3.0 - 2.0 * t)).filter(apart),
    );
    // Merges what is sorted in runs.
    cuts.sort_by(f64::total_cmp);
    cuts.dedup_by(|next, kept| *next - *kept < MERGED);
    cuts.extend((0..=kind.cells(width)).map(|i| kind.line(i, width)).filter(inside));
    cuts.extend([0.0, 1.0]);
    cuts.sort_by(f64::total_cmp);
    cuts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cuts_increase_and_are_never_far_apart() {
        for (width, height) in [(1, 1), (2, 2), (10, 7), (64, 256), (5, 5)] {
            for kind in [Reconstruction::Constant, Reconstruction::Bilinear] {
                let cuts = cuts(width, height, kind);
                assert_eq!((cuts.first(), cuts.last()), (Some(&0.0), Some(&1.0)));
                for pair in cuts.windows(2) {
                    let (dx, dy) = (pair[1] - pair[0], half_chord(pair[1]) - half_chord(pair[0]));
                    // The distance from chord to arc of a circle of radius ½, per radius.
                    assert!(dx > 0.0 && (dx * dx + dy * dy) / 2.0 < 1.44e-6, "{width} × {height}: {pair:?}");
                }
            }
        }
    }
}
