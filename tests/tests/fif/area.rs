//! Means over rectangles of height fields against exact rationals, and the distribution of normals.
#![expect(clippy::unwrap_used, reason = "a test that cannot read its reference has failed")]

use asperity_fif::glam::DVec3;
use asperity_fif::{Estimate, Fif, FifError, HeightField, Interval, cochran_2000, surface::Function};
use asperity_ndf_sampling::{Measure, Ndf, NdfMap, Reconstruction};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::fif_systems::{Reference, ratio, ratios, read};
use serde_json::Value;

use crate::properties::{f, f_hat};

/// Compares the means over all rectangles, and returns the maximum error relative to the value and
/// its conditioning.
fn rectangles<F: Function, G: Function>(surface: &HeightField<F, G>, json: &Value) -> f64 {
    let mut worst = 0.0_f64;
    for rectangle in json["rectangles"].as_array().unwrap() {
        let [x, y] = ["x", "y"].map(|key| ratios(&rectangle[key]));
        let interval = |x: &[f64]| Interval::new(x[0], x[1]);
        let got = surface.area_means(interval(&x), interval(&y)).unwrap();
        let mut means: Vec<(&str, Estimate)> = vec![("mean_h", got.height), ("mean_h2", got.height_squared)];
        if let Some(slopes) = got.slopes {
            means.extend([("mean_hx", slopes.slope[0]), ("mean_hy", slopes.slope[1])]);
            means.extend([("mean_hx2", slopes.squared[0]), ("mean_hy2", slopes.squared[1])]);
            means.push(("mean_hxhy", slopes.product));
        }
        for (key, got) in means {
            let want = ratio(rectangle[key].as_str().unwrap());
            let error = (got.value - want).abs();
            // The rational ends of the rectangle are rounded.
            let area = [&x, &y].into_iter().map(|x| x[1] - x[0]).fold(f64::INFINITY, f64::min);
            let ends = 32.0 * f64::EPSILON / area;
            assert!(error <= got.bound + ends, "{key} over {x:?} × {y:?}: {got:?} != {want}");
            worst = worst.max(error / (want.abs() * got.condition).max(0.1));
        }
    }
    worst
}

#[test]
fn rectangle_means_match_exact_rationals() {
    let (f, g) = (Reference::<2>::load("paper_f").system, Reference::<2>::load("paper_g").system);
    let [f_hat, g_hat] = [&f, &g].map(|slope| slope.integral::<Vec<_>, 3>(0.0).unwrap());
    let (f, g, f_hat, g_hat) = (f.view(), g.view(), f_hat.view(), g_hat.view());
    let tensor = read("tensor");
    let mut worst = Vec::new();
    for surface in tensor.as_array().unwrap() {
        worst.push(match (surface["fx"].as_str().unwrap(), surface["gy"].as_str().unwrap()) {
            ("paper_f", "paper_f") => rectangles(&HeightField::new(f, f), surface),
            ("paper_g", "paper_g") => rectangles(&HeightField::new(g, g), surface),
            ("paper_f_int", "paper_f_int") => {
                rectangles(&HeightField::new(f_hat, f_hat).tabulated_with(16), surface)
            }
            ("paper_g_int", "paper_g_int") => rectangles(&HeightField::new(g_hat, g_hat), surface),
            ("paper_f_int", "paper_g_int") => rectangles(&HeightField::new(f_hat, g_hat), surface),
            other => panic!("{other:?} is not among the tests"),
        });
    }
    println!("{worst:?}");
    assert!(worst.len() == 5 && worst.iter().all(|&worst| worst <= 1e-12), "{worst:?}");
}

#[test]
fn rectangle_of_zero_area_returns_values() {
    let surface = HeightField::new(f_hat(), f_hat());
    let point = surface.area_means(Interval::new(0.7, 0.7), Interval::new(1.2, 1.2)).unwrap();
    let (height, slope) = (surface.height(0.7, 1.2), surface.gradient(0.7, 1.2).unwrap());
    assert!((point.height.value - height).abs() <= point.height.bound);
    let slopes = point.slopes.unwrap();
    assert_abs_diff_eq!(slopes.slope[0].value, slope.x, epsilon = 1e-14);
    assert_abs_diff_eq!(slopes.slope[1].value, slope.y, epsilon = 1e-14);
    assert_abs_diff_eq!(slopes.product.value, slope.x * slope.y, epsilon = 1e-14);
    let nan = surface.area_means(Interval::new(f64::NAN, 1.0), Interval::new(0.0, 1.0)).unwrap();
    assert!(nan.height.value.is_nan() && nan.slopes.unwrap().product.value.is_nan());
}

