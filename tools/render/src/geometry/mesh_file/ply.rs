//! PLY: text and both binary encodings.
//!
//! Format: Turk 1994, "The PLY Polygon File Format".

use std::collections::HashMap;

use glam::{DVec3, Vec2};

use crate::geometry::mesh_file::{
    error::MeshFileError,
    polygon::strip,
    triangle_soup::{Corner, TriangleSoup},
};
use crate::input_file::{number, utf8};

/// Reads the element `vertex` with `x`, `y`, `z`, and optional normals and texture coordinates.
/// Faces come from the element `face` with a list of corners and an optional list `texcoord`, or
/// from `tristrips` with strips terminated by −1. Other elements are skipped.
pub(super) fn parse(bytes: &[u8]) -> Result<TriangleSoup, MeshFileError> {
    let bytes = utf8(bytes);
    let (encoding, elements, rest) = header(&bytes)?;
    let element = |name| elements.iter().find(|element| element.name == name);
    let vertices = element("vertex").ok_or(MeshFileError::Lacks { what: "element `vertex`" })?;
    let faces = ["face", "tristrips"].map(element).into_iter().flatten();
    let faces = faces
        .max_by_key(|element| element.count > 0)
        .ok_or(MeshFileError::Lacks { what: "element `face`" })?;
    for (names, what) in PLACES {
        vertices.scalar(names).ok_or(MeshFileError::Lacks { what })?;
    }
    let of_corners = faces.list(&["vertex_indices", "vertex_index"]);
    let of_corners = of_corners.ok_or(MeshFileError::Lacks { what: "property `vertex_indices`" })?;
    let per_corner = faces.list(&["texcoord", "texcoords"]);
    let body = Body { elements: &elements, vertices, faces, of_corners, per_corner };
    if !matches!(encoding, Encoding::Text) {
        return body.read(encoding, rest);
    }
    // With one line per row, extra columns at the end are harmless. Rows may also be wrapped.
    let lines = rest.split(|byte| matches!(byte, b'\n' | b'\r')).filter(|line| !line.trim_ascii().is_empty());
    let rows = elements.iter().map(|element| element.count).fold(0, usize::saturating_add);
    let lines = lines.count();
    if lines < rows && lines > 1 {
        body.elements.iter().try_for_each(|element| element.check_count(rest.len()))?;
        return Err(broken(format!("header claims {rows} rows, but there are {lines} lines")));
    }
    let by_lines = || body.read(Encoding::Lines, rest);
    if lines == rows {
        by_lines()
    } else {
        body.read(Encoding::Text, rest).or_else(|error| by_lines().map_err(|_| error))
    }
}

/// The elements after the header, and the elements that are read.
struct Body<'a> {
    elements: &'a [Element],
    vertices: &'a Element,
    faces: &'a Element,
    /// The positions of the lists of a face.
    of_corners: usize,
    per_corner: Option<usize>,
}

impl Body<'_> {
    fn read(&self, encoding: Encoding, mut rest: &[u8]) -> Result<TriangleSoup, MeshFileError> {
        let &Self { elements, vertices, faces, of_corners, per_corner } = self;
        let mut soup = TriangleSoup::default();
        let (mut polygons, mut wedges) = (Vec::new(), Vec::new());
        for element in elements {
            element.check_count(rest.len())?;
            if std::ptr::eq(element, vertices) {
                soup.corners = corners(element, encoding, &mut rest)?;
                continue;
            }
            for row in 0..element.count {
                let (mut polygon, mut wedge) = (Vec::new(), Vec::new());
                element.row(row, encoding, &mut rest, |k, values| {
                    if std::ptr::eq(element, faces) && k == of_corners {
                        polygon = values.to_vec();
                    } else if std::ptr::eq(element, faces) && Some(k) == per_corner {
                        wedge = values.to_vec();
                    }
                })?;
                if std::ptr::eq(element, faces) {
                    let strips = faces.name == "tristrips";
                    let corners = polygon.into_iter().map(|corner| index(corner, strips));
                    polygons.push(corners.collect::<Result<Vec<u32>, _>>()?);
                    wedges.push(wedge);
                }
            }
        }
        if faces.name == "tristrips" {
            for strip_corners in polygons.iter().flat_map(|all| all.split(|&corner| corner == END)) {
                strip(strip_corners).into_iter().try_for_each(|triangle| soup.push(triangle))?;
            }
            return Ok(soup);
        }
        let mut known = HashMap::new();
        for (mut polygon, wedge) in polygons.into_iter().zip(wedges) {
            if wedge.len() == 2 * polygon.len() {
                for (corner, &[u, v]) in polygon.iter_mut().zip(wedge.as_chunks().0) {
                    *corner = with_uv(&mut soup, &mut known, *corner, Vec2::new(u as f32, v as f32))?;
                }
            }
            soup.push_polygon(&polygon)?;
        }
        Ok(soup)
    }
}

