//! Checks that stand between a change and `main`.

pub(crate) mod bare_metal;
pub(crate) mod ci;
pub(crate) mod density;
mod dependencies;
pub(crate) mod firmware;
pub(crate) mod fuzz;
pub(crate) mod no_std;
pub(crate) mod packages;
pub(crate) mod tidy;
pub(crate) mod wasm;
