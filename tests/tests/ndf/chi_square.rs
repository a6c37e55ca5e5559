//! Sampled normals against their density: χ² with pooled bins, significance 0.001 over the number of cases.

use asperity_ndf_sampling::{Beckmann, Ggx, Ndf, NdfMap, Reconstruction};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::chi_square::p_value;
use asperity_tests::disk_bins::DiskBins;
use asperity_tests::random::Random;
use asperity_tests::reference::{self, rows};
use glam::{Vec2, Vec3};
use rayon::prelude::*;

const SAMPLES: u64 = 200_000;
const CASES: f64 = 17.0;
const LEAST_P: f64 = 0.001 / CASES;

/// Counts of normals from Gaussian numbers through `sample`.
fn count(bins: DiskBins, seed: u64, sample: impl Fn(Vec2) -> Vec3) -> Vec<u64> {
    let (mut counts, mut random) = (vec![0; bins.size * bins.size], Random(seed));
    for _ in 0..SAMPLES {
        let [x, y] = random.gaussians();
        let m = sample(Vec2::new(x as f32, y as f32));
        assert!(m.z > 0.0, "{m}");
        assert_abs_diff_eq!(m.length(), 1.0, epsilon = 1e-6, "{m}");
        if let Some(bin) = bins.index(f64::from(m.x), f64::from(m.y)) {
            counts[bin] += 1;
        }
    }
    counts
}

/// The densities by the textbook, in f64 and written apart from the crate.
#[derive(Clone, Copy, Debug)]
enum Model {
    Ggx,
    Beckmann,
}

impl Model {
    fn density(self, alpha: [f64; 2], nx: f64, ny: f64) -> f64 {
        let cos2 = 1.0 - nx * nx - ny * ny;
        let stretched = (nx / alpha[0]).powi(2) + (ny / alpha[1]).powi(2);
        let peak = 1.0 / (std::f64::consts::PI * alpha[0] * alpha[1]);
        match self {
            Self::Ggx => peak / (stretched + cos2).powi(2),
            Self::Beckmann if cos2 <= 0.0 => 0.0,
            Self::Beckmann => peak * (-stretched / cos2).exp() / (cos2 * cos2),
        }
    }

    fn ndf(self, alpha: [f64; 2]) -> Box<dyn Ndf> {
        let [x, y] = alpha.map(|alpha| alpha as f32);
        match self {
            Self::Ggx => Box::new(Ggx::new(x, y).expect("valid")),
            Self::Beckmann => Box::new(Beckmann::new(x, y).expect("valid")),
        }
    }

    /// Bins over four roughnesses to each side, at most the disk; the rest is one more bin.
    fn bins(alpha: [f64; 2]) -> DiskBins {
        DiskBins { size: 32, extent: alpha.map(|alpha| (4.0 * alpha).min(1.0)) }
    }

    fn p_value(self, alpha: [f64; 2], seed: u64, sample: impl Fn(Vec2) -> Vec3) -> f64 {
        let bins = Self::bins(alpha);
        let probabilities = bins.integrate(2, |x, y| self.density(alpha, x, y));
        p_value(&count(bins, seed, sample), &probabilities, SAMPLES)
    }
}

#[test]
fn closed_forms_sample_their_density() {
    let alphas = [0.05, 0.2, 0.5, 1.0].into_iter().flat_map(|alpha| [[alpha, alpha], [0.4 * alpha, alpha]]);
    let cases: Vec<_> =
        alphas.flat_map(|alpha| [(Model::Ggx, alpha), (Model::Beckmann, alpha)]).enumerate().collect();
    assert_eq!(cases.len(), 16);
    let results: Vec<_> = cases
        .into_par_iter()
        .map(|(seed, (model, alpha))| {
            (model, alpha, model.p_value(alpha, seed as u64, |z| model.ndf(alpha).from_gaussian(z)))
        })
        .collect();
    for (model, alpha, p) in results {
        println!("{model:?} {alpha:?}: p = {p:.4}");
        assert!(p > LEAST_P, "{model:?} {alpha:?}: p = {p:e}");
    }
}

#[test]
fn ggx_samples_the_reference_bins() {
    let reference = reference::read("ndf/ndf_bins_32.json");
    let item = &reference["items"][0];
    assert_eq!(item["model"], "ggx");
    let ggx =
        Ggx::new(item["alpha_x"].as_f64().unwrap() as f32, item["alpha_y"].as_f64().unwrap() as f32).unwrap();
    // The file's first index runs along x, the bins' along y.
    let columns = rows(&item["P"]);
    let probabilities: Vec<f64> = (0..32 * 32).map(|bin| columns[bin % 32][bin / 32]).collect();
    let bins = DiskBins { size: 32, extent: [1.0, 1.0] };
    let p = p_value(&count(bins, 99, |z| ggx.from_gaussian(z)), &probabilities, SAMPLES);
    assert!(p > LEAST_P, "p = {p:e}");
}

#[test]
fn distorted_samplers_are_rejected() {
    let alpha = [0.2, 0.4];
    let right = Ggx::new(0.2, 0.4).unwrap();
    let rougher = Ggx::new(0.21, 0.42).unwrap();
    let turned = Ggx::new(0.4, 0.2).unwrap();
    let beckmann = Beckmann::new(0.2, 0.4).unwrap();
    let map = NdfMap::from_ndf(32, 32, Reconstruction::Constant, &right).unwrap();
    let centres = |z: Vec2| {
        let m = map.from_gaussian(z);
        let centre = |n: f32| (((n * 0.5 + 0.5) * 32.0).floor() + 0.5) / 16.0 - 1.0;
        let (x, y) = (centre(m.x), centre(m.y));
        Vec3::new(x, y, (1.0 - x * x - y * y).max(1e-6).sqrt()).normalize()
    };
    let distorted: [(&str, &dyn Fn(Vec2) -> Vec3); 5] = [
        ("5 % too rough", &|z| rougher.from_gaussian(z)),
        ("axes swapped", &|z| turned.from_gaussian(z)),
        ("another model", &|z| beckmann.from_gaussian(z)),
        ("tails clamped at 2.5 deviations", &|z| {
            right.from_gaussian(z.clamp(Vec2::splat(-2.5), Vec2::splat(2.5)))
        }),
        ("centres of texels", &centres),
    ];
    for (name, sample) in distorted {
        let p = Model::Ggx.p_value(alpha, 5, sample);
        println!("{name}: p = {p:e}");
        assert!(p < 1e-9, "{name}: p = {p:e}");
    }
    // The same test passes the right sampler.
    assert!(Model::Ggx.p_value(alpha, 5, |z| right.from_gaussian(z)) > LEAST_P);
}
