//! Time per pixel of each material, near and far, of each texture, and per value of each BRDF.

use std::hint::black_box;

use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::level_of_detail::ResolvedBumps;
use asperity_shading::material::{BrickWall, BumpMappedBrdf, GlintField, Material};
use asperity_shading::noise::{FbmSpectrum, GaussianFbm, GaussianNoise};
use asperity_shading::reflectance::{
    BlinnPhongBrdf, BlinnPhongNormalization, CharlieSheen, EnergyCompensated, FacetBrdf, OrenNayar,
    OrenNayarVariant, WardBrdf, WardNormalization, ZeltnerFuzz,
};
use asperity_shading::texture::{Gas, StarWallpaper};
use asperity_shading::{
    Beckmann, Brdf, Brick, BumpField, Carpet, CarpetParameters, CookTorrance, Dielectric,
    EnergyPreservingOrenNayar, Footprint, Frame, Ggx, Lambert, Marble, MetallicPaint,
    MetallicPaintParameters, OpenPbr, OpenPbrParameters, Phong, PixelEllipse, Scratches, ScratchesParameters,
    StandardMaterial, StandardMaterialParameters, SurfacePoint, TemperedGlass, TemperedGlassParameters,
    TorranceSparrow, Variations, VariationsParameters,
};
use criterion::{Criterion, criterion_group, criterion_main};

/// Points of a plane, a different one for each call.
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
        time("glints", &|p| glints.density(h, p.position, p.footprint()));
        for ratio in [1.0, 4.0, 16.0] {
            let pixel = PixelEllipse::aligned(Vec2::new(width * ratio, width));
            time(&format!("glints_{ratio}_to_1"), &|p| glints.density_over(h, 0.0, p.position, &pixel));
        }
        let round = PixelEllipse::from(Footprint::from_width(width));
        time("glints_area_light", &|p| glints.density_over(h, 0.1, p.position, &round));
        time("glints_sample", &|p| glints.sample(p.uv.fract(), p.position, &round).x);
        let materials: [(&str, &dyn Material); 6] = [
            ("carpet", &carpet),
            ("paint", &paint),
            ("glass", &glass),
            ("variations", &varied),
            ("scratches", &scratches),
            ("bricks", &BrickWall::default()),
        ];
        let (wi, wo) = (Vec3::new(2.0, -3.0, 6.0) / 7.0, Vec3::new(-0.6, 0.0, 0.8));
        for (name, material) in materials {
            time(&format!("bsdf_{name}"), &|p| material.bsdf(p, wo).emitted().x);
            time(&format!("bsdf_value_{name}"), &|p| material.bsdf(p, wo).eval_cos(wo, wi).x);
        }
    }
}

fn textures(c: &mut Criterion) {
    let (wall, stars, marble, gas) =
        (Brick::default(), StarWallpaper::default(), Marble::default(), Gas::default());
    let mut k = 0.0;
    let mut time = |name: &str, f: &dyn Fn(&SurfacePoint) -> f32| {
        c.bench_function(&format!("texture/{name}"), |b| b.iter(|| f(black_box(&point(&mut k, 1e-3)))));
    };
    time("brick", &|p| wall.sample(p.uv).height);
    time("brick_filtered", &|p| wall.filtered(p.uv, PixelEllipse::aligned(Vec2::splat(0.03))).height);
    time("star_wallpaper", &|p| stars.coverage(p.uv, Footprint::from_width(0.01)));
    time("marble", &|p| marble.color(p.position, p.footprint()).x);
    time("gas", &|p| gas.density(p.position));
}

fn reflectances(c: &mut Criterion) {
    let gray = Vec3::splat(0.5);
    let ggx = Ggx::new(0.2, 0.4).expect("roughness in range");
    let glass = Dielectric::new(1.5).expect("index in range");
    let lobe = BlinnPhongBrdf::new(gray, 30.0, BlinnPhongNormalization::Albedo).expect("parameters in range");
    let ward = WardBrdf::new(gray, 0.2, 0.4, WardNormalization::Bounded).expect("parameters in range");
    let full = OrenNayar::new(gray, 0.6, OrenNayarVariant::Full).expect("parameters in range");
    let metal = EnergyCompensated::metal(ggx, glass);
    let frosted = EnergyCompensated::glass(ggx, glass);
    let all: [(&str, &dyn Brdf); 13] = [
        ("lambert", &Lambert::new(gray).expect("albedo in range")),
        ("oren_nayar_full", &full),
        ("energy_preserving", &EnergyPreservingOrenNayar::new(gray, 0.6).expect("parameters in range")),
        ("cook_torrance", &CookTorrance::new(ggx, glass)),
        ("cook_torrance_compensated", &metal),
        ("rough_dielectric", frosted.single()),
        ("rough_dielectric_compensated", &frosted),
        ("zeltner_fuzz", &ZeltnerFuzz::new(gray, 0.3).expect("parameters in range")),
        ("charlie_sheen", &CharlieSheen::new(gray, 0.3).expect("parameters in range")),
        ("torrance_sparrow", &TorranceSparrow::new(ggx, glass)),
        ("phong", &Phong::new(gray, 30.0).expect("parameters in range")),
        ("blinn_phong", &lobe),
        ("ward", &ward),
    ];
    let (wi, wo) = (Vec3::new(2.0, -3.0, 6.0) / 7.0, Vec3::new(-0.6, 0.0, 0.8));
    for (name, brdf) in all {
        c.bench_function(&format!("value/{name}"), |b| b.iter(|| brdf.eval(black_box(wo), black_box(wi))));
    }
}

