//! Time per pixel of each material, near and far.

use std::hint::black_box;

use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::{
    Beckmann, Carpet, CarpetParameters, Footprint, GlintField, MetallicPaint, MetallicPaintParameters,
    Scratches, ScratchesParameters, SurfacePoint, TemperedGlass, TemperedGlassParameters, Variations,
    VariationsParameters,
};
use criterion::{Criterion, criterion_group, criterion_main};

/// Points of a plane, another one at each call.
fn point(k: &mut f32, width: f32) -> SurfacePoint {
    *k = (*k + 1.0) % 1024.0;
    let uv = Vec2::new(0.0137, 0.0211) * *k;
    SurfacePoint::new(uv.extend(0.3), Vec3::Z, Footprint::from_width(width)).with_uv(uv, [Vec3::X, Vec3::Y])
}

fn materials(c: &mut Criterion) {
    let carpet = Carpet::new(CarpetParameters::default()).expect("parameters in range");
    let paint = MetallicPaint::new(MetallicPaintParameters::default()).expect("parameters in range");
    let glass = TemperedGlass::new(TemperedGlassParameters::default()).expect("parameters in range");
    let varied = Variations::new(VariationsParameters::default()).expect("parameters in range");
    let scratches = Scratches::new(ScratchesParameters::default()).expect("parameters in range");
    let ndf = Beckmann::isotropic(0.3).expect("roughness in range");
    let glints = GlintField::new(ndf, 1e-3, 0.1, 1).expect("parameters in range");
    let h = Vec3::new(0.2, 0.1, 1.0).normalize();
    for (distance, width) in [("near", 1e-5), ("between", 2e-3), ("far", 10.0)] {
        let mut k = 0.0;
        let mut time = |name: &str, f: &dyn Fn(&SurfacePoint) -> f32| {
            c.bench_function(&format!("{name}/{distance}"), |b| {
                b.iter(|| f(black_box(&point(&mut k, width))));
            });
        };
        time("carpet", &|p| carpet.surface(p, Vec3::Z).diffuse.x);
        time("paint", &|p| paint.surface(p).coat_normal.x);
        time("glints", &|p| glints.density(h, p.position, p.footprint));
        time("glass", &|p| glass.surface(p).normal.x);
        time("variations", &|p| varied.surface(p).normal.x);
        time("scratches", &|p| scratches.surface(p).amount);
    }
}

criterion_group!(benches, materials);
criterion_main!(benches);
