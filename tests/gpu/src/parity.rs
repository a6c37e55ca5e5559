//! Cases as compute shaders, and the table of their errors.

use asperity_shader_tests::case::{Case, INPUTS, OUTPUTS};
use asperity_shader_tests::cases;

use crate::{
    compute::Kernel,
    device::{self, Gpu},
};

const ENTRY: &str = "
@group(1) @binding(0) var<storage, read> case_inputs: array<vec4<u32>>;
@group(1) @binding(1) var<storage, read_write> case_outcomes: array<Outcome>;

@compute @workgroup_size(64)
fn run_case(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&case_outcomes) {
        return;
    }
    let at = id.x * 4u;
    let a = bitcast<vec4<f32>>(case_inputs[at]);
    let b = bitcast<vec4<f32>>(case_inputs[at + 1u]);
    case_outcomes[id.x] = evaluate(a, b, case_inputs[at + 2u], case_inputs[at + 3u]);
}
";

/// Prints the table of functions and adapters, and fails where a bound is broken.
pub(crate) fn run(adapter: Option<&str>, only: Option<&str>) -> Result<(), String> {
    let gpus = device::open(adapter)?;
    let mut broken = 0;
    for gpu in &gpus {
        println!(
            "\n{}\n\n| function | quantity | equal | largest error | bound |\n|---|---|---|---|---|",
            gpu.name
        );
        for case in cases::all().iter().filter(|case| only.is_none_or(|part| case.name.contains(part))) {
            let inputs: Vec<[u32; INPUTS]> = (0..Case::COUNT).map(|i| (case.input)(i)).collect();
            let got = outcomes(gpu, case, &inputs)?;
            let whole = |input: &[u32; INPUTS]| !input[..8].iter().any(|x| f32::from_bits(*x).is_subnormal());
            for output in &case.outputs {
                let (mut equal, mut largest, mut worst) = (0_u32, 0.0_f32, 0);
                // A card may take denormal numbers for 0, which for some is another branch.
                for (i, (input, got)) in
                    inputs.iter().zip(&got).enumerate().filter(|(_, (input, _))| whole(input))
                {
                    let expected = (case.reference)(*input);
                    let errors = output.words.clone().map(|k| output.adapter.error(got[k], expected[k]));
                    let error = errors.fold(0.0, f32::max);
                    equal += u32::from(error == 0.0);
                    if error > largest {
                        (largest, worst) = (error, i);
                    }
                }
                let broken_at =
                    format!(" **broken** by input {worst}: {:?}", inputs[worst].map(f32::from_bits));
                let verdict = if largest <= output.adapter.limit() { "" } else { &broken_at };
                broken += usize::from(!verdict.is_empty());
                let equal = f64::from(equal) / f64::from(Case::COUNT) * 100.0;
                println!(
                    "| {} | {} | {equal:.2} % | {largest:.1e} | {:?}{verdict} |",
                    case.name, output.name, output.adapter
                );
            }
        }
    }
    if broken == 0 { Ok(()) } else { Err(format!("{broken} bounds are broken")) }
}

/// What an adapter computes of a case.
fn outcomes(gpu: &Gpu, case: &Case, inputs: &[[u32; INPUTS]]) -> Result<Vec<[u32; OUTPUTS]>, String> {
    let kernel = Kernel::new(gpu, &case.name, &case.parts, &(case.wgsl() + ENTRY), "run_case")?;
    let groups = [(inputs.len() as u32).div_ceil(64), 1];
    let words = kernel.run(gpu, &case.resources, inputs.as_flattened(), inputs.len() * OUTPUTS, groups)?;
    Ok(words.chunks_exact(OUTPUTS).map(|words| std::array::from_fn(|k| words[k])).collect())
}
