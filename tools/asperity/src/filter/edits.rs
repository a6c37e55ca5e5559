//! The changes of a glTF: new textures and their data, materials that use them.

use asperity_render::geometry::mesh_file::gltf::buffers::{fetched, relative};
use serde_json::{Value, json};

use crate::failure::Result;
use crate::filter::container::{Container, number};
use crate::filter::output::Files;
use crate::filter::splice::{edit, items, member, set};

/// Changes, in the order in which they were made.
pub(super) struct Edits<'a> {
    gltf: &'a Container,
    materials: Vec<(usize, String)>,
    textures: Vec<String>,
    images: Vec<String>,
    samplers: Vec<String>,
    views: Vec<String>,
    /// Appended to the binary chunk.
    data: Vec<u8>,
    /// Files next to a model without a binary chunk.
    files: Vec<(&'static str, Vec<u8>)>,
    extensions: Vec<&'static str>,
    /// Copies of samplers, with mip levels.
    copies: Vec<(usize, usize)>,
}

impl<'a> Edits<'a> {
    pub(super) fn new(gltf: &'a Container) -> Self {
        Self {
            gltf,
            materials: Vec::new(),
            textures: Vec::new(),
            images: Vec::new(),
            samplers: Vec::new(),
            views: Vec::new(),
            data: Vec::new(),
            files: Vec::new(),
            extensions: Vec::new(),
            copies: Vec::new(),
        }
    }

