//! The materials of `render`, and their named parameters.

use asperity_render::image::tone::hex;
use asperity_render::materials::{InMetres, Projected};
use asperity_render::scene::Surface;
use asperity_shading::material::{BrickWall, GlassBody, GlassWaves, PaintFlakes, PolishedMarble, Wallpaper};
use asperity_shading::reflectance::{Absorption, Coat};
use asperity_shading::texture::{Brick, StarWallpaper, StarWallpaperParameters};
use asperity_shading::{
    Carpet, CarpetParameters, Marble, MetallicPaint, MetallicPaintParameters, Scratches, ScratchesParameters,
    TemperedGlass, TemperedGlassParameters, Variations, VariationsParameters, noise::Perlin,
};
use glam::Vec3;
use serde::{Serialize, de::DeserializeOwned};
use serde_json::{Value, json};

use crate::cli::render::{Material, Render};
use crate::failure::Result;

/// Parameter names with descriptions.
type Fields = &'static [(&'static str, &'static str)];

/// A material's parameters, including those set by the options common to all materials.
pub(crate) struct Parameters {
    values: Value,
    fields: Fields,
    /// Parameters multiplied by the tint, each with its factor.
    tint: &'static [(&'static str, f32)],
    roughness: &'static str,
}

/// Options common to all materials, and parameters by name.
pub(crate) struct Chosen<'a> {
    pub(crate) tint: Option<u32>,
    pub(crate) roughness: Option<f32>,
    pub(crate) seed: u32,
    pub(crate) set: &'a [(String, String)],
}

/// A material for a scene.
pub(crate) struct Made<'a> {
    pub(crate) surface: Box<Surface<'a>>,
    /// The absorption inside a refracting body.
    pub(crate) body: Option<Absorption>,
}

impl Parameters {
    /// Returns the default parameters of a material in the gallery. Bumps have none.
    pub(crate) fn usual(material: Material) -> Result<Self> {
        fn of<P: Serialize>(values: P, fields: Fields) -> Result<(Value, Fields)> {
            Ok((serde_json::to_value(values)?, fields))
        }
        let paint = MetallicPaintParameters::default();
        let ((values, fields), tint, roughness): (_, &'static [_], _) = match material {
            Material::Bumps => ((json!({}), &[][..]), &[], ""),
            Material::Carpet => {
                let diffuse = Vec3::new(0.24, 0.21, 0.19);
                let fake_rim_light_color = Vec3::splat(0.5);
                let carpet = CarpetParameters { diffuse, fake_rim_light_color, ..Default::default() };
                (of(carpet, CarpetParameters::FIELDS)?, &[("diffuse", 1.0)], "roughness")
            }
            Material::Paint | Material::Flakes => {
                let counted = PaintFlakes::Counted { spacing: 2e-4, bin: 0.12 };
                let flakes = if material == Material::Flakes { counted } else { paint.flakes };
                let paint = MetallicPaintParameters { flakes, ..paint };
                let fields = MetallicPaintParameters::FIELDS;
                (of(paint, fields)?, &[("specular", 1.0), ("pigment", 0.25)], "flake_roughness")
            }
            Material::Glass | Material::Frosted => {
                let (body, tint) = (GlassBody::Solid, Vec3::new(0.86, 0.95, 0.92));
                let glass = TemperedGlassParameters { body, tint, ..Default::default() };
                let frosted = TemperedGlassParameters {
                    roughness: 0.25,
                    wave_amplitude: 2e-3,
                    waves: GlassWaves::Noise,
                    ..glass
                };
                let glass = if material == Material::Frosted { frosted } else { glass };
                (of(glass, TemperedGlassParameters::FIELDS)?, &[("tint", 1.0)], "roughness")
            }
            Material::Plastic => {
                let (diffuse, gloss_roughness) = (Vec3::new(0.34, 0.12, 0.06), 0.2);
                let plastic = VariationsParameters { diffuse, gloss_roughness, ..Default::default() };
                (of(plastic, VariationsParameters::FIELDS)?, &[("diffuse", 1.0)], "gloss_roughness")
            }
            Material::Scratched => {
                let (specular, roughness) = (hex(0xc8_ccd2), 0.2);
                let metal = ScratchesParameters { specular, roughness, ..Default::default() };
                (of(metal, ScratchesParameters::FIELDS)?, &[("specular", 1.0)], "roughness")
            }
            Material::Chrome => {
                let values = json!({ "color": hex(0xe4_e6ea).to_array(), "roughness": 0.0 });
                ((values, CHROME), &[("color", 1.0)], "roughness")
            }
            Material::Brick => {
                let BrickWall { clay, mortar, variation, depth, roughness, .. } = BrickWall::default();
                let values = json!({
                    "width": 0.255, "height": 0.085, "mortar": 0.005, "clay": clay.to_array(), "mortar_color": mortar.to_array(),
                    "variation": variation, "depth": depth, "roughness": roughness,
                });
                ((values, BRICK), &[("clay", 1.0)], "roughness")
            }
            Material::Marble => {
                let values = json!({ "tint": [2.6, 2.6, 2.6], "veins": 2.5, "polish": 0.12, "seed": 0 });
                ((values, MARBLE), &[("tint", 2.6)], "polish")
            }
            Material::Wallpaper => {
                let values = json!({
                    "paper": hex(0x2c_3a5e).to_array(), "star": hex(0xe8_d9a8).to_array(), "points": 5, "r_min": 0.1,
                    "r_max": 0.3, "chance": 0.55, "roughness": 0.0, "seed": 1,
                });
                ((values, WALLPAPER), &[("paper", 1.0)], "roughness")
            }
        };
        Ok(Self { values, fields, tint, roughness })
    }

