//! The float functions that this crate calls; each line names both backends, and `libm` wins.
