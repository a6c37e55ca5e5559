//! Property tests for any density, your own included: normalisation, χ² with pooled bins, the inverse of the map, and totality
//! on odd input.
//!
//! What the tests of this crate do to its densities, five lines do to another:
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
//! Integrals are taken over cells of the hemisphere that hold equally many samples of a pilot run, by adaptive quadrature, so that
//! lobes of any width are resolved where the sampler goes; a place to which it never goes lies in some cell too, and what the
//! density has there shows in the integral and in χ². A lobe which no pilot sample has met and which is narrower than a
//! sixth of its cell may be overlooked.
//!
//! The feature `check` is off by default and adds no dependency: enable it for `dev-dependencies`.

mod cells;
pub(crate) mod chi_square;
mod ndf;
mod report;

pub use chi_square::p_value;
pub use ndf::ndf;
pub use report::{Check, Limit, Report};

/// The seed and the effort of a [`Report`].
///
/// ```
/// use asperity_ndf_sampling::check::Settings;
///
/// let quick = Settings { samples: 10_000, ..Settings::default() };
/// assert_eq!(quick.seed, 0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Seed of the samples; the same seed, the same report.
    pub seed: u32,
    /// Samples of each χ² test; at least 4096 are drawn.
    pub samples: u32,
    /// Probability with which a χ² test may fail a right density.
    pub significance: f64,
}

impl Default for Settings {
    /// The seed 0, 65,536 samples, and a significance of 10⁻⁶: a thousand runs of two tests fail once in 500 times.
    fn default() -> Self {
        Self { seed: 0, samples: 1 << 16, significance: 1e-6 }
    }
}
