//! Options of `shader`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use crate::cli::value::whole;

/// Options of `shader`.
#[derive(Debug, Args)]
pub struct Shader {
    /// Parts, by a name or an end of it such as `kinds/perlin`, or by the name of a function; without any,
    /// all parts are listed.
    #[arg(value_name = "PART")]
    pub parts: Vec<String>,
    /// Language of the output.
    #[arg(long, value_enum, default_value_t)]
    pub language: Language,
    /// How shaders read tables.
    #[arg(long, value_enum, default_value_t)]
    pub tables: Tables,
    /// Bind group of the resources.
    #[arg(long, default_value_t = 0, value_parser = whole(0, 3))]
    pub group: u32,
    /// Output file [default: standard output; SPIR-V needs a file].
    #[arg(long, value_name = "FILE", requires = "parts")]
    pub out: Option<PathBuf>,
}

/// Shading languages.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Language {
    /// WGSL, the parts and all they need
    #[default]
    Wgsl,
    /// WGSL for Bevy's preprocessor, each part with its imports
    NagaOil,
    /// WESL, each part with its imports
    Wesl,
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
    /// SPIR-V for linking, with the names of the functions
    Spirv,
}

/// Resources of tables.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Tables {
    /// Textures, which all languages support
    #[default]
    Textures,
    /// Read-only storage buffers
    Buffers,
}
