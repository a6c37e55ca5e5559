//! Surfaces and reflectances with any valid parameters, at any point, from any direction:
//! invariants also hold for NaN, infinities, degenerate tangents and directions.

use asperity_shading::bump::*;
use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::material::*;
use asperity_shading::noise::{Fbm, FbmSpectrum, GaussianFbm, GaussianNoise, Perlin, Turbulence};
use asperity_shading::pixel::{FrequencyClamp, PixelEllipse};
use asperity_shading::reflectance::*;
use asperity_shading::texture::{
    Bevel, BevelParameters, Brick, Edge, Gas, Marble, PerturbedTexture, StarWallpaper,
    StarWallpaperParameters, Steam, march,
};
use asperity_shading::{Beckmann, BumpField, Footprint, Frame, Ggx, ShadingError};
use proptest::prelude::*;
use proptest::sample::select;

fn config(cases: u32) -> ProptestConfig {
    let rng_seed = proptest::test_runner::RngSeed::Fixed(0x5_4ADE);
    ProptestConfig { cases, rng_seed, failure_persistence: None, ..ProptestConfig::default() }
}

/// Mostly ordinary numbers, some with arbitrary bits, some known to be problematic.
fn number() -> impl Strategy<Value = f32> {
    let odd = vec![
        0.0,
        -0.0,
        1e-30,
        -1e-30,
        f32::MIN_POSITIVE,
        1.0,
        16_777_216.0,
        8_388_608.0,
        1e30,
        -1e30,
        f32::MAX,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::NAN,
    ];
    prop_oneof![6 => -4.0..4.0_f32, 1 => proptest::num::f32::ANY, 2 => select(odd)]
}

fn vector() -> impl Strategy<Value = Vec3> {
    [number(), number(), number()].prop_map(Vec3::from)
}

fn pair() -> impl Strategy<Value = Vec2> {
    [number(), number()].prop_map(Vec2::from)
}

pub(crate) fn unit() -> impl Strategy<Value = Vec3> {
    (-1.0..1.0_f32, 0.0..std::f32::consts::TAU).prop_map(|(z, turn)| {
        let r = (1.0 - z * z).sqrt();
        Vec3::new(r * turn.cos(), r * turn.sin(), z)
    })
}

/// A unit vector, including along the horizon, or a vector without direction.
fn direction() -> impl Strategy<Value = Vec3> {
    let along = vector().prop_map(|v| {
        let unit = v.as_dvec3().normalize_or_zero().as_vec3();
        if unit == Vec3::ZERO || !unit.is_finite() { v } else { unit }
    });
    prop_oneof![unit(), along]
}

fn point() -> impl Strategy<Value = SurfacePoint> {
    (vector(), unit(), number(), pair(), [vector(), vector()]).prop_map(
        |(position, n, width, uv, tangents)| {
            SurfacePoint::new(position, n, Footprint::from_width(width)).with_uv(uv, tangents)
        },
    )
}

/// Any valid size, including the ends of the range.
fn size() -> impl Strategy<Value = f32> {
    prop_oneof![8 => (-6.0..6.0_f32).prop_map(|e| 10.0_f32.powf(e)), 1 => Just(1e-6), 1 => Just(1e6)]
}

fn share() -> impl Strategy<Value = f32> {
    prop_oneof![6 => 0.0..=1.0_f32, 1 => Just(0.0), 1 => Just(1.0)]
}

fn color() -> impl Strategy<Value = Vec3> {
    [share(), share(), share()].prop_map(Vec3::from)
}

fn heading() -> impl Strategy<Value = Vec2> {
    (0.0..std::f32::consts::TAU, size()).prop_map(|(turn, length)| Vec2::from_angle(turn) * length)
}

/// Whether a normal is a unit vector on the side of the surface's own normal.
fn is_normal(n: Vec3, bumped: Vec3) -> bool {
    (bumped.length() - 1.0).abs() < 1e-5 && bumped.dot(n) > 0.0
}