    /// Returns the parameters with the options of `render` applied.
    pub(crate) fn of(wanted: &Render, material: Material) -> Result<Self> {
        let Render { tint, roughness, seed, .. } = *wanted;
        Self::chosen(material, &Chosen { tint, roughness, seed, set: &wanted.set })
    }

    /// Returns the values by name.
    pub(crate) const fn values(&self) -> &Value {
        &self.values
    }

    /// Returns the parameters with the chosen values applied.
    pub(crate) fn chosen(material: Material, wanted: &Chosen<'_>) -> Result<Self> {
        let mut own = Self::usual(material)?;
        if own.values.get("seed").is_some() {
            own.values["seed"] = json!(wanted.seed);
        }
        for (rgb, (name, factor)) in
            wanted.tint.iter().flat_map(|&rgb| own.tint.iter().map(move |by| (rgb, by)))
        {
            own.values[*name] = json!((hex(rgb) * *factor).to_array());
        }
        if let Some(roughness) = wanted.roughness.filter(|_| !own.roughness.is_empty()) {
            own.values[own.roughness] = json!(roughness);
        }
        for (k, (name, text)) in wanted.set.iter().enumerate() {
            if wanted.set[..k].iter().any(|(other, _)| other == name) {
                return Err(format!("--set gives `{name}` twice").into());
            }
            let place = own.values.pointer_mut(&format!("/{}", name.replace('.', "/")));
            let Some(place) = place else {
                let names: Vec<_> = own.fields.iter().map(|field| field.0).collect();
                let there = if names.is_empty() { "none but its options".into() } else { names.join(", ") };
                return Err(format!("{material:?} has no parameter `{name}` (available: {there})")
                    .to_lowercase()
                    .into());
            };
            let new = value(text);
            if let Some(kind) = kind(place).filter(|_| kind(place) != kind(&new)) {
                return Err(format!("`{name}` must be {kind}, got `{text}`").into());
            }
            *place = new;
        }
        Ok(own)
    }

