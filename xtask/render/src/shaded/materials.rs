//! Every material in its own light.

use asperity_shading::glam::Vec3;
use asperity_shading::material::{BumpMapped, GlassWaves, Material, PaintFlakes};
use asperity_shading::material::{FibresParameters, SeamPattern};
use asperity_shading::noise::{Gaussian, GaussianOctaves, Spectrum};
use asperity_shading::{
    BumpField, Carpet, CarpetParameters, Ggx, LevelOfDetail, MetallicPaint, MetallicPaintParameters,
    Scratches, ScratchesParameters, SurfacePoint, TemperedGlass, TemperedGlassParameters, Variations,
    VariationsParameters,
};

use crate::shaded::subject::Subject;

/// A subject of this material, of this unit: the mean over the taps of a pixel.
pub(super) fn subject(
    name: &'static str,
    width: f32,
    material: impl Material + Send + Sync + 'static,
    point: impl Fn(SurfacePoint) -> SurfacePoint + Send + Sync + 'static,
) -> Subject {
    Subject::new(name, width, move |pixel, sky| {
        pixel.over(|tap, footprint| {
            let bsdf = material.bsdf(&point(tap.point(footprint)), tap.view());
            sky.on(&bsdf, tap.view())
        })
    })
}

/// Every material whose mean is the same at every zoom.
#[must_use]
pub fn materials() -> Vec<Subject> {
    let plain =
        |name, width, material: Box<dyn Material + Send + Sync>| subject(name, width, material, |p| p);
    vec![
        plain("carpet", 1.2, carpet(SeamPattern::Lines)),
        plain("carpet, grid", 1.2, carpet(SeamPattern::Grid)),
        plain("fibres", 0.2, fibres()),
        plain("orange peel", 0.08, orange_peel()),
        plain("passive flakes", 0.08, passive_flakes()),
        plain("flakes", 0.08, flakes()),
        plain("paint", 0.08, paint()),
        plain("glass", 2.4, glass(GlassWaves::Sine)),
        plain("glass, noise", 2.4, glass(GlassWaves::Noise)),
        plain("variations", 0.8, Box::new(Variations::new(VariationsParameters::default()).expect(VALID))),
        plain("scratches", 0.4, scratches()),
        bumps("bumps", LevelOfDetail::Exact),
    ]
}

/// Bumps by the paper's rule, whose mean depends on the zoom.
#[must_use]
pub fn fractal_bumps() -> Subject {
    bumps("bumps, fractal", LevelOfDetail::Fractal)
}

pub(super) const VALID: &str = "parameters in range";

type Boxed = Box<dyn Material + Send + Sync>;

fn carpet(seams_pattern: SeamPattern) -> Boxed {
    let parameters = CarpetParameters {
        seams_pattern,
        specular_roughness: 0.4,
        fake_rim_light_colour: Vec3::splat(0.1),
        ..Default::default()
    };
    Box::new(Carpet::new(parameters).expect(VALID))
}

/// A carpet of nothing but fibres.
fn fibres() -> Boxed {
    let parameters = CarpetParameters {
        diffuse: Vec3::splat(0.5),
        diffuse_thread_strength: 0.0,
        diffuse_thread_bump_strength: 0.0,
        specular_thread_strength: 0.0,
        dark_area_strength: 0.0,
        seams_pattern: SeamPattern::None,
        fibre_strength: 1.0,
        fibres: FibresParameters { fibre_length: 0.04, ..Default::default() },
        fake_rim_light: 0.0,
        ..Default::default()
    };
    Box::new(Carpet::new(parameters).expect(VALID))
}

/// Paint without a coat, pigment, sparkles or passive flakes.
fn bare() -> MetallicPaintParameters {
    MetallicPaintParameters {
        flake_sparkle_elimination: 1.0,
        passive_flake_strength: 0.0,
        pigment: Vec3::ZERO,
        coat_index: 1.0,
        coat_roughness: 0.2,
        ..Default::default()
    }
}

fn painted(parameters: MetallicPaintParameters) -> Boxed {
    Box::new(MetallicPaint::new(parameters).expect(VALID))
}

fn orange_peel() -> Boxed {
    let coated = MetallicPaintParameters { coat_index: 1.5, orange_peel_strength: 0.03, ..bare() };
    painted(MetallicPaintParameters { specular: Vec3::ZERO, ..coated })
}

fn passive_flakes() -> Boxed {
    painted(MetallicPaintParameters { passive_flake_strength: 0.3, flake_roughness: 0.3, ..bare() })
}

const COUNTED: PaintFlakes = PaintFlakes::Counted { spacing: 4e-5, bin: 1.0 };

fn flakes() -> Boxed {
    let specular = Vec3::splat(0.5);
    painted(MetallicPaintParameters { specular, flakes: COUNTED, flake_roughness: 0.6, seed: 3, ..bare() })
}

/// Metallic paint, whose sparkles are counted: those of a fixed width in pixels have no mean that would not depend on the zoom.
fn paint() -> Boxed {
    painted(MetallicPaintParameters {
        orange_peel_strength: 0.03,
        flakes: COUNTED,
        flake_roughness: 0.6,
        coat_roughness: 0.2,
        ..Default::default()
    })
}

fn glass(waves: GlassWaves) -> Boxed {
    let parameters = TemperedGlassParameters {
        waves,
        wave_amplitude: 0.003,
        wave_propagation_vector: Vec3::new(0.6, 0.8, 0.0),
        roughness: 0.2,
        ..Default::default()
    };
    Box::new(TemperedGlass::new(parameters).expect(VALID))
}

fn scratches() -> Boxed {
    let parameters = ScratchesParameters { scratch_width: 0.02, scratch_strength: 0.4, ..Default::default() };
    Box::new(Scratches::new(parameters).expect(VALID))
}

fn bumps(name: &'static str, rule: LevelOfDetail) -> Subject {
    let spectrum = Spectrum::new(2.17, 0.8, 3).expect("three octaves");
    let bumps = BumpField::new(GaussianOctaves::<3>::new(Gaussian::new(7), spectrum), 20.0).expect(VALID);
    let material = BumpMapped { ndf: Ggx::new(0.3, 0.5).expect(VALID), bumps, rule, colour: Vec3::ONE };
    // The mean over a pixel still shows octaves above the limit of its frequency.
    subject(name, 0.8, material, |point| SurfacePoint { pixel: point.pixel.scaled(0.5), ..point })
}
