//! Pinned values of the crate's functions: a change is value-breaking.
//!
//! Values are pinned to a few units in the last place, not to the bit. The float functions of `std`
//! round differently on different platforms, and those of `libm`, which are the same everywhere,
//! round differently again.

use asperity_shading::bump::{
    bumped_normal, displace, finite_difference_gradient, flip_to_visible, gradient_of_normal,
    project_to_tangent_plane, surface_gradient,
};
use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::level_of_detail::{
    GaussianField, RemappedOctaves, ResolvedBumps, facet_coordinates, shade_facet,
};
use asperity_shading::noise::{FbmSpectrum, GaussianFbm, GaussianNoise, Perlin};
use asperity_shading::pixel::FrequencyClamp;
use asperity_shading::pixel::Tap;
use asperity_shading::reflectance::{
    BlinnPhongBrdf, BlinnPhongNormalization, Masking, OrenNayar, OrenNayarVariant, SchlickF82, WardBrdf,
    WardNormalization,
};
use asperity_shading::texture::{
    Bevel, BevelParameters, Edge, Gas, PerturbedTexture, StarWallpaper, Steam, march,
};
use asperity_shading::{
    Beckmann, Brdf, Brick, BumpField, Conductor, CookTorrance, Dielectric, EnergyPreservingOrenNayar,
    Footprint, Frame, Fresnel, Ggx, Lambert, LevelOfDetail, Marble, Phong, PixelEllipse, Schlick,
    TorranceSparrow, far_field, half_vector, reflect,
};
use asperity_tests::pinned::{SINGLE, pinned, single};

const P: Vec3 = Vec3::new(0.37, -1.21, 2.83);
const N: Vec3 = Vec3::new(0.36, 0.48, 0.8);
const UV: Vec2 = Vec2::new(0.613, 0.247);
const TANGENTS: [Vec3; 2] = [Vec3::new(1.6, 0.4, -0.96), Vec3::new(-0.3, 0.9, -0.405)];
const SLOPE: Vec2 = Vec2::new(0.31, -0.47);

fn wi() -> Vec3 {
    Vec3::new(2.0, -3.0, 6.0) / 7.0
}

fn wo() -> Vec3 {
    Vec3::new(-0.6, 0.0, 0.8)
}

#[test]
fn directions_and_bumps() {
    let h = half_vector(wi(), wo());
    single("half_vector", h, [-0.180594996, -0.246265903, 0.952228129]);
    single("reflect", reflect(wi(), N), [0.133942902, 0.988114357, 0.0754286647]);
    let gradient = surface_gradient(N, TANGENTS, SLOPE);
    single("surface_gradient", gradient, [0.333558947, -0.376835942, 0.0759999976]);
    single("tangential", project_to_tangent_plane(N, P), [-0.283904016, -2.08187199, 1.37687993]);
    single("bumped_normal", bumped_normal(N, gradient), [0.0235645268, 0.763620257, 0.645235538]);
    single(
        "gradient_of_normal",
        gradient_of_normal(&Frame::from_normal(N), wi()),
        [-0.357333332, 0.467999965, -0.11999999],
    );
    single(
        "facing",
        flip_to_visible(Vec3::Z, Vec3::new(0.8, 0.0, 0.6), Vec3::new(-0.8, 0.0, 0.6)),
        [0.316227764, 0.0, 0.948683321],
    );
    // Sevenths of differences of a square: about ten units of the last place.
    pinned(
        "differences",
        finite_difference_gradient(|uv| uv.x * uv.x - uv.x * uv.y, UV, 0.125),
        [0.978999853, -0.612999856],
        10.0 * SINGLE,
    );
    let raised = displace(P, N, TANGENTS, TANGENTS.map(|t| 0.2 * t), 0.3, SLOPE);
    single("displace", raised.position, [0.478000015, -1.06599998, 3.06999993]);
    single("displace, normal", raised.normal, [0.0408561304, 0.753182411, 0.656541646]);
}

