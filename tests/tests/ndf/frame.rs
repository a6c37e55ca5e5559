//! Tangent frames: orthonormal, right-handed, and the minimal rotation.

use asperity_ndf_sampling::Frame;
use glam::{Mat3, Quat, Vec3};
use proptest::prelude::*;

/// Returns the maximum deviation of the frame's matrix from a rotation.
fn departure(frame: Frame) -> f32 {
    let m = Mat3::from_cols(frame.tangent, frame.bitangent, frame.normal);
    let defect = m.transpose() * m - Mat3::IDENTITY;
    let handed = (frame.tangent.cross(frame.bitangent) - frame.normal).abs().max_element();
    defect.to_cols_array().into_iter().fold(handed, |worst, entry| worst.max(entry.abs()))
}

#[test]
fn orthonormal_everywhere_including_the_opposite_pole() {
    let mut worst = 0.0_f32;
    for exponent in 0..24 {
        let tilt = 10f32.powi(-exponent);
        for k in 0..100 {
            let (sin, cos) = (k as f32 * 0.0628).sin_cos();
            for z in [-1.0_f32, 1.0] {
                let n = Vec3::new(tilt * cos, tilt * sin, z).normalize();
                worst = worst.max(departure(Frame::from_normal(n)));
            }
        }
    }
    println!("worst departure from orthonormal: {worst:e}");
    assert!(worst < 1e-6, "{worst:e}");
}

#[test]
fn continuous_over_the_upper_hemisphere() {
    for k in 0..10_000 {
        let (sin, cos) = (k as f32 * 0.7).sin_cos();
        let radius = (k as f32 / 10_000.0).sqrt();
        let n = |r: f32| Vec3::new(r * cos, r * sin, (1.0 - r * r).max(0.0).sqrt()).normalize();
        let (a, b) = (Frame::from_normal(n(radius)), Frame::from_normal(n(radius * 0.999)));
        let step = (a.normal - b.normal).length();
        assert!((a.tangent - b.tangent).length() <= 2.0 * step + 1e-6, "{}", n(radius));
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        rng_seed: proptest::test_runner::RngSeed::Fixed(4), failure_persistence: None, ..ProptestConfig::with_cases(2000)
    })]

    #[test]
    fn frame_is_the_minimal_rotation(x in -1.0_f32..1.0, y in -1.0_f32..1.0, z in -1.0_f32..1.0) {
        let n = Vec3::new(x, y, z);
        prop_assume!(n.length() > 0.1 && n.normalize().z > -0.99);
        let n = n.normalize();
        let (frame, rotation) = (Frame::from_normal(n), Quat::from_rotation_arc(Vec3::Z, n));
        prop_assert!(frame.tangent.abs_diff_eq(rotation * Vec3::X, 2e-6), "{} {}", frame.tangent, rotation * Vec3::X);
        prop_assert!(frame.bitangent.abs_diff_eq(rotation * Vec3::Y, 2e-6));
        prop_assert!(departure(frame) < 1e-6);
    }

    #[test]
    fn tangent_frame_is_orthonormal_and_keeps_the_plane(
        n in prop::array::uniform3(-1.0_f32..1.0), t in prop::array::uniform3(-10.0_f32..10.0),
    ) {
        let (n, t) = (Vec3::from(n), Vec3::from(t));
        prop_assume!(n.length() > 0.01);
        let frame = Frame::from_normal_tangent(n, t);
        prop_assert!(departure(frame) < 1e-6, "{}", departure(frame));
        if n.normalize().cross(t.normalize_or_zero()).length() > 0.01 {
            prop_assert!(frame.bitangent.dot(t.normalize()).abs() < 1e-5, "tangent left the plane of n and t");
            prop_assert!(frame.tangent.dot(t) > 0.0);
        }
    }

    #[test]
    fn local_and_world_are_inverse(n in prop::array::uniform3(-1.0_f32..1.0), v in prop::array::uniform3(-1.0_f32..1.0)) {
        let (frame, v) = (Frame::from_normal(Vec3::from(n)), Vec3::from(v));
        prop_assert!(frame.to_world(frame.to_local(v)).abs_diff_eq(v, 2e-6));
        prop_assert!(frame.to_local(frame.to_world(v)).abs_diff_eq(v, 2e-6));
        prop_assert!(frame.to_local(frame.normal).abs_diff_eq(Vec3::Z, 1e-6));
    }
}
