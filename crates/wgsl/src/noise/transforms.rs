//! Transforms of fields: domain warping and curl, from samples taken by the shader.

use super::kinds::SAMPLE;
use crate::part::{Part, part};

/// Domain warping, [`Warp`](asperity_noise::Warp): the displacement with its Jacobian, and the
/// gradient of the warped field.
pub static WARP: Part = part!("noise/transforms/warp", SAMPLE);

/// Divergence-free velocities, [`curl`](asperity_noise::curl).
pub static CURL: Part = part!("noise/transforms/curl");
