//! Checks of an NDF and its map from Gaussian coordinates.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use glam::{Vec2, Vec3};

use crate::check::cells::Cells;
use crate::ndf::Ndf;
use crate::numeric::normal_distribution::inverse_gaussian_cdf;
use asperity_core::check::Settings;
use asperity_core::check::p_value;
use asperity_core::check::{Limit, Report};
use asperity_core::math;

/// The largest accepted error of an integral: five times the largest error of the quadrature
/// itself.
pub(super) const INTEGRAL: f64 = 1e-3;

/// Samples from which the cells are made, 64 for each.
const PILOT: usize = 1 << 14;

/// Points at which the map and its inverse are compared, and the minimum sample count of a χ² test.
const PLACES: usize = 4096;

/// Checks an [`Ndf`]: normalization, χ² of `sample` and `T`, derivative and inverse of `T`, invalid
/// input.
///
/// ```text
/// ∫ D cos θ dω = 1,      D(T(z)) |∂(n_x, n_y)/∂z| = φ(z) = exp(−|z|²/2)/(2π),      T⁻¹(T(z)) = z,      T(T⁻¹(m)) = m
/// ```
///
/// - The integral is 1 within 1e-3.
/// - `sample` and `warp_gaussian` draw from `D`, by χ² over 256 cells, each at half of the
///   significance of the settings.
/// - `D` is consistent with the derivative of `T`, by finite differences: within 0.2 % at nine of
///   ten normals, which permits kinks.
/// - `T⁻¹(T(z)) = z` for |z| ≤ 4, and `T(T⁻¹(m)) = m` for samples, within 1e-3 standard deviations
///   and four times the effect of rounding the normal to `f32`.
/// - Invalid input (NaN, infinities, huge and tiny numbers) produces unit normals above the
///   horizon, finite coordinates, and finite densities that are 0 at and below the horizon.
///
/// ```
/// use asperity_ndf_sampling::{Ndf, check, glam::{Vec2, Vec3}};
///
/// /// A custom NDF, one per cent too bright.
/// struct Bright(asperity_ndf_sampling::Beckmann);
/// impl Ndf for Bright {
///     fn d(&self, m: Vec3) -> f32 { (1.01 * self.0.d(m)).min(f32::MAX) }
///     fn warp_gaussian(&self, z: Vec2) -> Vec3 { self.0.warp_gaussian(z) }
///     fn invert(&self, m: Vec3) -> Vec2 { self.0.invert(m) }
/// }
///
/// let bright = Bright(asperity_ndf_sampling::Beckmann::new(0.2, 0.4)?);
/// let report = check::ndf(&bright, check::Settings::default());
/// assert!(report.failures().eq(["normalization", "Jacobian of the map"]), "{report}");
/// # Ok::<(), asperity_ndf_sampling::NdfError>(())
/// ```
#[must_use]
pub fn ndf<N: Ndf + ?Sized>(ndf: &N, settings: Settings) -> Report {
    shared(ndf, settings, settings.significance / 2.0)
}

/// The checks of an [`Ndf`] at the given significance for each χ² test.
pub(super) fn shared<N: Ndf + ?Sized>(ndf: &N, settings: Settings, significance: f64) -> Report {
    let mut report = Report::default();
    let density = Density::new(settings, 0, |u| ndf.sample(u));
    let masses = density.cells.integrate(|m| f64::from(ndf.d(m)) * f64::from(m.z));
    let total: f64 = masses.iter().sum();
    report.add("normalization", "|∫ D cos θ dω − 1|", (total - 1.0).abs(), Limit::AtMost(INTEGRAL), "");
    let limit = Limit::AtLeast(significance);
    let p = density.p_value(&masses, 1, |u| ndf.sample(u));
    report.add("samples", "p of χ²", p, limit, "");
    let p = density.p_value(&masses, 2, |u| ndf.warp_gaussian(gaussian(u)));
    report.add("map from Gaussian coordinates", "p of χ²", p, limit, "");
    add_jacobian(&mut report, ndf, settings.points(3));
    add_inverses(&mut report, ndf, settings.points(4));
    add_totality(&mut report, ndf);
    report
}