/// A surface's normals form a density that can be sampled, with matching mean and slope moments.
#[test]
fn normal_distribution_builds_an_ndf_map() {
    let f_hat = f_hat();
    let low: Fif<3> = cochran_2000::f().unwrap().scaled(0.5).unwrap().integral(0.0).unwrap();
    // A low relief with different axes, so that rows and columns cannot be confused.
    let surface = HeightField::new(low.view(), f_hat);
    let (x, y) = (Interval::new(0.25, 1.75), Interval::new(0.5, 2.0));
    let (width, height) = (128, 96);
    let mut texels = vec![0.0; width * height];
    surface.normal_distribution([x, y], 512, [width, height], &mut texels).unwrap();
    let texel_area = 4.0 / (width * height) as f32;
    assert_abs_diff_eq!(texels.iter().sum::<f32>() * texel_area, 1.0, epsilon = 1e-4);
    let map =
        NdfMap::from_texels(width, height, &texels, Measure::ProjectedSolidAngle, Reconstruction::Constant)
            .unwrap();
    // The mean slope in closed form, against the mean over the texel centers.
    let exact = surface.area_means(x, y).unwrap().slopes.unwrap();
    let (mut mean, mut square, mut weight) = ([0.0; 2], [0.0; 2], 0.0);
    for (k, &texel) in texels.iter().enumerate() {
        let nx = (2.0 * (k % width) as f64 + 1.0) / width as f64 - 1.0;
        let ny = (2.0 * (k / width) as f64 + 1.0) / height as f64 - 1.0;
        let nz = (1.0 - nx * nx - ny * ny).max(0.0).sqrt();
        if texel > 0.0 && nz > 0.0 {
            let normal = DVec3::new(nx, ny, nz);
            let density = map.d(normal.as_vec3());
            // Every texel inside the disk matches the map's density up to scale. Texels at the rim
            // count partially.
            let share = density / texel;
            assert_abs_diff_eq!(share, 1.0, epsilon = 0.01, "{nx} {ny}: {density} != {texel}");
            let weighted = f64::from(texel);
            for (axis, slope) in [-nx / nz, -ny / nz].into_iter().enumerate() {
                mean[axis] += weighted * slope;
                square[axis] += weighted * slope * slope;
            }
            weight += weighted;
        }
    }
    for axis in 0..2 {
        let (got, want) = (mean[axis] / weight, exact.slope[axis].value);
        // Texels are 1/64 and 1/48 wide.
        assert_abs_diff_eq!(got, want, epsilon = 0.01, "mean slope {axis}: {got} != {want}");
        let (got, want) = (square[axis] / weight, exact.squared[axis].value);
        assert_abs_diff_eq!(got / want, 1.0, epsilon = 0.02, "mean square slope {axis}: {got} != {want}");
    }
}

#[test]
fn normal_distribution_errors() {
    let (smooth, rough) = (HeightField::new(f_hat(), f_hat()), HeightField::new(f_hat(), f()));
    let whole = Interval::new(0.0, 2.0);
    let mut texels = [0.0; 12];
    let mut error = |over, samples, size| {
        smooth.normal_distribution([over, whole], samples, size, &mut texels).unwrap_err().to_string()
    };
    assert_eq!(error(whole, 9, [4, 4]), "`texels` must have 16 elements, got 12");
    assert_eq!(error(whole, 0, [4, 3]), "`samples` must be between 1 and 4096, got 0");
    assert_eq!(error(Interval::new(3.0, 4.0), 9, [4, 3]), "rectangle does not intersect the domain");
    assert_eq!(
        error(Interval::new(f64::NAN, f64::NAN), 9, [4, 3]),
        "rectangle does not intersect the domain"
    );
    let error = rough.normal_distribution([whole; 2], 9, [4, 3], &mut texels).unwrap_err();
    assert_eq!(error, FifError::Rough);
}
