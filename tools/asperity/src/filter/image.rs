//! The images of a glTF, decoded.

use std::sync::Arc;

use asperity_render::image::content::Content;
use asperity_render::image::read::ImageFile;

use crate::failure::Result;
use crate::filter::container::Container;
use crate::filter::texture_file;

/// The images of a glTF. An image is decoded once in a row.
pub(super) struct Images<'a> {
    gltf: &'a Container,
    decoded: Vec<(usize, Arc<ImageFile>)>,
}

impl<'a> Images<'a> {
    pub(super) fn new(gltf: &'a Container) -> Self {
        Self { gltf, decoded: Vec::new() }
    }

    /// Decodes an image. The last four are kept.
    pub(super) fn get(&mut self, index: usize) -> Result<Arc<ImageFile>> {
        if let Some((_, image)) = self.decoded.iter().find(|(at, _)| *at == index) {
            return Ok(Arc::clone(image));
        }
        let image = Arc::new(self.decode(index)?);
        self.decoded.truncate(3);
        self.decoded.insert(0, (index, Arc::clone(&image)));
        Ok(image)
    }

    fn decode(&self, index: usize) -> Result<ImageFile> {
        let bytes = self.gltf.image(index)?;
        let image = match &bytes[..] {
            [0xab, b'K', b'T', b'X', ..] => texture_file::decode(&bytes),
            _ => ImageFile::decode(&bytes, Content::Colors).map_err(Into::into),
        };
        image.map_err(|error| format!("cannot read image {index} of the glTF: {error}").into())
    }
}
