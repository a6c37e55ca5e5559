//! Property tests for any density, your own included: normalisation, χ² with pooled bins, the map's derivative and inverse, masking,
//! visible normals, and totality on odd input.
//!
//! Five lines do to any density what the tests of this crate do to its own:
//!
//! ```
//! use asperity_ndf_sampling::{Ggx, check::{self, Settings}};
//!
//! let report = check::ndf(&Ggx::new(0.2, 0.4)?, Settings::default());
//! println!("{report}");
//! assert!(report.passed());
//! # Ok::<(), asperity_ndf_sampling::RangeError>(())
//! ```
//!
//! Integrals are taken over cells of the hemisphere that hold equally many samples of a pilot run, by adaptive quadrature, finest where
//! the samples of a cell lie, so that lobes of any width are resolved where the sampler goes; a place to which it never goes lies in
//! some cell too, and what the density has there shows in the integral and in χ². A lobe which no pilot sample has met and which is
//! narrower than a sixth of its cell may be overlooked.
//!
//! # False alarms
//!
//! [`Settings::significance`] is the probability with which a right density may fail a report by chance. It is divided evenly among
//! the report's χ² tests, two of [`ndf()`] and seven of [`microfacet()`]; the other checks have limits that no chance is in.
//!
//! The feature `check` is off by default and adds no dependency: enable it for `dev-dependencies`.

mod cells;
mod microfacet;
mod ndf;

pub use asperity_core::check::{Check, Limit, Report, Settings, p_value};
pub use cells::Cells;
pub use microfacet::microfacet;
pub use ndf::ndf;
