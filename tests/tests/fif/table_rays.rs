//! Rays against surfaces with tables of values: tolerances, brackets, batches, and adversarial
//! rays.

use asperity_fif::glam::DVec3;
use asperity_fif::{FifRef, HeightField, Hit, Intersect, Interval, Ray};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::fif_systems::read;

use crate::properties::{f_hat, g_hat};
use crate::rays::half_line;
use crate::surface_rays::random_rays;

type Axis = FifRef<'static, 3>;

const ALL: Interval = Interval::new(0.0, f64::INFINITY);

fn cached(axis: Axis) -> HeightField<Axis, Axis> {
    HeightField::new(axis, axis).tabulated()
}

#[test]
fn reference_hits_stay_within_any_tolerance() {
    let surface = cached(f_hat());
    let json = read("rays_fhat_fhat");
    for tolerance in [0.0, 1e-12, 1e-9, 1e-6, 1e-4, 1e-2] {
        let mut worst = 0.0_f64;
        for ray in json["rays"].as_array().unwrap() {
            let half_line = half_line(ray);
            let hit = surface.intersect_within(&half_line, ALL, tolerance);
            assert_eq!(hit.is_some(), ray["hit"].as_bool().unwrap(), "{half_line:?} to {tolerance:e}");
            assert_eq!(hit.is_some(), surface.occluded(&half_line, ALL), "{half_line:?}");
            let Some(hit) = hit else { continue };
            let (lo, hi) = (ray["t_lo"].as_f64().unwrap(), ray["t_hi"].as_f64().unwrap());
            let length = half_line.direction.length();
            let outside = (lo - hit.t).max(hit.t - hi) * length;
            assert!(outside <= tolerance + 1e-11, "{half_line:?} to {tolerance:e}: {outside:e}");
            worst = worst.max(outside);
        }
        println!("{tolerance:e}: {worst:e}");
    }
}

#[test]
fn tolerance_changes_no_decision_and_batch_no_hit() {
    for axis in [f_hat(), g_hat()] {
        let (surface, plain) = (cached(axis), HeightField::new(axis, axis));
        let rays = random_rays(&plain, 3000);
        let mut exact = vec![None; rays.len()];
        surface.intersect_batch(&rays, ALL, 0.0, &mut exact).unwrap();
        for tolerance in [0.0, 2e-6, 2e-4] {
            let mut hits: Vec<Option<Hit>> = vec![None; rays.len()];
            surface.intersect_batch(&rays, ALL, tolerance, &mut hits).unwrap();
            for ((ray, hit), exact) in rays.iter().zip(&hits).zip(&exact) {
                assert_eq!(*hit, surface.intersect_within(ray, ALL, tolerance), "{ray:?}");
                assert_eq!(hit.is_some(), exact.is_some(), "{ray:?} to {tolerance:e}");
                if let (Some(hit), Some(exact)) = (hit, exact) {
                    let off = (hit.t - exact.t).abs() * ray.direction.length();
                    assert!(off <= tolerance + 1e-11, "{ray:?} to {tolerance:e}: {off:e}");
                }
            }
        }
        // The plain descent of boxes, without tables.
        for (ray, exact) in rays.iter().zip(&exact).step_by(5) {
            let hit = plain.intersect(ray);
            assert_eq!(hit.is_some(), exact.is_some(), "{ray:?}");
            assert_eq!(hit.is_some(), surface.occluded(ray, ALL), "{ray:?}");
            if let (Some(hit), Some(exact)) = (hit, exact) {
                assert_abs_diff_eq!(hit.t, exact.t, epsilon = 1e-10, "{ray:?}: {hit:?}, {exact:?}");
                let (got, want) = (exact.gradient.unwrap(), hit.gradient.unwrap());
                // The hits differ by some units in the last place, and the rough slopes between
                // them add slack.
                let spread = |a: f64, b: f64| {
                    let (lo, hi) = (a.min(b) - 1e-14, a.max(b) + 1e-14);
                    axis.derivative::<Vec<_>, 2>()
                        .unwrap()
                        .extrema_over(lo, hi, 1e-6)
                        .unwrap()
                        .enclosure()
                        .width()
                        + 1e-9
                };
                let (off, magnitude) = ((got - want).abs(), axis.range().magnitude());
                assert!(off.x <= magnitude * spread(hit.x, exact.x), "{ray:?}: {got} {want}");
                assert!(off.y <= magnitude * spread(hit.y, exact.y), "{ray:?}: {got} {want}");
            }
        }
    }
}

