//! Compute shaders: resources and words in, words out.

use asperity_wgsl::Part;
use wgpu::{BufferUsages, ShaderSource, ShaderStages};

use crate::{
    device::Gpu,
    resources::{bound, buffer, bytes, group, layout, stored},
};

/// An entry point of a module of parts: resources in group 0, input and output in group 1.
pub(crate) struct Kernel {
    name: String,
    parts: Vec<&'static Part>,
    layouts: [wgpu::BindGroupLayout; 2],
    pipeline: wgpu::ComputePipeline,
}

impl Kernel {
    pub(crate) fn new(
        gpu: &Gpu,
        name: &str,
        parts: &[&'static Part],
        wgsl: &str,
        entry: &'static str,
    ) -> Result<Self, String> {
        let scope = gpu.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let source = ShaderSource::Wgsl(wgsl.into());
        let module =
            gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor { label: Some(name), source });
        let own = |binding, read_only| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: ShaderStages::COMPUTE,
            ty: stored(wgpu::BufferBindingType::Storage { read_only }),
            count: None,
        };
        let own = wgpu::BindGroupLayoutDescriptor { label: None, entries: &[own(0, true), own(1, false)] };
        let layouts = [layout(gpu, parts, ShaderStages::COMPUTE), gpu.device.create_bind_group_layout(&own)];
        let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &[Some(&layouts[0]), Some(&layouts[1])],
            ..Default::default()
        });
        let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(name),
            layout: Some(&layout),
            module: &module,
            entry_point: Some(entry),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        match pollster::block_on(scope.pop()) {
            Some(error) => Err(format!("{name}: {error}")),
            None => Ok(Self { name: name.into(), parts: parts.to_vec(), layouts, pipeline }),
        }
    }

    /// Runs `groups` workgroups and returns the words they write.
    pub(crate) fn run(
        &self,
        gpu: &Gpu,
        resources: &[(&'static str, Vec<u32>)],
        input: &[u32],
        output: usize,
        groups: [u32; 2],
    ) -> Result<Vec<u32>, String> {
        let scope = gpu.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let resources = bound(gpu, &self.parts, resources, &[])?;
        let size = output as u64 * 4;
        let make = |usage| {
            let descriptor = wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false };
            gpu.device.create_buffer(&descriptor)
        };
        let input = buffer(gpu, input, BufferUsages::STORAGE);
        let output = make(BufferUsages::STORAGE | BufferUsages::COPY_SRC);
        let back = make(BufferUsages::MAP_READ | BufferUsages::COPY_DST);
        let tables: Vec<_> = resources.iter().map(|resource| resource.binding()).collect();
        let own = vec![input.as_entire_binding(), output.as_entire_binding()];
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&self.pipeline);
            for (index, (layout, resources)) in (0..).zip(self.layouts.iter().zip([tables, own])) {
                pass.set_bind_group(index, &group(gpu, layout, &resources), &[]);
            }
            pass.dispatch_workgroups(groups[0], groups[1], 1);
        }
        encoder.copy_buffer_to_buffer(&output, 0, &back, 0, size);
        gpu.queue.submit([encoder.finish()]);
        if let Some(error) = pollster::block_on(scope.pop()) {
            return Err(format!("{}: {error}", self.name));
        }
        Ok(bytemuck::pod_collect_to_vec(&bytes(gpu, &back)?))
    }
}
