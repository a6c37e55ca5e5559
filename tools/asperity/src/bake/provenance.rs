//! The provenance record of a set: parameters, maps and measurements.

use serde_json::{Value, json};

use crate::bake::maps::Map;
use crate::bake::set::Set;
use crate::failure::Result;
use crate::output::Output;

type Fields = serde_json::Map<String, Value>;

/// Writes `provenance.json`.
pub(super) fn write(set: &Set<'_>, output: &Output) -> Result<()> {
    let text = serde_json::to_vec_pretty(&document(set))?;
    Ok(output.write("provenance.json", &text)?)
}

fn document(set: &Set<'_>) -> Value {
    let maps: Fields = set
        .maps()
        .iter()
        .map(|map| {
            let files: Vec<_> = set.formats.iter().map(|format| map.file(*format)).collect();
            let about = json!({ "files": files, "size": map.side(0), "uniform": !map.differs(), "meaning": meaning(map.map) });
            (map.map.name().to_owned(), about)
        })
        .collect();
    let mut record = json!({
        "program": concat!("asperity ", env!("CARGO_PKG_VERSION"), ", asperity bake"),
        "surface": set.plan.describe(),
        "maps": maps,
        "levels": "means of 2 × 2 texels; roughness includes the variance of slopes that a level does not resolve",
    });
    if set.plan.source.varies().height {
        record["height_range_in_sides"] = json!(set.levels.tops.range);
    }
    if let Some(alpha) = set.plan.source.coat() {
        record["clear_coat_alpha"] = json!(alpha);
    }
    if set.plan.tileable {
        let [value, slope] = set.plan.seam();
        record["difference_across_edges"] = json!({ "value": value, "slope": slope });
    }
    record
}

/// Returns the meaning of a map's numbers.
const fn meaning(map: Map) -> &'static str {
    match map {
        Map::BaseColor => "base color, sRGB; linear in OpenEXR",
        Map::NormalOpenGl => "tangent-space normal, (n + 1)/2, green up the image",
        Map::NormalDirectX => "tangent-space normal, (n + 1)/2, green down the image",
        Map::Height => "height: 0 lowest, 1 highest; in units of the side in OpenEXR",
        Map::Roughness => "roughness r = √α of a GGX lobe",
        Map::Metallic => "metallic",
        Map::Occlusion => "fraction of uniform sky light within the occlusion reach",
        Map::Packed => "red: occlusion, green: roughness, blue: metallic",
    }
}
