//! BSDFs of all materials: public property tests, energy up to the horizon, reciprocity, and light
//! through coats.

use std::f32::consts::PI;

use asperity_shading::bump::bumped_normal;
use asperity_shading::check;
use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::level_of_detail::{BumpField, LevelOfDetail};
use asperity_shading::material::{
    BeveledTiles, BrickWall, BumpMapped, Carpet, CarpetParameters, GlassBody, Material, MetallicPaint,
    MetallicPaintParameters, NormalMapped, PaintFlakes, PolishedMarble, Scratches, ScratchesParameters,
    SurfacePoint, TemperedGlass, TemperedGlassParameters, Variations, VariationsParameters, Wallpaper,
};
use asperity_shading::ndf_sampling::{Beckmann, Frame, Ggx};
use asperity_shading::noise::{FbmSpectrum, GaussianFbm, GaussianNoise};
use asperity_shading::normal_map::SlopePyramid;
use asperity_shading::pixel::Footprint;
use asperity_shading::reflectance::{Brdf, Bsdf, Coat, Dielectric, Lambert};
use asperity_shading::texture::{Bevel, BevelParameters, Marble, StarWallpaper};
use asperity_tests::assert_abs_diff_eq;

use crate::checked::quick;
use crate::reflectance::{albedo, direction};

type Boxed = Box<dyn Material>;

/// Every material at maximum albedo, with the width of a pixel that resolves only some of it.
fn materials() -> Vec<(&'static str, Boxed, f32)> {
    const VALID: &str = "parameters in range";
    let white = Vec3::ONE;
    let carpet = CarpetParameters {
        diffuse: white,
        specular: Vec3::splat(0.5),
        diffuse_thread_bump_strength: 0.3,
        fake_rim_light: 0.0,
        ..Default::default()
    };
    let paint = MetallicPaintParameters {
        specular: Vec3::splat(0.9),
        pigment: white,
        orange_peel_strength: 0.1,
        passive_flake_strength: 0.0,
        flake_sparkle_elimination: 1.0,
        ..Default::default()
    };
    let rough = MetallicPaintParameters { coat_roughness: 0.2, ..paint };
    let glass = TemperedGlassParameters { wave_amplitude: 0.01, ..Default::default() };
    let rough_glass = TemperedGlassParameters { roughness: 0.3, ..glass };
    let panel = VariationsParameters {
        diffuse: white,
        specular: Vec3::splat(0.6),
        dent_strength: 0.3,
        ..Default::default()
    };
    let scratches = ScratchesParameters {
        specular: white,
        scratch_width: 0.05,
        scratch_strength: 1.0,
        ..Default::default()
    };
    let wall = BrickWall { clay: white, mortar: white, variation: 0.0, depth: 0.02, ..Default::default() };
    let bevel =
        Bevel::new(BevelParameters { plateau: 0.03, ridge: 0.2, top: 0.2, bottom: 0.9 }).expect(VALID);
    let tiles = BeveledTiles { bevel, side: 0.2, color: white, roughness: 0.5 };
    let stars = Wallpaper { stars: StarWallpaper::default(), paper: white, star: white, roughness: 0.0 };
    let marble = PolishedMarble { marble: Marble::default(), tint: Vec3::splat(100.0), polish: 0.3 };
    let field = GaussianFbm::<Vec3>::new(GaussianNoise::new(7), FbmSpectrum::new(2.17, 0.8, 3).expect(VALID));
    let bumps = |rule| BumpMapped {
        ndf: Ggx::new(0.3, 0.5).expect(VALID),
        bumps: BumpField::new(field, 20.0).expect(VALID),
        rule,
        color: white,
    };
    let ridges: Vec<Vec3> =
        (0..256).map(|k| Vec3::new(if k % 4 < 2 { 0.6 } else { -0.6 }, 0.0, 0.8)).collect();
    let map = Box::leak(Box::new(SlopePyramid::<4>::from_normals(16, 16, &ridges).expect(VALID)));
    let roughness = Beckmann::isotropic(0.3).expect(VALID);
    let mapped = NormalMapped { map: map.view(), roughness, color: white };
    vec![
        ("Lambert", Box::new(Lambert::new(white).expect(VALID)) as Boxed, 0.0),
        ("carpet", Box::new(Carpet::new(carpet).expect(VALID)), 4e-3),
        ("paint", Box::new(MetallicPaint::new(paint).expect(VALID)), 2e-3),
        ("paint, rough", Box::new(MetallicPaint::new(rough).expect(VALID)), 2e-3),
        ("glass", Box::new(TemperedGlass::new(glass).expect(VALID)), 0.1),
        ("glass, rough", Box::new(TemperedGlass::new(rough_glass).expect(VALID)), 0.1),
        ("variations", Box::new(Variations::new(panel).expect(VALID)), 3e-3),
        ("scratches", Box::new(Scratches::new(scratches).expect(VALID)), 5e-3),
        ("bricks", Box::new(wall), 0.05),
        ("tiles", Box::new(tiles), 0.1),
        ("wallpaper", Box::new(stars), 0.01),
        ("marble", Box::new(marble), 0.01),
        ("normal map", Box::new(mapped), 0.1),
        ("bumps, exact", Box::new(bumps(LevelOfDetail::Exact)), 0.01),
        ("bumps, fractal", Box::new(bumps(LevelOfDetail::Fractal)), 0.01),
    ]
}

