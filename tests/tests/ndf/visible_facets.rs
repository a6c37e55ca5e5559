//! Visible normals as a map of Gaussian numbers, and their distribution when a part is resolved.

use core::fmt::Debug;

use asperity_ndf_sampling::{
    Beckmann, Blend, BlinnPhong, Ggx, Isotropic, Masked, Measure, Microfacet, Ndf, NdfError, NdfMap,
    Reconstruction, Rotated, StudentT, VisibleFacets, VisibleWarp, Ward,
    check::{Cells, p_value},
    glam::{Vec2, Vec3},
    inverse_gaussian_cdf,
};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::random::Random;
use rayon::prelude::*;

const ALPHAS: [[f32; 2]; 5] = [[0.3, 0.3], [0.5, 0.2], [0.05, 0.6], [1e-3, 1e-3], [1.0, 0.1]];

/// A density with its name.
type Named = (String, Box<dyn VisibleWarp + Sync + Send>);

fn named<N: VisibleWarp + Debug + Sync + Send + 'static>(ndf: Result<N, NdfError>) -> Named {
    let ndf = ndf.expect("valid parameters");
    (format!("{ndf:?}"), Box::new(ndf))
}

/// Densities whose map is exact.
fn closed_forms() -> Vec<Named> {
    let of_roughness = ALPHAS.into_iter().flat_map(|[x, y]| {
        // Below γ = 2 the density is unbounded at the horizon, which quadrature misses.
        let student = [2.2, 3.0, 1e6].map(|gamma| named(StudentT::new(x, y, gamma)));
        [named(Ggx::new(x, y)), named(Beckmann::new(x, y))].into_iter().chain(student)
    });
    of_roughness
        .chain([
            named(Ward::new(0.3, 0.1)),
            named(BlinnPhong::new(20.0)),
            named(Rotated::new(Ggx::new(0.5, 0.2).expect("a roughness"), 0.7)),
            named(Rotated::new(Beckmann::new(0.2, 0.5).expect("a roughness"), 2.0)),
        ])
        .collect()
}

fn painted(n: Vec3) -> f32 {
    (9.0 * n.x).sin() * (7.0 * n.y + 1.0).cos() + 1.1
}

fn map_of(density: impl Fn(Vec3) -> f32) -> NdfMap {
    NdfMap::from_fn(128, 128, Measure::ProjectedSolidAngle, Reconstruction::Bilinear, density)
        .expect("a density")
}

/// Densities whose map is interpolated.
fn tables() -> Vec<Named> {
    let ggx = Ggx::new(0.5, 0.2).expect("a roughness");
    let measured = |cos: f32| (12.0 * (cos - 1.0)).exp() + 0.3 * (-200.0 * (cos - 0.8).powi(2)).exp();
    let blend = Blend::new(ggx, Beckmann::new(0.1, 0.6).expect("a roughness"), 0.4).expect("a weight");
    let lobe = |n: Vec3, x: f32| (-40.0 * ((n.x - x).powi(2) + n.y * n.y)).exp();
    let maps: [(&str, &dyn Fn(Vec3) -> f32); 4] = [
        ("GGX", &|m| ggx.d(m)),
        ("painted", &painted),
        ("two lobes", &|n| lobe(n, -0.4) + lobe(n, 0.4)),
        ("mixture", &|m| blend.d(m)),
    ];
    let measured = Masked::new(Isotropic::from_fn(256, measured).expect("a density"));
    maps.into_iter()
        .map(|(name, density)| (name.to_owned(), Box::new(Masked::new(map_of(density))) as Box<_>))
        .chain([("measured".to_owned(), Box::new(measured) as Box<_>)])
        .collect()
}

fn view(tilt: f32, azimuth: f32) -> Vec3 {
    Vec3::new(tilt.sin() * azimuth.cos(), tilt.sin() * azimuth.sin(), tilt.cos())
}

fn views() -> impl Iterator<Item = Vec3> {
    [0.0_f32, 1e-3, 0.3, 0.8, 1.2, 1.45, 1.55, 1.57]
        .into_iter()
        .enumerate()
        .map(|(k, tilt)| view(tilt, 0.7 * k as f32))
}

fn gaussians(random: &mut Random) -> Vec2 {
    Vec2::from(random.gaussians().map(|z| z as f32))
}

