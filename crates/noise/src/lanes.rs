//! The lanes of `asperity-core` that noise kinds are written over, and the SIMD levels of a
//! machine.

pub(crate) use asperity_core::lanes::MAX_LANES as LANES;
pub use asperity_core::lanes::{Arithmetic, Floats, Lanes, Scalar, Words};

pub(crate) mod level;

/// A value in lanes, and its gradient.
pub type LaneSample<S, const N: usize> = (<S as Arithmetic>::F, [<S as Arithmetic>::F; N]);
