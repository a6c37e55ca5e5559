//! The materials of a glTF, each with a new roughness map.

use std::sync::atomic::AtomicBool;

use png::{BitDepth, ColorType, Encoder};
use serde_json::{Value, json};

use crate::cli::filter::{Filter, FilteredFormat};
use crate::failure::Result;
use crate::filter::container::Container;
use crate::filter::edits::Edits;
use crate::filter::image::Images;
use crate::filter::levels::{Levels, Texel};
use crate::filter::output::Files;
use crate::filter::report;
use crate::filter::splice::{member, set};
use crate::filter::summary::{FilteredLevel, FilteredMaterial};
use crate::filter::texels::{Map, Maps};
use crate::filter::texture::{Places, Texture, numbers};
use crate::filter::texture_file::{self, Level};

/// A change of roughness that no texture of 8 bits can store.
const SMALLEST: f32 = 0.5 / 255.0;

/// New texels of a file. Any number of materials may refer to one image.
pub(super) const MOST_TEXELS: usize = 1 << 30;

/// The materials, with the maps that are already filtered.
pub(super) struct Materials<'a> {
    gltf: &'a Container,
    wanted: &'a Filter,
    images: Images<'a>,
    done: Vec<(String, Result<Filtered, String>)>,
    /// Texels of all new textures.
    pub(super) texels: usize,
}

/// Textures in place of a material's.
#[derive(Clone)]
struct Filtered {
    roughness: usize,
    /// In place of `roughnessFactor`.
    factor: f32,
    anisotropy: Option<usize>,
    levels: Vec<FilteredLevel>,
    error: Option<[f64; 2]>,
}

/// What the roughness of a material depends on.
struct Source {
    normal: Texture,
    scale: f32,
    roughness: Option<Texture>,
    factor: f32,
    places: Places,
}

impl Source {
    /// Returns the sampler of the map whose place the new texture takes.
    fn sampler(&self) -> Option<usize> {
        match &self.roughness {
            Some(map) if !self.places.of_normal => map.sampler,
            _ => self.normal.sampler,
        }
    }
}

impl<'a> Materials<'a> {
    pub(super) fn new(gltf: &'a Container, wanted: &'a Filter) -> Self {
        Self { gltf, wanted, images: Images::new(gltf), done: Vec::new(), texels: 0 }
    }

    /// Filters a material; `None` if it has no normal map.
    pub(super) fn filter(
        &mut self,
        index: usize,
        edits: &mut Edits<'_>,
        files: &mut Files,
        interrupted: &AtomicBool,
    ) -> Result<Option<FilteredMaterial>> {
        let material = self.gltf.item("materials", index)?;
        let name = material.get("name").and_then(Value::as_str).unwrap_or_default().to_owned();
        if !has(material, "/normalTexture") {
            return Ok(None);
        }
        let left = |why: String| {
            Ok(Some(FilteredMaterial { index, name: name.clone(), outcome: Err(why), error: None }))
        };
        let Some(normal) = Texture::read(self.gltf, material, "/normalTexture")? else {
            return left("its normal map has no image in a known format".into());
        };
        let source = match self.source(material, normal)? {
            Ok(source) => source,
            Err(why) => return left(why.into()),
        };
        let Source { normal, roughness, places, .. } = &source;
        let of_roughness = roughness.as_ref().map(|map| (map.image, map.wrap));
        let of_normal = (normal.image, normal.wrap, source.scale.to_bits());
        let factor = source.factor.to_bits();
        let key = format!("{of_normal:?} {of_roughness:?} {places:?} {factor} {:?}", source.sampler());
        let filtered = match self.done.iter().find(|(done, _)| *done == key) {
            Some((_, filtered)) => filtered.clone(),
            None => {
                let filtered = self.new_textures(index, &source, edits, files, interrupted)?;
                self.done.push((key, filtered.clone()));
                filtered
            }
        };
        let filtered = match filtered {
            Ok(filtered) => filtered,
            Err(why) => return left(why),
        };
        self.replace(index, material, &source, &filtered, edits)?;
        let Filtered { levels, error, .. } = filtered;
        Ok(Some(FilteredMaterial { index, name, outcome: Ok(levels), error }))
    }

