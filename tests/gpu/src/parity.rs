//! Cases as compute shaders, and the table of their errors.

use asperity_shader_tests::case::{Case, INPUTS, OUTPUTS};
use asperity_shader_tests::cases;
use wgpu::{BufferUsages, ShaderSource};

use crate::{
    device::{self, Gpu},
    resources::{bound, buffer},
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
            for output in &case.outputs {
                let (mut equal, mut largest) = (0_u32, 0.0_f32);
                for (input, got) in inputs.iter().zip(&got) {
                    let expected = (case.reference)(*input);
                    let errors = output.words.clone().map(|k| output.adapter.error(got[k], expected[k]));
                    let error = errors.fold(0.0, f32::max);
                    equal += u32::from(error == 0.0);
                    largest = largest.max(error);
                }
                let verdict = if largest <= output.adapter.limit() { "" } else { " **broken**" };
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
    let scope = gpu.device.push_error_scope(wgpu::ErrorFilter::Validation);
    let source = ShaderSource::Wgsl((case.wgsl() + ENTRY).into());
    let module =
        gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor { label: Some(&case.name), source });
    let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some(&case.name),
        layout: None,
        module: &module,
        entry_point: Some("run_case"),
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    });
    let resources = bound(gpu, &case.parts, &case.resources)?;
    let words: Vec<u32> = inputs.iter().flatten().copied().collect();
    let size = (inputs.len() * OUTPUTS * 4) as u64;
    let input = buffer(gpu, &words, BufferUsages::STORAGE);
    let make = |usage| {
        let descriptor = wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false };
        gpu.device.create_buffer(&descriptor)
    };
    let output = make(BufferUsages::STORAGE | BufferUsages::COPY_SRC);
    let back = make(BufferUsages::MAP_READ | BufferUsages::COPY_DST);
    let group = |index, resources: &[wgpu::BindingResource<'_>]| {
        let entries: Vec<_> = (0..)
            .zip(resources)
            .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource: resource.clone() })
            .collect();
        let layout = &pipeline.get_bind_group_layout(index);
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &entries })
    };
    let tables: Vec<_> = resources.iter().map(|resource| resource.binding()).collect();
    let groups = [group(0, &tables), group(1, &[input.as_entire_binding(), output.as_entire_binding()])];
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&pipeline);
        for (index, group) in (0..).zip(&groups) {
            pass.set_bind_group(index, group, &[]);
        }
        pass.dispatch_workgroups((inputs.len() as u32).div_ceil(64), 1, 1);
    }
    encoder.copy_buffer_to_buffer(&output, 0, &back, 0, size);
    gpu.queue.submit([encoder.finish()]);
    if let Some(error) = pollster::block_on(scope.pop()) {
        return Err(format!("{}: {error}", case.name));
    }
    back.slice(..).map_async(wgpu::MapMode::Read, |_| ());
    gpu.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|error| error.to_string())?;
    let bytes = back.slice(..).get_mapped_range().map_err(|error| error.to_string())?;
    let words: &[u32] = bytemuck::cast_slice(&bytes);
    Ok(words.chunks_exact(OUTPUTS).map(|words| std::array::from_fn(|k| words[k])).collect())
}