fn is_color(color: Vec3) -> bool {
    color.to_array().iter().all(|c| (0.0..=1.0).contains(c))
}

/// Asserts that a BSDF returns finite nonnegative numbers, and that its samples are directions with
/// a density.
fn is_bsdf(material: &dyn Material, point: &SurfacePoint, wo: Vec3, wi: Vec3) -> Result<(), TestCaseError> {
    let is_light = |c: Vec3| c.is_finite() && c.cmpge(Vec3::ZERO).all();
    let bsdf = material.bsdf(point, wo);
    prop_assert!(is_light(bsdf.emitted()), "{}", bsdf.emitted());
    let height = material.height(point);
    let [low, high] = material.height_range().unwrap_or_default();
    prop_assert!(low - 1e-5 * high.max(-low) <= height && height <= high + 1e-5 * high.max(-low), "{height}");
    for u in [Vec2::new(0.3, 0.7), Vec2::ONE, Vec2::ZERO, Vec2::NAN] {
        let sampled = bsdf.sample(wo, u.y, u);
        for wi in [Some(wi), sampled.map(|sample| sample.wi)].into_iter().flatten() {
            let (value, density) = (bsdf.eval(wo, wi), bsdf.pdf(wo, wi));
            prop_assert!(is_light(value) && density >= 0.0 && density.is_finite(), "{value}, {density}");
        }
        for sample in bsdf.specular_samples(wo, u).into_iter().flatten() {
            prop_assert!(is_color(sample.eval_cos) && sample.wi.is_finite(), "{sample:?}");
        }
    }
    Ok(())
}

/// The parameters of a material, each from its strategy.
macro_rules! any_parameters {
    ($name:ident -> $type:ident { $($field:ident: $values:expr),+ $(,)? }) => {
        prop_compose! {
            fn $name()($($field in $values),+) -> $type { $type { $($field),+ } }
        }
    };
}

/// The roughness of a lobe.
fn lobe() -> impl Strategy<Value = f32> {
    share().prop_map(|roughness| roughness.max(0.01))
}

any_parameters!(fibers -> FibersParameters {
    fiber_length: size(), fiber_width: 0.01..=0.3_f32, fiber_bend: 0.0..=0.3_f32, fiber_direction: heading(),
    fiber_spread: share(), fiber_contrast: share(), seed: any::<u32>(),
});

any_parameters!(carpet -> CarpetParameters {
    diffuse: color(), specular: color(), roughness: share(), specular_roughness: lobe(),
    diffuse_thread_size: size(), diffuse_thread_strength: share(), diffuse_thread_bump_strength: share(),
    specular_thread_size: size(), specular_thread_strength: share(), dark_area_size: size(), dark_area_strength: share(),
    seams_propagation: heading(), seams_pattern: select(vec![SeamPattern::None, SeamPattern::Lines, SeamPattern::Grid]),
    seam_distance: size(), seams_amplitude: share(), seams_bump_strength: share(),
    seam_crossover_size: size(), seam_crossover_strength: share(),
    fiber_strength: share(), fiber_bump_strength: share(), fibers: fibers(),
    fake_rim_light: share(), fake_rim_light_width: share(), fake_rim_light_color: color(), seed: any::<u32>(),
});

any_parameters!(paint -> MetallicPaintParameters {
    specular: color(), orange_peel_strength: share(), orange_peel_size: size(),
    flake_sparkle_pixel_size: 0.0..=1000.0_f32, flake_sparkle_physical_size: size(), flake_sparkle_variation: share(),
    flake_sparkle_boost: share(), flake_sparkle_boost_target: color(), flake_sparkle_elimination: share(),
    smart_flake_sparkle: prop_oneof![Just(Elimination::Fixed), size().prop_map(|unit| Elimination::Adaptive { unit })],
    passive_flake_size: size(), passive_flake_strength: share(), passive_flake_detail: 1..=8_u32,
    flake_roughness: lobe(),
    flakes: prop_oneof![
        Just(PaintFlakes::Sparkling),
        (size(), share()).prop_map(|(spacing, bin)| PaintFlakes::Counted { spacing, bin: bin.max(0.001) }),
    ],
    pigment: color(), coat_index: share().prop_map(|share| 1.0 + share), coat_roughness: share(), seed: any::<u32>(),
});