/// Names of coordinates.
const PLACES: [(&[&str], &str); 3] = [
    (&["x", "px", "posx"], "property `x`"),
    (&["y", "py", "posy"], "property `y`"),
    (&["z", "pz", "posz"], "property `z`"),
];

/// Terminator of a strip.
const END: u32 = u32::MAX;

/// Converts a number to an index; −1 terminates a strip.
fn index(value: f64, strips: bool) -> Result<u32, MeshFileError> {
    if strips && value == -1.0 {
        return Ok(END);
    }
    let whole = value >= 0.0 && value < f64::from(END) && value.fract() == 0.0;
    whole
        .then_some(value as u32)
        .ok_or_else(|| broken(format!("a face has the invalid vertex index {value}")))
}

/// Returns the vertex with these texture coordinates. A vertex may have different ones in each
/// face.
fn with_uv(
    soup: &mut TriangleSoup,
    known: &mut HashMap<(u32, [u32; 2]), u32>,
    vertex: u32,
    uv: Vec2,
) -> Result<u32, MeshFileError> {
    let corner = *soup.corner(vertex)?;
    Ok(*known.entry((vertex, uv.to_array().map(f32::to_bits))).or_insert_with(|| {
        soup.corners.push(Corner { uv, ..corner });
        soup.corners.len() as u32 - 1
    }))
}

fn corners(element: &Element, encoding: Encoding, rest: &mut &[u8]) -> Result<Vec<Corner>, MeshFileError> {
    const NAMES: [&[&str]; 8] = [
        PLACES[0].0,
        PLACES[1].0,
        PLACES[2].0,
        &["nx", "normalx"],
        &["ny", "normaly"],
        &["nz", "normalz"],
        &["u", "s", "tx", "texture_u", "texture_s", "texcoord_u", "texcoord_x", "s0", "u0"],
        &["v", "t", "ty", "texture_v", "texture_t", "texcoord_v", "texcoord_y", "t0", "v0"],
    ];
    let mut place_of = vec![None; element.properties.len()];
    for (place, names) in NAMES.iter().enumerate() {
        if let Some(k) = element.scalar(names) {
            place_of[k] = Some(place);
        }
    }
    let mut corners = Vec::new();
    for row in 0..element.count {
        let mut values = [0.0; 8];
        element.row(row, encoding, rest, |k, read| {
            if let (Some(place), &[value]) = (place_of[k], read) {
                values[place] = value;
            }
        })?;
        let [x, y, z, nx, ny, nz, u, v] = values;
        corners.push(Corner {
            position: DVec3::new(x, y, z),
            normal: DVec3::new(nx, ny, nz).as_vec3(),
            uv: Vec2::new(u as f32, v as f32),
        });
    }
    Ok(corners)
}

#[derive(Clone, Copy)]
enum Encoding {
    Text,
    /// Text with one line per row.
    Lines,
    LittleEndian,
    BigEndian,
}

/// Number types.
#[derive(Clone, Copy)]
enum Type {
    Signed(usize),
    Unsigned(usize),
    Float,
    Double,
}

impl Type {
    fn of(name: &str) -> Result<Self, MeshFileError> {
        Ok(match name {
            "char" | "int8" => Self::Signed(1),
            "uchar" | "uint8" => Self::Unsigned(1),
            "short" | "int16" => Self::Signed(2),
            "ushort" | "uint16" => Self::Unsigned(2),
            "int" | "int32" => Self::Signed(4),
            "uint" | "uint32" => Self::Unsigned(4),
            "int64" => Self::Signed(8),
            "uint64" => Self::Unsigned(8),
            "float" | "float32" => Self::Float,
            "double" | "float64" => Self::Double,
            _ => return Err(broken(format!("unknown type `{name}` in the header"))),
        })
    }

    const fn size(self) -> usize {
        match self {
            Self::Signed(size) | Self::Unsigned(size) => size,
            Self::Float => 4,
            Self::Double => 8,
        }
    }

    /// Parses a number from the front of the body.
    fn take(self, encoding: Encoding, rest: &mut &[u8]) -> Option<f64> {
        if matches!(encoding, Encoding::Text | Encoding::Lines) {
            *rest = rest.trim_ascii_start();
            let end = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
            let (word, behind) = rest.split_at(end);
            *rest = behind;
            return number(std::str::from_utf8(word).ok()?);
        }
        let (bytes, behind) = rest.split_at_checked(self.size())?;
        *rest = behind;
        let join = |bits: u64, &byte: &u8| bits << 8 | u64::from(byte);
        let bits = match encoding {
            Encoding::BigEndian => bytes.iter().fold(0, join),
            _ => bytes.iter().rev().fold(0, join),
        };
        let unused = 64 - 8 * self.size() as u32;
        Some(match self {
            Self::Signed(_) => ((bits << unused).cast_signed() >> unused) as f64,
            Self::Unsigned(_) => bits as f64,
            Self::Float => f32::from_bits(bits as u32).into(),
            Self::Double => f64::from_bits(bits),
        })
    }
}