    /// Returns a line per parameter: name, value and description.
    pub(crate) fn lines(&self) -> impl Iterator<Item = String> {
        self.fields.iter().map(|(name, about)| {
            // Strip links and defaults, which are meant for the crate's documentation.
            let about = about.split(" Default").next().unwrap_or(about);
            let (text, links) = about.split_once("](").unwrap_or((about, ""));
            let behind = links.split("](").map(|link| link.split_once(')').map_or("", |link| link.1));
            let about: Vec<_> = std::iter::once(text).chain(behind).collect();
            let about = about.concat().replace("[`", "").replace("`]", "").replace('`', "");
            format!("  {name} = {}\n     {}", shown(&self.values[*name]), about.trim())
        })
    }

    /// Builds the material, with the size of a scene unit in meters. `projected` maps patterns onto
    /// objects without texture coordinates.
    pub(crate) fn make(self, material: Material, metres: f32, projected: bool) -> Result<Made<'static>> {
        fn read<P: DeserializeOwned>(values: &Value) -> Result<P> {
            serde_json::from_value(values.clone()).map_err(|error| format!("parameter: {error}").into())
        }
        fn laid<'a>(
            material: impl asperity_shading::Material + Sync + 'a,
            metres: f32,
            projected: bool,
        ) -> Box<Surface<'a>> {
            if projected {
                Box::new(Projected(InMetres(material, metres)))
            } else {
                Box::new(InMetres(material, metres))
            }
        }
        let values = &self.values;
        let number = |name: &str| read::<f32>(&values[name]).map_err(|error| format!("`{name}`: {error}"));
        let color = |name: &str| {
            read::<[f32; 3]>(&values[name]).map(Vec3::from).map_err(|error| format!("`{name}`: {error}"))
        };
        let seed = || read::<u32>(&values["seed"]);
        let mut body = None;
        let surface = match material {
            Material::Bumps => return Err("the `bumps` material has no parameters to set by name".into()),
            Material::Carpet => laid(Carpet::new(read(values)?)?, metres, projected),
            Material::Paint | Material::Flakes => laid(MetallicPaint::new(read(values)?)?, metres, false),
            Material::Glass | Material::Frosted => {
                let parameters: TemperedGlassParameters = read(values)?;
                if parameters.body == GlassBody::Solid {
                    body = Some(Absorption::of_color(parameters.tint, 1.0)?);
                }
                laid(TemperedGlass::new(parameters)?, metres, false)
            }
            Material::Plastic => laid(Variations::new(read(values)?)?, metres, false),
            Material::Scratched => laid(Scratches::new(read(values)?)?, metres, projected),
            Material::Chrome => Box::new(Coat::conductor(color("color")?).rough(number("roughness")?)),
            Material::Brick => {
                let bricks = Brick::new(number("width")?, number("height")?, number("mortar")?)?;
                let (clay, mortar) = (color("clay")?, color("mortar_color")?);
                let [variation, depth, roughness] =
                    [number("variation")?, number("depth")?, number("roughness")?];
                laid(BrickWall { bricks, clay, mortar, variation, depth, roughness }, metres, projected)
            }
            Material::Marble => {
                let marble = Marble::new(Perlin::default(), number("veins")?, seed()?)?;
                laid(
                    PolishedMarble { marble, tint: color("tint")?, polish: number("polish")? },
                    metres / 0.2,
                    false,
                )
            }
            Material::Wallpaper => {
                let stars = StarWallpaper::new(StarWallpaperParameters {
                    points: read(&values["points"])?,
                    r_min: number("r_min")?,
                    r_max: number("r_max")?,
                    cells: 1.0,
                    chance: number("chance")?,
                    seed: seed()?,
                })?;
                let (paper, star) = (color("paper")?, color("star")?);
                laid(
                    Wallpaper { stars, paper, star, roughness: number("roughness")? },
                    metres / 0.1,
                    projected,
                )
            }
        };
        Ok(Made { surface, body })
    }
}

