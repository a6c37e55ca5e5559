//! # asperity-ndf-sampling
#![no_std]

#[cfg(feature = "std")]
extern crate std;

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("asperity-ndf-sampling needs a float backend: enable the feature `std` or `libm`");

mod beckmann;
mod conditional;
mod frame;
mod ggx;
mod math;
mod ndf;
mod roughness;

pub use beckmann::Beckmann;
pub use conditional::{GaussianSplit, MAX_SHARE, conditional_density};
pub use frame::Frame;
pub use ggx::Ggx;
pub use glam;
pub use ndf::Ndf;
pub use roughness::{MAX_ALPHA, MIN_ALPHA, RoughnessError};
