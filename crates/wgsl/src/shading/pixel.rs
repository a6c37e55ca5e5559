//! Pixel footprints on a surface: width and axes.

use crate::noise::sums::FREQUENCY_CLAMP;
use crate::part::{Part, part};
use crate::shading::DIRECTION;

/// Width of a pixel on a surface, [`Footprint`](asperity_shading::Footprint); the largest float
/// instead of ∞.
pub(crate) static FOOTPRINT: Part = part!("shading/pixel/footprint", DIRECTION, FREQUENCY_CLAMP);

/// Elliptical pixel footprints, [`PixelEllipse`](asperity_shading::PixelEllipse).
pub(crate) static PIXEL_ELLIPSE: Part = part!("shading/pixel/ellipse", FOOTPRINT);
