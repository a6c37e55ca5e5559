//! The textures of a material, with their place on the surface.

use asperity_render::image::texture_map::Wrap;
use glam::{DAffine2, DMat2, DVec2};
use serde_json::Value;

use crate::failure::Result;
use crate::filter::container::{Container, number};

/// A texture as a material uses it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Texture {
    /// Index in `textures`.
    pub(super) index: usize,
    /// Index in `images`.
    pub(super) image: usize,
    pub(super) sampler: Option<usize>,
    /// The set of texture coordinates.
    pub(super) set: usize,
    /// Applied to the texture coordinates, whose v points down.
    pub(super) transform: DAffine2,
    /// Along u and v.
    pub(super) wrap: [Wrap; 2],
}

impl Texture {
    /// Reads the texture at a pointer of a material; `None` without an image in a known format.
    pub(super) fn read(gltf: &Container, material: &Value, pointer: &str) -> Result<Option<Self>> {
        let Some(info) = material.pointer(pointer).filter(|info| !info.is_null()) else { return Ok(None) };
        let index = number(info, "index")?.ok_or("a texture has no `index`")?;
        let texture = gltf.item("textures", index)?;
        let Some(image) = image(texture)? else { return Ok(None) };
        let sampler = number(texture, "sampler")?;
        let wrap = |name: &str| -> Result<Wrap> {
            let Some(sampler) = sampler else { return Ok(Wrap::Repeat) };
            Ok(match number(gltf.item("samplers", sampler)?, name)? {
                Some(33_071) => Wrap::Clamp,
                Some(33_648) => Wrap::Mirror,
                _ => Wrap::Repeat,
            })
        };
        let wrap = [wrap("wrapS")?, wrap("wrapT")?];
        let place = info.pointer("/extensions/KHR_texture_transform");
        let own = place.map_or(Ok(None), |place| number(place, "texCoord"))?;
        let set = own.or(number(info, "texCoord")?).unwrap_or(0);
        let transform = place.map_or(Ok(DAffine2::IDENTITY), transform)?;
        Ok(Some(Self { index, image, sampler, set, transform, wrap }))
    }
}

/// Returns the image of a texture, in the format that is easiest to decode without loss.
fn image(texture: &Value) -> Result<Option<usize>> {
    if let Some(source) = number(texture, "source")? {
        return Ok(Some(source));
    }
    for extension in ["EXT_texture_webp", "KHR_texture_basisu"] {
        if let Some(value) = texture.pointer(&format!("/extensions/{extension}")) {
            return number(value, "source");
        }
    }
    Ok(None)
}

/// Reads a `KHR_texture_transform`.
fn transform(place: &Value) -> Result<DAffine2> {
    let offset = DVec2::from(numbers(place, "offset", [0.0; 2])?);
    let scale = DVec2::from(numbers(place, "scale", [1.0; 2])?);
    let [rotation] = numbers(place, "rotation", [0.0])?;
    // Counterclockwise where v points down.
    let matrix = DMat2::from_angle(-rotation) * DMat2::from_diagonal(scale);
    Ok(DAffine2::from_mat2_translation(matrix, offset))
}

/// Reads a number or a list of numbers.
pub(super) fn numbers<const N: usize>(value: &Value, name: &str, usual: [f64; N]) -> Result<[f64; N]> {
    let Some(value) = value.get(name).filter(|value| !value.is_null()) else { return Ok(usual) };
    let read = match value.as_array() {
        Some(list) => list.iter().map(Value::as_f64).collect::<Option<Vec<_>>>(),
        None => value.as_f64().map(|number| vec![number]),
    };
    let read = read
        .and_then(|list| <[f64; N]>::try_from(list).ok())
        .filter(|list| list.iter().all(|n| n.abs() < 1e6));
    read.ok_or_else(|| format!("invalid `{name}` (expected {N} numbers)").into())
}

/// Where two textures lie in the square of a third, which takes the place of one of them.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Places {
    /// From the square to the roughness map.
    pub(super) roughness: DAffine2,
    /// From the square to the normal map.
    pub(super) normal: DAffine2,
    /// Whether the square is that of the normal map.
    pub(super) of_normal: bool,
}

impl Places {
    /// Returns the places in one square, or the reason why no square holds both.
    pub(super) fn new(normal: &Texture, roughness: Option<&Texture>) -> Result<Self, &'static str> {
        let identity = DAffine2::IDENTITY;
        let Some(roughness) = roughness else {
            return Ok(Self { roughness: identity, normal: identity, of_normal: true });
        };
        if normal.set != roughness.set {
            return Err("its normal and roughness maps use different texture coordinates");
        }
        let invertible = |texture: &Texture| texture.transform.matrix2.determinant().abs() > 1e-12;
        if !invertible(normal) || !invertible(roughness) {
            return Err("a `KHR_texture_transform` is not invertible");
        }
        let to_normal = normal.transform * roughness.transform.inverse();
        if to_normal.abs_diff_eq(identity, 1e-6) {
            if normal.wrap != roughness.wrap {
                return Err("its normal and roughness maps have different wrap modes");
            }
            return Ok(Self { roughness: identity, normal: identity, of_normal: false });
        }
        let whole =
            |place: DAffine2| place.matrix2.to_cols_array().iter().all(|n| (n - n.round()).abs() < 1e-6);
        if normal.wrap != [Wrap::Repeat; 2] || roughness.wrap != [Wrap::Repeat; 2] {
            return Err("its normal and roughness maps have different transforms, and do not repeat");
        }
        if whole(to_normal) {
            return Ok(Self { roughness: identity, normal: to_normal, of_normal: false });
        }
        if whole(to_normal.inverse()) {
            return Ok(Self { roughness: to_normal.inverse(), normal: identity, of_normal: true });
        }
        Err("its normal and roughness maps have transforms without a common period")
    }
}
