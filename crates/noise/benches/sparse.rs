//! Sparse convolution noise of one impulse per cell.

#[allow(dead_code, reason = "each bench uses some of the forms")]
mod forms;

use asperity_noise::Sparse;
use criterion::{Criterion, criterion_group, criterion_main};
use forms::{configuration, every_form};

fn sparse(criterion: &mut Criterion) {
    every_form(criterion, "sparse", Sparse::default());
}

criterion_group! { name = benches; config = configuration(); targets = sparse }
criterion_main!(benches);
