//! Checks that stand between a change and `main`.

mod blocks;
pub(crate) mod ci;
mod dependencies;
pub(crate) mod fuzz;
pub(crate) mod packages;
mod stranger;
pub(crate) mod tidy;
