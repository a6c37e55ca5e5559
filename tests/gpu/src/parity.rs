//! Cases as compute shaders, and the table of their errors.

use std::path::Path;

use asperity_shader_tests::case::{Bound, Case, INPUTS, OUTPUTS, Output};
use asperity_shader_tests::interpreter::Arithmetic;
use wgpu::Backends;

use crate::{
    compute::Kernel,
    device::{self, Gpu},
    entry,
};

/// Source of a column's outcomes: the interpreter with one arithmetic or the other, or an adapter.
enum Column {
    Interpreter(Arithmetic),
    Adapter(Gpu),
}

impl Column {
    fn name(&self) -> &str {
        match self {
            Self::Interpreter(Arithmetic::Fused) => "no driver, fused",
            Self::Interpreter(_) => "no driver",
            Self::Adapter(gpu) => &gpu.name,
        }
    }

    fn outcomes(&self, case: &Case, inputs: &[[u32; INPUTS]]) -> Result<Vec<[u32; OUTPUTS]>, String> {
        match self {
            Self::Interpreter(arithmetic) => {
                let shader = case.interpreter()?.arithmetic(*arithmetic);
                let outcomes = shader.call_many("evaluate", inputs)?;
                Ok(outcomes.iter().map(|outcome| std::array::from_fn(|k| outcome.words()[k])).collect())
            }
            Self::Adapter(gpu) => outcomes(gpu, case, inputs),
        }
    }
}

/// Prints the table of functions and adapters, writes it where that is asked for, and fails where a bound is broken.
///
/// Without any adapter that is said in a line, and the interpreter is tried alone.
pub(crate) fn run(cases: &[Case], adapter: Option<&str>, out: Option<&Path>) -> Result<(), String> {
    let mut columns = vec![Column::Interpreter(Arithmetic::Written), Column::Interpreter(Arithmetic::Fused)];
    let gpus = device::find(adapter, Backends::all());
    if gpus.is_empty() {
        match adapter {
            Some(_) => return Err(device::none(adapter)),
            None => println!("no driver is tried: {}", device::none(None)),
        }
    }
    columns.extend(gpus.into_iter().map(Column::Adapter));
    let names: Vec<_> = columns.iter().map(Column::name).collect();
    let mut table = format!("| function | quantity | bound | {} |\n|---|---|---|", names.join(" | "));
    table += &"---|".repeat(columns.len());
    table += "\n";
    print!("{table}");
    let mut broken = Vec::new();
    for case in cases {
        let inputs: Vec<[u32; INPUTS]> = (0..Case::COUNT).map(|i| (case.input)(i)).collect();
        let expected: Vec<_> = inputs.iter().map(|input| (case.reference)(*input)).collect();
        let outcomes = columns.iter().map(|column| column.outcomes(case, &inputs));
        let outcomes: Vec<_> = outcomes.collect::<Result<_, _>>()?;
        for output in &case.outputs {
            let mut row = format!("| {} | {} | {} |", case.name, output.name, bound(output.adapter));
            for (column, got) in columns.iter().zip(&outcomes) {
                let limit = match column {
                    Column::Interpreter(Arithmetic::Written) => output.written,
                    _ => output.adapter,
                };
                let found = Found::new(column, output, limit, &inputs, got, &expected);
                row += &format!(" {} |", found.cell());
                if found.largest > limit.limit() {
                    let input = inputs[found.worst].map(f32::from_bits);
                    let (name, error) = (column.name(), found.largest);
                    let words = |words: &[u32; OUTPUTS]| words[output.words.clone()].to_vec();
                    let [got, expected] = [&got[found.worst], &expected[found.worst]].map(words);
                    let [got, expected] =
                        [got, expected].map(|w| w.into_iter().map(f32::from_bits).collect::<Vec<_>>());
                    broken.push(format!(
                        "{}, {}, {name}: {error:.1e} at {input:?}: {got:?} for {expected:?}",
                        case.name, output.name
                    ));
                }
            }
            println!("{row}");
            table += &format!("{row}\n");
        }
    }
    if let Some(path) = out {
        let text = format!("{HEAD}{table}");
        crate::write(path, text.as_bytes())?;
        println!("the table: {}", path.display());
    }
    if broken.is_empty() { Ok(()) } else { Err(format!("bounds are broken:\n{}", broken.join("\n"))) }
}

const HEAD: &str = "\
# The shaders beside the crates

Every function on ten thousand inputs, bad ones among them: \"=\" where all bits are equal; else the share of equal ones and the largest
error, absolute or relative as the bound. Without a driver an interpreter computes each operation as it is written, or every product that
is added fused with the sum. `cargo run -- parity --out ../../docs/shaders/parity.md` in `tests/gpu` makes this page.

";

/// A bound in few letters.
fn bound(bound: Bound) -> String {
    match bound {
        Bound::Equal => "=".into(),
        Bound::Absolute(limit) => format!("{limit:.0e}"),
        Bound::Relative(limit) => format!("{limit:.0e} relative"),
    }
}

/// Nearness of an output.
struct Found {
    equal: f64,
    largest: f32,
    /// The input at which it is farthest.
    worst: usize,
}

impl Found {
    fn new(
        column: &Column,
        output: &Output,
        limit: Bound,
        inputs: &[[u32; INPUTS]],
        got: &[[u32; OUTPUTS]],
        expected: &[[u32; OUTPUTS]],
    ) -> Self {
        let mut found = Self { equal: 0.0, largest: 0.0, worst: 0 };
        let mut count = 0.0;
        for (i, (got, expected)) in got.iter().zip(expected).enumerate() {
            // A card may take denormal numbers for 0, which for some is another branch.
            let denormal = inputs[i][..8].iter().any(|x| f32::from_bits(*x).is_subnormal());
            if denormal && matches!(column, Column::Adapter(_)) {
                continue;
            }
            let errors = output.words.clone().map(|k| limit.error(got[k], expected[k]));
            let error = errors.fold(0.0, f32::max);
            count += 1.0;
            found.equal += f64::from(u8::from(error == 0.0));
            if error > found.largest {
                (found.largest, found.worst) = (error, i);
            }
        }
        found.equal /= count;
        found
    }

    fn cell(&self) -> String {
        if self.largest == 0.0 {
            return "=".into();
        }
        format!("{:.1} %, {:.0e}", 100.0 * self.equal, self.largest)
    }
}

/// Outcomes of a case on an adapter.
pub(crate) fn outcomes(
    gpu: &Gpu,
    case: &Case,
    inputs: &[[u32; INPUTS]],
) -> Result<Vec<[u32; OUTPUTS]>, String> {
    let kernel = Kernel::new(gpu, &case.name, &case.parts, &(case.wgsl() + entry::COMPUTE), "run_case")?;
    let groups = [(inputs.len() as u32).div_ceil(64), 1];
    let words = kernel.run(gpu, &case.resources, inputs.as_flattened(), inputs.len() * OUTPUTS, groups)?;
    Ok(words.chunks_exact(OUTPUTS).map(|words| std::array::from_fn(|k| words[k])).collect())
}
