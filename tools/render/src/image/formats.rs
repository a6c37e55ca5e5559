//! Exchange formats: OpenEXR for textures, `.npy` for arrays.

use std::io::Cursor;

use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, SmallVec, WritableImage,
};

use crate::failure::Failure;

/// Encodes named channels of 32-bit floats, row by row from the top, as an uncompressed OpenEXR
/// file.
pub fn exr<'a>(
    width: usize,
    height: usize,
    channels: impl IntoIterator<Item = (&'a str, Vec<f32>)>,
) -> Result<Vec<u8>, Failure> {
    let list: SmallVec<[_; 4]> = channels
        .into_iter()
        .map(|(name, samples)| AnyChannel::new(name, FlatSamples::F32(samples)))
        .collect();
    let encoding = Encoding::UNCOMPRESSED;
    let layer = Layer::new((width, height), LayerAttributes::default(), encoding, AnyChannels::sort(list));
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layer(layer).write().non_parallel().to_buffered(&mut bytes)?;
    Ok(bytes.into_inner())
}

/// Number types with NumPy's names, and their little-endian bytes.
pub const U8: (&str, fn(u8) -> [u8; 1]) = ("|u1", u8::to_le_bytes);
pub const F32: (&str, fn(f32) -> [u8; 4]) = ("<f4", f32::to_le_bytes);
pub const F64: (&str, fn(f64) -> [u8; 8]) = ("<f8", f64::to_le_bytes);

/// Encodes a C-ordered array in NumPy's format 1.0.
pub fn npy<T: Copy, const N: usize>(
    (descr, bytes_of): (&str, fn(T) -> [u8; N]),
    shape: &[usize],
    values: &[T],
) -> Vec<u8> {
    let dimensions: String = shape.iter().map(|n| format!("{n}, ")).collect();
    let mut header = format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': ({dimensions}), }}");
    // Magic, version and length take 10 bytes. The header ends in a line feed at a multiple of 64.
    header += &" ".repeat(63 - (header.len() + 10) % 64);
    header.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend_from_slice(&(header.len() as u16).to_le_bytes());
    bytes.extend_from_slice(header.as_bytes());
    bytes.extend(values.iter().flat_map(|&value| bytes_of(value)));
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn npy_header() {
        let bytes = npy(F32, &[2, 3], &[0.5_f32; 6]);
        assert_eq!(&bytes[..8], b"\x93NUMPY\x01\x00");
        let length = usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
        assert_eq!((10 + length) % 64, 0);
        let header = std::str::from_utf8(&bytes[10..10 + length]).unwrap();
        assert!(
            header.starts_with("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3, ), }"),
            "{header}"
        );
        assert!(header.ends_with('\n'));
        assert_eq!(bytes.len(), 10 + length + 24);
    }
}