/// The standard materials from afar, on resolved bumps, and with bumps of a field.
fn standard_materials(c: &mut Criterion) {
    let plastic = StandardMaterialParameters {
        base_color: Vec3::new(0.6, 0.2, 0.1),
        metallic: 0.0,
        roughness: 0.5,
        ..Default::default()
    };
    let varnished = StandardMaterialParameters { clearcoat: 1.0, clearcoat_roughness: 0.2, ..plastic };
    let all = StandardMaterialParameters {
        metallic: 0.3,
        sheen_color: Vec3::splat(0.3),
        sheen_roughness: 0.5,
        transmission: 0.5,
        thickness: 1.0,
        anisotropy: 0.5,
        ..varnished
    };
    let open_pbr = OpenPbrParameters { coat_weight: 0.5, fuzz_weight: 0.5, ..Default::default() };
    let gltf = |p| StandardMaterial::new(p).expect("parameters in range");
    let metal = gltf(StandardMaterialParameters { metallic: 1.0, ..plastic });
    let all: [(&str, &dyn FacetBrdf); 5] = [
        ("metal", &metal),
        ("plastic", &gltf(plastic)),
        ("varnished", &gltf(varnished)),
        ("all", &gltf(all)),
        ("open_pbr", &OpenPbr::new(open_pbr).expect("parameters in range")),
    ];
    let (wi, wo) = (Vec3::new(2.0, -3.0, 6.0) / 7.0, Vec3::new(-0.6, 0.0, 0.8));
    let near = ResolvedBumps { z: Vec2::new(0.8, -0.3), variance: 0.75, blend: 1.0 };
    for (name, material) in all {
        for (place, bumps) in [("far", ResolvedBumps::FAR), ("near", near)] {
            c.bench_function(&format!("standard/{name}/{place}/value"), |b| {
                b.iter(|| black_box(material).eval_resolved(black_box(wo), black_box(wi), black_box(bumps)));
            });
            c.bench_function(&format!("standard/{name}/{place}/sample"), |b| {
                let mut k = 0.0;
                b.iter(|| {
                    k = (k + 0.618_034) % 1.0;
                    black_box(material).sample_resolved(black_box(wo), k, Vec2::new(k, 0.3), black_box(bumps))
                });
            });
        }
    }
    // With bumps at every octave that the pixel resolves: exact, and by a tilted normal.
    let noise = GaussianFbm::new(GaussianNoise::new(1), FbmSpectrum::default());
    let bumps = BumpField::new(noise, 40.0).expect("a frequency");
    for (name, p) in [("metal", *metal.parameters()), ("plastic", plastic), ("varnished", varnished)] {
        let material = gltf(p);
        let exact = BumpMappedBrdf { brdf: material, bumps };
        let alpha = p.roughness * p.roughness * core::f32::consts::FRAC_1_SQRT_2;
        let mut k = 0.0;
        c.bench_function(&format!("standard/{name}/bumps_exact"), |b| {
            b.iter(|| exact.bsdf(black_box(&point(&mut k, 1e-3)), wo).eval_cos(wo, wi));
        });
        c.bench_function(&format!("standard/{name}/bumps_tilted"), |b| {
            b.iter(|| {
                let point = black_box(point(&mut k, 1e-3));
                let frame = point.frame();
                let z = bumps.coordinates(point.position, &frame, point.footprint()).z;
                let normal = frame.to_world(Vec3::new(alpha * z.x, alpha * z.y, 1.0).normalize());
                let tilted = Frame::from_normal_tangent(normal, frame.tangent);
                material.bsdf_at(tilted, wo, ResolvedBumps::FAR).eval_cos(wo, wi)
            });
        });
    }
    c.bench_function("standard/new", |b| b.iter(|| StandardMaterial::new_clamped(black_box(plastic))));
}

criterion_group!(benches, materials, textures, reflectances, standard_materials);
criterion_main!(benches);
