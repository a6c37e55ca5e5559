//! Table L: what the look-ups lose at a point, and their frames.

use asperity_ndf_sampling::{Ggx, Ndf, NormalTable, inverse_phi};
use asperity_tests::low_discrepancy::r2;
use glam::{Vec2, Vec3};

#[test]
fn quantile_error_of_the_slopes() {
    // The slope along x at z = (Φ⁻¹(u), 0) is its quantile of the line z₂ = 0.
    let ggx = Ggx::new(0.2, 0.4).unwrap();
    let table = NormalTable::standard(&ggx);
    let (mut nearest, mut bilinear) = (0.0_f32, 0.0_f32);
    for k in 1..2000 {
        let z = Vec2::new(inverse_phi(f64::from(k) / 2000.0) as f32, 0.0);
        let exact = ggx.from_gaussian(z);
        let error = |m: Vec3| (m.x - exact.x).hypot(m.y - exact.y);
        nearest = nearest.max(error(table.nearest(z).normal));
        bilinear = bilinear.max(error(table.bilinear(z).normal));
    }
    println!(
        "largest error of (n_x, n_y) for u in [0.0005, 0.9995]: nearest {nearest:.2e}, bilinear {bilinear:.2e}"
    );
    // Half a texel is 0.0176 deviations in each coordinate; interpolation errs by its square, most at |z| = 3.3.
    assert!(nearest < 0.02, "{nearest}");
    assert!(bilinear < 2e-4, "{bilinear}");
}

#[test]
fn frames_are_orthonormal_in_both_look_ups() {
    for alpha in [0.01, 0.3, 1.0] {
        let table = NormalTable::new(&Ggx::new(alpha, 0.5).unwrap(), 64).unwrap();
        for k in 0..5000 {
            let z = Vec2::from(r2(k).map(|u| u as f32)) * 12.0 - 6.0;
            for frame in [table.nearest(z), table.bilinear(z)] {
                let (t, b, n) = (frame.tangent, frame.bitangent, frame.normal);
                assert!((t.cross(b) - n).length() < 1e-6 && t.dot(b).abs() < 1e-6, "{z}: {frame:?}");
                assert!((n.length() - 1.0).abs() < 1e-6 && n.z >= 0.0, "{z}: {n}");
            }
        }
    }
}
