//! Programs of the materials scene.

use asperity_wgsl::shading::{material, reflectance, texture};
use asperity_wgsl::{Binding, Element, Part};

use super::{DISPLAY, Program, SCREEN, program};

macro_rules! page_part {
    ($name:literal, $($need:expr),* $(,)?) => {
        Part::new(concat!("page/", $name), include_str!(concat!("../../../page/wgsl/", $name, ".wgsl")), &[$(&$need),*])
    };
}

static LIGHT: Part = page_part!("light",).with_bindings(&[
    Binding::Uniform { name: "light", of: "Light" },
    Binding::Table { name: "light_word", element: Element::Word, width: 256 },
]);

const VIEW: &[Binding] = &[Binding::Uniform { name: "materials_view", of: "MaterialsView" }];

static COATED: Part = page_part!("coated", reflectance::COOK_TORRANCE_BECKMANN, reflectance::COAT);

static GLOSSY: Part = page_part!("glossy_lit", reflectance::COOK_TORRANCE_BECKMANN);

static PAINT: Part = page_part!("material_paint", material::METALLIC_PAINT, COATED);
static CARPET: Part = page_part!("material_carpet", material::CARPET, GLOSSY);
static VARIATIONS: Part = page_part!("material_variations", material::VARIATIONS, GLOSSY);
static SCRATCHES: Part = page_part!("material_scratches", material::SCRATCHES);
static GLASS: Part = page_part!("material_glass", material::TEMPERED_GLASS, COATED);
static BRICK: Part = page_part!("material_brick", material::BRICK_WALL);
static MARBLE: Part = page_part!("material_marble", material::POLISHED_MARBLE, COATED);
static PLAIN: Part = page_part!("material_plain", reflectance::COOK_TORRANCE_BECKMANN);

macro_rules! surfaces {
    ($($name:ident = $of:ident;)*) => {
        $(static $name: Part = page_part!(
            "materials",
            reflectance::COOK_TORRANCE_BECKMANN,
            $of,
            LIGHT,
            material::SURFACE_POINT,
            DISPLAY,
        )
        .with_bindings(VIEW);)*
    };
}

surfaces! {
    OF_PAINT = PAINT;
    OF_CARPET = CARPET;
    OF_VARIATIONS = VARIATIONS;
    OF_SCRATCHES = SCRATCHES;
    OF_GLASS = GLASS;
    OF_BRICK = BRICK;
    OF_MARBLE = MARBLE;
    OF_PLAIN = PLAIN;
}

static BEHIND: Part = page_part!("behind", OF_PLAIN, SCREEN);
static STEAM: Part = page_part!("steam", OF_PLAIN, texture::GAS).with_bindings(&[
    Binding::Uniform { name: "steam_gas", of: "Gas" },
    Binding::Uniform { name: "steam_view", of: "SteamView" },
]);

const SURFACE: [&str; 2] = ["materials_corner", "materials_pixel"];

/// The programs.
pub(super) static ALL: [Program; 10] = [
    program("materials-paint", &OF_PAINT, SURFACE),
    program("materials-carpet", &OF_CARPET, SURFACE),
    program("materials-variations", &OF_VARIATIONS, SURFACE),
    program("materials-scratches", &OF_SCRATCHES, SURFACE),
    program("materials-glass", &OF_GLASS, SURFACE),
    program("materials-brick", &OF_BRICK, SURFACE),
    program("materials-marble", &OF_MARBLE, SURFACE),
    program("materials-plain", &OF_PLAIN, SURFACE),
    program("materials-behind", &BEHIND, ["screen_corner", "behind_pixel"]),
    program("materials-steam", &STEAM, ["materials_corner", "steam_pixel"]),
];
