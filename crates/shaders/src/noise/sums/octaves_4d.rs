//! Sums of octaves in four dimensions, of the kinds that move in space; and what sums of a kind of one's own are made of.

use super::UNIFORM_4D;
use super::octaves::{octave_part, octaves};

octaves!(
    ["4", "in four dimensions", "layer.cell", "layer.key"],
    UNIFORM_4D,
    [VALUE, PERLIN_2002, SIMPLEX, SIMPLEX_WIDE]
);
