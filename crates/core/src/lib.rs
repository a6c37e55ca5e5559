//! Foundations of the Asperity crates: SIMD lanes, float functions, intervals and check reports.
//!
//! - [`lanes`]: arithmetic written once, for a number or for SIMD registers, with the same bits.
//! - [`math`]: the float functions of `std` or `libm`.
//! - [`Interval`]: interval arithmetic with outward rounding.
//! - [`gpu`]: structs with the same layout in Rust and in WGSL.
//!
//! The dependent crates re-export the parts that their users need.
//!
//! ```
//! use asperity_core::{Interval, math};
//!
//! let root = math::sqrt_f64(2.0);
//! let square = Interval::new(root, root).product(Interval::new(root, root));
//! assert!(square.inflated(1e-15).contains(2.0));
//! ```
#![no_std]

#[cfg(feature = "check")]
extern crate alloc;
#[cfg(any(feature = "std", test))]
extern crate std;

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("every Asperity crate needs a float backend: enable its feature `std` or `libm`");

mod batch_error;
#[cfg(feature = "check")]
pub mod check;
pub mod gpu;
mod interval;
pub mod lanes;
mod macros;
pub mod math;
mod short;
mod split_mix;

pub use batch_error::BatchError;
pub use interval::Interval;
pub use short::Short;
pub use split_mix::SplitMix64;
