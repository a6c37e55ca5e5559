//! Checks of materials at a point.

use asperity_ndf_sampling::check::{Report, Settings};
use glam::{Vec2, Vec3};

use crate::check::scattering::{Scattering, VIEWS, add_totality, view};
use crate::material::{Material, SurfacePoint};

/// Points of the unit square along each side, over which delta lobes are averaged.
const SIDE: u8 = 16;

/// Checks a [`Material`] at a point: energy, density, samples, weights, sign and invalid input.
///
/// Each BSDF is checked for its own view.
///
/// The checks are those of [`brdf`](crate::check::brdf). The energy includes the delta lobes of
/// smooth coats and panes. Reciprocity is not checked, because bump mapping is not reciprocal.
///
/// ```
/// use asperity_shading::check::{self, Settings};
/// use asperity_shading::{Carpet, CarpetParameters, Footprint, SurfacePoint, glam::Vec3};
///
/// let carpet = Carpet::new(CarpetParameters::default())?;
/// let point = SurfacePoint::new(Vec3::new(0.3, 0.2, 0.0), Vec3::Z, Footprint::from_width(4e-3));
/// let report = check::material(&carpet, &point, Settings { samples: 10_000, ..Settings::default() });
/// assert!(report.passed(), "{report}");
/// # Ok::<(), asperity_shading::ParameterError>(())
/// ```
#[must_use]
pub fn material(material: &dyn Material, point: &SurfacePoint, settings: Settings) -> Report {
    let mut report = Report::default();
    let mut scattering = Scattering::new(settings);
    for k in 0..VIEWS {
        let wo = view(k);
        let bsdf = material.bsdf(point, wo);
        let cells = (0..SIDE).flat_map(|i| (0..SIDE).map(move |j| Vec2::new(f32::from(i), f32::from(j))));
        let deltas = cells.flat_map(|cell| bsdf.deltas(wo, (cell + 0.5) / f32::from(SIDE)));
        let smooth: Vec3 = deltas.map(|delta| delta.weight).sum();
        scattering.see(&bsdf, k, smooth / f32::from(u16::from(SIDE).pow(2)));
    }
    scattering.add(&mut report);
    add_totality(&mut report, &material.bsdf(point, view(0)));
    report
}
