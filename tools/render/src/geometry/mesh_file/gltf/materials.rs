//! The materials of a glTF, with their textures.

use std::{borrow::Cow, collections::BTreeSet, io, path::Path, sync::Arc};

use asperity_shading::{StandardMaterialParameters, reflectance::Absorption};
use glam::{Affine2, Mat2, Vec2, Vec3};
use serde_json::Value;

use crate::{
    geometry::mesh_file::{
        error::{MOST_TEXELS, MeshFileError},
        gltf::{
            buffers::{Gltf, fetched},
            document::{item, shown},
        },
        materials::{Coverage, TexturedMaterial, Textures},
    },
    image::texture_map::{Texels, TextureMap, Wrap},
};

/// The materials of a document.
pub(super) struct Materials {
    /// All materials, and last the material of primitives without one.
    pub(super) list: Vec<TexturedMaterial>,
    /// Features that are not rendered.
    pub(super) ignored: Vec<String>,
}

impl Materials {
    /// Reads all materials, or returns `None` if there are none. An image is decoded once, and only
    /// if a material uses it.
    pub(super) fn read(gltf: &Gltf, folder: &Path) -> Result<Option<Self>, MeshFileError> {
        let materials = list(&gltf.document.materials);
        if materials.is_empty() {
            return Ok(None);
        }
        let decoded = vec![None; list(&gltf.document.images).len()];
        let most = TEXELS + TEXELS_PER_BYTE * gltf.bytes();
        let mut images = Images { gltf, folder, decoded, texels: 0, most, missing: Vec::new() };
        let usual = Value::Null;
        let all = materials.iter().chain([&usual]).enumerate();
        let all = all.map(|(index, value)| Source { value, index }.material(&mut images));
        let list = all.collect::<Result<_, _>>()?;
        if let Some(error) = images.missing() {
            return Err(error);
        }
        Ok(Some(Self { list, ignored: ignored(materials) }))
    }

    /// Returns the index of a primitive's material.
    pub(super) fn index(&self, material: &Value) -> Result<u32, MeshFileError> {
        let usual = self.list.len() - 1;
        if material.is_null() {
            return Ok(usual as u32);
        }
        let index = material.as_u64().map_or(usize::MAX, |index| index as usize);
        item(&self.list[..usual], "material", index).map(|_| index as u32)
    }

    /// Returns the set of texture coordinates of a material's normal map.
    pub(super) fn normal_set(&self, material: u32) -> usize {
        let normal = self.list.get(material as usize).and_then(|m| m.textures.normal.as_ref());
        normal.map_or(0, |map| map.set)
    }
}

/// Rendered extensions of materials, with their features that are not.
const RENDERED: [(&str, &[&str]); 10] = [
    ("KHR_materials_anisotropy", &[]),
    ("KHR_materials_clearcoat", &["clearcoatNormalTexture"]),
    ("KHR_materials_emissive_strength", &[]),
    ("KHR_materials_ior", &[]),
    ("KHR_materials_sheen", &[]),
    ("KHR_materials_specular", &[]),
    ("KHR_materials_transmission", &[]),
    ("KHR_materials_unlit", &[]),
    ("KHR_materials_volume", &["thicknessTexture"]),
    ("KHR_texture_transform", &[]),
];

/// Returns the features of materials that are not rendered, sorted.
fn ignored(materials: &[Value]) -> Vec<String> {
    let mut names = BTreeSet::new();
    for material in materials {
        if material.get("occlusionTexture").is_some_and(|texture| !texture.is_null()) {
            names.insert("occlusionTexture".to_owned());
        }
        let extensions = material.get("extensions").and_then(Value::as_object);
        for (name, value) in extensions.into_iter().flatten() {
            match RENDERED.iter().find(|(rendered, _)| name == rendered) {
                Some((_, features)) => {
                    let used = features.iter().filter(|feature| value.get(**feature).is_some());
                    names.extend(used.map(|&feature| feature.to_owned()));
                }
                None => drop(names.insert(shown(name))),
            }
        }
    }
    names.into_iter().collect()
}

