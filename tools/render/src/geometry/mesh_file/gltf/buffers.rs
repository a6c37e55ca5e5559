//! The data of a glTF's accessors.

use std::{
    cell::Cell,
    path::{Component, Path},
};

use base64::{
    Engine,
    alphabet::STANDARD,
    engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig},
};

use crate::{
    geometry::mesh_file::{
        error::{MOST_BYTES, MeshFileError},
        gltf::document::{Accessor, BufferView, Document, item, shown},
    },
    input_file,
};

/// A document with its buffers.
pub(super) struct Gltf {
    pub(super) document: Document,
    buffers: Vec<Vec<u8>>,
    /// Bytes of the document and its buffers. No accessor may have more items than this, even if
    /// all are zero.
    bytes: usize,
    /// Bytes that may still be read. Any number of primitives may refer to the same accessor.
    left: Cell<usize>,
}

const BYTE: u32 = 5120;
const UNSIGNED_BYTE: u32 = 5121;
const SHORT: u32 = 5122;
const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_INT: u32 = 5125;
const FLOAT: u32 = 5126;

/// Returns the bytes per component.
const fn size(component_type: u32) -> Option<usize> {
    match component_type {
        BYTE | UNSIGNED_BYTE => Some(1),
        SHORT | UNSIGNED_SHORT => Some(2),
        UNSIGNED_INT | FLOAT => Some(4),
        _ => None,
    }
}

impl Gltf {
    /// Reads a document, with or without a binary container, and its buffers.
    pub(super) fn read(bytes: &[u8], folder: &Path) -> Result<Self, MeshFileError> {
        let (json, mut bin) = match bytes {
            [b'g', b'l', b'T', b'F', ..] => container(bytes)?,
            _ => (bytes, None),
        };
        let json = input_file::utf8(json);
        let end = json.iter().rposition(|byte| !matches!(byte, 0 | b' ' | b'\t' | b'\r' | b'\n'));
        let json = &json[..end.map_or(0, |end| end + 1)];
        if !json.trim_ascii_start().starts_with(b"{") {
            return Err(MeshFileError::broken("glTF", "neither JSON nor a binary container"));
        }
        let document = Document::parse(json)?;
        let (mut buffers, mut all) = (Vec::new(), bytes.len());
        for buffer in &document.buffers {
            let buffer = match &buffer.uri {
                None => bin.take().map(<[u8]>::to_vec).unwrap_or_default(),
                Some(uri) => fetched("buffer", uri, folder)?,
            };
            all += buffer.len();
            if all as u64 > MOST_BYTES {
                return Err(MeshFileError::BuffersTooLong);
            }
            buffers.push(buffer);
        }
        Ok(Self { document, buffers, bytes: all, left: Cell::new(MOST_BYTES as usize) })
    }

    /// Returns the number of bytes of the document and its buffers.
    pub(super) const fn bytes(&self) -> usize {
        self.bytes
    }

    /// Returns vectors of `N` numbers. Normalized integers are converted to fractions.
    pub(super) fn floats<const N: usize>(&self, index: usize) -> Result<Vec<[f32; N]>, MeshFileError> {
        let (dimensions, wanted) = match N {
            2 => ("VEC2", "vectors of two numbers"),
            3 => ("VEC3", "vectors of three numbers"),
            4 => ("VEC4", "vectors of four numbers"),
            _ => ("MAT4", "matrices of four columns"),
        };
        let accessor = item(&self.document.accessors, "accessor", index)?;
        let of = size(accessor.component_type).filter(|_| accessor.dimensions == dimensions);
        let size = of.ok_or(MeshFileError::Accessor { accessor: index, wanted })?;
        let items = self.items(index, accessor, N * size)?;
        let read = |bytes: &[u8]| component(accessor, number(bytes));
        let vector = |bytes: &[u8]| {
            let mut vector = [0.0; N];
            vector.iter_mut().zip(bytes.chunks_exact(size)).for_each(|(to, bytes)| *to = read(bytes));
            vector
        };
        Ok(items.chunks_exact(N * size).map(vector).collect())
    }

