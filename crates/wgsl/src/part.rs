//! Parts of shaders: sources with their dependencies.

/// One concept in WGSL: its source, its dependencies and its bindings.
///
/// You can define your own parts:
///
/// ```
/// use asperity_wgsl::{Part, noise};
///
/// static HEIGHT: Part = Part::new(
///     "height",
///     "fn height(p: vec2<f32>) -> f32 { return 8.0 * perlin_noise_2d(p, 0u).value; }\n",
///     &[&noise::PERLIN],
/// );
/// assert_eq!(HEIGHT.needs()[0].name(), "noise/kinds/perlin");
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Part {
    name: &'static str,
    source: &'static str,
    needs: &'static [&'static Self],
    bindings: &'static [Binding],
}

impl Part {
    /// Creates a part without bindings.
    ///
    /// Names are unique. A composition keeps the first of two parts with the same name.
    #[must_use]
    pub const fn new(name: &'static str, source: &'static str, needs: &'static [&'static Self]) -> Self {
        Self { name, source, needs, bindings: &[] }
    }

    /// Adds bindings to uniforms, tables and textures.
    #[must_use]
    pub const fn with_bindings(self, bindings: &'static [Binding]) -> Self {
        Self { bindings, ..self }
    }

    /// Returns the path of the concept: crate, module, file; for instance `noise/kinds/gaussian`.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        self.name
    }

    /// Returns the plain WGSL, without bindings and dependencies.
    #[must_use]
    pub const fn source(&self) -> &'static str {
        self.source
    }

    /// Returns the direct dependencies: parts whose names the source uses, without their own
    /// dependencies.
    #[must_use]
    pub const fn needs(&self) -> &'static [&'static Self] {
        self.needs
    }

    /// Iterates over the names that the source defines, in order: functions, structures, constants.
    pub fn names(&self) -> impl Iterator<Item = &'static str> + use<> {
        self.source.lines().filter_map(|line| {
            let rest =
                ["fn ", "struct ", "const ", "alias "].iter().find_map(|word| line.strip_prefix(word))?;
            rest.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).next()
        })
    }

    /// Returns the resources that the source reads.
    #[must_use]
    pub const fn bindings(&self) -> &'static [Binding] {
        self.bindings
    }
}

/// A resource that a part reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Binding {
    /// `var<uniform> name: of;`
    Uniform {
        /// Name of the variable.
        name: &'static str,
        /// Its WGSL type, a structure of the part.
        of: &'static str,
    },
    /// A list of words, read by a function `fn name(i: u32) -> element`.
    ///
    /// As a texture it has one channel, `r32float` or `r32uint`, and `width` texels per row, and is
    /// read without filtering. As a buffer it is `array<element>`.
    Table {
        /// Name of the function.
        name: &'static str,
        /// Type of an element.
        element: Element,
        /// Texels per row, a power of two.
        width: u32,
    },
    /// `var name: texture_2d<f32>;` with mip levels.
    Texture {
        /// Name of the variable.
        name: &'static str,
    },
    /// `var name: sampler;`
    Sampler {
        /// Name of the variable.
        name: &'static str,
    },
}

impl Binding {
    /// Returns the name of the variable, or of the function that reads the table.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Uniform { name, .. }
            | Self::Table { name, .. }
            | Self::Texture { name }
            | Self::Sampler { name } => name,
        }
    }
}

/// Type of a table's elements.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Element {
    /// `f32`.
    Float,
    /// `u32`, also for the bits of floats mixed with integers, which hardware may flush to zero as
    /// floats.
    Word,
}

impl Element {
    /// Returns the name of the type in WGSL.
    #[must_use]
    pub const fn wgsl(self) -> &'static str {
        match self {
            Self::Float => "f32",
            Self::Word => "u32",
        }
    }
}

/// Defines a part of this crate from its file under `wgsl/`, the structs that its crate declares,
/// and its dependencies.
macro_rules! part {
    ($name:expr, [$($struct:ty),+] $(, $need:ident $(. $field:ident)?)* $(,)?) => {{
        const PIECES: &[&str] = &[$crate::part::file!($name) $(, "\n", <$struct>::WGSL)+];
        const TEXT: [u8; asperity_core::gpu::joined_len(PIECES)] = asperity_core::gpu::joined(PIECES);
        const SOURCE: &str = match core::str::from_utf8(&TEXT) {
            Ok(source) => source,
            Err(_) => unreachable!(),
        };
        $crate::part::Part::new($name, SOURCE, &[$(&$need $(. $field)?),*])
    }};
    ($name:expr $(, $need:ident $(. $field:ident)?)* $(,)?) => {
        $crate::part::Part::new($name, $crate::part::file!($name), &[$(&$need $(. $field)?),*])
    };
}

/// The text of a file under `wgsl/`.
macro_rules! file {
    ($name:expr) => {
        include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/src/wgsl/", $name, ".wgsl"))
    };
}

pub(crate) use file;
pub(crate) use part;
