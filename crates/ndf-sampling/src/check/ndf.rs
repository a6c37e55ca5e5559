//! Checks of a density with its map from Gaussian coordinates.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use glam::{Vec2, Vec3};

use crate::check::cells::Cells;
use crate::check::chi_square::p_value;
use crate::check::report::{Limit, Report};
use crate::check::settings::Settings;
use crate::ndf::Ndf;
use crate::numeric::hashed::Hashed;
use crate::numeric::normal_distribution::inverse_phi;

/// The largest error of an integral that passes: five times the most that the quadrature's own comes to.
const INTEGRAL: f64 = 1e-3;

/// Samples from which the cells are made.
const PILOT: u32 = 4096;

/// Checks of an [`Ndf`]: normalisation, χ² of `sample` and of `T`, the inverse of `T`, totality.
///
/// - `∫ D cos θ dω = 1` within 1e-3;
/// - `sample` and `from_gaussian` draw from `D`, by χ² over 256 cells at the significance of the settings;
/// - `T⁻¹(T(z)) = z` for |z| ≤ 4, within 1e-3 and four times what rounding of the normal to `f32` is worth;
/// - odd input, NaN, infinities, huge and tiny numbers, gives unit normals above the horizon, finite coordinates, and finite
///   densities that are 0 from the horizon down.
///
/// ```
/// use asperity_ndf_sampling::{Ndf, check, glam::{Vec2, Vec3}};
///
/// /// A density of one's own, one per cent too bright.
/// struct Bright(asperity_ndf_sampling::Beckmann);
/// impl Ndf for Bright {
///     fn density(&self, m: Vec3) -> f32 { (1.01 * self.0.density(m)).min(f32::MAX) }
///     fn from_gaussian(&self, z: Vec2) -> Vec3 { self.0.from_gaussian(z) }
///     fn to_gaussian(&self, m: Vec3) -> Vec2 { self.0.to_gaussian(m) }
/// }
///
/// let bright = Bright(asperity_ndf_sampling::Beckmann::new(0.2, 0.4)?);
/// let report = check::ndf(&bright, check::Settings::default());
/// assert!(report.failures().eq(["normalisation"]), "{report}");
/// # Ok::<(), asperity_ndf_sampling::RangeError>(())
/// ```
#[must_use]
pub fn ndf<N: Ndf + ?Sized>(ndf: &N, settings: Settings) -> Report {
    let mut report = Report::default();
    let random = |stream: u64| Hashed { state: (u64::from(settings.seed) << 8 | stream) << 32 };
    let pilot = samples(random(0), PILOT, |u| ndf.sample(u));
    let density = Density { cells: Cells::new(pilot), settings };
    let masses = density.cells.integrate(|m| f64::from(ndf.density(m)) * f64::from(m.z));
    let total: f64 = masses.iter().sum();
    report.add("normalisation", "|∫ D cos θ dω − 1|", (total - 1.0).abs(), Limit::AtMost(INTEGRAL), "");
    density.add(&mut report, "samples", &masses, random(1), |u| ndf.sample(u));
    density.add(&mut report, "map from Gaussian coordinates", &masses, random(2), |u| {
        ndf.from_gaussian(gaussian(u, 13.0))
    });
    add_inverse(&mut report, ndf, random(3));
    add_totality(&mut report, ndf);
    report
}

/// A partition of the hemisphere for χ² tests.
struct Density {
    cells: Cells,
    settings: Settings,
}

impl Density {
    /// The probability that the samples follow the masses of the cells.
    fn p_value(&self, masses: &[f64], random: Hashed, sample: impl Fn(Vec2) -> Vec3) -> f64 {
        let (total, samples_of) = (masses.iter().sum::<f64>(), self.settings.samples.max(PILOT));
        let shares: Vec<f64> = masses.iter().map(|mass| mass / total).collect();
        let counts = self.cells.count(samples(random, samples_of, sample));
        p_value(&counts, &shares, u64::from(samples_of))
    }

    /// Adds the χ² test of a sampler.
    fn add(
        &self,
        report: &mut Report,
        name: &'static str,
        masses: &[f64],
        random: Hashed,
        sample: impl Fn(Vec2) -> Vec3,
    ) {
        let p = self.p_value(masses, random, sample);
        report.add(name, "p of χ²", p, Limit::AtLeast(self.settings.significance), "");
    }
}