fn point(at: Vec2, width: f32) -> SurfacePoint {
    SurfacePoint::new(at.extend(0.3), Vec3::Z, Footprint::from_width(width)).with_uv(at, [Vec3::X, Vec3::Y])
}

/// A BSDF of a surface whose frame is the world.
struct Flat<'a>(&'a Bsdf<'a>);

impl Brdf for Flat<'_> {
    fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        self.0.eval(wo, wi)
    }
}

/// Returns the albedo of the smooth coat, averaged over its facets.
fn coat(bsdf: &Bsdf<'_>, wo: Vec3) -> f64 {
    let sum: f32 = (0..256_u16)
        .map(|k| {
            let u = Vec2::new((f32::from(k % 16) + 0.5) / 16.0, (f32::from(k / 16) + 0.5) / 16.0);
            bsdf.specular_samples(wo, u).iter().flatten().map(|s| s.eval_cos.max_element()).sum::<f32>()
        })
        .sum();
    f64::from(sum) / 256.0
}

const PLACES: [Vec2; 3] = [Vec2::new(0.304, 0.17), Vec2::new(0.131, 0.292), Vec2::new(0.711, 0.053)];

#[test]
fn albedo_is_at_most_one() {
    for (name, material, width) in materials() {
        let mut most = [0.0_f64; 4];
        for (k, theta) in [0.05, 0.6, 1.2, 1.5].into_iter().enumerate() {
            let wo = direction(theta, 0.4);
            for (at, width) in PLACES.into_iter().zip([0.0, width, 100.0 * width]) {
                let bsdf = material.bsdf(&point(at, width), wo);
                let (coarse, fine) = (albedo(&Flat(&bsdf), wo, 48), albedo(&Flat(&bsdf), wo, 96));
                let all = fine + coat(&bsdf, wo);
                // The error of a second-order rule is a third of the difference.
                assert!(all - (fine - coarse).abs() <= 1.0 + 1e-5, "{name}, {theta}, {width}: {all}");
                most[k] = most[k].max(all);
            }
        }
        println!("{name}: {most:.4?}");
    }
}

