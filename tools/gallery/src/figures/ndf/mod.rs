//! Figures of the normal densities.

pub(super) mod bump_maps;
pub(super) mod conditional;
pub(super) mod densities;
pub(super) mod masking;
pub(super) mod table;
