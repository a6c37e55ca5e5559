//! Authored normal maps: parts and words.

use asperity_shading::gpu::SlopePyramidUniform;

use crate::ndf::{GAUSSIAN_SPLIT, OFFSET_BECKMANN};
use crate::part::{Binding, Element, Part, part};
use crate::shading::MATH;
use crate::shading::pixel::PIXEL_ELLIPSE;

/// Mean and covariance of slopes within a pixel,
/// [`SlopeMoments`](asperity_shading::normal_map::SlopeMoments).
pub(crate) static SLOPE_MOMENTS: Part =
    part!("shading/normal_map/slope_moments", GAUSSIAN_SPLIT, OFFSET_BECKMANN, MATH);

/// Normal maps at every zoom as grouped slopes,
/// [`SlopePyramid`](asperity_shading::normal_map::SlopePyramid).
///
/// Bound to [`gpu_numbers`](asperity_shading::normal_map::SlopePyramid::gpu_numbers) as the
/// table `slope_pyramid_number`.
pub static SLOPE_PYRAMID: Part =
    part!("shading/normal_map/slope_pyramid", [SlopePyramidUniform], SLOPE_MOMENTS, PIXEL_ELLIPSE, MATH)
        .with_bindings(&[Binding::Table {
            name: "slope_pyramid_number",
            element: Element::Float,
            width: 2048,
        }]);
