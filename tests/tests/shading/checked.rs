//! The public property tests: valid reflectances and materials pass, and each fault is detected by
//! the corresponding checks.

use asperity_shading::check::{self, Settings};
use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::reflectance::BsdfSample;
use asperity_shading::{Brdf, CookTorrance, Ggx, Lambert};
use rayon::prelude::*;

use crate::reflectance::{Case, cases};

const VALID: &str = "in range";

pub(crate) fn quick(seed: u32) -> Settings {
    Settings { seed, samples: 1 << 14, ..Settings::default() }
}

/// A reflectance with one fault.
struct Faulty<'a> {
    of: &'a (dyn Brdf + Sync),
    fault: Fault,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Fault {
    None,
    /// One percent too much light.
    Bright,
    /// One percent more light in one direction than in the reverse direction.
    OneWay,
    /// A density that is 1 % too large.
    Density,
    /// A density that is 1 % too large, but not in samples.
    Stale,
    /// The density of facets instead of directions: without 1/(4 ωo·h).
    Jacobian,
    /// The density of another sampler.
    Other,
    /// No samples where x > 0.2, although the density is positive.
    Hole,
    /// Neither samples nor density where x > 0.2, although there is light.
    Bare,
    /// Negative light near the horizon.
    Negative,
    /// NaN for non-finite input.
    Partial,
}

impl Brdf for Faulty<'_> {
    fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        let value = self.of.eval(wo, wi);
        match self.fault {
            Fault::Bright => 1.01 * value,
            Fault::OneWay if wi.x > wo.x => 0.99 * value,
            Fault::Negative if (0.0..0.1).contains(&wi.z.min(wo.z)) => -value,
            Fault::Partial => value + (wi.x + wi.z) * 0.0,
            _ => value,
        }
    }

    fn sample(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BsdfSample> {
        let wi = self.of.sample(wo, uc, u)?.wi;
        match self.fault {
            Fault::Hole | Fault::Bare if wi.x > 0.2 => None,
            Fault::Stale => BsdfSample::from_direction(self.of, wo, wi),
            _ => BsdfSample::from_direction(self, wo, wi),
        }
    }

    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        let density = self.of.pdf(wo, wi);
        match self.fault {
            Fault::Density | Fault::Stale => 1.01 * density,
            Fault::Jacobian if density > 0.0 => (density * 2.0 * (wi + wo).length()).min(f32::MAX),
            Fault::Other => Lambert::new(Vec3::ONE).expect(VALID).pdf(wo, wi),
            Fault::Bare if wi.x > 0.2 => 0.0,
            _ => density,
        }
    }
}

#[test]
fn faulty_reflectances_are_detected() {
    let gloss = CookTorrance::new(Ggx::new(0.3, 0.4).expect(VALID), Vec3::splat(0.9));
    let chalk = Lambert::new(Vec3::ONE).expect(VALID);
    let cases: [(&(dyn Brdf + Sync), Fault, &[&str]); 13] = [
        (&gloss, Fault::None, &[]),
        (&chalk, Fault::None, &[]),
        (&chalk, Fault::Bright, &["energy"]),
        (&gloss, Fault::OneWay, &["reciprocity"]),
        (&chalk, Fault::OneWay, &["reciprocity"]),
        (&chalk, Fault::Density, &["density", "samples"]),
        (&chalk, Fault::Stale, &["density", "samples", "consistency"]),
        (&gloss, Fault::Jacobian, &["density", "samples"]),
        (&gloss, Fault::Other, &["samples"]),
        (&gloss, Fault::Hole, &["samples"]),
        (&gloss, Fault::Bare, &["weights"]),
        (&chalk, Fault::Negative, &["sign", "totality"]),
        (&gloss, Fault::Partial, &["totality"]),
    ];
    for (of, fault, caught) in cases {
        let report = check::brdf(&Faulty { of, fault }, quick(1));
        assert!(report.failures().eq(caught.iter().copied()), "{fault:?}\n{report}");
    }
}

#[test]
fn valid_reflectances_pass() {
    let failed = cases().into_par_iter().filter_map(|Case { name, brdf, albedo }| {
        let report = check::brdf(&*brdf, quick(3));
        // Some of the older models reflect more than they receive, as documented.
        let right = report.failures().all(|failure| failure == "energy" && albedo > 1.0);
        (!right).then(|| format!("{name}\n{report}"))
    });
    let failed: Vec<String> = failed.collect();
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

#[test]
fn valid_reflectance_passes_for_every_seed() {
    let gloss = CookTorrance::new(Ggx::new(0.3, 0.4).expect(VALID), Vec3::splat(0.9));
    (0..40).into_par_iter().for_each(|seed| {
        let report = check::brdf(&gloss, Settings { samples: 4096, ..quick(seed) });
        assert!(report.passed(), "{seed}\n{report}");
    });
}
