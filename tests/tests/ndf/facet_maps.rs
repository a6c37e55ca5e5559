//! Maps from and to Gaussian coordinates of every density: inversion, Jacobian, ends of the square.

use asperity_ndf_sampling::{
    AshikhminShirley, Beckmann, BlinnPhong, Ggx, Isotropic, Microfacet, Mixture, Ndf, Rotated, StudentT, Ward,
};
use asperity_tests::assert_abs_diff_eq;
use glam::{Vec2, Vec3};
use proptest::prelude::*;

/// Densities with roughnesses `x` and `y`, at most 1, and the tolerance of `T⁻¹(T(z))` relative to
/// `z` for |z| ≤ 6.
fn facets(x: f32, y: f32, gamma: f32, angle: f32) -> Vec<(&'static str, Box<dyn Microfacet>, f32)> {
    let [nu, nv] = [x, y].map(|alpha| 2.0 / (alpha * alpha) - 2.0);
    let isotropic = Beckmann::isotropic(x).expect("valid");
    let mixture = Mixture::new(isotropic, BlinnPhong::new_clamped(0.0), 0.7).expect("valid");
    let turned = Rotated::new(Ggx::new(x, y).expect("valid"), angle).expect("valid");
    vec![
        ("GGX", Box::new(Ggx::new(x, y).expect("valid")), 8e-6),
        ("Beckmann", Box::new(Beckmann::new(x, y).expect("valid")), 8e-6),
        ("Ward", Box::new(Ward::new(x, y).expect("valid")), 8e-6),
        ("Student-t", Box::new(StudentT::new(x, y, gamma).expect("valid")), 1e-5),
        ("Blinn–Phong", Box::new(BlinnPhong::new_clamped(nu)), 1e-5),
        ("Ashikhmin–Shirley", Box::new(AshikhminShirley::new_clamped(nu, nv)), 1e-5),
        ("mixture", Box::new(mixture), 1e-5),
        // The rounding of the longer slope leaks into the shorter slope.
        ("turned", Box::new(turned), 1e-5 + 4e-7 * (x / y).max(y / x)),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { rng_seed: proptest::test_runner::RngSeed::Fixed(4), failure_persistence: None, ..ProptestConfig::with_cases(600) })]

    #[test]
    fn inverse_undoes_the_map(
        log_x in -4.0_f32..0.0, log_y in -4.0_f32..0.0, gamma in 1.6_f32..50.0, turn in -4.0_f32..4.0,
        radius in 0.0_f32..6.0, angle in 0.0_f32..6.3,
    ) {
        let z = Vec2::from_angle(angle) * radius;
        for (name, ndf, tolerance) in facets(10f32.powf(log_x), 10f32.powf(log_y), gamma, turn) {
            let m = ndf.warp_gaussian(z);
            prop_assert!((m.length() - 1.0).abs() < 4e-7 && m.z > 0.0, "{name}: {m}");
            prop_assert!((ndf.invert(m) - z).length() < tolerance, "{name}: {z} -> {m} -> {}", ndf.invert(m));
        }
    }

    #[test]
    fn density_follows_from_the_map(
        x in 0.05_f32..1.0, y in 0.05_f32..1.0, gamma in 1.6_f32..50.0, turn in -4.0_f32..4.0, z1 in -3.0_f32..3.0, z2 in -3.0_f32..3.0,
    ) {
        // D dn_x dn_y = N(z) dz: central differences in f32 limit the accuracy to a few per mille,
        // or less near the mixture's bend.
        for (name, ndf, _) in facets(x, y, gamma, turn) {
            let e = 0.01;
            let at = |dx: f32, dy: f32| {
                let m = ndf.warp_gaussian(Vec2::new(z1 + dx, z2 + dy)).as_dvec3();
                [m.x, m.y]
            };
            let d = |a: [f64; 2], b: [f64; 2]| [0, 1].map(|k| (a[k] - b[k]) / (2.0 * f64::from(e)));
            let ([xx, yx], [xy, yy]) = (d(at(e, 0.0), at(-e, 0.0)), d(at(0.0, e), at(0.0, -e)));
            let jacobian = xx * yy - xy * yx;
            let gaussian = (-0.5 * f64::from(z1 * z1 + z2 * z2)).exp() / std::f64::consts::TAU;
            let density = f64::from(ndf.d(ndf.warp_gaussian(Vec2::new(z1, z2))));
            let ratio = density * jacobian / gaussian;
            let tolerance = if matches!(name, "GGX" | "Beckmann") { 0.01 } else { 0.02 };
            prop_assert!((ratio - 1.0).abs() < tolerance, "{name} at {z1} {z2}: {ratio}");
        }
    }

    #[test]
    fn tables_are_inverted(values in proptest::collection::vec(0.001_f32..1.0, 2..60), radius in 0.0_f32..6.0, angle in 0.0_f32..6.3) {
        let table = Isotropic::new(&values).unwrap();
        let z = Vec2::from_angle(angle) * radius;
        let m = table.warp_gaussian(z);
        prop_assert!((m.length() - 1.0).abs() < 4e-7 && m.z > 0.0, "{m}");
        prop_assert!((table.invert(m) - z).length() < 2e-5, "{z} -> {m} -> {}", table.invert(m));
        // Monotone in the radius.
        prop_assert!(table.warp_gaussian(z * 1.001).z <= m.z + 1e-7);
    }

    #[test]
    fn visible_normals_are_seen(
        log_x in -4.0_f32..0.0, log_y in -4.0_f32..0.0, gamma in 1.6_f32..50.0, turn in -4.0_f32..4.0,
        polar in 0.0_f32..1.57, azimuth in 0.0_f32..6.3, u1 in 0.0_f32..1.0, u2 in 0.0_f32..1.0,
    ) {
        let towards = Vec2::from_angle(azimuth) * polar.sin();
        let v = towards.extend(polar.cos());
        for (name, ndf, _) in facets(10f32.powf(log_x), 10f32.powf(log_y), gamma, turn) {
            let (m, area) = (ndf.sample_visible(v, Vec2::new(u1, u2)), ndf.projected_area(v));
            prop_assert!((m.length() - 1.0).abs() < 4e-7 && m.z > 0.0, "{name}: {m}");
            // The boundary of visibility is rounded.
            prop_assert!(v.dot(m) > -1e-6, "{name}: {v} sees {m} at {}", v.dot(m));
            prop_assert!(area >= v.z * 0.999_999 && area.is_finite(), "{name}: {v} {area}");
        }
    }
}

#[test]
fn ends_of_the_square_are_normals() {
    let ends = [0.0, f32::from_bits(1), 1e-10, 0.5, 1.0 - 0.5 * f32::EPSILON];
    for (name, ndf, _) in facets(0.3, 0.1, 1.6, 0.5) {
        for u in ends.into_iter().flat_map(|a| ends.map(|b| Vec2::new(a, b))) {
            let views =
                [Vec3::Z, Vec3::X, Vec3::new(0.6, 0.0, 0.8), Vec3::NEG_Y, Vec3::new(-1.0, 0.0, 1e-30)];
            let mut normals = vec![ndf.sample(u)];
            normals.extend(views.map(|v| ndf.sample_visible(v, u)));
            for m in normals {
                assert_abs_diff_eq!(m.length(), 1.0, epsilon = 4e-7, "{name} at {u}: {m}");
                assert!(m.z > 0.0, "{name} at {u}: {m}");
            }
        }
    }
}
