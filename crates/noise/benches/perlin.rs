//! Gradient noise of 1985 and of 2002.

#[allow(dead_code, reason = "each bench uses some of the forms")]
mod forms;

use asperity_noise::{Perlin1985, Perlin2002};
use criterion::{Criterion, criterion_group, criterion_main};
use forms::{configuration, every_form};

fn perlin(criterion: &mut Criterion) {
    every_form(criterion, "perlin-1985", Perlin1985::default());
    every_form(criterion, "perlin-2002", Perlin2002::default());
}

criterion_group! { name = benches; config = configuration(); targets = perlin }
criterion_main!(benches);
