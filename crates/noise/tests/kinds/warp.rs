//! Warps of a field.

use asperity_noise::{
    Field, NoiseError, Perlin, Simplex, Warp,
    glam::{Vec2, Vec3},
};

#[test]
fn warp_of_strength_0_is_the_field() {
    let field = Perlin::new(1);
    let warp = Warp::new(field, [2, 3, 4].map(Simplex::new), 0.0).unwrap();
    let p = Vec3::new(0.3, -4.1, 7.7);
    assert_eq!(warp.sample(p), field.sample(p));
    assert_eq!(warp.displacement(p).jacobian, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
}

#[test]
fn warp_with_nonfinite_strength_or_points() {
    let field = Perlin::new(1);
    for strength in [f32::INFINITY, f32::NEG_INFINITY] {
        let error = NoiseError::Invalid { parameter: "strength", value: strength, rule: "finite" };
        assert_eq!(Warp::new(field, [field; 2], strength), Err(error));
    }
    assert!(Warp::new(field, [field; 2], f32::NAN).is_err());
    let warp = Warp::new(field, [field; 2], 1.0).unwrap();
    for p in [Vec2::new(f32::NAN, 0.0), Vec2::new(0.0, f32::INFINITY)] {
        assert_eq!((warp.value(p), warp.sample(p).gradient), (0.0, Vec2::ZERO), "{p}");
    }
}
