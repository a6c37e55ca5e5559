//! Transforms of fields: domain warping and curl, from the samples that a shader has taken.

use super::SAMPLE;
use crate::part::{Part, part};

/// Domain warping, [`Warp`](asperity_noise::Warp): the displacement with its Jacobian, and the gradient turned back.
pub static WARP: Part = part!("noise/transforms/warp", SAMPLE);

/// Flows without divergence, [`curl`](asperity_noise::curl).
pub static CURL: Part = part!("noise/transforms/curl");