/// Returns the items of a list that may be missing.
fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

/// A material of the document.
struct Source<'a> {
    value: &'a Value,
    index: usize,
}

const CLEARCOAT: &str = "/extensions/KHR_materials_clearcoat";

impl Source<'_> {
    fn material(&self, images: &mut Images<'_>) -> Result<TexturedMaterial, MeshFileError> {
        let [r, g, b, alpha] = self.numbers("/pbrMetallicRoughness/baseColorFactor", [1.0; 4])?;
        let extended = |extension: &str, name: &str| format!("/extensions/KHR_materials_{extension}/{name}");
        let number = |extension, name, usual| self.number(&extended(extension, name), usual);
        let color =
            |extension, name, usual| self.numbers(&extended(extension, name), [usual; 3]).map(Vec3::from);
        let strength = number("emissive_strength", "emissiveStrength", 1.0)?;
        let parameters = StandardMaterialParameters {
            base_color: Vec3::new(r, g, b),
            metallic: self.number("/pbrMetallicRoughness/metallicFactor", 1.0)?,
            roughness: self.number("/pbrMetallicRoughness/roughnessFactor", 1.0)?,
            emissive: Vec3::from(self.numbers("/emissiveFactor", [0.0; 3])?) * strength,
            ior: number("ior", "ior", 1.5)?,
            specular: number("specular", "specularFactor", 1.0)?,
            specular_color: color("specular", "specularColorFactor", 1.0)?,
            clearcoat: number("clearcoat", "clearcoatFactor", 0.0)?,
            clearcoat_roughness: number("clearcoat", "clearcoatRoughnessFactor", 0.0)?,
            sheen_color: color("sheen", "sheenColorFactor", 0.0)?,
            sheen_roughness: number("sheen", "sheenRoughnessFactor", 0.0)?,
            transmission: number("transmission", "transmissionFactor", 0.0)?,
            thickness: number("volume", "thicknessFactor", 0.0)?,
            anisotropy: number("anisotropy", "anisotropyStrength", 0.0)?,
            anisotropy_rotation: number("anisotropy", "anisotropyRotation", 0.0)? % std::f32::consts::TAU,
        };
        let mut texture = |pointer: &str| self.texture(pointer, images);
        let textures = Textures {
            base_color: texture("/pbrMetallicRoughness/baseColorTexture")?,
            metallic_roughness: texture("/pbrMetallicRoughness/metallicRoughnessTexture")?,
            normal: texture("/normalTexture")?,
            emissive: texture("/emissiveTexture")?,
            clearcoat: texture(&format!("{CLEARCOAT}/clearcoatTexture"))?,
            clearcoat_roughness: texture(&format!("{CLEARCOAT}/clearcoatRoughnessTexture"))?,
            sheen_color: texture(&extended("sheen", "sheenColorTexture"))?,
            sheen_roughness: texture(&extended("sheen", "sheenRoughnessTexture"))?,
            transmission: texture(&extended("transmission", "transmissionTexture"))?,
            specular: texture(&extended("specular", "specularTexture"))?,
            specular_color: texture(&extended("specular", "specularColorTexture"))?,
            anisotropy: texture(&extended("anisotropy", "anisotropyTexture"))?,
        };
        let coverage = match self.value.get("alphaMode").and_then(Value::as_str) {
            Some("MASK") => Coverage::Mask(self.number("/alphaCutoff", 0.5)?),
            Some("BLEND") => Coverage::Blend,
            _ => Coverage::Opaque,
        };
        let passed = color("volume", "attenuationColor", 1.0)?.clamp(Vec3::ZERO, Vec3::ONE);
        let distance = number("volume", "attenuationDistance", f32::INFINITY)?;
        Ok(TexturedMaterial {
            parameters,
            alpha,
            coverage,
            double_sided: self.value.get("doubleSided") == Some(&Value::Bool(true)),
            unlit: self.value.pointer("/extensions/KHR_materials_unlit").is_some(),
            normal_scale: self.number("/normalTexture/scale", 1.0)?,
            // Infinite and invalid distances absorb nothing.
            absorption: Absorption::of_color(passed, distance).unwrap_or(Absorption::NONE),
            textures,
        })
    }

    fn number(&self, pointer: &str, usual: f32) -> Result<f32, MeshFileError> {
        self.found(pointer).map_or(Ok(usual), |value| self.read(pointer, value))
    }

    fn numbers<const N: usize>(&self, pointer: &str, usual: [f32; N]) -> Result<[f32; N], MeshFileError> {
        let Some(value) = self.found(pointer) else { return Ok(usual) };
        let list = value.as_array().filter(|list| list.len() == N);
        let list = list.ok_or_else(|| self.wrong(pointer))?;
        let mut numbers = usual;
        for (number, value) in numbers.iter_mut().zip(list) {
            *number = self.read(pointer, value)?;
        }
        Ok(numbers)
    }

    fn read(&self, pointer: &str, value: &Value) -> Result<f32, MeshFileError> {
        value.as_f64().map(|number| number as f32).ok_or_else(|| self.wrong(pointer))
    }

    fn found(&self, pointer: &str) -> Option<&Value> {
        self.value.pointer(pointer).filter(|value| !value.is_null())
    }

    fn wrong(&self, pointer: &str) -> MeshFileError {
        let field = pointer.rsplit('/').next().unwrap_or_default().to_owned();
        MeshFileError::Material { material: self.index, field }
    }

    /// Reads a texture with its place. A texture without an image is white.
    fn texture(&self, pointer: &str, images: &mut Images<'_>) -> Result<Option<TextureMap>, MeshFileError> {
        let Some(info) = self.found(pointer) else { return Ok(None) };
        let named = |field: &str, value: Option<&Value>| -> Result<Option<usize>, MeshFileError> {
            let Some(value) = value else { return Ok(None) };
            let index = value.as_u64().and_then(|index| usize::try_from(index).ok());
            index.map(Some).ok_or_else(|| self.wrong(field))
        };
        let index = |value: Option<&Value>| named(pointer, value);
        let set = |value: Option<&Value>| named("texCoord", value);
        let document = &images.gltf.document;
        let texture = index(info.get("index"))?.ok_or_else(|| self.wrong(pointer))?;
        let texture = item(list(&document.textures), "texture", texture)?;
        let extensions = texture.get("extensions").and_then(Value::as_object);
        let other = extensions.and_then(|all| all.get("EXT_texture_webp")).and_then(|all| all.get("source"));
        let Some(image) = index(other.or_else(|| texture.get("source")))? else {
            // Its image is in a format of an extension.
            let extension = extensions.and_then(|all| all.keys().next());
            return extension
                .map_or(Ok(None), |name| Err(MeshFileError::Extension { extension: shown(name) }));
        };
        let sampler = index(texture.get("sampler"))?;
        let sampler =
            sampler.map(|sampler| item(list(&document.samplers), "sampler", sampler)).transpose()?;
        let number = |name: &str| sampler.and_then(|sampler| sampler.get(name)).and_then(Value::as_u64);
        let wrap = |name: &str| match number(name) {
            Some(33_071) => Wrap::Clamp,
            Some(33_648) => Wrap::Mirror,
            _ => Wrap::Repeat,
        };
        let (wrap, nearest) = ([wrap("wrapS"), wrap("wrapT")], number("magFilter") == Some(9728));
        let (mut coordinates, mut transform) = (set(info.get("texCoord"))?, Affine2::IDENTITY);
        if info.pointer("/extensions/KHR_texture_transform").is_some() {
            let at = |name: &str| format!("{pointer}/extensions/KHR_texture_transform/{name}");
            let own = set(info.pointer("/extensions/KHR_texture_transform/texCoord"))?;
            coordinates = own.or(coordinates);
            let offset = Vec2::from(self.numbers(&at("offset"), [0.0; 2])?);
            let scale = Vec2::from(self.numbers(&at("scale"), [1.0; 2])?);
            // Counterclockwise where v points down.
            let rotation = -self.number(&at("rotation"), 0.0)?;
            let matrix = Mat2::from_angle(rotation) * Mat2::from_diagonal(scale);
            transform = Affine2::from_mat2_translation(matrix, offset);
        }
        let set = coordinates.unwrap_or(0);
        if set > 1 {
            let field = pointer.rsplit('/').next().unwrap_or_default().to_owned();
            return Err(MeshFileError::TexCoord { material: self.index, field, set });
        }
        Ok(Some(TextureMap { texels: images.texels(image)?, set, transform, wrap, nearest }))
    }
}