    /// Reads what the roughness depends on, or why it cannot be filtered.
    fn source(&self, material: &Value, normal: Texture) -> Result<Result<Source, &'static str>> {
        let extended =
            |name: &str| material.pointer("/extensions").is_some_and(|all| all.get(name).is_some());
        if extended("KHR_materials_unlit") {
            return Ok(Err("it is unlit"));
        }
        if extended("KHR_materials_pbrSpecularGlossiness") {
            return Ok(Err("it has a glossiness instead of a roughness"));
        }
        if self.wanted.anisotropy && extended("KHR_materials_anisotropy") {
            return Ok(Err("it has an anisotropy"));
        }
        let place = "/pbrMetallicRoughness/metallicRoughnessTexture";
        let roughness = Texture::read(self.gltf, material, place)?;
        if roughness.is_none() && has(material, place) {
            return Ok(Err("its roughness map has no image in a known format"));
        }
        let factor = material.get("pbrMetallicRoughness");
        let [factor] = factor.map_or(Ok([1.0]), |pbr| numbers(pbr, "roughnessFactor", [1.0]))?;
        let [scale] = numbers(&material["normalTexture"], "scale", [1.0])?;
        let (factor, scale) = (factor.clamp(0.0, 1.0) as f32, scale as f32);
        Ok(Places::new(&normal, roughness.as_ref()).map(|places| Source {
            normal,
            scale,
            roughness,
            factor,
            places,
        }))
    }

    /// Computes new textures, or why none are needed.
    fn new_textures(
        &mut self,
        index: usize,
        source: &Source,
        edits: &mut Edits<'_>,
        files: &mut Files,
        interrupted: &AtomicBool,
    ) -> Result<Result<Filtered, String>> {
        let mut map =
            |texture: &Texture| self.images.get(texture.image).map(|image| Map { image, wrap: texture.wrap });
        let maps = Maps {
            normal: map(&source.normal)?,
            scale: source.scale,
            roughness: source.roughness.as_ref().map(map).transpose()?,
            factor: source.factor,
            places: source.places.clone(),
        };
        let multiple = match self.wanted.format {
            // `KHR_texture_basisu` requires multiples of 4.
            FilteredFormat::Uastc => 4,
            FilteredFormat::Zstd => 1,
        };
        let Some(texels) = maps.texels(multiple) else {
            return Ok(Err("its roughness would need more than 8192 texels on a side".into()));
        };
        let all = self.texels + texels.size[0] * texels.size[1];
        if all > MOST_TEXELS {
            return Ok(Err(format!("the file would have more than {MOST_TEXELS} new texels")));
        }
        self.texels = all;
        let levels = Levels::new(texels, interrupted)?;
        let gained = |texel: Texel| texel.roughness() - texel.plain[1];
        if (1..levels.count()).all(|level| levels.map(level, gained).into_iter().all(|gain| gain < SMALLEST))
        {
            return Ok(Err("no mip level would change: its normal map is flat or its roughness is 1".into()));
        }
        let anisotropic = self.wanted.anisotropy;
        let roughness = |texel: Texel| {
            let [_, across] = texel.alpha2_along().0;
            if anisotropic { across.sqrt().sqrt() } else { texel.roughness() }
        };
        let peak = (0..levels.count()).flat_map(|level| levels.map(level, roughness)).fold(0.0, f32::max);
        let kept = peak <= source.factor + SMALLEST;
        let factor = if kept { source.factor } else { ((peak * 1e4).ceil() / 1e4).min(1.0) };
        let packed = |texel: Texel| {
            let [occlusion, _, metallic] = texel.plain;
            bytes([occlusion, roughness(texel) / factor, metallic])
        };
        let stored = rgba(&levels, packed);
        if self.wanted.png.is_some() {
            files.add_levels(index, "roughness", factor, pngs(&stored)?);
        }
        let sampler = edits.mipmapped(source.sampler())?;
        let old = match &source.roughness {
            Some(map) if kept && !source.places.of_normal => {
                self.gltf.item("textures", map.index)?.get("source")
            }
            _ => None,
        };
        let fallback = match (old.and_then(Value::as_u64), &source.roughness) {
            (Some(old), _) => old as usize,
            (None, Some(_)) => edits.image("png", png(&stored[0])?),
            // The same everywhere.
            (None, None) => {
                edits.image("png", png(&Level { size: [1; 2], rgba: stored[0].rgba[..4].into() })?)
            }
        };
        let image = edits.image("ktx2", texture_file::encode(&stored, self.wanted.format)?);
        let texture = edits.texture(sampler, fallback, image);
        let anisotropy = anisotropic.then(|| {
            let (_, main) = levels.texel(levels.count() - 1, 0).alpha2_along();
            let stored = rgba(&levels, |texel| direction(texel, main));
            if self.wanted.png.is_some() {
                files.add_levels(index, "anisotropy", 1.0, pngs(&stored)?);
            }
            let fallback = Level { size: [1; 2], rgba: vec![255, 128, 0, 255] };
            let fallback = edits.image("png", png(&fallback)?);
            let image = edits.image("ktx2", texture_file::encode(&stored, self.wanted.format)?);
            Ok::<_, crate::failure::Failure>(edits.texture(sampler, fallback, image))
        });
        let means = |level| {
            let [width, height] = levels.size(level);
            let pairs = levels.map(level, |texel| [texel.plain[1], roughness(texel)].map(f64::from));
            let [before, after] =
                [0, 1].map(|k| pairs.iter().map(|pair| pair[k]).sum::<f64>() / pairs.len() as f64);
            FilteredLevel { width, height, before, after }
        };
        Ok(Ok(Filtered {
            roughness: texture,
            factor,
            anisotropy: anisotropy.transpose()?,
            levels: (0..levels.count()).map(means).collect(),
            error: self.wanted.report.then(|| report::errors(&levels, anisotropic)),
        }))
    }

    /// Replaces the text of a material.
    fn replace(
        &self,
        index: usize,
        material: &Value,
        source: &Source,
        filtered: &Filtered,
        edits: &mut Edits<'_>,
    ) -> Result<()> {
        let text = edits.material(index)?;
        let pbr = member(text, "pbrMetallicRoughness")?.unwrap_or("{}");
        let old = member(pbr, "metallicRoughnessTexture")?.filter(|_| !source.places.of_normal);
        let normal = &material["normalTexture"];
        let placed = |texture: usize| {
            let mut info = json!({ "index": texture });
            if let Some(set) = normal.get("texCoord") {
                info["texCoord"] = set.clone();
            }
            if let Some(place) = normal.pointer("/extensions/KHR_texture_transform") {
                info["extensions"] = json!({ "KHR_texture_transform": place });
            }
            info.to_string()
        };
        let info = |texture: usize| match old {
            Some(old) => set(old, &[("index", texture.to_string())]),
            None => Ok(placed(texture)),
        };
        let mut members = vec![("metallicRoughnessTexture", info(filtered.roughness)?)];
        if filtered.factor != source.factor {
            members.push(("roughnessFactor", filtered.factor.to_string()));
        }
        let mut changed = vec![("pbrMetallicRoughness", set(pbr, &members)?)];
        // The new texture has the occlusion of the old one too.
        if let (Some(old), Some(occlusion), Some(roughness)) = (
            member(text, "occlusionTexture")?,
            Texture::read(self.gltf, material, "/occlusionTexture")?,
            source.roughness.as_ref().filter(|_| !source.places.of_normal),
        ) && occlusion == *roughness
        {
            changed.push(("occlusionTexture", set(old, &[("index", filtered.roughness.to_string())])?));
        }
        if let Some(texture) = filtered.anisotropy {
            edits.use_extension("KHR_materials_anisotropy");
            let value = format!("{{\"anisotropyStrength\":1,\"anisotropyTexture\":{}}}", info(texture)?);
            let extensions = member(text, "extensions")?.unwrap_or("{}");
            changed.push(("extensions", set(extensions, &[("KHR_materials_anisotropy", value)])?));
        }
        edits.replace_material(index, set(text, &changed)?);
        Ok(())
    }
}

