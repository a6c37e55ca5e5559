//! Every density, roughness and map against integrals of the textbook density: χ² at significance
//! 0.001 divided by the number of cases.

use asperity_ndf_sampling::check::p_value;
use asperity_ndf_sampling::{Beckmann, Ggx, Isotropic, Microfacet, Ndf, StudentT};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::disk_bins::DiskBins;
use asperity_tests::facets::{BINS, Facets};
use asperity_tests::random::Random;
use asperity_tests::reference::{self, rows};
use glam::{DVec3, Vec2, Vec3};
use rayon::prelude::*;

/// Angles of the views from the normal in degrees; the last is grazing.
const ANGLES: [f64; 4] = [0.0, 40.0, 75.0, 89.5];
/// 40 densities by 6 maps, minus one map missing for the sum of two densities.
const CASES: f64 = 239.0;
const LEAST_P: f64 = 0.001 / CASES;

fn view(angle: f64) -> Vec3 {
    let (sin, cos) = angle.to_radians().sin_cos();
    DVec3::new(sin * 0.6, sin * -0.8, cos).as_vec3()
}

/// Counts normals per bin.
fn count(facets: &Facets, seed: u64, samples: u64, sample: impl Fn(&mut Random) -> Vec3) -> Vec<u64> {
    let (mut counts, mut random) = (vec![0; BINS * BINS], Random(seed));
    for _ in 0..samples {
        let m = sample(&mut random);
        assert!(m.z > 0.0, "{}: {m}", facets.name);
        assert_abs_diff_eq!(m.length(), 1.0, epsilon = 1e-6, "{}: {m}", facets.name);
        if let Some(bin) = facets.bin(m) {
            counts[bin] += 1;
        }
    }
    counts
}

fn square(random: &mut Random) -> Vec2 {
    Vec2::new(random.uniform() as f32, random.uniform() as f32)
}

fn gaussian(random: &mut Random) -> Vec2 {
    Vec2::from(random.gaussians().map(|z| z as f32))
}

/// Returns the p-value of a sampler of the density `D cos θ` over solid angle.
fn macro_p(facets: &Facets, seed: u64, samples: u64, sample: impl Fn(&mut Random) -> Vec3) -> f64 {
    let probabilities = facets.probabilities(|m| (facets.density)(m) * m.z);
    p_value(&count(facets, seed, samples, sample), &probabilities, samples)
}

/// Returns the p-value of a sampler of visible normals.
fn visible_p(facets: &Facets, v: Vec3, seed: u64, samples: u64, sample: impl Fn(Vec2) -> Vec3) -> f64 {
    let towards = v.as_dvec3();
    let area = facets.projected(towards, &facets.density);
    let visible = |m: DVec3| (facets.density)(m) * towards.dot(m).max(0.0) / area;
    let counts = count(facets, seed, samples, |random| sample(square(random)));
    p_value(&counts, &facets.probabilities(visible), samples)
}

#[test]
fn every_map_samples_its_density() {
    let results: Vec<(String, f64)> = Facets::all()
        .into_par_iter()
        .enumerate()
        .flat_map_iter(|(case, facets)| {
            let seed = 10 * case as u64;
            let samples = 40_000;
            let mut results =
                vec![("square", macro_p(&facets, seed, samples, |random| (facets.sample)(square(random))))];
            if let Some(map) = &facets.warp_gaussian {
                results
                    .push(("Gaussian", macro_p(&facets, seed + 1, 200_000, |random| map(gaussian(random)))));
            }
            let samples = if facets.slow { 12_000 } else { samples };
            for (angle, name) in ANGLES.into_iter().zip(["0°", "40°", "75°", "89.5°"]) {
                let v = view(angle);
                let sample = |u| (facets.sample_visible)(v, u);
                results.push((name, visible_p(&facets, v, seed + 2 + angle as u64, samples, sample)));
            }
            results.into_iter().map(move |(map, p)| (format!("{} {map}", facets.name), p)).collect::<Vec<_>>()
        })
        .collect();
    let mut least = (String::new(), 1.0);
    for (name, p) in &results {
        assert!(*p > LEAST_P, "{name}: p = {p:e}");
        if *p < least.1 {
            least = (name.clone(), *p);
        }
    }
    let below = |limit: f64| results.iter().filter(|result| result.1 < limit).count();
    println!("{} cases, least p = {:.1e} ({}), {} below 0.1", results.len(), least.1, least.0, below(0.1));
    assert_eq!(results.len() as f64, CASES);
}

#[test]
fn ggx_samples_the_reference_bins() {
    let reference = reference::read("ndf/ndf_bins_32.json");
    let item = &reference["items"][0];
    assert_eq!(item["model"], "ggx");
    let [x, y] = ["alpha_x", "alpha_y"].map(|name| item[name].as_f64().unwrap() as f32);
    let ggx = Ggx::new(x, y).unwrap();
    // The file's first index runs along x, the bins' first index along y.
    let columns = rows(&item["P"]);
    let probabilities: Vec<f64> = (0..32 * 32).map(|bin| columns[bin % 32][bin / 32]).collect();
    let (mut random, samples) = (Random(99), 200_000);
    let normals = (0..samples).map(|_| ggx.warp_gaussian(gaussian(&mut random)));
    let counts = DiskBins { size: 32, extent: [1.0, 1.0] }.count(normals);
    let p = p_value(&counts, &probabilities, samples);
    assert!(p > 0.001, "p = {p:e}");
}

