//! Errors of a noise relative to its reference.

use asperity_noise::{
    Field, IntegerHash, Lattice, Noise, Point, Sample,
    glam::{Vec2, Vec3, Vec4},
};

use crate::{
    noise_any::{At, at},
    noise_reference::{Kind, Words},
    random::Random,
};

/// Returns a coordinate within ±4096 with twelve fractional bits, which `f32` represents exactly,
/// so that no point moves across a face.
fn coordinate(random: &mut Random) -> f32 {
    ((random.uniform() - 0.5) * 8192.0 * 4096.0).round() as f32 / 4096.0
}

/// Returns the maximum errors of value and gradient of a noise in 1 to 4 dimensions, at points
/// within ±4096 divided by a power of two.
#[must_use]
pub fn errors_by_dimension<K>(noise: K, lattice: &impl Lattice, kind: Kind, divisor: f32) -> [[f64; 2]; 4]
where
    K: Noise + Field<f32> + Field<Vec2> + Field<Vec3> + Field<Vec4> + Copy,
{
    fn of<V: Point<Coordinates = [f32; N]>, const N: usize>(
        noise: impl Noise + Field<V> + Copy,
        lattice: &impl Lattice,
        kind: Kind,
        divisor: f32,
    ) -> [f64; 2] {
        let words = |cell: [i32; N], seed| kind.word(lattice, cell, seed);
        let at = |p, seed| at(noise.with_seed(seed).sample(V::from_coordinates(p)));
        errors_on(&words, kind, divisor, &at)
    }
    [
        of::<f32, 1>(noise, lattice, kind, divisor),
        of::<Vec2, 2>(noise, lattice, kind, divisor),
        of::<Vec3, 3>(noise, lattice, kind, divisor),
        of::<Vec4, 4>(noise, lattice, kind, divisor),
    ]
}

/// Returns the maximum errors of value and gradient at points within ±4096 divided by a power of
/// two.
#[must_use]
pub fn errors<V: Point<Coordinates = [f32; N]>, const N: usize>(
    kind: Kind,
    divisor: f32,
    noise: impl Fn(V, u32) -> Sample<V>,
) -> [f64; 2] {
    let noise = |p, seed| at(noise(V::from_coordinates(p), seed));
    errors_on(&|cell, seed| kind.word(&IntegerHash, cell, seed), kind, divisor, &noise)
}

/// Returns the maximum errors on a lattice, type-erased, so that the code is compiled once per
/// dimension.
///
/// # Panics
///
/// If hardly any gradient could be compared.
#[must_use]
pub fn errors_on<const N: usize>(
    words: Words<'_, N>,
    kind: Kind,
    divisor: f32,
    noise: &dyn Fn([f32; N], u32) -> At<N>,
) -> [f64; 2] {
    let scale = kind.scales()[N - 1];
    // Splines and impulses in 4-D have hundreds of parts each.
    let points = if N == 4 { 800 } else { 3000 };
    let mut random = Random(2);
    let mut worst = [0.0_f64; 2];
    let mut compared = 0;
    for seed in 0..points {
        let p = [(); N].map(|()| coordinate(&mut random) / divisor);
        let wide = p.map(f64::from);
        let sample = noise(p, seed);
        let value = scale * kind.value_on(words, wide, seed);
        worst[0] = worst[0].max((f64::from(sample.value) - value).abs());
        if let Some(gradient) = kind.gradient_on(words, wide, seed) {
            compared += 1;
            for (got, expected) in sample.gradient.into_iter().zip(gradient) {
                worst[1] = worst[1].max((f64::from(got) - scale * expected).abs());
            }
        }
    }
    assert!(compared > points * 9 / 10, "{compared} gradients");
    worst
}
