//! The command `asperity` in a Python process.

use std::ffi::OsString;
use std::path::PathBuf;

use asperity::invocation::Invocation;
use pyo3::prelude::*;

use crate::parallel;

/// Runs a command line, the name of the program first, and returns the exit code.
///
/// `command` runs the program again, and the bytes of `binary` identify it. A signal stops the command.
#[pyfunction]
pub(crate) fn run(py: Python<'_>, words: Vec<OsString>, command: PathBuf, binary: PathBuf) -> PyResult<u8> {
    let invocation = Invocation { words, command, binary };
    let (code, signal) = parallel::with_signals(py, |stop| asperity::program::run(&invocation, stop));
    match code {
        Some(code) => Ok(code),
        None => Err(signal.unwrap_or_else(parallel::panicked)),
    }
}
