//! Pixels on a surface: their width and their two axes.

use crate::noise::sums::FREQUENCY_CLAMP;
use crate::part::{Part, part};
use crate::shading::DIRECTION;

/// Width of a pixel on a surface, [`Footprint`](asperity_shading::Footprint): the largest float where the crate's is infinite.
pub static FOOTPRINT: Part = part!("shading/pixel/footprint", DIRECTION, FREQUENCY_CLAMP);

/// Footprints of pixels that are longer than wide, [`PixelEllipse`](asperity_shading::PixelEllipse).
pub static PIXEL_ELLIPSE: Part = part!("shading/pixel/ellipse", FOOTPRINT);
