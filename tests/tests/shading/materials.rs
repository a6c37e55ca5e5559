//! Materials: the thesis's values, printed and corrected, and means that do not depend on the distance.

use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::noise::removed_share;
use asperity_shading::{
    Carpet, CarpetParameters, Footprint, Form, SeamPattern, Seams, SpecularThreads, SurfacePoint, rim_light,
};
use asperity_tests::random::Random;
use asperity_tests::reference::{read, rows};

fn file() -> serde_json::Value {
    read("ndf/nilsson.json")
}

#[track_caller]
fn close(got: f32, expected: f64, tolerance: f64, case: &impl std::fmt::Debug) {
    assert!((f64::from(got) - expected).abs() <= tolerance, "{case:?}: {got} for {expected}");
}

#[test]
fn fading_and_rim_meet_the_references() {
    for row in rows(&file()["fadeout"]["rows"]) {
        let [signal, average, size, footprint, out] = row[..] else { panic!("five columns") };
        let share = f64::from(removed_share(footprint as f32, (1.0 / size) as f32));
        close((signal + share * (average - signal)) as f32, out, 1e-5, &row);
    }
    for row in rows(&file()["rim_light"]["rows"]) {
        let cosine = row[0] as f32;
        let view = Vec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
        close(rim_light(Vec3::Z, view, row[1] as f32), row[2], 1e-5, &row);
    }
}

#[test]
fn seams_meet_the_references() {
    let seams = &file()["seams"];
    let expected = [(Form::Printed, "thesis_amount_dx_dy"), (Form::Corrected, "corrected_amount_dx_dy")];
    for (form, name) in expected {
        for (input, out) in rows(&seams["inputs"]).iter().zip(rows(&seams[name])) {
            let pattern = [SeamPattern::None, SeamPattern::Lines, SeamPattern::Grid][input[2] as usize];
            let align = Vec2::new(input[0] as f32, input[1] as f32);
            let distance = std::f64::consts::PI / input[6];
            let seams = Seams::new(align, pattern, distance as f32, input[5] as f32).unwrap();
            let got = seams.sample(Vec2::new(input[3] as f32, input[4] as f32), form);
            // Phases go up to 30: rounding of position, distance and product each 2⁻²⁴ of it, 6e-6 in all, and the slope is f times
            // as steep.
            close(got.amount, out[0], 1e-5, &(form, input));
            let slope = 1e-5 * if form == Form::Corrected { input[6] } else { 1.0 };
            close(got.slope.x, out[1], slope, &(form, input));
            close(got.slope.y, out[2], slope, &(form, input));
        }
    }
}

/// Points of a plane through space, with their texture coordinates.
fn points(seed: u64, count: usize) -> impl Iterator<Item = SurfacePoint> {
    let mut random = Random(seed);
    let n = Vec3::new(0.36, 0.48, 0.8);
    std::iter::repeat_with(move || {
        let uv = Vec2::new(random.uniform() as f32, random.uniform() as f32) * 4.0;
        let [t, b] = SurfacePoint::new(Vec3::ZERO, n, Footprint::from_width(0.0)).tangents;
        SurfacePoint::new(t * uv.x + b * uv.y, n, Footprint::from_width(0.0)).with_uv(uv, [t, b])
    })
    .take(count)
}

fn seen(point: SurfacePoint, width: f32) -> SurfacePoint {
    SurfacePoint { footprint: Footprint::from_width(width), ..point }
}

/// Mean and its standard error.
fn mean(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let (mut n, mut sum, mut squares) = (0.0, 0.0, 0.0);
    for x in values {
        n += 1.0;
        sum += x;
        squares += x * x;
    }
    let mean = sum / n;
    [mean, ((squares / n - mean * mean).max(0.0) / n).sqrt()]
}

#[test]
fn single_threads_keep_their_mean_at_every_distance() {
    let threads = SpecularThreads::new(0.02, 7).unwrap();
    for width in [0.0, 0.0016, 0.002, 0.003, 0.005, 0.008, 0.011] {
        let values =
            points(3, 60_000).map(|p| f64::from(threads.value(p.position, Footprint::from_width(width))));
        let [mean, error] = mean(values);
        // Five standard errors of a mean over independent points, and the error of the measured moments, 0.2 %.
        let tolerance = 5.0 * error + 0.002 * mean;
        println!("width {width}: {mean} ± {error}, from afar {}", threads.mean());
        assert!((mean - f64::from(threads.mean())).abs() < tolerance, "width {width}: {mean}");
    }
    // What fading inside of the power would leave: (1 − E|N|)⁷.
    let inside = (1.0 - 0.313_86_f64).powi(7);
    assert!(inside < 0.8 * f64::from(threads.mean()), "{inside}");
}

#[test]
fn carpets_keep_their_mean_colour_at_every_distance() {
    for pattern in [SeamPattern::Lines, SeamPattern::Grid] {
        let carpet = Carpet::new(CarpetParameters { seams_pattern: pattern, ..Default::default() }).unwrap();
        let colour = |width: f32| {
            let surfaces = || points(5, 20_000).map(|p| carpet.surface(&seen(p, width), Vec3::Z));
            [
                mean(surfaces().map(|s| f64::from(s.diffuse.x))),
                mean(surfaces().map(|s| f64::from(s.specular.x))),
            ]
        };
        let far = colour(1e3);
        for width in [0.0, 0.001, 0.003, 0.01, 0.03, 0.1] {
            for ([near, error], [far, _]) in colour(width).into_iter().zip(far) {
                println!("{pattern:?}, {width}: {near} ± {error}, from afar {far}");
                // Dark areas of 0.15 over 4 × 4 are some 700 independent ones: of deviation 0.12, a standard error of 0.5 %.
                assert!(
                    (near / far - 1.0).abs() < 0.02 + 4.0 * error / far,
                    "{pattern:?}, {width}: {near} for {far}"
                );
            }
        }
    }
}
