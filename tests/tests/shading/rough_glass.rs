//! Rough glass: public property tests, energy, reciprocity, and reference values of another
//! renderer.

use std::f64::consts::{FRAC_PI_2, TAU};

use asperity_ndf_sampling::check::p_value;
use asperity_shading::bump::{Facet, slope_facets};
use asperity_shading::check;
use asperity_shading::glam::{DVec3, Vec2, Vec3};
use asperity_shading::ndf_sampling::{
    Beckmann, Masked, Measure, Microfacet, NdfMap, Reconstruction, StudentT,
};
use asperity_shading::reflectance::{Bsdf, Coat, EnergyCompensated, Lobe, RoughDielectric};
use asperity_shading::{Brdf, CookTorrance, Dielectric, Ggx, Lambert};
use asperity_shading::{Footprint, Material, Ndf, SurfacePoint};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::low_discrepancy::r2;
use asperity_tests::random::Random;
use asperity_tests::reference::{numbers, read, rows};
use asperity_tests::sphere_bins::SphereBins;
use rayon::prelude::*;

use crate::checked::quick;
use crate::reflectance::direction;

type Facets = dyn Microfacet + Sync;
type Glass<'a> = RoughDielectric<&'a Facets>;

const VALID: &str = "in range";

fn densities() -> [(&'static str, Box<Facets>); 5] {
    [
        ("GGX 0.2, 0.4", Box::new(Ggx::new(0.2, 0.4).expect(VALID))),
        ("GGX 0.7", Box::new(Ggx::isotropic(0.7).expect(VALID))),
        ("Beckmann 0.2, 0.4", Box::new(Beckmann::new(0.2, 0.4).expect(VALID))),
        ("Beckmann 0.7", Box::new(Beckmann::isotropic(0.7).expect(VALID))),
        ("Student", Box::new(StudentT::new(0.4, 0.4, 4.0).expect(VALID))),
    ]
}

/// Surfaces of bodies, of bubbles inside bodies, and thin walls.
fn surfaces(density: &Facets) -> [(&'static str, Glass<'_>); 3] {
    let glass = |index| Dielectric::new(index).expect(VALID);
    [
        ("body", RoughDielectric::new(density, glass(1.5))),
        ("bubble", RoughDielectric::new(density, glass(1.0 / 1.33))),
        ("wall", RoughDielectric::thin(density, glass(1.5), Vec3::ONE)),
    ]
}

/// Views from above or, for angles beyond a right angle, from below.
fn views() -> [Vec3; 4] {
    [direction(0.3, 0.7), direction(1.3, -2.0), direction(2.7, 1.0), direction(2.2, 0.2)]
}

/// Reference values of Mitsuba 3.9.1.
#[test]
fn values_match_mitsuba() {
    let file = read("ndf/rough_glass.json");
    for item in file["items"].as_array().expect("an array") {
        let alpha = numbers(&item["alpha"]).iter().map(|&a| a as f32).collect::<Vec<_>>();
        let ggx = item["distribution"] == "ggx";
        let density: Box<dyn Microfacet> = if ggx {
            Box::new(Ggx::new(alpha[0], alpha[1]).expect(VALID))
        } else {
            Box::new(Beckmann::new(alpha[0], alpha[1]).expect(VALID))
        };
        let index = item["eta"].as_f64().expect("a number") as f32;
        let glass = RoughDielectric::new(density.as_ref(), Dielectric::new(index).expect(VALID));
        let mut worst = 0.0_f64;
        for row in rows(&item["rows"]) {
            let vector = |k: usize| Vec3::new(row[k] as f32, row[k + 1] as f32, row[k + 2] as f32);
            let (wo, wi) = (vector(0), vector(3));
            let error = (f64::from(glass.eval(wo, wi).x) / row[6] - 1.0).abs();
            // Both are in f32. Mitsuba's masking of the Beckmann density has an error of 0.35 % for
            // either direction.
            let tolerance = if ggx { 2e-4 } else { 7e-3 };
            assert!(error < tolerance, "{item:.60} {wi} {wo}: {} for {}", glass.eval(wo, wi).x, row[6]);
            worst = worst.max(error);
        }
        println!("{} {alpha:?} {index}: {worst:.1e}", item["distribution"]);
    }
}

/// Returns the reflectance of a glass facet from inside, in `f64`.
fn inner_reflectance(index: f64, wi: DVec3, wo: DVec3) -> f64 {
    let c = wi.dot((wi + wo).normalize()).abs();
    let left = 1.0 / (index * index) - 1.0 + c * c;
    if left <= 0.0 {
        return 1.0;
    }
    let g = left.sqrt();
    let s = (g - c) / (g + c);
    let p = s * (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
    0.5 * (s * s + p * p)
}

#[test]
fn rough_dielectric_value_next_to_the_critical_angle() {
    let ggx = Ggx::isotropic(0.5).expect(VALID);
    for index in [1.05_f32, 1.5] {
        let glass = RoughDielectric::new(ggx, Dielectric::new(index).expect(VALID));
        let mut random = Random(4);
        let [mut near, mut elsewhere] = [0.0_f64; 2];
        let critical = (1.0 - 1.0 / f64::from(index).powi(2)).sqrt();
        for k in 0..200_000 {
            // Reflected by a facet at any angle from near the critical angle on.
            let h = ggx.sample(Vec2::new(random.uniform() as f32, random.uniform() as f32)).as_dvec3();
            let off = 10.0_f64.powf(-7.0 * random.uniform()) * if k % 2 == 0 { 1.0 } else { -1.0 };
            let c = (critical + off).clamp(0.05, 0.999);
            let across = h.any_orthonormal_vector();
            let turn = TAU * random.uniform();
            let side = across * turn.cos() + h.cross(across) * turn.sin();
            let [wi, wo] = [1.0, -1.0].map(|sign| (side * (sign * (1.0 - c * c).sqrt()) - h * c).as_vec3());
            if wi.z > -0.02 || wo.z > -0.02 {
                continue;
            }
            let h = -(wi + wo).normalize();
            let facets = ggx.d(h) * ggx.g1(-wi) * ggx.g1(-wo) / (4.0 * wi.z * wo.z);
            let exact = inner_reflectance(f64::from(index), wi.as_dvec3(), wo.as_dvec3());
            let error = (f64::from(glass.eval(wo, wi).x) / (f64::from(facets) * exact) - 1.0).abs();
            let worst = if off.abs() < 1e-4 { &mut near } else { &mut elsewhere };
            *worst = worst.max(error);
        }
        println!("{index}: {near:.1e} within 1e-4 of the critical cosine, {elsewhere:.1e} elsewhere");
        // 1 − F is 4 √(2 δ/c) next to the critical cosine c for s-polarized light. A few roundings
        // of the cosine make δ = 3e-7.
        let bound = 4.0 * (6e-7 / critical).sqrt();
        assert!(near < bound && near > elsewhere, "{index}: {near}, {elsewhere}");
        assert!(elsewhere < 2e-4, "{index}: {elsewhere}");
    }
}

/// Returns `∫ f |cos θ_i|` over the hemispheres above and below.
fn albedos(brdf: &dyn Brdf, wo: Vec3, rows: u32) -> [f64; 2] {
    let (step, turn) = (FRAC_PI_2 / f64::from(rows), TAU / f64::from(2 * rows));
    let mut sums = [0.0; 2];
    for i in 0..rows {
        let theta = step * (f64::from(i) + 0.5);
        let weight = theta.cos() * theta.sin() * step * turn;
        for j in 0..2 * rows {
            let wi = direction(theta, turn * (f64::from(j) + 0.5));
            for (sum, side) in sums.iter_mut().zip([1.0, -1.0]) {
                let value = brdf.eval(wo, Vec3::new(wi.x, wi.y, side * wi.z));
                *sum += weight * f64::from(value.max_element());
            }
        }
    }
    sums
}

/// Returns expectations over visible normals of unshadowed reflection and transmission: Snell's and
/// Fresnel's laws in `f64`.
fn expected(name: &str, density: &Facets, index: f64, wo: Vec3) -> [f64; 2] {
    const SIDE: u16 = 240;
    let v = if wo.z < 0.0 { -wo } else { wo };
    let outside = wo.z > 0.0;
    let eta = if outside || name == "wall" { index } else { 1.0 / index };
    let mut sums = [0.0; 2];
    for k in 0..SIDE * SIDE {
        let u = Vec2::new(f32::from(k % SIDE) + 0.5, f32::from(k / SIDE) + 0.5) / f32::from(SIDE);
        let (v, h) = (v.as_dvec3(), density.sample_visible(v, u).as_dvec3());
        let cosine = v.dot(h).min(1.0);
        let below = 1.0 - (1.0 - cosine * cosine) / (eta * eta);
        let refracted = below.max(0.0).sqrt();
        let s = (cosine - eta * refracted) / (cosine + eta * refracted);
        let p = (eta * cosine - refracted) / (eta * cosine + refracted);
        let once = if below > 0.0 { 0.5 * (s * s + p * p) } else { 1.0 };
        let share = if name == "wall" { 2.0 * once / (1.0 + once) } else { once };
        let g1 = |w: DVec3| if w.z > 0.0 { f64::from(density.g1(w.as_vec3())) } else { 0.0 };
        let mirrored = 2.0 * cosine * h - v;
        let g2_over_g1 = |w: DVec3| {
            let (v, w) = (v.as_vec3(), w.as_vec3());
            if w.z > 0.0 { f64::from(density.g2(v, w) / density.g1(v)) } else { 0.0 }
        };
        // The path of refracted light, reversed: facets are visible from below as from above.
        let on = if name == "wall" { mirrored } else { v / eta - (cosine / eta - refracted) * h };
        let shown: &dyn Fn(DVec3) -> f64 = if name == "wall" { &g2_over_g1 } else { &g1 };
        sums[0] += share * shown(mirrored);
        sums[1] += (1.0 - share) * shown(on);
    }
    let [mirrored, through] = sums.map(|sum| sum / f64::from(SIDE * SIDE));
    if outside { [mirrored, through] } else { [through, mirrored] }
}

#[test]
fn energy_is_conserved_except_for_shadowing() {
    for (density_name, density) in densities() {
        for (name, glass) in surfaces(density.as_ref()) {
            for wo in views() {
                let (coarse, fine) = (albedos(&glass, wo, 64), albedos(&glass, wo, 128));
                let index = f64::from(glass.fresnel().relative_index());
                let expected = expected(name, density.as_ref(), index, wo);
                for side in 0..2 {
                    // GGX has facets up to the horizon, where the integrand has an edge. For α =
                    // 0.7 the rule with 128 rows is within 2.8e-3, and with 800 rows within 3e-4.
                    // The rule over visible normals is within 1e-4.
                    let epsilon = (fine[side] - coarse[side]).abs() + 4e-3;
                    let case = format!("{density_name}, {name}, {wo}, side {side}");
                    assert_abs_diff_eq!(fine[side], expected[side], epsilon = epsilon, "{case}");
                }
                let all = fine[0] + fine[1];
                println!("{density_name}, {name}, {wo:.2}: {fine:.4?}, {all:.4}");
                assert!(
                    all <= 1.0 + (all - coarse[0] - coarse[1]).abs() + 1e-5,
                    "{density_name}, {name}: {all}"
                );
            }
        }
    }
}

#[test]
fn transport_is_reciprocal_up_to_the_index() {
    let mut random = Random(5);
    let mut any = move || {
        let [x, y] = [random.uniform(), random.uniform()];
        direction((2.0 * x - 1.0).acos(), TAU * y)
    };
    for (density_name, density) in densities() {
        for (name, glass) in surfaces(density.as_ref()) {
            let index = glass.fresnel().relative_index();
            let side = |w: Vec3| if w.z > 0.0 || name == "wall" { 1.0 } else { index * index };
            let mut seen = [0; 2];
            for _ in 0..2000 {
                let (wi, wo) = (any(), any());
                let there = glass.eval(wo, wi).x * side(wo);
                let back = glass.eval(wi, wo).x * side(wi);
                seen[usize::from(wi.z * wo.z < 0.0)] += u32::from(there > 0.0);
                // The refracting facet is accurate to 1e-7/|η − 1|, and its density to that over
                // its deviation.
                let tolerance = 2e-5 * there.max(1e-3);
                assert!(
                    (there - back).abs() <= tolerance,
                    "{density_name}, {name}: {there}, {back}: {wi}, {wo}"
                );
            }
            assert!(seen.iter().all(|&n| n > 100), "{density_name}, {name}: {seen:?}");
        }
    }
}

/// Returns the p-value of 40,000 samples in bins of both hemispheres.
fn samples_fit(name: &str, brdf: &dyn Brdf, wo: Vec3) -> f64 {
    const BINS: SphereBins = SphereBins { rows: 16, columns: 12 };
    const SAMPLES: u64 = 40_000;
    let probabilities = BINS.integrate(|wi| f64::from(brdf.pdf(wo, wi)));
    let mut random = Random(11);
    let samples = (0..SAMPLES).map(|_| {
        let [uc, x, y] = [(); 3].map(|()| random.uniform() as f32);
        let wi = brdf.sample(wo, uc, Vec2::new(x, y)).map_or(Vec3::ZERO, |sample| sample.wi);
        assert!(wi == Vec3::ZERO || (wi.length() - 1.0).abs() < 1e-4, "{name}: {wi}");
        wi
    });
    p_value(&BINS.count(samples), &probabilities, SAMPLES)
}

#[test]
fn samples_follow_their_density_on_both_sides() {
    let hills = |n: Vec3| (9.0 * n.x).sin() * (7.0 * n.y + 1.0).cos() + 1.1;
    let painted = NdfMap::from_fn(24, 24, Measure::ProjectedSolidAngle, Reconstruction::Bilinear, hills)
        .expect("hills");
    let mut all = densities().into_iter().filter(|(name, _)| *name != "Beckmann 0.7").collect::<Vec<_>>();
    all.push(("painted", Box::new(Masked::new(painted))));
    // From outside and from inside, along the normal and up to grazing. Walls are the same from
    // both sides.
    let angles = [0.0, 45.0, 80.0, 100.0, 135.0, 180.0_f64];
    let cases: Vec<_> = all
        .iter()
        .flat_map(|(density, facets)| {
            surfaces(facets.as_ref()).into_iter().flat_map(move |(name, glass)| {
                let angles = angles.into_iter().filter(move |&angle| name != "wall" || angle < 90.0);
                angles.map(move |angle| (format!("{density}, {name}, {angle}°"), glass, angle))
            })
        })
        .collect();
    let level = 1e-3 / cases.len() as f64;
    cases.into_par_iter().for_each(|(case, glass, angle)| {
        let p = samples_fit(&case, &glass, direction(angle.to_radians(), 0.7));
        println!("{case}: p = {p:.4}");
        assert!(p > level, "{case}: p = {p:e}");
    });
}

#[test]
fn bodies_and_walls_pass_the_public_checks() {
    for (density_name, density) in densities().into_iter().filter(|(name, _)| name.ends_with("0.2, 0.4")) {
        for (name, glass) in surfaces(density.as_ref()) {
            let index = if name == "wall" { 1.0 } else { glass.fresnel().relative_index() };
            let report = check::dielectric(&glass, index, quick(2));
            assert!(report.passed(), "{density_name}, {name}\n{report}");
        }
    }
}

/// Chalk dust on a wavy sheet of frosted glass, with facets that lean to one side.
struct Dusty {
    sheet: RoughDielectric<Beckmann>,
    dust: Lambert,
}

impl Material for Dusty {
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        Bsdf::new(point.frame(), wo)
            .with(slope_facets(Vec3::Z, direction(0.2, 1.0), 0.02), [Lobe::from(&self.sheet as &dyn Brdf)])
            .with([Facet::new(0.5, Vec3::Z)], [Lobe::from(&self.dust as &dyn Brdf)])
    }
}

#[test]
fn layers_of_rough_glass_pass_the_public_checks() {
    let glass = Dielectric::new(1.5).expect(VALID);
    let dusty = Dusty {
        sheet: RoughDielectric::thin(Beckmann::new(0.3, 0.5).expect(VALID), glass, Vec3::ONE),
        dust: Lambert::new(Vec3::splat(0.3)).expect(VALID),
    };
    let point = SurfacePoint::new(Vec3::ZERO, Vec3::Z, Footprint::from_width(1e-3));
    let report = check::material(&dusty, &point, quick(5));
    // Both layers are fully present.
    assert!(report.failures().all(|failure| failure == "energy"), "{report}");
    let coat = Coat::dielectric(glass).rough(0.4);
    let report = check::material(&coat, &point, quick(6));
    assert!(report.passed(), "{report}");
    for wo in views() {
        assert_eq!(coat.bsdf(&point, wo).specular_samples(wo, Vec2::splat(0.4)), [None; 2]);
    }
}

#[test]
fn sample_weights_are_bounded() {
    let mut random = Random(3);
    for (density_name, density) in densities() {
        for (name, glass) in surfaces(density.as_ref()) {
            for wo in views() {
                let (mut most, mut sum) = (0.0_f32, 0.0_f64);
                for _ in 0..2000 {
                    let [uc, x, y] = [(); 3].map(|()| random.uniform() as f32);
                    let weight =
                        glass.sample(wo, uc, Vec2::new(x, y)).map_or(0.0, |sample| sample.weight().x);
                    sum += f64::from(weight) / 2000.0;
                    most = most.max(weight);
                }
                println!("{density_name}, {name}, {wo:.2}: mean {sum:.3}, most {most:.2}");
                assert!(most < 1.001 && sum < 1.0, "{density_name}, {name}, {wo}: {most}, {sum}");
            }
        }
    }
}

#[test]
fn tinted_walls_are_darker_at_an_angle() {
    let ggx = Ggx::isotropic(0.03).expect(VALID);
    let index = Dielectric::new(1.5).expect(VALID);
    let through = |tint: Vec3, wo| albedos(&RoughDielectric::thin(ggx, index, tint), wo, 128)[1];
    for theta in [0.0_f64, 0.6, 1.2] {
        let wo = direction(theta, 0.4);
        let share = through(Vec3::splat(0.3), wo) / through(Vec3::ONE, wo);
        let longer = 1.0 / (1.0 - (theta.sin() / 1.5).powi(2)).sqrt();
        // Facets with α = 0.03 see the angle ± 0.03, which affects the path length only in second
        // order.
        assert_abs_diff_eq!(share, 0.3_f64.powf(longer), epsilon = 2e-3, "{theta}");
    }
}

#[test]
fn directions_without_a_side_are_dark() {
    let good = direction(0.7, 0.3);
    let odd =
        [Vec3::ZERO, Vec3::X, Vec3::NAN, Vec3::new(0.0, f32::NAN, 1.0), Vec3::INFINITY, Vec3::NEG_INFINITY];
    for (density_name, density) in densities() {
        for (name, glass) in surfaces(density.as_ref()) {
            for bad in odd {
                for (wi, wo) in [(bad, good), (good, bad), (bad, bad), (bad, -good)] {
                    assert_eq!(glass.eval(wo, wi), Vec3::ZERO, "{density_name}, {name}: {wi}, {wo}");
                    assert_eq!(glass.pdf(wo, wi), 0.0, "{density_name}, {name}: {wi}, {wo}");
                }
                assert_eq!(glass.sample(bad, 0.5, Vec2::splat(0.5)), None, "{density_name}, {name}: {bad}");
            }
            for low in [1e-7, 1e-30, f32::MIN_POSITIVE, -1e-7, -1e-30] {
                let low = Vec3::new(1.0, 0.0, low);
                for other in [low, -low, good, -good, Vec3::new(-low.x, 0.0, low.z)] {
                    for value in [glass.eval(other, low), glass.eval(low, other)] {
                        assert!(
                            value.is_finite() && value.min_element() >= 0.0,
                            "{density_name}, {name}: {other}"
                        );
                    }
                    assert!(glass.pdf(other, low).is_finite(), "{density_name}, {name}: {other}");
                }
                for u in [Vec2::ZERO, Vec2::ONE, Vec2::NAN, Vec2::splat(0.999_999_94), Vec2::INFINITY] {
                    let sample = glass.sample(low, u.y, u);
                    let unit = sample.is_none_or(|sample| (sample.wi.length() - 1.0).abs() < 1e-4);
                    assert!(unit, "{density_name}, {name}: {low}, {u}: {sample:?}");
                }
            }
        }
    }
    // No interface, and a degenerate interface.
    for index in [1.0, 0.999_999, f32::MIN_POSITIVE, f32::MAX] {
        let glass = RoughDielectric::new(Ggx::isotropic(0.3).expect(VALID), Dielectric::new_clamped(index));
        for (wi, wo) in [(good, good), (-good, good), (good, -good), (-good, -good)] {
            let value = glass.eval(wo, wi);
            assert!(value.is_finite() && glass.pdf(wo, wi).is_finite(), "{index}: {value}");
            let sample = glass.sample(wo, 0.5, Vec2::splat(0.5));
            assert!(sample.is_none_or(|sample| sample.wi.is_finite()), "{index}");
        }
    }
}

/// Visible normals of GGX as Heitz 2018 samples them, *Sampling the GGX Distribution of Visible
/// Normals*, listing 1: projected onto a disk.
#[derive(Clone, Copy)]
struct Disk(Ggx);

impl Ndf for Disk {
    fn d(&self, m: Vec3) -> f32 {
        self.0.d(m)
    }

    fn warp_gaussian(&self, z: Vec2) -> Vec3 {
        self.0.warp_gaussian(z)
    }

    fn invert(&self, m: Vec3) -> Vec2 {
        self.0.invert(m)
    }
}

impl Microfacet for Disk {
    fn lambda(&self, v: Vec3) -> f32 {
        self.0.lambda(v)
    }

    fn projected_area(&self, v: Vec3) -> f32 {
        self.0.projected_area(v)
    }

    fn sample_visible(&self, v: Vec3, u: Vec2) -> Vec3 {
        let stretch = Vec3::new(self.0.alpha_x(), self.0.alpha_y(), 1.0);
        let w = (v * stretch).normalize();
        let across = Vec2::new(-w.y, w.x);
        let x = if across == Vec2::ZERO { Vec3::X } else { across.normalize().extend(0.0) };
        let y = w.cross(x);
        let (radius, (sin, cos)) = (u.x.sqrt(), (TAU as f32 * u.y).sin_cos());
        let (p, s) = (radius * cos, 0.5 * (1.0 + w.z));
        let q = (1.0 - s) * (1.0 - p * p).sqrt() + s * radius * sin;
        let m = x * p + y * q + w * (1.0 - p * p - q * q).max(0.0).sqrt();
        Vec3::new(m.x * stretch.x, m.y * stretch.y, m.z.max(1e-6)).normalize()
    }
}

/// The transmittance of a path through a slab of glass with two rough surfaces.
fn through_slab(top: &dyn Brdf, bottom: &dyn Brdf, wo: Vec3, mut uniform: impl FnMut() -> f32) -> f64 {
    let mut weight = 1.0;
    let (mut w, mut at_top) = (wo, true);
    for _ in 0..64 {
        // The normal of the bottom points down.
        let flip = Vec3::new(1.0, 1.0, if at_top { 1.0 } else { -1.0 });
        let surface = if at_top { top } else { bottom };
        let (uc, u) = (uniform(), Vec2::new(uniform(), uniform()));
        let Some(sample) = surface.sample(w * flip, uc, u) else { return 0.0 };
        weight *= f64::from(sample.weight().x);
        let leaving = sample.wi * flip;
        if (leaving.z > 0.0) == at_top {
            return if at_top { 0.0 } else { weight };
        }
        (w, at_top) = (-leaving, !at_top);
    }
    0.0
}

/// The variance of estimates beside the sampling of visible normals of 2018: a rough slab, a white
/// furnace, and a slab with every bounce between facets.
///
/// Each estimate is the mean of 64 points of a shifted lattice for the first facet. Printed are the
/// mean, the variance of a path, and 64 times that of an estimate.
#[test]
#[ignore = "slow: weekly"]
fn variance_beside_disks() {
    const ESTIMATES: u32 = 4000;
    const POINTS: u32 = 64;
    let figures = |estimate: &(dyn Fn(u32) -> [f64; 2] + Sync)| {
        let all: Vec<_> = (0..ESTIMATES).into_par_iter().map(estimate).collect();
        let count = f64::from(ESTIMATES);
        let mean = all.iter().map(|e| e[0]).sum::<f64>() / count;
        let variance = all.iter().map(|e| (e[0] - mean).powi(2)).sum::<f64>() / count;
        let single = all.iter().map(|e| e[1]).sum::<f64>() / count - mean * mean;
        [mean, single, variance * f64::from(POINTS)]
    };
    let lattice = |k: u32, of: &dyn Fn(Vec2, &mut Random) -> f64| {
        let mut random = Random(u64::from(k) + 1);
        let shift = Vec2::new(random.uniform() as f32, random.uniform() as f32);
        let [mut sum, mut squares] = [0.0; 2];
        for i in 0..POINTS {
            let u = (Vec2::from(r2(i).map(|u| u as f32)) + shift).fract();
            let value = of(u, &mut random);
            sum += value;
            squares += value * value;
        }
        [sum / f64::from(POINTS), squares / f64::from(POINTS)]
    };
    let glass = Dielectric::new(1.5).expect(VALID);
    for (alpha, theta) in [(0.1, 0.3), (0.3, 0.3), (0.3, 1.2), (0.6, 0.3), (0.6, 1.2)] {
        let (ggx, wo) = (Ggx::isotropic(alpha).expect(VALID), direction(theta, 0.4));
        let slab = |surface: &(dyn Brdf + Sync)| {
            figures(&|k| {
                lattice(k, &|u, random| {
                    let mut first = [u.x, u.y].into_iter();
                    // The choice of a lobe is random; then come both numbers of the first facet.
                    let mut count = 0;
                    through_slab(surface, surface, wo, || {
                        count += 1;
                        if count == 1 { None } else { first.next() }
                            .unwrap_or_else(|| random.uniform() as f32)
                    })
                })
            })
        };
        let mirror = |metal: &(dyn Brdf + Sync)| {
            figures(&|k| {
                lattice(k, &|u, _| metal.sample(wo, 0.5, u).map_or(0.0, |s| f64::from(s.weight().x)))
            })
        };
        let ours = [
            slab(&RoughDielectric::new(ggx, glass)),
            mirror(&CookTorrance::new(ggx, Vec3::ONE)),
            slab(&EnergyCompensated::glass(ggx, glass)),
        ];
        let theirs =
            [slab(&RoughDielectric::new(Disk(ggx), glass)), mirror(&CookTorrance::new(Disk(ggx), Vec3::ONE))];
        println!("α {alpha}, {theta} rad: caps {ours:.5?}, disk {theirs:.5?}");
        for (ours, theirs) in ours.into_iter().zip(theirs) {
            // Measured for the slab: equal, because both draw visible normals and most of the variance
            // is the choice of reflection. For the furnace 0.29 to 0.65 of the variance of a path.
            assert!((ours[0] - theirs[0]).abs() < 4e-3, "{ours:?} {theirs:?}");
            assert!(ours[1] < 1.05 * theirs[1] + 1e-6, "{ours:?} {theirs:?}");
        }
        assert!(ours[2][0] > ours[0][0]);
    }
}
