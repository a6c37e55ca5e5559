//! Renders the scene's triangles with the shader.

use std::time::{Duration, Instant};

use asperity_shading::noise::{FbmSpectrum, GaussianNoise};
use asperity_wgsl::{Binding, Bindings, Part, compose, ndf, noise, shading};
use glam::DVec3;
use wgpu::{BufferUsages, TextureFormat, TextureUsages};

use crate::{
    device::Gpu,
    picture::{
        Look,
        reference::BACKGROUND,
        scene::{Corner, Scene},
    },
    resources::{Resource, bound, buffer, bytes, group, layout},
};

/// Bumps from noise. The renderer receives the words of its sum.
pub(crate) static PROCEDURAL: Part =
    Part::new("procedural", include_str!("procedural.wgsl"), &[&noise::GAUSSIAN_SLOPES_3D, &SURFACE]);

/// Bumps from a noise texture and a normal texture.
pub(crate) static TEXTURED: Part = Part::new(
    "textured",
    include_str!("textured.wgsl"),
    &[&noise::MIP_MAPPED, &ndf::NORMAL_TABLE_FILTERED, &SURFACE],
);

static SURFACE: Part = Part::new("surface", include_str!("surface.wgsl"), &[&shading::LEVEL_OF_DETAIL])
    .with_bindings(&[Binding::Uniform { name: "surface_view", of: "SurfaceView" }]);

const COLOUR: TextureFormat = TextureFormat::Rgba8Unorm;
const DEPTH: TextureFormat = TextureFormat::Depth32Float;

/// Floats per corner: position, normal, tangent, the plane of its triangle, texture coordinates.
const FLOATS: u64 = 15;

/// The pipeline and its render targets.
pub(crate) struct Renderer {
    bumps: &'static Part,
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
    color: wgpu::Texture,
    depth: wgpu::Texture,
    size: u32,
}

impl Renderer {
    pub(crate) fn new(gpu: &Gpu, bumps: &'static Part, size: u32) -> Result<Self, String> {
        let scope = gpu.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let source = wgpu::ShaderSource::Wgsl(compose(&[bumps], Bindings::Textures { group: 0 }).into());
        let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source });
        let options = wgpu::PipelineCompilationOptions::default;
        let attributes = wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x3, 3 => Float32x4, 4 => Float32x2];
        let layout = layout(gpu, &[bumps], wgpu::ShaderStages::VERTEX_FRAGMENT);
        let pipeline_layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &[Some(&layout)],
            ..Default::default()
        });
        let pipeline = gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: None,
            layout: Some(&pipeline_layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("surface_corner"),
                compilation_options: options(),
                buffers: &[Some(wgpu::VertexBufferLayout {
                    array_stride: FLOATS * 4,
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
                entry_point: Some("surface_pixel"),
                compilation_options: options(),
                targets: &[Some(COLOUR.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        let texture = |format, usage| {
            gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: None,
                size: wgpu::Extent3d { width: size, height: size, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage,
                view_formats: &[],
            })
        };
        let color = texture(COLOUR, TextureUsages::RENDER_ATTACHMENT | TextureUsages::COPY_SRC);
        let depth = texture(DEPTH, TextureUsages::RENDER_ATTACHMENT);
        match pollster::block_on(scope.pop()) {
            Some(error) => Err(error.to_string()),
            None => Ok(Self { bumps, pipeline, layout, color, depth, size }),
        }
    }

    /// Renders 8-bit colors of every pixel, and returns the time from command to image.
    pub(crate) fn draw(
        &self,
        gpu: &Gpu,
        scene: &Scene,
        look: &Look,
        spectrum: &FbmSpectrum,
        octaves: &(&'static str, Vec<u32>),
        made: &[(&'static str, Resource)],
    ) -> Result<(Vec<[u8; 3]>, Duration), String> {
        let scope = gpu.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let levels = GaussianNoise::gpu_levels().map(f32::to_bits).collect();
        let words = [
            ("gaussian_level", levels),
            octaves.clone(),
            ("surface_view", view_words(scene, look, spectrum, self.size)),
        ];
        let resources = bound(gpu, &[self.bumps], &words, made)?;
        let resources: Vec<_> = resources.iter().map(|resource| resource.binding()).collect();
        let group = group(gpu, &self.layout, &resources);
        let corners: Vec<u32> = scene.triangles.iter().flat_map(corner_words).collect();
        let corners = buffer(gpu, &corners, BufferUsages::VERTEX);
        let row = (self.size * 4).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let back = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: u64::from(row * self.size),
            usage: BufferUsages::MAP_READ | BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let start = Instant::now();
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let [r, g, b] = BACKGROUND.map(|x| f64::from(x) / 255.0);
            let view = |texture: &wgpu::Texture| texture.create_view(&wgpu::TextureViewDescriptor::default());
            let (color, depth) = (view(&self.color), view(&self.depth));
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: None,
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: &color,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations {
                        load: wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a: 1.0 }),
                        store: wgpu::StoreOp::Store,
                    },
                })],
                depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                    view: &depth,
                    depth_ops: Some(wgpu::Operations {
                        load: wgpu::LoadOp::Clear(0.0),
                        store: wgpu::StoreOp::Store,
                    }),
                    stencil_ops: None,
                }),
                timestamp_writes: None,
                occlusion_query_set: None,
                multiview_mask: None,
            });
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.set_vertex_buffer(0, corners.slice(..));
            pass.draw(0..scene.triangles.len() as u32 * 3, 0..1);
        }
        encoder.copy_texture_to_buffer(
            self.color.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &back,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(row),
                    rows_per_image: None,
                },
            },
            self.color.size(),
        );
        gpu.queue.submit([encoder.finish()]);
        if let Some(error) = pollster::block_on(scope.pop()) {
            return Err(error.to_string());
        }
        let bytes = bytes(gpu, &back)?;
        let time = start.elapsed();
        let rows = bytes.chunks_exact(row as usize).map(|bytes| &bytes[..4 * self.size as usize]);
        let pixels = rows.flat_map(|bytes| bytes.chunks_exact(4).map(|rgba| [rgba[0], rgba[1], rgba[2]]));
        Ok((pixels.collect(), time))
    }
}

fn vector(v: DVec3) -> [f32; 3] {
    v.as_vec3().to_array()
}

/// Returns the words of `SurfaceView`.
fn view_words(scene: &Scene, look: &Look, spectrum: &FbmSpectrum, size: u32) -> Vec<u32> {
    let view = &scene.view;
    let rows = [
        (view.eye, view.pixel_angle as f32),
        (view.right, look.frequency),
        (view.up, spectrum.lacunarity().log2()),
        (view.forward, spectrum.max_octaves() as f32),
        (view.light, look.share),
    ];
    let rows = rows.into_iter().flat_map(|(v, last)| vector(v).into_iter().chain([last]));
    rows.chain([look.alpha.x, look.alpha.y, look.exposure, size as f32]).map(f32::to_bits).collect()
}

/// Returns the corners of a triangle with its plane, computed in `f64` relative to the focus.
fn corner_words(corners: &[Corner; 3]) -> Vec<u32> {
    let [a, b, c] = corners.map(|corner| corner.position);
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let plane = [vector(normal), [normal.dot(a) as f32, 0.0, 0.0]].concat();
    let floats = corners.iter().flat_map(|corner| {
        let own = [corner.position, corner.normal, corner.tangent].map(vector).concat();
        own.into_iter().chain(plane[..4].to_vec()).chain(corner.uv.as_vec2().to_array())
    });
    floats.map(f32::to_bits).collect()
}
