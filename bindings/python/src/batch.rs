//! Functions of the rows of arrays.

use numpy::{Element, IntoPyArray, PyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::parallel;

/// The number of rows of one piece of work.
const PIECE: usize = 512;

/// Fewer rows are computed without starting a thread.
const SMALL: usize = 2048;

/// A contiguous array of rows.
pub(crate) type Rows<'py, T = f32> = PyReadonlyArray2<'py, T>;

/// A flat array.
pub(crate) type Flat<'py, T = f32> = Bound<'py, PyArray1<T>>;

pub(crate) fn value_error(message: impl ToString) -> PyErr {
    PyValueError::new_err(message.to_string())
}

/// Returns the results of a function of each row, with the GIL released.
pub(crate) fn map<'py, T, const IN: usize, const OUT: usize>(
    py: Python<'py>,
    rows: &Rows<'py, T>,
    threads: Option<isize>,
    f: impl Fn([T; IN]) -> [T; OUT] + Sync,
) -> PyResult<Flat<'py, T>>
where
    T: Element + Copy + Default + Send + Sync,
{
    if rows.shape()[1] != IN {
        return Err(value_error(format!("expected rows of {IN} numbers, got {}", rows.shape()[1])));
    }
    let rows = rows.as_slice().map_err(value_error)?.as_chunks::<IN>().0;
    let mut results = vec![T::default(); rows.len() * OUT];
    let pieces = rows.chunks(PIECE).zip(results.chunks_mut(PIECE * OUT)).collect();
    let threads = parallel::count(threads)?;
    parallel::for_each(
        py,
        threads,
        rows.len() <= SMALL,
        pieces,
        |(rows, results): (&[[T; IN]], &mut [T])| {
            for (row, result) in rows.iter().zip(results.as_chunks_mut::<OUT>().0) {
                *result = f(*row);
            }
        },
    )?;
    Ok(results.into_pyarray(py))
}
