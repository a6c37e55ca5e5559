//! Cases as compute shaders, and the table of their errors.

use std::path::Path;

use asperity_shader_tests::case::{Bound, Case, DENORMAL, INPUTS, OUTPUTS, Output};
use asperity_shader_tests::interpreter::Arithmetic;
use wgpu::Backends;

use crate::{
    compute::Kernel,
    device::{self, Gpu},
    entry,
};

/// Source of a column's outcomes: the interpreter with either arithmetic, or an adapter.
enum Column {
    Interpreter(Arithmetic),
    Adapter(Gpu),
}

impl Column {
    fn name(&self) -> String {
        match self {
            Self::Interpreter(Arithmetic::Fused) => "no driver, fused".into(),
            Self::Interpreter(_) => "no driver".into(),
            Self::Adapter(gpu) => gpu.name.clone(),
        }
    }

    fn bound(&self, output: &Output) -> Bound {
        match self {
            Self::Interpreter(Arithmetic::Written) => output.written,
            _ => output.adapter,
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

/// Prints the table of functions and adapters, writes it if requested, and fails if a bound is
/// exceeded.
///
/// Without an adapter, prints a note and runs only the interpreter.
pub(crate) fn run(cases: &[Case], adapter: Option<&str>, out: Option<&Path>) -> Result<(), String> {
    let mut columns = vec![Column::Interpreter(Arithmetic::Written), Column::Interpreter(Arithmetic::Fused)];
    let gpus = device::find(adapter, Backends::all());
    if gpus.is_empty() {
        match adapter {
            Some(_) => return Err(device::none(adapter)),
            None => println!("no driver tested: {}", device::none(None)),
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
        let expected: Vec<_> = inputs.iter().map(|input| Expected::new(case, input)).collect();
        let outcomes = columns.iter().map(|column| column.outcomes(case, &inputs));
        let outcomes: Vec<_> = outcomes.collect::<Result<_, _>>()?;
        for output in &case.outputs {
            let mut row = format!("| {} | {} | {} |", case.name, output.name, bound(output.adapter));
            for (column, got) in columns.iter().zip(&outcomes) {
                let found = Found::new(column, output, got, &expected);
                row += &format!(" {} |", found.cell());
                if let Some((worst, error)) = found.broken {
                    let input = inputs[worst].map(f32::from_bits);
                    let name = column.name();
                    let words = |words: &[u32; OUTPUTS]| words[output.words.clone()].to_vec();
                    let [got, expected] = [&got[worst], &expected[worst].written].map(words);
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
        println!("table written to {}", path.display());
    }
    if broken.is_empty() { Ok(()) } else { Err(format!("bounds exceeded:\n{}", broken.join("\n"))) }
}

const HEAD: &str = "\
# Shaders compared with the crates

Every function on ten thousand inputs, including invalid ones. \"=\": all bits are equal. Otherwise: the fraction of
equal results and the largest error, absolute or relative like the bound. Without a driver, an interpreter computes each
operation as written, or with every product that is added fused with the sum.
`cargo xtask shaders --check` writes this page.

";

/// Formats a bound compactly.
fn bound(bound: Bound) -> String {
    match bound {
        Bound::Equal => "=".into(),
        Bound::Absolute(limit) => format!("{limit:.0e}"),
        Bound::Rounding(limit) => format!("{limit:.0e} of max(1, value)"),
        Bound::Relative(limit) => format!("{limit:.0e} relative"),
    }
}

/// Outcomes of the crates for an input.
struct Expected {
    written: [u32; OUTPUTS],
    /// For the input with denormals replaced by 0, if it has any: WGSL allows a GPU to flush them.
    flushed: Option<[u32; OUTPUTS]>,
}

impl Expected {
    fn new(case: &Case, input: &[u32; INPUTS]) -> Self {
        let mut flushed = *input;
        flushed.iter_mut().filter(|word| **word == DENORMAL.to_bits()).for_each(|word| *word = 0);
        let has_denormal = flushed != *input;
        Self { written: (case.reference)(*input), flushed: has_denormal.then(|| (case.reference)(flushed)) }
    }

    /// Returns the error of an output's words. On an adapter, the smaller error with or without
    /// flushed denormals.
    fn error(&self, output: &Output, got: &[u32; OUTPUTS], bound: Bound, on_adapter: bool) -> f32 {
        let of = |expected: &[u32; OUTPUTS]| {
            output.words.clone().map(|k| bound.error(got[k], expected[k])).fold(0.0, f32::max)
        };
        let flushed = self.flushed.iter().filter(|_| on_adapter);
        flushed.map(of).fold(of(&self.written), f32::min)
    }
}

/// Accuracy of an output.
struct Found {
    equal: f64,
    largest: f32,
    /// The input that exceeds its bound the most, and its error.
    broken: Option<(usize, f32)>,
}

impl Found {
    fn new(column: &Column, output: &Output, got: &[[u32; OUTPUTS]], expected: &[Expected]) -> Self {
        let on_adapter = matches!(column, Column::Adapter(..));
        let bound = column.bound(output);
        let mut found = Self { equal: 0.0, largest: 0.0, broken: None };
        for (i, (got, expected)) in got.iter().zip(expected).enumerate() {
            let error = expected.error(output, got, bound, on_adapter);
            found.equal += f64::from(u8::from(error == 0.0));
            found.largest = found.largest.max(error);
            if error > found.broken.map_or(bound.limit(), |(_, worst)| worst) {
                found.broken = Some((i, error));
            }
        }
        found.equal /= got.len() as f64;
        found
    }

    fn cell(&self) -> String {
        if self.largest == 0.0 {
            return "=".into();
        }
        format!("{:.1} %, {:.0e}", 100.0 * self.equal, self.largest)
    }
}

/// Returns the outcomes of a case on an adapter.
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
