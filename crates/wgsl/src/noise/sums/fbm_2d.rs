//! Sums of octaves in 2-D for every kind of noise, and building blocks for custom kinds.

use super::UNIFORM_2D;
use super::fbm::{fbm, octave_part};

fbm!(
    ["2", "in 2-D", "layer.cell", "layer.key"],
    UNIFORM_2D,
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
