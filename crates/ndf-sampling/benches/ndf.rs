//! Time per call of the densities, their maps and look-ups, and of building the tables.

mod each;

use std::hint::black_box;

use asperity_ndf_sampling::glam::{Vec2, Vec3};
use asperity_ndf_sampling::{
    BatchError, Beckmann, ConditionalTable, Frame, GaussianSplit, Ggx, Ndf, NdfMap, NormalTable,
    NormalTableRef, Reconstruction, conditional_density, inverse_phi,
    normal_table::{Spacing, TableLayout},
    phi,
};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

use each::each;

/// Gaussian coordinates without a pattern that a branch predictor could learn.
fn coordinates() -> Vec<Vec2> {
    let uniform = |k: u32| f64::from(k.wrapping_mul(0x9E37_79B9) >> 8) / f64::from(1 << 24) + 1e-8;
    (0..1024)
        .map(|k| Vec2::new(inverse_phi(uniform(2 * k)) as f32, inverse_phi(uniform(2 * k + 1)) as f32))
        .collect()
}

fn maps(c: &mut Criterion) {
    let coordinates = coordinates();
    let ggx = Ggx::new(0.2, 0.4).expect("roughness in range");
    let beckmann = Beckmann::new(0.2, 0.4).expect("roughness in range");
    let map = NdfMap::from_ndf(256, 256, Reconstruction::Constant, &ggx).expect("a density");
    let ndfs: [(&str, &dyn Ndf); 3] = [("ggx", &ggx), ("beckmann", &beckmann), ("map_256", &map)];
    for (name, ndf) in ndfs {
        let normals: Vec<Vec3> = coordinates.iter().map(|&z| ndf.from_gaussian(z)).collect();
        each(c, &format!("density/{name}"), &normals, |m| ndf.density(m));
        each(c, &format!("from_gaussian/{name}"), &coordinates, |z| ndf.from_gaussian(z));
        each(c, &format!("to_gaussian/{name}"), &normals, |m| ndf.to_gaussian(m));
        each(c, &format!("conditional_density/{name}"), &normals, |h| {
            conditional_density(ndf, h, Vec2::new(0.3, -0.8), 0.75)
        });
    }
}

fn look_ups(c: &mut Criterion) {
    let coordinates = coordinates();
    let ggx = Ggx::new(0.2, 0.4).expect("roughness in range");
    let table = NormalTable::standard(&ggx);
    let normals: Vec<Vec3> = coordinates.iter().map(|&z| ggx.from_gaussian(z)).collect();
    each(c, "normal_table/nearest", &coordinates, |z| table.nearest(z));
    each(c, "normal_table/bilinear", &coordinates, |z| table.bilinear(z));
    let seen = ConditionalTable::new(&ggx, 256).expect("size in range");
    let split = GaussianSplit::new(Vec2::new(0.3, -0.8), 0.75);
    each(c, "conditional_density/table", &normals, |h| seen.density(h, split));
    each(c, "frame/from_normal", &normals, Frame::from_normal);
    each(c, "phi", &coordinates, |z| phi(f64::from(z.x)));
    let uniforms: Vec<f64> = coordinates.iter().map(|z| phi(f64::from(z.x))).collect();
    each(c, "inverse_phi", &uniforms, inverse_phi);
}

/// Fills arrays of normals from arrays of coordinates.
type LookUp<'a> = dyn Fn([&[f32]; 2], [&mut [f32]; 3]) -> Result<(), BatchError> + 'a;

/// The elements per second are normals per second; 10⁸ are asked for.
fn look_ups_of_many(c: &mut Criterion) {
    let coordinates = coordinates();
    let (z1, z2): (Vec<f32>, Vec<f32>) = coordinates.iter().map(|z| (z.x, z.y)).unzip();
    let mut normals = [(); 3].map(|()| vec![0.0; coordinates.len()]);
    let ggx = Ggx::new(0.2, 0.4).expect("roughness in range");
    let table = NormalTable::standard(&ggx);
    let layout = TableLayout { spacing: Spacing::Warped, ..TableLayout::default() };
    let warped = NormalTable::with_layout(&ggx, 256, layout).expect("size in range");
    let halves = table.halves();
    let halves = NormalTableRef::new(256, table.layout(), &halves).expect("size in range");
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
    group.bench_function("map_256", |b| {
        b.iter(|| NdfMap::from_ndf(256, 256, Reconstruction::Constant, black_box(&ggx)));
    });
    group.bench_function("normal_table_256", |b| b.iter(|| NormalTable::standard(black_box(&ggx))));
    group.finish();
}

criterion_group!(benches, maps, look_ups, look_ups_of_many, construction);
criterion_main!(benches);
