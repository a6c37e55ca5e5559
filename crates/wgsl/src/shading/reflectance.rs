//! Reflectances: Fresnel terms, diffuse and glossy models.

use asperity_shading::gpu::{CoatUniform, OpenPbrUniform, StandardMaterialUniform};

use crate::ndf::{BECKMANN, ELEMENTARY, FRAME, GAUSSIAN_SPLIT, GGX, NORMAL_DISTRIBUTION};
use crate::part::{Binding, Element, Part, part};
use crate::shading::bump::{SLOPE_FACETS, SURFACE_GRADIENT};
use crate::shading::{DIRECTION, MATH};

/// Clamps reflectances to finite, non-negative values.
pub(crate) static BRDF: Part = part!("shading/reflectance/brdf", MATH);

/// Schlick's approximation, plain and with a tint at 82°: [`Schlick`](asperity_shading::Schlick),
/// [`SchlickF82`](asperity_shading::reflectance::SchlickF82).
pub static SCHLICK: Part = part!("shading/reflectance/fresnel/schlick", MATH);

/// Fresnel reflectance of a dielectric, [`Dielectric`](asperity_shading::Dielectric).
pub static DIELECTRIC: Part = part!("shading/reflectance/fresnel/dielectric", MATH);

/// Fresnel reflectance of a metal, [`Conductor`](asperity_shading::Conductor).
pub static CONDUCTOR: Part = part!("shading/reflectance/fresnel/conductor", MATH);

/// Lambertian reflectance, [`Lambert`](asperity_shading::Lambert).
pub static LAMBERT: Part = part!("shading/reflectance/diffuse/lambert", DIRECTION);

/// Common geometry of rough diffuse reflectances.
pub(crate) static ROUGH: Part = part!("shading/reflectance/diffuse/rough", MATH);

/// Oren–Nayar reflectance in three forms, [`OrenNayar`](asperity_shading::reflectance::OrenNayar).
pub static OREN_NAYAR: Part = part!("shading/reflectance/diffuse/oren_nayar", BRDF, DIRECTION, ROUGH);

/// Energy-preserving Oren–Nayar reflectance,
/// [`EnergyPreservingOrenNayar`](asperity_shading::EnergyPreservingOrenNayar).
pub static ENERGY_PRESERVING: Part =
    part!("shading/reflectance/diffuse/energy_preserving", BRDF, DIRECTION, ROUGH);

/// Beckmann microfacets with Smith masking, [`CookTorrance`](asperity_shading::CookTorrance).
pub static COOK_TORRANCE_BECKMANN: Part =
    part!("shading/reflectance/cook_torrance_beckmann", BRDF, DIRECTION, BECKMANN);

/// GGX microfacets with Smith masking, [`CookTorrance`](asperity_shading::CookTorrance).
pub static COOK_TORRANCE_GGX: Part = part!("shading/reflectance/cook_torrance_ggx", BRDF, DIRECTION, GGX);

/// Microfacets of any normal distribution over grooves,
/// [`TorranceSparrow`](asperity_shading::TorranceSparrow).
pub static TORRANCE_SPARROW: Part = part!("shading/reflectance/torrance_sparrow", BRDF, DIRECTION);

/// Cosine-power lobes, [`Phong`](asperity_shading::Phong) and
/// [`BlinnPhongBrdf`](asperity_shading::reflectance::BlinnPhongBrdf).
pub static PHONG: Part = part!("shading/reflectance/phong", BRDF, DIRECTION, ELEMENTARY);

/// Ward's anisotropic reflectance in three forms,
/// [`WardBrdf`](asperity_shading::reflectance::WardBrdf).
pub static WARD: Part = part!("shading/reflectance/ward", BRDF, DIRECTION, ELEMENTARY);

/// Light from a facet of a surface, as summed by [`Bsdf`](asperity_shading::Bsdf).
pub(crate) static FACET: Part = part!("shading/reflectance/facet", SURFACE_GRADIENT, FRAME, BRDF);

/// Frosted glass, walls and bodies,
/// [`RoughDielectric`](asperity_shading::reflectance::RoughDielectric).
pub static ROUGH_DIELECTRIC: Part =
    part!("shading/reflectance/rough_dielectric", BRDF, DIRECTION, DIELECTRIC, BECKMANN, ELEMENTARY);

