//! A MaterialX document of the material, for renderers and painting tools.

use asperity_render::image::tone::linear;

use crate::bake::maps::Map;
use crate::bake::set::{MapLevels, Set};
use crate::cli::bake::BakedFormat as Format;
use crate::failure::Result;
use crate::output::Output;

/// Writes `material.mtlx`, which references the PNG files if there are any, and the OpenEXR files
/// otherwise.
pub(super) fn write(set: &Set<'_>, output: &Output) -> Result<()> {
    let Some(format) = [Format::Png, Format::Exr].into_iter().find(|format| set.formats.contains(format))
    else {
        return Ok(());
    };
    Ok(output.write("material.mtlx", document(set, format)?.as_bytes())?)
}

fn document(set: &Set<'_>, format: Format) -> Result<String> {
    let (mut nodes, mut inputs, mut relief) = (String::new(), String::new(), "");
    let address = if set.plan.tileable { "periodic" } else { "clamp" };
    let mut image = |map: &MapLevels<'_>, kind: &str| {
        let (name, file) = (map.map.name(), map.file(format));
        let space = match (map.map, format) {
            (Map::BaseColor, Format::Png) => " colorspace=\"srgb_texture\"",
            (Map::BaseColor, _) => " colorspace=\"lin_rec709\"",
            _ => "",
        };
        nodes.push_str(&format!(
            "  <image name=\"{name}_image\" type=\"{kind}\">\n    <input name=\"file\" type=\"filename\" value=\"{file}\"{space}/>\n"
        ));
        for axis in ["u", "v"] {
            let field = format!("{axis}addressmode");
            nodes.push_str(&format!("    <input name=\"{field}\" type=\"string\" value=\"{address}\"/>\n"));
        }
        nodes.push_str("  </image>\n");
    };
    for map in set.maps() {
        let (name, kind, input) = match map.map {
            Map::BaseColor => ("base_color", "color3", "base_color"),
            Map::NormalOpenGl => ("normal_opengl", "vector3", "normal"),
            Map::Roughness => ("roughness", "float", "roughness"),
            Map::Metallic => ("metallic", "float", "metallic"),
            Map::Occlusion => ("ambient_occlusion", "float", "occlusion"),
            Map::Height => ("height", "float", ""),
            Map::NormalDirectX | Map::Packed => continue,
        };
        if !map.differs() {
            let unit = map.uniform()?.into_iter().map(|word| f32::from(word) / 65_535.0);
            let value: Vec<String> =
                unit.map(|x| if map.map == Map::BaseColor { linear(x) } else { x }.to_string()).collect();
            let value = value.join(", ");
            inputs.push_str(&format!("    <input name=\"{input}\" type=\"{kind}\" value=\"{value}\"/>\n"));
            continue;
        }
        image(&map, kind);
        let from = match map.map {
            Map::NormalOpenGl => "tangent_normal".into(),
            _ => format!("{name}_image"),
        };
        if !input.is_empty() {
            inputs.push_str(&format!("    <input name=\"{input}\" type=\"{kind}\" nodename=\"{from}\"/>\n"));
        }
    }
    if let Some(alpha) = set.plan.source.coat() {
        let fields = [("clearcoat", 1.0), ("clearcoat_roughness", alpha.max(0.0).sqrt())];
        for (input, value) in fields {
            inputs.push_str(&format!("    <input name=\"{input}\" type=\"float\" value=\"{value}\"/>\n"));
        }
    }
    nodes.push_str(
        "  <normalmap name=\"tangent_normal\" type=\"vector3\">\n    <input name=\"in\" type=\"vector3\" \
         nodename=\"normal_opengl_image\"/>\n  </normalmap>\n",
    );
    if set.plan.source.varies().height {
        // PNG: from a fraction of the range to units of the side. OpenEXR: already in units of the
        // side.
        let [low, high] = if format == Format::Png { set.levels.tops.range } else { [0.0, 1.0] };
        nodes.push_str(&format!(
            "  <multiply name=\"height_scaled\" type=\"float\">\n    <input name=\"in1\" type=\"float\" \
             nodename=\"height_image\"/>\n    <input name=\"in2\" type=\"float\" value=\"{}\"/>\n  </multiply>\n  <add \
             name=\"height_in_sides\" type=\"float\">\n    <input name=\"in1\" type=\"float\" nodename=\"height_scaled\"/>\n    \
             <input name=\"in2\" type=\"float\" value=\"{low}\"/>\n  </add>\n  <displacement name=\"relief\" \
             type=\"displacementshader\">\n    <input name=\"displacement\" type=\"float\" nodename=\"height_in_sides\"/>\n  \
             </displacement>\n",
            high - low
        ));
        relief = "    <input name=\"displacementshader\" type=\"displacementshader\" nodename=\"relief\"/>\n";
    }
    Ok(format!(
        "<?xml version=\"1.0\"?>\n<materialx version=\"1.38\" colorspace=\"lin_rec709\">\n{nodes}  <gltf_pbr name=\"surface\" \
         type=\"surfaceshader\">\n{inputs}  </gltf_pbr>\n  <surfacematerial name=\"baked\" type=\"material\">\n    <input \
         name=\"surfaceshader\" type=\"surfaceshader\" nodename=\"surface\"/>\n{relief}  </surfacematerial>\n</materialx>\n"
    ))
}