#[test]
fn warp_visible_is_sample_visible_of_exponential_and_azimuth() {
    let mut random = Random(2);
    for (ggx, v) in ALPHAS
        .into_iter()
        .flat_map(|[x, y]| views().flat_map(move |v| (0..500).map(move |_| (Ggx::new(x, y).unwrap(), v))))
    {
        let u = Vec2::new(random.uniform() as f32, random.uniform() as f32);
        let rho = (-2.0 * f64::from(-u.y).ln_1p()).sqrt();
        let (sin, cos) = (core::f64::consts::TAU * f64::from(u.x)).sin_cos();
        let m = ggx.warp_visible(v, Vec2::new((rho * cos) as f32, (rho * sin) as f32));
        // Normals whose terms cancel, see `Ggx`, amplify rounding.
        assert_abs_diff_eq!(m, ggx.sample_visible(v, u), epsilon = 3e-5, "{ggx:?} {v} {u}");
    }
}

#[test]
fn student_warp_visible_between_ggx_and_beckmann() {
    // γ = 2 has the density of GGX and another map. γ → ∞ has the map of Beckmann.
    let mut random = Random(11);
    for ([x, y], v) in ALPHAS.into_iter().flat_map(|alpha| views().map(move |v| (alpha, v))) {
        let (student, beckmann) = (StudentT::new(x, y, 1e10).unwrap(), Beckmann::new(x, y).unwrap());
        for _ in 0..50 {
            let z = gaussians(&mut random);
            let (m, expected) = (student.warp_visible(v, z), beckmann.warp_visible(v, z));
            assert_abs_diff_eq!(m, expected, epsilon = 2e-6, "{x} {y} {v} {z}");
        }
    }
}

#[test]
fn warp_visible_at_the_zenith_is_warp_gaussian() {
    let mut random = Random(5);
    let exact = closed_forms().into_iter().map(|named| (named, true));
    for ((name, ndf), is_exact) in exact.chain(tables().into_iter().map(|named| (named, false))) {
        for _ in 0..1000 {
            let z = gaussians(&mut random);
            let (m, n) = (ndf.warp_visible(Vec3::Z, z), ndf.warp_gaussian(z));
            assert_abs_diff_eq!(m, n, epsilon = 4e-7, "{name} {z}");
            let expected = if is_exact { z } else { ndf.invert(n) };
            assert_abs_diff_eq!(ndf.invert_visible(Vec3::Z, n), expected, epsilon = 1e-5, "{name}");
        }
    }
}

#[test]
fn invert_visible_round_trip() {
    let bounds = closed_forms().into_iter().map(|named| (named, 4e-5));
    // Where a table has hardly any weight, the rounding of the normal moves the coordinates far.
    // Measured: 2.1e-3.
    let tables = tables().into_iter().map(|named| (named, 1e-2));
    bounds.chain(tables).par_bridge().for_each(|((name, ndf), bound)| {
        let (mut random, mut worst) = (Random(7), 0.0_f32);
        for (v, _) in views().flat_map(|v| (0..500).map(move |k| (v, k))) {
            let z = gaussians(&mut random);
            let m = ndf.warp_visible(v, z);
            assert!(m.is_normalized() && m.z > 0.0, "{v} {z} {m}");
            let error = (ndf.invert_visible(v, m) - z).abs().max_element();
            // Measured: 1.8e-5 at a grazing view, whose cap ends next to the horizon.
            assert!(error < bound, "{name} {v} {z}: {error}");
            worst = worst.max(error);
        }
        println!("{name}: {worst:.1e}");
    });
}

/// Samples of each χ² test, of 256 cells.
const SAMPLES: usize = 1 << 15;

/// `∫ f dω` in cells of the visible normals that `seen` samples, and `p` of χ² of its samples.
fn integrate<N: VisibleWarp>(
    seen: &VisibleFacets<N>,
    f: impl Fn(&VisibleFacets<N>, Vec3) -> f64,
    seed: u64,
) -> (f64, f64) {
    let mut random = Random(seed);
    let mut sample = || seen.warp_gaussian(gaussians(&mut random));
    let cells = Cells::of_hemisphere((0..SAMPLES / 4).map(|_| sample()));
    let masses = cells.integrate(|m| f(seen, m));
    let whole: f64 = masses.iter().sum();
    let fractions: Vec<f64> = masses.iter().map(|mass| mass / whole).collect();
    (whole, p_value(&cells.count((0..SAMPLES).map(|_| sample())), &fractions, SAMPLES as u64))
}

