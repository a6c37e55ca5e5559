//! BRDFs evaluated from a few views and with invalid input.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::cell::Cell;

use asperity_ndf_sampling::check::{Cells, Limit, Report, Settings, p_value};
use glam::{Vec2, Vec3};

use crate::math::{cos, sin, sqrt};
use crate::reflectance::{Brdf, BsdfSample};

/// The accepted excess of an integral over 1, the error of quadrature over cells.
const INTEGRAL: f64 = 2e-3;

/// The largest accepted amount of light from directions without density.
const BARE: f64 = 1e-3;

/// The accepted relative difference between a sample and `eval` and `pdf`, rounding of directions.
const MISMATCH: f64 = 1e-3;

/// Samples from which cells are made, 64 for each.
const PILOT: usize = 1 << 14;

/// Views: equally many from above and from below, where the latter are used if the BSDF transmits.
pub(super) const VIEWS: u8 = 8;

/// The direction of a view: even ones from above.
pub(super) fn view(k: u8) -> Vec3 {
    let up = [0.99, 0.8, 0.45, 0.12][usize::from(k / 2 % 4)];
    towards(if k.is_multiple_of(2) { up } else { -up }, 0.1 + 0.37 * f32::from(k))
}

/// The direction with this height and azimuth in turns.
pub(super) fn towards(z: f32, turns: f32) -> Vec3 {
    let (across, phi) = (sqrt((1.0 - z * z).max(0.0)), core::f32::consts::TAU * turns);
    Vec3::new(across * cos(phi), across * sin(phi), z)
}

/// The largest of some values and where it occurs; NaN is larger than any number.
#[derive(Default)]
pub(super) struct Worst {
    pub(super) value: f64,
    pub(super) place: String,
}

impl Worst {
    pub(super) fn note(&mut self, value: f64, place: impl FnOnce() -> String) {
        if value > self.value || value.is_nan() && !self.value.is_nan() {
            *self = Self { value, place: place() };
        }
    }

    fn add(self, report: &mut Report, name: &'static str, quantity: &'static str, most: f64) {
        report.add(name, quantity, self.value, Limit::AtMost(most), self.place);
    }
}

/// Integrals over incoming light and χ² of samples, the worst of all views.
pub(super) struct Scattering {
    settings: Settings,
    energy: Worst,
    density: Worst,
    bare: Worst,
    negative: Worst,
    mismatch: Worst,
    p_values: Vec<(f64, Vec3)>,
}

impl Scattering {
    pub(super) fn new(settings: Settings) -> Self {
        let [energy, density, bare, negative, mismatch] = [(); 5].map(|()| Worst::default());
        Self { settings, energy, density, bare, negative, mismatch, p_values: Vec::new() }
    }

    /// Evaluates a BRDF from a view, given the additional light of specular samples.
    pub(super) fn see(&mut self, brdf: &dyn Brdf, k: u8, smooth: Vec3) {
        let (wo, through) = (view(k), brdf.transmits());
        if wo.z < 0.0 && !through {
            return;
        }
        let place = || format!("from {wo}");
        let samples = |stream: u8, count: usize| {
            let points =
                self.settings.points(2 + 2 * k + stream).zip(self.settings.points(18 + 2 * k + stream));
            let all = points.take(count).filter_map(|(u, v)| brdf.sample(wo, v.x, u));
            all.filter(|sample| !sample.is_specular())
        };
        for BsdfSample { wi, eval_cos, pdf, .. } in samples(0, PILOT) {
            let (value, density) = (brdf.eval(wo, wi) * wi.z.abs(), brdf.pdf(wo, wi));
            let apart = (value - eval_cos).abs().max_element() / value.max_element().max(1.0);
            let apart = apart.max((pdf - density).abs() / density.max(1.0));
            self.mismatch.note(f64::from(apart), place);
        }
        let samples = |stream, count| samples(stream, count).map(|sample| sample.wi);
        let pilot = samples(0, PILOT);
        let cells = if through { Cells::of_sphere(pilot) } else { Cells::of_hemisphere(pilot) };
        let negative = Cell::new(0.0);
        let integrals = cells.integrate_all(|wi| {
            let (value, density) = (brdf.eval(wo, wi), brdf.pdf(wo, wi));
            if value.min_element().min(density) < 0.0 {
                negative.set(negative.get() + 1.0);
            }
            let [r, g, b] = (value * wi.z.abs()).to_array().map(f64::from);
            [f64::from(density), r, g, b, if density > 0.0 { 0.0 } else { r.max(g).max(b) }]
        });
        let sum = |k: usize| integrals.iter().map(|cell| cell[k]).sum::<f64>();
        self.negative.note(negative.get(), place);
        self.density.note(sum(0), place);
        for (channel, smooth) in (1..4).zip(smooth.to_array()) {
            self.energy.note(sum(channel) + f64::from(smooth), place);
        }
        self.bare.note(sum(4), place);
        // Without lobes there is nothing to sample.
        if sum(0) > 0.0 {
            let count = (self.settings.samples as usize).max(4096);
            let masses: Vec<f64> = integrals.iter().map(|cell| cell[0]).collect();
            self.p_values.push((p_value(&cells.count(samples(1, count)), &masses, count as u64), wo));
        }
    }

