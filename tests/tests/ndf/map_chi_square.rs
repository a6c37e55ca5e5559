//! Normals and visible normals sampled from images, against their density: χ² with pooled bins,
//! significance 0.001 divided by the number of cases.

use asperity_ndf_sampling::check::p_value;
use asperity_ndf_sampling::{Masked, Measure, Microfacet, Ndf, NdfMap, Reconstruction};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::disk_bins::DiskBins;
use asperity_tests::random::Random;
use glam::{DVec3, Vec2, Vec3};
use rayon::prelude::*;

const SAMPLES: u64 = 200_000;
/// Nine images and the largest in both reconstructions, and two of them in both measures.
const CASES: f64 = 24.0;
const LEAST_P: f64 = 0.001 / CASES;

const KINDS: [Reconstruction; 2] = [Reconstruction::Constant, Reconstruction::Bilinear];

/// An image and the bins per side that resolve it. Each bin lies in one texel, or in one quarter of
/// a texel for bilinear maps.
struct Image {
    name: &'static str,
    width: usize,
    height: usize,
    bins: usize,
    texels: Vec<f32>,
}

/// Returns the density inside the disk, and 0 outside.
fn density(map: &NdfMap, x: f64, y: f64) -> f64 {
    if x * x + y * y <= 1.0 { f64::from(map.d(Vec3::new(x as f32, y as f32, 1.0))) } else { 0.0 }
}

impl Image {
    /// Creates the image of a function of column and row.
    fn new(
        name: &'static str,
        [width, height, bins]: [usize; 3],
        texel: impl Fn(usize, usize) -> f32 + Sync,
    ) -> Self {
        let texels = (0..width * height).into_par_iter().map(|k| texel(k % width, k / width)).collect();
        Self { name, width, height, bins, texels }
    }

    fn map(&self, measure: Measure, reconstruction: Reconstruction) -> NdfMap {
        NdfMap::from_texels(self.width, self.height, &self.texels, measure, reconstruction).expect("valid")
    }

    /// Returns the probabilities of the bins from the map's density.
    fn probabilities(&self, map: &NdfMap) -> Vec<f64> {
        let bins = DiskBins { size: self.bins, extent: [1.0, 1.0] };
        let probabilities = bins.integrate(2, |x, y| density(map, x, y));
        let total: f64 = probabilities.iter().sum();
        assert_abs_diff_eq!(total, 1.0, epsilon = 1e-6, "{}: the density integrates to {total}", self.name);
        probabilities
    }

    /// Returns the projected areas of visible normals in the bins, from the map's density.
    fn areas(&self, map: &NdfMap, view: DVec3) -> Vec<f64> {
        let bins = DiskBins { size: self.bins, extent: [1.0, 1.0] };
        bins.projected(view, 1, |x, y| density(map, x, y))
    }

    fn counts(&self, seed: u64, samples: u64, sample: impl Fn(Vec2) -> Vec3) -> Vec<u64> {
        let mut random = Random(seed);
        let mut draw = || sample(Vec2::new(random.uniform() as f32, random.uniform() as f32));
        DiskBins { size: self.bins, extent: [1.0, 1.0] }.count((0..samples).map(|_| draw()))
    }

    /// Returns a normal moved back into its texel, if rounding placed it across the border of a
    /// texel with weight.
    ///
    /// The density looks up the texel at `n·size/2 + size/2` in `f32`. With ε = 2⁻²⁴ the product
    /// rounds by at most `ε·size/2`, and the sum, at most `size`, by `ε·size`: together 3ε = 1.8e-7
    /// of `n`. A step of 4ε, which is at least 3.5ε after its own rounding, is enough.
    fn off_border(&self, m: Vec3) -> Vec3 {
        const STEP: f32 = 2.0 * f32::EPSILON;
        const NEAR: [f32; 3] = [0.0, -STEP, STEP];
        let texel = |m: &Vec3| {
            let at = |n: f32, size: usize| (0.5 * (f64::from(n) + 1.0) * size as f64) as usize;
            let (i, j) = (at(m.x, self.width), at(m.y, self.height));
            self.texels[j.min(self.height - 1) * self.width + i.min(self.width - 1)]
        };
        let near = NEAR.into_iter().flat_map(|x| NEAR.map(|y| m + Vec3::new(x, y, 0.0)));
        near.into_iter().find(|m| texel(m) > 0.0).unwrap_or(m)
    }
}

