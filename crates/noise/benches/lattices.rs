//! The lattices that gradient noise can be drawn from.

#[allow(dead_code, reason = "each bench uses some of the forms")]
mod forms;

use asperity_noise::{
    ChainedTable, IntegerHash, Lattice, Noise, Perlin2002, PermutationTable, Tiled, glam::Vec3,
};
use criterion::{Criterion, criterion_group, criterion_main};
use forms::{calls, configuration};

fn lattices(criterion: &mut Criterion) {
    of_lattice(criterion, "integer-hash", IntegerHash);
    of_lattice(criterion, "permutation-table", PermutationTable::new(1));
    of_lattice(criterion, "chained-table", ChainedTable(PermutationTable::new(1)));
    of_lattice(criterion, "tiled", Tiled::new(IntegerHash, [16; 3]).expect("periods in range"));
}

fn of_lattice(criterion: &mut Criterion, name: &str, lattice: impl Lattice + Copy) {
    let noise = Perlin2002(lattice);
    let at = |i: usize| Vec3::new(0.3, -7.0, 2.0) + Vec3::new(0.21, 0.17, -0.13) * i as f32;
    calls(criterion, "value", 3, &format!("perlin-2002-{name}"), |i| noise.value(at(i), 1));
    calls(criterion, "sample", 3, &format!("perlin-2002-{name}"), |i| noise.sample(at(i), 1));
}

criterion_group! { name = benches; config = configuration(); targets = lattices }
criterion_main!(benches);