    /// Adds the worst of all views.
    pub(super) fn add(self, report: &mut Report) {
        self.energy.add(report, "energy", "∫ f |cos θ| dω", 1.0 + INTEGRAL);
        self.density.add(report, "density", "∫ density dω", 1.0 + INTEGRAL);
        let tests = self.p_values.len().max(1) as f64;
        let least = self.p_values.into_iter().min_by(|a, b| {
            // NaN, an unknown value, is less than any number.
            let key = |p: f64| if p.is_nan() { -1.0 } else { p };
            key(a.0).total_cmp(&key(b.0))
        });
        let (p, place) = least.map_or((1.0, String::new()), |(p, wo)| (p, format!("from {wo}")));
        report.add("samples", "p of χ²", p, Limit::AtLeast(self.settings.significance / tests), place);
        self.bare.add(report, "weights", "∫ f |cos θ| dω without density", BARE);
        self.negative.add(report, "sign", "values below 0", 0.0);
        self.mismatch.add(report, "consistency", "difference of samples from eval and pdf", MISMATCH);
    }
}

/// Inputs that evaluation must accept.
const ODD: [f32; 10] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0, -0.0, 1e-40, 1e38, -1e38, -1.0, 0.5];

/// Adds the check that every method accepts every input.
pub(super) fn add_totality(report: &mut Report, brdf: &dyn Brdf) {
    let (mut count, mut first) = (0_u32, String::new());
    let mut unless = |kept: bool, case: &dyn Fn() -> String| {
        if !kept {
            count += 1;
            if count == 1 {
                first = case();
            }
        }
    };
    let low = [1e-7_f32, 1e-30, -1e-7].map(|z| Vec3::new(1.0, 0.0, z));
    let good = Vec3::new(0.0, 0.6, 0.8);
    for w in ODD.into_iter().flat_map(|x| ODD.map(|z| Vec3::new(x, 0.3, z))).chain(low) {
        for (wi, wo) in [(w, good), (good, w), (w, w), (w, -good), (-good, w)] {
            let (value, density) = (brdf.eval(wo, wi), brdf.pdf(wo, wi));
            let kept = value.to_array().into_iter().chain([density]).all(|x| (0.0..=f32::MAX).contains(&x));
            let dark = brdf.transmits() || wi.z > 0.0 && wo.z > 0.0 || value == Vec3::ZERO && density == 0.0;
            unless(kept && dark, &|| format!("eval({wo}, {wi}) = {value}, pdf {density}"));
        }
        let u = Vec2::new(w.x, w.z);
        let sample = brdf.sample(good, w.y, u);
        let sound = sample.is_none_or(|sample| {
            (sample.wi.length() - 1.0).abs() < 1e-3 && sample.pdf > 0.0 && sample.weight().is_finite()
        });
        unless(sound, &|| format!("sample({good}, {}, {u}) = {sample:?}", w.y));
    }
    report.add("totality", "cases out of range", f64::from(count), Limit::AtMost(0.0), first);
}
