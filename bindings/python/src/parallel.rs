//! Work on threads that stops when Python has a signal.

use std::collections::HashMap;
use std::num::NonZero;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;
use std::{process, thread};

use pyo3::exceptions::{PyOSError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use rayon::{ThreadPool, ThreadPoolBuilder};

/// How often signals are checked.
const PERIOD: Duration = Duration::from_millis(20);

/// The stack of a thread: transforms of noise that are nested have a buffer each.
const STACK: usize = 64 << 20;

/// Pools by process and number of threads.
type Pools = HashMap<(u32, usize), Arc<ThreadPool>>;

/// The pools in use. The threads of a pool do not survive a fork, so a child process has its own.
static POOLS: Mutex<Option<Pools>> = Mutex::new(None);

/// Returns the number of threads to use, all cores by default.
pub(crate) fn count(threads: Option<isize>) -> PyResult<usize> {
    match threads {
        Some(threads @ ..1) => {
            Err(PyValueError::new_err(format!("`threads` must be at least 1, got {threads}")))
        }
        Some(threads) => Ok(threads.unsigned_abs().min(1024)),
        None => Ok(thread::available_parallelism().map_or(1, NonZero::get)),
    }
}

fn pool(threads: usize) -> PyResult<Arc<ThreadPool>> {
    let mut pools = POOLS.lock().unwrap_or_else(PoisonError::into_inner);
    let pools = pools.get_or_insert_with(Pools::new);
    if let Some(pool) = pools.get(&(process::id(), threads)) {
        return Ok(Arc::clone(pool));
    }
    let pool = ThreadPoolBuilder::new().num_threads(threads).stack_size(STACK).build();
    let pool = Arc::new(pool.map_err(|error| PyOSError::new_err(error.to_string()))?);
    pools.insert((process::id(), threads), Arc::clone(&pool));
    Ok(pool)
}

/// Works on all items with the GIL released, on `threads` threads.
///
/// Returns the exception of a signal handler, for instance `KeyboardInterrupt`, after the items that
/// are in work. A `small` amount of work is done at once on the calling thread.
pub(crate) fn for_each<T: Send>(
    py: Python<'_>,
    threads: usize,
    small: bool,
    items: Vec<T>,
    work: impl Fn(T) + Sync,
) -> PyResult<()> {
    if small {
        py.detach(|| items.into_iter().for_each(&work));
        return Ok(());
    }
    let pool = if threads > 1 { Some(pool(threads)?) } else { None };
    until_signal(py, |stop| {
        let each = |item| {
            if !stop.load(Ordering::Relaxed) {
                work(item);
            }
        };
        match pool {
            Some(pool) => pool.install(|| items.into_par_iter().for_each(each)),
            None => items.into_iter().for_each(each),
        }
    })
}

/// Runs work as [`with_signals`] does, and returns the exception of a signal handler
/// in place of its result.
pub(crate) fn until_signal<R: Send>(
    py: Python<'_>,
    work: impl FnOnce(&AtomicBool) -> R + Send,
) -> PyResult<R> {
    unless_signal(with_signals(py, work))
}

/// Returns a result, or the exception in its place.
pub(crate) fn unless_signal<R>(outcome: (Option<R>, Option<PyErr>)) -> PyResult<R> {
    match outcome {
        (_, Some(signal)) => Err(signal),
        (Some(result), None) => Ok(result),
        (None, None) => Err(panicked()),
    }
}

/// Runs work on a thread of the pool of all cores with the GIL released, and sets its flag at a
/// signal.
///
/// A new thread would take longer than the values of 20,000 points. The threads of rayon's global
/// pool do not survive a fork.
///
/// The result is `None` if the work panicked.
#[expect(clippy::redundant_closure_for_method_calls, reason = "the method is not general enough")]
pub(crate) fn with_signals<R: Send>(
    py: Python<'_>,
    work: impl FnOnce(&AtomicBool) -> R + Send,
) -> (Option<R>, Option<PyErr>) {
    let pool = match count(None).and_then(pool) {
        Ok(pool) => pool,
        Err(error) => return (None, Some(error)),
    };
    let stop = AtomicBool::new(false);
    py.detach(|| {
        let (mut result, mut signal) = (None, None);
        pool.in_place_scope(|scope| {
            let (done, finished) = mpsc::channel();
            let stop = &stop;
            scope.spawn(move |_| {
                if let Ok(result) = catch_unwind(AssertUnwindSafe(|| work(stop))) {
                    let _ = done.send(result);
                }
            });
            result = loop {
                match finished.recv_timeout(PERIOD) {
                    Ok(result) => break Some(result),
                    Err(RecvTimeoutError::Disconnected) => break None,
                    Err(RecvTimeoutError::Timeout) if signal.is_none() => {
                        if let Err(error) = Python::attach(|py| py.check_signals()) {
                            stop.store(true, Ordering::Relaxed);
                            signal = Some(error);
                        }
                    }
                    Err(RecvTimeoutError::Timeout) => {}
                }
            };
        });
        (result, signal)
    })
}

/// The exception of a thread that panicked.
pub(crate) fn panicked() -> PyErr {
    PyRuntimeError::new_err("a thread panicked")
}