#[test]
fn adversarial_rays_are_decided_as_without_tables() {
    let ray =
        |o: [f64; 3], d: [f64; 3]| Ray { origin: DVec3::from_array(o), direction: DVec3::from_array(d) };
    for axis in [f_hat(), g_hat()] {
        let (surface, plain) = (cached(axis), HeightField::new(axis, axis));
        let mut rays = vec![
            // From the surface, in all directions; along the border; parallel to axes, and nearly
            // parallel.
            ray([1.0, 1.0, 1.0], [0.0, 0.0, 1.0]),
            ray([1.0, 1.0, 1.0], [0.0, 0.0, -1.0]),
            ray([1.0, 1.0, 1.0], [1.0, 0.5, 0.3]),
            ray([1.0, 1.0, 1.0], [-0.2, 1.0, 3.0]),
            ray([1.0, 1.0, 1.0], [-0.2, -1.0, -3.0]),
            ray([-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
            ray([-1.0, 1e-300, 1e-300], [1.0, 1e-300, 0.0]),
            ray([1.0, -3.0, 1.0], [0.0, 1.0, 0.0]),
            ray([1.0, -3.0, 1.0], [1e-200, 1.0, 0.0]),
            ray([4.0, 1.0, 1.0], [-2.0, 0.0, 0.0]),
            ray([4.0, 1.0, 1.0], [-2.0, 1e-17, 1e-17]),
            ray([3.0, 3.0, 4.0], [-1.0, -1.0, -1e-9]),
            ray([0.5, 0.5, 0.01], [1.0, 1.0, 0.0]),
            ray([2.0, 2.0, 9.0], [-1e-12, -1e-12, -1.0]),
            ray([0.0, 0.0, 0.0], [1.0, 1.0, 0.25]),
            ray([f64::NAN, 0.0, 1.0], [1.0, 1.0, -1.0]),
            ray([0.0, 0.0, 1.0], [1.0, f64::INFINITY, -1.0]),
            ray([0.5, 0.5, 1.0], [0.0; 3]),
        ];
        // Tangents at knots and elsewhere, slightly raised and lowered.
        for (x, y) in [(1.0, 1.0), (0.5, 1.25), (0.7, 1.6), (1.5, 0.5)] {
            let gradient = surface.gradient(x, y).unwrap();
            for way in [[1.0, 0.3], [-0.4, 1.0], [1.0, -1.0]] {
                for lift in [-1e-3, -1e-6, 1e-9, 1e-6, 1e-3] {
                    let rise = gradient.x * way[0] + gradient.y * way[1];
                    let start = [x - way[0], y - way[1], surface.height(x, y) + lift - rise];
                    rays.push(ray(start, [way[0], way[1], rise]));
                }
            }
        }
        for ray in &rays {
            let (got, want) = (surface.intersect(ray), plain.intersect(ray));
            assert_eq!(got.is_some(), want.is_some(), "{ray:?}: {got:?}, {want:?}");
            assert_eq!(got.is_some(), surface.occluded(ray, ALL), "{ray:?}");
            if let (Some(got), Some(want)) = (got, want) {
                assert_abs_diff_eq!(got.t, want.t, epsilon = 1e-8, "{ray:?}: {got:?}, {want:?}");
            }
            let near = surface.intersect_within(ray, ALL, 1e-4);
            assert_eq!(near.is_some(), want.is_some(), "{ray:?}: {near:?}, {want:?}");
        }
        let mut hits = vec![None; rays.len()];
        for tolerance in [0.0, 1e-9, 1e-4, 10.0] {
            surface.intersect_batch(&rays, ALL, tolerance, &mut hits).unwrap();
            for (ray, hit) in rays.iter().zip(&hits) {
                assert_eq!(*hit, surface.intersect_within(ray, ALL, tolerance), "{ray:?} to {tolerance:e}");
            }
        }
        let down = ray([1.0, 0.999, 3.0], [1e-3, 1e-3, -1.0]);
        assert_eq!(surface.intersect_within(&down, Interval::new(0.0, 1.9), 1e-4), None);
        assert_eq!(surface.intersect_within(&down, Interval::new(2.5, 9.0), 1e-4), None);
        assert_eq!(surface.intersect_within(&down, Interval::new(0.0, f64::NAN), 1e-4), None);
        assert!(surface.intersect_within(&down, Interval::new(f64::NAN, 9.0), f64::NAN).is_some());
    }
}

#[test]
fn coarse_table_value_decides_nothing() {
    // The first position tested is so near to the surface that one step of the table cannot
    // determine the side.
    let directions = [
        [0.595_129_907_131_195_1, 0.456_805_974_245_071_4, -0.688_720_583_915_710_4],
        [0.347_619_444_131_851_2, 0.668_113_648_891_449, -0.681_331_992_149_353],
        [0.513_154_804_706_573_5, 0.629_906_415_939_331, -0.584_356_844_425_201_4],
        [0.522_786_259_651_184_1, 0.623_843_550_682_067_9, -0.582_509_696_483_612_1],
        [0.519_265_055_656_433_1, 0.630_013_823_509_216_3, -0.579_277_217_388_153_1],
    ];
    let (surface, plain) = (cached(g_hat()), HeightField::new(g_hat(), g_hat()));
    for direction in directions {
        let ray = Ray {
            origin: DVec3::new(-2.5, -3.25, 4.900_000_095_367_432),
            direction: DVec3::from_array(direction),
        };
        let want = plain.intersect(&ray).unwrap();
        for tolerance in [0.0, 2e-6, 2e-4] {
            let got = surface.intersect_within(&ray, ALL, tolerance).unwrap();
            assert!(
                (got.t - want.t).abs() <= tolerance + 1e-11,
                "{ray:?} to {tolerance:e}: {got:?}, {want:?}"
            );
            assert_abs_diff_eq!(got.normal.unwrap().length(), 1.0, epsilon = 1e-15, "{got:?}");
        }
    }
}
