//! Pinned values of the parametric densities, in `tests/data/ndf/golden_facets.json`: a change is
//! value-breaking.
//!
//! Values are pinned to a few units in the last place, like the values of the other densities.

use asperity_ndf_sampling::{
    AshikhminShirley, Beckmann, Blend, BlinnPhong, Ggx, Isotropic, Microfacet, Mixture, Ndf, Radial, Rotated,
    StudentT, Ward,
};
use asperity_tests::pinned::{Numbers, pinned};
use asperity_tests::reference::{self, numbers};
use glam::{Vec2, Vec3};

use super::golden::{Z, direction};

const U: Vec2 = Vec2::new(0.3, 0.8);
const V: Vec3 = Vec3::new(0.8, -0.36, 0.48);
/// A few units in the last place of `f32`, after several steps.
const TOLERANCE: f64 = 3e-6;

fn within<const N: usize>(what: &str, got: impl Numbers<N>, expected: [f64; N]) {
    pinned(what, got.numbers(), expected, TOLERANCE);
}

/// Compares with the numbers of the file.
fn stated<const N: usize>(what: &str, name: &str, got: [f32; N]) {
    let file = reference::read("ndf/golden_facets.json");
    let expected = numbers(&file[what][name]).try_into().expect("as many numbers");
    within(&format!("{what} of {name}"), got, expected);
}

/// `D`, the density of slopes, `T`, `T⁻¹` and a sample.
fn maps(name: &str, ndf: &dyn Ndf) {
    let (h, m, z, s) = (direction(), ndf.warp_gaussian(Z), ndf.invert(direction()), ndf.sample(U));
    let densities = [ndf.d(h), ndf.slope_density(Vec2::new(0.3, -0.4)), ndf.pdf(h)];
    let [density, slopes, sample] = densities;
    stated("maps", name, [density, slopes, sample, m.x, m.y, m.z, z.x, z.y, s.x, s.y, s.z]);
}

/// Λ, σ, G₁, both G₂, a visible normal and its density.
fn masking(name: &str, ndf: &dyn Microfacet) {
    let (w, m) = (Vec3::new(-0.6, 0.0, 0.8), ndf.sample_visible(V, U));
    let areas = [ndf.lambda(V), ndf.projected_area(V), ndf.g1(V), ndf.g2(V, w), ndf.g2_separable(V, w)];
    let [lambda, area, g1, g2, separable] = areas;
    let visible = ndf.visible_pdf(V, direction());
    stated("masking", name, [lambda, area, g1, g2, separable, m.x, m.y, m.z, visible]);
}

#[test]
fn parametric_densities() {
    let (ggx, beckmann) = (Ggx::new(0.2, 0.4).unwrap(), Beckmann::new(0.2, 0.4).unwrap());
    let (diffuse, isotropic) = (BlinnPhong::new(0.0).unwrap(), Beckmann::isotropic(0.3).unwrap());
    let ndfs: [(&str, &dyn Microfacet); 6] = [
        ("StudentT", &StudentT::new(0.2, 0.4, 3.0).unwrap()),
        ("Ward", &Ward::new(0.2, 0.4).unwrap()),
        ("BlinnPhong", &BlinnPhong::new(20.0).unwrap()),
        ("AshikhminShirley", &AshikhminShirley::new(50.0, 10.0).unwrap()),
        ("Rotated", &Rotated::new(ggx, 0.7).unwrap()),
        ("Mixture", &Mixture::new(isotropic, diffuse, 0.7).unwrap()),
    ];
    for (name, ndf) in ndfs {
        maps(name, &ndf);
        masking(name, ndf);
    }
    masking("Ggx", &ggx);
    masking("Beckmann", &beckmann);
    let converted =
        [BlinnPhong::from_roughness(0.3).unwrap().exponent(), BlinnPhong::new(20.0).unwrap().roughness()];
    within("conversions", converted, [20.222_221, 0.301_511_35]);
    within("Ward::lobe", Ward::new(0.2, 0.4).unwrap().lobe(direction()), [0.012_964_068]);
}

#[test]
fn composed_densities() {
    let table = Isotropic::new(&[0.1, 0.5, 0.4, 2.0, 9.0]).unwrap();
    maps("Isotropic", &table);
    within("Radial::exponent", [table.exponent(0.7).unwrap()], [1.286_901_8]);
    let blend = Blend::new(Ggx::new(0.2, 0.4).unwrap(), Beckmann::new(0.5, 0.1).unwrap(), 0.3).unwrap();
    let h = direction();
    let areas = [blend.d(h), blend.lambda(V), blend.projected_area(V), blend.visible_pdf(V, h)];
    within("Blend", areas, [0.077_542_68, 0.022_148_935, 0.490_631_46, 0.125_534_24]);
    within("Blend::sample", blend.sample(U), [-0.0, 0.0, 1.0]);
    let seen = blend.sample_visible(V, U);
    within("Blend::sample_visible", seen, [0.481_895_71, -0.341_391_18, 0.806_987_35]);
}
