//! Tables of one thing, ready to be written.

use asperity_render::image::Image;
use serde_json::Value;

/// The files of a set with their picture and words.
pub(super) struct Made {
    /// Contents of the files, in a sentence or two.
    pub(super) text: String,
    pub(super) parameters: Value,
    pub(super) files: Vec<(String, Vec<u8>)>,
    pub(super) picture: Image,
}