#[test]
fn mean_albedo_of_counted_flakes_is_at_most_one() {
    let flakes = PaintFlakes::Counted { spacing: 1e-3, bin: 1.0 };
    let paint = MetallicPaintParameters {
        specular: Vec3::ONE,
        pigment: Vec3::ZERO,
        coat_index: 1.0,
        flakes,
        ..Default::default()
    };
    let paint = MetallicPaint::new(MetallicPaintParameters { passive_flake_strength: 0.0, ..paint }).unwrap();
    let wo = direction(0.5, 0.4);
    let places = (0..400_u16).map(|k| Vec2::new(f32::from(k) * 0.0173, f32::from(k) * 0.0291));
    let mean = places.map(|at| albedo(&Flat(&paint.bsdf(&point(at, 2e-3), wo)), wo, 24)).sum::<f64>() / 400.0;
    // The lobe of all flakes reflects 0.96. The mean of 400 points has a standard error of 0.01.
    assert_abs_diff_eq!(mean, 0.96, epsilon = 0.04);
}

#[test]
fn materials_pass_the_public_checks() {
    materials().into_iter().zip(0..).for_each(|((name, material, width), seed)| {
        let report = check::material(&material, &point(PLACES[1], width), quick(seed));
        assert!(report.passed(), "{name}\n{report}");
    });
}

#[test]
fn materials_without_tilted_facets_are_reciprocal() {
    let flat = ["Lambert", "wallpaper", "marble", "normal map", "bumps, exact", "bumps, fractal"];
    for (name, material, width) in materials().into_iter().filter(|(name, ..)| flat.contains(name)) {
        for (a, b) in [(0.2, 1.1), (0.9, 0.4), (1.4, 1.3)] {
            let (wi, wo) = (direction(a, 0.3), direction(b, 2.2));
            let there = material.bsdf(&point(PLACES[0], width), wo).eval(wo, wi);
            let back = material.bsdf(&point(PLACES[0], width), wi).eval(wi, wo);
            assert_abs_diff_eq!(there, back, epsilon = 2e-5 * there.max_element(), "{name}");
        }
    }
}

#[test]
fn coats_reflect_and_refract() {
    let wo = direction(0.7, 0.4);
    let u = Vec2::splat(0.3);
    let at = point(Vec2::ZERO, 0.0);
    let body = Coat::dielectric(Dielectric::new(1.5).unwrap());
    let bsdf = body.bsdf(&at, wo);
    let both = |bsdf: &Bsdf<'_>, wo| bsdf.specular_samples(wo, u).map(|sample| sample.expect("light"));
    let [mirrored, refracted] = both(&bsdf, wo);
    assert_abs_diff_eq!(mirrored.wi, Vec3::new(-wo.x, -wo.y, wo.z), epsilon = 1e-6);
    assert!((refracted.wi.truncate() + wo.truncate() / 1.5).length() < 1e-6 && refracted.wi.z < 0.0);
    assert_abs_diff_eq!(refracted.wi.length(), 1.0, epsilon = 1e-6);
    assert!((mirrored.eval_cos + refracted.eval_cos - Vec3::ONE).length() < 1e-6);
    // And back again from inside.
    let [_, back] = both(&bsdf, refracted.wi);
    assert!(
        (back.wi - wo).length() < 1e-5 && (back.eval_cos - refracted.eval_cos).length() < 1e-5,
        "{back:?}"
    );
    // Beyond the critical angle everything is reflected.
    let [inside, outside] = bsdf.specular_samples(Vec3::new(0.8, 0.0, -0.6), u);
    assert_eq!((inside.map(|sample| sample.eval_cos), outside), (Some(Vec3::ONE), None));
    // Waves tilt the reflection, and do not affect the straight view through a pane.
    let glass = TemperedGlassParameters { wave_amplitude: 0.01, body: GlassBody::Pane, ..Default::default() };
    let glass = TemperedGlass::new(glass).unwrap();
    let bsdf = glass.bsdf(&at, wo);
    let [tilted, straight] = both(&bsdf, wo);
    assert!((tilted.wi - mirrored.wi).length() > 0.1 && straight.wi == -wo, "{tilted:?}");
    assert_eq!(bsdf.eval(wo, mirrored.wi), Vec3::ZERO);
    // Where the pixel resolves none, random facets do.
    let far = glass.bsdf(&point(Vec2::ZERO, 100.0), wo);
    let [a, b] = [0.1, 0.4].map(|x| far.sample(wo, 0.0, Vec2::splat(x)).expect("a reflection").wi);
    assert!((a - b).length() > 0.1, "{a} {b}");
    for bad in [Vec3::ZERO, Vec3::X, Vec3::NAN] {
        assert_eq!(bsdf.specular_samples(bad, u), [None; 2]);
    }
}

