//! `OpenPbr` beside values of Adobe's implementation.

use asperity_shading::glam::Vec3;
use asperity_shading::ndf_sampling::Microfacet;
use asperity_shading::reflectance::{Masking, SchlickF82};
use asperity_shading::{
    Brdf, CookTorrance, Dielectric, EnergyPreservingOrenNayar, Fresnel, Ggx, OpenPbr, OpenPbrParameters,
};
use asperity_tests::reference::{numbers, read};
use serde_json::Value;

const VALID: &str = "in range";

fn vec3(item: &Value, name: &str) -> Vec3 {
    let of = numbers(&item[name]);
    Vec3::new(of[0] as f32, of[1] as f32, of[2] as f32)
}

fn number(item: &Value, name: &str) -> f32 {
    item[name].as_f64().expect("a number") as f32
}

/// The largest relative difference of the channels.
fn apart(got: Vec3, expected: Vec3) -> f32 {
    ((got - expected).abs() / expected.abs()).max_element()
}

fn open_pbr(p: OpenPbrParameters) -> OpenPbr {
    OpenPbr::new(p).expect(VALID)
}

#[test]
fn metals_match_adobe() {
    let file = read("ndf/open_pbr.json");
    let (mut single, mut ratios, mut last) = (0.0_f32, 0.0_f32, None);
    for item in file["metal"].as_array().expect("an array") {
        let (roughness, anisotropy) = (number(item, "roughness"), number(item, "anisotropy"));
        let (f0, tint) = (vec3(item, "f0"), vec3(item, "tint"));
        let (wo, wi, expected) = (vec3(item, "wo"), vec3(item, "wi"), vec3(item, "f"));
        let across = 1.0 - anisotropy;
        let along = roughness * roughness * (2.0 / (1.0 + across * across)).sqrt();
        let ggx = Ggx::new(along, across * along).expect(VALID);
        let fresnel = [0, 1, 2].map(|k| SchlickF82::new(f0[k], tint[k]).expect(VALID));
        let metal = CookTorrance::new(ggx, fresnel).with_masking(Masking::Separable);
        single = single.max(apart(metal.eval(wo, wi), expected));
        // The factor of further bounces depends on the view alone, so two lights from a view have the
        // ratio of single scattering, here with the other masking.
        let material = open_pbr(OpenPbrParameters {
            base_color: f0,
            base_metalness: 1.0,
            specular_color: tint,
            specular_roughness: roughness,
            specular_roughness_anisotropy: anisotropy,
            ..Default::default()
        });
        let light = last.replace(wi).unwrap_or(wi);
        let of = |wi: Vec3| material.eval(wo, wi) * (ggx.g2_separable(wi, wo) / ggx.g2(wi, wo));
        let ratio = of(light) / of(wi);
        ratios = ratios.max(apart(ratio, metal.eval(wo, light) / expected));
    }
    println!("single scattering {single:e}, ratios {ratios:e}");
    assert!(single < 1e-5 && ratios < 1e-5, "{single} {ratios}");
}

#[test]
fn rough_diffuse_light_matches_adobe() {
    let file = read("ndf/open_pbr.json");
    let mut worst = 0.0_f32;
    for item in file["diffuse"].as_array().expect("an array") {
        let eon = EnergyPreservingOrenNayar::new(vec3(item, "albedo"), number(item, "roughness"));
        let value = eon.expect(VALID).eval(vec3(item, "wo"), vec3(item, "wi"));
        worst = worst.max(apart(value, vec3(item, "f")));
    }
    println!("{worst:e}");
    assert!(worst < 1e-5, "{worst}");
}

/// The formula of the specification: eq. 65 to 71 of OpenPBR 1.1, from mean Fresnel reflectances.
fn darkening(item: &Value, mean: impl Fn(f32) -> f32) -> Vec3 {
    let (coat, relative) =
        (number(item, "coat_ior"), number(item, "specular_ior") / number(item, "coat_ior"));
    let specular = mean(relative.max(1.0 / relative));
    let rough = 1.0 + (number(item, "roughness") - 1.0) * specular;
    let inner = 1.0 - (1.0 - mean(coat)) / (coat * coat);
    let k = mean(coat) + rough * (inner - mean(coat));
    let base = vec3(item, "base_color") * (1.0 - specular) + specular;
    (1.0 - k) / (Vec3::ONE - base * k)
}

#[test]
fn coats_darken_like_those_of_adobe_but_for_the_mean_reflectance() {
    let file = read("ndf/open_pbr.json");
    let (wo, wi) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.0, -0.28, 0.96));
    let (mut formula, mut ours) = (0.0_f32, 0.0_f32);
    for item in file["darkening"].as_array().expect("an array") {
        // Their fit of the mean, after Kulla and Conty 2017, is off by up to 0.007; ours is exact.
        let fit = |index: f32| (index - 1.0) / (4.085_67 + 1.000_71 * index);
        formula = formula.max(apart(darkening(item, fit), vec3(item, "delta")));
        let p = OpenPbrParameters {
            base_color: vec3(item, "base_color"),
            specular_roughness: number(item, "roughness"),
            specular_ior: number(item, "specular_ior"),
            coat_weight: 1.0,
            coat_ior: number(item, "coat_ior"),
            ..Default::default()
        };
        let black = OpenPbrParameters { base_weight: 0.0, specular_weight: 0.0, ..p };
        let coat = open_pbr(black).eval(wo, wi);
        let [plain, dark] =
            [0.0, 1.0].map(|coat_darkening| open_pbr(OpenPbrParameters { coat_darkening, ..p }).eval(wo, wi));
        let mean = |index: f32| Dielectric::new(index).expect(VALID).mean_reflectance_rgb().x;
        ours = ours.max(apart((dark - coat) / (plain - coat), darkening(item, mean)));
    }
    println!("formula {formula:e}, ours {ours:e}");
    assert!(formula < 1e-6 && ours < 1e-5, "{formula} {ours}");
}