fn has(material: &Value, pointer: &str) -> bool {
    material.pointer(pointer).is_some_and(|value| !value.is_null())
}

/// Returns direction and strength of an anisotropy: `α_t = α + (1 − α) strength²` along the
/// direction of more variance, and `α` across.
///
/// A direction and its opposite are the same. The one on the side of `main` is stored, so that
/// neighboring texels do not cancel when they are interpolated.
fn direction(texel: Texel, main: [f32; 2]) -> [u8; 4] {
    let (alpha2, [x, y]) = texel.alpha2_along();
    let [along, across] = alpha2.map(f32::sqrt);
    let strength = ((along - across) / (1.0 - across).max(1e-6)).clamp(0.0, 1.0).sqrt();
    let [x, y] = match x * main[0] + y * main[1] {
        _ if strength == 0.0 => main,
        ..0.0 => [-x, -y],
        _ => [x, y],
    };
    bytes([0.5 + 0.5 * x, 0.5 + 0.5 * y, strength])
}

fn bytes(values: [f32; 3]) -> [u8; 4] {
    let [r, g, b] = values.map(|value| (255.0 * value.clamp(0.0, 1.0)).round() as u8);
    [r, g, b, 255]
}

fn rgba(levels: &Levels, texel: impl Fn(Texel) -> [u8; 4] + Sync) -> Vec<Level> {
    let level = |k| Level { size: levels.size(k), rgba: levels.map(k, &texel).concat() };
    (0..levels.count()).map(level).collect()
}

/// Encodes a level as a PNG file.
fn png(level: &Level) -> Result<Vec<u8>> {
    let [width, height] = level.size.map(|side| side as u32);
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, width, height);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    let rgb: Vec<u8> = level.rgba.as_chunks::<4>().0.iter().flat_map(|[r, g, b, _]| [*r, *g, *b]).collect();
    encoder.write_header()?.write_image_data(&rgb)?;
    Ok(bytes)
}

fn pngs(levels: &[Level]) -> Result<Vec<Vec<u8>>> {
    levels.iter().map(png).collect()
}