any_parameters!(glass -> TemperedGlassParameters {
    wave_frequency: size(), wave_amplitude: 0.0..=1e6_f32, wave_propagation_vector: unit(),
    waves: select(vec![GlassWaves::Sine, GlassWaves::Noise]), body: select(vec![GlassBody::Pane, GlassBody::Solid]),
    index: 1.0..=2.0_f32, tint: color(), roughness: share(), seed: any::<u32>(),
});

any_parameters!(variations -> VariationsParameters {
    diffuse: color(), specular: color(), roughness: share(),
    small_blemish_size: size(), small_blemish_bump_strength: share(), small_blemish_color_strength: share(),
    dent_strength: share(), dent_size: size(), dent_cover: share(), dent_detail: 1..=8_u32,
    gloss_roughness: lobe(), seed: any::<u32>(),
});

any_parameters!(scratches -> ScratchesParameters {
    scratch_size: size(), scratch_length: 0.01..=1.0_f32, scratch_width: 1e-4..=0.5_f32, scratch_strength: share(),
    scratch_cover: 0.0..=4.0_f32, scratch_direction: heading(), scratch_spread: share(),
    specular: color(), roughness: 0.01..1.0_f32, seed: any::<u32>(),
});

proptest! {
    #![proptest_config(config(60))]

    #[test]
    fn carpets(parameters in carpet(), (point, wo, wi) in (point(), direction(), direction())) {
        is_bsdf(&Carpet::new(parameters).unwrap(), &point, wo, wi)?;
    }
}

proptest! {
    #![proptest_config(config(2000))]

    #[test]
    fn materials(
        (paint, glass, panel, scratches) in (paint(), glass(), variations(), scratches()),
        (point, wo, wi) in (point(), direction(), direction()),
    ) {
        let (paint, glass) = (MetallicPaint::new(paint).unwrap(), TemperedGlass::new(glass).unwrap());
        let (panel, scratches) = (Variations::new(panel).unwrap(), Scratches::new(scratches).unwrap());
        for material in [&paint as &dyn Material, &glass, &panel, &scratches] {
            is_bsdf(material, &point, wo, wi)?;
        }
    }

    #[test]
    fn glints(
        (spacing, bin, alpha) in (size(), 0.001..=1.0_f32, 0.01..1.0_f32),
        (h, point, seed) in (direction(), point(), any::<u32>()),
    ) {
        let field = GlintField::new(Beckmann::isotropic(alpha).unwrap(), spacing, bin, seed).unwrap();
        let density = field.density(h, point.position, point.footprint());
        prop_assert!(density >= 0.0 && density.is_finite(), "{density}");
        if let Some(flake) = field.flake(point.position) {
            prop_assert!(is_normal(Vec3::Z, flake.normal) && flake.center.is_finite(), "{flake:?}");
        }
    }
}

proptest! {
    #![proptest_config(config(60))]

    #[test]
    fn fibers_are_bright_and_have_a_direction(parameters in fibers(), point in point()) {
        let fiber = Fibers::new(parameters).unwrap().sample(point.uv, point.footprint());
        prop_assert!(fiber.factor >= 0.0 && fiber.factor.is_finite(), "{fiber:?}");
        prop_assert!((fiber.direction.length() - 1.0).abs() < 1e-5 && fiber.slope.is_finite(), "{fiber:?}");
    }
}

