//! The printed noises at points that are not finite, and far from the origin.

use asperity_core::SplitMix64;
use asperity_noise::{
    Field, Sample,
    ebert_1994::{Gnoise, LectureTables, Vnoise},
    glam::Vec3,
    lattice::PermutationTable,
};

fn tables() -> LectureTables {
    let stream = |start: u64| {
        let mut counter = start;
        move || {
            counter += 1;
            (SplitMix64::nth(counter) >> 11) as f64 / 9_007_199_254_740_992.0
        }
    };
    LectureTables::new(PermutationTable::new(4), stream(0), stream(1000))
}

#[test]
fn printed_noises_at_nonfinite_points() {
    let tables = tables();
    let nowhere = Vec3::new(f32::NAN, 0.0, 0.0);
    assert_eq!(Vnoise(&tables).sample(nowhere), Sample::default());
    assert_eq!(Gnoise(&tables).sample(nowhere), Sample::default());
    assert_eq!(Vnoise(&tables).value(Vec3::splat(3e9)), Vnoise(&tables).value(Vec3::ZERO));
}
