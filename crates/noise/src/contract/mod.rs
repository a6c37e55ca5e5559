//! The traits of noises and fields, and the values that they return.

pub(crate) mod batch;
pub(crate) mod compiled;
pub(crate) mod field;
pub(crate) mod hessian;
pub(crate) mod kernel;
pub(crate) mod many;
pub(crate) mod noise;
