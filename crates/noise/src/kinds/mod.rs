//! The kinds of noise.

pub(crate) mod catmull_rom;
pub(crate) mod cell;
pub(crate) mod cellular;
pub(crate) mod gaussian;
pub(crate) mod perlin;
pub(crate) mod simplex;
pub(crate) mod sparse_convolution;
pub(crate) mod value;
pub(crate) mod value_gradient;
pub(crate) mod white;
