//! Integer samples of PNG, JPEG and WebP files.

use std::io::Cursor;

use image_webp::WebPDecoder;
use zune_jpeg::{
    JpegDecoder,
    zune_core::{bytestream::ZCursor, colorspace::ColorSpace, options::DecoderOptions},
};

use crate::image::content::{ImageFileError, check_size};

/// Interleaved samples, row by row from the top left.
pub(super) struct Samples {
    pub(super) width: usize,
    pub(super) height: usize,
    /// Gray or red, green, blue; then alpha, if the number is even.
    pub(super) channels: usize,
    /// Bytes per sample, 1 or 2, most significant byte first.
    pub(super) step: usize,
    pub(super) bytes: Vec<u8>,
}

/// A file whose header is decoded.
pub(super) struct OpenedSamples<'a> {
    pub(super) width: usize,
    pub(super) height: usize,
    decoder: Decoder<'a>,
}

enum Decoder<'a> {
    Png(Box<png::Reader<Cursor<&'a [u8]>>>),
    Jpeg(Box<JpegDecoder<ZCursor<&'a [u8]>>>),
    WebP(Box<WebPDecoder<Cursor<&'a [u8]>>>),
}

fn broken_png(error: png::DecodingError) -> ImageFileError {
    ImageFileError::Broken { format: "PNG", error: error.into() }
}

fn broken_jpeg(error: &zune_jpeg::errors::DecodeErrors) -> ImageFileError {
    ImageFileError::Broken { format: "JPEG", error: error.to_string().into() }
}

fn broken_webp(error: image_webp::DecodingError) -> ImageFileError {
    ImageFileError::Broken { format: "WebP", error: error.into() }
}

impl Samples {
    /// Decodes the header of a file, or returns `None` for other formats. Nothing is allocated for
    /// pixels.
    pub(super) fn open(bytes: &[u8]) -> Result<Option<OpenedSamples<'_>>, ImageFileError> {
        let (width, height, pixel, decoder) = match *bytes {
            [] => return Err(ImageFileError::Empty),
            [0x89, b'P', b'N', b'G', ..] => {
                let mut decoder = png::Decoder::new(Cursor::new(bytes));
                decoder.set_transformations(png::Transformations::EXPAND);
                decoder.set_ignore_text_chunk(true);
                decoder.set_ignore_iccp_chunk(true);
                let reader = decoder.read_info().map_err(broken_png)?;
                let (width, height) = (reader.info().width as usize, reader.info().height as usize);
                let (color, depth) = reader.output_color_type();
                let pixel = color.samples() * if depth == png::BitDepth::Sixteen { 2 } else { 1 };
                (width, height, pixel, Decoder::Png(Box::new(reader)))
            }
            [0xff, 0xd8, 0xff, ..] => {
                let options = DecoderOptions::default().jpeg_set_out_colorspace(ColorSpace::RGB);
                let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
                decoder.decode_headers().map_err(|error| broken_jpeg(&error))?;
                let info = decoder.info();
                let (width, height) = info.map_or((0, 0), |info| (info.width.into(), info.height.into()));
                (width, height, 3, Decoder::Jpeg(Box::new(decoder)))
            }
            [b'R', b'I', b'F', b'F', _, _, _, _, b'W', b'E', b'B', b'P', ..] => {
                let decoder = WebPDecoder::new(Cursor::new(bytes)).map_err(broken_webp)?;
                let (width, height) = decoder.dimensions();
                (width as usize, height as usize, 4, Decoder::WebP(Box::new(decoder)))
            }
            _ => return Ok(None),
        };
        check_size(width, height, pixel, bytes.len())?;
        Ok(Some(OpenedSamples { width, height, decoder }))
    }
}

impl OpenedSamples<'_> {
    /// Decodes the pixels.
    pub(super) fn decode(self) -> Result<Samples, ImageFileError> {
        let Self { width, height, decoder } = self;
        let too_large = ImageFileError::Size { width, height };
        match decoder {
            Decoder::Png(mut reader) => {
                let mut bytes = vec![0; reader.output_buffer_size().ok_or(too_large)?];
                let info = reader.next_frame(&mut bytes).map_err(broken_png)?;
                let step = if info.bit_depth == png::BitDepth::Sixteen { 2 } else { 1 };
                Ok(Samples { width, height, channels: info.color_type.samples(), step, bytes })
            }
            Decoder::Jpeg(mut decoder) => {
                let bytes = decoder.decode().map_err(|error| broken_jpeg(&error))?;
                Ok(Samples { width, height, channels: 3, step: 1, bytes })
            }
            Decoder::WebP(mut decoder) => {
                let mut bytes = vec![0; decoder.output_buffer_size().ok_or(too_large)?];
                decoder.read_image(&mut bytes).map_err(broken_webp)?;
                let channels = if decoder.has_alpha() { 4 } else { 3 };
                Ok(Samples { width, height, channels, step: 1, bytes })
            }
        }
    }
}
