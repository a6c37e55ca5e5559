//! Checks that stand between a change and `main`.

pub(crate) mod bits;
mod blocks;
pub(crate) mod ci;
pub(crate) mod coverage;
mod dependencies;
pub(crate) mod firmware;
pub(crate) mod fuzz;
pub(crate) mod no_std;
pub(crate) mod packages;
mod stranger;
pub(crate) mod tidy;
