//! Checks of materials at a point.

use asperity_ndf_sampling::Frame;
use asperity_ndf_sampling::check::{Report, Settings};
use glam::{Vec2, Vec3};

use crate::check::scattering::{Scattering, VIEWS, add_totality, view};
use crate::material::{Material, SurfacePoint};
use crate::reflectance::{Brdf, Bsdf, BsdfSample};

/// Points of the unit square along each side, over which specular samples are averaged.
const SIDE: u8 = 16;

/// Checks a [`Material`] at a point: energy, density, samples, weights, sign and invalid input.
///
/// Each BSDF is checked for its own view.
///
/// The checks are those of [`brdf`](crate::check::brdf). The energy includes specular samples of
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
/// # Ok::<(), asperity_shading::ShadingError>(())
/// ```
#[must_use]
pub fn material(material: &dyn Material, point: &SurfacePoint, settings: Settings) -> Report {
    let mut report = Report::default();
    let (mut scattering, frame) = (Scattering::new(settings), point.frame());
    for k in 0..VIEWS {
        let wo = frame.to_world(view(k));
        let bsdf = Local { bsdf: material.bsdf(point, wo), frame };
        let cells = (0..SIDE).flat_map(|i| (0..SIDE).map(move |j| Vec2::new(f32::from(i), f32::from(j))));
        let samples = cells.flat_map(|cell| bsdf.bsdf.specular_samples(wo, (cell + 0.5) / f32::from(SIDE)));
        let specular: Vec3 = samples.flatten().map(|sample| sample.eval_cos).sum();
        scattering.see(&bsdf, k, specular / f32::from(u16::from(SIDE).pow(2)));
    }
    scattering.add(&mut report);
    add_totality(&mut report, &Local { bsdf: material.bsdf(point, frame.to_world(view(0))), frame });
    report
}

/// A BSDF in the frame of its surface.
struct Local<'a> {
    bsdf: Bsdf<'a>,
    frame: Frame,
}

impl Brdf for Local<'_> {
    fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        self.bsdf.eval(self.frame.to_world(wo), self.frame.to_world(wi))
    }

    fn sample(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BsdfSample> {
        let sample = self.bsdf.sample(self.frame.to_world(wo), uc, u)?;
        Some(BsdfSample { wi: self.frame.to_local(sample.wi), ..sample })
    }

    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.bsdf.pdf(self.frame.to_world(wo), self.frame.to_world(wi))
    }

    fn transmits(&self) -> bool {
        self.bsdf.transmits()
    }
}
