//! Filtered models.

use std::path::PathBuf;

use asperity::cli::filter::{Filter, FilteredFormat};
use asperity::filter::summary::{FilteredLevel, FilteredMaterial, Summary};
use pyo3::prelude::*;

use crate::batch::value_error;
use crate::parallel;

/// Width, height, and mean roughness before and after.
type Level = (usize, usize, f64, f64);

/// Index, name, levels, why the material is left as it is, and the error before and after.
type Material = (usize, String, Option<Vec<Level>>, Option<String>, Option<[f64; 2]>);

/// Filters a model, and returns its materials with a normal map and the files written.
#[pyfunction]
pub(crate) fn filter(
    py: Python<'_>,
    model: PathBuf,
    out: PathBuf,
    format: &str,
    anisotropy: bool,
    png: Option<PathBuf>,
    report: bool,
) -> PyResult<(Vec<Material>, Vec<String>)> {
    let format = match format {
        "uastc" => FilteredFormat::Uastc,
        "zstd" => FilteredFormat::Zstd,
        _ => return Err(value_error(format!("`format` must be uastc or zstd, got `{format}`"))),
    };
    let wanted = Filter { model, out, format, anisotropy, png, report };
    let filtered = parallel::with_signals(py, |stop| {
        asperity::filter::filter(&wanted, stop).map_err(|error| error.to_string())
    });
    let Summary { materials, files } = parallel::unless_signal(filtered)?.map_err(value_error)?;
    let materials = materials.into_iter().map(|FilteredMaterial { index, name, outcome, error }| {
        let (levels, why) = match outcome {
            Ok(levels) => (Some(levels), None),
            Err(why) => (None, Some(why)),
        };
        let level = |FilteredLevel { width, height, before, after }| (width, height, before, after);
        (index, name, levels.map(|levels| levels.into_iter().map(level).collect()), why, error)
    });
    Ok((materials.collect(), files))
}