proptest! {
    #![proptest_config(config(2000))]

    #[test]
    fn textures(
        (width, height, mortar) in (size(), size(), prop_oneof![size(), Just(0.0)]),
        (uv, widths, p, footprint) in (pair(), pair(), vector(), number()),
        (points, chance, inner) in (2..=1000_u32, share(), 0.01..=1.0_f32),
    ) {
        let wall = Brick::new(width, height, mortar).unwrap();
        for got in [wall.sample(uv), wall.filtered(uv, PixelEllipse::aligned(widths))] {
            prop_assert!((0.0..=1.0).contains(&got.brick) && (0.0..=1.0).contains(&got.height), "{got:?}");
            prop_assert!(got.slope.is_finite(), "{got:?}");
        }
        prop_assert!((0.0..=1.0).contains(&wall.mean()));
        let mut shares = 0.0;
        wall.facets(uv, PixelEllipse::aligned(widths), |share, _, slope| {
            shares += if slope.is_finite() { share } else { f32::NAN };
        });
        prop_assert!((shares - 1.0).abs() < 1e-4, "{shares}");
        let largest = 0.4 / width;
        let [r_min, r_max] = [inner * largest * 0.999, largest * 0.999];
        let stars = StarWallpaperParameters { points, r_min, r_max, cells: width, chance, seed: 1 };
        if let Ok(stars) = StarWallpaper::new(stars) {
            let share = stars.coverage(uv, Footprint::from_width(footprint));
            prop_assert!((0.0..=1.0).contains(&share), "{share}");
        }
        let marble = Marble::new(Perlin::default(), width, 1).unwrap();
        let color = marble.color(p, Footprint::from_width(footprint));
        prop_assert!(is_color(color), "{color}");
        prop_assert!(marble.sum(p).is_finite());
        let moved = PerturbedTexture::default().coordinates(p, uv);
        prop_assert!(moved.is_finite() || !uv.is_finite(), "{moved}");
        let gas = Gas::default().with_veins();
        for density in [gas.density(p), gas.clamped_density(p, Footprint::from_width(footprint))] {
            prop_assert!((0.0..=gas.densest()).contains(&density), "{density}");
        }
        let room = Steam::new(Vec3::ZERO, width, height).unwrap().share(p);
        prop_assert!((0.0..=1.0).contains(&room), "{room}");
    }

    #[test]
    fn ridges_and_edges(
        (plateau, top, bottom) in (size(), -1e6..1e6_f32, -1e6..1e6_f32),
        distance in number(),
        corners in proptest::collection::vec(pair(), 0..6),
        p in pair(),
    ) {
        let [height, slope] = bevel(plateau, 2.0 * plateau, top, bottom).unwrap().profile(distance);
        prop_assert!(height.is_finite() && slope.is_finite(), "{height} {slope}");
        if let Some(edge) = Edge::nearest(&corners, p) {
            prop_assert!(edge.distance >= 0.0 && (edge.away.length() - 1.0).abs() < 1e-5, "{edge:?}");
        }
    }

    #[test]
    fn bumps(n in unit(), (g, m, wo) in (vector(), vector(), vector()), p in [vector(), vector()], slope in pair()) {
        let frame = Frame::from_normal(n);
        for gradient in [surface_gradient(n, p, slope), project_to_tangent_plane(n, g), gradient_of_normal(&frame, m)] {
            prop_assert!(gradient.is_finite(), "{gradient}");
            prop_assert!(is_normal(n, bumped_normal(n, gradient)), "{gradient}");
        }
        let bumped = bumped_normal(n, g);
        prop_assert!(is_normal(n, bumped) && bumped.dot(n) > 5e-5, "{bumped}");
        let normal = displace(g, n, p, [m, wo], slope.x, slope).normal;
        prop_assert!((normal.length() - 1.0).abs() < 1e-5);
        let seen = flip_to_visible(n, bumped_normal(n, g), wo);
        prop_assert!((seen.length() - 1.0).abs() < 1e-5, "{seen} {wo}");
    }
}