/// A partition of the hemisphere for χ² tests.
pub(super) struct Density {
    pub(super) cells: Cells,
    settings: Settings,
}

impl Density {
    /// Creates a partition from the samples of a sampler.
    pub(super) fn new(settings: Settings, stream: u8, sample: impl Fn(Vec2) -> Vec3) -> Self {
        Self { cells: Cells::of_hemisphere(settings.points(stream).take(PILOT).map(sample)), settings }
    }

    /// The p-value of the hypothesis that the samples follow the masses of the cells.
    pub(super) fn p_value(&self, masses: &[f64], stream: u8, sample: impl Fn(Vec2) -> Vec3) -> f64 {
        let (total, count) = (masses.iter().sum::<f64>(), (self.settings.samples as usize).max(PLACES));
        let fractions: Vec<f64> = masses.iter().map(|mass| mass / total).collect();
        let counts = self.cells.count(self.settings.points(stream).take(count).map(sample));
        p_value(&counts, &fractions, count as u64)
    }
}

/// Gaussian coordinates of uniform numbers.
fn gaussian(u: Vec2) -> Vec2 {
    // The middle of its cell of 2⁻²⁴, so neither end is infinite.
    Vec2::from(u.to_array().map(|u| inverse_gaussian_cdf(f64::from(u) + 0.5 / 16_777_216.0) as f32))
}

/// Adds `D(T(z)) |∂(n_x, n_y)/∂z| = φ(z)`.
fn add_jacobian<N: Ndf + ?Sized>(report: &mut Report, ndf: &N, points: impl Iterator<Item = Vec2>) {
    // A power of two, which shifts coordinates of 2⁻¹⁶ without rounding.
    const H: f32 = 1.0 / 256.0;
    let mut errors: Vec<(f64, Vec2)> = points
        .take(PLACES)
        .map(|u| {
            let z = Vec2::from(gaussian(u).to_array().map(|x| ((x * 65_536.0) as i32) as f32 / 65_536.0));
            let along = |step: Vec2| {
                let moved = ndf.warp_gaussian(z + step) - ndf.warp_gaussian(z - step);
                [moved.x, moved.y].map(|x| f64::from(x) / f64::from(2.0 * H))
            };
            let ([a, b], [c, d]) = (along(H * Vec2::X), along(H * Vec2::Y));
            let area = (a * d - b * c).abs();
            let density = f64::from(ndf.d(ndf.warp_gaussian(z)));
            let phi = math::exp_f64(-0.5 * f64::from(z.length_squared())) / core::f64::consts::TAU;
            ((density * area / phi - 1.0).abs(), z)
        })
        .collect();
    let most = errors.len() * 9 / 10;
    let (_, &mut (error, z), _) = errors.select_nth_unstable_by(most, |a, b| a.0.total_cmp(&b.0));
    let quantity = "|D ∂n/∂z/φ − 1|, exceeded at a tenth";
    report.add("Jacobian of the map", quantity, error, Limit::AtMost(JACOBIAN), format!("at z = {z}"));
}

/// The largest accepted relative error of a density by finite differences of its map.
const JACOBIAN: f64 = 2e-3;

