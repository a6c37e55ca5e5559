//! Energy of BRDFs with every bounce: white and tinted furnaces, and the property tests.

use core::f32::consts::FRAC_PI_8;

use asperity_shading::check;
use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::ndf_sampling::Microfacet;
use asperity_shading::reflectance::{
    AlbedoTable, DirectionalAlbedo, EnergyCompensated, GgxAlbedo, GlassAlbedo, RoughDielectric,
    directional_albedo,
};
use asperity_shading::{Beckmann, Brdf, Conductor, CookTorrance, Dielectric, Fresnel, Ggx, Schlick, reflect};
use rayon::prelude::*;

use crate::checked::quick;

const VALID: &str = "in range";
const ROUGHNESSES: [f32; 8] = [0.05, 0.08, 0.15, 0.25, 0.4, 0.6, 0.8, 1.0];
const COSINES: [f32; 9] = [0.003, 0.02, 0.07, 0.2, 0.4, 0.6, 0.75, 0.9, 1.0];

fn view(z: f32, turn: f32) -> Vec3 {
    let across = (1.0 - z * z).sqrt();
    Vec3::new(across * turn.cos(), across * turn.sin(), z)
}

/// The white furnace: `∫ f |cos θ_i| dω_i` over the reflected and refracted directions of visible
/// normals, a Fibonacci lattice of 2¹⁶ points. Twice as many change it by at most 3·10⁻⁴.
fn furnace(brdf: &impl Brdf, ndf: &impl Microfacet, eta: Option<f32>, wo: Vec3) -> f64 {
    const POINTS: u32 = 1 << 16;
    let (up, side) = (wo * wo.z.signum(), wo.z.signum());
    let (mut sum, mut all) = (0.0, 0.0);
    for k in 0..POINTS {
        let t = (f64::from(k) + 0.5) / f64::from(POINTS);
        let u = (0.5 + f64::from(k) * 0.618_033_988_749_894_9).fract();
        let h = ndf.sample_visible(up, Vec2::new(u as f32, (1.0 - t * t * t) as f32));
        let (o, pdf) = (up.dot(h), ndf.visible_pdf(up, h));
        let light = |wi: Vec3, jacobian: f32| {
            f64::from(brdf.eval(wo, side * wi).x * wi.z.abs()) / f64::from(pdf * jacobian).max(1e-30)
        };
        let mirrored = reflect(up, h);
        let mut value = if mirrored.z > 0.0 { light(mirrored, 0.25 / o) } else { 0.0 };
        if let Some(eta) = eta {
            let eta = if wo.z < 0.0 { 1.0 / eta } else { eta };
            let refracted = (-up).refract(h, 1.0 / eta);
            if refracted.z < 0.0 {
                let i = refracted.dot(h);
                value += light(refracted, (eta / (eta * i + o)).powi(2) * i.abs());
            }
        }
        sum += t * t * value;
        all += t * t;
    }
    sum / all
}

/// The worst deviation from 1 over roughness and angle.
fn worst(deviation: impl Fn(f32, f32) -> f64 + Sync) -> (f64, f32, f32) {
    let cases = ROUGHNESSES.into_par_iter().flat_map_iter(|alpha| COSINES.map(|z| (alpha, z)));
    let all = cases.map(|(alpha, z)| ((deviation(alpha, z) - 1.0).abs(), alpha, z));
    all.max_by(|a, b| a.0.total_cmp(&b.0)).expect("cases")
}

