//! Time per call of NDFs: maps, sampling, Λ, visible normals, lookups, and construction of a table.

mod each;

use std::hint::black_box;

use asperity_ndf_sampling::glam::{Vec2, Vec3};
use asperity_ndf_sampling::{
    AshikhminShirley, BatchError, Beckmann, BlinnPhong, ConditionalTable, Frame, GaussianSplit, Ggx,
    Isotropic, Masked, Microfacet, Mixture, Ndf, NdfMap, NormalLut, Radial, Reconstruction, StudentT,
    VisibleFacets, VisibleWarp, gaussian_cdf, inverse_gaussian_cdf,
    normal_table::{Spacing, TableLayout},
    residual_ndf,
};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

use each::each;

/// Gaussian coordinates of these numbers.
fn coordinates() -> Vec<Vec2> {
    let gaussian = |u: f32| inverse_gaussian_cdf(f64::from(u) + 1e-8) as f32;
    uniforms().iter().map(|u| Vec2::new(gaussian(u.x), gaussian(u.y))).collect()
}

/// Uniform numbers without a pattern that a branch predictor could learn.
fn uniforms() -> Vec<Vec2> {
    let uniform = |k: u32| (k.wrapping_mul(0x9E37_79B9) >> 8) as f32 / 16_777_216.0;
    (0..1024).map(|k| Vec2::new(uniform(2 * k), uniform(2 * k + 1))).collect()
}

/// Views over the whole hemisphere.
fn views() -> Vec<Vec3> {
    let diffuse = BlinnPhong::new(0.0).expect("an exponent");
    uniforms().into_iter().map(|u| diffuse.sample(u)).collect()
}

fn maps(c: &mut Criterion, name: &str, ndf: impl Ndf) {
    let uniforms = uniforms();
    let normals: Vec<Vec3> = uniforms.iter().map(|&u| ndf.sample(u)).collect();
    let coordinates: Vec<Vec2> = normals.iter().map(|&m| ndf.invert(m)).collect();
    each(c, &format!("density/{name}"), &normals, |m| ndf.d(m));
    each(c, &format!("warp_gaussian/{name}"), &coordinates, |z| ndf.warp_gaussian(z));
    each(c, &format!("invert/{name}"), &normals, |m| ndf.invert(m));
    each(c, &format!("sample/{name}"), &uniforms, |u| ndf.sample(u));
}

fn masking(c: &mut Criterion, name: &str, ndf: impl Microfacet) {
    let (uniforms, views) = (uniforms(), views());
    let pairs: Vec<(Vec3, Vec2)> = views.iter().copied().zip(uniforms.iter().rev().copied()).collect();
    each(c, &format!("lambda/{name}"), &views, |v| ndf.lambda(v));
    each(c, &format!("sample_visible/{name}"), &pairs, |(v, u)| ndf.sample_visible(v, u));
    each(c, &format!("sample_reflecting/{name}"), &pairs, |(v, u)| ndf.sample_reflecting(v, u));
    maps(c, name, ndf);
}

/// Maps of visible normals, and their density where a part of the bumps is resolved.
fn seen(c: &mut Criterion, name: &str, ndf: impl VisibleWarp) {
    let pairs: Vec<(Vec3, Vec2)> = views().into_iter().zip(coordinates()).collect();
    let normals: Vec<(Vec3, Vec3)> = pairs.iter().map(|&(v, z)| (v, ndf.warp_visible(v, z))).collect();
    each(c, &format!("warp_visible/{name}"), &pairs, |(v, z)| ndf.warp_visible(v, z));
    each(c, &format!("invert_visible/{name}"), &normals, |(v, m)| ndf.invert_visible(v, m));
    each(c, &format!("visible_facets/{name}"), &normals, |(v, m)| {
        VisibleFacets::new(&ndf, v, Vec2::new(0.3, -0.8), 0.75).d(m)
    });
}

fn visible(c: &mut Criterion) {
    seen(c, "ggx", Ggx::new(0.2, 0.4).expect("a roughness"));
    seen(c, "beckmann", Beckmann::new(0.2, 0.4).expect("a roughness"));
    let map = NdfMap::from_ndf(128, 128, Reconstruction::Bilinear, &Ggx::new(0.2, 0.4).expect("a roughness"));
    seen(c, "map_128", Masked::new(map.expect("a density")));
    seen(c, "student_t", StudentT::new(0.2, 0.4, 3.0).expect("an exponent"));
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
    let table = Isotropic::from_fn(256, |cos| ggx.d(Vec3::new((1.0 - cos * cos).sqrt(), 0.0, cos)));
    maps(c, "isotropic_256", table.expect("a density"));
}

