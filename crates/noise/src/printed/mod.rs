//! Noises as printed in their sources, for reproduction.

pub(crate) mod ebert_1994;

pub use ebert_1994::{Gnoise, LectureTables, Vgnoise, Vnoise};
