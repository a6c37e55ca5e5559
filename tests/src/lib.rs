//! Helpers of the tests.

pub use approx;

pub mod assertions;
pub mod disk_bins;
pub mod facets;
pub mod fif_systems;
pub mod histogram;
pub mod low_discrepancy;
pub mod noise_any;
pub mod noise_errors;
pub mod noise_kinds;
pub mod noise_reference;
#[cfg(doctest)]
pub mod pages;
pub mod pinned;
pub mod random;
pub mod reference;
pub mod sphere_bins;
pub mod surface_patches;
