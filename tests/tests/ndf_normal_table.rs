//! Table L: what the look-ups lose, measured against the exact bins of GGX (0.2, 0.4).

use asperity_ndf_sampling::{Ggx, Ndf, NormalTable, inverse_phi};
use asperity_tests::disk_bins::DiskBins;
use asperity_tests::low_discrepancy::r2;
use asperity_tests::reference::{self, rows};
use glam::{Vec2, Vec3};
use rayon::prelude::*;

const POINTS: u32 = 1 << 22;
const BINS: DiskBins = DiskBins { size: 32, extent: [1.0, 1.0] };
/// The share of the exact normals that counts as the tail.
const BEYOND: f64 = 1e-3;

/// Total variation from the reference's bins, and the share of normals beyond the tilt that 0.1 % of the target exceed.
fn measure(sample: impl Fn(Vec2) -> Vec3 + Sync) -> (f64, f64) {
    let reference = reference::read("ndf/ndf_bins_32.json");
    let columns = rows(&reference["items"][0]["P"]);
    let (tilt, parts) = (target_tilt(), 64);
    let parts: Vec<_> = (0..parts)
        .into_par_iter()
        .map(|part| {
            let (mut counts, mut beyond) = (vec![0_u32; BINS.size * BINS.size], 0_u32);
            for index in (part..POINTS).step_by(parts as usize) {
                let z = r2(index).map(|u| inverse_phi(u) as f32);
                let m = sample(Vec2::from(z));
                counts[BINS.index(f64::from(m.x), f64::from(m.y)).expect("valid")] += 1;
                beyond += u32::from(m.z < tilt);
            }
            (counts, beyond)
        })
        .collect();
    let count = |bin: usize| parts.iter().map(|part| f64::from(part.0[bin])).sum::<f64>() / f64::from(POINTS);
    let variation: f64 = 0.5
        * (0..BINS.size * BINS.size).map(|bin| (count(bin) - columns[bin % 32][bin / 32]).abs()).sum::<f64>();
    let beyond: f64 = parts.iter().map(|part| f64::from(part.1)).sum();
    (variation, beyond / f64::from(POINTS) / BEYOND)
}

/// cos θ beyond which 0.1 % of the exact normals are tilted.
fn target_tilt() -> f32 {
    let ggx = Ggx::new(0.2, 0.4).expect("valid");
    let points = 1 << 20;
    let mut cosines: Vec<f32> =
        (0..points).map(|k| ggx.from_gaussian(Vec2::from(r2(k).map(|u| inverse_phi(u) as f32))).z).collect();
    let rank = (BEYOND * f64::from(points)) as usize;
    *cosines.select_nth_unstable_by(rank, f32::total_cmp).1
}

#[test]
fn bilinear_look_up_keeps_the_density_and_its_tail() {
    let ggx = Ggx::new(0.2, 0.4).unwrap();
    let table = NormalTable::standard(&ggx);
    let (floor, floor_tail) = measure(|z| ggx.from_gaussian(z));
    let (nearest, nearest_tail) = measure(|z| table.nearest(z).normal);
    let (bilinear, bilinear_tail) = measure(|z| table.bilinear(z).normal);
    println!("total variation: floor {floor:.5}, nearest {nearest:.5}, bilinear {bilinear:.5}");
    println!(
        "share beyond the 99.9 % tilt: floor {floor_tail:.3}, nearest {nearest_tail:.3}, bilinear {bilinear_tail:.3}"
    );
    assert!(floor < 5e-4, "the points alone differ by {floor}");
    assert!(bilinear < 1e-3, "{bilinear}");
    assert!(nearest < 0.05 && nearest > 3.0 * bilinear, "{nearest}");
    assert!((bilinear_tail / floor_tail - 1.0).abs() < 0.01, "{bilinear_tail}");
}

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
