//! Sums of octaves in 4-D for the kinds in 4-D, and building blocks for custom kinds.

use super::UNIFORM_4D;
use super::octaves::{octave_part, octaves};

octaves!(["4", "in 4-D", "layer.cell", "layer.key"], UNIFORM_4D, [VALUE, PERLIN_2002, SIMPLEX, SIMPLEX_WIDE]);
