//! Sums of octaves in 4-D for the kinds in 4-D, and building blocks for custom kinds.

use super::UNIFORM_4D;
use super::fbm::{fbm, octave_part};

fbm!(["4", "in 4-D", "layer.cell", "layer.key"], UNIFORM_4D, [VALUE, PERLIN, SIMPLEX, SIMPLEX_WIDE]);
