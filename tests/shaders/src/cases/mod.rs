//! Every shader function as a case.

use crate::case::Case;

mod fif;
mod ndf;
mod noise;
mod shading;
pub mod sums;

/// Returns all cases.
#[must_use]
pub fn all() -> Vec<Case> {
    [noise::cases(), ndf::cases(), shading::cases(), sums::cases(), fif::cases()]
        .into_iter()
        .flatten()
        .collect()
}