/// Returns images on which inversion has failed in the past.
fn images() -> Vec<Image> {
    // Of the texel's center, in normal coordinates.
    let at = |k: usize, n: usize| (2.0 * k as f32 + 1.0) / n as f32 - 1.0;
    let lobe = |x: f32, y: f32| (-30.0 * (x * x + y * y)).exp();
    vec![
        Image::new("smooth", [32, 32, 64], |i, j| {
            let (x, y) = (at(i, 32), at(j, 32));
            lobe(x + 0.45, y - 0.2) + 0.5 * lobe(x - 0.6, y + 0.6) + 0.01
        }),
        Image::new("binary mask", [16, 16, 64], |i, j| f32::from((i * 7 + j * 5) % 11 < 4)),
        Image::new("one hot texel", [16, 16, 64], |i, j| if (i, j) == (11, 6) { 1e-20 } else { 0.0 }),
        Image::new("one hot texel at the rim", [8, 8, 64], |i, j| f32::from((i, j) == (0, 2))),
        Image::new("hot texel at the top", [9, 9, 54], |i, j| f32::from((i, j) == (4, 8))),
        Image::new("two far islands", [32, 32, 64], |i, j| match (i, j) {
            (1, 16) => 1.0,
            (30, 15) => 3.0,
            _ => 0.0,
        }),
        Image::new("ring with an empty center", [32, 32, 64], |i, j| {
            f32::from(at(i, 32).hypot(at(j, 32)) > 0.7)
        }),
        Image::new("one texel", [1, 1, 24], |_, _| 2.0),
        Image::new("not square", [24, 5, 120], |i, j| ((i * 5 + j * 3) % 7) as f32),
    ]
}

/// Returns every image in both reconstructions, and two of them in both measures.
fn cases() -> Vec<(Image, Measure, Reconstruction)> {
    let cases: Vec<_> = [Measure::ProjectedSolidAngle, Measure::SolidAngle]
        .into_iter()
        .flat_map(|measure| {
            let count = if measure == Measure::ProjectedSolidAngle { usize::MAX } else { 2 };
            let cases =
                KINDS.map(|kind| images().into_iter().take(count).map(move |image| (image, measure, kind)));
            cases.into_iter().flatten()
        })
        .collect();
    assert_eq!(cases.len() + 2, CASES as usize);
    cases
}

#[test]
fn images_sample_their_density() {
    cases().into_par_iter().enumerate().for_each(|(seed, (image, measure, kind))| {
        let map = image.map(measure, kind);
        let probabilities = image.probabilities(&map);
        let p = p_value(&image.counts(seed as u64, SAMPLES, |u| map.sample(u)), &probabilities, SAMPLES);
        println!("{}, {measure:?}, {kind:?}: p = {p:.4}", image.name);
        assert!(p > LEAST_P, "{}, {measure:?}, {kind:?}: p = {p:e}", image.name);
    });
}

/// Returns a view at an angle from the normal in degrees.
fn view(degrees: f64, azimuth: f64) -> Vec3 {
    let ((sin, cos), (y, x)) = (degrees.to_radians().sin_cos(), azimuth.sin_cos());
    DVec3::new(sin * x, sin * y, cos).as_vec3()
}

#[test]
fn images_sample_their_visible_normals() {
    const SAMPLES: u64 = 40_000;
    let angles = [0.0, 45.0, 80.0, 89.5];
    let least_p = 0.001 / ((CASES - 2.0) * angles.len() as f64);
    cases().into_par_iter().enumerate().for_each(|(seed, (image, measure, kind))| {
        let masked = Masked::new(image.map(measure, kind));
        for (k, degrees) in (0..).zip(angles) {
            let v = view(degrees, 2.4 * (seed + 7 * k) as f64);
            let mut probabilities = image.areas(masked.density(), v.as_dvec3());
            let area: f64 = probabilities.iter().sum();
            let case = format!("{}, {measure:?}, {kind:?} from {degrees}°", image.name);
            // Measured 1.7e-3 for distant islands in steps, and 1e-5 where hardly a facet is
            // visible.
            let table = f64::from(masked.projected_area(v));
            assert!((table - area).abs() < 2e-3 * area + 2e-5, "{case}: an area of {table} for {area}");
            if area < 1e-6 {
                continue;
            }
            probabilities.iter_mut().for_each(|probability| *probability /= area);
            let sample = |u| masked.sample_visible(v, u);
            let place = |u| image.off_border(sample(u));
            let p = p_value(&image.counts(seed as u64, SAMPLES, place), &probabilities, SAMPLES);
            println!("{case}: σ {area:.4} ({:.0e}), p = {p:.4}", table / area - 1.0);
            assert!(p > least_p, "{case}: p = {p:e}");
            // The density by which a reflectance divides is the same.
            for m in (0..50_u16).map(|k| sample(Vec2::new(f32::from(k) / 50.0, f32::from(k * 7 % 50) / 50.0)))
            {
                let exact = f64::from(masked.density().d(m)) * f64::from(v.dot(m).max(0.0)) / table;
                assert_abs_diff_eq!(
                    f64::from(masked.visible_pdf(v, m)) / exact,
                    1.0,
                    epsilon = 1e-3,
                    "{case}: {m}"
                );
            }
        }
    });
}