proptest! {
    #![proptest_config(config(200))]

    #[test]
    fn light_through_gas(
        (origin, direction, from, to) in (vector(), vector(), number(), number()),
        (step, offset) in (prop_oneof![1e-2..1e3_f32, select(vec![f32::NAN, 0.0, -1.0, f32::INFINITY])], number()),
        (extinction, light) in (number(), color()),
    ) {
        let seen = march(origin, direction, [from, to], step, offset, |_| extinction, |_| light);
        prop_assert!((0.0..=1.0).contains(&seen.transmittance), "{seen:?}");
        prop_assert!(seen.light.is_finite() && seen.light.min_element() >= 0.0, "{seen:?}");
    }
}

/// Color, roughness, widths of the density, exponent, refractive index.
type Looks = (Vec3, f32, [f32; 2], f32, [f32; 2]);

fn looks() -> impl Strategy<Value = Looks> {
    let alpha = || 1e-3..1.0_f32;
    (
        color(),
        share(),
        [alpha(), alpha()],
        1.0..1e4_f32,
        (1.01..4.0_f32, 0.0..6.0_f32).prop_map(<[f32; 2]>::from),
    )
}

fn reflectances(
    (albedo, roughness, [ax, ay], exponent, [eta, k]): Looks,
) -> Vec<(&'static str, Box<dyn Brdf>)> {
    const FORMS: [OrenNayarVariant; 3] =
        [OrenNayarVariant::Full, OrenNayarVariant::Qualitative, OrenNayarVariant::Fujii];
    const FACTORS: [BlinnPhongNormalization; 3] = [
        BlinnPhongNormalization::Albedo,
        BlinnPhongNormalization::Approximate,
        BlinnPhongNormalization::Density,
    ];
    let ggx = Ggx::new(ax, ay).expect("in range");
    let beckmann = Beckmann::new(ax, ay).expect("in range");
    let glass = Dielectric::new(eta).expect("in range");
    let metal = Conductor::new(eta, k).expect("in range");
    let schlick = Schlick::new(roughness).expect("in range");
    let tinted = SchlickF82::new(roughness, albedo.x).expect("in range");
    let mut all: Vec<(&'static str, Box<dyn Brdf>)> = vec![
        ("Lambert", Box::new(Lambert::new(albedo).expect("in range"))),
        ("rough", Box::new(EnergyPreservingOrenNayar::new(albedo, roughness).expect("in range"))),
        ("GGX glass", Box::new(CookTorrance::new(ggx, glass))),
        ("GGX, separable", Box::new(CookTorrance::new(ggx, glass).with_masking(Masking::Separable))),
        ("Beckmann metal", Box::new(CookTorrance::new(beckmann, metal))),
        ("grooves", Box::new(TorranceSparrow::new(ggx, schlick))),
        ("F82", Box::new(CookTorrance::new(ggx, tinted))),
        ("Phong", Box::new(Phong::new(albedo, exponent).expect("in range"))),
    ];
    for form in FORMS {
        all.push(("Oren-Nayar", Box::new(OrenNayar::new(albedo, roughness, form).expect("in range"))));
    }
    for factor in FACTORS {
        all.push(("Blinn-Phong", Box::new(BlinnPhongBrdf::new(albedo, exponent, factor).expect("in range"))));
    }
    for form in [WardNormalization::Ward, WardNormalization::Dur, WardNormalization::Bounded] {
        all.push(("Ward", Box::new(WardBrdf::new(albedo, ax, ay, form).expect("in range"))));
    }
    all
}

