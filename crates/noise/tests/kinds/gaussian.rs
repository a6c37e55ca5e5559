//! Gaussian noise: its pair, its parts, and points that are not finite.

use approx::assert_abs_diff_eq;
use asperity_noise::{
    Field, GaussianNoise, Sample,
    glam::{Vec2, Vec3},
};

#[test]
fn gaussian_pair_starts_with_sample() {
    let noise = GaussianNoise::default();
    for i in 0..100_u8 {
        let p = Vec3::new(0.37 * f32::from(i), -0.21 * f32::from(i), 3.1);
        let [first, second] = noise.with_seed(5).pair(p);
        assert_eq!(first, noise.with_seed(5).sample(p));
        assert_eq!(first.value, noise.with_seed(5).value(p));
        assert_ne!(first.value, second.value);
    }
}

#[test]
fn gaussian_is_unnormalized_over_deviation() {
    let p = Vec2::new(1.3, -2.6);
    let (n, v) = (GaussianNoise::new(3).unnormalized(p), GaussianNoise::new(3).variance(p));
    let z = GaussianNoise::new(3).sample(p).value;
    assert_abs_diff_eq!(n.value / v.value.sqrt(), z, epsilon = 1e-6);
    let corner = GaussianNoise::new(3).variance(Vec2::new(4.0, 7.0));
    assert_eq!(corner.value, 1.0);
}

#[test]
fn gaussian_at_far_and_nonfinite_points() {
    let noise = GaussianNoise::default();
    assert_eq!(noise.with_seed(1).pair(Vec2::new(f32::NAN, 1.0)), [Sample::default(); 2]);
    let nowhere = Vec2::new(f32::INFINITY, 1.0);
    assert_eq!([noise.unnormalized(nowhere), noise.variance(nowhere)], [Sample::default(); 2]);
    let far = noise.with_seed(1).pair(Vec3::new(2e9, -2e9, 1e30));
    assert!(far.iter().all(|sample| sample.value.is_finite() && sample.value != 0.0));
}
