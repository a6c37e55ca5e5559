//! Entry points for the function `evaluate` of a case.

/// `run_case`, a compute shader with inputs and outcomes in buffers of group 1.
pub(crate) const COMPUTE: &str = "
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

/// `show_case`, a fragment shader with inputs from the vertex stage and outcomes in four integer
/// targets, which GLSL ES 3.00 supports too.
pub(crate) const FRAGMENT: &str = "
struct CaseInput {
    @location(0) a: vec4<f32>,
    @location(1) b: vec4<f32>,
    @location(2) @interpolate(flat, either) c: vec4<u32>,
    @location(3) @interpolate(flat, either) d: vec4<u32>,
}

struct CaseTargets {
    @location(0) a: vec4<u32>,
    @location(1) b: vec4<u32>,
    @location(2) c: vec4<u32>,
    @location(3) d: vec4<u32>,
}

@fragment
fn show_case(given: CaseInput) -> CaseTargets {
    let outcome = evaluate(given.a, given.b, given.c, given.d);
    return CaseTargets(outcome.a, outcome.b, outcome.c, outcome.d);
}
";
