//! Property tests for any BRDF or material, including your own.
//!
//! They cover reciprocity, energy, χ² of samples against their density, and invalid input.
//!
//! A custom BRDF gets the tests of this crate in five lines:
//!
//! ```
//! use asperity_shading::{Lambert, check::{self, Settings}, glam::Vec3};
//!
//! let report = check::brdf(&Lambert::new(Vec3::splat(0.8))?, Settings::default());
//! println!("{report}");
//! assert!(report.passed());
//! # Ok::<(), asperity_shading::ShadingError>(())
//! ```
//!
//! The report, its settings and the integration cells are those of
//! [`asperity_ndf_sampling::check`](crate::ndf_sampling::check), which tests NDFs. The significance
//! is divided evenly among the χ² tests, one for each view. A lobe that the sampler never hits and
//! that is narrower than a sixth of a cell may be missed.
//!
//! The feature `check` is off by default and adds no dependency. Enable it in `dev-dependencies`.

mod material;
mod reflectance;
mod scattering;

pub use asperity_ndf_sampling::check::{Check, Limit, Report, Settings};
pub use material::material;
pub use reflectance::{brdf, dielectric};
