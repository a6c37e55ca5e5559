//! The content of image files, and errors of image files.

use crate::failure::Failure;

/// Pixels of an environment map of 16k × 8k.
const MOST_PIXELS: usize = 1 << 27;
/// Maximum expansion ratio of deflate: a header that claims more than the file could hold is wrong.
/// Other encodings could repeat one color indefinitely. Unless it is small, an image with a larger
/// ratio counts as malicious.
const MOST_INFLATED: usize = 1032;
const SMALL: usize = 1 << 22;

/// The content of an image. OpenEXR files may have channels of both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Content {
    /// Red, green and blue, or gray.
    Colors,
    /// Components of normals: three, or x and y.
    Normals,
}

/// Returns an error for sizes above the limit, or above the pixels that `bytes` can encode. The
/// check precedes allocation.
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

/// The reason why a file is not a supported image.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ImageFileError {
    #[error("cannot read the file: {error}")]
    Unreadable {
        #[source]
        error: std::io::Error,
    },
    #[error("the file is empty")]
    Empty,
    #[error("unsupported image format (expected PNG, JPEG, WebP, Radiance HDR or OpenEXR)")]
    UnknownFormat,
    #[error("unsupported texture format (expected PNG, JPEG or WebP)")]
    UnknownTexture,
    #[error("an image must have 1 to {MOST_PIXELS} pixels, got {width} × {height}")]
    Size { width: usize, height: usize },
    #[error("{bytes} bytes cannot hold the {width} × {height} pixels that the header claims")]
    Truncated { width: usize, height: usize, bytes: usize },
    #[error("the image has only an alpha channel")]
    OnlyAlpha,
    #[error("the image has no color channels (found {channels})")]
    NoColors { channels: String },
    #[error("a normal map needs channels R, G, B or X, Y, Z, got {channels}")]
    NoNormals { channels: String },
    #[error("cannot choose between the image's layers: {layers}")]
    SeveralLayers { layers: String },
    #[error("luminance and chroma channels (Y, RY, BY) are not supported (save the image with R, G and B)")]
    LuminanceChroma,
    #[error("subsampled channels are not supported (save the image without subsampling)")]
    Subsampled,
    #[error("deep data is not supported (save the image flat)")]
    DeepData,
    #[error("cube maps are not supported (convert the image to latitude and longitude)")]
    CubeMap,
    /// The file violates its format, according to the decoder.
    #[error("cannot decode the {format}: {error}")]
    Broken {
        format: &'static str,
        #[source]
        error: Failure,
    },
}
