//! Simplex noise with both kernel radii.

#[allow(dead_code, reason = "each bench uses some of the forms")]
mod forms;

use asperity_noise::Simplex;
use criterion::{Criterion, criterion_group, criterion_main};
use forms::{configuration, every_form};

fn simplex(criterion: &mut Criterion) {
    every_form(criterion, "simplex-continuous", Simplex::CONTINUOUS);
    every_form(criterion, "simplex-wide", Simplex::WIDE);
}

criterion_group! { name = benches; config = configuration(); targets = simplex }
criterion_main!(benches);
