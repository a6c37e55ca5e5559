//! CI checks.

mod blocks;
pub(crate) mod ci;
mod clean_room;
mod dependencies;
pub(crate) mod fuzz;
pub(crate) mod packages;
pub(crate) mod tidy;
