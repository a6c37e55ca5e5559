//! Value-gradient noise.

#[allow(dead_code, reason = "each bench uses some of the forms")]
mod forms;

use asperity_noise::ValueGradient;
use criterion::{Criterion, criterion_group, criterion_main};
use forms::{configuration, every_form};

fn value_gradient(criterion: &mut Criterion) {
    every_form(criterion, "value-gradient", ValueGradient::default());
}

criterion_group! { name = benches; config = configuration(); targets = value_gradient }
criterion_main!(benches);
