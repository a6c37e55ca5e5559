//! Value noise with quintic weights and with Catmull–Rom splines.

#[allow(dead_code, reason = "each bench uses some of the forms")]
mod forms;

use asperity_noise::{Value, ValueCatmullRom};
use criterion::{Criterion, criterion_group, criterion_main};
use forms::{configuration, every_form};

fn value(criterion: &mut Criterion) {
    every_form(criterion, "value-quintic", Value::default());
    every_form(criterion, "value-catmull-rom", ValueCatmullRom::default());
}

criterion_group! { name = benches; config = configuration(); targets = value }
criterion_main!(benches);