/// Returns Gaussian slopes of deviation 1, from the centers of a subdivided unit square.
fn gaussian_slopes(rings: u16, sectors: u16) -> Vec<Vec2> {
    let at = |k: u16, n: u16| (f32::from(k) + 0.5) / f32::from(n);
    let ring = |i| (-2.0 * (1.0 - at(i, rings)).ln()).sqrt();
    let turn = |i: u16, j| 2.0 * PI * (at(j, sectors) + f32::from(i % 2) * 0.5 / f32::from(sectors));
    (0..rings).flat_map(|i| (0..sectors).map(move |j| ring(i) * Vec2::from_angle(turn(i, j)))).collect()
}

#[test]
fn unresolved_slopes_give_their_mean_reflection() {
    let glass = Dielectric::new(1.52).unwrap();
    let (metal, body, pane) =
        (Coat::conductor(Vec3::ONE), Coat::dielectric(glass), Coat::thin_dielectric(glass, Vec3::ONE));
    // The roughness and the deviation of the slopes, and the tolerance relative to the peak:
    // measured 0.2 % and 8 %.
    let cases = [
        ("metal", metal, [0.2, 0.105], 0.005),
        ("body", body, [0.2, 0.105], 0.005),
        ("pane", pane, [0.2, 0.105], 0.005),
        ("metal", metal, [0.05, 0.1], 0.1),
        ("body", body, [0.05, 0.1], 0.1),
    ];
    let slopes = gaussian_slopes(24, 48);
    for (name, coat, [alpha, deviation], bound) in cases {
        let coat = coat.rough(alpha);
        for wo in [Vec3::Z, direction(1.05, 0.3)] {
            let far = coat.bumped(Vec3::Z, deviation * deviation);
            let far = Bsdf::new(Frame::IDENTITY, wo).with_coat(far);
            let near: Vec<_> = slopes
                .iter()
                .map(|slope| bumped_normal(Vec3::Z, deviation * slope.extend(0.0)))
                .map(|normal| Bsdf::new(Frame::IDENTITY, wo).with_coat(coat.bumped(normal, 0.0)))
                .collect();
            // For reflection and for transmission.
            let (mut worst, mut peaks) = ([0.0_f32; 2], [0.0_f32; 2]);
            for (theta, phi) in (0..24_u8).flat_map(|i| (0..12_u8).map(move |j| (i, j))) {
                let [theta, phi] = [(f32::from(theta) + 0.5) / 24.0, f32::from(phi) / 6.0];
                let wi = direction(f64::from(theta * PI), f64::from(phi * PI));
                let mean = near.iter().map(|bsdf| bsdf.eval_cos(wo, wi).x).sum::<f32>() / near.len() as f32;
                let side = usize::from(wi.z < 0.0);
                worst[side] = worst[side].max((far.eval_cos(wo, wi).x - mean).abs());
                peaks[side] = peaks[side].max(mean);
            }
            println!("{name}, {alpha}, {wo:.1}: {:?}", [worst[0] / peaks[0], worst[1] / peaks[1]]);
            for (worst, peak) in worst.into_iter().zip(peaks) {
                assert!(worst <= bound * peak, "{name}, {alpha}, {wo}: {worst} of {peak}");
            }
        }
    }
}
