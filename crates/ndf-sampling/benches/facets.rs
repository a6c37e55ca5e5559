//! Time per call of the parametric densities: density, maps, sampling, Λ and visible normals.

mod each;

use asperity_ndf_sampling::glam::{Vec2, Vec3};
use asperity_ndf_sampling::{
    AshikhminShirley, Beckmann, BlinnPhong, Ggx, Isotropic, Microfacet, Mixture, Ndf, Radial, StudentT,
};
use criterion::{Criterion, criterion_group, criterion_main};

use each::each;

/// Uniform numbers without a pattern that a branch predictor could learn.
fn uniforms() -> Vec<Vec2> {
    let uniform = |k: u32| (k.wrapping_mul(0x9E37_79B9) >> 8) as f32 / 16_777_216.0;
    (0..1024).map(|k| Vec2::new(uniform(2 * k), uniform(2 * k + 1))).collect()
}

/// Views all over the hemisphere.
fn views() -> Vec<Vec3> {
    let diffuse = BlinnPhong::new(0.0).expect("an exponent");
    uniforms().into_iter().map(|u| diffuse.sample(u)).collect()
}

fn maps(c: &mut Criterion, name: &str, ndf: impl Ndf) {
    let uniforms = uniforms();
    let normals: Vec<Vec3> = uniforms.iter().map(|&u| ndf.sample(u)).collect();
    let coordinates: Vec<Vec2> = normals.iter().map(|&m| ndf.to_gaussian(m)).collect();
    each(c, &format!("density/{name}"), &normals, |m| ndf.density(m));
    each(c, &format!("from_gaussian/{name}"), &coordinates, |z| ndf.from_gaussian(z));
    each(c, &format!("to_gaussian/{name}"), &normals, |m| ndf.to_gaussian(m));
    each(c, &format!("sample/{name}"), &uniforms, |u| ndf.sample(u));
}

fn masking(c: &mut Criterion, name: &str, ndf: impl Microfacet) {
    let (uniforms, views) = (uniforms(), views());
    let pairs: Vec<(Vec3, Vec2)> = views.iter().copied().zip(uniforms.iter().rev().copied()).collect();
    each(c, &format!("lambda/{name}"), &views, |v| ndf.lambda(v));
    each(c, &format!("sample_visible/{name}"), &pairs, |(v, u)| ndf.sample_visible(v, u));
    maps(c, name, ndf);
}

fn parametric(c: &mut Criterion) {
    masking(c, "ggx", Ggx::new(0.2, 0.4).expect("a roughness"));
    masking(c, "beckmann", Beckmann::new(0.2, 0.4).expect("a roughness"));
    masking(c, "student_t", StudentT::new(0.2, 0.4, 3.0).expect("an exponent"));
    masking(c, "blinn_phong", BlinnPhong::new(50.0).expect("an exponent"));
    masking(c, "ashikhmin_shirley", AshikhminShirley::new(1000.0, 20.0).expect("an exponent"));
}

fn composed(c: &mut Criterion) {
    let ggx = Ggx::isotropic(0.1).expect("a roughness");
    let diffuse = BlinnPhong::new(0.0).expect("an exponent");
    let mixture = Mixture::new(ggx, diffuse, 0.3).expect("radial densities");
    each(c, "exponent/mixture", &[0.01, 0.1, 1.0], |slope| mixture.exponent(slope));
    masking(c, "mixture", mixture);
    let table = Isotropic::from_fn(256, |cos| ggx.density(Vec3::new((1.0 - cos * cos).sqrt(), 0.0, cos)));
    maps(c, "isotropic_256", table.expect("a density"));
}

criterion_group!(benches, parametric, composed);
criterion_main!(benches);
