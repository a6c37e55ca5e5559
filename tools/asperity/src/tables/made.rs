//! Tables of one thing, ready to be written.

use asperity_render::image::Image;
use serde_json::Value;

/// The files of a set, with image and description.
pub(super) struct Made {
    /// A description of the files in one or two sentences.
    pub(super) text: String,
    pub(super) parameters: Value,
    pub(super) files: Vec<(String, Vec<u8>)>,
    pub(super) picture: Image,
}