proptest! {
    #![proptest_config(config(2000))]

    #[test]
    fn reflectances_of_any_roughness(
        looks in looks(),
        wi in direction(),
        wo in direction(),
        u in pair(),
    ) {
        for (name, brdf) in reflectances(looks) {
            let value = brdf.eval(wo, wi);
            prop_assert!(value.is_finite() && value.min_element() >= 0.0, "{name}: {value}");
            let density = brdf.pdf(wo, wi);
            prop_assert!(density >= 0.0 && density.is_finite(), "{name}: {density}");
            if !(wi.z > 0.0 && wo.z > 0.0 && wi.is_finite() && wo.is_finite()) {
                prop_assert_eq!(value, Vec3::ZERO, "{}", name);
                prop_assert_eq!(density, 0.0, "{}", name);
            }
            let Some(sample) = brdf.sample(wo, u.x, u) else { continue };
            if (wo.length() - 1.0).abs() < 1e-5 && wo.z > 0.0 {
                prop_assert!((sample.wi.length() - 1.0).abs() < 1e-3, "{name}: {sample:?} from {wo}, {u}");
            }
            prop_assert_eq!(sample.pdf, brdf.pdf(wo, sample.wi), "{}", name);
            prop_assert!(sample.weight().is_finite() && sample.pdf > 0.0, "{name}: {sample:?}");
        }
    }
}

/// Returns the name of the invalid parameter.
fn refused<T>(constructed: Result<T, ShadingError>) -> Option<&'static str> {
    constructed.err().map(|error| error.parameter())
}

fn bevel(plateau: f32, ridge: f32, top: f32, bottom: f32) -> Result<Bevel, ShadingError> {
    Bevel::new(BevelParameters { plateau, ridge, top, bottom })
}

/// The name of a parameter, and the error for a value.
type Constructor<'a> = (&'static str, &'a dyn Fn(f32) -> Option<&'static str>);

