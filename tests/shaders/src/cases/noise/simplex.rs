//! Simplex noise of both radii.

use asperity_noise::Simplex;
use asperity_wgsl::noise;

use super::{body, case, input_within, outputs, sample, seed};
use crate::case::{Bound, Case};

/// Within 100 cells. If the skew's product were fused with a sum of 350, corners would differ by
/// 8e-6. The gradient is up to 7, and its gradient up to 100.
const NEAR: [Bound; 2] = [Bound::Absolute(1e-4), Bound::Absolute(1e-3)];
/// Up to 10⁶ cells away corners differ by the `f32` resolution of points, and values are in range.
const FAR: [Bound; 2] = [Bound::Absolute(4.0), Bound::Absolute(32.0)];

pub(super) fn cases() -> Vec<Case> {
    let within = |far, name: &str, case: Case| Case {
        name: format!("{}{name}", case.name),
        input: Box::new(move |i| input_within(far, i)),
        ..case
    };
    vec![within(100.0, "", narrow(NEAR)), within(4e6, ", far", narrow(FAR)), within(100.0, ", wide", wide())]
}

fn narrow(bounds: [Bound; 2]) -> Case {
    case(&noise::SIMPLEX, body("simplex", "", true), bounds, |words| {
        let simplex = Simplex::new(seed(words));
        outputs(sample(&simplex, words), sample(&simplex, words), sample(&simplex, words))
    })
}

fn wide() -> Case {
    case(&noise::SIMPLEX, body("simplex_classic", "", true), NEAR, |words| {
        let simplex = Simplex::new(seed(words)).with_classic_radius();
        outputs(sample(&simplex, words), sample(&simplex, words), sample(&simplex, words))
    })
}
