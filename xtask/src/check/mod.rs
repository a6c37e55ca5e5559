//! What stands between a change and `main`.

pub(crate) mod bare_metal;
pub(crate) mod cargo;
pub(crate) mod ci;
#[cfg(test)]
mod documents;
pub(crate) mod no_std;
pub(crate) mod tidy;
