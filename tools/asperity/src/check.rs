//! `asperity check-ndf`: property tests of a density of normals, printed.

use asperity_ndf_sampling::check::{Settings, ndf};

use asperity::cli;
use asperity::failure::Failure;
use asperity::input::density::Density;
use asperity::progress;

/// Checks each density that is asked for.
pub(crate) fn check(wanted: &cli::CheckNdf) -> Result<(), Failure> {
    let settings = Settings { seed: wanted.seed, ..Settings::default() };
    let mut failed = 0;
    for spec in &wanted.ndf {
        let density = Density::parse(spec, wanted.images)?;
        let report = ndf(density.ndf.as_ref(), settings);
        progress::say(&format!("{}\n{report}", density.name()));
        if !report.passed() && density.is_in_steps() {
            progress::note(
                "an image is a density in steps, whose map has a kink at the edge of every texel; \
                 `--reconstruction bilinear` has none",
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