/// Samples of a sampler by uniform numbers.
fn samples(mut random: Hashed, count: u32, sample: impl Fn(Vec2) -> Vec3) -> impl Iterator<Item = Vec3> {
    (0..count).map(move |_| sample(Vec2::new(random.uniform(), random.uniform())))
}

/// Gaussian coordinates of uniform numbers, at most `most` from the origin along each axis.
fn gaussian(u: Vec2, most: f32) -> Vec2 {
    // In the middle of its cell of 2⁻²⁴: neither end is infinite.
    let z = u.to_array().map(|u| inverse_phi(f64::from(u) + 0.5 / 16_777_216.0) as f32);
    Vec2::from(z).clamp(Vec2::splat(-most), Vec2::splat(most))
}

/// Adds `T⁻¹(T(z)) = z`.
fn add_inverse<N: Ndf + ?Sized>(report: &mut Report, ndf: &N, mut random: Hashed) {
    let (mut worst, mut place) = (0.0_f64, String::new());
    for _ in 0..PILOT {
        // Uniform over the square, so that the tails count.
        let z = Vec2::new(random.uniform() - 0.5, random.uniform() - 0.5)
            * (8.0 * core::f32::consts::FRAC_1_SQRT_2);
        let m = ndf.from_gaussian(z);
        let back = ndf.to_gaussian(m);
        // What a unit in the last place of each component is worth.
        let nudged = |k: usize| {
            let mut near = m.to_array();
            near[k] *= 1.0 + f32::EPSILON;
            (ndf.to_gaussian(near.into()) - back).length()
        };
        let rounding = nudged(0) + nudged(1) + nudged(2);
        let off = f64::from((back - z).length() - 4.0 * rounding);
        if off > worst || off.is_nan() {
            (worst, place) = (off, format!("at z = {z}"));
        }
        if off.is_nan() {
            break;
        }
    }
    report.add("inverse of the map", "|T⁻¹(T(z)) − z| beyond rounding", worst, Limit::AtMost(1e-3), place);
}

/// Numbers that evaluation must survive.
const ODD: [f32; 10] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0, -0.0, 1e-40, 1e38, -1e38, -1.0, 0.5];

/// Whether `m` is a unit vector above the horizon.
fn is_facet(m: Vec3) -> bool {
    (m.length() - 1.0).abs() < 1e-5 && m.z > 0.0
}

/// Counts of what breaks a promise, with the first case.
#[derive(Default)]
struct Broken {
    count: u32,
    first: String,
}

impl Broken {
    fn unless(&mut self, kept: bool, case: impl FnOnce() -> String) {
        if !kept {
            if self.count == 0 {
                self.first = case();
            }
            self.count += 1;
        }
    }

    fn add(self, report: &mut Report, name: &'static str) {
        let Self { count, first } = self;
        report.add(name, "cases out of range", f64::from(count), Limit::AtMost(0.0), first);
    }
}

/// Adds totality of every call.
fn add_totality<N: Ndf + ?Sized>(report: &mut Report, ndf: &N) {
    let mut broken = Broken::default();
    for z in ODD.into_iter().flat_map(|x| ODD.map(|y| Vec2::new(x, y))) {
        let (from, sample, slopes) = (ndf.from_gaussian(z), ndf.sample(z), ndf.slope_density(z));
        broken.unless(is_facet(from), || format!("from_gaussian({z}) = {from}"));
        broken.unless(is_facet(sample), || format!("sample({z}) = {sample}"));
        broken.unless(slopes >= 0.0, || format!("slope_density({z}) = {slopes}"));
        for m in ODD.map(|up| z.extend(up)) {
            let (density, back) = (ndf.density(m), ndf.to_gaussian(m));
            let kept = (0.0..=f32::MAX).contains(&density) && (m.z > 0.0 || density == 0.0);
            broken.unless(kept, || format!("density({m}) = {density}"));
            broken.unless(back.is_finite(), || format!("to_gaussian({m}) = {back}"));
        }
    }
    broken.add(report, "totality");
}