#[test]
fn nan_and_negative_parameters_are_named() {
    let field = || GaussianFbm::<Vec3>::new(GaussianNoise::new(0), FbmSpectrum::default());
    let turbulence = || Fbm::new(Perlin::new(0), FbmSpectrum::default()).with_shape(Turbulence);
    let beckmann = Beckmann::isotropic(0.3).unwrap();
    let stars = |[r_min, r_max]: [f32; 2], cells, chance| {
        let parameters = StarWallpaperParameters { r_min, r_max, cells, chance, ..Default::default() };
        refused(StarWallpaper::new(parameters))
    };
    let seams = |parameters: SeamsParameters| refused(Seams::new(parameters));
    let carpet = |parameters: CarpetParameters| refused(Carpet::new(parameters));
    let paint = |parameters: MetallicPaintParameters| refused(MetallicPaint::new(parameters));
    let constructors: [Constructor<'_>; 48] = [
        ("eta", &|x| refused(Conductor::new(x, 1.0))),
        ("k", &|x| refused(Conductor::new(1.0, x))),
        ("relative_index", &|x| refused(Dielectric::new(x))),
        ("f0", &|x| refused(Schlick::new(x))),
        ("f0", &|x| refused(SchlickF82::new(x, 0.5))),
        ("tint", &|x| refused(SchlickF82::new(0.5, x))),
        ("albedo", &|x| refused(Lambert::new(Vec3::new(0.5, x, 0.5)))),
        ("roughness", &|x| refused(OrenNayar::new(Vec3::ONE, x, OrenNayarVariant::Full))),
        ("roughness", &|x| refused(OrenNayar::new(Vec3::ONE, x, OrenNayarVariant::Fujii))),
        ("roughness", &|x| refused(EnergyPreservingOrenNayar::new(Vec3::ONE, x))),
        ("specular", &|x| refused(Phong::new(Vec3::splat(x), 1.0))),
        ("exponent", &|x| refused(Phong::new(Vec3::ONE, x))),
        ("exponent", &|x| refused(BlinnPhongBrdf::new(Vec3::ONE, x, BlinnPhongNormalization::Albedo))),
        ("specular", &|x| refused(WardBrdf::new(Vec3::splat(x), 0.1, 0.3, WardNormalization::Ward))),
        ("alpha_x", &|x| refused(WardBrdf::new(Vec3::ONE, x, 0.3, WardNormalization::Ward))),
        ("frequency", &|x| refused(FrequencyClamp::new(x, 2.0, 8.0))),
        ("lacunarity", &|x| refused(FrequencyClamp::new(1.0, x, 8.0))),
        ("max_octaves", &|x| refused(FrequencyClamp::new(1.0, 2.0, x))),
        ("frequency", &|x| refused(BumpField::new(field(), x))),
        ("width", &|x| refused(Brick::new(x, 1.0, 0.1))),
        ("height", &|x| refused(Brick::new(1.0, x, 0.1))),
        ("mortar", &|x| refused(Brick::new(1.0, 1.0, x))),
        ("plateau", &|x| refused(bevel(x, 1.0, 0.0, 1.0))),
        ("ridge", &|x| refused(bevel(0.1, x, 0.0, 1.0))),
        ("r_min", &|x| stars([x, 0.03], 10.0, 0.5)),
        ("r_max", &|x| stars([0.01, x], 10.0, 0.5)),
        ("cells", &|x| stars([0.01, 0.03], x, 0.5)),
        ("chance", &|x| stars([0.01, 0.03], 10.0, x)),
        ("scale", &|x| refused(Marble::new(Perlin::default(), x, 0))),
        ("max_density", &|x| refused(Gas::new(turbulence(), x, 1.0))),
        ("exponent", &|x| refused(Gas::new(turbulence(), 1.0, x))),
        ("radius", &|x| refused(Steam::new(Vec3::ZERO, x, 1.0))),
        ("height", &|x| refused(Steam::new(Vec3::ZERO, 1.0, x))),
        ("seam_distance", &|x| seams(SeamsParameters { seam_distance: x, ..Default::default() })),
        ("seams_amplitude", &|x| seams(SeamsParameters { seams_amplitude: x, ..Default::default() })),
        ("diffuse_thread_size", &|diffuse_thread_size| {
            carpet(CarpetParameters { diffuse_thread_size, ..Default::default() })
        }),
        ("specular_thread_size", &|specular_thread_size| {
            carpet(CarpetParameters { specular_thread_size, ..Default::default() })
        }),
        ("dark_area_size", &|dark_area_size| {
            carpet(CarpetParameters { dark_area_size, ..Default::default() })
        }),
        ("dark_area_strength", &|dark_area_strength| {
            carpet(CarpetParameters { dark_area_strength, ..Default::default() })
        }),
        ("orange_peel_size", &|x| refused(OrangePeel::new(x, 0.5, 4))),
        ("orange_peel_strength", &|x| refused(OrangePeel::new(0.5, x, 4))),
        ("passive_flake_size", &|passive_flake_size| {
            paint(MetallicPaintParameters { passive_flake_size, ..Default::default() })
        }),
        ("passive_flake_strength", &|x| {
            paint(MetallicPaintParameters { passive_flake_strength: x, ..Default::default() })
        }),
        ("smart_flake_sparkle", &|unit| {
            let smart_flake_sparkle = Elimination::Adaptive { unit };
            paint(MetallicPaintParameters { smart_flake_sparkle, ..Default::default() })
        }),
        ("flake_spacing", &|x| refused(GlintField::new(beckmann, x, 0.05, 3))),
        ("flake_bin", &|x| refused(GlintField::new(beckmann, 1.0, x, 3))),
        ("dent_cover", &|x| refused(Dents::new(DentsParameters { dent_cover: x, ..Default::default() }))),
        ("small_blemish_size", &|x| refused(Blemishes::new(x, 1))),
    ];
    for (name, constructor) in constructors {
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.5] {
            assert_eq!(constructor(bad), Some(name), "{bad}");
        }
    }
}

/// Returns the name of the invalid parameter for modified default parameters.
fn refused_of<P: Default, M>(
    new: fn(P) -> Result<M, ShadingError>,
    change: fn(&mut P),
) -> Option<&'static str> {
    let mut parameters = P::default();
    change(&mut parameters);
    refused(new(parameters))
}