#[test]
fn levels_of_detail() {
    let ggx = Ggx::new(0.2, 0.4).unwrap();
    let h = half_vector(wi(), wo());
    let coordinates = ResolvedBumps { z: Vec2::new(0.7, -1.2), variance: 0.75, blend: 0.6 };
    single("far_field", far_field(&ggx, h), [0.901255548]);
    for (rule, name, radiance, normal) in [
        (LevelOfDetail::Exact, "Exact", [0.0248400383], [0.0973757431, -0.333859742, 0.937579691]),
        (LevelOfDetail::Fractal, "Fractal", [0.682684481], [0.0632693395, -0.216923445, 0.974136174]),
    ] {
        // The exponent is of order 10.
        pinned(name, rule.radiance(&ggx, h, coordinates), radiance, 10.0 * SINGLE);
        single(name, rule.normal(&ggx, coordinates), normal);
    }
    single("facet_coordinates", facet_coordinates(&ggx, coordinates), [0.420000017, -0.720000029]);
    single("shade_facet", shade_facet(&ggx, &Frame::from_normal(N), h), [0.0498385504]);
    let footprint = Footprint::from_distance(3.0, 1e-3, 0.4);
    single("Footprint::from_distance", footprint.width(), [0.00749999983]);
    single(
        "Footprint::from_derivatives",
        Footprint::from_derivatives(0.1 * N, 0.2 * P).width(),
        [0.622806847],
    );
    let ellipse = PixelEllipse::from_derivatives(0.1 * N, 0.2 * P);
    let Tap { offset: tap, footprint: width } = ellipse.taps(4).next().unwrap();
    single("PixelEllipse", tap, [-0.0289145112, 0.0886110812, -0.214146763]);
    single("PixelEllipse, width", width.width(), [0.155701712]);
    let clamp = FrequencyClamp::new(2.0, 2.17, 16.0).unwrap();
    single(
        "FrequencyClamp",
        [clamp.octaves(footprint), clamp.footprint(3.5).width()],
        [4.52618408, 0.0166085176],
    );
    let field =
        BumpField::new(GaussianFbm::<Vec3>::new(GaussianNoise::new(1), FbmSpectrum::default()), 7.0).unwrap();
    let seen = field.coordinates(P, &Frame::from_normal(N), footprint);
    single("BumpField", seen.z, [0.195360303, 1.46503329]);
    single("BumpField, share and fade", [seen.variance, seen.blend], [0.97624445, 1.0]);
    let classic = RemappedOctaves::new(Perlin::default(), FbmSpectrum::default(), 1).unwrap();
    pinned(
        "RemappedOctaves",
        classic.coordinates(P, &Frame::IDENTITY, 4.3).z,
        [-0.813406944, -1.30235529],
        10.0 * SINGLE,
    );
}

#[test]
fn fresnel() {
    let all: [(&str, &dyn Fresnel, [f64; 2]); 4] = [
        ("Dielectric", &Dielectric::new(1.5).unwrap(), [0.040791899, 0.513473749]),
        ("Conductor", &Conductor::new(0.2, 3.0).unwrap(), [0.923130572, 0.952598214]),
        ("Schlick", &Schlick::new(0.04).unwrap(), [0.0400095992, 0.546622634]),
        ("SchlickF82", &SchlickF82::new(0.9, 0.7).unwrap(), [0.899996459, 0.673524737]),
    ];
    for (name, fresnel, expected) in all {
        single(name, [0.9, 0.12].map(|c| fresnel.reflectance_rgb(c).x), expected);
    }
}