const CHROME: Fields = &[
    ("color", "Reflectance at normal incidence."),
    ("roughness", "Roughness: Beckmann's α, within [0, 1]."),
];
const BRICK: Fields = &[
    ("width", "Width of a brick in meters."),
    ("height", "Height of a brick in meters."),
    ("mortar", "Thickness of the mortar between bricks in meters."),
    ("clay", "Color of the bricks."),
    ("mortar_color", "Color of the mortar."),
    ("variation", "Relative variation of brightness between bricks."),
    ("depth", "Depth of the mortar."),
    ("roughness", "Roughness of the facets, within [0, 1]."),
];
const MARBLE: Fields = &[
    ("tint", "Factor for the colors of the lecture."),
    ("veins", "Cells of the first octave of veins per 0.2 meters."),
    ("polish", "Roughness of the polish: Beckmann's α; 0 is unpolished stone."),
    ("seed", "Random seed."),
];
const WALLPAPER: Fields = &[
    ("paper", "Color of the paper."),
    ("star", "Color of the stars."),
    ("points", "Number of points of a star."),
    ("r_min", "Minimum radius of a star, in cells of 0.1 meters."),
    ("r_max", "Maximum radius of a star, in cells of 0.1 meters."),
    ("chance", "Fraction of cells with a star."),
    ("roughness", "Roughness of the facets, within [0, 1]."),
    ("seed", "Random seed."),
];

/// Formats a value as [`value`] parses it.
fn shown(value: &Value) -> String {
    match value {
        Value::Number(number) if number.is_f64() => (number.as_f64().unwrap_or_default() as f32).to_string(),
        Value::Array(all) => all.iter().map(shown).collect::<Vec<_>>().join(","),
        Value::Object(fields) => {
            let field = |(name, value): (&String, &Value)| format!("{name}.{}", shown(value));
            fields.iter().map(field).collect::<Vec<_>>().join(" ")
        }
        Value::String(word) => word.clone(),
        other => other.to_string(),
    }
}

/// The kind of a parameter that a number, a list or a word sets.
fn kind(value: &Value) -> Option<&'static str> {
    match value {
        Value::Number(_) => Some("a number"),
        Value::Array(_) => Some("a list of numbers"),
        Value::String(_) => Some("a word"),
        _ => None,
    }
}

/// Parses a parameter value: a number, a word, a list `0.2,0.1,0.4`, or a color `#d9a066`.
fn value(text: &str) -> Value {
    let rgb = text.strip_prefix('#').filter(|digits| digits.len() == 6);
    if let Some(rgb) = rgb.and_then(|digits| u32::from_str_radix(digits, 16).ok()) {
        return json!(hex(rgb).to_array());
    }
    let list = format!("[{text}]");
    let parsed = serde_json::from_str(text).ok();
    parsed.or_else(|| serde_json::from_str(&list).ok()).unwrap_or_else(|| json!(text))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use clap::ValueEnum;

    use super::*;

    #[test]
    fn lines_list_every_parameter_with_a_valid_value() {
        for &material in Material::value_variants() {
            let own = Parameters::usual(material).unwrap();
            let fields = own.values.as_object().unwrap();
            let there: BTreeSet<&str> = fields.keys().map(String::as_str).collect();
            assert_eq!(there, own.fields.iter().map(|field| field.0).collect(), "{material:?}");
            for (name, about) in own.fields {
                assert!(!about.trim().is_empty(), "{material:?} {name}");
                let text = shown(&own.values[*name]);
                if !own.values[*name].is_object() {
                    assert_eq!(shown(&value(&text)), text, "{material:?} {name}");
                }
            }
            for line in own.lines() {
                assert!(!line.contains("crate::") && !line.contains('`'), "{line}");
            }
            if material != Material::Bumps {
                assert!(own.make(material, 1.0, true).is_ok(), "{material:?}");
            }
        }
    }

    #[test]
    fn value_parses_words_lists_and_colors() {
        assert_eq!(value("0.25"), json!(0.25));
        assert_eq!(value("grid"), json!("grid"));
        assert_eq!(value("1, 0.5,0"), json!([1, 0.5, 0]));
        assert_eq!(value("#ffffff"), json!([1.0, 1.0, 1.0]));
        assert_eq!(value("#fffff"), json!("#fffff"));
    }
}
