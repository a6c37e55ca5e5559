//! Property tests for any NDF, including your own.
//!
//! They cover normalization, χ² with pooled bins, the derivative of the map and its inverse,
//! masking, visible normals, and invalid input.
//!
//! A custom NDF gets the tests of this crate in five lines:
//!
//! ```
//! use asperity_ndf_sampling::{Ggx, check::{self, Settings}};
//!
//! let report = check::ndf(&Ggx::new(0.2, 0.4)?, Settings::default());
//! println!("{report}");
//! assert!(report.passed());
//! # Ok::<(), asperity_ndf_sampling::NdfError>(())
//! ```
//!
//! Integrals are taken over cells of the hemisphere that hold equally many samples of a pilot run.
//! Adaptive quadrature is finest where the samples of a cell lie, so lobes of any width are
//! resolved where the sampler goes. Regions without samples also belong to a cell, so the density
//! there contributes to the integral and to χ². A lobe that no pilot sample hits and that is
//! narrower than a sixth of its cell may be missed.
//!
//! # False alarms
//!
//! [`Settings::significance`] is the probability that a report on a correct NDF fails by chance. It
//! is divided evenly among the χ² tests of the report, two of [`ndf()`] and seven of
//! [`microfacet()`]. The other checks have fixed limits.
//!
//! The feature `check` is off by default and adds no dependency. Enable it in `dev-dependencies`.

mod cells;
mod microfacet;
mod ndf;

pub use asperity_core::check::{Check, Limit, Report, Settings, p_value};
pub use cells::Cells;
pub use microfacet::microfacet;
pub use ndf::ndf;
