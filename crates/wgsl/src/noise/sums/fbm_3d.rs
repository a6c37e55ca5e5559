//! Sums of octaves in 3-D for every kind of noise, and building blocks for custom kinds.

use super::UNIFORM_3D;
use super::fbm::{fbm, octave_part};

fbm!(
    ["3", "in 3-D", "layer.cell_and_key.xyz", "bitcast<u32>(layer.cell_and_key.w)"],
    UNIFORM_3D,
    [
        VALUE,
        VALUE_CATMULL_ROM,
        PERLIN_CLASSIC,
        PERLIN,
        VALUE_GRADIENT,
        SIMPLEX,
        SIMPLEX_WIDE,
        SPARSE,
        GAUSSIAN
    ]
);
