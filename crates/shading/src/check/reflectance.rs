//! Checks of BRDFs and BSDFs.

use alloc::format;

use asperity_ndf_sampling::check::{Limit, Report, Settings};
use glam::{Vec2, Vec3};

use crate::check::scattering::{Scattering, VIEWS, Worst, add_totality, towards};
use crate::reflectance::Brdf;

/// The largest accepted relative difference between both directions.
///
/// In the tail of a narrow lobe the exponent magnifies the rounding of h.
const RECIPROCITY: f64 = 2e-3;

/// Pairs of directions that are compared both ways.
const PAIRS: usize = 4096;

/// Checks a [`Brdf`]: reciprocity, energy, density, samples, weights, sign, invalid input.
///
/// - **reciprocity:** `f(ωi, ωo) = f(ωo, ωi)` to 0.2 %, for 4096 pairs, half of them by `sample`;
/// - **energy:** `∫ f |cos θ_i| dω_i ≤ 1.002` in every channel, from four views, or eight if the
///   BSDF transmits;
/// - **density:** `∫ pdf dω_i ≤ 1.002`;
/// - **samples:** `sample` draws from `pdf`, by χ² over 256 cells, each view at its fraction of the
///   significance of the settings. `None` and specular samples account for the difference of the
///   integral from 1;
/// - **weights:** `f |cos θ_i|` is a finite weight times the pdf. Where the pdf is 0, the
///   light is at most 0.001;
/// - **sign:** values and pdfs are not negative;
/// - **consistency:** samples contain the values of `eval` and `pdf`;
/// - **invalid input:** NaN, infinities, huge and tiny numbers return finite non-negative values
///   and pdfs, which are 0 below an opaque surface, and samples of unit directions or `None`.
///
/// ```
/// use asperity_shading::{Brdf, check::{self, Settings}, glam::Vec3};
///
/// /// A lobe that depends only on the direction of the light.
/// struct Lopsided;
/// impl Brdf for Lopsided {
///     fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
///         let above = wi.z > 0.0 && wo.z > 0.0 && (wi + wo).is_finite();
///         if above { Vec3::splat(0.3 * wi.z.min(1.0)) } else { Vec3::ZERO }
///     }
/// }
///
/// let report = check::brdf(&Lopsided, Settings::default());
/// assert!(report.failures().eq(["reciprocity"]), "{report}");
/// ```
///
/// Veach 1997, "Robust Monte Carlo Methods for Light Transport Simulation", section 5.2, for
/// reciprocity, and 3.7 for energy.
#[must_use]
pub fn brdf(brdf: &dyn Brdf, settings: Settings) -> Report {
    dielectric(brdf, 1.0, settings)
}

/// Checks a [`Brdf`] that transmits light into a medium of this relative index.
///
/// The checks are those of [`brdf`](brdf()), where reciprocity includes the squares of the indices.
///
/// ```text
/// η_o² f(ωi, ωo) = η_i² f(ωo, ωi)
/// ```
///
/// ```
/// use asperity_shading::check::{self, Settings};
/// use asperity_shading::reflectance::RoughDielectric;
/// use asperity_shading::{Dielectric, Ggx};
///
/// let frosted = RoughDielectric::new(Ggx::isotropic(0.4)?, Dielectric::new(1.5)?);
/// let settings = Settings { samples: 10_000, ..Settings::default() };
/// assert!(check::dielectric(&frosted, 1.5, settings).passed());
/// assert!(check::dielectric(&frosted, 1.33, settings).failures().eq(["reciprocity"]));
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
///
/// Veach 1997, eq. 5.14, where radiance is divided by η², as in
/// [`RoughDielectric`](crate::reflectance::RoughDielectric).
#[must_use]
pub fn dielectric(brdf: &dyn Brdf, relative_index: f32, settings: Settings) -> Report {
    let mut report = Report::default();
    add_reciprocity(&mut report, brdf, relative_index, settings);
    let mut scattering = Scattering::new(settings);
    (0..VIEWS).for_each(|k| scattering.see(brdf, k, Vec3::ZERO));
    scattering.add(&mut report);
    add_totality(&mut report, brdf);
    report
}

/// Adds `η_o² f(ωi, ωo) = η_i² f(ωo, ωi)`.
fn add_reciprocity(report: &mut Report, brdf: &dyn Brdf, index: f32, settings: Settings) {
    let mut worst = Worst::default();
    let squared = |w: Vec3| if w.z < 0.0 { index * index } else { 1.0 };
    let direction = |u: Vec2| towards(if brdf.transmits() { 2.0 * u.x - 1.0 } else { 1.0 - u.x }, u.y);
    for (k, (a, b)) in settings.points(0).zip(settings.points(1)).take(PAIRS).enumerate() {
        let wo = direction(a);
        let sampled = if k % 2 == 0 { None } else { brdf.sample(wo, a.y, b) };
        let wi = sampled.map_or_else(|| direction(b), |sample| sample.wi);
        let (there, back) = (brdf.eval(wo, wi) * squared(wo), brdf.eval(wi, wo) * squared(wi));
        // Values without weight in the albedo are ignored.
        let most = there.max(back).max_element().max(1e-4);
        worst.note(f64::from((there - back).abs().max_element() / most), || format!("at {wi} and {wo}"));
    }
    let limit = Limit::AtMost(RECIPROCITY);
    report.add("reciprocity", "|f(ωi, ωo) − f(ωo, ωi)|/f", worst.value, limit, worst.place);
}
