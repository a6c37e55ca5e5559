//! The page's programs: parts of the crate combined with parts of the page.

mod materials;

use asperity_wgsl::{Binding, Part, fif, ndf, noise as noise_parts, shading};

/// A vertex and a fragment entry point of one composition.
pub(crate) struct Program {
    pub(crate) name: &'static str,
    pub(crate) part: &'static Part,
    pub(crate) vertex: &'static str,
    pub(crate) fragment: &'static str,
}

macro_rules! page_part {
    ($name:literal, $($need:expr),* $(,)?) => {
        page_part!($name; $($need),*)
    };
    ($($name:literal),+; $($need:expr),* $(,)?) => {
        Part::new(
            concat!("page/" $(, $name)+),
            include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/../page/wgsl/" $(, $name)+, ".wgsl")),
            &[$(&$need),*],
        )
    };
}

mod noise;

pub(crate) static SCREEN: Part = page_part!("screen",);
pub(crate) static DISPLAY: Part = page_part!("display",);

mod bumps {
    use super::*;

    const VIEW: &[Binding] = &[Binding::Uniform { name: "bumps_view", of: "BumpsView" }];

    static DENSITY_GGX: Part = page_part!("density_ggx", ndf::GGX);
    static DENSITY_BECKMANN: Part = page_part!("density_beckmann", ndf::BECKMANN);
    static DENSITY_STUDENT_T: Part = page_part!("density_student_t", ndf::STUDENT_T);
    static DENSITY_PAINTED: Part = page_part!("density_painted", ndf::PACKED_MAP);

    macro_rules! bumps {
        ($density:expr) => {
            page_part!(
                "bumps",
                $density,
                noise_parts::GAUSSIAN_SLOPES_3D,
                shading::LEVEL_OF_DETAIL,
                SCREEN,
                DISPLAY,
            )
            .with_bindings(VIEW)
        };
    }

    pub(super) static GGX: Part = bumps!(DENSITY_GGX);
    pub(super) static BECKMANN: Part = bumps!(DENSITY_BECKMANN);
    pub(super) static STUDENT_T: Part = bumps!(DENSITY_STUDENT_T);
    pub(super) static PAINTED: Part = bumps!(DENSITY_PAINTED);
}

const fn program(name: &'static str, part: &'static Part, [vertex, fragment]: [&'static str; 2]) -> Program {
    Program { name, part, vertex, fragment }
}

const BUMPS: [&str; 2] = ["bumps_corner", "bumps_pixel"];
const PATCH: [&str; 2] = ["screen_corner", "bumps_patch"];
const SCATTERED: [&str; 2] = ["screen_corner", "bumps_scattered"];

/// Programs of bumps.
static OF_BUMPS: &[Program] = &[
    program("bumps-ggx", &bumps::GGX, BUMPS),
    program("bumps-beckmann", &bumps::BECKMANN, BUMPS),
    program("bumps-student-t", &bumps::STUDENT_T, BUMPS),
    program("bumps-painted", &bumps::PAINTED, BUMPS),
    program("patch-ggx", &bumps::GGX, PATCH),
    program("patch-beckmann", &bumps::BECKMANN, PATCH),
    program("patch-student-t", &bumps::STUDENT_T, PATCH),
    program("patch-painted", &bumps::PAINTED, PATCH),
    program("scattered-ggx", &bumps::GGX, SCATTERED),
    program("scattered-beckmann", &bumps::BECKMANN, SCATTERED),
    program("scattered-student-t", &bumps::STUDENT_T, SCATTERED),
    program("scattered-painted", &bumps::PAINTED, SCATTERED),
];

/// Code snippets for copying, equal to the module's computation: name, part, functions to call.
pub(crate) static COPIED: &[(&str, &Part, &[&str])] = &[
    ("fractals", &INTERSECT, &["height_field_intersect", "height_field_height", "upward_normal"]),
    ("fractals-folded", &FOLDED, &["folded_surface_height", "folded_surface_jet", "upward_normal"]),
];

/// Surfaces with their normals.
static INTERSECT: Part = Part::new("page/intersect", "", &[&fif::INTERSECT]);
static FOLDED: Part = Part::new("page/folded", "", &[&fif::FOLDED_SURFACE]);

/// Returns every program of the page.
pub(crate) fn all() -> impl Iterator<Item = &'static Program> {
    OF_BUMPS.iter().chain(noise::programs()).chain(&materials::ALL)
}