/// Splines of the tables of albedos, and the factor of
/// [`EnergyCompensated`](asperity_shading::reflectance::EnergyCompensated).
pub static ENERGY: Part = part!("shading/reflectance/energy/spline", MATH);

/// Directional albedo of GGX mirrors, [`GgxAlbedo`](asperity_shading::reflectance::GgxAlbedo).
///
/// Bound to [`GgxAlbedo::table`](asperity_shading::reflectance::GgxAlbedo::table) as the table
/// `ggx_albedo_number`.
pub static GGX_ALBEDO: Part = part!("shading/reflectance/energy/ggx_albedo", ENERGY)
    .with_bindings(&[Binding::Table { name: "ggx_albedo_number", element: Element::Float, width: 64 }]);

/// Directional albedo of rough glass, [`GlassAlbedo`](asperity_shading::reflectance::GlassAlbedo).
///
/// Bound to [`GlassAlbedo::table`](asperity_shading::reflectance::GlassAlbedo::table) as the table
/// `glass_albedo_number`.
pub static GLASS_ALBEDO: Part = part!("shading/reflectance/energy/glass_albedo", ENERGY)
    .with_bindings(&[Binding::Table { name: "glass_albedo_number", element: Element::Float, width: 128 }]);

/// Fuzz by linearly transformed cosines,
/// [`ZeltnerFuzz`](asperity_shading::reflectance::ZeltnerFuzz).
pub static ZELTNER_FUZZ: Part = part!("shading/reflectance/fuzz/zeltner", BRDF, DIRECTION, ELEMENTARY);

/// Charlie sheen, [`CharlieSheen`](asperity_shading::reflectance::CharlieSheen).
///
/// Bound to [`CharlieSheen::table`](asperity_shading::reflectance::CharlieSheen::table) as the
/// table `charlie_albedo_number`.
pub static CHARLIE_SHEEN: Part =
    part!("shading/reflectance/fuzz/charlie", BRDF, DIRECTION, ELEMENTARY, ENERGY).with_bindings(&[
        Binding::Table { name: "charlie_albedo_number", element: Element::Float, width: 64 },
    ]);

/// Smooth and rough coats over the layers of a surface,
/// [`Coat`](asperity_shading::reflectance::Coat): transmission to the layers, reflection and
/// transmission.
///
/// Apply a coat to any material by `coat_over(coat, material(point, wo, wi), wo, wi)` and
/// `coat_specular_samples`.
pub static COAT: Part = part!(
    "shading/reflectance/coat",
    [CoatUniform],
    SLOPE_FACETS,
    FACET,
    COOK_TORRANCE_BECKMANN,
    DIELECTRIC,
    ROUGH_DIELECTRIC,
    ELEMENTARY,
);

/// Fuzz over a coat over gloss, diffuse light and glass, with bumps that are exact at every zoom.
static STANDARD_LAYERS: Part = part!(
    "shading/reflectance/standard/layers",
    CHARLIE_SHEEN,
    ZELTNER_FUZZ,
    COOK_TORRANCE_GGX,
    ENERGY_PRESERVING,
    GAUSSIAN_SPLIT,
    NORMAL_DISTRIBUTION,
    GGX_ALBEDO,
    GLASS_ALBEDO,
    ROUGH_DIELECTRIC,
);

/// The material of glTF 2.0, [`StandardMaterial`](asperity_shading::StandardMaterial): reflection
/// and emission, with bumps that are exact at every zoom.
///
/// The light that crosses a transmitting surface is not part of it.
pub static STANDARD_MATERIAL: Part =
    part!("shading/reflectance/standard/standard_material", [StandardMaterialUniform], STANDARD_LAYERS);

/// The material of OpenPBR Surface 1.1, [`OpenPbr`](asperity_shading::OpenPbr), like
/// [`STANDARD_MATERIAL`].
pub static OPEN_PBR: Part =
    part!("shading/reflectance/standard/open_pbr", [OpenPbrUniform], STANDARD_LAYERS, DIELECTRIC);
