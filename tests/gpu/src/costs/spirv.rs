//! Operations of the functions of a SPIR-V module.

use std::collections::HashMap;
use std::ops::{Add, AddAssign};

const HEADER: usize = 5;

/// Operations on scalars, and texel reads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Operations {
    /// Sums, products, comparisons, roundings, min and max of floats; a fused pair is two.
    pub(crate) floats: u32,
    /// Quotients, roots and transcendental functions, which GPUs compute at a quarter of the rate
    /// or less.
    pub(crate) special: u32,
    /// Integer operations, conversions and selections.
    pub(crate) integers: u32,
    /// Texels fetched or filtered.
    pub(crate) texels: u32,
}

impl AddAssign for Operations {
    fn add_assign(&mut self, other: Self) {
        self.floats += other.floats;
        self.special += other.special;
        self.integers += other.integers;
        self.texels += other.texels;
    }
}

/// Operations of a function and everything it calls, including both branches of every selection.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Cost {
    /// Outside loops.
    pub(crate) once: Operations,
    /// In loop bodies, each body once.
    pub(crate) turn: Operations,
}

impl Cost {
    fn add(&mut self, other: Self, in_loop: bool) {
        if in_loop {
            self.turn += other.once;
        } else {
            self.once += other.once;
        }
        self.turn += other.turn;
    }

    /// Returns all operations, each loop body once.
    pub(crate) fn total(self) -> Operations {
        self.once + self.turn
    }
}

impl Add for Operations {
    type Output = Self;

    fn add(mut self, other: Self) -> Self {
        self += other;
        self
    }
}

/// Returns the costs of named functions. Functions follow their callees in naga's output.
pub(crate) fn costs(words: &[u32]) -> HashMap<String, Cost> {
    let mut names: HashMap<u32, String> = HashMap::new();
    // Number of components of vectors; columns, and components per column, of matrices.
    let mut shapes: HashMap<u32, [u32; 2]> = HashMap::new();
    // The type of every value, because the cost of a matrix product depends on the operand's shape.
    let mut types: HashMap<u32, u32> = HashMap::new();
    let mut costs: HashMap<u32, Cost> = HashMap::new();
    let (mut function, mut cost, mut loops) = (0, Cost::default(), vec![]);
    let mut at = HEADER;
    while let Some(&first) = words.get(at) {
        let (length, code) = ((first >> 16).max(1) as usize, first & 0xFFFF);
        let operands = words.get(at + 1..at + length).unwrap_or_default();
        at += length;
        let operand = |k: usize| operands.get(k).copied().unwrap_or_default();
        types.insert(operand(1), operand(0));
        let shape = |of: u32| shapes.get(&of).copied().unwrap_or([1, 1]);
        match code {
            // OpName
            5 => {
                let bytes = operands[1..].iter().flat_map(|word| word.to_le_bytes());
                let bytes: Vec<u8> = bytes.take_while(|byte| *byte != 0).collect();
                names.insert(operand(0), String::from_utf8_lossy(&bytes).into_owned());
            }
            // OpTypeVector, OpTypeMatrix
            23 => drop(shapes.insert(operand(0), [1, operand(2)])),
            24 => drop(shapes.insert(operand(0), [operand(2), shape(operand(1))[1]])),
            // OpFunction, OpFunctionEnd
            54 => (function, cost) = (operand(1), Cost::default()),
            56 => drop(costs.insert(function, cost)),
            // OpLoopMerge, and the label after the loop.
            246 => loops.push(operand(0)),
            248 if loops.last() == Some(&operand(0)) => drop(loops.pop()),
            // OpFunctionCall
            57 => {
                let called = costs.get(&operand(2)).copied().unwrap_or_default();
                cost.add(called, !loops.is_empty());
            }
            _ => {
                let result = shape(operand(0));
                let argument = |k: usize| shape(types.get(&operand(k)).copied().unwrap_or_default());
                let once = operations(code, result, argument, operand(3));
                cost.add(Cost { once, ..Cost::default() }, !loops.is_empty());
            }
        }
    }
    costs.into_iter().filter_map(|(function, cost)| Some((names.remove(&function)?, cost))).collect()
}

