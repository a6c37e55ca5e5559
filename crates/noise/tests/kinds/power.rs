//! Powers of a field.

use asperity_noise::{Field, Perlin, glam::Vec2, ops::Power};

#[test]
fn power_matches_products() {
    let (field, p) = (Perlin::new(3), Vec2::new(0.3, 1.8));
    let n = field.sample(p);
    let [one, itself, cube] = [0, 1, 3].map(|k| Power(field, k).sample(p));
    assert_eq!((one.value, one.gradient), (1.0, Vec2::ZERO));
    assert_eq!(itself, n);
    assert_eq!(cube.value, n.value * n.value * n.value);
    assert_eq!(cube.gradient, 3.0 * (n.value * n.value) * n.gradient);
}