/// White metal, and glass of nine indices from both sides, as bodies and as bubbles.
#[test]
#[ignore = "slow: weekly"]
fn white_furnace() {
    let metal = worst(|alpha, z| {
        let ggx = Ggx::isotropic(alpha).expect(VALID);
        furnace(&EnergyCompensated::metal(ggx, Vec3::ONE), &ggx, None, view(z, 0.7))
    });
    println!("metal: {metal:?}");
    // Measured: 1.4e-4.
    assert!(metal.0 < 5e-4, "{metal:?}");
    for eta in [1.05, 1.13, 1.33, 1.5, 2.4, 1.0 / 1.05] {
        for side in [1.0, -1.0] {
            let glass = worst(|alpha, z| {
                let ggx = Ggx::isotropic(alpha).expect(VALID);
                let glass = EnergyCompensated::glass(ggx, Dielectric::new(eta).expect(VALID));
                furnace(&glass, &ggx, Some(eta), side * view(z, 0.7))
            });
            println!("glass {eta} from {side}: {glass:?}");
            // Measured: 1.3e-3 for 1.05, 4e-4 for 1.33 and above, the error of the reference included.
            let limit = if (1.0 / 1.3..1.3).contains(&eta) { 1.5e-3 } else { 6e-4 };
            assert!(glass.0 < limit, "{eta} from {side}: {glass:?}");
        }
    }
}

/// The furnace notices the light that is lost without compensation.
#[test]
fn single_scattering_fails_the_furnace() {
    for alpha in [0.15, 0.4, 1.0] {
        let ggx = Ggx::isotropic(alpha).expect(VALID);
        let metal = EnergyCompensated::metal(ggx, Vec3::ONE);
        let glass = EnergyCompensated::glass(ggx, Dielectric::new(1.5).expect(VALID));
        let wo = view(0.2, 0.0);
        assert!(furnace(metal.single(), &ggx, None, wo) < 0.93, "{alpha}");
        assert!(furnace(glass.single(), &ggx, Some(1.5), wo) < 0.96, "{alpha}");
    }
}

/// A constant reflectance: every bounce in turn.
#[test]
fn tinted_furnace_is_the_sum_of_bounces() {
    let color = Vec3::new(0.95, 0.6, 0.1);
    for (alpha, z) in ROUGHNESSES.into_iter().flat_map(|alpha| COSINES.map(|z| (alpha, z))) {
        let ggx = Ggx::isotropic(alpha).expect(VALID);
        let (white, wo) = (CookTorrance::new(ggx, Vec3::ONE), view(z, 0.3));
        let e = directional_albedo(&white, wo, 1 << 14).x;
        // The mean over views, by the midpoint rule over the cosine's square.
        let count = 64;
        let squares = (0..count).map(|k| (k as f32 + 0.5) / count as f32);
        let mean = squares.map(|s| directional_albedo(&white, view(s.sqrt(), 0.0), 1 << 11).x).sum::<f32>()
            / count as f32;
        let (mut sum, mut left) = (color * e, color * (1.0 - e));
        for _ in 0..200 {
            left *= color;
            sum += left * mean;
            left *= 1.0 - mean;
        }
        let got = directional_albedo(&EnergyCompensated::metal(ggx, color), wo, 1 << 14);
        // Measured: 1.0e-3, the error of the reference.
        assert!((got - sum).abs().max_element() < 2e-3, "α = {alpha}, cos = {z}: {got}, expected {sum}");
    }
}

/// The albedo of Schlick's approximation from two tables, and its mean.
#[test]
fn schlick_moment_is_that_of_the_integral() {
    let cases = ROUGHNESSES.into_par_iter().chain([0.04]).map(|alpha| {
        let ggx = Ggx::isotropic(alpha).expect(VALID);
        let table = GgxAlbedo::new(&ggx);
        let [moment, glass] = [0.0, 0.04].map(|f0| CookTorrance::new(ggx, Schlick::new(f0).expect(VALID)));
        let mut worst = [0.0_f32; 3];
        for z in COSINES.into_iter().chain([0.12, 0.3, 0.5, 0.97]) {
            let wo = view(z, 0.7);
            let (e, e5) = (table.albedo(wo), table.schlick_moment(wo));
            worst[0] = worst[0].max((e5 - directional_albedo(&moment, wo, 1 << 17).x).abs());
            let exact = directional_albedo(&glass, wo, 1 << 17).x;
            worst[1] = worst[1].max(((0.04 * (e - e5) + e5) / exact - 1.0).abs());
        }
        let rule = (0..64).map(|k| table.schlick_moment(view(((k as f32 + 0.5) / 64.0).sqrt(), 0.0)));
        worst[2] = (rule.sum::<f32>() / 64.0 - table.mean_schlick_moment()).abs();
        println!("{alpha}: {worst:?}");
        worst
    });
    let worst = cases.reduce(Default::default, |a, b| core::array::from_fn(|k| a[k].max(b[k])));
    println!("{worst:?}");
    // Measured: 4.0e-4, 7.3e-4 and 1.4e-4, all for α below 0.1.
    assert!(worst[0] < 5e-4 && worst[1] < 9e-4 && worst[2] < 2e-4, "{worst:?}");
}

