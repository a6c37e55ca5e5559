//! Renders a rough teapot at zooms 1, 10, 100 and 10⁴:
//! `cargo run --release --example teapot -- FOLDER`.
//!
//! Requires wgpu, pollster, bytemuck, glam and png, and a mesh with normals and tangents.

use std::error::Error;
use std::fs::File;
use std::path::Path;

use asperity_render::geometry::teapot::teapot;
use asperity_shading::noise::gpu::FbmUniform3d;
use asperity_shading::noise::{FbmSpectrum, GaussianFbm, GaussianNoise};
use asperity_wgsl::noise::GAUSSIAN_SLOPES_3D;
use asperity_wgsl::{Binding, Bindings, Part, compose, shading};
use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Vec3};
use wgpu::util::{DeviceExt, TextureDataOrder};

const SIZE: u32 = 512;
const FREQUENCY: f32 = 3.0;
/// The camera position at zoom 1, and its target between spout and handle.
const EYE: DVec3 = DVec3::new(4.4, -9.8, 4.8);
const TARGET: DVec3 = DVec3::new(0.25, 0.0, 1.35);
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// The shader and the parts that it calls. Bindings 0 and 1 belong to the octaves, 2 is its own.
static SURFACE: Part =
    Part::new("surface", include_str!("surface.wgsl"), &[&GAUSSIAN_SLOPES_3D, &shading::LEVEL_OF_DETAIL])
        .with_bindings(&[Binding::Uniform { name: "view", of: "View" }]);

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| "target".into());
    std::fs::create_dir_all(&folder)?;
    let painter = pollster::block_on(Painter::new())?;
    let octaves = GaussianFbm::<Vec3>::new(GaussianNoise::new(7), FbmSpectrum::new(2.17, 0.8, 16)?);
    let focus = focus();
    for zoom in [1.0, 10.0, 100.0, 10_000.0] {
        // Positions in f64 up to the focus, in f32 from there.
        let sums = FbmUniform3d::array(&[octaves.anchored(focus * f64::from(FREQUENCY)).gpu()]);
        let view = view((EYE - focus) / zoom, octaves.spectrum());
        let pixels = painter.paint(&corners(focus), &sums, &view)?;
        let path = Path::new(&folder).join(format!("teapot-{zoom}.png"));
        let mut encoder = png::Encoder::new(File::create(&path)?, SIZE, SIZE);
        encoder.set_color(png::ColorType::Rgba);
        encoder.write_header()?.write_image_data(&pixels)?;
        println!("{}", path.display());
    }
    Ok(())
}

/// Returns the intersection of the mesh and the ray from the camera through the body's center.
fn focus() -> DVec3 {
    let direction = (TARGET - EYE).normalize();
    let mesh = teapot();
    let hits = mesh.triangles.iter().filter_map(|triangle| {
        let [a, b, c] = triangle.map(|i| mesh.vertices[i as usize].position.as_dvec3());
        let normal = (b - a).cross(c - a);
        let t = (a - EYE).dot(normal) / direction.dot(normal);
        let p = EYE + t * direction;
        let inside = |from: DVec3, to: DVec3| (to - from).cross(p - from).dot(normal) >= 0.0;
        (t > 0.0 && inside(a, b) && inside(b, c) && inside(c, a)).then_some(t)
    });
    EYE + hits.fold(f64::INFINITY, f64::min) * direction
}

/// Returns corners of all triangles: position relative to the focus, normal, tangent, and the
/// triangle's plane.
fn corners(focus: DVec3) -> Vec<f32> {
    let mesh = teapot();
    let of = |triangle: &[u32; 3]| {
        let vertices = triangle.map(|i| mesh.vertices[i as usize]);
        let [a, b, c] = vertices.map(|vertex| vertex.position.as_dvec3() - focus);
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let plane = normal.as_vec3().extend(normal.dot(a) as f32).to_array();
        let positions = [a, b, c].map(|p| p.as_vec3());
        let rows = vertices.iter().zip(positions).flat_map(move |(vertex, position)| {
            [position, vertex.normal, vertex.tangent]
                .into_iter()
                .flat_map(|v: Vec3| v.to_array())
                .chain(plane)
        });
        rows.collect::<Vec<f32>>()
    };
    mesh.triangles.iter().flat_map(of).collect()
}

/// The structure `View` of the shader.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct View {
    eye: [f32; 3],
    pixel_angle: f32,
    right: [f32; 3],
    frequency: f32,
    up: [f32; 3],
    size: f32,
    forward: [f32; 3],
    log_lacunarity: f32,
    light: [f32; 3],
    max_octaves: f32,
}

fn view(eye: DVec3, spectrum: &FbmSpectrum) -> View {
    let half = (0.5 * 0.62_f64).tan();
    let forward = -eye.normalize();
    let right = forward.cross(DVec3::Z).normalize();
    let up = right.cross(forward);
    let light = DVec3::new(0.0, -0.8, 0.75).normalize();
    View {
        eye: eye.as_vec3().into(),
        pixel_angle: (2.0 * half / f64::from(SIZE)) as f32,
        right: (right * half).as_vec3().into(),
        frequency: FREQUENCY,
        up: (up * half).as_vec3().into(),
        size: SIZE as f32,
        forward: forward.as_vec3().into(),
        log_lacunarity: spectrum.lacunarity().log2(),
        light: light.as_vec3().into(),
        max_octaves: spectrum.max_octaves() as f32,
    }
}

