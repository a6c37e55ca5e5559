//! # asperity-fif
#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;
#[cfg(feature = "std")]
extern crate std;

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("asperity-fif needs a float backend: enable the feature `std` or `libm`");

mod axis;
mod bounds;
#[cfg(feature = "alloc")]
mod cached;
mod cell;
mod evaluate;
mod height_field;
mod integral;
mod interval;
mod map;
mod math;
mod orbit;
pub mod paper;
mod polynomial;
mod ray;
mod storage;
mod system;

pub use axis::{Axis, Smooth};
pub use bounds::Extrema;
#[cfg(feature = "alloc")]
pub use cached::Cached;
pub use evaluate::MAX_DEPTH;
pub use glam;
pub use height_field::HeightField;
pub use interval::{Bounded, Interval};
pub use map::{Map, Piece};
pub use ray::{Hit, Ray};
#[cfg(feature = "alloc")]
pub use storage::{FifBuf, SmoothBuf};
pub use storage::{FifView, FixedFif, FixedSmooth, Storage};
pub use system::{End, Fif, JOIN_TOLERANCE, List, SystemError};
