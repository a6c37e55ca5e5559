//! Every function of the shaders as a case.

use crate::case::Case;

mod fif;
mod ndf;
mod noise;
mod shading;
pub mod sums;

/// All cases.
#[must_use]
pub fn all() -> Vec<Case> {
    [noise::cases(), ndf::cases(), shading::cases(), sums::cases(), fif::cases()]
        .into_iter()
        .flatten()
        .collect()
}
