//! Microfacet models of which a pixel resolves a part: mean, energy and samples.

use asperity_shading::check;
use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::level_of_detail::{GaussianField, ResolvedBumps};
use asperity_shading::ndf_sampling::{Blend, Isotropic, Masked, Measure, NdfMap, Reconstruction, StudentT};
use asperity_shading::noise::{FbmSpectrum, GaussianFbm, GaussianNoise};
use asperity_shading::reflectance::{
    BumpFacets, EnergyCompensated, FacetBrdf, Lobe, RoughDielectric, SchlickF82,
};
use asperity_shading::{Beckmann, Brdf, Conductor, CookTorrance, Dielectric, Ggx};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::random::Random;
use asperity_tests::surface_patches::{FRAME, points};
use rayon::prelude::*;

use crate::checked::quick;
use crate::reflectance::direction;

const VALID: &str = "in range";

type Facets = Box<dyn FacetBrdf + Sync>;

fn gold() -> [Conductor; 3] {
    [(0.18, 3.42), (0.42, 2.35), (1.37, 1.77)].map(|(eta, k)| Conductor::new(eta, k).expect(VALID))
}

/// Single scattering: conductors, dielectrics, and a pane.
fn models() -> Vec<(&'static str, Facets)> {
    let ggx = |alpha_x, alpha_y| Ggx::new(alpha_x, alpha_y).expect(VALID);
    let tint = [0.9, 0.5, 0.3].map(|f0| SchlickF82::new(f0, 0.4).expect(VALID));
    let glass = Dielectric::new(1.5).expect(VALID);
    vec![
        ("gold", Box::new(CookTorrance::new(ggx(0.5, 0.2), gold()))),
        ("F82", Box::new(CookTorrance::new(ggx(0.3, 0.3), tint))),
        ("Beckmann", Box::new(CookTorrance::new(Beckmann::new(0.2, 0.5).expect(VALID), gold()))),
        ("Student", Box::new(CookTorrance::new(StudentT::new(0.3, 0.3, 3.0).expect(VALID), glass))),
        ("glass", Box::new(RoughDielectric::new(ggx(0.4, 0.2), glass))),
        ("bubble", Box::new(RoughDielectric::new(ggx(0.3, 0.3), glass.reversed()))),
        ("pane", Box::new(RoughDielectric::thin(ggx(0.3, 0.5), glass, Vec3::new(0.9, 0.8, 0.7)))),
    ]
}

/// The same with further bounces.
fn compensated() -> Vec<(&'static str, Facets)> {
    let ggx = |alpha| Ggx::isotropic(alpha).expect(VALID);
    let glass = Dielectric::new(1.5).expect(VALID);
    vec![
        ("gold, bounces", Box::new(EnergyCompensated::metal(ggx(0.7), gold()))),
        ("glass, bounces", Box::new(EnergyCompensated::glass(ggx(0.6), glass))),
    ]
}

fn all_models() -> Vec<(&'static str, Facets)> {
    let mut all = models();
    all.extend(compensated());
    all
}

/// A painting, a mixture and a measured profile, as metal and as glass.
fn tabulated() -> Vec<(&'static str, Facets)> {
    let lobe = |n: Vec3, x: f32| (-20.0 * ((n.x - x).powi(2) + (n.y - 0.1).powi(2))).exp();
    let (narrow, wide) = (Ggx::new(0.5, 0.2).expect(VALID), Beckmann::new(0.1, 0.6).expect(VALID));
    let blend = Blend::new(narrow, wide, 0.4).expect(VALID);
    let map = |density: &dyn Fn(Vec3) -> f32| {
        let (measure, between) = (Measure::ProjectedSolidAngle, Reconstruction::Bilinear);
        Masked::new(NdfMap::from_fn(64, 64, measure, between, density).expect(VALID))
    };
    let painting = map(&|n| lobe(n, -0.4) + 0.6 * lobe(n, 0.3));
    let profile = |cos: f32| (12.0 * (cos - 1.0)).exp() + 0.3 * (-200.0 * (cos - 0.8).powi(2)).exp();
    let measured = Masked::new(Isotropic::from_fn(256, profile).expect(VALID));
    let glass = Dielectric::new(1.5).expect(VALID);
    vec![
        ("painting, glass", Box::new(RoughDielectric::new(painting.clone(), glass))),
        ("painting", Box::new(CookTorrance::new(painting, gold()))),
        ("mixture", Box::new(CookTorrance::new(map(&|m| blend.d(m)), gold()))),
        ("measured, glass", Box::new(RoughDielectric::new(measured.clone(), glass))),
        ("measured", Box::new(CookTorrance::new(measured, gold()))),
    ]
}