/// Resolved coordinates, their fraction, and the tilt of the view.
const RESOLVED: [([f32; 2], f32, f32); 6] = [
    ([0.4, -1.1], 0.0, 0.3),
    ([0.4, -1.1], 0.5, 0.3),
    ([0.4, -1.1], 0.8, 1.2),
    ([-1.3, 0.2], 0.6, 1.45),
    ([1.5, 1.0], 0.9, 0.8),
    ([0.0, 0.0], 0.7, 1.0),
];

#[test]
#[ignore = "slow: weekly"]
fn visible_facets_samples_have_the_density_whose_integral_is_one() {
    let densities: Vec<_> = closed_forms().into_iter().chain(tables()).collect();
    let least = 1e-4 / (densities.len() * RESOLVED.len()) as f64;
    densities.par_iter().enumerate().for_each(|(index, (name, ndf))| {
        // Every density at half of the points, every point with half of the densities.
        for (seed, (z_b, s, tilt)) in (0..).zip(RESOLVED).skip(index % 2).step_by(2) {
            let seen = VisibleFacets::new(&**ndf, view(tilt, 0.4), Vec2::from(z_b), s);
            let (integral, p) = integrate(&seen, |seen, m| f64::from(seen.pdf(m)), seed);
            assert_abs_diff_eq!(integral, 1.0, epsilon = 1e-3, "{name} {z_b:?} {s} {tilt}");
            assert!(p > least, "{name} {z_b:?} {s} {tilt}: p = {p:e}");
        }
    });
}

#[test]
#[ignore = "slow: weekly"]
fn visible_facets_of_tables_are_nearly_normalized() {
    const SIDE: usize = 16;
    const POINTS: u16 = 100;
    let gaussian = |k: usize| inverse_gaussian_cdf((k as f64 + 0.5) / SIDE as f64) as f32;
    tables().par_iter().for_each(|(name, ndf)| {
        for (tilt, s) in [0.0_f32, 60.0, 80.0].into_iter().flat_map(|t| [0.3, 0.8, 0.97].map(|s| (t, s))) {
            let (mut random, v) = (Random(3), view(tilt.to_radians(), 0.4));
            let (mut sums, mut weights) = ([0.0_f64; 2], [f64::INFINITY, 0.0_f64]);
            let mut integrals = [f64::INFINITY, 0.0_f64];
            for _ in 0..POINTS {
                let seen = VisibleFacets::new(&**ndf, v, gaussians(&mut random), s);
                let mut integral = 0.0;
                for (i, j) in (0..SIDE).flat_map(|i| (0..SIDE).map(move |j| (i, j))) {
                    let m = seen.warp_gaussian(Vec2::new(gaussian(i), gaussian(j)));
                    let weight = f64::from(ndf.visible_pdf(v, m) / ndf.warp_visible_pdf(v, m));
                    integral += weight / (SIDE * SIDE) as f64;
                    weights = [weights[0].min(weight), weights[1].max(weight)];
                }
                integrals = [integrals[0].min(integral), integrals[1].max(integral)];
                sums = [sums[0] + integral, sums[1] + (integral - 1.0).powi(2)];
            }
            let [mean, square] = sums.map(|sum| sum / f64::from(POINTS));
            println!(
                "{name:10} {tilt:2}° s = {s:4}: ∫ d dω {mean:.4} rms {:.4}, {integrals:.3?}; weights {weights:.3?}",
                square.sqrt(),
            );
            // Measured: 0.054, and 3.8.
            assert!(square.sqrt() < 0.08 && (mean - 1.0).abs() < 0.02 && weights[1] < 6.0, "{name}");
        }
    });
}

