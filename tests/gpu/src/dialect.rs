//! The languages of exported shaders, and their file names.

use asperity::cli::shader::Language;
use asperity::shader::language::Checked;

/// The languages of whole shaders.
pub(crate) const DIALECTS: [Language; 7] = [
    Language::Wgsl,
    Language::Glsl450,
    Language::GlslEs300,
    Language::GlslEs310,
    Language::Hlsl,
    Language::Msl,
    Language::Spirv,
];

/// Returns the file name of an entry point.
pub(crate) const fn file(language: Language) -> &'static str {
    match language {
        Language::Wgsl | Language::NagaOil | Language::Wesl => "shader.wgsl",
        Language::Glsl450 => "shader-450.frag",
        Language::GlslEs300 => "shader-es-300.frag",
        Language::GlslEs310 => "shader-es-310.frag",
        Language::Hlsl => "shader.hlsl",
        Language::Msl => "shader.metal",
        Language::Spirv => "shader.spv",
    }
}

/// Returns SPIR-V of all functions, in which every operation is in the source.
pub(crate) fn counted(wgsl: &str) -> Result<Vec<u32>, String> {
    let bytes = Checked::library(wgsl).and_then(|checked| checked.counted());
    let bytes = bytes.map_err(|error| error.to_string())?;
    Ok(bytes.as_chunks().0.iter().map(|word| u32::from_le_bytes(*word)).collect())
}