fn resolved(z: [f64; 2], variance: f32) -> ResolvedBumps {
    ResolvedBumps { z: Vec2::from(z.map(|z| z as f32)), variance, blend: 1.0 }
}

/// The mean over Gaussian bumps at one pair of directions, by the trapezoid rule on ±6.
pub(crate) fn mean(brdf: &dyn FacetBrdf, wo: Vec3, wi: Vec3, variance: f32) -> f64 {
    const SIDE: i16 = 72;
    let step = 6.0 / f64::from(SIDE);
    let mut sum = 0.0;
    for (i, j) in (-SIDE..=SIDE).flat_map(|i| (-SIDE..=SIDE).map(move |j| (i, j))) {
        let z = [f64::from(i) * step, f64::from(j) * step];
        let weight = (-0.5 * (z[0] * z[0] + z[1] * z[1])).exp() / core::f64::consts::TAU;
        sum += weight * f64::from(brdf.eval_resolved(wo, wi, resolved(z, variance)).x);
    }
    sum * step * step
}

#[test]
fn mean_over_bumps_is_the_far_field() {
    let mut random = Random(11);
    for (name, brdf) in all_models().into_iter().chain(tabulated()) {
        let views = if brdf.transmits() { &[0.0, 1.047, 1.396, 2.2][..] } else { &[0.0, 1.047, 1.396] };
        for (k, &theta) in views.iter().enumerate() {
            let wo = direction(theta, 0.4 + k as f64);
            for variance in [0.3, 0.75, 0.9] {
                let mut u = || random.uniform() as f32;
                // Directions where the BRDF is bright.
                let Some(sample) = brdf.sample(wo, u(), Vec2::new(u(), u())) else { continue };
                let far = f64::from(brdf.eval(wo, sample.wi).x);
                let ratio = mean(&*brdf, wo, sample.wi, variance) / far;
                assert_abs_diff_eq!(ratio, 1.0, epsilon = 2e-4, "{name}, {wo}, {}, {variance}", sample.wi);
            }
        }
    }
}

#[test]
fn facets_by_area_have_the_same_mean_and_are_reciprocal() {
    let brdf = CookTorrance::new(Ggx::new(0.5, 0.2).expect(VALID), gold()).with_bump_facets(BumpFacets::All);
    for (theta, variance) in [(0.0, 0.3), (1.047, 0.75), (1.396, 0.9)] {
        let (wo, wi) = (direction(theta, 0.4), direction(0.5, -2.3));
        let far = f64::from(brdf.eval(wo, wi).x);
        assert_abs_diff_eq!(mean(&brdf, wo, wi, variance) / far, 1.0, epsilon = 2e-4, "{theta}");
        let bumps = resolved([0.7, -0.4], variance);
        let report = check::brdf(&Lobe::bumps(&brdf, bumps), quick(3));
        // Single points may reflect more than they receive.
        assert!(report.failures().all(|failure| failure == "energy"), "{report}");
    }
}

#[test]
fn single_points_are_bright_by_area_only() {
    const POINTS: usize = 8000;
    let mut random = Random(6);
    let wo = direction(1.396, 0.4);
    let mut brightest = |facets| {
        let white = CookTorrance::new(Ggx::isotropic(0.5).expect(VALID), Vec3::ONE).with_bump_facets(facets);
        let mut albedos: Vec<f32> = (0..POINTS)
            .map(|_| {
                let bumps = resolved(random.gaussians(), 0.8);
                let samples = (0..200).filter_map(|_| {
                    let u = Vec2::new(random.uniform() as f32, random.uniform() as f32);
                    white.sample_resolved(wo, 0.5, u, bumps)
                });
                samples.map(|sample| sample.weight().x).sum::<f32>() / 200.0
            })
            .collect();
        albedos.sort_by(f32::total_cmp);
        [albedos[POINTS - 1], albedos[POINTS - POINTS / 1000]]
    };
    let ([seen, _], [most, of_a_thousand]) = (brightest(BumpFacets::Visible), brightest(BumpFacets::All));
    println!("brightest point: {seen} by visible facets, {most} by area, {of_a_thousand} of a thousand");
    assert!(seen <= 1.0001 && of_a_thousand > 6.0, "{seen} {most} {of_a_thousand}");
}

