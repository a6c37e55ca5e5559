//! Reports of property tests: quantities with limits, settings, and Pearson's χ² test.

mod chi_square;
mod report;
mod settings;

pub use chi_square::p_value;
pub use report::{Check, Limit, Report};
pub use settings::Settings;
