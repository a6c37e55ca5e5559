//! Every function of the shaders as a case.

use crate::case::Case;

mod noise;

/// All cases.
#[must_use]
pub fn all() -> Vec<Case> {
    noise::cases()
}