    /// Returns the text of a material.
    pub(super) fn material(&self, index: usize) -> Result<&'a str> {
        let list = member(self.gltf.json(), "materials")?.unwrap_or("[]");
        items(list)?.get(index).copied().ok_or_else(|| "the glTF has another number of materials".into())
    }

    /// Replaces a material.
    pub(super) fn replace_material(&mut self, index: usize, text: String) {
        self.materials.push((index, text));
    }

    pub(super) fn use_extension(&mut self, name: &'static str) {
        if !self.extensions.contains(&name) {
            self.extensions.push(name);
        }
    }

    /// Returns a sampler with this one's wrap modes that blends mip levels.
    pub(super) fn mipmapped(&mut self, sampler: Option<usize>) -> Result<Option<usize>> {
        const LINEAR_MIPMAP_LINEAR: usize = 9987;
        let Some(sampler) = sampler else { return Ok(None) };
        // Without a value, loaders blend mip levels. Roughness would jump between unblended levels.
        let filter = number(self.gltf.item("samplers", sampler)?, "minFilter")?;
        if matches!(filter, None | Some(LINEAR_MIPMAP_LINEAR)) {
            return Ok(Some(sampler));
        }
        if let Some((_, copy)) = self.copies.iter().find(|(of, _)| *of == sampler) {
            return Ok(Some(*copy));
        }
        let list = member(self.gltf.json(), "samplers")?.unwrap_or("[]");
        let text = *items(list)?.get(sampler).ok_or("the glTF has another number of samplers")?;
        self.samplers.push(set(text, &[("minFilter", LINEAR_MIPMAP_LINEAR.to_string())])?);
        let copy = self.gltf.list("samplers").len() + self.samplers.len() - 1;
        self.copies.push((sampler, copy));
        Ok(Some(copy))
    }

    /// Adds an image and returns its index.
    pub(super) fn image(&mut self, extension: &'static str, bytes: Vec<u8>) -> usize {
        let kind = format!("image/{extension}");
        let image = if let Some(length) = self.gltf.bin_len() {
            let offset = length.next_multiple_of(4) + self.data.len();
            let view = json!({ "buffer": 0, "byteOffset": offset, "byteLength": bytes.len() });
            self.views.push(view.to_string());
            self.data.extend_from_slice(&bytes);
            self.data.resize(self.data.len().next_multiple_of(4), 0);
            let view = self.gltf.list("bufferViews").len() + self.views.len() - 1;
            json!({ "mimeType": kind, "bufferView": view }).to_string()
        } else {
            self.files.push((extension, bytes));
            // Its name follows from the model's.
            format!("{}", self.files.len() - 1)
        };
        self.images.push(image);
        self.gltf.list("images").len() + self.images.len() - 1
    }

    /// Adds a texture with an image for loaders without KTX2, and returns its index.
    pub(super) fn texture(&mut self, sampler: Option<usize>, fallback: usize, image: usize) -> usize {
        self.use_extension("KHR_texture_basisu");
        let mut texture =
            json!({ "source": fallback, "extensions": { "KHR_texture_basisu": { "source": image } } });
        if let Some(sampler) = sampler {
            texture["sampler"] = sampler.into();
        }
        self.textures.push(texture.to_string());
        self.gltf.list("textures").len() + self.textures.len() - 1
    }

    /// Adds the model and the files that it needs.
    pub(super) fn finish(mut self, files: &mut Files) -> Result<()> {
        if files.moved {
            self.copy(files)?;
        }
        let model = files.model.clone();
        if self.materials.is_empty() {
            files.add(model, self.gltf.bytes().to_vec());
            return Ok(());
        }
        let uris = std::mem::take(&mut self.files).into_iter().map(|(extension, bytes)| {
            let uri = escaped(&files.add_texture(extension, bytes));
            json!({ "mimeType": format!("image/{extension}"), "uri": uri }).to_string()
        });
        let uris: Vec<String> = uris.collect();
        for image in &mut self.images {
            if let Ok(file) = image.parse::<usize>() {
                image.clone_from(&uris[file]);
            }
        }
        let json = self.json()?;
        let bytes = self.gltf.rebuilt(&json, &self.data)?;
        files.add(model, bytes);
        Ok(())
    }

    /// Returns the JSON with all changes.
    fn json(&self) -> Result<String> {
        let text = self.gltf.json();
        let list = |name: &'static str, replaced: &[(usize, String)], appended: &[String]| {
            let old = member(text, name)?.unwrap_or("[]");
            Ok((name, edit(old, replaced, appended).map_err(|error| format!("`{name}`: {error}"))?))
        };
        let used = self.gltf.list("extensionsUsed");
        let new = self.extensions.iter().filter(|name| used.iter().all(|used| used != **name));
        let new: Vec<_> = new.map(|name| format!("\"{name}\"")).collect();
        let mut members: Vec<Result<(&str, String)>> = vec![
            list("materials", &self.materials, &[]),
            list("textures", &[], &self.textures),
            list("images", &[], &self.images),
        ];
        for (name, appended) in
            [("samplers", &self.samplers), ("bufferViews", &self.views), ("extensionsUsed", &new)]
        {
            if !appended.is_empty() {
                members.push(list(name, &[], appended));
            }
        }
        if let Some(length) = self.gltf.bin_len().filter(|_| !self.data.is_empty()) {
            let buffers = member(text, "buffers")?.unwrap_or("[]");
            let first = *items(buffers)?.first().ok_or("the glTF has no buffer")?;
            let length = length.next_multiple_of(4) + self.data.len();
            let first = set(first, &[("byteLength", length.to_string())])?;
            members.push(list("buffers", &[(0, first)], &[]));
        }
        set(text, &members.into_iter().collect::<Result<Vec<_>>>()?)
    }

    /// Copies the files that the model refers to.
    fn copy(&self, files: &mut Files) -> Result<()> {
        let mut copied: Vec<String> = Vec::new();
        for name in ["buffers", "images"] {
            for uri in
                self.gltf.list(name).iter().filter_map(|item| item.get("uri")).filter_map(Value::as_str)
            {
                if uri.get(..5).is_some_and(|scheme| scheme.eq_ignore_ascii_case("data:")) {
                    continue;
                }
                let file = relative(uri)?;
                if !copied.contains(&file) {
                    files.add_copy(file.clone(), fetched("file", uri, &self.gltf.folder)?)?;
                    copied.push(file);
                }
            }
        }
        Ok(())
    }
}

/// Encodes a file name as a URI.
fn escaped(name: &str) -> String {
    let plain = |byte: u8| byte.is_ascii_alphanumeric() || b"-._~".contains(&byte);
    name.bytes()
        .map(|byte| if plain(byte) { char::from(byte).to_string() } else { format!("%{byte:02X}") })
        .collect()
}