#[test]
fn largest_map_samples_its_density() {
    const SIZE: usize = 4096;
    let density = |x: f64, y: f64| 1.0 + 0.9 * (9.0 * x).sin() * (7.0 * y).cos();
    let at = |k: usize| (2.0 * k as f64 + 1.0) / SIZE as f64 - 1.0;
    let image = Image::new("4096×4096", [SIZE, SIZE, 64], |i, j| density(at(i), at(j)) as f32);
    // The texels' steps are 1e-6 of the bins' probabilities.
    let mut probabilities = DiskBins { size: 64, extent: [1.0, 1.0] }.integrate(2, density);
    let total: f64 = probabilities.iter().sum();
    probabilities.iter_mut().for_each(|probability| *probability /= total);
    for (seed, kind) in KINDS.into_iter().enumerate() {
        let map = image.map(Measure::ProjectedSolidAngle, kind);
        let p = p_value(&image.counts(50 + seed as u64, SAMPLES, |u| map.sample(u)), &probabilities, SAMPLES);
        println!("4096×4096 {kind:?}: p = {p:.4}");
        assert!(p > LEAST_P, "4096×4096 {kind:?}: p = {p:e}");
    }
}

#[test]
fn constant_per_solid_angle_is_uniform_on_the_hemisphere() {
    let map = NdfMap::from_fn(128, 128, Measure::SolidAngle, Reconstruction::Constant, |_| 3.0).unwrap();
    for n in [Vec3::Z, Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.5, -0.5, 0.5_f32.sqrt())] {
        // D cos θ is the density per solid angle: 1/(2π). The texel's mean of 1/cos θ differs by
        // its width; measured 1.2 %.
        let per_solid_angle = map.d(n) * n.z * std::f32::consts::TAU;
        assert_abs_diff_eq!(per_solid_angle, 1.0, epsilon = 0.02, "{n}: {per_solid_angle}");
    }
}

#[test]
fn distorted_samplers_are_rejected() {
    let images = images();
    let smooth = &images[0];
    for kind in KINDS {
        let map = smooth.map(Measure::ProjectedSolidAngle, kind);
        let other = smooth.map(Measure::ProjectedSolidAngle, KINDS[usize::from(kind == KINDS[0])]);
        let center = |n: f32| ((n * 16.0 + 16.0).floor() + 0.5) / 16.0 - 1.0;
        let up = |x: f32, y: f32| Vec3::new(x, y, (1.0 - x * x - y * y).max(1e-6).sqrt()).normalize();
        let centers = |u: Vec2| {
            let m = map.sample(u);
            up(center(m.x), center(m.y))
        };
        let distorted: [(&str, &dyn Fn(Vec2) -> Vec3); 4] = [
            ("the other reconstruction", &|u| other.sample(u)),
            ("centers of texels", &centers),
            ("axes swapped", &|u| {
                let m = map.sample(u);
                Vec3::new(m.y, m.x, m.z)
            }),
            ("1 % of the tail lost", &|u| map.sample(u * 0.99)),
        ];
        let probabilities = smooth.probabilities(&map);
        for (name, sample) in distorted {
            let p = p_value(&smooth.counts(5, SAMPLES, sample), &probabilities, SAMPLES);
            println!("{kind:?}, {name}: p = {p:e}");
            assert!(p < 1e-9, "{kind:?}, {name}: p = {p:e}");
        }
    }
}
