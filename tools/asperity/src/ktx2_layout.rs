//! The parts of a KTX2 file before its texels, and where the texels of each mip level lie.

use ktx2::dfd::{Basic, Block};
use ktx2::{Format, Header, Index, LevelIndex, SupercompressionScheme};

/// What all levels of a texture have in common.
pub(crate) struct Texture {
    pub(crate) format: Option<Format>,
    pub(crate) type_size: u32,
    pub(crate) description: Basic,
    /// Width and height of the first level.
    pub(crate) size: [usize; 2],
    pub(crate) scheme: Option<SupercompressionScheme>,
    /// Of the first byte of a level.
    pub(crate) alignment: u64,
}

/// A file without its texels.
pub(crate) struct Layout {
    /// The header, the level index, the description and the notes.
    pub(crate) head: Vec<u8>,
    /// Where the levels lie, in the order of the file: the smallest level first.
    pub(crate) places: Vec<LevelIndex>,
}

impl Texture {
    /// Lays out levels, the largest first, by their length in the file and without supercompression.
    pub(crate) fn layout(self, lengths: &[[u64; 2]]) -> Layout {
        let Self { format, type_size, description, size, scheme, alignment } = self;
        let block = Block::Basic(description).to_vec();
        let description = [&(block.len() as u32 + 4).to_le_bytes()[..], &block].concat();
        let writer = concat!("asperity ", env!("CARGO_PKG_VERSION"));
        let notes = [note("KTXorientation", "rd"), note("KTXwriter", writer)].concat();
        let first = Header::LENGTH + LevelIndex::LENGTH * lengths.len();
        let header = Header {
            format,
            type_size,
            pixel_width: size[0] as u32,
            pixel_height: size[1] as u32,
            pixel_depth: 0,
            layer_count: 0,
            face_count: 1,
            level_count: lengths.len() as u32,
            supercompression_scheme: scheme,
            index: Index {
                dfd_byte_offset: first as u32,
                dfd_byte_length: description.len() as u32,
                kvd_byte_offset: (first + description.len()) as u32,
                kvd_byte_length: notes.len() as u32,
                sgd_byte_offset: 0,
                sgd_byte_length: 0,
            },
        };
        let mut end = (first + description.len() + notes.len()) as u64;
        let place = |&[byte_length, uncompressed_byte_length]: &[u64; 2]| {
            let byte_offset = end.next_multiple_of(alignment);
            end = byte_offset + byte_length;
            LevelIndex { byte_offset, byte_length, uncompressed_byte_length }
        };
        let places: Vec<_> = lengths.iter().rev().map(place).collect();
        let index: Vec<u8> = places.iter().rev().flat_map(LevelIndex::as_bytes).collect();
        Layout { head: [&header.as_bytes()[..], &index, &description, &notes].concat(), places }
    }
}

/// Encodes a key and its value, padded to four bytes.
fn note(key: &str, value: &str) -> Vec<u8> {
    let text = format!("{key}\0{value}\0");
    let mut bytes = (text.len() as u32).to_le_bytes().to_vec();
    bytes.extend_from_slice(text.as_bytes());
    bytes.resize(bytes.len().next_multiple_of(4), 0);
    bytes
}
