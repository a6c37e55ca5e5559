//! Total variation between generated normals and their target over 32 × 32 bins of radius and
//! azimuth: closed forms, and all variants of table L.

use asperity_tests::assert_abs_diff_eq;
use std::sync::LazyLock;

use asperity_ndf_sampling::{
    Beckmann, Ggx, Ndf, NormalLut, inverse_gaussian_cdf,
    normal_table::{Chart, Spacing, TableEntry, TableLayout},
};
use asperity_tests::low_discrepancy::r2;
use glam::{Vec2, Vec3};
use rayon::prelude::*;

/// Low-discrepancy points, used as Gaussian coordinates of normals: 6.3 million.
static POINTS: LazyLock<Vec<Vec2>> = LazyLock::new(|| {
    (0..3_u32 << 21)
        .into_par_iter()
        .map(|k| Vec2::from(r2(k).map(|u| inverse_gaussian_cdf(u) as f32)))
        .collect()
});

/// Bins along the radius and the azimuth. Every bin has the same probability under the target.
const BINS: usize = 32;

/// The fraction of the exact normals that counts as the tail.
const BEYOND: f64 = 1e-3;

/// The points mapped by `sample`.
#[derive(Clone, Copy, Debug)]
struct Measured {
    variation: f64,
    /// The fraction beyond the target's 99.9 % quantile of the radius, relative to the expected
    /// fraction.
    tail: f64,
}

/// Counts `quantile`, the target's probability within the radius, and the azimuth of each normal.
fn measure(
    points: &[Vec2],
    sample: impl Fn(Vec2) -> Vec3 + Sync,
    quantile: fn(f64) -> f64,
    [alpha_x, alpha_y]: [f32; 2],
) -> Measured {
    let counts: Vec<(Vec<u32>, u32)> = points
        .par_chunks(points.len() / 16)
        .map(|points| {
            let (mut counts, mut beyond) = (vec![0_u32; BINS * BINS], 0);
            for &z in points {
                let m = sample(z);
                let (x, y) = (m.x / (alpha_x * m.z), m.y / (alpha_y * m.z));
                let within = quantile(f64::from(x).powi(2) + f64::from(y).powi(2));
                let ring = ((within * BINS as f64) as usize).min(BINS - 1);
                counts[ring * BINS + sector(x, y)] += 1;
                beyond += u32::from(within > 1.0 - BEYOND);
            }
            (counts, beyond)
        })
        .collect();
    let share = |count: u32| f64::from(count) / points.len() as f64;
    let uniform = 1.0 / (BINS * BINS) as f64;
    let variation = 0.5
        * (0..BINS * BINS)
            .map(|bin| (share(counts.iter().map(|part| part.0[bin]).sum()) - uniform).abs())
            .sum::<f64>();
    Measured { variation, tail: share(counts.iter().map(|part| part.1).sum()) / BEYOND }
}

/// Returns the sector of the plane out of 32 equal sectors, in arbitrary order. It uses
/// comparisons, because an arctangent would take as long as everything else.
fn sector(x: f32, y: f32) -> usize {
    // Tangents of the multiples of 11.25°.
    const EDGES: [f32; 3] = [0.198_912_37, 0.414_213_57, 0.668_178_6];
    let (large, small) = (x.abs().max(y.abs()), x.abs().min(y.abs()));
    let within = EDGES.iter().filter(|&&edge| small > edge * large).count();
    let octant = usize::from(x < 0.0) + 2 * usize::from(y < 0.0) + 4 * usize::from(x.abs() < y.abs());
    4 * octant + within
}

/// Returns the fraction of GGX with squared slope length at most `t2`, in units of the roughness.
fn ggx_quantile(t2: f64) -> f64 {
    1.0 - 1.0 / (1.0 + t2)
}

fn beckmann_quantile(t2: f64) -> f64 {
    -(-t2).exp_m1()
}

/// Variation of the points themselves: they are Beckmann slopes in `f64` up to a scale.
static FLOOR: LazyLock<Measured> = LazyLock::new(|| {
    let slopes = |z: Vec2| Vec3::new(z.x, z.y, std::f32::consts::SQRT_2);
    measure(&POINTS, slopes, beckmann_quantile, [1.0, 1.0])
});

