//! The file of a glTF: JSON, or a binary container around it.

use std::ops::Range;
use std::path::{Path, PathBuf};

use asperity_render::geometry::mesh_file::gltf::buffers::fetched;
use asperity_render::input_file;
use serde_json::Value;

use crate::failure::Result;

/// Longest input.
const MOST_BYTES: u64 = 1 << 31;

/// A file, and what its JSON means.
pub(super) struct Container {
    bytes: Vec<u8>,
    json: Range<usize>,
    /// The data of the binary chunk, in a binary container.
    bin: Option<Range<usize>>,
    binary: bool,
    pub(super) value: Value,
    pub(super) folder: PathBuf,
}

impl Container {
    /// Reads a file.
    pub(super) fn open(path: &Path) -> Result<Self> {
        let bytes =
            input_file::read(path, MOST_BYTES).map_err(|error| format!("cannot read the file: {error}"))?;
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        Self::parse(bytes, folder)
    }

    /// Finds the parts of a file.
    pub(super) fn parse(bytes: Vec<u8>, folder: PathBuf) -> Result<Self> {
        if bytes.is_empty() {
            return Err("the file is empty".into());
        }
        let binary = bytes.starts_with(b"glTF");
        let (json, bin) = if binary { chunks(&bytes)? } else { (mark(&bytes)..bytes.len(), None) };
        let text = std::str::from_utf8(&bytes[json.clone()]);
        let text = text.map_err(|error| format!("invalid glTF: {error}"))?;
        let text = text.trim_end_matches(['\0', ' ', '\t', '\r', '\n']);
        if !text.trim_start().starts_with('{') {
            return Err("invalid glTF: neither JSON nor a binary container".into());
        }
        let value: Value = serde_json::from_str(text).map_err(|error| format!("invalid glTF: {error}"))?;
        match value.pointer("/asset/version").and_then(Value::as_str) {
            Some(version) if version.starts_with("2.") => {}
            Some(_) => return Err("another version than glTF 2.0 is not supported".into()),
            None => return Err("the JSON has no `asset.version`, so it is not a glTF 2.0".into()),
        }
        let json = json.start..json.start + text.len();
        Ok(Self { json, bin, binary, value, folder, bytes })
    }

    /// Returns the file.
    pub(super) fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Returns the JSON.
    pub(super) fn json(&self) -> &str {
        std::str::from_utf8(&self.bytes[self.json.clone()]).unwrap_or_default()
    }

    /// Returns the number of bytes of the binary chunk, if new data can be appended to it.
    pub(super) fn bin_len(&self) -> Option<usize> {
        self.value.pointer("/buffers/0").filter(|buffer| buffer.get("uri").is_none())?;
        Some(self.bin.clone()?.len())
    }

    /// Returns the list of this name, empty if it is missing.
    pub(super) fn list(&self, name: &str) -> &[Value] {
        self.value.get(name).and_then(Value::as_array).map_or(&[], Vec::as_slice)
    }

    /// Returns an item of a list.
    pub(super) fn item(&self, name: &str, index: usize) -> Result<&Value> {
        let list = self.list(name);
        list.get(index)
            .ok_or_else(|| format!("the glTF has no item {index} in `{name}` (it has {})", list.len()).into())
    }

    /// Returns the bytes of an image, and its URI if it is in a file.
    pub(super) fn image(&self, index: usize) -> Result<Vec<u8>> {
        let image = self.item("images", index)?;
        if let Some(uri) = image.get("uri").and_then(Value::as_str) {
            return Ok(fetched("image", uri, &self.folder)?);
        }
        let view = number(image, "bufferView")?.ok_or_else(|| format!("image {index} has no data"))?;
        let value = self.item("bufferViews", view)?;
        let buffer = number(value, "buffer")?.unwrap_or(usize::MAX);
        let (start, length) = (number(value, "byteOffset")?.unwrap_or(0), number(value, "byteLength")?);
        let end = start.saturating_add(length.unwrap_or(0));
        let outside = || format!("buffer view {view} extends beyond its buffer");
        let bytes = match self.item("buffers", buffer)?.get("uri").and_then(Value::as_str) {
            Some(uri) => fetched("buffer", uri, &self.folder)?.get(start..end).map(<[u8]>::to_vec),
            None => {
                let bin = self.bin.clone().filter(|_| buffer == 0).unwrap_or_default();
                self.bytes[bin].get(start..end).map(<[u8]>::to_vec)
            }
        };
        Ok(bytes.ok_or_else(outside)?)
    }