fn tabulated(c: &mut Criterion) {
    let ggx = Ggx::new(0.2, 0.4).expect("a roughness");
    let map = NdfMap::from_ndf(256, 256, Reconstruction::Constant, &ggx).expect("a density");
    for (name, ndf) in [("ggx", &ggx as &dyn Ndf), ("map_256", &map)] {
        let normals: Vec<Vec3> = uniforms().iter().map(|&u| ndf.sample(u)).collect();
        each(c, &format!("conditional_density/{name}"), &normals, |h| {
            residual_ndf(ndf, h, Vec2::new(0.3, -0.8), 0.75)
        });
    }
    maps(c, "map_256", map);
}

fn look_ups(c: &mut Criterion) {
    let coordinates = coordinates();
    let ggx = Ggx::new(0.2, 0.4).expect("roughness in range");
    let table = NormalLut::standard(&ggx);
    let normals: Vec<Vec3> = coordinates.iter().map(|&z| ggx.warp_gaussian(z)).collect();
    each(c, "normal_table/nearest", &coordinates, |z| table.nearest(z));
    each(c, "normal_table/bilinear", &coordinates, |z| table.bilinear(z));
    let seen = ConditionalTable::new(&ggx, 256).expect("size in range");
    let split = GaussianSplit::new(Vec2::new(0.3, -0.8), 0.75);
    each(c, "conditional_density/table", &normals, |h| seen.view().residual_ndf(h, split));
    each(c, "frame/from_normal", &normals, Frame::from_normal);
    each(c, "phi", &coordinates, |z| gaussian_cdf(f64::from(z.x)));
    let uniforms: Vec<f64> = coordinates.iter().map(|z| gaussian_cdf(f64::from(z.x))).collect();
    each(c, "inverse_gaussian_cdf", &uniforms, inverse_gaussian_cdf);
}

/// Fills arrays of normals from arrays of coordinates.
type LookUp<'a> = dyn Fn([&[f32]; 2], [&mut [f32]; 3]) -> Result<(), BatchError> + 'a;

/// Elements per second are normals per second. The target is 10⁸.
fn look_ups_of_many(c: &mut Criterion) {
    let coordinates = coordinates();
    let (z1, z2): (Vec<f32>, Vec<f32>) = coordinates.iter().map(|z| (z.x, z.y)).unzip();
    let mut normals = [(); 3].map(|()| vec![0.0; coordinates.len()]);
    let ggx = Ggx::new(0.2, 0.4).expect("roughness in range");
    let table = NormalLut::standard(&ggx);
    let layout = TableLayout { spacing: Spacing::Warped, ..TableLayout::default() };
    let warped = NormalLut::with_layout(&ggx, 256, layout).expect("size in range");
    let halves = table.halves();
    let halves = NormalLut::from_entries(256, table.layout(), &halves).expect("size in range");
    let mut group = c.benchmark_group("normals_of_many");
    group.throughput(Throughput::Elements(coordinates.len() as u64));
    let mut bench = |name: &str, look_up: &LookUp<'_>| {
        group.bench_function(name, |b| {
            b.iter(|| {
                let [x, y, z] = &mut normals;
                look_up(black_box([&z1, &z2]), [x, y, z])
            });
        });
    };
    bench("nearest", &|z, n| table.view().nearest_normals(z, n));
    bench("bilinear", &|z, n| table.view().bilinear_normals(z, n));
    bench("bilinear/warped", &|z, n| warped.view().bilinear_normals(z, n));
    bench("bilinear/half", &|z, n| halves.bilinear_normals(z, n));
    group.finish();
}

fn construction(c: &mut Criterion) {
    let ggx = Ggx::new(0.2, 0.4).expect("roughness in range");
    let mut group = c.benchmark_group("build");
    group.sample_size(10);
    group.bench_function("normal_table_256", |b| b.iter(|| NormalLut::standard(black_box(&ggx))));
    group.finish();
}

criterion_group!(benches, parametric, visible, composed, tabulated, look_ups, look_ups_of_many, construction);
criterion_main!(benches);
