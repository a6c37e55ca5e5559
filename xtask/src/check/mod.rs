//! CI checks.

mod blocks;
pub(crate) mod ci;
mod dependencies;
pub(crate) mod fuzz;
pub(crate) mod packages;
mod stranger;
pub(crate) mod tidy;