/// Returns the operations of one instruction whose result has these columns and components.
fn operations(
    code: u32,
    [columns, rows]: [u32; 2],
    argument: impl Fn(usize) -> [u32; 2],
    extended: u32,
) -> Operations {
    let count = columns * rows;
    let floats = |floats| Operations { floats, ..Operations::default() };
    let special = |special| Operations { special, ..Operations::default() };
    let integers = |integers| Operations { integers, ..Operations::default() };
    match code {
        // Negation, sum, difference, product; products with scalars, outer products; comparisons,
        // NaN tests.
        127 | 129 | 131 | 133 | 142 | 143 | 147 | 156..=158 | 180..=191 => floats(count),
        // Quotient, remainders.
        136 | 140 | 141 => special(count),
        // Products of vectors and matrices: `2 n − 1` for a sum of n products.
        144..=146 | 148 => {
            let [columns, rows] = argument(2);
            let terms = if matches!(code, 144 | 148) { rows } else { columns };
            floats(count * (2 * terms - 1))
        }
        // GLSL.std.450
        12 => match extended {
            // Roundings, absolute value, sign, fraction, least, largest, step.
            1..=4 | 6 | 8..=10 | 37 | 40 | 48 | 79 | 80 => floats(count),
            // Clamp, a product with a sum; mix; smooth step.
            43 | 50 | 53 | 81 => floats(2 * count),
            46 => floats(3 * count),
            49 => floats(7 * count),
            13..=32 => special(count),
            // Length and distance: a dot and a root; unit length: three products more.
            66 | 67 => {
                let [_, rows] = argument(4);
                floats(2 * rows - 1) + special(1)
            }
            69 => floats(3 * rows - 1) + special(1),
            68 => floats(9),
            _ => integers(count),
        },
        // Conversions, sums, products, remainders, choices, logic, comparisons, shifts, masks.
        109..=114 | 126 | 128 | 130 | 132 | 134 | 135 | 137..=139 | 149..=152 | 164..=179 | 194..=205 => {
            integers(count)
        }
        // Samples, fetches, gathered texels, reads.
        87..=98 => Operations { texels: 1, ..Operations::default() },
        _ => Operations::default(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dialect;

    #[test]
    fn operations_are_counted_per_component_and_loop() {
        let wgsl = "
            @group(0) @binding(0) var table: texture_2d<f32>;
            fn texel(x: i32) -> f32 { return textureLoad(table, vec2<i32>(x, 0), 0).x; }
            fn scaled(v: vec3<f32>, s: f32) -> vec3<f32> { return v * s + v; }
            fn length_of(v: vec3<f32>) -> f32 { return sqrt(dot(v, v)) / 3.0; }
            fn turned(m: mat3x3<f32>, v: vec3<f32>) -> vec3<f32> { return m * v; }
            fn word(a: u32) -> u32 { return (a ^ (a >> 16u)) * 5u; }
            fn sum(n: u32) -> f32 {
                var s = f32(n);
                for (var i = 0u; i < n; i++) { s += texel(i32(i)); }
                return s;
            }
            fn twice(n: u32) -> f32 { return sum(n) * sum(n); }";
        let costs = costs(&dialect::counted(wgsl).unwrap());
        let of = |name: &str| {
            let Cost { once, turn } = costs[name];
            [once, turn].map(|o| [o.floats, o.special, o.integers, o.texels])
        };
        assert_eq!(of("texel"), [[0, 0, 0, 1], [0; 4]]);
        assert_eq!(of("scaled"), [[6, 0, 0, 0], [0; 4]]);
        assert_eq!(of("length_of"), [[5, 2, 0, 0], [0; 4]]);
        assert_eq!(of("turned"), [[15, 0, 0, 0], [0; 4]]);
        assert_eq!(of("word"), [[0, 0, 3, 0], [0; 4]]);
        // In the loop: the comparison, a logic operation, the counter and the integer conversion,
        // one float sum.
        let [once, turn] = of("sum");
        assert_eq!(once, [0, 0, 1, 0]);
        assert_eq!([turn[0], turn[1], turn[3]], [1, 0, 1]);
        assert!((2..=4).contains(&turn[2]), "{turn:?}");
        assert_eq!(of("twice")[1], turn.map(|x| 2 * x));
        assert_eq!(of("twice")[0], [1, 0, 2, 0]);
    }
}
