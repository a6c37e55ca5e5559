//! Time of single calls.

use std::hint::black_box;

use criterion::Criterion;

/// Measures `f` over all of `inputs`, one call after another.
pub(crate) fn each<T: Copy, R>(c: &mut Criterion, name: &str, inputs: &[T], mut f: impl FnMut(T) -> R) {
    let mut k = 0;
    c.bench_function(name, |b| {
        b.iter(|| {
            k = (k + 1) % inputs.len();
            f(black_box(inputs[k]))
        });
    });
}
