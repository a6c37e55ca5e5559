//! Textures as arrays.

use asperity::program::{Array, bake_arrays};
use numpy::IntoPyArray;
use pyo3::prelude::*;

use crate::batch::{Flat, value_error};
use crate::parallel;

/// The name, the side and the channels of a map, and its numbers.
type Map<'py> = (&'static str, usize, usize, Flat<'py>);

/// Bakes a texture, given the options of `asperity bake` as words.
#[pyfunction]
pub(crate) fn bake(py: Python<'_>, options: Vec<String>) -> PyResult<Vec<Map<'_>>> {
    let baked =
        parallel::with_signals(py, |stop| bake_arrays(&options, stop).map_err(|error| error.to_string()));
    let maps = parallel::unless_signal(baked)?.map_err(value_error)?.into_iter();
    Ok(maps
        .map(|Array { name, side, channels, numbers }| (name, side, channels, numbers.into_pyarray(py)))
        .collect())
}
