//! White noise.

#[allow(dead_code, reason = "each bench uses some of the forms")]
mod forms;

use asperity_noise::White;
use criterion::{Criterion, criterion_group, criterion_main};
use forms::{configuration, every_form};

fn white(criterion: &mut Criterion) {
    every_form(criterion, "white", White::default());
}

criterion_group! { name = benches; config = configuration(); targets = white }
criterion_main!(benches);
