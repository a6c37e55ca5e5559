//! First hits, heights and normals against rigorous brackets and exact rationals.
#![expect(clippy::unwrap_used, reason = "a test that cannot read its reference has failed")]

use asperity_fif::glam::DVec3;
use asperity_fif::{Fif, FifRef, HeightField, Intersect, Ray, paper, surface::Function};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::fif_systems::{Reference, decimal, ratio, read};
use serde_json::Value;

fn vector(value: &Value) -> DVec3 {
    let v: Vec<f64> = value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect();
    DVec3::new(v[0], v[1], v[2])
}

/// `(hits, wide brackets, worst distance outside a narrow bracket)`.
fn check_rays(file: &str, surface: &impl Intersect) -> (usize, usize, f64) {
    let json = read(file);
    let (mut hits, mut wide, mut worst) = (0, 0, 0.0_f64);
    for ray in json["rays"].as_array().unwrap() {
        let kind = ray["kind"].as_str().unwrap();
        let half_line = Ray { origin: vector(&ray["o"]), direction: vector(&ray["d"]) };
        let hit = surface.first_hit(&half_line);
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
fn first_hits_of_the_smooth_surface_agree_with_the_brackets() {
    let axis: Fif<3> = vector_of(paper::F_MAPS).integral(0.0).unwrap();
    let surface = HeightField::new(axis.clone(), axis);
    let plain = check_rays("rays_fhat_fhat", &surface);
    let table = check_rays("rays_fhat_fhat", &surface.tabulated());
    println!("{plain:?} {table:?}");
    assert_eq!((table.0, table.1), (124, 0));
}

#[test]
fn first_hits_of_the_continuous_surface_agree_with_the_brackets() {
    let surface = HeightField::new(vector_of(paper::F_MAPS), vector_of(paper::F_MAPS));
    let plain = check_rays("rays_f_f", &surface);
    let table = check_rays("rays_f_f", &surface.tabulated());
    println!("{plain:?} {table:?}");
    // Eight brackets are wider than 1e-6; there the hit only has to lie within.
    assert_eq!((table.0, table.1), (162, 8));
}

#[test]
fn heights_and_normals_equal_the_exact_ones() {
    fn check<const C: usize, const D: usize, const E: usize, const F: usize>(json: &Value) -> (usize, f64)
    where
        Fif<C>: Function<Derivative = Fif<D>>,
        Fif<E>: Function<Derivative = Fif<F>>,
    {
        let load = |key: &str| json[key].as_str().unwrap().to_owned();
        let (x, y) = (Reference::<C>::load(&load("fx")).system, Reference::<E>::load(&load("gy")).system);
        let surface = HeightField::new(x.clone(), y.clone());
        let (mut seen, mut worst) = (0, 0.0_f64);
        let mut close = |got: f64, want: f64, slack: f64, what: &str| {
            assert!((got - want).abs() <= 1e-12 + slack, "{what}: {got} != {want}");
            worst = worst.max((got - want).abs() - slack);
            seen += 1;
        };
        for point in json["points"].as_array().unwrap() {
            let (px, py) = (ratio(point["x"].as_str().unwrap()), ratio(point["y"].as_str().unwrap()));
            let want = decimal(&point["h_dec"]);
            // The doubles next to the rationals: what the functions take within an ulp is the honest slack.
            let near = |v: f64| f64::EPSILON * v.abs();
            let spread = |f: FifRef<'_, C>, v: f64| {
                f.extrema_over(v - near(v), v + near(v), 1e-12).unwrap().enclosure().width()
            };
            let spread_y = |f: FifRef<'_, E>, v: f64| {
                f.extrema_over(v - near(v), v + near(v), 1e-12).unwrap().enclosure().width()
            };
            let slack =
                spread(x.view(), px) * y.range().magnitude() + spread_y(y.view(), py) * x.range().magnitude();
            close(surface.height(px, py), want, slack, "height");
            let Some(normal) = point["unit_normal_dec"].as_array() else {
                assert_eq!(surface.normal(px, py), None);
                continue;
            };
            let slope = |f: &Fif<D>, v: f64| {
                f.extrema_over(v - near(v), v + near(v), 1e-12).unwrap().enclosure().width()
            };
            let slope_y = |f: &Fif<F>, v: f64| {
                f.extrema_over(v - near(v), v + near(v), 1e-12).unwrap().enclosure().width()
            };
            let slack = slack
                + slope(surface.x.derivative().unwrap(), px) * y.range().magnitude()
                + slope_y(surface.y.derivative().unwrap(), py) * x.range().magnitude();
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
    let counts = [
        check::<3, 2, 3, 2>(&json[0]),
        check::<3, 2, 3, 2>(&json[1]),
        check::<3, 2, 3, 2>(&json[2]),
        check::<2, 1, 2, 1>(&json[3]),
        check::<2, 1, 2, 1>(&json[4]),
    ];
    println!("{counts:?}");
    assert_eq!(counts.map(|c| c.0), [150, 150, 150, 25, 25]);
}

fn vector_of(maps: [asperity_fif::Map<2>; 2]) -> Fif<2> {
    Fif::new(&paper::KNOTS, &maps.map(|w| w.alpha), &maps.map(|w| w.q)).unwrap()
}