#[test]
#[ignore = "slow: weekly"]
fn resolved_facets_pass_the_public_checks() {
    let bumps = [([0.7, -0.4], 0.3), ([-1.2, 0.9], 0.75), ([0.2, 0.1], 0.94)];
    let cases: Vec<_> = all_models().into_iter().flat_map(|m| bumps.map(|b| (m.0, b))).collect();
    cases.into_par_iter().for_each(|(name, (z, variance))| {
        let all = all_models();
        let brdf = &*all.iter().find(|model| model.0 == name).expect("one of them").1;
        let report = check::brdf(&Lobe::bumps(brdf, resolved(z, variance)), quick(5));
        // The factor for further bounces is that of the mean over the surface.
        let bounces = name.contains("bounces");
        let mut failures = report.failures();
        assert_eq!(failures.next(), Some("reciprocity"), "{name}, {z:?}, {variance}\n{report}");
        assert!(failures.all(|failure| bounces && failure == "energy"), "{name}, {z:?}\n{report}");
    });
}

#[test]
fn no_sample_is_brighter_than_the_light() {
    let mut random = Random(4);
    for (name, brdf) in models() {
        for _ in 0..20_000 {
            let mut u = || random.uniform() as f32;
            let up = 2.0 * u() - if brdf.transmits() { 1.0 } else { 0.0 };
            let wo = direction(f64::from(up.min(1.0)).acos(), f64::from(7.0 * u()));
            let (uc, point, variance) = (u(), Vec2::new(u(), u()), u());
            let bumps = resolved(random.gaussians(), variance);
            let Some(sample) = brdf.sample_resolved(wo, uc, point, bumps) else { continue };
            // The rounding of half vectors is magnified in narrow lobes.
            assert!(sample.weight().max_element() < 1.001, "{name}, {wo}, {bumps:?}: {sample:?}");
        }
    }
}

/// Tables map visible normals approximately, see `Masked`.
#[test]
fn samples_of_tables_have_bounded_weights() {
    let mut random = Random(9);
    for (name, brdf) in tabulated() {
        for _ in 0..5000 {
            let mut u = || random.uniform() as f32;
            let wo = direction(f64::from(u()).acos(), f64::from(7.0 * u()));
            let (uc, point, variance) = (u(), Vec2::new(u(), u()), u());
            let bumps = resolved(random.gaussians(), variance);
            let Some(sample) = brdf.sample_resolved(wo, uc, point, bumps) else { continue };
            assert!(sample.weight().max_element() < 4.0, "{name}, {wo}, {bumps:?}: {sample:?}");
        }
    }
}

#[test]
fn unresolved_facets_are_the_far_field() {
    let (wo, u) = (direction(1.0, 0.3), Vec2::new(0.3, 0.6));
    for (_, brdf) in models() {
        let sample = brdf.sample(wo, 0.02, u).expect("above the horizon");
        assert_eq!(brdf.sample_resolved(wo, 0.02, u, ResolvedBumps::FAR), Some(sample));
        assert_eq!(brdf.pdf_resolved(wo, sample.wi, ResolvedBumps::FAR), sample.pdf);
        assert_eq!(brdf.eval_resolved(wo, sample.wi, ResolvedBumps::FAR), brdf.eval(wo, sample.wi));
    }
}

#[test]
fn any_bumps_and_directions_are_accepted() {
    let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0, -1.0, 1e30];
    for (name, brdf) in all_models().into_iter().chain(tabulated()) {
        for (a, b) in bad.into_iter().flat_map(|a| bad.map(|b| (a, b))) {
            let bumps = ResolvedBumps { z: Vec2::new(a, b), variance: b, blend: a };
            for (w, wi) in [
                (Vec3::new(a, b, 1.0), direction(0.7, 2.0)),
                (Vec3::new(0.6, a, b), direction(0.7, 2.0)),
                (direction(0.4, 0.2), direction(0.7, 2.0)),
                (Vec3::new(1.0, 0.0, 1e-25), Vec3::new(0.0, 1.0, 1e-25)),
                (Vec3::new(1.0, 0.0, 1e-20), Vec3::new(0.0, 1.0, 1e-30)),
            ] {
                let value = brdf.eval_resolved(w, wi, bumps);
                assert!(value.is_finite() && value.min_element() >= 0.0, "{name} {w} {bumps:?}");
                assert!(value == Vec3::ZERO || brdf.eval(w, wi) != Vec3::ZERO, "{name} {w} {wi} {bumps:?}");
                assert!(brdf.pdf_resolved(w, wi, bumps).is_finite(), "{name} {w} {bumps:?}");
                if let Some(sample) = brdf.sample_resolved(w, 0.5, Vec2::new(a, b), bumps) {
                    assert!(sample.wi.is_finite() && sample.weight().is_finite(), "{name} {w} {bumps:?}");
                }
            }
        }
    }
}

/// Points per patch, all of which are independent of each other and of other patches.
const POINTS: usize = 128 * 128;

