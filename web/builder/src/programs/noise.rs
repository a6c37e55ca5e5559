//! Noise slices: a program per noise and dimension. The programs differ only in the octave
//! function.

use asperity_wgsl::noise::sums::{self, fbm_2d, fbm_3d, fbm_4d};
use asperity_wgsl::noise::{self, transforms};
use asperity_wgsl::{Binding, Part};

use super::{Program, SCREEN, program};

const VIEW: &[Binding] = &[Binding::Uniform { name: "noise_view", of: "NoiseView" }];

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
    ($module:ident, $dimension:literal, $n:literal, $cell:literal, $key:literal, $sums:ident, $uniform:path,
     $warp:path, $curl:path, $($name:literal $kind:path { $($octave:tt)* })*) => {
        mod $module {
            use super::*;

            pub(super) static PROGRAMS: &[Program] = &[$({
                static OCTAVE: Part = Part::new(
                    concat!("page/noise_octave_", $name, "_", $dimension),
                    octave!($dimension, $n, $cell, $key, $($octave)*),
                    &[&noise::SAMPLE, &noise::CELL, &$kind, &sums::OCTAVE],
                );
                static PART: Part = page_part!(
                    "noise_", $dimension;
                    OCTAVE, sums::SHAPE, sums::SPECTRUM, $uniform, $sums::TOTAL, $sums::RIDGED_MULTIFRACTAL, $warp, $curl, SCREEN, SEEN,
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

slices!(plane, "2d", "2", "layer.cell", "layer.key", fbm_2d, sums::UNIFORM_2D, transforms::WARP, transforms::CURL,
    "white" noise::WHITE { white }
    "value" noise::VALUE { cell "value" "" }
    "catmull-rom" noise::VALUE_CATMULL_ROM { cell "value_catmull_rom" "" }
    "perlin-1985" noise::PERLIN_CLASSIC { cell "perlin_classic" "" }
    "perlin-2002" noise::PERLIN { cell "perlin" "" }
    "value-gradient" noise::VALUE_GRADIENT { cell "value_gradient" "0.5, " }
    "simplex" noise::SIMPLEX { simplex "simplex" }
    "simplex-wide" noise::SIMPLEX { simplex "simplex_wide" }
    "sparse" noise::SPARSE { cell "sparse" "1u, " }
    "gaussian" noise::GAUSSIAN { cell "gaussian" "" }
    "cellular" noise::CELLULAR { cell "cellular" "noise_view.basis, noise_view.metric, noise_view.jitter, " }
);

slices!(space, "3d", "3", "layer.cell_and_key.xyz", "bitcast<u32>(layer.cell_and_key.w)", fbm_3d, sums::UNIFORM_3D,
    transforms::WARP, transforms::CURL,
    "white" noise::WHITE { white }
    "value" noise::VALUE { cell "value" "" }
    "catmull-rom" noise::VALUE_CATMULL_ROM { cell "value_catmull_rom" "" }
    "perlin-1985" noise::PERLIN_CLASSIC { cell "perlin_classic" "" }
    "perlin-2002" noise::PERLIN { cell "perlin" "" }
    "value-gradient" noise::VALUE_GRADIENT { cell "value_gradient" "0.5, " }
    "simplex" noise::SIMPLEX { simplex "simplex" }
    "simplex-wide" noise::SIMPLEX { simplex "simplex_wide" }
    "sparse" noise::SPARSE { cell "sparse" "1u, " }
    "gaussian" noise::GAUSSIAN { cell "gaussian" "" }
    "cellular" noise::CELLULAR { cell "cellular" "noise_view.basis, noise_view.metric, noise_view.jitter, " }
);

slices!(time, "4d", "4", "layer.cell", "layer.key", fbm_4d, sums::UNIFORM_4D, SCREEN, SCREEN,
    "value" noise::VALUE { cell "value" "" }
    "perlin-2002" noise::PERLIN { cell "perlin" "" }
    "simplex" noise::SIMPLEX { simplex "simplex" }
    "simplex-wide" noise::SIMPLEX { simplex "simplex_wide" }
);

/// Returns the scene's programs.
pub(super) fn programs() -> impl Iterator<Item = &'static Program> {
    plane::PROGRAMS.iter().chain(space::PROGRAMS).chain(time::PROGRAMS)
}
