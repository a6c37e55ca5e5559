//! First hits, heights and normals, against rigorous brackets and exact rationals.
#![expect(clippy::unwrap_used, reason = "a test that cannot read its reference has failed")]

use asperity_fif::glam::DVec3;
use asperity_fif::{Fif, FifRef, HeightField, Intersect, Ray, surface::Function};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::fif_systems::{Reference, decimal, ratio, read};
use serde_json::Value;

use crate::properties::{f, f_hat};

/// Parses a ray of the reference.
pub(super) fn half_line(json: &Value) -> Ray {
    let [origin, direction] = ["o", "d"].map(|key| {
        let component = |k: usize| json[key][k].as_f64().unwrap();
        DVec3::new(component(0), component(1), component(2))
    });
    Ray { origin, direction }
}

/// Returns `(hits, wide brackets, maximum distance outside a narrow bracket)`.
fn check_rays(file: &str, surface: &impl Intersect) -> (usize, usize, f64) {
    let json = read(file);
    let (mut hits, mut wide, mut worst) = (0, 0, 0.0_f64);
    for ray in json["rays"].as_array().unwrap() {
        let kind = ray["kind"].as_str().unwrap();
        let half_line = half_line(ray);
        let hit = surface.intersect(&half_line);
        match ray["hit"].as_bool() {
            Some(true) => {
                let hit = hit.unwrap_or_else(|| panic!("{file} {kind} {half_line:?} is missed"));
                let (lo, hi) = (ray["t_lo"].as_f64().unwrap(), ray["t_hi"].as_f64().unwrap());
                let outside = (lo - hit.t).max(hit.t - hi).max(0.0);
                assert!(outside <= 1e-6, "{file} {kind} {half_line:?}: {} not in [{lo}, {hi}]", hit.t);
                hits += 1;
                wide += usize::from(hi - lo > 1e-6);
                worst = worst.max(outside);
                let at = half_line.at(hit.t);
                assert_abs_diff_eq!(at.x, hit.x, epsilon = 1e-12);
                assert_abs_diff_eq!(at.y, hit.y, epsilon = 1e-12);
                if let (Some(gradient), Some(hx)) = (hit.gradient, ray["hx"].as_array()) {
                    let (lo, hi) = (hx[0].as_f64().unwrap(), hx[1].as_f64().unwrap());
                    assert!(
                        lo - 1e-9 <= gradient.x && gradient.x <= hi + 1e-9,
                        "{kind}: {gradient} not in [{lo}, {hi}]"
                    );
                }
            }
            Some(false) => assert!(hit.is_none(), "{file} {kind} {half_line:?} hits at {hit:?}"),
            None => panic!("no ray of this file is undecided"),
        }
    }
    (hits, wide, worst)
}

#[test]
fn first_hits_match_the_brackets() {
    fn check<F: Function>(file: &str, axis: F, hits: usize, wide: usize) {
        let surface = HeightField::new(axis.clone(), axis);
        let (plain, table) = (check_rays(file, &surface), check_rays(file, &surface.clone().tabulated()));
        println!("{plain:?} {table:?}");
        assert_eq!([plain.0, plain.1, table.0, table.1], [hits, wide, hits, wide]);
    }
    check("rays_fhat_fhat", f_hat(), 124, 0);
    // Eight brackets are wider than 1e-6. For these, the hit only has to be inside.
    check("rays_f_f", f(), 162, 8);
}

#[test]
fn heights_and_normals_match_exact_rationals() {
    /// Returns the range of a function within an ulp of the rational represented by the double.
    fn spread<const C: usize>(f: &Fif<C>, x: f64) -> f64 {
        let near = f64::EPSILON * x.abs();
        f.extrema_over(x - near, x + near, 1e-12).unwrap().enclosure().width()
    }
    fn check<const C: usize, const D: usize>(json: &Value) -> (usize, f64)
    where
        for<'a> FifRef<'a, C>: Function<Derivative = Fif<D>>,
        Fif<D>: Function,
    {
        let [x, y] = ["fx", "gy"].map(|key| Reference::<C>::load(json[key].as_str().unwrap()).system);
        let surface = HeightField::new(x.view(), y.view());
        let (mut seen, mut worst) = (0, 0.0_f64);
        let mut close = |got: f64, want: f64, slack: f64, what: &str| {
            assert_abs_diff_eq!(got, want, epsilon = 1e-12 + slack, "{what}");
            worst = worst.max((got - want).abs() - slack);
            seen += 1;
        };
        for point in json["points"].as_array().unwrap() {
            let (px, py) = (ratio(point["x"].as_str().unwrap()), ratio(point["y"].as_str().unwrap()));
            let want = decimal(&point["h_dec"]);
            let sizes = [y.range().magnitude(), x.range().magnitude()];
            let slack = spread(&x, px) * sizes[0] + spread(&y, py) * sizes[1];
            close(surface.height(px, py), want, slack, "height");
            let Some(normal) = point["unit_normal_dec"].as_array() else {
                assert_eq!(surface.normal(px, py), None);
                continue;
            };
            let [f_slope, g_slope] = [surface.x().derivative(), surface.y().derivative()].map(Option::unwrap);
            let slack = slack + spread(f_slope, px) * sizes[0] + spread(g_slope, py) * sizes[1];
            let gradient = surface.gradient(px, py).unwrap();
            close(gradient.x, decimal(&point["hx_dec"]), slack, "h_x");
            close(gradient.y, decimal(&point["hy_dec"]), slack, "h_y");
            let got = surface.normal(px, py).unwrap();
            for (got, want) in got.to_array().into_iter().zip(normal) {
                close(got, decimal(want), slack, "normal");
            }
        }
        (seen, worst)
    }
    let json = read("tensor");
    let smooth = [0, 1, 2].map(|k| check::<3, 2>(&json[k]));
    let rough = [3, 4].map(|k| check::<2, 1>(&json[k]));
    println!("{smooth:?} {rough:?}");
    assert!(smooth.iter().all(|c| c.0 == 150) && rough.iter().all(|c| c.0 == 25), "{smooth:?} {rough:?}");
}
