//! Bumps from a height, on a surface: their distribution, and the slopes of the height.

use asperity_shading::bump::displace;
use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::noise::{FbmSpectrum, GaussianFbm, GaussianNoise};
use asperity_shading::{Beckmann, BumpField, Footprint, Frame, LevelOfDetail};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::histogram::Histogram;
use asperity_tests::random::Random;
use rayon::prelude::*;

fn bumps(seed: u32) -> BumpField<GaussianFbm<Vec3>> {
    BumpField::new(GaussianFbm::new(GaussianNoise::new(seed), FbmSpectrum::default()), 5.0)
        .expect("frequency in range")
}

/// Returns a point of a sphere of 500 cells with a random frame.
fn place(random: &mut Random) -> (Vec3, Frame) {
    let mut direction = || Vec3::from(std::array::from_fn(|_| random.gaussians()[0] as f32)).normalize();
    let (normal, tangent) = (direction(), direction());
    (100.0 * normal, Frame::from_normal_tangent(normal, tangent))
}

/// Compares the coordinates over spheres with two independent N(0, 1).
fn assert_gaussian(octaves: f32, seeds: u32) {
    const POINTS: u32 = 2048;
    let empty = || ([Histogram::new(), Histogram::new()], 0.0);
    let (histograms, product) = (0..seeds)
        .into_par_iter()
        .fold(empty, |(mut histograms, mut product), seed| {
            let (bumps, mut random) = (bumps(seed), Random(u64::from(seed) << 32 | 7));
            let pixel = bumps.clamp().footprint(octaves);
            for _ in 0..POINTS {
                let (p, frame) = place(&mut random);
                let z = bumps.coordinates(p, &frame, pixel).z;
                for (histogram, z) in histograms.iter_mut().zip(z.to_array()) {
                    histogram.add(z);
                }
                product += f64::from(z.x) * f64::from(z.y);
            }
            (histograms, product)
        })
        .reduce(empty, |([a, b], product), ([c, d], other)| ([a.join(&c), b.join(&d)], product + other));
    let n = histograms[0].count() as f64;
    let [a, b] = histograms.map(|histogram| histogram.distance());
    // Significance 0.0001: 2.2/√n.
    let limit = 2.2 / n.sqrt();
    assert!(a < limit && b < limit, "{octaves} octaves: {a} {b} (limit {limit})");
    assert_abs_diff_eq!(product / n, 0.0, epsilon = 4.0 / n.sqrt(), "{octaves} octaves");
}

#[test]
fn coordinates_on_a_sphere_are_gaussian() {
    for octaves in [0.5, 1.0, 1.5, 3.0, 4.75, 8.0] {
        assert_gaussian(octaves, 256);
    }
}

/// A hundred million points.
#[test]
#[ignore = "slow: weekly"]
fn coordinates_on_a_sphere_are_gaussian_over_a_hundred_million_points() {
    for octaves in [0.5, 1.0, 1.5, 2.0, 3.25, 4.75, 6.0, 8.0] {
        assert_gaussian(octaves, 6144);
    }
}

