//! Value-gradient noise: settings, and its parts at lattice points.

use asperity_noise::{Field, NoiseError, ValueGradient, glam::Vec2};

#[test]
fn value_gradient_rejects_invalid_weight() {
    for weight in [-0.0, 0.0, 0.3, 1.0] {
        assert_eq!(ValueGradient::default().with_weight(weight).unwrap().weight(), weight);
    }
    for weight in [-1e-9, 1.000_001, f32::INFINITY] {
        assert_eq!(
            ValueGradient::default().with_weight(weight),
            Err(NoiseError::OutOfRange { parameter: "weight", value: weight, min: 0.0, max: 1.0 })
        );
    }
    assert!(ValueGradient::default().with_weight(f32::NAN).is_err());
}

#[test]
fn value_gradient_parts_at_lattice_points() {
    let p = Vec2::new(3.0, -2.0);
    assert_eq!(ValueGradient::default().with_weight(1.0).unwrap().with_seed(1).value(p), 0.0);
    assert_eq!(
        ValueGradient::default().with_weight(0.0).unwrap().with_seed(1).sample(p).gradient,
        Vec2::ZERO
    );
}