/// Anisotropic mirrors: the albedo, the Schlick moment and the means, up to the ratios 4 and 10.
#[test]
fn anisotropic_mirrors_are_tabulated() {
    let roughnesses =
        [[0.1, 0.4], [0.4, 0.1], [0.3, 0.2], [0.08, 0.05], [1.0, 0.25], [0.6, 0.45], [0.1, 1.0]];
    let cases = roughnesses.into_par_iter().map(|[x, y]| {
        let ggx = Ggx::new(x, y).expect(VALID);
        let table = GgxAlbedo::new(&ggx);
        let white = CookTorrance::new(ggx, Vec3::ONE);
        let glass = CookTorrance::new(ggx, Schlick::new(0.04).expect(VALID));
        let mut worst = [0.0_f32; 4];
        let mut means = [0.0_f32; 2];
        for (z, turn) in
            COSINES.into_iter().flat_map(|z| [0.0, 0.3, 0.8, 1.2, 1.57, 4.0].map(|turn| (z, turn)))
        {
            let wo = view(z, turn);
            let (e, e5) = (table.albedo(wo), table.schlick_moment(wo));
            worst[0] = worst[0].max((e / directional_albedo(&white, wo, 1 << 15).x - 1.0).abs());
            let exact = directional_albedo(&glass, wo, 1 << 15).x;
            worst[1] = worst[1].max(((0.04 * (e - e5) + e5) / exact - 1.0).abs());
        }
        for (i, k) in (0..32).flat_map(|i| (0..16).map(move |k| (i, k))) {
            let wo = view(((i as f32 + 0.5) / 32.0).sqrt(), (k as f32 + 0.5) * FRAC_PI_8);
            means[0] += table.albedo(wo) / 512.0;
            means[1] += table.schlick_moment(wo) / 512.0;
        }
        worst[2] = (table.mean_albedo() / means[0] - 1.0).abs();
        worst[3] = (table.mean_schlick_moment() - means[1]).abs();
        println!("{x}, {y}: {worst:?}");
        (worst, x.max(y) > 4.1 * x.min(y))
    });
    let all: Vec<_> = cases.collect();
    let worst = |wide: bool, k: usize| {
        all.iter().filter(|case| case.1 == wide).map(|case| case.0[k]).fold(0.0, f32::max)
    };
    let [up_to_4, up_to_10] = [false, true].map(|wide| [0, 1, 2, 3].map(|k| worst(wide, k)));
    println!("{up_to_4:?} {up_to_10:?}");
    // Measured: [4.9e-3, 4.1e-2, 1.3e-3, 4.6e-4] and [2.7e-2, 0.152, 2.2e-3, 7.4e-4].
    let within =
        |worst: [f32; 4], limits: [f32; 4]| worst.into_iter().zip(limits).all(|(error, limit)| error < limit);
    assert!(within(up_to_4, [5.5e-3, 5e-2, 2e-3, 8e-4]), "{up_to_4:?}");
    assert!(within(up_to_10, [3e-2, 0.16, 3e-3, 8e-4]), "{up_to_10:?}");
}

