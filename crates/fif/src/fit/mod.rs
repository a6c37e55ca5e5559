//! Fits to data: vertical scalings by least squares, knots by Mazel and Hayes, refinement, and
//! errors.
//!
//! ```
//! use asperity_fif::{Fif, fit};
//! // Recovers the scalings from 65 samples of a function that repeats itself on four parts.
//! let knots = [0.0, 0.25, 0.5, 0.75, 1.0];
//! let f = Fif::affine(&knots, &[0.0, 1.0, -1.0, 0.5, 0.0], &[0.5, -0.4, 0.3, 0.6])?;
//! let x: Vec<f64> = (0..=64).map(|k| f64::from(k) / 64.0).collect();
//! let y: Vec<f64> = x.iter().map(|&x| f.evaluate(x, 1e-14).value).collect();
//! let fit = fit::affine(&x, &y, &[0, 16, 32, 48, 64])?;
//! assert!((fit.system.pieces()[3].map().alpha - 0.6).abs() < 1e-12 && fit.error < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub(crate) mod collage;
mod knots;
pub(crate) mod refine;

pub use collage::{Fit, affine};
pub use knots::knots;
pub use refine::refine;