struct Property {
    name: String,
    /// The type of the count, for a list.
    count: Option<Type>,
    of: Type,
}

struct Element {
    name: String,
    count: usize,
    properties: Vec<Property>,
}

impl Element {
    fn find(&self, list: bool, names: &[&str]) -> Option<usize> {
        self.properties.iter().position(|p| names.contains(&&*p.name) && p.count.is_some() == list)
    }

    /// Returns the position of the first scalar property with one of these names.
    fn scalar(&self, names: &[&str]) -> Option<usize> {
        self.find(false, names)
    }

    /// Returns the position of the first list property with one of these names.
    fn list(&self, names: &[&str]) -> Option<usize> {
        self.find(true, names)
    }

    /// Returns an error for a count that the remaining bytes cannot hold: each property takes at
    /// least one byte.
    fn check_count(&self, left: usize) -> Result<(), MeshFileError> {
        if self.count.saturating_mul(self.properties.len().max(1)) > left {
            let element = self.name.chars().take(40).collect();
            return Err(MeshFileError::PlyTruncated { element, count: self.count, bytes: left });
        }
        Ok(())
    }

    /// Parses a row, and passes on the numbers of each property.
    fn row(
        &self,
        row: usize,
        encoding: Encoding,
        rest: &mut &[u8],
        mut to: impl FnMut(usize, &[f64]),
    ) -> Result<(), MeshFileError> {
        let mut values = Vec::new();
        for (k, property) in self.properties.iter().enumerate() {
            let ends = || {
                let (row, element, property) = (row + 1, &self.name, &property.name);
                broken(format!("`{property}` of `{element}` {row} of {} is missing", self.count))
            };
            values.clear();
            let count = match property.count {
                None => 1.0,
                Some(count) => count.take(encoding, rest).ok_or_else(ends)?,
            };
            // At least a byte each.
            if !(0.0..=rest.len() as f64).contains(&count) {
                return Err(ends());
            }
            for _ in 0..count as usize {
                values.push(property.of.take(encoding, rest).ok_or_else(ends)?);
            }
            to(k, &values);
        }
        if matches!(encoding, Encoding::Lines) {
            let end = rest.iter().position(|byte| matches!(byte, b'\n' | b'\r')).unwrap_or(rest.len());
            *rest = &rest[end..];
        }
        Ok(())
    }
}

/// Returns the encoding, the elements, and the bytes after the header. Lines outside the format are
/// ignored like comments.
fn header(bytes: &[u8]) -> Result<(Encoding, Vec<Element>, &[u8]), MeshFileError> {
    let mut rest = bytes.strip_prefix(b"ply").ok_or_else(|| broken("file does not begin with `ply`"))?;
    let (mut encoding, mut elements) = (None, Vec::<Element>::new());
    loop {
        let length = rest.iter().position(|byte| matches!(byte, b'\n' | b'\r'));
        let length = length.ok_or_else(|| broken("header has no line `end_header`"))?;
        let line = String::from_utf8_lossy(&rest[..length]).into_owned();
        rest = rest[length..].strip_prefix(b"\r\n").unwrap_or(&rest[length + 1..]);
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            ["format", name, ..] => {
                encoding = Some(match name {
                    "ascii" => Encoding::Text,
                    "binary_little_endian" => Encoding::LittleEndian,
                    "binary_big_endian" => Encoding::BigEndian,
                    _ => return Err(broken(format!("unknown format `{name}`"))),
                });
            }
            ["element", name, count] => {
                let count = count
                    .parse()
                    .map_err(|_| broken(format!("invalid number of rows `{count}` of `{name}`")))?;
                elements.push(Element { name: name.into(), count, properties: Vec::new() });
            }
            ["property", "list", count, of, name] => {
                let of = Property { name: name.into(), count: Some(Type::of(count)?), of: Type::of(of)? };
                elements.last_mut().ok_or_else(|| out_of_place(name))?.properties.push(of);
            }
            ["property", of, name] => {
                let of = Property { name: name.into(), count: None, of: Type::of(of)? };
                elements.last_mut().ok_or_else(|| out_of_place(name))?.properties.push(of);
            }
            ["element" | "property" | "format", ..] => {
                return Err(broken(format!("invalid header line `{}`", line.trim())));
            }
            ["end_header", ..] => break,
            _ => {}
        }
    }
    Ok((encoding.ok_or_else(|| broken("header has no line `format`"))?, elements, rest))
}

fn out_of_place(name: &str) -> MeshFileError {
    broken(format!("property `{name}` precedes every element"))
}

fn broken(error: impl Into<String>) -> MeshFileError {
    MeshFileError::broken("PLY", error.into())
}
