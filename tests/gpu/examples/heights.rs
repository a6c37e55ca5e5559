//! Computes heights and normals with a compute shader, and writes two images:
//! `cargo run --release --example heights -- FOLDER`.
//!
//! Requires wgpu, pollster, bytemuck and png.

use std::error::Error;
use std::fs::File;
use std::path::Path;

use asperity_shading::noise::gpu::FbmUniform3d;
use asperity_shading::noise::{Fbm, FbmSpectrum, Perlin};
use asperity_wgsl::noise::FBM_3D;
use asperity_wgsl::{Bindings, Part, compose};
use glam::{DVec3, Vec3};
use wgpu::util::DeviceExt;

const SIDE: u32 = 512;

/// A square of eight cells of Perlin noise: the height, and the slopes along x and y.
static HEIGHTS: Part = Part::new(
    "heights",
    "
@group(1) @binding(0) var<storage, read_write> heights: array<vec4<f32>>;

@compute @workgroup_size(8, 8)
fn fill(@builtin(global_invocation_id) id: vec3<u32>) {
    let p = vec2<f32>(id.xy) * (8.0 / 512.0);
    // Exactly the octaves that a pixel resolves.
    let height = perlin_fbm_3d(vec3<f32>(p, 0.0), 5.0, 0.0, 0u);
    heights[id.y * 512u + id.x] = vec4<f32>(height.value, height.gradient);
}
",
    &[&FBM_3D.perlin],
);

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| "target".into());
    std::fs::create_dir_all(&folder)?;
    let heights = pollster::block_on(heights())?;

    // The sum is normalized to a variance of at most 1, so six deviations span black to white.
    let gray =
        heights.iter().flat_map(|[h, ..]| (((h / 6.0 + 0.5).clamp(0.0, 1.0) * 65535.0) as u16).to_be_bytes());
    write(
        &Path::new(&folder).join("heights.png"),
        png::ColorType::Grayscale,
        png::BitDepth::Sixteen,
        &gray.collect::<Vec<_>>(),
    )?;
    let steepness = 0.12;
    let normals = heights.iter().flat_map(|[_, x, y, _]| {
        let [x, y] = [x, y].map(|slope| -steepness * slope);
        let length = (x * x + y * y + 1.0).sqrt();
        [x, y, 1.0].map(|n| ((n / length / 6.0 + 0.5) * 255.0).round() as u8)
    });
    write(
        &Path::new(&folder).join("normals.png"),
        png::ColorType::Rgb,
        png::BitDepth::Eight,
        &normals.collect::<Vec<_>>(),
    )?;
    println!("wrote heights.png and normals.png to {folder}");
    Ok(())
}

/// Returns height, and slopes in three directions, of every pixel.
async fn heights() -> Result<Vec<[f32; 4]>, Box<dyn Error>> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapter = instance.request_adapter(&wgpu::RequestAdapterOptions::default()).await?;
    println!("on {}", adapter.get_info().name);
    let limits = wgpu::Limits::downlevel_defaults();
    let descriptor = wgpu::DeviceDescriptor { required_limits: limits, ..Default::default() };
    let (device, queue) = adapter.request_device(&descriptor).await?;

    // The uniform that the part binds: an array of sums, of which this shader uses one.
    let sum = Fbm::<_, Vec3>::new(Perlin::new(42), FbmSpectrum::new(2.0, 0.5, 8)?).anchored(DVec3::ZERO);
    let sums = FbmUniform3d::array(&[sum.gpu()]);
    let uniform = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: None,
        contents: bytemuck::bytes_of(&sums),
        usage: wgpu::BufferUsages::UNIFORM,
    });
    let size = u64::from(SIDE * SIDE) * 16;
    let buffer = |usage| {
        device.create_buffer(&wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false })
    };
    let output = buffer(wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
    let back = buffer(wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST);

    let source = wgpu::ShaderSource::Wgsl(compose(&[&HEIGHTS], Bindings::Textures { group: 0 }).into());
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source });
    let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: None,
        layout: None,
        module: &module,
        entry_point: Some("fill"),
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    });
    let group = |index, of: &wgpu::Buffer| {
        device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pipeline.get_bind_group_layout(index),
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: of.as_entire_binding() }],
        })
    };
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group(0, &uniform), &[]);
        pass.set_bind_group(1, &group(1, &output), &[]);
        pass.dispatch_workgroups(SIDE / 8, SIDE / 8, 1);
    }
    encoder.copy_buffer_to_buffer(&output, 0, &back, 0, size);
    queue.submit([encoder.finish()]);
    back.slice(..).map_async(wgpu::MapMode::Read, |_| ());
    device.poll(wgpu::PollType::wait_indefinitely())?;
    let bytes = back.slice(..).get_mapped_range()?.to_vec();
    Ok(bytemuck::pod_collect_to_vec(&bytes))
}

fn write(
    path: &Path,
    color: png::ColorType,
    depth: png::BitDepth,
    bytes: &[u8],
) -> Result<(), Box<dyn Error>> {
    let mut encoder = png::Encoder::new(File::create(path)?, SIDE, SIDE);
    encoder.set_color(color);
    encoder.set_depth(depth);
    encoder.write_header()?.write_image_data(bytes)?;
    Ok(())
}
