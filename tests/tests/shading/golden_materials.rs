//! Pinned values of the materials with their default parameters: a change is value-breaking.

use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::material::{
    Blemishes, Dents, DentsParameters, Fibers, FibersParameters, GlassWaves, GlintField, OrangePeel,
    SeamPattern, Seams, SeamsParameters,
};
use asperity_shading::{
    Beckmann, Carpet, CarpetParameters, Footprint, Material, MetallicPaint, MetallicPaintParameters,
    Scratches, ScratchesParameters, SurfacePoint, TemperedGlass, TemperedGlassParameters, Variations,
    VariationsParameters,
};
use asperity_tests::pinned::{SINGLE, pinned, single};

const P: Vec3 = Vec3::new(0.37, -1.21, 2.83);
const N: Vec3 = Vec3::new(0.36, 0.48, 0.8);
const UV: Vec2 = Vec2::new(0.613, 0.247);
/// Sums of noises, and slopes of noises with up to hundreds of cells per unit.
const LOOSE: f64 = 100.0 * SINGLE;

fn point(width: f32) -> SurfacePoint {
    let point = SurfacePoint::new(P, N, Footprint::from_width(width));
    point.with_uv(UV, point.tangents)
}

/// Directions in the frame of the surface.
const WI: Vec3 = Vec3::new(0.48, 0.36, 0.8);
const WO: Vec3 = Vec3::new(-0.6, 0.0, 0.8);

/// Pins the radiance that a material scatters from a lamp.
fn lit(name: &str, material: &dyn Material, width: f32, expected: [f64; 3]) {
    let (point, frame) = (point(width), point(width).frame());
    let [wo, wi] = [WO, WI].map(|w| frame.to_world(w));
    pinned(name, material.bsdf(&point, wo).eval_cos(wo, wi), expected, LOOSE);
}

/// Returns the direction of a specular reflection in the frame of the surface.
fn mirrored(material: &dyn Material) -> Vec3 {
    let (point, frame) = (point(1e-3), point(1e-3).frame());
    let wo = frame.to_world(WO);
    let sample = material.bsdf(&point, wo).sample(wo, 0.0, Vec2::splat(0.3)).expect("some direction");
    assert!(sample.is_specular() && !sample.is_transmission());
    frame.to_local(sample.wi)
}

#[test]
fn carpets() {
    let carpet = Carpet::new(CarpetParameters::default()).unwrap();
    lit("Carpet", &carpet, 1e-3, [0.0242119581, 0.0242119581, 0.0259427764]);
    let rim = carpet.bsdf(&point(1e-3), point(1e-3).frame().to_world(Vec3::new(0.96, 0.0, 0.28))).emitted();
    pinned("Carpet, rim", rim, [0.03240001, 0.03240001, 0.03240001], LOOSE);
    let seams = Seams::new(SeamsParameters {
        seams_propagation: Vec2::new(0.8, 0.6),
        seams_pattern: SeamPattern::Grid,
        seam_distance: 0.3,
        seams_amplitude: 0.6,
    })
    .unwrap();
    let samples = [
        ("Seams", seams.sample(UV), [0.635979891, 4.62146044, 3.46609545]),
        ("Seams::rounded", seams.rounded(UV, 0.05), [0.637582362, 4.57884121, 3.43413091]),
        (
            "Seams::filtered",
            seams.filtered(UV, Footprint::from_width(0.02).into()),
            [0.635306418, 4.60827398, 3.45620561],
        ),
    ];
    for (name, seam, expected) in samples {
        pinned(name, [seam.amount, seam.slope.x, seam.slope.y], expected, LOOSE);
    }
    let rim = CarpetParameters { fake_rim_light: 1.0, fake_rim_light_width: 0.7, ..Default::default() };
    let rim = Carpet::new(rim).unwrap().bsdf(&point(1e-3), Vec3::X).emitted();
    single("Carpet, rim with a custom width", rim.x, [0.478577256]);
    let fibers = Fibers::new(FibersParameters::default()).unwrap();
    let fiber = fibers.sample(UV, Footprint::from_width(1e-4));
    let expected = [1.11548305, 0.785506785, -0.0595688075];
    pinned("Fibers", [fiber.factor, fiber.direction.x, fiber.slope.x], expected, LOOSE);
}

#[test]
fn paints() {
    let paint = MetallicPaint::new(MetallicPaintParameters::default()).unwrap();
    lit("MetallicPaint", &paint, 1e-3, [0.147088125, 0.210509986, 0.372331738]);
    pinned("MetallicPaint, coat", mirrored(&paint), [0.601685822, -0.044651784, 0.797483861], LOOSE);
    let footprint = Footprint::from_width(1e-3);
    let peel = OrangePeel::new(0.01, 0.3, 1).unwrap();
    pinned("OrangePeel", peel.normal(P, N, footprint), [0.291437387, 0.950335443, 0.10921064], LOOSE);
    single("OrangePeel, variance", peel.removed_slope(Footprint::from_width(1e-2)), [0.277200013]);
    let glints = GlintField::new(Beckmann::isotropic(0.3).unwrap(), 1e-3, 0.1, 1).unwrap();
    pinned("GlintField", glints.density(N, P, Footprint::from_width(0.02)), [0.0], LOOSE);
    single("GlintFlake", glints.flake(P).unwrap().normal, [0.0322401002, 0.240900666, 0.970014215]);
}

#[test]
fn glass_scratches_and_variations() {
    for (name, waves, expected) in [
        ("sine", GlassWaves::Sine, [0.60018295, -0.0016619678, 0.7998609]),
        ("noise", GlassWaves::Noise, [0.604230583, 0.00498932833, 0.796793997]),
    ] {
        let glass = TemperedGlass::new(TemperedGlassParameters { waves, ..Default::default() }).unwrap();
        pinned(name, mirrored(&glass), expected, LOOSE);
    }
    let scratches = Scratches::new(ScratchesParameters { scratch_cover: 4.0, ..Default::default() }).unwrap();
    pinned("Scratches, mean", scratches.mean(), [0.0142222224], LOOSE);
    lit("Scratches", &scratches, 0.02, [0.45600876, 0.45600876, 0.45600876]);
    let variations = Variations::new(VariationsParameters::default()).unwrap();
    lit("Variations", &variations, 1e-3, [0.173824921, 0.169478774, 0.162989706]);
    single("Blemishes::vary", Blemishes::vary(0.4, 0.7, 0.5), [0.610000014]);
    let footprint = Footprint::from_width(1e-3);
    let blemishes = Blemishes::new(0.01, 1).unwrap();
    pinned(
        "Blemishes",
        blemishes.color(N, 0.5, P, footprint),
        [0.332260966, 0.443014592, 0.738357663],
        LOOSE,
    );
    pinned(
        "Blemishes, gradient",
        blemishes.gradient(0.5, P, N, footprint),
        [-0.149065018, -1.64259362, 1.05263543],
        LOOSE,
    );
    let dents =
        Dents::new(DentsParameters { dent_size: 0.05, dent_cover: 0.5, dent_detail: 3, seed: 1 }).unwrap();
    pinned("Dents", dents.sample(P, footprint).value, [0.157136053], LOOSE);
    pinned(
        "Dents, gradient",
        dents.gradient(0.5, P, N, footprint),
        [-0.174804389, -0.40585202, 0.322173178],
        LOOSE,
    );
    pinned(
        "Fiber, width",
        Fibers::new(FibersParameters::default()).unwrap().sample(UV, Footprint::from_width(1e-4)).slope,
        [-0.0595688075, 0.0357200764],
        LOOSE,
    );
}
