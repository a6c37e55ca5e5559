//! Every material, with its own reflectances.

use asperity_shading::glam::Vec3;
use asperity_shading::noise::{GaussianOctaves, Spectrum};
use asperity_shading::{
    Beckmann, Brdf, BumpField, Carpet, CarpetParameters, CookTorrance, EnergyPreservingOrenNayar, Fibres,
    FibresParameters, Footprint, Ggx, GlassWaves, GlintField, Lambert, LevelOfDetail, MetallicPaint,
    MetallicPaintParameters, Ndf, OrangePeel, PassiveFlakes, Schlick, Scratches, ScratchesParameters,
    SeamPattern, TemperedGlass, TemperedGlassParameters, Variations, VariationsParameters, half_vector,
    slope_facets,
};

use crate::shaded::light::{Both, on_facets};
use crate::shaded::{Pixel, Sky, Subject};

fn subject(
    name: &'static str,
    width: f32,
    radiance: impl Fn(&Pixel, Footprint, &Sky) -> Vec3 + Send + Sync + 'static,
) -> Subject {
    Subject::new(name, width, move |pixel, sky| pixel.over(|tap, footprint| radiance(tap, footprint, sky)))
}

/// Every material whose mean is the same at every zoom.
#[must_use]
pub fn materials() -> Vec<Subject> {
    vec![
        carpet("carpet", SeamPattern::Lines),
        carpet("carpet, grid", SeamPattern::Grid),
        fibres(),
        orange_peel(),
        passive_flakes(),
        flakes(),
        paint(),
        glass("glass", GlassWaves::Sine),
        glass("glass, noise", GlassWaves::Noise),
        variations(),
        scratches(),
        bumps("bumps", LevelOfDetail::Exact),
    ]
}

/// Bumps by the paper's rule, whose mean depends on the zoom.
#[must_use]
pub fn fractal_bumps() -> Subject {
    bumps("bumps, fractal", LevelOfDetail::Fractal)
}

const VALID: &str = "parameters in range";

fn gloss(alpha: f32, f0: Vec3) -> CookTorrance<Beckmann, Vec3> {
    CookTorrance::new(Beckmann::isotropic(alpha).expect(VALID), f0)
}

fn carpet(name: &'static str, seams_pattern: SeamPattern) -> Subject {
    let carpet = Carpet::new(CarpetParameters { seams_pattern, ..Default::default() }).expect(VALID);
    subject(name, 1.2, move |pixel, footprint, sky| {
        let surface = carpet.surface(&pixel.point(footprint), pixel.view());
        let threads = Both(surface.reflectance().expect(VALID), gloss(0.4, surface.specular));
        let facets = slope_facets(Vec3::Z, surface.normal, surface.slope_variance);
        on_facets(sky, &threads, facets, pixel.view()) + Vec3::splat(0.1 * surface.rim)
    })
}

fn fibres() -> Subject {
    let fibres = Fibres::new(FibresParameters { fibre_length: 0.04, ..Default::default() }).expect(VALID);
    let white = Lambert::new(Vec3::splat(0.5)).expect(VALID);
    subject("fibres", 0.2, move |pixel, footprint, sky| {
        let (fibre, gradient, variance) = fibres.surface(&pixel.point(footprint));
        let normal = (Vec3::Z - 0.3 * gradient).normalize();
        fibre.factor * on_facets(sky, &white, slope_facets(Vec3::Z, normal, 0.09 * variance), pixel.view())
    })
}

fn coat() -> CookTorrance<Beckmann, Schlick> {
    CookTorrance::new(Beckmann::isotropic(0.2).expect(VALID), Schlick::new(0.04).expect(VALID))
}

fn orange_peel() -> Subject {
    let (peel, coat) = (OrangePeel::new(0.006, 0.03, 1).expect(VALID), coat());
    subject("orange peel", 0.08, move |pixel, footprint, sky| {
        let normal = peel.normal(pixel.at.extend(0.0), Vec3::Z, footprint);
        on_facets(sky, &coat, slope_facets(Vec3::Z, normal, peel.removed_slope(footprint)), pixel.view())
    })
}

fn passive_flakes() -> Subject {
    let flakes = PassiveFlakes::new(0.004, 0.3, 4).expect(VALID);
    let base = gloss(0.3, Vec3::new(0.25, 0.35, 0.6));
    subject("passive flakes", 0.08, move |pixel, footprint, sky| {
        flakes.factor(pixel.at.extend(0.0), footprint) * sky.on(&base, Vec3::Z, pixel.view())
    })
}