#[test]
#[ignore = "slow: weekly"]
fn visible_facets_mean_is_the_far_field() {
    // Means over z_b of the density at one normal, by the trapezoid rule on ±6. The narrowest lobe has
    // a standard deviation of 0.5, five steps.
    const SIDE: i16 = 60;
    closed_forms().into_iter().chain(tables()).par_bridge().for_each(|(name, ndf)| {
        for (v, s) in views().zip([0.1, 0.3, 0.5, 0.7, 0.8, 0.4, 0.6, 0.2]) {
            for z in [Vec2::new(0.3, -0.4), Vec2::new(-1.5, 0.7), Vec2::new(0.1, 2.0)] {
                let m = ndf.warp_visible(v, z);
                let mut mean = 0.0;
                for (i, j) in (-SIDE..=SIDE).flat_map(|i| (-SIDE..=SIDE).map(move |j| (i, j))) {
                    let z_b = Vec2::new(f32::from(i), f32::from(j)) * (6.0 / f32::from(SIDE));
                    let weight = (-0.5 * f64::from(z_b.length_squared())).exp() / core::f64::consts::TAU;
                    mean += weight * f64::from(VisibleFacets::new(&*ndf, v, z_b, s).d(m));
                }
                mean *= (6.0 / f64::from(SIDE)).powi(2);
                let far = f64::from(ndf.visible_pdf(v, m));
                assert_abs_diff_eq!(mean / far, 1.0, epsilon = 1e-4, "{name} {v} {s} {z}");
            }
        }
    });
}

#[test]
fn visible_warp_is_continuous_in_the_view() {
    let densities = [
        named(Ggx::new(0.4, 0.2)),
        named(Beckmann::new(0.4, 0.2)),
        named(StudentT::new(0.4, 0.2, 1.6)),
        named(Rotated::new(Ggx::new(0.4, 0.2).expect("a roughness"), 1.0)),
    ];
    let bounds = densities.into_iter().map(|named| (named, 4e-3));
    // The map of a painting bends more. `T` of two lobes jumps between them.
    for ((name, ndf), bound) in
        bounds.chain(tables().into_iter().filter(|(name, _)| name != "two lobes").map(|named| (named, 2e-2)))
    {
        for z in [Vec2::ZERO, Vec2::new(1.0, -0.5), Vec2::new(-2.0, 0.3)] {
            let mut last = ndf.warp_visible(Vec3::Z, z);
            for k in 1..=1600_u16 {
                let m = ndf.warp_visible(view(f32::from(k) * 9.8e-4, 0.3), z);
                assert!(m.distance(last) < bound, "{name} {z} {k}: {m} {last}");
                last = m;
            }
        }
    }
}

#[test]
fn every_input_returns_a_normal() {
    let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0, -1.0, 1e30, 1e-30];
    let extreme = [[1e-6, 1e6], [1e6, 1e6], [1e-6, 1e-6]].into_iter().flat_map(|[x, y]| {
        [
            named(Ggx::new(x, y)),
            named(Beckmann::new(x, y)),
            named(StudentT::new(x, y, 1.51)),
            named(StudentT::new(x, y, 1e12)),
        ]
    });
    let rim = |n: Vec3| if n.z < 0.02 { 1.0 } else { 0.0 };
    let odd = ("rim".to_owned(), Box::new(Masked::new(map_of(rim))) as Box<_>);
    closed_forms().into_iter().chain(tables()).chain(extreme).chain([odd]).for_each(|(name, ndf)| {
        for (a, b, c) in
            bad.into_iter().flat_map(|a| bad.into_iter().flat_map(move |b| bad.map(|c| (a, b, c))))
        {
            let v = Vec3::new(a, b, c);
            let m = ndf.warp_visible(v, Vec2::new(b, c));
            assert!(m.is_normalized() && m.z >= 0.0, "{name} {v}: {m}");
            for z in [ndf.invert_visible(v, m), ndf.invert_visible(m, v), ndf.invert_visible(v, v)] {
                assert!(z.is_finite(), "{name} {v}: {z}");
            }
            let seen = VisibleFacets::new(&*ndf, v, Vec2::new(c, a), b);
            for density in [seen.pdf(m), seen.d(m), seen.pdf(v), seen.d(v)] {
                assert!(density >= 0.0 && density.is_finite(), "{name} {v}: {density}");
            }
            assert!(seen.warp_gaussian(Vec2::new(a, c)).is_normalized(), "{name} {v}");
        }
    });
}
