//! UASTC blocks of an image, by the encoder of Basis Universal.
//!
//! The binding marks the encoder as `unsafe`, because C++ does not validate its parameters. The only
//! `unsafe` blocks of the program `asperity` are in this file.

use basis_universal::{
    BasisTextureFormat, ColorSpace, Compressor, CompressorParams, UASTC_QUALITY_DEFAULT, UASTC_QUALITY_MIN,
};

/// Largest side of an image.
pub const MAX_SIDE: u32 = 16_384;

/// Bytes of a block of 4 × 4 texels.
pub const BLOCK: usize = 16;

/// Returns the blocks of an RGBA image, row by row; texels beyond the image repeat its last.
///
/// The color space is linear. `threads` is at least 1. Small images are encoded with more care.
///
/// # Errors
///
/// An empty image, one larger than [`MAX_SIDE`], bytes of another length, and errors of the encoder.
pub fn encode(rgba: &[u8], width: u32, height: u32, threads: u32) -> Result<Vec<u8>, String> {
    let sides = [width, height];
    if sides.iter().any(|side| !(1..=MAX_SIDE).contains(side)) {
        return Err(format!("image of {width} × {height} texels (expected 1 to {MAX_SIDE} on a side)"));
    }
    if rgba.len() != 4 * width as usize * height as usize {
        return Err(format!("{} bytes for {width} × {height} texels of 4 bytes", rgba.len()));
    }
    let mut params = CompressorParams::new();
    params.set_basis_format(BasisTextureFormat::UASTC4x4);
    let large = width.max(height) > 256;
    params.set_uastc_quality_level(if large { UASTC_QUALITY_MIN } else { UASTC_QUALITY_DEFAULT });
    params.set_color_space(ColorSpace::Linear);
    params.set_mip_color_space(ColorSpace::Linear);
    params.set_generate_mipmaps(false);
    params.source_image_mut(0).init(rgba, width, height, 4);
    let mut compressor = Compressor::new(threads.max(1));
    // SAFETY: one image of valid size was copied into the parameters above; every other parameter
    // has its default, and both objects live until the end of this function.
    let initialized = unsafe { compressor.init(&params) };
    if !initialized {
        return Err("the UASTC encoder refused its parameters".into());
    }
    // SAFETY: the compressor was initialized with these parameters.
    unsafe { compressor.process() }.map_err(|code| format!("the UASTC encoder failed: {code:?}"))?;
    slice(compressor.basis_file(), sides).ok_or_else(|| "the UASTC encoder wrote an invalid file".into())
}

/// Returns the blocks of the only slice of a .basis file.
fn slice(file: &[u8], sides: [u32; 2]) -> Option<Vec<u8>> {
    let word = |at: usize| {
        let bytes = file.get(at..at + 4)?.try_into().ok()?;
        usize::try_from(u32::from_le_bytes(bytes)).ok()
    };
    // `basis_file_header::m_slice_desc_file_ofs`, then `basis_slice_desc::m_file_ofs`, `m_file_size`.
    let description = word(65)?;
    let (offset, length) = (word(description + 13)?, word(description + 17)?);
    let [columns, rows] = sides.map(|side| side.div_ceil(4) as usize);
    let blocks = file.get(offset..offset.checked_add(length)?)?;
    (blocks.len() == BLOCK * columns * rows).then(|| blocks.to_vec())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn encode_covers_sizes_that_are_not_multiples_of_four() {
        for [width, height] in [[16, 8], [5, 7], [1, 1]] {
            let texel = |k: u32| [255, (k % width * 9) as u8, (k / width * 20) as u8, 255];
            let rgba: Vec<u8> = (0..width * height).flat_map(texel).collect();
            let blocks = encode(&rgba, width, height, 2).unwrap();
            assert_eq!(blocks.len(), BLOCK * (width.div_ceil(4) * height.div_ceil(4)) as usize);
            assert_eq!(blocks, encode(&rgba, width, height, 1).unwrap());
        }
    }

    #[test]
    fn encode_rejects_wrong_sizes() {
        assert!(encode(&[], 0, 4, 1).is_err());
        assert!(encode(&[0; 4], 2, 1, 1).is_err());
        assert!(encode(&[], 1 << 20, 1 << 20, 1).is_err());
    }
}
