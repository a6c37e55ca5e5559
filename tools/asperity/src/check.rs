//! `asperity check-ndf`: runs property tests of normal distributions and prints the report.

use asperity_ndf_sampling::check::{Settings, ndf};

use crate::cli;
use crate::failure::Failure;
use crate::input::density::Density;
use crate::progress;

/// Checks each given distribution.
pub(crate) fn check(wanted: &cli::CheckNdf) -> Result<(), Failure> {
    let settings = Settings { seed: wanted.seed, ..Settings::default() };
    let mut failed = 0;
    for spec in &wanted.ndf {
        let density = Density::parse(spec, wanted.images)?;
        let report = ndf(density.ndf.as_ref(), settings);
        progress::say(&format!("{}\n{report}", density.name()));
        if !report.passed() && density.is_in_steps() {
            progress::note(
                "an image is a piecewise constant density, whose map T has a kink at every texel edge; \
                 `--reconstruction bilinear` avoids the kinks",
            );
        }
        failed += report.failures().count();
    }
    match failed {
        0 => Ok(()),
        1 => Err("1 check failed".into()),
        _ => Err(format!("{failed} checks failed").into()),
    }
}