#[test]
fn closed_forms_are_at_the_sampling_floor() {
    let floor = *FLOOR;
    println!("floor: {floor:.6?}");
    assert!(floor.variation < 6e-4, "{floor:?}");
    for alpha in [0.001, 0.01, 0.1, 0.3, 1.0] {
        let ggx = Ggx::isotropic(alpha).unwrap();
        let beckmann = Beckmann::isotropic(alpha).unwrap();
        let forms = [
            ("GGX", measure(&POINTS, |z| ggx.warp_gaussian(z), ggx_quantile, [alpha; 2])),
            ("Beckmann", measure(&POINTS, |z| beckmann.warp_gaussian(z), beckmann_quantile, [alpha; 2])),
        ];
        for (name, measured) in forms {
            println!("{name} {alpha}: {measured:.6?}");
            // Rounding moves a point across an edge if it is within 10⁻⁶: 64 edges, 10⁻⁶ of the
            // points each.
            let Measured { variation, tail } = measured;
            assert_abs_diff_eq!(variation, floor.variation, epsilon = 5e-5, "{name} {alpha}");
            assert_abs_diff_eq!(tail / floor.tail, 1.0, epsilon = 1e-3, "{name} {alpha}");
        }
    }
}

#[test]
fn every_variant_of_table_l() {
    const ALPHA: [f32; 2] = [0.2, 0.4];
    let ggx = Ggx::new(ALPHA[0], ALPHA[1]).unwrap();
    let floor = *FLOOR;
    println!(
        "floor: {floor:.5?}\n| spacing | chart | nearest | tail | bilinear | tail |\n|---|---|---|---|---|---|"
    );
    for spacing in [Spacing::Coordinates, Spacing::Quantiles, Spacing::Warped] {
        let mut nearest = None;
        for chart in [Chart::Projected, Chart::Slopes, Chart::Stereographic] {
            let table = NormalLut::with_layout(&ggx, 256, TableLayout { spacing, chart }).unwrap();
            // The nearest entry does not depend on the chart. Its error is so large that fewer
            // points suffice.
            let nearest = *nearest.get_or_insert_with(|| {
                measure(&POINTS[..1 << 20], |z| table.view().nearest_normal(z), ggx_quantile, ALPHA)
            });
            let bilinear = measure(&POINTS, |z| table.view().bilinear_normal(z), ggx_quantile, ALPHA);
            println!(
                "| {spacing:?} | {chart:?} | {:.4} | {:.2} | {:.5} | {:.3} |",
                nearest.variation, nearest.tail, bilinear.variation, bilinear.tail
            );
            if spacing == Spacing::Quantiles {
                // The paper's index truncates the tail with any interpolation.
                assert!(bilinear.tail < 0.3 && bilinear.variation > 1.5 * floor.variation, "{chart:?}");
                assert!(nearest.tail < 0.3 && nearest.variation > 0.01, "{chart:?}");
            } else {
                assert!(bilinear.variation < 1e-3, "{spacing:?} {chart:?}: {bilinear:?}");
                assert_abs_diff_eq!(bilinear.tail, 1.0, epsilon = 0.05, "{spacing:?} {chart:?}");
                assert!(nearest.variation < 0.05, "{spacing:?} {chart:?}: {nearest:?}");
            }
        }
    }
}

#[test]
fn recommended_table_preserves_every_roughness() {
    fn check<E: TableEntry + Sync>(name: &str, table: NormalLut<&[E]>, quantile: fn(f64) -> f64, alpha: f32) {
        let measured = measure(&POINTS, |z| table.bilinear_normal(z), quantile, [alpha; 2]);
        println!("{name} {alpha}: {measured:.6?}");
        assert!(measured.variation < 1e-3, "{name} {alpha}: {measured:?}");
        assert_abs_diff_eq!(measured.tail, 1.0, epsilon = 0.05, "{name} {alpha}: {measured:?}");
    }
    for alpha in [0.001, 1.0] {
        let ggx = NormalLut::standard(&Ggx::isotropic(alpha).unwrap());
        check("GGX", ggx.view(), ggx_quantile, alpha);
    }
    let ggx = NormalLut::standard(&Ggx::isotropic(0.3).unwrap());
    let halves = ggx.halves();
    let packed = NormalLut::from_entries(ggx.size(), ggx.layout(), &halves).unwrap();
    check("GGX in half floats", packed, ggx_quantile, 0.3);
    let beckmann = NormalLut::standard(&Beckmann::isotropic(0.1).unwrap());
    check("Beckmann", beckmann.view(), beckmann_quantile, 0.1);
}
