//! Sums of octaves of gradient noise: rotated, aligned, turbulence and the ridged multifractal, of eight octaves.

#[allow(dead_code, reason = "each bench uses some of the forms")]
mod forms;

use asperity_noise::{
    Kernel, Octaves, Perlin2002, Point, RidgedMultifractal, Rotation, Spectrum, Turbulence,
    glam::{Vec2, Vec3},
};
use criterion::{Criterion, criterion_group, criterion_main};
use forms::{batches, configuration};

fn sums(criterion: &mut Criterion) {
    of_dimension::<Vec2, 2>(criterion, [64; 2]);
    of_dimension::<Vec3, 3>(criterion, [16; 3]);
}

fn of_dimension<V: Point<N>, const N: usize>(criterion: &mut Criterion, size: [usize; N])
where
    Perlin2002: Kernel<N>,
{
    let rotated = Octaves::<_, N>::new(Perlin2002::default(), Spectrum::default(), Default::default(), 1);
    batches::<V, _, N>(criterion, "perlin-2002-octaves-8-rotated", &rotated.first(8.0), size);
    let aligned = rotated.with_rotation(Rotation::Aligned);
    batches::<V, _, N>(criterion, "perlin-2002-octaves-8", &aligned.first(8.0), size);
    let turbulence = aligned.with_shape(Turbulence);
    batches::<V, _, N>(criterion, "perlin-2002-turbulence-8", &turbulence.first(8.0), size);
    let ridged = RidgedMultifractal::<_, N>::new(Perlin2002::default(), Spectrum::default(), 2.0, 1);
    let ridged = ridged.expect("a feedback in range");
    batches::<V, _, N>(criterion, "perlin-2002-ridged-multifractal-8", &ridged.first(8.0), size);
}

criterion_group! { name = benches; config = configuration(); targets = sums }
criterion_main!(benches);
