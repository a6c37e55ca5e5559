//! PLY, by `ply-rs-bw`: text and both binary kinds.

use std::io::Cursor;

use gltf::mesh::Mode;
use ply_rs_bw::{
    parser::{ParseError, Parser, Reader},
    ply::{DefaultElement, Property, PropertyAccess, PropertyAccessResult},
};

use crate::geometry::mesh_file::{
    error::MeshFileError,
    glb::triangles,
    triangle_soup::{Corner, TriangleSoup},
};

/// The element `vertex` with `x`, `y`, `z`, perhaps `nx`, `ny`, `nz` and texture coordinates under one of the usual
/// names, and the element `face` with a list of corners, or `tristrips` with lists of strips that −1 ends. All others are passed
/// over.
pub(super) fn parse(bytes: &[u8]) -> Result<TriangleSoup, MeshFileError> {
    let broken = |error: ParseError| {
        // The library's words, without its parser's state behind them.
        let said = error.to_string();
        MeshFileError::broken("PLY", said.split(" Error: ").next().unwrap_or(&said))
    };
    let mut reader = Reader::new(Cursor::new(bytes));
    let header = Parser::<DefaultElement>::new().read_header(&mut reader).map_err(broken)?;
    let element = |name, what| header.elements.get(name).ok_or(MeshFileError::Lacks { what });
    let vertex = element("vertex", "element `vertex`")?;
    let strips = !header.elements.contains_key("face") && header.elements.contains_key(STRIPS);
    let faces_name = if strips { STRIPS } else { "face" };
    let face = element(faces_name, "element `face`")?;
    for (name, what) in [("x", "property `x`"), ("y", "property `y`"), ("z", "property `z`")] {
        vertex.properties.get(name).ok_or(MeshFileError::Lacks { what })?;
    }
    if !CORNERS.iter().any(|&name| face.properties.contains_key(name)) {
        return Err(MeshFileError::Lacks { what: "property `vertex_indices`" });
    }
    let mut soup = TriangleSoup::default();
    let mut faces: Vec<Face> = Vec::new();
    for (name, element) in &header.elements {
        let left = bytes.len().saturating_sub(reader.get_ref().position() as usize);
        // Each property takes a byte at least, and an element without any would never come to an end.
        if element.count.saturating_mul(element.properties.len().max(1)) > left {
            let (element, count) = (name.chars().take(40).collect(), element.count);
            return Err(MeshFileError::PlyTruncated { element, count, bytes: left });
        }
        if name == "vertex" {
            soup.corners =
                Parser::new().read_payload_for_element(&mut reader, element, &header).map_err(broken)?;
        } else {
            let read =
                Parser::new().read_payload_for_element(&mut reader, element, &header).map_err(broken)?;
            if name == faces_name {
                faces = read;
            }
        }
    }
    if !strips {
        faces.iter().try_for_each(|Face(corners)| soup.push_polygon(corners))?;
        return Ok(soup);
    }
    for strip in faces.iter().flat_map(|Face(corners)| corners.split(|&corner| corner == u32::MAX)) {
        for triangle in triangles(Mode::TriangleStrip, strip)? {
            soup.push(triangle)?;
        }
    }
    Ok(soup)
}

/// The element of triangle strips.
const STRIPS: &str = "tristrips";

const CORNERS: [&str; 2] = ["vertex_indices", "vertex_index"];

impl PropertyAccess for Corner {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let value = match property {
            Property::Double(value) => Some(value),
            other => other.to_f32_lossy().map(f64::from),
        };
        let Some(value) = value else { return PropertyAccessResult::Ignored };
        match name {
            "x" => self.position.x = value,
            "y" => self.position.y = value,
            "z" => self.position.z = value,
            "nx" => self.normal.x = value as f32,
            "ny" => self.normal.y = value as f32,
            "nz" => self.normal.z = value as f32,
            "u" | "s" | "texture_u" => self.uv.x = value as f32,
            "v" | "t" | "texture_v" => self.uv.y = value as f32,
            _ => return PropertyAccessResult::Ignored,
        }
        PropertyAccessResult::Set
    }
}

/// Corners of a face; an element that nothing is taken from has none.
struct Face(Vec<u32>);

impl PropertyAccess for Face {
    fn new() -> Self {
        Self(Vec::new())
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        if !CORNERS.contains(&name) {
            return PropertyAccessResult::Ignored;
        }
        let strips = || {
            // The end of a strip is the greatest number; nothing else is below 0.
            let Property::ListInt(corners) = &property else { return None };
            corners
                .iter()
                .all(|&corner| corner >= -1)
                .then(|| corners.iter().map(|&corner| corner as u32).collect())
        };
        match property.to_u32_list().or_else(strips) {
            Some(corners) => {
                self.0 = corners;
                PropertyAccessResult::Set
            }
            // Numbers with a fraction, or below 0.
            None => PropertyAccessResult::UnsupportedType,
        }
    }
}
