//! Fresnel reflectances against references of 20 digits (Born and Wolf's formulas, unpolarised).

use asperity_shading::{Conductor, Dielectric, Schlick};
use asperity_tests::assert_abs_diff_eq;
use serde::Deserialize;

/// Absolute, on a share in [0, 1]. Measured worst cases: dielectric 2.6e-7, conductor 2.2e-7, Schlick 1.0e-7.
const TOLERANCE: f64 = 3e-7;

#[derive(Deserialize)]
struct Reference {
    cos_theta: Vec<f64>,
    dielectric: Vec<DielectricCase>,
    conductor: Vec<ConductorCase>,
    schlick: Vec<SchlickCase>,
}

#[derive(Deserialize)]
struct DielectricCase {
    eta: f64,
    #[serde(rename = "F")]
    reflectance: Vec<f64>,
}

#[derive(Deserialize)]
struct ConductorCase {
    eta: f64,
    k: f64,
    #[serde(rename = "F")]
    reflectance: Vec<f64>,
}

#[derive(Deserialize)]
struct SchlickCase {
    #[serde(rename = "F0")]
    f0: f64,
    #[serde(rename = "F")]
    reflectance: Vec<f64>,
}

fn reference() -> Reference {
    serde_json::from_str(include_str!("../../data/ndf/fresnel.json")).expect("the file of references")
}

/// The largest error over the cosines, each printed with its case when it is too large.
fn worst(cosines: &[f64], expected: &[f64], name: &str, reflectance: impl Fn(f32) -> f32) -> f64 {
    assert_eq!(cosines.len(), expected.len());
    let mut worst = 0.0_f64;
    for (&c, &expected) in cosines.iter().zip(expected) {
        let got = f64::from(reflectance(c as f32));
        let error = (got - expected).abs();
        assert!(error <= TOLERANCE, "{name}, cos = {c}: {got} != {expected}");
        worst = worst.max(error);
    }
    worst
}

/// The textbook's formula in `f64`, with Snell's law written out.
fn plain_dielectric(eta: f64, c: f64) -> f64 {
    let sin_squared = (1.0 - c * c) / (eta * eta);
    if sin_squared > 1.0 {
        return 1.0;
    }
    let c_t = (1.0 - sin_squared).sqrt();
    let r_s = (c - eta * c_t) / (c + eta * c_t);
    let r_p = (eta * c - c_t) / (eta * c + c_t);
    0.5 * (r_s * r_s + r_p * r_p)
}

#[test]
fn dielectric_equals_its_references() {
    let reference = reference();
    for case in &reference.dielectric {
        // Near eta = 1 and the critical angle, rounding the inputs to `f32` moves F by up to 2e-5. So the reference
        // checks the plain formula, and that is evaluated at the rounded inputs.
        let mut rounded = Vec::new();
        for (&c, &expected) in reference.cos_theta.iter().zip(&case.reflectance) {
            let plain = plain_dielectric(case.eta, c);
            assert_abs_diff_eq!(
                plain,
                expected,
                epsilon = 1e-12,
                "eta = {}, cos = {c}: {plain} != {expected}",
                case.eta
            );
            rounded.push(plain_dielectric(f64::from(case.eta as f32), f64::from(c as f32)));
        }
        let dielectric = Dielectric::new(case.eta as f32).unwrap();
        let name = format!("eta = {}", case.eta);
        let worst = worst(&reference.cos_theta, &rounded, &name, |c| dielectric.reflectance(c));
        println!("dielectric, {name}: {worst:.1e}");
    }
}

#[test]
fn conductor_equals_its_references() {
    let reference = reference();
    for case in &reference.conductor {
        let conductor = Conductor::new(case.eta as f32, case.k as f32).unwrap();
        let name = format!("eta = {}, k = {}", case.eta, case.k);
        let worst = worst(&reference.cos_theta, &case.reflectance, &name, |c| conductor.reflectance(c));
        println!("conductor, {name}: {worst:.1e}");
    }
}

#[test]
fn schlick_equals_its_references() {
    let reference = reference();
    for case in &reference.schlick {
        let schlick = Schlick::new(case.f0 as f32).unwrap();
        let name = format!("F0 = {}", case.f0);
        let worst = worst(&reference.cos_theta, &case.reflectance, &name, |c| schlick.reflectance(c));
        println!("Schlick, {name}: {worst:.1e}");
    }
}
