//! Fields made of fields.

pub(crate) mod curl;
pub(crate) mod power;
pub(crate) mod warp;
