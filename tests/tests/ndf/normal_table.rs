//! Table L: lookup errors at a point, and frames.

use asperity_ndf_sampling::{
    Beckmann, Frame, Ggx, Ndf, NormalLut, inverse_gaussian_cdf,
    normal_table::{Chart, Spacing, TableLayout},
};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::low_discrepancy::r2;
use glam::{Vec2, Vec3};

const SPACINGS: [Spacing; 3] = [Spacing::Coordinates, Spacing::Quantiles, Spacing::Warped];
const CHARTS: [Chart; 3] = [Chart::Projected, Chart::Slopes, Chart::Stereographic];

#[test]
fn quantile_error_of_the_slopes() {
    // The slope along x at z = (Φ⁻¹(u), 0) is its quantile on the line z₂ = 0.
    let ggx = Ggx::new(0.2, 0.4).unwrap();
    let table = NormalLut::standard(&ggx);
    let (mut nearest, mut bilinear) = (0.0_f32, 0.0_f32);
    for k in 1..2000 {
        let z = Vec2::new(inverse_gaussian_cdf(f64::from(k) / 2000.0) as f32, 0.0);
        let exact = ggx.warp_gaussian(z);
        let error = |m: Vec3| (m.x - exact.x).hypot(m.y - exact.y);
        nearest = nearest.max(error(table.nearest(z).normal));
        bilinear = bilinear.max(error(table.bilinear(z).normal));
    }
    println!(
        "largest error of (n_x, n_y) for u in [0.0005, 0.9995]: nearest {nearest:.2e}, bilinear {bilinear:.2e}"
    );
    // Half a texel is 0.0176 deviations in each coordinate. The interpolation error is its square,
    // largest at |z| = 3.3.
    assert!(nearest < 0.02, "{nearest}");
    assert!(bilinear < 2e-4, "{bilinear}");
}

#[test]
fn frames_are_orthonormal_in_every_layout() {
    let orthonormal = |frame: &Frame, at: Vec2| {
        let (t, b, n) = (frame.tangent, frame.bitangent, frame.normal);
        assert_abs_diff_eq!((t.cross(b) - n).length(), 0.0, epsilon = 1e-6, "{at}: {frame:?}");
        assert_abs_diff_eq!(t.dot(b), 0.0, epsilon = 1e-6, "{at}: {frame:?}");
        assert_abs_diff_eq!(n.length(), 1.0, epsilon = 1e-6, "{at}: {n}");
        assert!(n.z >= 0.0, "{at}: {n}");
    };
    for (spacing, chart) in SPACINGS.into_iter().flat_map(|spacing| CHARTS.map(|chart| (spacing, chart))) {
        for alpha in [0.01, 0.3, 1.0] {
            let ggx = Ggx::new(alpha, 0.5).unwrap();
            let table = NormalLut::with_layout(&ggx, 64, TableLayout { spacing, chart }).unwrap();
            let halves = table.halves();
            let packed = NormalLut::from_entries(64, table.layout(), &halves).unwrap();
            for k in 0..1000 {
                let z = Vec2::from(r2(k).map(|u| u as f32)) * 12.0 - 6.0;
                for frame in [table.nearest(z), table.bilinear(z), packed.nearest(z), packed.bilinear(z)] {
                    orthonormal(&frame, z);
                }
            }
        }
    }
}

#[test]
fn adjacent_frames_differ_little() {
    // The steps of 256² entries. The largest are next to the horizon, or at the border of an
    // island.
    for (name, ndf, most) in [
        ("GGX 0.2 0.4", &Ggx::new(0.2, 0.4).unwrap() as &dyn Ndf, 2.5),
        ("GGX 1", &Ggx::isotropic(1.0).unwrap(), 2.5),
        ("Beckmann 0.3", &Beckmann::isotropic(0.3).unwrap(), 0.5),
    ] {
        let step = NormalLut::standard(ndf).accuracy(ndf).largest_step.to_degrees();
        println!("{name}: {step:.2}°");
        assert!(step < most, "{name}: {step}");
    }
}