/// The white furnace of anisotropic glass from both sides, up to the ratios 4 and 10.
#[test]
#[ignore = "slow: weekly"]
fn white_furnace_of_anisotropic_glass() {
    let worst = |x, y, eta: f32, side: f32| {
        let ggx = Ggx::new(x, y).expect(VALID);
        let glass = EnergyCompensated::glass(ggx, Dielectric::new(eta).expect(VALID));
        let views = [0.003, 0.07, 0.4, 0.75]
            .into_par_iter()
            .flat_map_iter(|z| [0.0, 0.4, 1.57].map(|turn| (z, turn)));
        let error = views
            .map(|(z, turn)| ((furnace(&glass, &ggx, Some(eta), side * view(z, turn)) - 1.0).abs(), z, turn));
        error.reduce(Default::default, |a, b| if a.0 > b.0 { a } else { b })
    };
    // Measured: 4.5e-3 from the rarer side and 7.6e-3 from the denser up to the ratio 4, also for (0.4, 0.1),
    // (0.5, 0.9) and the index 1.13; 0.11 and 0.13 for 10.
    let up_to_4 = [(0.25, 1.0), (0.05, 0.2)].into_iter();
    let cases = up_to_4.flat_map(|(x, y)| [1.05, 1.5, 2.4].map(|eta| (x, y, eta, [7e-3, 1e-2])));
    for (x, y, eta, limits) in cases.chain([(0.1, 1.0, 1.5, [0.14, 0.18])]) {
        let errors = [1.0, -1.0].map(|side| worst(x, y, eta, side));
        println!("{x}, {y}, {eta}: {errors:?}");
        assert!(errors[0].0 < limits[0] && errors[1].0 < limits[1], "{x}, {y}, {eta}: {errors:?}");
    }
}

/// All checks but reciprocity, which the factor gives up.
#[test]
fn compensated_brdfs_pass_the_checks() {
    let gold =
        [(0.18, 3.42), (0.42, 2.35), (1.37, 1.77)].map(|(eta, k)| Conductor::new(eta, k).expect(VALID));
    for (k, (x, y)) in [(0.1, 0.1), (0.2, 0.4), (0.8, 0.8)].into_iter().enumerate() {
        let ggx = Ggx::new(x, y).expect(VALID);
        let table = AlbedoTable::new(&CookTorrance::new(ggx, Vec3::ONE), 48).expect(VALID);
        let metal = EnergyCompensated::new(CookTorrance::new(ggx, gold), table, &gold);
        let report = check::brdf(&metal, quick(k as u32));
        assert!(report.failures().all(|name| name == "reciprocity"), "{x}, {y}: {report}");
        if x == y {
            let glass = EnergyCompensated::glass(ggx, Dielectric::new(1.5).expect(VALID));
            let report = check::dielectric(&glass, 1.5, quick(9 + k as u32));
            assert!(report.failures().all(|name| name == "reciprocity"), "{x}: {report}");
        }
    }
}

#[test]
#[ignore = "slow: weekly"]
fn computed_tables_are_within_two_tenths_of_a_percent() {
    let mut worst = [0.0_f32; 3];
    let mut note = |k: usize, table: &AlbedoTable, white: &dyn Brdf, samples: u32| {
        for (z, turn) in COSINES.into_iter().flat_map(|z| [0.0, 0.4, 1.1, 1.57, 4.0].map(|turn| (z, turn))) {
            for wo in [view(z, turn), -view(z, turn)].into_iter().take(1 + usize::from(white.transmits())) {
                let exact = directional_albedo(white, wo, samples).x;
                worst[k] = worst[k].max((table.albedo(wo) / exact - 1.0).abs());
            }
        }
    };
    for alpha in [0.05, 0.2, 1.0] {
        let white = CookTorrance::new(Beckmann::isotropic(alpha).expect(VALID), Vec3::ONE);
        note(0, &AlbedoTable::new(&white, 1).expect(VALID), &white, 1 << 16);
    }
    for (x, y) in [(0.1, 0.4), (0.6, 0.3)] {
        let white = CookTorrance::new(Ggx::new(x, y).expect(VALID), Vec3::ONE);
        note(1, &AlbedoTable::new(&white, 48).expect(VALID), &white, 1 << 15);
    }
    let glass = RoughDielectric::new(Ggx::isotropic(0.3).expect(VALID), Dielectric::new(1.5).expect(VALID));
    note(2, &AlbedoTable::new(&glass, 1).expect(VALID), &glass, 1 << 17);
    println!("{worst:?}");
    assert!(worst[0] < 2e-3 && worst[1] < 2e-3 && worst[2] < 5e-3, "{worst:?}");
}