/// Adds `T⁻¹(T(z)) = z` and `T(T⁻¹(m)) = m`.
fn add_inverses<N: Ndf + ?Sized>(report: &mut Report, ndf: &N, points: impl Iterator<Item = Vec2>) {
    let (mut there, mut back) = (Worst::default(), Worst::default());
    for u in points.take(PLACES) {
        // Uniform over the square, which includes the tails.
        let z = (u - 0.5) * (8.0 * core::f32::consts::FRAC_1_SQRT_2);
        let m = ndf.warp_gaussian(z);
        let again = ndf.invert(m);
        // The effect of a unit in the last place of each component.
        let nudged = |k: usize| {
            let mut near = m.to_array();
            near[k] *= 1.0 + f32::EPSILON;
            (ndf.invert(near.into()) - again).length()
        };
        let rounding = nudged(0) + nudged(1) + nudged(2);
        there.note(f64::from((again - z).length() - 4.0 * rounding), || format!("at z = {z}"));

        let m = ndf.sample(u);
        let z = ndf.invert(m);
        let again = ndf.warp_gaussian(z);
        // The effect of a thousandth of a standard deviation, to either side.
        let from_there = |n: Vec3| (n - again).truncate().length();
        let moved = |step: Vec2| from_there(ndf.warp_gaussian(z + step));
        let width: f32 = [Vec2::X, Vec2::Y, -Vec2::X, -Vec2::Y].map(|axis| moved(1e-3 * axis)).iter().sum();
        let off = from_there(m) - 4.0 * f32::EPSILON * m.truncate().length();
        back.note(if off <= 0.0 { 0.0 } else { f64::from(1e-3 * off / width) }, || format!("at m = {m}"));
    }
    let limit = Limit::AtMost(1e-3);
    report.add("inverse of the map", "|T⁻¹(T(z)) − z| beyond rounding", there.error, limit, there.place);
    report.add("map of the inverse", "|T(T⁻¹(m)) − m| in standard deviations", back.error, limit, back.place);
}

/// The largest error and where it occurs; NaN is larger than any number.
#[derive(Default)]
pub(super) struct Worst {
    pub(super) error: f64,
    pub(super) place: String,
}

impl Worst {
    pub(super) fn note(&mut self, error: f64, place: impl FnOnce() -> String) {
        if error > self.error || error.is_nan() && !self.error.is_nan() {
            *self = Self { error, place: place() };
        }
    }
}

/// Inputs that evaluation must accept.
pub(super) const ODD: [f32; 10] =
    [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0, -0.0, 1e-40, 1e38, -1e38, -1.0, 0.5];

/// Whether `m` is a unit vector above the horizon.
pub(super) fn is_facet(m: Vec3) -> bool {
    (m.length() - 1.0).abs() < 1e-5 && m.z > 0.0
}

/// Counts violations of an invariant and keeps the first case.
#[derive(Default)]
pub(super) struct Broken {
    count: u32,
    first: String,
}

impl Broken {
    pub(super) fn unless(&mut self, kept: bool, case: impl FnOnce() -> String) {
        if !kept {
            if self.count == 0 {
                self.first = case();
            }
            self.count += 1;
        }
    }

    pub(super) fn add(self, report: &mut Report, name: &'static str) {
        let Self { count, first } = self;
        report.add(name, "cases out of range", f64::from(count), Limit::AtMost(0.0), first);
    }
}

/// Adds the check that every method accepts every input.
fn add_totality<N: Ndf + ?Sized>(report: &mut Report, ndf: &N) {
    let mut broken = Broken::default();
    for z in ODD.into_iter().flat_map(|x| ODD.map(|y| Vec2::new(x, y))) {
        let (from, sample, slopes) = (ndf.warp_gaussian(z), ndf.sample(z), ndf.slope_density(z));
        broken.unless(is_facet(from), || format!("warp_gaussian({z}) = {from}"));
        broken.unless(is_facet(sample), || format!("sample({z}) = {sample}"));
        broken.unless(slopes >= 0.0, || format!("slope_density({z}) = {slopes}"));
        for m in ODD.map(|up| z.extend(up)) {
            let (density, back) = (ndf.d(m), ndf.invert(m));
            let kept = (0.0..=f32::MAX).contains(&density) && (m.z > 0.0 || density == 0.0);
            broken.unless(kept, || format!("density({m}) = {density}"));
            broken.unless(back.is_finite(), || format!("invert({m}) = {back}"));
        }
    }
    broken.add(report, "totality");
}