    /// Returns the file with another JSON, and with data appended to the binary chunk, which is a
    /// multiple of 4 bytes long.
    pub(super) fn rebuilt(&self, json: &str, appended: &[u8]) -> Result<Vec<u8>> {
        if !self.binary {
            let (before, after) = (&self.bytes[..self.json.start], &self.bytes[self.json.end..]);
            return Ok([before, json.as_bytes(), after].concat());
        }
        let padded = |length: usize| length.next_multiple_of(4);
        let mut out = self.bytes[..12].to_vec();
        let length = |length: usize| u32::try_from(length).map_err(|_| "the result is longer than 4 GiB");
        out.extend(length(padded(json.len()))?.to_le_bytes());
        out.extend_from_slice(b"JSON");
        out.extend_from_slice(json.as_bytes());
        out.resize(padded(out.len()), b' ');
        let rest = self.chunk_end();
        if let Some(bin) = self.bin.clone() {
            out.extend_from_slice(&self.bytes[rest..bin.start - 8]);
            out.extend(length(padded(bin.len()) + appended.len())?.to_le_bytes());
            out.extend_from_slice(b"BIN\0");
            out.extend_from_slice(&self.bytes[bin.clone()]);
            out.resize(out.len() + padded(bin.len()) - bin.len(), 0);
            out.extend_from_slice(appended);
            out.extend_from_slice(&self.bytes[bin.end..]);
        } else {
            out.extend_from_slice(&self.bytes[rest..]);
        }
        let all = length(out.len())?;
        out[8..12].copy_from_slice(&all.to_le_bytes());
        Ok(out)
    }

    /// Returns the end of the JSON chunk.
    fn chunk_end(&self) -> usize {
        let length = self.bytes[12..16].iter().rev().fold(0, |sum, &byte| sum << 8 | usize::from(byte));
        20 + length
    }
}

/// Returns the length of a byte order mark.
fn mark(bytes: &[u8]) -> usize {
    if bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 }
}

/// Returns the JSON and the binary chunk of a container.
fn chunks(bytes: &[u8]) -> Result<(Range<usize>, Option<Range<usize>>)> {
    let word = |at: usize| {
        let word = bytes.get(at..at + 4)?;
        Some(word.iter().rev().fold(0, |sum, &byte| sum << 8 | usize::from(byte)))
    };
    if word(4) != Some(2) {
        return Err("invalid glTF container: its version must be 2".into());
    }
    if word(8) != Some(bytes.len()) {
        return Err("invalid glTF container: the header claims another length".into());
    }
    let (mut found, mut at) = (Vec::new(), 12);
    while at < bytes.len() {
        let start = at + 8;
        let end = word(at).and_then(|length| start.checked_add(length)).filter(|end| *end <= bytes.len());
        let end = end.ok_or("invalid glTF container: a chunk extends beyond the file")?;
        found.push((&bytes[at + 4..start], start..end));
        at = end;
    }
    match &found[..] {
        [(b"JSON", json), rest @ ..] => {
            let bin = rest.first().filter(|(kind, _)| *kind == b"BIN\0");
            Ok((json.clone(), bin.map(|(_, range)| range.clone())))
        }
        _ => Err("invalid glTF container: no JSON chunk".into()),
    }
}

/// Reads an index or a length; `None` if it is missing.
pub(super) fn number(value: &Value, name: &str) -> Result<Option<usize>> {
    let Some(value) = value.get(name).filter(|value| !value.is_null()) else { return Ok(None) };
    let number = value.as_u64().and_then(|number| usize::try_from(number).ok());
    number.map(Some).ok_or_else(|| format!("`{name}` must be a non-negative integer").into())
}