/// Name, reflectance, red and blue of its value, its density with two components of a sample.
type Golden = (&'static str, Box<dyn Brdf>, [f64; 2], [f64; 3]);

#[test]
fn reflectances() {
    /// Density of the golden direction, and x and z of a sample: cosine-weighted, by the
    /// Blinn–Phong peak, by the slopes of Ward.
    const COSINE: [f64; 3] = [0.272837043, 0.0147572653, 0.62209326];
    const POWER: [f64; 3] = [0.320843667, 0.607002139, 0.702558458];
    const SLOPES: [f64; 3] = [0.354659081, 0.605087936, 0.585240424];
    let albedo = Vec3::new(0.8, 0.5, 0.1);
    let (ggx, beckmann) = (Ggx::new(0.2, 0.4).unwrap(), Beckmann::new(0.2, 0.4).unwrap());
    let (glass, gold) = (Dielectric::new(1.5).unwrap(), Conductor::new(0.2, 3.0).unwrap());
    let oren_nayar = |form| Box::new(OrenNayar::new(albedo, 0.6, form).unwrap());
    let blinn_phong = |factor| Box::new(BlinnPhongBrdf::new(albedo, 30.0, factor).unwrap());
    let ward = |form| Box::new(WardBrdf::new(albedo, 0.2, 0.4, form).unwrap());
    let all: [Golden; 16] = [
        ("Lambert", Box::new(Lambert::new(albedo).unwrap()), [0.254647911, 0.0318309888], COSINE),
        (
            "EnergyPreservingOrenNayar",
            Box::new(EnergyPreservingOrenNayar::new(albedo, 0.6).unwrap()),
            [0.227948502, 0.0248292815],
            COSINE,
        ),
        ("OrenNayar, full", oren_nayar(OrenNayarVariant::Full), [0.19840318, 0.0218342822], COSINE),
        (
            "OrenNayar, qualitative",
            oren_nayar(OrenNayarVariant::Qualitative),
            [0.188218012, 0.0235272516],
            COSINE,
        ),
        ("OrenNayar, Fujii", oren_nayar(OrenNayarVariant::Fujii), [0.194815546, 0.0243519433], COSINE),
        (
            "CookTorrance, GGX",
            Box::new(CookTorrance::new(ggx, glass)),
            [0.01338741, 0.01338741],
            [0.287143677, 0.423796475, 0.871587932],
        ),
        (
            "CookTorrance, separable",
            Box::new(CookTorrance::new(ggx, glass).with_masking(Masking::Separable)),
            [0.0133865997, 0.0133865997],
            [0.287143677, 0.423796475, 0.871587932],
        ),
        (
            "CookTorrance, Beckmann",
            Box::new(CookTorrance::new(beckmann, gold)),
            [0.436215013, 0.436215013],
            [0.405106336, 0.51138252, 0.801558197],
        ),
        (
            "TorranceSparrow",
            Box::new(TorranceSparrow::new(beckmann, glass)),
            [0.0195754133, 0.0195754133],
            SLOPES,
        ),
        (
            "Phong",
            Box::new(Phong::new(albedo, 30.0).unwrap()),
            [0.0399628691, 0.00499535864],
            [0.0483925343, 0.585579634, 0.773115993],
        ),
        (
            "BlinnPhongLobe, albedo",
            blinn_phong(BlinnPhongNormalization::Albedo),
            [0.265820473, 0.0332275592],
            POWER,
        ),
        (
            "BlinnPhongLobe, approximate",
            blinn_phong(BlinnPhongNormalization::Approximate),
            [0.278525442, 0.0348156802],
            POWER,
        ),
        (
            "BlinnPhongLobe, density",
            blinn_phong(BlinnPhongNormalization::Density),
            [0.234547734, 0.0293184668],
            POWER,
        ),
        ("WardReflection", ward(WardNormalization::Ward), [0.257419437, 0.0321774296], SLOPES),
        ("WardReflection, Dür", ward(WardNormalization::Dur), [0.310863525, 0.0388579406], SLOPES),
        ("WardReflection, bounded", ward(WardNormalization::Bounded), [0.34242937, 0.0428036712], SLOPES),
    ];
    for (name, brdf, [x, z], samples) in all {
        let (value, sampled) = (brdf.eval(wo(), wi()), brdf.sample(wo(), 0.5, UV).unwrap().wi);
        // Exponents and powers of up to 30.
        pinned(name, [value.x, value.z], [x, z], 30.0 * SINGLE);
        pinned(name, [brdf.pdf(wo(), wi()), sampled.x, sampled.z], samples, 30.0 * SINGLE);
    }
}

#[test]
fn textures() {
    let wall = Brick::default();
    let at = wall.sample(Vec2::new(0.613, 0.003));
    pinned(
        "Brick::sample",
        [at.brick, at.height, at.slope.x, at.slope.y],
        [0.0, 0.648000002, 0.0, 288.0],
        10.0 * SINGLE,
    );
    let mean = wall.filtered(UV, PixelEllipse::aligned(Vec2::new(0.1, 0.07)));
    pinned(
        "Brick::filtered",
        [mean.brick, mean.height, mean.slope.x, mean.slope.y],
        [0.847142816, 0.921785772, 0.0, -0.714285851],
        10.0 * SINGLE,
    );
    single("Brick::mean", wall.mean(), [0.854700863]);
    let bevel = Bevel::new(BevelParameters { plateau: 0.1, ridge: 0.6, top: 0.3, bottom: 0.9 }).unwrap();
    single("Bevel::profile", bevel.profile(0.4), [0.155999988, -0.659999967]);
    let edge = Edge::nearest(&[Vec2::ZERO, Vec2::X, Vec2::ONE], UV).unwrap();
    single("Edge::nearest", [edge.distance, edge.away.x, edge.away.y], [0.246999994, 0.0, 1.0]);
    let stars = StarWallpaper::default();
    let covered: f32 = (0..64).map(|k| stars.coverage(UV * k as f32, Footprint::from_width(0.004))).sum();
    pinned("StarWallpaper", [covered, stars.mean()], [2.08931255, 0.0484922789], 10.0 * SINGLE);
    let marble = Marble::default();
    single("Marble::sum", marble.sum(P), [0.028875351]);
    pinned(
        "Marble::color",
        marble.color(P, Footprint::from_width(0.05)),
        [0.0861342102, 0.0861342102, 0.248287141],
        10.0 * SINGLE,
    );
    single("PerturbedTexture", PerturbedTexture::default().coordinates(P, UV), [0.621038318, 0.255345523]);
    let gas = Gas::default();
    let densities = [
        gas.density(P),
        gas.clamped_density(P, Footprint::from_width(0.2)),
        gas.with_veins().density(P),
        gas.densest(),
    ];
    pinned("Gas", densities, [0.0154482871, 0.0242005214, 2.63556385, 8.0], 10.0 * SINGLE);
    let steam = Steam::new(Vec3::new(0.3, -1.1, 2.0), 0.5, 1.5).unwrap();
    single("Steam::share", steam.share(P), [0.371387482]);
    let seen = march(P, N, [0.1, 2.0], 0.1, 0.5, |p| gas.density(p), Vec3::abs);
    pinned("march", seen.light, [0.0683753267, 0.116040759, 0.3961882], 10.0 * SINGLE);
    pinned("march, transmittance", seen.transmittance, [0.87835151], 10.0 * SINGLE);
}