/// Where light goes: within 20° of the mirrored direction, farther, and through the surface.
fn bin(wo: Vec3, wi: Vec3) -> usize {
    let mirrored = Vec3::new(-wo.x, -wo.y, wo.z);
    match (wi.z * wo.z < 0.0, wi.dot(mirrored) > 0.94) {
        (true, _) => 2,
        (false, near) => usize::from(!near),
    }
}

/// The light of one sample of each model and view, by the bin of its direction.
fn scattered(
    cases: &[(String, Facets, Vec3)],
    bumps: ResolvedBumps,
    random: &mut Random,
    sums: &mut [[f64; 3]],
) {
    let [uc, x, y] = [(); 3].map(|()| random.uniform() as f32);
    for ((_, brdf, wo), sums) in cases.iter().zip(sums) {
        if let Some(sample) = brdf.sample_resolved(*wo, uc, Vec2::new(x, y), bumps) {
            sums[bin(*wo, sample.wi)] += f64::from(sample.weight().x);
        }
    }
}

/// The mean over a surface in the real noise, from 0.5 to 12 resolved octaves.
///
/// Where all octaves are resolved, each point is a mirror, and the noise alone distributes the
/// light.
#[test]
#[ignore = "slow: weekly"]
fn mean_over_the_surface_is_the_far_field_over_twelve_octaves() {
    for (place, ratio, error) in surface_ratios() {
        let place = format!("{place}: {ratio:.5} ± {error:.5}");
        println!("{place}");
        assert!(error < 4e-3, "{place} shows nothing");
        assert!((ratio - 1.0).abs() < 4.5 * error, "{place}");
    }
}

/// The light in each bin over that of the far field, for each model, view and zoom, with its
/// standard error. Bins with less than 3 % of the light, whose mean is not precise, are left out.
fn surface_ratios() -> Vec<(String, f64, f64)> {
    const SEEDS: u32 = 256;
    let views = [("0°", 0.0), ("60°", 1.047), ("80°", 1.396)];
    let cases: Vec<_> = views
        .into_iter()
        .flat_map(|(degrees, theta)| {
            let wo = direction(theta, 0.4);
            all_models().into_iter().map(move |(name, brdf)| (format!("{name}, {degrees}"), brdf, wo))
        })
        .collect();
    // Independent of bumps: as many samples as in all patches.
    let far: Vec<Vec<[f64; 3]>> = (0..SEEDS)
        .into_par_iter()
        .map(|seed| {
            let mut sums = vec![[0.0; 3]; cases.len()];
            let mut random = Random(u64::from(seed) << 32);
            (0..4 * POINTS).for_each(|_| scattered(&cases, ResolvedBumps::FAR, &mut random, &mut sums));
            sums
        })
        .collect();
    let (far, far_error) = means(&far, 4 * POINTS);
    let mut ratios = Vec::new();
    for octaves in [0.5, 1.0, 2.5, 4.0, 6.0, 8.0, 10.0, 12.0] {
        let patches: Vec<Vec<[f64; 3]>> = (0..SEEDS)
            .into_par_iter()
            .map(|seed| {
                let spectrum = FbmSpectrum::new(2.17, 0.5, 12).expect(VALID);
                let field = GaussianFbm::<Vec3>::new(GaussianNoise::new(seed), spectrum);
                let mut random = Random(u64::from(seed));
                let mut sums = vec![[0.0; 3]; cases.len()];
                for p in points(1) {
                    let bumps = field.coordinates(p, &FRAME, octaves);
                    scattered(&cases, bumps, &mut random, &mut sums);
                }
                sums
            })
            .collect();
        let (near, near_error) = means(&patches, POINTS);
        for (case, (name, ..)) in cases.iter().enumerate() {
            for k in (0..3).filter(|&k| far[case][k] > 0.03) {
                let ratio = near[case][k] / far[case][k];
                let error = near_error[case][k].hypot(far_error[case][k]) / far[case][k];
                ratios.push((format!("{name}, {octaves} octaves, bin {k}"), ratio, error));
            }
        }
    }
    ratios
}

/// Means of each case and bin over patches, and their standard errors.
fn means(patches: &[Vec<[f64; 3]>], count: usize) -> (Vec<[f64; 3]>, Vec<[f64; 3]>) {
    let n = patches.len() as f64;
    let at = |case: usize, k: usize| {
        let values = || patches.iter().map(|patch| patch[case][k] / count as f64);
        let mean = values().sum::<f64>() / n;
        let variance = values().map(|value| (value - mean).powi(2)).sum::<f64>() / (n - 1.0);
        (mean, (variance / n).sqrt())
    };
    let all = |pick: fn((f64, f64)) -> f64| {
        (0..patches[0].len()).map(|case| [0, 1, 2].map(|k| pick(at(case, k)))).collect()
    };
    (all(|pair| pair.0), all(|pair| pair.1))
}