#[test]
fn albedos_accept_every_input() {
    let odd = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0, -0.0, 1e-40, 1e38, -1e38, -1.0, 0.5];
    let mut albedos: Vec<Box<dyn DirectionalAlbedo>> = Vec::new();
    for alpha in [Ggx::MIN_ALPHA, 0.01, 0.3, 1.0, Ggx::MAX_ALPHA] {
        let ggx = Ggx::new(alpha, 0.3).expect(VALID);
        albedos.push(Box::new(GgxAlbedo::new(&ggx)));
        for eta in [f32::MIN_POSITIVE, 0.4, 0.99, 1.0, 1.01, 1.5, f32::MAX] {
            albedos.push(Box::new(GlassAlbedo::new(&ggx, &Dielectric::new(eta).expect(VALID))));
        }
        albedos.push(Box::new(AlbedoTable::new(&CookTorrance::new(ggx, Vec3::ONE), 2).expect(VALID)));
    }
    for albedo in albedos {
        for wo in odd.into_iter().flat_map(|x| odd.map(|z| Vec3::new(x, 0.3, z))) {
            let e = albedo.albedo(wo);
            assert!(e > 0.0 && e <= 1.0, "{wo}: {e}");
        }
        assert!(albedo.mean_albedo() > 0.0 && albedo.mean_albedo() <= 1.0);
    }
    for bad in [0, 257, usize::MAX] {
        assert!(
            AlbedoTable::new(&CookTorrance::new(Ggx::isotropic(0.3).expect(VALID), Vec3::ONE), bad).is_err()
        );
    }
}

#[test]
fn mean_reflectance_of_interfaces() {
    // 2 ∫ (F₀ + (1 − F₀) (1 − c)⁵) c dc = F₀ + (1 − F₀)/21.
    let schlick = Schlick::new(0.04).expect(VALID).mean_reflectance_rgb().x;
    assert!((schlick - (0.04 + 0.96 / 21.0)).abs() < 1e-6, "{schlick}");
    let reference = |fresnel: &dyn Fresnel| {
        let count = 200_000;
        let squares = (0..count).map(|k| ((f64::from(k) + 0.5) / f64::from(count)).sqrt() as f32);
        squares.map(|c| f64::from(fresnel.reflectance_rgb(c).x)).sum::<f64>() / f64::from(count)
    };
    let glass = |eta| Dielectric::new(eta).expect(VALID);
    let metals = [(0.18, 3.42), (1.37, 1.77)].map(|(eta, k)| Conductor::new(eta, k).expect(VALID));
    let all: [(&dyn Fresnel, f64); 5] = [
        (&glass(1.5), 5e-4),
        (&glass(2.4), 5e-4),
        (&metals[0], 5e-4),
        (&metals[1], 5e-4),
        (&glass(1.0 / 1.5), 0.06),
    ];
    for (k, (fresnel, limit)) in all.into_iter().enumerate() {
        let error = f64::from(fresnel.mean_reflectance_rgb().x) - reference(fresnel);
        assert!(error.abs() < limit, "{k}: {error}");
    }
}
