//! Algorithms as their sources print them.

pub(crate) mod ebert_1994;
