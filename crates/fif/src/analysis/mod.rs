//! Extrema, moduli of continuity, box dimension.

pub(crate) mod branch_and_bound;
pub(crate) mod dimension;
pub(crate) mod extrema;
pub(crate) mod modulus;
pub(crate) mod oscillation;