#[test]
fn parameters_just_out_of_range_are_named() {
    let (carpet, paint) = (|p| refused_of(Carpet::new, p), |p| refused_of(MetallicPaint::new, p));
    let (glass, panel) = (|p| refused_of(TemperedGlass::new, p), |p| refused_of(Variations::new, p));
    let (scratches, fibers) = (|p| refused_of(Scratches::new, p), |p| refused_of(Fibers::new, p));
    let (seams, stars) = (|p| refused_of(Seams::new, p), |p| refused_of(StarWallpaper::new, p));
    let cases = [
        ("eta", refused(Conductor::new(0.0, 1.0))),
        ("relative_index", refused(Dielectric::new(-0.0))),
        ("f0", refused(Schlick::new(1.001))),
        ("albedo", refused(Lambert::new(Vec3::splat(1.01)))),
        ("roughness", refused(OrenNayar::new(Vec3::ONE, 1.6, OrenNayarVariant::Full))),
        ("roughness", refused(OrenNayar::new(Vec3::ONE, 1.1, OrenNayarVariant::Fujii))),
        ("exponent", refused(Phong::new(Vec3::ONE, 1e7))),
        ("alpha_x", refused(WardBrdf::new(Vec3::ONE, 0.0, 0.3, WardNormalization::Ward))),
        ("lacunarity", refused(FrequencyClamp::new(1.0, 1.0, 8.0))),
        ("width", refused(Brick::new(0.0, 1.0, 0.1))),
        ("plateau", refused(bevel(1.0, 1.0, 0.0, 1.0))),
        ("top", refused(bevel(0.0, 1.0, f32::NAN, 1.0))),
        ("points", stars(|p| p.points = 1)),
        ("r_max", stars(|p| p.r_min = 0.04)),
        ("r_max", stars(|p| p.r_max = 0.05)),
        ("seams_propagation", seams(|p| p.seams_propagation = Vec2::ZERO)),
        ("diffuse_thread_size", carpet(|p| p.diffuse_thread_size = 0.0)),
        ("passive_flake_detail", paint(|p| p.passive_flake_detail = 9)),
        ("dent_detail", refused(Dents::new(DentsParameters { dent_detail: 20, ..Default::default() }))),
        ("flake_bin", refused(GlintField::new(Beckmann::isotropic(0.3).unwrap(), 1.0, 2.0, 3))),
        ("roughness", carpet(|p| p.roughness = 1.5)),
        ("seam_crossover_size", carpet(|p| p.seam_crossover_size = 0.0)),
        ("diffuse", carpet(|p| p.diffuse = Vec3::splat(f32::NAN))),
        ("seams_propagation", carpet(|p| p.seams_propagation = Vec2::ZERO)),
        ("orange_peel_strength", paint(|p| p.orange_peel_strength = 2.0)),
        ("flake_sparkle_boost", paint(|p| p.flake_sparkle_boost = -1.0)),
        ("passive_flake_detail", paint(|p| p.passive_flake_detail = 0)),
        ("wave_propagation_vector", glass(|p| p.wave_propagation_vector = Vec3::ZERO)),
        ("wave_amplitude", glass(|p| p.wave_amplitude = -1.0)),
        ("dent_detail", panel(|p| p.dent_detail = 99)),
        ("scratch_width", scratches(|p| p.scratch_width = 0.9)),
        ("scratch_direction", scratches(|p| p.scratch_direction = Vec2::NAN)),
        ("fiber_width", fibers(|p| p.fiber_width = 0.5)),
        ("fiber_direction", fibers(|p| p.fiber_direction = Vec2::ZERO)),
    ];
    for (name, got) in cases {
        assert_eq!(got, Some(name));
    }
    let none = SeamsParameters {
        seams_propagation: Vec2::ZERO,
        seams_pattern: SeamPattern::None,
        ..Default::default()
    };
    assert_eq!(refused(Seams::new(none)), None);
}
