//! Cellular noise of every basis and metric.

use asperity_noise::{Cellular, CellularOutput, Metric};
use asperity_wgsl::noise;

use super::{body, case, number, outputs_of, seed};
use crate::case::{Bound, Case};

/// Distances are of order 1, and offsets are divided by them.
const BOUNDS: [Bound; 2] = [Bound::Absolute(1e-6), Bound::Absolute(1e-4)];

const BASES: [CellularOutput; 4] =
    [CellularOutput::F1, CellularOutput::F2, CellularOutput::F2MinusF1, CellularOutput::Cell];
const METRICS: [Metric; 3] = [Metric::Euclidean, Metric::Manhattan, Metric::Chebyshev];

pub(super) fn cases() -> Vec<Case> {
    // A tenth of the points have their feature points at cell centers.
    let parameters = "u32(b.x * 4.0), u32(b.y * 3.0), select(b.z, 0.0, b.w < 0.1), ";
    vec![case(&noise::CELLULAR, body("cellular", parameters, false), BOUNDS, |words| {
        let [basis, metric, jitter, centerd] = [4, 5, 6, 7].map(|k| number(words, k));
        let cellular = Cellular::new(seed(words))
            .with_output(BASES[(basis * 4.0) as usize])
            .with_metric(METRICS[(metric * 3.0) as usize]);
        let jitter = if centerd < 0.1 { 0.0 } else { jitter };
        outputs_of(&cellular.with_jitter(jitter).unwrap_or(cellular), words)
    })]
}
