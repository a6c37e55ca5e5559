//! Points from other vector libraries, by the feature `mint`.

use asperity_noise::{Field, Simplex, glam::Vec3};

#[test]
fn mint_vectors_are_points() {
    let noise = Simplex::new(7);
    let p = mint::Vector3 { x: 0.3_f32, y: 1.7, z: -0.4 };
    let sample = noise.sample(Vec3::from(p));
    assert_eq!(sample, noise.sample(Vec3::new(0.3, 1.7, -0.4)));
    let gradient: mint::Vector3<f32> = sample.gradient.into();
    assert_eq!(gradient.y, sample.gradient.y);
}
