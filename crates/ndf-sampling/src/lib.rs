//! # asperity-ndf-sampling
#![no_std]

#[cfg(feature = "std")]
extern crate std;

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("asperity-ndf-sampling needs a float backend: enable the feature `std` or `libm`");

mod math;

pub use glam;
