//! Lanes of SIMD registers, the SIMD level of the machine, and elementary functions in lanes.

pub(crate) mod dispatch;
pub mod elementary;
pub(crate) mod lanes;
#[cfg(feature = "simd")]
mod look_up;
#[cfg(feature = "simd")]
pub(crate) mod register_pair;
#[cfg(feature = "simd")]
pub(crate) mod registers;
pub(crate) mod transpose;

pub use dispatch::{Kernel, Task, map, run};
#[cfg(feature = "simd")]
pub use dispatch::{best_level, each_level, level_for, run_at};
#[cfg(feature = "simd")]
#[doc(no_inline)]
pub use fearless_simd::Level;
pub use lanes::{Arithmetic, Floats, Lanes, MAX_LANES, Scalar, Words};
#[cfg(feature = "simd")]
pub use register_pair::{Pair, RegisterPair};
#[cfg(feature = "simd")]
pub use registers::{Keys, OwnKeys, Registers};
pub use transpose::{Transpose, TransposeSquare};
