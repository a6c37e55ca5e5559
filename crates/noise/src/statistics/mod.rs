//! Measured statistics of the kinds.

pub(crate) mod absolute_moments;
pub(crate) mod cellular;
pub(crate) mod statistics;
pub(crate) mod tables;
