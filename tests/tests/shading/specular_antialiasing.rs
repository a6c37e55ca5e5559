//! Specular anti-aliasing compared with averages of slopes over Gaussian pixels.

use asperity_shading::Frame;
use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::pixel::SpecularAntialiasing;

/// The covariance of slopes in the frame of the middle, averaged over a Gaussian pixel of the
/// default width by the midpoint rule.
fn averaged(normal: impl Fn(Vec2) -> Vec3, frame: Frame) -> [f32; 3] {
    let sigma = SpecularAntialiasing::default().variance.sqrt();
    let side = 128;
    let at = |k: i32| 8.0 * ((k as f32 + 0.5) / side as f32 - 0.5);
    let (mut sum, mut all) = ([0.0_f64; 3], 0.0);
    for (x, y) in (0..side).flat_map(|i| (0..side).map(move |j| (at(i), at(j)))) {
        let weight = f64::from((-0.5 * (x * x + y * y)).exp());
        let m = frame.to_local(normal(sigma * Vec2::new(x, y)));
        let slope = m.truncate() / m.z;
        for (sum, term) in sum.iter_mut().zip([slope.x * slope.x, slope.x * slope.y, slope.y * slope.y]) {
            *sum += weight * f64::from(term);
        }
        all += weight;
    }
    sum.map(|sum| (sum / all) as f32)
}

/// The largest error of the covariance relative to its trace.
fn error(normal: impl Fn(Vec2) -> Vec3) -> f32 {
    let frame = Frame::from_normal(normal(Vec2::ZERO));
    let step = 1e-2;
    let derivative =
        |axis: Vec2| frame.to_local((normal(step * axis) - normal(-step * axis)) / (2.0 * step)).truncate();
    let got = SpecularAntialiasing::default().slope_covariance([derivative(Vec2::X), derivative(Vec2::Y)]);
    let expected = averaged(normal, frame);
    let apart = got.iter().zip(expected).map(|(got, expected)| (got - expected).abs()).fold(0.0, f32::max);
    apart / (expected[0] + expected[2])
}

#[test]
fn slope_covariance_is_that_of_a_gaussian_pixel() {
    for (turn, limit) in [(0.03, 0.001), (0.1, 0.005), (0.3, 0.05)] {
        for tilt in [0.0, 0.4, 0.8] {
            // A sphere seen orthographically.
            let sphere = |pixel: Vec2| {
                let at = Vec2::new(tilt, 0.0) + turn * (1.0 - tilt * tilt) * pixel;
                at.extend((1.0 - at.length_squared()).max(1e-4).sqrt())
            };
            // A torus: the normal turns faster around the tube.
            let torus = |pixel: Vec2| {
                let (u, v) =
                    (turn * (0.3 * pixel.x + 0.1 * pixel.y), tilt + turn * (0.2 * pixel.x - pixel.y));
                Vec3::new(v.cos() * u.cos(), v.cos() * u.sin(), v.sin())
            };
            let errors = [error(sphere), error(torus)];
            println!("{turn} {tilt}: {errors:?}");
            assert!(errors.iter().all(|&error| error < limit), "{turn}, {tilt}: {errors:?}");
        }
    }
}

#[test]
fn specular_antialiasing_is_the_identity_without_derivatives_and_total() {
    let filter = SpecularAntialiasing::default();
    for alpha in [0.0, 0.01, 0.37, 1.0] {
        assert_eq!(filter.roughness(alpha, [Vec2::ZERO; 2]), alpha);
        let (sides, axis) = filter.anisotropic_roughness(Vec2::new(0.5 * alpha, alpha), [Vec2::ZERO; 2]);
        assert!((sides - Vec2::new(alpha, 0.5 * alpha)).length() < 1e-6);
        assert_eq!(axis, if alpha > 0.0 { Vec2::Y } else { Vec2::X });
    }
    for narrow in [1e-3, 1e-4] {
        let (sides, _) = filter.anisotropic_roughness(Vec2::new(1.0, narrow), [Vec2::ZERO; 2]);
        assert!((sides.y / narrow - 1.0).abs() < 1e-5, "{sides}");
    }
    let most = filter.max_alpha_squared;
    for x in [f32::NAN, f32::INFINITY, -1e38, 1e-40, 0.0, 3.0] {
        for y in [f32::NAN, f32::NEG_INFINITY, 1e38, -1e-40, 0.2] {
            let d = [Vec2::new(x, y), Vec2::new(y, -x)];
            let [xx, xy, yy] = filter.slope_covariance(d);
            assert!(
                xx >= 0.0 && yy >= 0.0 && xx.max(yy) <= 0.5 * most + 1e-6 && xy.abs() <= 0.5 * most,
                "{d:?}"
            );
            let alpha = filter.roughness(x, d);
            assert!((0.0..=1.0).contains(&alpha), "{d:?}");
            let (sides, axis) = filter.anisotropic_roughness(Vec2::new(x, y), d);
            assert!(sides.min_element() >= 0.0 && sides.max_element() <= 1.0, "{d:?}");
            assert!((axis.length() - 1.0).abs() < 1e-5, "{d:?}");
        }
    }
}

#[test]
fn principal_axes_follow_the_derivatives() {
    let filter = SpecularAntialiasing::default();
    let along = Vec2::new(0.6, 0.8);
    let (sides, axis) = filter.anisotropic_roughness(Vec2::splat(0.1), [0.5 * along, Vec2::ZERO]);
    assert!(axis.dot(along).abs() > 0.9999);
    let added = 2.0 * filter.variance * 0.25;
    assert!((sides - Vec2::new((0.01 + added).sqrt(), 0.1)).length() < 1e-5, "{sides}");
}
