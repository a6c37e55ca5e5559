//! Curl noise.

use approx::abs_diff_eq;
use asperity_noise::{
    Field, Perlin, Simplex,
    curl::{Curl2, Curl3, CurlPotential},
    glam::{Vec2, Vec3},
};

#[test]
fn curl_is_perpendicular_to_gradients() {
    let fields = [1, 2, 3].map(Perlin::new);
    for i in 0..20_u8 {
        let p = Vec3::new(0.31 * f32::from(i), 1.7, -0.4 * f32::from(i));
        let [a, b, _] = fields.map(|field| field.sample(p).gradient);
        let v = Curl3(fields[0], fields[1]).velocity(p);
        // Each component of v is rounded by 3 half ulps of a product of gradients under 4.
        assert!(
            abs_diff_eq!(v.dot(a), 0.0, epsilon = 2e-5) && abs_diff_eq!(v.dot(b), 0.0, epsilon = 2e-5),
            "{p}: {v}"
        );
        let flat = Curl2(fields[0]).velocity(p.truncate());
        let gradient: Vec2 = fields[0].sample(p.truncate()).gradient;
        assert_eq!(flat.x * gradient.x + flat.y * gradient.y, 0.0);
    }
}

#[test]
fn curl_velocity_matches_velocity_and_jacobian() {
    let fields = [1, 2, 3].map(Simplex::new);
    let p = Vec3::new(0.2, -1.3, 5.5);
    let pair = Curl3(fields[0], fields[1]);
    assert_eq!(pair.velocity(p), pair.velocity_and_jacobian(p).velocity);
    let potential = CurlPotential(fields);
    assert_eq!(potential.velocity(p), potential.velocity_and_jacobian(p).velocity);
    let flat = Curl2(fields[0]);
    assert_eq!(flat.velocity(p.truncate()), flat.velocity_and_jacobian(p.truncate()).velocity);
}
