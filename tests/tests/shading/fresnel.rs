//! Fresnel reflectances against references with 20 digits (Born and Wolf's formulas, unpolarized).

use asperity_shading::reflectance::SchlickF82;
use asperity_shading::{Conductor, Dielectric, Fresnel, Schlick};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::reference::{numbers, read};
use serde_json::Value;

/// The textbook formula in `f64`, with Snell's law written out.
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

/// Name in the file, constructor, names of its parameters.
type Interface<'a> = (&'a str, &'a dyn Fn(&[f32]) -> Box<dyn Fresnel>, &'a [&'a str]);

#[test]
fn reflectances_match_their_references() {
    let file = read("ndf/fresnel.json");
    let cosines = numbers(&file["cos_theta"]);
    let number = |case: &Value, name: &str| case[name].as_f64().expect("a number");
    let interfaces: [Interface<'_>; 4] = [
        ("dielectric", &|p| Box::new(Dielectric::new(p[0]).unwrap()), &["eta"]),
        ("conductor", &|p| Box::new(Conductor::new(p[0], p[1]).unwrap()), &["eta", "k"]),
        ("schlick", &|p| Box::new(Schlick::new(p[0]).unwrap()), &["F0"]),
        ("f82_tint", &|p| Box::new(SchlickF82::new(p[0], p[1]).unwrap()), &["F0", "tint82"]),
    ];
    for (interface, new, names) in interfaces {
        for case in file[interface].as_array().expect("an array") {
            let parameters: Vec<f64> = names.iter().map(|name| number(case, name)).collect();
            let fresnel = new(&parameters.iter().map(|&x| x as f32).collect::<Vec<_>>());
            for (&c, expected) in cosines.iter().zip(numbers(&case["F"])) {
                let what = format!("{interface}, {parameters:?}, cos = {c}");
                // Near eta = 1 and the critical angle, rounding the inputs to `f32` changes F by up
                // to 2e-5. The reference therefore checks the plain formula, which is evaluated at
                // the rounded inputs.
                let expected = if interface == "dielectric" {
                    assert_abs_diff_eq!(
                        plain_dielectric(parameters[0], c),
                        expected,
                        epsilon = 1e-12,
                        "{what}"
                    );
                    plain_dielectric(f64::from(parameters[0] as f32), f64::from(c as f32))
                } else {
                    expected
                };
                // Maximum measured: dielectric 2.6e-7, conductor 2.2e-7, Schlick 1.0e-7.
                assert_abs_diff_eq!(
                    f64::from(fresnel.reflectance_rgb(c as f32).x),
                    expected,
                    epsilon = 3e-7,
                    "{what}"
                );
            }
        }
    }
}
