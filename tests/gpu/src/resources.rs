//! Converts words of uniforms and tables to GPU resources.

use asperity_wgsl::{Binding, Element, Part, ordered};
use wgpu::util::{BufferInitDescriptor, DeviceExt, TextureDataOrder};
use wgpu::{
    BindGroupLayout, BindGroupLayoutDescriptor, BindGroupLayoutEntry, BindingType, BufferBindingType,
    BufferUsages, Extent3d, ShaderStages, TextureDescriptor, TextureDimension, TextureFormat,
    TextureSampleType, TextureUsages, TextureView, TextureViewDimension,
};

use crate::device::Gpu;

/// Resource of a binding.
#[derive(Clone)]
pub(crate) enum Resource {
    Buffer(wgpu::Buffer),
    View(TextureView),
    Sampler(wgpu::Sampler),
}

impl Resource {
    pub(crate) fn binding(&self) -> wgpu::BindingResource<'_> {
        match self {
            Self::Buffer(buffer) => buffer.as_entire_binding(),
            Self::View(view) => wgpu::BindingResource::TextureView(view),
            Self::Sampler(sampler) => wgpu::BindingResource::Sampler(sampler),
        }
    }
}

/// Creates a filterable texture with two channels; `texel` is called for every level, column and
/// row.
pub(crate) fn filtered(gpu: &Gpu, sizes: &[u32], texel: impl Fn(u32, u32, u32) -> [f32; 2]) -> Resource {
    let texels = (0..).zip(sizes).flat_map(|(level, &size)| {
        let texel = &texel;
        (0..size).flat_map(move |y| (0..size).flat_map(move |x| texel(level, x, y)))
    });
    let texels: Vec<half::f16> = texels.map(half::f16::from_f32).collect();
    let side = sizes.first().copied().unwrap_or(1);
    let texture = gpu.device.create_texture_with_data(
        &gpu.queue,
        &TextureDescriptor {
            label: None,
            size: Extent3d { width: side, height: side, depth_or_array_layers: 1 },
            mip_level_count: sizes.len() as u32,
            sample_count: 1,
            dimension: TextureDimension::D2,
            format: TextureFormat::Rg16Float,
            usage: TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        },
        TextureDataOrder::LayerMajor,
        bytemuck::cast_slice(&texels),
    );
    Resource::View(texture.create_view(&wgpu::TextureViewDescriptor::default()))
}

/// Creates a sampler that is linear between texels and levels.
pub(crate) fn linear(gpu: &Gpu, at_ends: wgpu::AddressMode) -> Resource {
    Resource::Sampler(gpu.device.create_sampler(&wgpu::SamplerDescriptor {
        address_mode_u: at_ends,
        address_mode_v: at_ends,
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        mipmap_filter: wgpu::MipmapFilterMode::Linear,
        ..Default::default()
    }))
}

/// Returns the resources of a composition in binding order: existing resources, and new ones from
/// words.
pub(crate) fn bound(
    gpu: &Gpu,
    parts: &[&'static Part],
    words: &[(&'static str, Vec<u32>)],
    made: &[(&'static str, Resource)],
) -> Result<Vec<Resource>, String> {
    let parts = ordered(parts);
    let bindings = parts.iter().flat_map(|part| part.bindings());
    bindings
        .map(|binding| {
            let name = binding.name();
            if let Some((_, resource)) = made.iter().find(|(of, _)| *of == name) {
                return Ok(resource.clone());
            }
            let words = words.iter().find(|(of, _)| *of == name).map(|(_, words)| words.as_slice());
            resource(gpu, binding, words.ok_or_else(|| format!("no resource for `{name}`"))?)
        })
        .collect()
}

/// Returns the layout of a composition's bindings. An automatic layout would omit bindings that an
/// entry point does not read.
pub(crate) fn layout(gpu: &Gpu, parts: &[&'static Part], visibility: ShaderStages) -> BindGroupLayout {
    let parts = ordered(parts);
    let bindings = (0..).zip(parts.iter().flat_map(|part| part.bindings()));
    let entries: Vec<_> = bindings
        .map(|(binding, of)| BindGroupLayoutEntry { binding, visibility, ty: kind(of), count: None })
        .collect();
    gpu.device.create_bind_group_layout(&BindGroupLayoutDescriptor { label: None, entries: &entries })
}

fn kind(binding: &Binding) -> BindingType {
    let texture = |sample_type| BindingType::Texture {
        sample_type,
        view_dimension: TextureViewDimension::D2,
        multisampled: false,
    };
    match binding {
        Binding::Table { element: Element::Word, .. } => texture(TextureSampleType::Uint),
        Binding::Table { .. } => texture(TextureSampleType::Float { filterable: false }),
        Binding::Texture { .. } => texture(TextureSampleType::Float { filterable: true }),
        Binding::Sampler { .. } => BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
        _ => stored(BufferBindingType::Uniform),
    }
}

/// A whole buffer.
pub(crate) fn stored(ty: BufferBindingType) -> BindingType {
    BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None }
}

fn resource(gpu: &Gpu, binding: &Binding, words: &[u32]) -> Result<Resource, String> {
    match *binding {
        Binding::Uniform { .. } => Ok(Resource::Buffer(buffer(gpu, words, BufferUsages::UNIFORM))),
        Binding::Table { element, width, .. } => {
            let format = match element {
                Element::Float => TextureFormat::R32Float,
                Element::Word => TextureFormat::R32Uint,
            };
            let height = (words.len() as u32).div_ceil(width).max(1);
            let mut texels = words.to_vec();
            texels.resize((width * height) as usize, 0);
            let texture = gpu.device.create_texture_with_data(
                &gpu.queue,
                &TextureDescriptor {
                    label: None,
                    size: Extent3d { width, height, depth_or_array_layers: 1 },
                    mip_level_count: 1,
                    sample_count: 1,
                    dimension: TextureDimension::D2,
                    format,
                    usage: TextureUsages::TEXTURE_BINDING,
                    view_formats: &[],
                },
                TextureDataOrder::LayerMajor,
                bytemuck::cast_slice(&texels),
            );
            Ok(Resource::View(texture.create_view(&wgpu::TextureViewDescriptor::default())))
        }
        _ => Err(format!("`{}` has an unsupported binding type", binding.name())),
    }
}

/// Creates a buffer of words.
pub(crate) fn buffer(gpu: &Gpu, words: &[u32], usage: BufferUsages) -> wgpu::Buffer {
    let contents = bytemuck::cast_slice(words);
    gpu.device.create_buffer_init(&BufferInitDescriptor { label: None, contents, usage })
}

/// Binds resources in order.
pub(crate) fn group(
    gpu: &Gpu,
    layout: &BindGroupLayout,
    resources: &[wgpu::BindingResource<'_>],
) -> wgpu::BindGroup {
    let entries: Vec<_> = (0..)
        .zip(resources)
        .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource: resource.clone() })
        .collect();
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &entries })
}

/// Returns the bytes of a mappable buffer, after the work that writes it.
pub(crate) fn bytes(gpu: &Gpu, buffer: &wgpu::Buffer) -> Result<Vec<u8>, String> {
    buffer.slice(..).map_async(wgpu::MapMode::Read, |_| ());
    gpu.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|error| error.to_string())?;
    let bytes = buffer.slice(..).get_mapped_range().map_err(|error| error.to_string())?;
    Ok(bytes.to_vec())
}
