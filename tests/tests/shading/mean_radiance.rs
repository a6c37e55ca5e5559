//! The mean radiance of a surface at every zoom, measured with the real noise: `Exact` preserves
//! it, `Fractal` does not.

use asperity_shading::glam::Vec3;
use asperity_shading::level_of_detail::GaussianField;
use asperity_shading::ndf_sampling::{Measure, NdfMap, Reconstruction};
use asperity_shading::noise::{FbmSpectrum, GaussianFbm, GaussianNoise};
use asperity_shading::{Beckmann, Ggx, LevelOfDetail, Ndf, far_field};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::surface_patches::{FRAME, mean_and_error, patch_means};

/// Patches, each with its own seed. The standard errors come from their variation.
const SEEDS: u32 = 128;

/// Resolved octaves, and the sufficient stride of points of a patch.
///
/// The fractions of the variance are 0.188, 0.75, 0.797, 0.938 and 0.949. With more resolved
/// variance the lobes are narrower, and their mean needs more points.
const ZOOMS: [(f32, usize); 5] = [(0.5, 16), (1.0, 4), (1.5, 4), (2.0, 2), (2.5, 2)];

/// The sufficient stride for the ratios of the `Fractal` rule, which need less precision.
const FRACTAL_STRIDE: usize = 32;

/// Tolerance of the ratio of the mean to p(h). The maximum of the 75 cases is 0.011, with a
/// standard error of 0.0052.
const TOLERANCE: f64 = 0.02;

/// Maximum standard error for a meaningful tolerance. The maximum measured is 0.0063.
const LARGEST_ERROR: f64 = TOLERANCE / 3.0;

/// The normal quantile of 75 two-sided cases at a combined significance of 0.001: 1 − 0.001/150.
const QUANTILE: f64 = 4.35;

struct Case {
    name: &'static str,
    ndf: Box<dyn Ndf + Sync>,
    half_vectors: [Vec3; 5],
}

/// Three densities, each with a half vector at its peak, three in its bulk and one in its tail.
///
/// Half vectors of the closed forms are given as slopes. For the painted density they are given as
/// n_x and n_y: its two lobes, the valley at the flat normal, a flank, and the saddle. In the tails
/// `p` is a twelfth (GGX) and a quarter (Beckmann) of its peak.
fn cases() -> [Case; 3] {
    let slopes = |slopes: [[f32; 2]; 5]| slopes.map(|[x, y]| Vec3::new(x, y, 1.0).normalize());
    let on_map = |points: [[f32; 2]; 5]| points.map(|[x, y]| Vec3::new(x, y, (1.0 - x * x - y * y).sqrt()));
    let lobe = |m: Vec3, x: f32, y: f32| f32::exp(-20.0 * ((m.x - x) * (m.x - x) + (m.y - y) * (m.y - y)));
    let painted = |m: Vec3| lobe(m, -0.4, 0.1) + 0.6 * lobe(m, 0.45, -0.2);
    [
        Case {
            name: "GGX 0.2, 0.4",
            ndf: Box::new(Ggx::new(0.2, 0.4).expect("roughness in range")),
            half_vectors: slopes([[0.0, 0.0], [0.1, 0.0], [0.0, 0.3], [-0.2, 0.25], [0.33, -0.25]]),
        },
        Case {
            name: "Beckmann 0.3",
            ndf: Box::new(Beckmann::isotropic(0.3).expect("roughness in range")),
            half_vectors: slopes([[0.0, 0.0], [0.15, 0.0], [0.0, -0.24], [0.2, 0.2], [-0.3, 0.2]]),
        },
        Case {
            name: "two lobes",
            ndf: Box::new(
                NdfMap::from_fn(128, 128, Measure::ProjectedSolidAngle, Reconstruction::Constant, painted)
                    .expect("two lobes have weight"),
            ),
            half_vectors: on_map([[-0.4, 0.1], [0.45, -0.2], [0.0, 0.0], [-0.5, -0.1], [0.2, -0.1]]),
        },
    ]
}

/// Returns the 15 ratios of mean radiance to p(h) at one zoom, with standard errors.
fn ratios(rule: LevelOfDetail, octaves: f32, stride: usize) -> Vec<(f64, f64)> {
    let cases = cases();
    let far: Vec<f64> = cases
        .iter()
        .flat_map(|case| case.half_vectors.map(|h| f64::from(far_field(&*case.ndf, h))))
        .collect();
    let field = |seed| GaussianFbm::<Vec3>::new(GaussianNoise::new(seed), FbmSpectrum::default());
    let patches = patch_means(SEEDS, stride, field, |field, p, sums: &mut [f64; 15]| {
        let coordinates = field.coordinates(p, &FRAME, octaves);
        let radiances = cases
            .iter()
            .flat_map(|case| case.half_vectors.map(|h| rule.radiance(&*case.ndf, h, coordinates)));
        for (sum, radiance) in sums.iter_mut().zip(radiances) {
            *sum += f64::from(radiance);
        }
    });
    far.iter()
        .enumerate()
        .map(|(index, far)| {
            let (mean, error) = mean_and_error(&patches, index);
            (mean / far, error / far)
        })
        .collect()
}

#[test]
fn exact_rule_keeps_the_mean_and_fractal_rule_does_not() {
    let exact = ZOOMS.map(|(octaves, stride)| ratios(LevelOfDetail::Exact, octaves, stride));
    let fractal = ZOOMS.map(|(octaves, _)| ratios(LevelOfDetail::Fractal, octaves, FRACTAL_STRIDE));

    println!(
        "mean radiance / p(h) at octaves {:?}: exact ± standard error | fractal",
        ZOOMS.map(|zoom| zoom.0)
    );
    let names = cases()
        .map(|case| case.half_vectors.map(|h| format!("{:12} h ({:5.2}, {:5.2})", case.name, h.x, h.y)));
    for (index, name) in names.as_flattened().iter().enumerate() {
        let columns = exact.iter().zip(&fractal).map(|(exact, fractal)| {
            let (mean, error) = exact[index];
            format!("{mean:.4} ± {error:.4} | {:6.3}", fractal[index].0)
        });
        println!("{name}   {}", columns.collect::<Vec<_>>().join("   "));
    }

    for (index, name) in names.as_flattened().iter().enumerate() {
        for (exact, (octaves, _)) in exact.iter().zip(ZOOMS) {
            let (mean, error) = exact[index];
            let case = format!("{name}, {octaves} octaves: {mean} ± {error}");
            assert!(error < LARGEST_ERROR, "{case} shows nothing");
            assert_abs_diff_eq!(mean, 1.0, epsilon = TOLERANCE, "{case}");
            assert_abs_diff_eq!(mean, 1.0, epsilon = QUANTILE * error, "{case}");
        }
        // From the first whole octave on, the paper's rule spreads the density by itself.
        for (fractal, (octaves, _)) in fractal.iter().zip(ZOOMS).skip(1) {
            let (mean, _) = fractal[index];
            match index {
                0 | 5 | 10 | 11 => assert!(mean < 0.6, "{name}, {octaves} octaves: peak {mean}"),
                4 | 12 | 14 => assert!(mean > 1.2, "{name}, {octaves} octaves: tail or valley {mean}"),
                _ => {}
            }
        }
    }
}