/// A device with the pipeline.
struct Painter {
    device: wgpu::Device,
    queue: wgpu::Queue,
    pipeline: wgpu::RenderPipeline,
    levels: wgpu::TextureView,
}

impl Painter {
    async fn new() -> Result<Self, Box<dyn Error>> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
        let adapter = instance.request_adapter(&wgpu::RequestAdapterOptions::default()).await?;
        println!("on {}", adapter.get_info().name);
        let required_limits = wgpu::Limits::downlevel_defaults();
        let descriptor = wgpu::DeviceDescriptor { required_limits, ..Default::default() };
        let (device, queue) = adapter.request_device(&descriptor).await?;

        let source = wgpu::ShaderSource::Wgsl(compose(&[&SURFACE], Bindings::Textures { group: 0 }).into());
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source });
        let attributes =
            wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x3, 3 => Float32x4];
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: None,
            layout: None,
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("corner"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[Some(wgpu::VertexBufferLayout {
                    array_stride: 13 * 4,
                    step_mode: wgpu::VertexStepMode::Vertex,
                    attributes: &attributes,
                })],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: Some(wgpu::DepthStencilState {
                format: DEPTH,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Greater),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState::default(),
            }),
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("pixel"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(FORMAT.into())],
            }),
            multiview_mask: None,
            cache: None,
        });

        // The table of Gaussian levels, 64 texels per row.
        let levels: Vec<f32> = GaussianNoise::gpu_levels().collect();
        let levels = device.create_texture_with_data(
            &queue,
            &wgpu::TextureDescriptor {
                label: None,
                size: wgpu::Extent3d {
                    width: 64,
                    height: levels.len() as u32 / 64,
                    depth_or_array_layers: 1,
                },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: wgpu::TextureFormat::R32Float,
                usage: wgpu::TextureUsages::TEXTURE_BINDING,
                view_formats: &[],
            },
            TextureDataOrder::LayerMajor,
            bytemuck::cast_slice(&levels),
        );
        let levels = levels.create_view(&wgpu::TextureViewDescriptor::default());
        Ok(Self { device, queue, pipeline, levels })
    }

    /// Renders an image with four bytes per pixel.
    fn paint(
        &self,
        corners: &[f32],
        sums: &[FbmUniform3d; 8],
        view: &View,
    ) -> Result<Vec<u8>, Box<dyn Error>> {
        let Self { device, queue, pipeline, levels } = self;
        let buffer = |contents, usage| {
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: None, contents, usage })
        };
        let octaves = buffer(bytemuck::bytes_of(sums), wgpu::BufferUsages::UNIFORM);
        let view = buffer(bytemuck::bytes_of(view), wgpu::BufferUsages::UNIFORM);
        let vertices = buffer(bytemuck::cast_slice(corners), wgpu::BufferUsages::VERTEX);
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pipeline.get_bind_group_layout(0),
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: octaves.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::TextureView(levels) },
                wgpu::BindGroupEntry { binding: 2, resource: view.as_entire_binding() },
            ],
        });
        let target = |format, usage| {
            let texture = device.create_texture(&wgpu::TextureDescriptor {
                label: None,
                size: wgpu::Extent3d { width: SIZE, height: SIZE, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: usage | wgpu::TextureUsages::RENDER_ATTACHMENT,
                view_formats: &[],
            });
            (texture.create_view(&wgpu::TextureViewDescriptor::default()), texture)
        };
        let (color, picture) = target(FORMAT, wgpu::TextureUsages::COPY_SRC);
        let (depth, _) = target(DEPTH, wgpu::TextureUsages::empty());
        let back = device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: u64::from(SIZE * SIZE) * 4,
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: None,
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: &color,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations {
                        load: wgpu::LoadOp::Clear(wgpu::Color { r: 0.13, g: 0.14, b: 0.16, a: 1.0 }),
                        store: wgpu::StoreOp::Store,
                    },
                })],
                depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                    view: &depth,
                    depth_ops: Some(wgpu::Operations {
                        load: wgpu::LoadOp::Clear(0.0),
                        store: wgpu::StoreOp::Discard,
                    }),
                    stencil_ops: None,
                }),
                timestamp_writes: None,
                occlusion_query_set: None,
                multiview_mask: None,
            });
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.set_vertex_buffer(0, vertices.slice(..));
            pass.draw(0..corners.len() as u32 / 13, 0..1);
        }
        encoder.copy_texture_to_buffer(
            picture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &back,
                // Rows of 512 pixels are multiples of 256 bytes, as required.
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(4 * SIZE),
                    rows_per_image: None,
                },
            },
            picture.size(),
        );
        queue.submit([encoder.finish()]);
        back.slice(..).map_async(wgpu::MapMode::Read, |_| ());
        device.poll(wgpu::PollType::wait_indefinitely())?;
        let bytes = back.slice(..).get_mapped_range()?.to_vec();
        Ok(bytes)
    }
}
