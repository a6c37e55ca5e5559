//! Noises as their sources print them, for reproduction.

pub(crate) mod ebert_1994;

pub use ebert_1994::{Gnoise, LectureTables, Vgnoise, Vnoise};
