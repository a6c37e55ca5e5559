//! Noise slices: a program per noise and dimension. The programs differ only in the octave
//! function.

use asperity_wgsl::noise::{self, CURL, FBM_2D, FBM_3D, FBM_4D, WARP};
use asperity_wgsl::{Binding, Part};

use super::{Program, SCREEN, program};

const VIEW: &[Binding] = &[Binding::Uniform { name: "noise_view", of: "NoiseView" }];

/// Domain warping and velocities.
static FLOW: Part = Part::new("page/flow", "", &[&WARP, &CURL]);

static SEEN: Part = page_part!("noise_view",).with_bindings(VIEW);

/// The octave function in WGSL: the noise at its cell and the position within the cell. Simplex
/// noise uses its own coordinates.
macro_rules! octave {
    ($dimension:literal, $n:literal, $cell:literal, $key:literal, cell $function:literal $further:literal) => {
        octave!(@ $dimension, $n, concat!("    let at = cell_place_", $dimension, "(fbm_point_", $dimension, "(layer, p));
    return sample_known_", $dimension, "(", $function, "_in_cell_", $dimension, "(", $cell, " + at.cell, at.place, ", $further, $key, "), at.known);"))
    };
    ($dimension:literal, $n:literal, $cell:literal, $key:literal, white) => {
        octave!(@ $dimension, $n, concat!("    let at = cell_place_", $dimension, "(fbm_point_", $dimension, "(layer, p));
    let value = white_in_cell_", $dimension, "(", $cell, " + at.cell, ", $key, ");
    return sample_known_", $dimension, "(Sample", $dimension, "(value, vec", $n, "<f32>(0.0)), at.known);"))
    };
    ($dimension:literal, $n:literal, $cell:literal, $key:literal, simplex $function:literal) => {
        octave!(@ $dimension, $n, concat!("    return ", $function, "_in_cell_", $dimension, "(", $cell, ", fbm_point_", $dimension, "(layer, p), ", $key, ");"))
    };
    (@ $dimension:literal, $n:literal, $body:expr) => {
        concat!("fn noise_octave_", $dimension, "(layer: FbmLayer", $dimension, ", p: vec", $n, "<f32>) -> Sample", $dimension, " {\n", $body, "\n}\n")
    };
}

/// Programs of a dimension: name, part of the crate, and octave function.
macro_rules! slices {
    ($module:ident, $dimension:literal, $n:literal, $cell:literal, $key:literal, $sums:ident, $flow:ident,
     $($name:literal $kind:path { $($octave:tt)* })*) => {
        mod $module {
            use super::*;

            pub(super) static PROGRAMS: &[Program] = &[$({
                static OCTAVE: Part = Part::new(
                    concat!("page/noise_octave_", $name, "_", $dimension),
                    octave!($dimension, $n, $cell, $key, $($octave)*),
                    &[&$kind, &$sums.custom],
                );
                static PART: Part = page_part!(
                    "noise_", $dimension;
                    OCTAVE, $sums.custom, $flow, SCREEN, SEEN,
                );
                program(
                    concat!("noise-", $name, "-", $dimension),
                    &PART,
                    ["screen_corner", concat!("noise_pixel_", $dimension)],
                )
            }),*];
        }
    };
}

slices!(plane, "2d", "2", "layer.cell", "layer.key", FBM_2D, FLOW,
    "white" noise::WHITE { white }
    "value" noise::VALUE { cell "value" "" }
    "catmull-rom" noise::VALUE_CATMULL_ROM { cell "value_catmull_rom" "" }
    "perlin-1985" noise::PERLIN_CLASSIC { cell "perlin_classic" "" }
    "perlin-2002" noise::PERLIN { cell "perlin" "" }
    "value-gradient" noise::VALUE_GRADIENT { cell "value_gradient" "0.5, " }
    "simplex" noise::SIMPLEX { simplex "simplex" }
    "simplex-wide" noise::SIMPLEX { simplex "simplex_classic" }
    "sparse" noise::SPARSE_CONVOLUTION { cell "sparse_convolution" "1u, " }
    "gaussian" noise::GAUSSIAN { cell "gaussian" "" }
    "cellular" noise::CELLULAR { cell "cellular" "noise_view.basis, noise_view.metric, noise_view.jitter, " }
);

slices!(space, "3d", "3", "layer.cell_and_key.xyz", "bitcast<u32>(layer.cell_and_key.w)", FBM_3D, FLOW,
    "white" noise::WHITE { white }
    "value" noise::VALUE { cell "value" "" }
    "catmull-rom" noise::VALUE_CATMULL_ROM { cell "value_catmull_rom" "" }
    "perlin-1985" noise::PERLIN_CLASSIC { cell "perlin_classic" "" }
    "perlin-2002" noise::PERLIN { cell "perlin" "" }
    "value-gradient" noise::VALUE_GRADIENT { cell "value_gradient" "0.5, " }
    "simplex" noise::SIMPLEX { simplex "simplex" }
    "simplex-wide" noise::SIMPLEX { simplex "simplex_classic" }
    "sparse" noise::SPARSE_CONVOLUTION { cell "sparse_convolution" "1u, " }
    "gaussian" noise::GAUSSIAN { cell "gaussian" "" }
    "cellular" noise::CELLULAR { cell "cellular" "noise_view.basis, noise_view.metric, noise_view.jitter, " }
);

slices!(time, "4d", "4", "layer.cell", "layer.key", FBM_4D, SCREEN,
    "value" noise::VALUE { cell "value" "" }
    "perlin-2002" noise::PERLIN { cell "perlin" "" }
    "simplex" noise::SIMPLEX { simplex "simplex" }
    "simplex-wide" noise::SIMPLEX { simplex "simplex_classic" }
);

/// Returns the scene's programs.
pub(super) fn programs() -> impl Iterator<Item = &'static Program> {
    plane::PROGRAMS.iter().chain(space::PROGRAMS).chain(time::PROGRAMS)
}