#[test]
fn height_has_the_slopes_of_the_bumps() {
    const POINTS: u32 = 20_000;
    let mut random = Random(41);
    for octaves in [0.5, 1.0, 2.0, 3.5, 5.0] {
        let (bumps, mut worst) = (bumps(3), 0.0_f64);
        let pixel = bumps.clamp().footprint(octaves);
        // A hundredth of a cell of the finest octave.
        let step = 0.01 / (5.0 * 2.17_f32.powf(octaves.max(1.0) - 1.0));
        let [mut zz, mut hh, mut zh] = [0.0_f64; 3];
        for _ in 0..POINTS {
            let (p, frame) = place(&mut random);
            let p = 0.02 * p;
            let seen = bumps.coordinates(p, &frame, pixel);
            let gradient = bumps.height(p, pixel).gradient;
            for (tangent, z) in [frame.tangent, frame.bitangent].into_iter().zip(seen.z.to_array()) {
                let [above, below] = [step, -step].map(|step| bumps.height(p + step * tangent, pixel).value);
                let slope = f64::from((above - below) / (2.0 * step));
                worst = worst.max((slope - f64::from(gradient.dot(tangent))).abs());
                let z = f64::from(seen.variance.sqrt() * z);
                (zz, hh, zh) = (zz + z * z, hh + slope * slope, zh - z * slope);
            }
        }
        let [zz, hh, zh] = [zz, hh, zh].map(|sum| sum / f64::from(2 * POINTS));
        let correlation = zh / (zz * hh).sqrt();
        println!(
            "{octaves} octaves: correlation {correlation:.4}, variances {zz:.4} {hh:.4}, gradient {worst:.1e}"
        );
        // Measured 0.979 to 0.980.
        assert!(correlation > 0.975, "{octaves} octaves: {correlation}");
        let share = f64::from(bumps.field().spectrum().resolved_variance(octaves));
        // Six standard errors of a variance.
        assert_abs_diff_eq!(hh, share, epsilon = 6.0 * share / f64::from(POINTS).sqrt());
        assert!(worst < 2e-2, "{octaves} octaves: {worst:e}");
    }
}

#[test]
fn displaced_surface_of_beckmann_has_the_normals_of_the_bumps() {
    let (bumps, ndf, mut random) = (bumps(8), Beckmann::isotropic(0.3).expect("in range"), Random(5));
    let (pixel, sigma) = (Footprint::from_width(0.01), ndf.alpha_x() / 2.0_f32.sqrt());
    let [mut apart, mut tilt] = [0.0_f32; 2];
    for _ in 0..5000 {
        let (p, frame) = place(&mut random);
        let p = 0.02 * p;
        let tangents = [frame.tangent, frame.bitangent];
        let height = bumps.height(p, pixel);
        let slope = Vec2::from(tangents.map(|tangent| sigma * height.gradient.dot(tangent)));
        let raised = displace(p, frame.normal, tangents, [Vec3::ZERO; 2], sigma * height.value, slope);
        let normal = LevelOfDetail::Exact.normal(&ndf, bumps.coordinates(p, &frame, pixel));
        apart += (frame.to_local(raised.normal) - normal).length_squared() / 5000.0;
        tilt += normal.truncate().length_squared() / 5000.0;
    }
    let (apart, tilt) = (apart.sqrt(), tilt.sqrt());
    println!("normals {apart:.3} apart, tilted by {tilt:.3}");
    // By the whitening alone: measured 0.056 of 0.280.
    assert!(apart < 0.22 * tilt, "{apart} of {tilt}");
}

#[test]
fn height_is_continuous_in_the_footprint() {
    let bumps = bumps(2);
    for k in 0..32 {
        let p = Vec3::new(0.37, -1.21, 0.83) * k as f32;
        let jump = |steps: u32| {
            // From a pixel that resolves nothing to a pixel that resolves five octaves.
            let at = |step: u32| 0.12 * 0.02_f32.powf(step as f32 / steps as f32);
            let heights = (0..=steps).map(|step| bumps.height(p, Footprint::from_width(at(step))).value);
            let heights: Vec<f32> = heights.collect();
            heights.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f32::max)
        };
        // A jump is unaffected by finer steps.
        let [coarse, fine] = [500, 4000].map(jump);
        assert!(coarse > 0.0 && fine < 0.25 * coarse + 1e-7, "{k}: {fine} after {coarse}");
    }
    for width in [0.1, 1.0, f32::INFINITY, f32::NAN] {
        assert_eq!(bumps.height(Vec3::ONE, Footprint::from_width(width)).value, 0.0);
    }
    for bad in [f32::NAN, f32::INFINITY, f32::MAX] {
        let height = bumps.height(Vec3::splat(bad), Footprint::from_width(0.01));
        assert!(height.value.is_finite() && height.gradient.is_finite(), "{bad}: {height:?}");
    }
}
