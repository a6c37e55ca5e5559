//! Property tests for any reflectance or material, your own included: reciprocity, energy, samples against their density by χ²,
//! totality on odd input.
//!
//! Five lines do to another reflectance what the tests of this crate do to its own:
//!
//! ```
//! use asperity_shading::{Lambert, check::{self, Settings}, glam::Vec3};
//!
//! let report = check::brdf(&Lambert::new(Vec3::splat(0.8))?, Settings::default());
//! println!("{report}");
//! assert!(report.passed());
//! # Ok::<(), asperity_shading::ParameterError>(())
//! ```
//!
//! The report, its settings and the cells that integrals are taken over are those of
//! [`asperity_ndf_sampling::check`](crate::ndf_sampling::check), which does the same for densities of normals: the significance is
//! divided evenly among the χ² tests, one for each view. What a reflectance has in lobes that its sampler never meets and that are
//! narrower than a sixth of a cell may be overlooked.
//!
//! The feature `check` is off by default and adds no dependency: enable it for `dev-dependencies`.

mod material;
mod reflectance;
mod scattering;

pub use asperity_ndf_sampling::check::{Check, Limit, Report, Settings};
pub use material::material;
pub use reflectance::{brdf, dielectric};
