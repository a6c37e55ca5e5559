//! Fields composed of other fields.

pub(crate) mod arithmetic;
pub(crate) mod curl;
pub(crate) mod frequency;
pub(crate) mod pointwise;
pub(crate) mod power;
pub(crate) mod unit;
pub(crate) mod warp;