/// Texels of any file: 16 images of 2048 × 2048.
const TEXELS: usize = 1 << 26;
/// Maximum expansion ratio of deflate. More texels than this share their bytes.
const TEXELS_PER_BYTE: usize = 1032;

/// The images of a document.
struct Images<'a> {
    gltf: &'a Gltf,
    folder: &'a Path,
    decoded: Vec<Option<Arc<Texels>>>,
    /// Decoded texels.
    texels: usize,
    /// The maximum number of texels. Any number of images may refer to the same bytes.
    most: usize,
    /// The files that do not exist.
    missing: Vec<(String, io::Error)>,
}

impl Images<'_> {
    fn texels(&mut self, index: usize) -> Result<Arc<Texels>, MeshFileError> {
        if let Some(Some(texels)) = self.decoded.get(index) {
            return Ok(Arc::clone(texels));
        }
        let texels = Arc::new(self.read(index)?);
        self.decoded[index] = Some(Arc::clone(&texels));
        Ok(texels)
    }

    /// Decodes an image. An image whose file does not exist is recorded, and white.
    fn read(&mut self, index: usize) -> Result<Texels, MeshFileError> {
        let image = item(list(&self.gltf.document.images), "image", index)?;
        let uri = image.get("uri").and_then(Value::as_str);
        let view = image.get("bufferView").and_then(Value::as_u64);
        let file: Option<Cow<'_, [u8]>> = match (uri, view) {
            (Some(uri), _) => match fetched("image", uri, self.folder) {
                Err(MeshFileError::Beside { uri, error, .. }) if error.kind() == io::ErrorKind::NotFound => {
                    self.missing.push((uri, error));
                    return Ok(Texels::white());
                }
                file => {
                    let file = file?;
                    self.most = self.most.saturating_add(TEXELS_PER_BYTE * file.len());
                    Some(file.into())
                }
            },
            (None, Some(view)) => {
                let view = item(&self.gltf.document.buffer_views, "buffer view", view as usize)?;
                self.gltf.within(view).map(Cow::from)
            }
            (None, None) => None,
        };
        let file = file.ok_or(MeshFileError::Lacks { what: "buffer of its image" })?;
        let failed = |error| {
            let uri = uri.filter(|uri| !uri.get(..5).is_some_and(|uri| uri.eq_ignore_ascii_case("data:")));
            let image = uri.map_or_else(|| format!("image {index}"), |uri| format!("image `{}`", shown(uri)));
            MeshFileError::Image { image, error }
        };
        let opened = Texels::open(&file).map_err(failed)?;
        self.texels += opened.count();
        let most = self.most.min(MOST_TEXELS);
        if self.texels > most {
            return Err(MeshFileError::ImagesTooLarge { most });
        }
        opened.decode().map_err(failed)
    }

    /// Returns the error for files that do not exist.
    fn missing(&mut self) -> Option<MeshFileError> {
        let (uri, error) = self.missing.pop()?;
        if self.missing.is_empty() {
            return Some(MeshFileError::Beside { what: "image", uri, error });
        }
        let mut uris: Vec<_> = self.missing.drain(..).map(|(uri, _)| uri).collect();
        uris.push(uri);
        Some(MeshFileError::MissingImages { uris })
    }
}
