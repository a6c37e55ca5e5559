//! # asperity-ndf-sampling
#![no_std]

#[cfg(feature = "std")]
extern crate std;

#[cfg(feature = "alloc")]
extern crate alloc;

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("asperity-ndf-sampling needs a float backend: enable the feature `std` or `libm`");

mod beckmann;
mod conditional;
#[cfg(feature = "alloc")]
mod disk;
mod frame;
mod gaussian;
mod ggx;
#[cfg(feature = "alloc")]
mod map;
#[cfg(feature = "alloc")]
mod marginal;
mod math;
mod ndf;
#[cfg(feature = "alloc")]
mod normal_table;
mod remap;
mod roughness;
#[cfg(feature = "alloc")]
mod slab;
#[cfg(feature = "alloc")]
mod sum;

pub use beckmann::Beckmann;
pub use conditional::{GaussianSplit, MAX_SHARE, conditional_density};
pub use frame::Frame;
pub use gaussian::{inverse_phi, phi};
pub use ggx::Ggx;
pub use glam;
#[cfg(feature = "alloc")]
pub use map::{MAX_TEXELS, Measure, NdfMap, NdfMapError};
#[cfg(feature = "alloc")]
pub use marginal::Cdf;
pub use ndf::Ndf;
#[cfg(feature = "alloc")]
pub use normal_table::{NormalTable, NormalTableError};
pub use remap::{NoiseCdf, NoiseCdfError};
pub use roughness::{MAX_ALPHA, MIN_ALPHA, RoughnessError};
