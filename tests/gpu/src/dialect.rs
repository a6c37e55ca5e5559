//! Shading languages, written by naga.

use clap::ValueEnum;
use naga::back::{self, glsl};
use naga::proc::BoundsCheckPolicies;
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{Module, ShaderStage};

/// A language that entries are written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Dialect {
    /// WGSL, as it is composed
    Wgsl,
    /// GLSL 4.50: OpenGL, Vulkan through glslang
    #[value(name = "glsl-450")]
    Glsl450,
    /// GLSL ES 3.00: WebGL 2
    #[value(name = "glsl-es-300")]
    GlslEs300,
    /// GLSL ES 3.10
    #[value(name = "glsl-es-310")]
    GlslEs310,
    /// HLSL, shader model 6.0
    Hlsl,
    /// Metal's language, 2.4
    Msl,
    /// SPIR-V
    Spirv,
}

/// A module that was accepted.
pub(crate) struct Checked<'a> {
    wgsl: &'a str,
    entry: &'static str,
    module: Module,
    info: ModuleInfo,
}

impl<'a> Checked<'a> {
    /// Parses and validates WGSL; languages but WGSL, SPIR-V and MSL ask for a fragment shader's entry.
    pub(crate) fn new(wgsl: &'a str, entry: &'static str) -> Result<Self, String> {
        let module = naga::front::wgsl::parse_str(wgsl).map_err(|error| error.emit_to_string(wgsl))?;
        let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
        let info = validator.validate(&module).map_err(|error| error.emit_to_string(wgsl))?;
        Ok(Self { wgsl, entry, module, info })
    }
}

impl Dialect {
    /// The file of an entry.
    pub(crate) const fn file(self) -> &'static str {
        match self {
            Self::Wgsl => "shader.wgsl",
            Self::Glsl450 => "shader-450.frag",
            Self::GlslEs300 => "shader-es-300.frag",
            Self::GlslEs310 => "shader-es-310.frag",
            Self::Hlsl => "shader.hlsl",
            Self::Msl => "shader.metal",
            Self::Spirv => "shader.spv",
        }
    }

    /// The module in this language.
    pub(crate) fn write(self, checked: &Checked<'_>) -> Result<Vec<u8>, String> {
        match self {
            Self::Wgsl => Ok(checked.wgsl.into()),
            Self::Glsl450 => glsl(checked, glsl::Version::Desktop(450)),
            Self::GlslEs300 => glsl(checked, glsl::Version::Embedded { version: 300, is_webgl: true }),
            Self::GlslEs310 => glsl(checked, glsl::Version::Embedded { version: 310, is_webgl: false }),
            Self::Hlsl => hlsl(checked),
            Self::Msl => msl(checked),
            Self::Spirv => spirv(checked),
        }
    }
}

fn glsl(
    Checked { module, info, entry, .. }: &Checked<'_>,
    version: glsl::Version,
) -> Result<Vec<u8>, String> {
    let options = glsl::Options { version, writer_flags: glsl::WriterFlags::empty(), ..Default::default() };
    let entry = glsl::PipelineOptions {
        entry_point: (*entry).into(),
        shader_stage: ShaderStage::Fragment,
        multiview: None,
    };
    let mut text = String::new();
    glsl::Writer::new(&mut text, module, info, &options, &entry, BoundsCheckPolicies::default())
        .and_then(|mut writer| writer.write())
        .map_err(|error| error.to_string())?;
    Ok(text.into())
}

fn hlsl(checked: &Checked<'_>) -> Result<Vec<u8>, String> {
    let mut options = back::hlsl::Options {
        shader_model: back::hlsl::ShaderModel::V6_0,
        fake_missing_bindings: true,
        ..Default::default()
    };
    // Samplers are in a heap, and found by numbers in a buffer; the space that naga gives it by itself is beyond what glslang has.
    let numbers = back::hlsl::BindTarget { space: 2, ..Default::default() };
    options.sampler_buffer_binding_map.insert(back::hlsl::SamplerIndexBufferKey { group: 0 }, numbers);
    let mut text = String::new();
    back::hlsl::Writer::new(&mut text, &options, &Default::default())
        .write(&checked.module, &checked.info, None)
        .map_err(|error| error.to_string())?;
    Ok(text.into())
}

fn msl(checked: &Checked<'_>) -> Result<Vec<u8>, String> {
    let options = back::msl::Options {
        fake_missing_bindings: false,
        lang_version: (2, 4),
        per_entry_point_map: slots(checked),
        ..Default::default()
    };
    back::msl::write_string(&checked.module, &checked.info, &options, &Default::default())
        .map(|(text, _)| text.into())
        .map_err(|error| error.to_string())
}

/// Metal's numbers of resources: buffers, textures and samplers each count from 0 in the order of the bindings.
fn slots(Checked { module, .. }: &Checked<'_>) -> back::msl::EntryPointResourceMap {
    let mut bound: Vec<_> = module
        .global_variables
        .iter()
        .filter_map(|(_, variable)| Some((variable.binding?, &module.types[variable.ty].inner)))
        .collect();
    bound.sort_by_key(|(binding, _)| (binding.group, binding.binding));
    let mut next = [0; 3];
    let mut resources = back::msl::BindingMap::new();
    for (binding, ty) in bound {
        let mut take = |kind: usize| {
            next[kind] += 1;
            Some(next[kind] - 1)
        };
        let mut target = back::msl::BindTarget::default();
        match ty {
            naga::TypeInner::Image { .. } => target.texture = take(1),
            naga::TypeInner::Sampler { .. } => {
                target.sampler = take(2).map(back::msl::BindSamplerTarget::Resource);
            }
            _ => target.buffer = take(0),
        }
        resources.insert(binding, target);
    }
    let of_entry = back::msl::EntryPointResources { resources, ..Default::default() };
    module.entry_points.iter().map(|entry| (entry.name.clone(), of_entry.clone())).collect()
}

fn spirv(checked: &Checked<'_>) -> Result<Vec<u8>, String> {
    let mut options = back::spv::Options { lang_version: (1, 3), ..Default::default() };
    options.flags |= back::spv::WriterFlags::DEBUG;
    let words = back::spv::write_vec(&checked.module, &checked.info, &options, None);
    let words = words.map_err(|error| error.to_string())?;
    Ok(words.iter().flat_map(|word| word.to_le_bytes()).collect())
}

/// SPIR-V of all functions with their names, without the counters by which naga bounds loops: every operation is one that is written.
pub(crate) fn counted(wgsl: &str) -> Result<Vec<u32>, String> {
    let Checked { module, info, .. } = Checked::new(wgsl, "")?;
    let mut options = back::spv::Options { force_loop_bounding: false, ..Default::default() };
    options.flags = back::spv::WriterFlags::DEBUG;
    back::spv::write_vec(&module, &info, &options, None).map_err(|error| error.to_string())
}