    pub(super) fn indices(&self, index: usize) -> Result<Vec<u32>, MeshFileError> {
        let accessor = item(&self.document.accessors, "accessor", index)?;
        let kinds = [UNSIGNED_BYTE, UNSIGNED_SHORT, UNSIGNED_INT];
        let unsigned = accessor.dimensions == "SCALAR" && kinds.contains(&accessor.component_type);
        let size = size(accessor.component_type).filter(|_| unsigned);
        let size = size.ok_or(MeshFileError::Accessor { accessor: index, wanted: "unsigned integers" })?;
        Ok(self.items(index, accessor, size)?.chunks_exact(size).map(number).collect())
    }

    /// Returns the bytes of all items, tightly packed.
    fn items(&self, index: usize, accessor: &Accessor, size: usize) -> Result<Vec<u8>, MeshFileError> {
        let view = accessor.buffer_view.and_then(|view| self.document.buffer_views.get(view));
        let compressed =
            view.and_then(|view| view.extensions.keys().find(|name| name.ends_with("_meshopt_compression")));
        let outside = || match compressed {
            Some(extension) => MeshFileError::Compressed { extension: shown(extension) },
            None => MeshFileError::Accessor { accessor: index, wanted: "within its buffer" },
        };
        let count = accessor.count;
        let mut items = match accessor.buffer_view {
            Some(view) => self.run(view, accessor.byte_offset, size, count)?.ok_or_else(outside)?,
            None if count <= self.bytes => vec![0; count * size],
            None => return Err(MeshFileError::TooLarge),
        };
        self.charge(items.len())?;
        if let Some(sparse) = &accessor.sparse {
            let (at, values) = (&sparse.indices, &sparse.values);
            let width = self::size(at.component_type).filter(|_| at.component_type != FLOAT);
            let width = width.ok_or_else(outside)?;
            let places = self.run(at.buffer_view, at.byte_offset, width, sparse.count)?;
            let values = self.run(values.buffer_view, values.byte_offset, size, sparse.count)?;
            let (places, values) = (places.ok_or_else(outside)?, values.ok_or_else(outside)?);
            for (place, value) in places.chunks_exact(width).zip(values.chunks_exact(size)) {
                let item = items.chunks_exact_mut(size).nth(number(place) as usize).ok_or_else(outside)?;
                item.copy_from_slice(value);
            }
        }
        Ok(items)
    }

    /// Subtracts from the bytes that may still be read.
    pub(super) fn charge(&self, bytes: usize) -> Result<(), MeshFileError> {
        self.left.set(self.left.get().checked_sub(bytes).ok_or(MeshFileError::TooLarge)?);
        Ok(())
    }

    /// Returns `count` items of this size from an offset in a view, or `None` if they exceed the
    /// view.
    fn run(
        &self,
        view: usize,
        offset: usize,
        size: usize,
        count: usize,
    ) -> Result<Option<Vec<u8>>, MeshFileError> {
        let view = item(&self.document.buffer_views, "buffer view", view)?;
        let stride = view.byte_stride.filter(|&stride| stride > 0).unwrap_or(size);
        if count == 0 {
            return Ok(Some(Vec::new()));
        }
        let length = stride.checked_mul(count - 1).and_then(|length| length.checked_add(size));
        let bytes = || self.within(view)?.get(offset..)?.get(..length?).filter(|_| stride >= size);
        Ok(bytes().map(|bytes| bytes.chunks(stride).flat_map(|item| &item[..size]).copied().collect()))
    }

    /// Returns the bytes of a view that exist.
    pub(super) fn within(&self, view: &BufferView) -> Option<&[u8]> {
        let end = view.byte_offset.checked_add(view.byte_length)?;
        self.buffers.get(view.buffer)?.get(view.byte_offset..end)
    }
}

/// Returns the JSON and the buffer of a binary container.
fn container(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), MeshFileError> {
    let broken = |error: String| MeshFileError::broken("glTF container", error);
    let word = |at: usize| Some(number(bytes.get(at..at + 4)?));
    match word(4) {
        Some(2) => {}
        Some(version) => return Err(MeshFileError::GltfVersion { version: version.to_string() }),
        None => return Err(broken("file ends within the header".into())),
    }
    let claimed = word(8).unwrap_or_default() as usize;
    let all = bytes
        .get(..claimed)
        .ok_or_else(|| broken(format!("header claims {claimed} bytes, but the file has {}", bytes.len())))?;
    let (mut json, mut bin, mut rest) = (None, None, all.get(12..).unwrap_or_default());
    while let Some((head, behind)) = rest.split_first_chunk::<8>() {
        let chunk = behind.get(..number(&head[..4]) as usize);
        let chunk = chunk.ok_or_else(|| broken("a chunk extends beyond the file".into()))?;
        match &head[4..] {
            b"JSON" if json.is_none() => json = Some(chunk),
            b"BIN\0" if bin.is_none() => bin = Some(chunk),
            _ => {}
        }
        // Chunk lengths already include the padding to four bytes.
        rest = &behind[chunk.len()..];
    }
    Ok((json.ok_or_else(|| broken("no JSON chunk".into()))?, bin))
}