#[test]
fn cosine_tables_sample_their_density() {
    // A ring, a peak over a floor, and two nodes.
    let tables: [&[f32]; 3] = [&[0.0, 0.0, 2.0, 1.0, 0.0, 0.0, 0.5], &[0.2, 0.2, 0.2, 0.2, 9.0], &[0.0, 1.0]];
    for (seed, values) in tables.into_iter().enumerate() {
        let table = Isotropic::new(values).unwrap();
        let cells = (values.len() - 1) as f64;
        let shape = |c: f64| {
            let k = ((c * cells) as usize).min(values.len() - 2);
            let (low, high) = (f64::from(values[k]), f64::from(values[k + 1]));
            low + (high - low) * (c * cells - k as f64)
        };
        // Bins of the cosine that end at the nodes, by Simpson's rule, exact for these cubics.
        // Azimuths are uniform.
        let parts = 12;
        let fine = parts * (values.len() - 1);
        let masses: Vec<f64> = (0..fine)
            .map(|k| {
                let at = |t: f64| (k as f64 + t) / fine as f64;
                let f = |t: f64| shape(at(t)) * at(t);
                f(1e-9) + 4.0 * f(0.5) + f(1.0 - 1e-9)
            })
            .collect();
        let total: f64 = masses.iter().sum();
        let sectors = 8;
        let probabilities: Vec<f64> =
            masses.iter().flat_map(|mass| vec![mass / total / sectors as f64; sectors]).collect();
        for by_gaussian in [0, 1] {
            let mut random = Random(500 + 2 * seed as u64 + by_gaussian);
            let mut counts = vec![0; probabilities.len()];
            for _ in 0..60_000 {
                let m = if by_gaussian == 1 {
                    table.warp_gaussian(gaussian(&mut random))
                } else {
                    table.sample(square(&mut random))
                };
                let sector = (f64::from(m.y).atan2(f64::from(m.x)).rem_euclid(core::f64::consts::TAU) * 8.0
                    / core::f64::consts::TAU) as usize;
                let ring = ((f64::from(m.z) * fine as f64) as usize).min(fine - 1);
                counts[ring * sectors + sector.min(sectors - 1)] += 1;
            }
            let p = p_value(&counts, &probabilities, 60_000);
            println!("{values:?} {by_gaussian}: p = {p:.4}");
            assert!(p > 0.001 / 6.0, "{values:?}: p = {p:e}");
        }
    }
}

#[test]
fn distorted_samplers_are_rejected() {
    let all = Facets::all();
    let find = |name: &str| all.iter().find(|facets| facets.name.starts_with(name)).expect("a density");
    let (v, samples) = (view(75.0), 60_000);
    let ggx = find("GGX (0.3, 0.3)");
    let shirley = find("Ashikhmin–Shirley (0.4, 0.04)");
    let student = find("Student-t (0.1, 0.1) 4");
    let proposal = Ggx::new(0.4, 0.04).unwrap();
    let rougher = Ggx::isotropic(0.315).unwrap();
    let heavier = StudentT::new(0.1, 0.1, 3.5).unwrap();
    let (oval, swapped) = (find("GGX (0.4, 0.04)"), Ggx::new(0.04, 0.4).unwrap());
    let (right, another) = (Ggx::isotropic(0.3).unwrap(), Beckmann::isotropic(0.3).unwrap());
    let clamped = |z: Vec2| right.warp_gaussian(z.clamp(Vec2::splat(-2.5), Vec2::splat(2.5)));
    for (name, p) in [
        ("all normals as visible", visible_p(ggx, v, 1, samples, |u| (ggx.sample)(u))),
        ("the view two degrees off", visible_p(ggx, v, 2, samples, |u| (ggx.sample_visible)(view(77.0), u))),
        ("5 % too rough", visible_p(ggx, v, 3, samples, |u| rougher.sample_visible(v, u))),
        (
            "the proposal without rejection",
            visible_p(shirley, v, 4, samples, |u| proposal.sample_visible(v, u)),
        ),
        ("another exponent", macro_p(student, 5, samples, |random| heavier.sample(square(random)))),
        (
            "visible normals as all",
            macro_p(ggx, 6, samples, |random| (ggx.sample_visible)(v, square(random))),
        ),
        ("axes swapped", macro_p(oval, 7, samples, |random| swapped.warp_gaussian(gaussian(random)))),
        ("another model", macro_p(ggx, 8, samples, |random| another.warp_gaussian(gaussian(random)))),
        ("tails clamped at 2.5 deviations", macro_p(ggx, 9, samples, |random| clamped(gaussian(random)))),
    ] {
        println!("{name}: p = {p:e}");
        assert!(p < 1e-9, "{name}: p = {p:e}");
    }
    // The same test passes the correct sampler.
    assert!(visible_p(ggx, v, 1, samples, |u| (ggx.sample_visible)(v, u)) > LEAST_P);
}
