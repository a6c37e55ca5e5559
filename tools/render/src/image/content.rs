//! The content of image files, and why one is refused.

use crate::failure::Failure;

/// Pixels of surroundings of 16k by 8k.
const MOST_PIXELS: usize = 1 << 27;
/// No deflated data grows by more than this: a header that claims more than its file could hold is wrong. Other codings could
/// repeat one colour for ever; what grows by more than this is taken for an attack, unless it is small.
const MOST_INFLATED: usize = 1032;
const SMALL: usize = 1 << 22;

/// The content of an image: OpenEXR files have channels of both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Content {
    /// Red, green and blue, or gray.
    Colors,
    /// Coordinates of normals: three, or x and y.
    Normals,
}

/// Refuses sizes beyond reason, and beyond what a file of so many `bytes` can hold in pixels of so many, before anything is allocated.
pub(super) fn check_size(
    width: usize,
    height: usize,
    pixel: usize,
    bytes: usize,
) -> Result<(), ImageFileError> {
    let pixels = width.checked_mul(height).filter(|pixels| (1..=MOST_PIXELS).contains(pixels));
    let all = pixels.ok_or(ImageFileError::Size { width, height })?.saturating_mul(pixel);
    if all > bytes.saturating_mul(MOST_INFLATED).max(SMALL) {
        return Err(ImageFileError::Truncated { width, height, bytes });
    }
    Ok(())
}

/// Why a file is not an image of data.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ImageFileError {
    #[error("the file cannot be read: {error}")]
    Unreadable {
        #[source]
        error: std::io::Error,
    },
    #[error("the file is empty")]
    Empty,
    #[error("the file is none of PNG, JPEG, WebP, Radiance HDR and OpenEXR")]
    UnknownFormat,
    #[error("an image must have 1 to {MOST_PIXELS} pixels, got {width} × {height}")]
    Size { width: usize, height: usize },
    #[error("{bytes} bytes cannot hold the {width} × {height} pixels that the header claims")]
    Truncated { width: usize, height: usize, bytes: usize },
    #[error("the image has no channel but alpha")]
    OnlyAlpha,
    #[error("the image has no colors: its channels are {channels}")]
    NoColors { channels: String },
    #[error("a normal map needs the channels R, G, B or X, Y, Z, got {channels}")]
    NoNormals { channels: String },
    #[error("the image has several layers and none is named as the picture: {layers}")]
    SeveralLayers { layers: String },
    #[error(
        "its colors are luminance and chroma (Y, RY, BY), which are not supported: save it with R, G and B"
    )]
    LuminanceChroma,
    #[error(
        "its channels have fewer samples than pixels, which is not supported: save it without subsampling"
    )]
    Subsampled,
    #[error("the file has deep data, which are not supported: save it flat")]
    DeepData,
    #[error("it is a cube map, which is not supported: convert it to latitude and longitude")]
    CubeMap,
    /// The file breaks its format, as the decoder has it.
    #[error("the {format} cannot be decoded: {error}")]
    Broken {
        format: &'static str,
        #[source]
        error: Failure,
    },
}
