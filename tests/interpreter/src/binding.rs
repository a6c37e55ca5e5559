//! Resources bound to the names of a module.

use naga::proc::Layouter;
use naga::{
    AddressSpace, ArraySize, GlobalVariable, Handle, ImageClass, ImageDimension, Module, StorageAccess,
    TypeInner,
};

use super::layout;

/// A texture with one component.
#[derive(Debug)]
pub(super) struct Texture {
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) words: Vec<u32>,
}

/// All bound resources, by naga's index.
#[derive(Debug)]
pub(super) struct Bindings {
    names: Vec<String>,
    buffers: Vec<Option<Vec<u32>>>,
    textures: Vec<Option<Texture>>,
}

impl Bindings {
    /// Creates an empty set.
    pub(super) fn new(module: &Module) -> Self {
        let names: Vec<String> = module
            .global_variables
            .iter()
            .map(|(_, global)| global.name.clone().unwrap_or_default())
            .collect();
        let buffers = names.iter().map(|_| None).collect();
        let textures = names.iter().map(|_| None).collect();
        Self { names, buffers, textures }
    }

    /// Binds a texture by its rows.
    pub(super) fn texture(
        &mut self,
        module: &Module,
        name: &str,
        width: u32,
        words: Vec<u32>,
    ) -> Result<(), String> {
        let (handle, global) = named(module, name)?;
        let is_table = matches!(
            module.types[global.ty].inner,
            TypeInner::Image {
                dim: ImageDimension::D2,
                arrayed: false,
                class: ImageClass::Sampled { multi: false, .. }
            }
        );
        if !is_table {
            return Err(format!("`{name}` is not a texture_2d"));
        }
        let length = words.len() as u32;
        if width == 0 || length == 0 || !length.is_multiple_of(width) {
            return Err(format!("`{name}`: {length} words are not a multiple of the row width {width}"));
        }
        self.textures[handle.index()] = Some(Texture { width, height: length / width, words });
        Ok(())
    }

    /// Binds a uniform or a storage buffer by its words with padding.
    pub(super) fn buffer(
        &mut self,
        module: &Module,
        name: &str,
        words: &[u32],
        sort: &str,
    ) -> Result<(), String> {
        let (handle, global) = named(module, name)?;
        let own = match global.space {
            AddressSpace::Uniform => "uniform",
            AddressSpace::Storage { access } if !access.contains(StorageAccess::STORE) => "storage buffer",
            _ => "another resource",
        };
        if own != sort {
            return Err(format!("`{name}` is not a readable {sort} but {own}"));
        }
        let mut layouter = Layouter::default();
        layouter.update(module.to_ctx()).map_err(|error| error.to_string())?;
        let bytes = words.len() as u32 * 4;
        if let Some(stride) = runtime_stride(module, global) {
            if !bytes.is_multiple_of(stride) {
                return Err(format!("`{name}` has elements of {} words, got {}", stride / 4, words.len()));
            }
        } else {
            let size = layouter[global.ty].size;
            // `std140` rounds sizes up to 16 bytes.
            if bytes != size && bytes != size.next_multiple_of(16) {
                return Err(format!("`{name}` has {} words, got {}", size / 4, words.len()));
            }
        }
        let mut unpadded = Vec::new();
        layout::unpad(module, global.ty, words, 0, &mut unpadded)
            .map_err(|error| format!("`{name}`: {error}"))?;
        self.buffers[handle.index()] = Some(unpadded);
        Ok(())
    }

    /// Returns the words of a buffer without padding.
    pub(super) fn buffer_words(&self, index: usize) -> Result<&[u32], String> {
        self.buffers[index].as_deref().ok_or_else(|| self.unbound(index))
    }

    /// Returns a texture.
    pub(super) fn texture_at(&self, index: usize) -> Result<&Texture, String> {
        let texture = self.textures.get(index).ok_or("no such texture")?;
        texture.as_ref().ok_or_else(|| self.unbound(index))
    }

    /// Returns the name of a global variable.
    pub(super) fn name(&self, index: usize) -> &str {
        self.names.get(index).map_or("", String::as_str)
    }

    fn unbound(&self, index: usize) -> String {
        format!("no resource for `{}`", self.name(index))
    }
}

/// Returns the stride of a runtime-sized array.
fn runtime_stride(module: &Module, global: &GlobalVariable) -> Option<u32> {
    match module.types[global.ty].inner {
        TypeInner::Array { size: ArraySize::Dynamic, stride, .. } => Some(stride),
        _ => None,
    }
}

/// Returns the global variable of a name.
fn named<'m>(module: &'m Module, name: &str) -> Result<(Handle<GlobalVariable>, &'m GlobalVariable), String> {
    let mut globals = module.global_variables.iter();
    globals
        .find(|(_, global)| global.name.as_deref() == Some(name))
        .ok_or_else(|| format!("no global variable `{name}`"))
}