/// Flakes of a metal, lit as many as there are.
struct Glints(GlintField<Beckmann>);

impl Glints {
    fn new() -> Self {
        let ndf = Beckmann::isotropic(0.6).expect(VALID);
        Self(GlintField::new(ndf, 4e-5, 1.0, 3).expect(VALID))
    }

    fn radiance(&self, colour: Vec3, pixel: &Pixel, footprint: Footprint, sky: &Sky) -> Vec3 {
        let smooth = CookTorrance::new(*self.0.ndf(), colour);
        sky.lights.iter().fold(Vec3::ZERO, |sum, light| {
            let h = half_vector(light.direction, pixel.view());
            let relative = self.0.density(h, pixel.at.extend(0.0), footprint) / self.0.ndf().density(h);
            sum + light.on_flat() * relative * smooth.value(light.direction, pixel.view())
        })
    }
}

fn flakes() -> Subject {
    let flakes = Glints::new();
    subject("flakes", 0.08, move |pixel, footprint, sky| {
        flakes.radiance(Vec3::splat(0.5), pixel, footprint, sky)
    })
}

/// Metallic paint, whose sparkles are counted: those of a fixed width in pixels have no mean that would not depend on the zoom.
fn paint() -> Subject {
    let parameters = MetallicPaintParameters { orange_peel_strength: 0.03, ..Default::default() };
    let paint = MetallicPaint::new(parameters).expect(VALID);
    let (flakes, coat) = (Glints::new(), coat());
    let base = EnergyPreservingOrenNayar::new(Vec3::new(0.02, 0.05, 0.14), 0.2).expect(VALID);
    subject("paint", 0.08, move |pixel, footprint, sky| {
        let surface = paint.surface(&pixel.point(footprint));
        let facets = slope_facets(Vec3::Z, surface.coat_normal, surface.coat_slope_variance);
        on_facets(sky, &coat, facets, pixel.view())
            + flakes.radiance(surface.specular, pixel, footprint, sky)
            + sky.on(&base, Vec3::Z, pixel.view())
    })
}

fn glass(name: &'static str, waves: GlassWaves) -> Subject {
    let glass = TemperedGlass::new(TemperedGlassParameters {
        waves,
        wave_amplitude: 0.003,
        wave_propagation_vector: Vec3::new(0.6, 0.8, 0.0),
        ..Default::default()
    })
    .expect(VALID);
    let coat = coat();
    subject(name, 2.4, move |pixel, footprint, sky| {
        let surface = glass.surface(&pixel.point(footprint));
        on_facets(sky, &coat, surface.facets(Vec3::Z), pixel.view())
    })
}

fn variations() -> Subject {
    let panel = Variations::new(VariationsParameters::default()).expect(VALID);
    subject("variations", 0.8, move |pixel, footprint, sky| {
        let surface = panel.surface(&pixel.point(footprint));
        let plastic = Both(surface.reflectance().expect(VALID), gloss(0.25, surface.specular));
        let facets = slope_facets(Vec3::Z, surface.normal, surface.slope_variance);
        on_facets(sky, &plastic, facets, pixel.view())
    })
}

fn scratches() -> Subject {
    let parameters = ScratchesParameters { scratch_width: 0.02, scratch_strength: 0.4, ..Default::default() };
    let scratches = Scratches::new(parameters).expect(VALID);
    let metal = gloss(0.3, Vec3::splat(0.7));
    subject("scratches", 0.4, move |pixel, footprint, sky| {
        let surface = scratches.surface(&pixel.point(footprint));
        on_facets(sky, &metal, surface.facets(Vec3::Z), pixel.view())
    })
}

fn bumps(name: &'static str, rule: LevelOfDetail) -> Subject {
    let ndf = Ggx::new(0.3, 0.5).expect(VALID);
    let spectrum = Spectrum::new(2.17, 0.8, 3).expect("three octaves");
    let bumps = BumpField::new(GaussianOctaves::<3>::new(spectrum, 7), 20.0).expect(VALID);
    subject(name, 0.8, move |pixel, footprint, sky| {
        // The mean over a pixel still shows octaves above the limit of its frequency.
        let half = Footprint::from_width(0.5 * footprint.width());
        let coordinates = bumps.coordinates(pixel.at.extend(0.0), half);
        sky.lights.iter().fold(Vec3::ZERO, |sum, light| {
            let h = half_vector(light.direction, pixel.view());
            sum + Vec3::splat(light.on_flat() * rule.radiance(&ndf, h, coordinates))
        })
    })
}
