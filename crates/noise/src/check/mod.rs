//! Property tests for any field, including custom fields.
//!
//! They compare gradients with finite differences, check ranges, lists and grids, statistics,
//! tiles, and totality on odd input. Five lines test any field like the tests of this crate test
//! its own fields:
//!
//! ```
//! use asperity_noise::{Perlin, check::{self, Settings}, glam::Vec3};
//!
//! let report = check::noise::<Vec3, _>(&Perlin::new(1), Settings::default());
//! println!("{report}");
//! assert!(report.passed());
//! ```
//!
//! # False alarms
//!
//! [`Settings::significance`] is the probability that a correct noise fails a report by chance. It
//! is divided evenly among the three statistical tests of [`noise()`]. The limits of the other
//! checks involve no chance. Reports have the form of `asperity_ndf_sampling::check`, which tests
//! densities.
//!
//! The feature `check` is off by default and adds no dependency. Enable it in `dev-dependencies`.

mod difference;
mod field;
mod noise;
mod settings;
mod tiled;

pub use asperity_core::check::{Check, Limit, Report, Settings};
pub use field::{field, hessian};
pub use noise::noise;
pub use tiled::tiled;