/// Decodes the component of an accessor from its bits.
fn component(accessor: &Accessor, bits: u32) -> f32 {
    accessor.fraction(match accessor.component_type {
        FLOAT => f32::from_bits(bits),
        BYTE => f32::from(bits as u8 as i8),
        SHORT => f32::from(bits as u16 as i16),
        _ => bits as f32,
    })
}

impl Accessor {
    /// Returns the number as stored, divided by the maximum of its type if the accessor is
    /// normalized.
    pub(super) fn fraction(&self, stored: f32) -> f32 {
        let largest = match self.component_type {
            BYTE => 127.0,
            UNSIGNED_BYTE => 255.0,
            SHORT => 32_767.0,
            UNSIGNED_SHORT => 65_535.0,
            UNSIGNED_INT => u32::MAX as f32,
            _ => return stored,
        };
        if self.normalized { (stored / largest).max(-1.0) } else { stored }
    }
}

/// Decodes a little-endian number of up to four bytes.
fn number(bytes: &[u8]) -> u32 {
    bytes.iter().rev().fold(0, |sum, &byte| sum << 8 | u32::from(byte))
}

/// Returns the bytes of a URI: a data URI (RFC 2397), or a file in or below the folder.
pub fn fetched(what: &'static str, uri: &str, folder: &Path) -> Result<Vec<u8>, MeshFileError> {
    let data = uri.get(..5).filter(|scheme| scheme.eq_ignore_ascii_case("data:"));
    if let Some((kind, data)) = data.and_then(|_| uri[5..].split_once(',')) {
        let bytes = unescaped(data);
        if !kind.trim_end().to_ascii_lowercase().ends_with(";base64") {
            return Ok(bytes);
        }
        return base64(bytes).map_err(|error| {
            MeshFileError::broken("glTF", format!("invalid Base64 in a data URI: {error}"))
        });
    }
    let file = folder.join(relative(uri)?);
    input_file::read(&file, MOST_BYTES).map_err(|error| MeshFileError::Beside {
        what,
        uri: shown(uri),
        error,
    })
}

/// Returns the name of the file of a URI, which must be in or below the folder of the glTF.
pub fn relative(uri: &str) -> Result<String, MeshFileError> {
    let is_below = |step: Component<'_>| matches!(step, Component::Normal(_) | Component::CurDir);
    String::from_utf8(unescaped(uri))
        .ok()
        // Windows programs write backslashes, which browsers convert.
        .map(|name| name.replace('\\', "/"))
        .filter(|name| !name.contains(':') && Path::new(name).components().all(is_below))
        .ok_or_else(|| MeshFileError::Elsewhere { uri: shown(uri) })
}

/// Decodes Base64 in either alphabet, with or without padding and spaces.
fn base64(mut text: Vec<u8>) -> Result<Vec<u8>, base64::DecodeError> {
    text.retain(|byte| !byte.is_ascii_whitespace());
    for byte in &mut text {
        *byte = match *byte {
            b'-' => b'+',
            b'_' => b'/',
            other => other,
        };
    }
    let config = GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent);
    GeneralPurpose::new(&STANDARD, config).decode(text)
}

/// Decodes percent escapes such as `%20`.
fn unescaped(uri: &str) -> Vec<u8> {
    let mut rest = uri.as_bytes();
    let mut bytes = Vec::new();
    while let [first, behind @ ..] = rest {
        let digits =
            behind.first_chunk::<2>().filter(|_| *first == b'%').and_then(|d| std::str::from_utf8(d).ok());
        match digits.and_then(|digits| u8::from_str_radix(digits, 16).ok()) {
            Some(byte) => (bytes.push(byte), rest = &behind[2..]),
            None => (bytes.push(*first), rest = behind),
        };
    }
    bytes
}
