//! Foundations of the Asperity crates: SIMD lanes, float back ends, intervals, errors of batches and reports of checks.
//!
#![doc = include_str!("../README.md")]
#![no_std]

#[cfg(any(feature = "check", test))]
extern crate alloc;
#[cfg(any(feature = "std", test))]
extern crate std;

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("every Asperity crate needs a float backend: enable its feature `std` or `libm`");

mod batch_error;
#[cfg(feature = "check")]
pub mod check;
mod interval;
pub mod lanes;
mod macros;
pub mod math;
mod split_mix;

pub use batch_error::BatchError;
pub use interval::Interval;
pub use split_mix::SplitMix64;
