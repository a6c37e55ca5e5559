//! Checks of an NDF with Smith masking and visible normals.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use glam::{Vec2, Vec3};

use crate::check::ndf::{Broken, Density, INTEGRAL, ODD, Worst, is_facet, shared};
use crate::microfacet::Microfacet;
use asperity_core::check::Settings;
use asperity_core::check::{Limit, Report};
use asperity_core::math;

/// Views in four quarters, from the zenith to near the horizon.
const VIEWS: [Vec3; 5] = [
    Vec3::Z,
    Vec3::new(0.36, 0.48, 0.8),
    Vec3::new(-0.768, 0.576, 0.28),
    Vec3::new(0.591, -0.803_8, 0.067_6),
    Vec3::new(-0.8, -0.6, 1e-3),
];

/// Tilts at which masking must decrease, and azimuths.
const TILTS: u16 = 64;
const AZIMUTHS: u16 = 5;

/// Checks projected areas, masking and visible normals, and everything of
/// [`ndf`](crate::check::ndf()).
///
/// ```text
/// σ(v) = ∫ D max(0, v·m) dω,      ∫ G₁ D max(0, v·m) dω = cos θ_v,      ∫ D_v dω = 1
/// ```
///
/// - The three integrals hold within 1e-3 relative from five views, from the zenith to near the
///   horizon. The second is at most `cos θ_v`. It is at least `cos θ_v` where `∫ D max(0, v·m) dω ≥
///   cos θ_v`, as for every NDF whose mean normal is the macro normal.
/// - `sample_visible` draws from `D_v`, by χ² from each view at a seventh of the significance of
///   the settings. Both χ² tests of [`ndf`](crate::check::ndf()) use the same significance here.
/// - `G₁` is in [0, 1] and does not increase towards the horizon.
/// - Invalid input produces unit normals above the horizon and numbers in their ranges.
///
/// ```
/// use asperity_ndf_sampling::{Beckmann, check};
///
/// let report = check::microfacet(&Beckmann::new(0.2, 0.4)?, check::Settings::default());
/// assert!(report.passed() && report.checks.len() == 13, "{report}");
/// # Ok::<(), asperity_ndf_sampling::NdfError>(())
/// ```
///
/// The integrals over masking and visible normals are eq. 43 and 83 of Heitz 2014.
#[must_use]
pub fn microfacet<N: Microfacet + ?Sized>(density: &N, settings: Settings) -> Report {
    let significance = settings.significance / (VIEWS.len() + 2) as f64;
    let mut report = shared(density, settings, significance);
    let [mut area, mut masking, mut norm] = [(); 3].map(|()| Worst::default());
    let mut least = (1.0_f64, String::new());
    for (v, stream) in VIEWS.map(Vec3::normalize).into_iter().zip(8..) {
        let place = || format!("seen from {v}");
        let samples = Density::new(settings, 2 * stream, |u: Vec2| density.sample_visible(v, u));
        let integrals = samples.cells.integrate_all(|m| {
            let flip_to_visible = f64::from(density.d(m)) * f64::from(v.dot(m).max(0.0));
            [flip_to_visible, f64::from(density.visible_pdf(v, m))]
        });
        let flip_to_visible: f64 = integrals.iter().map(|[flip_to_visible, _]| flip_to_visible).sum();
        let masses: Vec<f64> = integrals.iter().map(|[_, visible]| *visible).collect();
        let (sigma, up) = (f64::from(density.projected_area(v)), f64::from(v.z));
        area.note((sigma / flip_to_visible - 1.0).abs(), place);
        let seen = f64::from(density.g1(v)) * flip_to_visible / up - 1.0;
        masking
            .note(if flip_to_visible >= up * (1.0 - INTEGRAL) { seen.abs() } else { seen.max(0.0) }, place);
        norm.note((masses.iter().sum::<f64>() - 1.0).abs(), place);
        let p = samples.p_value(&masses, 2 * stream + 1, |u| density.sample_visible(v, u));
        if p < least.0 || p.is_nan() {
            least = (p, place());
        }
    }
    let limit = Limit::AtMost(INTEGRAL);
    report.add("projected area", "|σ(v)/∫ D max(0, v·m) dω − 1|", area.error, limit, area.place);
    report.add("masking", "|∫ G₁ D max(0, v·m) dω/cos θ − 1|", masking.error, limit, masking.place);
    report.add("density of visible normals", "|∫ D_v dω − 1|", norm.error, limit, norm.place);
    report.add("visible normals", "p of χ²", least.0, Limit::AtLeast(significance), least.1);
    add_monotonicity(&mut report, density);
    add_totality(&mut report, density);
    report
}

/// Adds the check that `0 ≤ G₁ ≤ 1` and that `G₁` decreases towards the horizon.
fn add_monotonicity<N: Microfacet + ?Sized>(report: &mut Report, density: &N) {
    let mut worst = Worst::default();
    for azimuth in 0..AZIMUTHS {
        let phi = core::f64::consts::TAU * f64::from(azimuth) / f64::from(AZIMUTHS);
        let mut before = 1.0;
        for tilt in 0..TILTS {
            let theta = core::f64::consts::FRAC_PI_2 * f64::from(tilt) / f64::from(TILTS);
            let sin = math::sin_f64(theta);
            let v = Vec3::new(
                (sin * math::cos_f64(phi)) as f32,
                (sin * math::sin_f64(phi)) as f32,
                math::cos_f64(theta) as f32,
            );
            let g1 = f64::from(density.g1(v));
            worst.note(if g1 < 0.0 { -g1 } else { g1 - before }, || format!("seen from {v}"));
            before = g1;
        }
    }
    let limit = Limit::AtMost(1e-5);
    report.add(
        "monotonicity of masking",
        "growth of G₁ towards the horizon",
        worst.error,
        limit,
        worst.place,
    );
}

/// Adds the check that methods with a view accept every input.
fn add_totality<N: Microfacet + ?Sized>(report: &mut Report, density: &N) {
    let mut broken = Broken::default();
    for (u, v) in ODD.into_iter().flat_map(|x| ODD.map(|y| (Vec2::new(x, y), Vec3::new(x, 0.3, y)))) {
        let m = density.sample_visible(v, u);
        broken.unless(is_facet(m), || format!("sample_visible({v}, {u}) = {m}"));
        let (lambda, sigma, visible) =
            (density.lambda(v), density.projected_area(v), density.visible_pdf(v, v));
        broken.unless(lambda >= 0.0 && (v.z > 0.0 || lambda == f32::INFINITY), || {
            format!("lambda({v}) = {lambda}")
        });
        broken.unless(sigma >= 0.0, || format!("projected_area({v}) = {sigma}"));
        broken
            .unless((0.0..=f32::MAX).contains(&visible), || format!("visible_density({v}, {v}) = {visible}"));
    }
    broken.add(report, "totality of views");
}
