//! Materials measured at every zoom.

use asperity_shading::material::{BumpMapped, FibersParameters, GlassWaves, PaintFlakes, SeamPattern};
use asperity_shading::noise::{FbmSpectrum, GaussianFbm, GaussianNoise};
use asperity_shading::{
    BumpField, Carpet, CarpetParameters, Ggx, LevelOfDetail, MetallicPaint, MetallicPaintParameters,
    Scratches, ScratchesParameters, SurfacePoint, TemperedGlass, TemperedGlassParameters, Variations,
    VariationsParameters,
};
use glam::Vec3;

use crate::shaded::subject::Subject;

pub(super) const VALID: &str = "parameters in range";

/// A carpet of fibers without threads, dark areas and seams.
#[must_use]
pub fn fibers_alone() -> CarpetParameters {
    CarpetParameters {
        diffuse_thread_strength: 0.0,
        diffuse_thread_bump_strength: 0.0,
        specular_thread_strength: 0.0,
        dark_area_strength: 0.0,
        seams_pattern: SeamPattern::None,
        fiber_strength: 1.0,
        ..Default::default()
    }
}

/// Materials whose mean is the same at every zoom.
#[must_use]
pub fn materials() -> Vec<Subject> {
    let carpet =
        |name, width, parameters| Subject::of(name, width, Carpet::new(parameters).expect(VALID), |p| p);
    let (specular_roughness, fake_rim_light_color) = (0.4, Vec3::splat(0.1));
    let seamed = CarpetParameters { specular_roughness, fake_rim_light_color, ..Default::default() };
    let fibers = CarpetParameters {
        diffuse: Vec3::splat(0.5),
        fibers: FibersParameters { fiber_length: 0.04, ..Default::default() },
        fake_rim_light: 0.0,
        ..fibers_alone()
    };
    let paint =
        |name, parameters| Subject::of(name, 0.08, MetallicPaint::new(parameters).expect(VALID), |p| p);
    // Without coat, pigment, sparkles or passive flakes.
    let bare = MetallicPaintParameters {
        flake_sparkle_elimination: 1.0,
        passive_flake_strength: 0.0,
        pigment: Vec3::ZERO,
        coat_index: 1.0,
        coat_roughness: 0.2,
        ..Default::default()
    };
    let peel =
        MetallicPaintParameters { coat_index: 1.5, orange_peel_strength: 0.03, specular: Vec3::ZERO, ..bare };
    let passive = MetallicPaintParameters { passive_flake_strength: 0.3, flake_roughness: 0.3, ..bare };
    // Flakes are counted. Sparkles of a fixed width in pixels cover less of the surface in close
    // views.
    let counted = PaintFlakes::Counted { spacing: 4e-5, bin: 1.0 };
    let flakes = MetallicPaintParameters {
        specular: Vec3::splat(0.5),
        flakes: counted,
        flake_roughness: 0.6,
        seed: 3,
        ..bare
    };
    let whole = MetallicPaintParameters {
        orange_peel_strength: 0.03,
        flakes: counted,
        flake_roughness: 0.6,
        coat_roughness: 0.2,
        ..Default::default()
    };
    let glass = |name, waves| {
        let parameters = TemperedGlassParameters {
            waves,
            wave_amplitude: 0.003,
            wave_propagation_vector: Vec3::new(0.6, 0.8, 0.0),
            roughness: 0.2,
            ..Default::default()
        };
        Subject::of(name, 2.4, TemperedGlass::new(parameters).expect(VALID), |p| p)
    };
    let variations = Variations::new(VariationsParameters::default()).expect(VALID);
    let scratches = ScratchesParameters { scratch_width: 0.02, scratch_strength: 0.4, ..Default::default() };
    vec![
        carpet("carpet", 1.2, CarpetParameters { seams_pattern: SeamPattern::Lines, ..seamed }),
        carpet("carpet, grid", 1.2, CarpetParameters { seams_pattern: SeamPattern::Grid, ..seamed }),
        carpet("fibers", 0.2, fibers),
        paint("orange peel", peel),
        paint("passive flakes", passive),
        paint("flakes", flakes),
        paint("paint", whole),
        glass("glass", GlassWaves::Sine),
        glass("glass, noise", GlassWaves::Noise),
        Subject::of("variations", 0.8, variations, |p| p),
        Subject::of("scratches", 0.4, Scratches::new(scratches).expect(VALID), |p| p),
        bumps("bumps", LevelOfDetail::Exact),
    ]
}

/// Bumps by the paper's rule, whose mean depends on the zoom.
#[must_use]
pub fn fractal_bumps() -> Subject {
    bumps("bumps, fractal", LevelOfDetail::Fractal)
}

fn bumps(name: &'static str, rule: LevelOfDetail) -> Subject {
    let spectrum = FbmSpectrum::new(2.17, 0.8, 3).expect("three octaves");
    let bumps = BumpField::new(GaussianFbm::<Vec3>::new(GaussianNoise::new(7), spectrum), 20.0).expect(VALID);
    let material = BumpMapped { ndf: Ggx::new(0.3, 0.5).expect(VALID), bumps, rule, color: Vec3::ONE };
    // The mean over a pixel still shows octaves above its frequency limit.
    Subject::of(name, 0.8, material, |point| SurfacePoint { pixel: point.pixel.scaled(0.5), ..point })
}
