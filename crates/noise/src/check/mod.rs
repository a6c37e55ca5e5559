//! Property tests for any field, your own included: gradients against differences, ranges, lists and grids, statistics, tiles, and
//! totality on odd input.
//!
//! Five lines do to any field what the tests of this crate do to its own:
//!
//! ```
//! use asperity_noise::{Perlin2002, check::{self, Settings}, glam::Vec3};
//!
//! let report = check::noise::<Vec3, _>(&Perlin2002::new(1), Settings::default());
//! println!("{report}");
//! assert!(report.passed());
//! ```
//!
//! # False alarms
//!
//! [`Settings::significance`] is the probability with which a right noise may fail a report by chance, divided evenly among the three
//! statistical tests of [`noise()`]; the other checks have limits that no chance is in. Reports have the form of those of
//! `asperity_ndf_sampling::check`, which does the same for densities.
//!
//! The feature `check` is off by default and adds no dependency: enable it for `dev-dependencies`.

mod difference;
mod field;
mod noise;
mod settings;
mod tiled;

pub use asperity_core::check::{Check, Limit, Report, Settings};
pub use field::{curved, field};
pub use noise::noise;
pub use tiled::tiled;
