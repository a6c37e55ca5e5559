//! SPIR-V handed to a driver as it is, so that the driver sees which sums and products it must not fuse.
#![expect(unsafe_code, reason = "wgpu drops decorations from all but SPIR-V that it does not read")]

use wgpu::{PassthroughShaderEntryPoint, ShaderModule, ShaderModuleDescriptorPassthrough};

use crate::device::Gpu;
use crate::dialect::{Checked, unfused};

/// A compute shader's module whose sums, products and quotients are computed as they are written.
pub(crate) fn module(gpu: &Gpu, name: &str, wgsl: &str, entry: &'static str) -> Result<ShaderModule, String> {
    let words = unfused(&Checked::new(wgsl, entry)?)?;
    // Sizes of groups are asked for on Metal alone.
    let entry = PassthroughShaderEntryPoint { name: entry.into(), workgroup_size: (1, 1, 1) };
    let descriptor = ShaderModuleDescriptorPassthrough {
        label: Some(name),
        entry_points: vec![entry].into(),
        spirv: Some(words.into()),
        ..Default::default()
    };
    // SAFETY: naga validated the module and wrote these words, with a decoration more on some; the interpreter refuses indices that
    // are outside of what is bound, for the same inputs and the same arithmetic.
    Ok(unsafe { gpu.device.create_shader_module_passthrough(descriptor) })
}
