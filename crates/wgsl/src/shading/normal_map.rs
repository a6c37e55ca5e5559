//! Authored normal maps: parts and words.

use asperity_shading::glam::Vec2;
use asperity_shading::normal_map::{SlopeLobes, SlopePyramidRef};

use crate::ndf::{GAUSSIAN_SPLIT, OFFSET_BECKMANN};
use crate::part::{Binding, Element, Part, part};
use crate::shading::MATH;
use crate::shading::pixel::PIXEL_ELLIPSE;

/// Mean and covariance of slopes within a pixel,
/// [`SlopeMoments`](asperity_shading::normal_map::SlopeMoments).
pub static SLOPE_MOMENTS: Part =
    part!("shading/normal_map/slope_moments", GAUSSIAN_SPLIT, OFFSET_BECKMANN, MATH);

/// Normal maps at every zoom as grouped slopes, [`SlopePyramidRef`].
///
/// Bound to [`slope_pyramid_numbers`] as the table `slope_pyramid_number`.
pub static SLOPE_PYRAMID: Part =
    part!("shading/normal_map/slope_pyramid", SLOPE_MOMENTS, PIXEL_ELLIPSE, MATH).with_bindings(&[
        Binding::Table { name: "slope_pyramid_number", element: Element::Float, width: SLOPE_PYRAMID_WIDTH },
    ]);

/// Texels per row of the table. A map of 512² texels in four groups takes 4352 rows.
pub const SLOPE_PYRAMID_WIDTH: u32 = 2048;

/// Returns the words of the structure `SlopePyramid`: width, height, last level, number of groups.
///
/// The example needs the feature `alloc`.
///
#[cfg_attr(feature = "alloc", doc = "```")]
#[cfg_attr(not(feature = "alloc"), doc = "```ignore")]
/// use asperity_wgsl::shading::normal_map::{slope_pyramid_numbers, slope_pyramid_words};
/// use asperity_shading::{SlopePyramid, glam::Vec2};
///
/// let map = SlopePyramid::<2>::new(4, 2, vec![Vec2::X; 8])?;
/// assert_eq!(slope_pyramid_words(&map.as_ref()), [4, 2, 2, 2]);
/// // Two centers, eight slopes, eleven texels of two lobes.
/// assert_eq!(slope_pyramid_numbers(&map.as_ref()).count(), 2 * 2 + 2 * 8 + 6 * 2 * 11);
/// # Ok::<(), asperity_shading::ImageError>(())
/// ```
#[must_use]
pub fn slope_pyramid_words<const K: usize>(map: &SlopePyramidRef<'_, K>) -> [u32; 4] {
    let ([width, height], ..) = map.parts();
    [width as u32, height as u32, map.last_level(), K as u32]
}

/// Iterates over the numbers of the table.
///
/// Two numbers for the center of each group, two for the slope of each texel, and six for each
/// group of each texel of every level: weight, mean, covariance.
pub fn slope_pyramid_numbers<'a, const K: usize>(
    map: &'a SlopePyramidRef<'_, K>,
) -> impl Iterator<Item = f32> + use<'a, K> {
    let (_, slopes, centres, lobes) = map.parts();
    let places = centres.iter().chain(slopes).flat_map(Vec2::to_array);
    places.chain(lobes.iter().flat_map(SlopeLobes::lobes).flat_map(|lobe| {
        let ([x, y], [xx, xy, yy]) = (lobe.moments.mean.to_array(), lobe.moments.covariance);
        [lobe.weight, x, y, xx, xy, yy]
    }))
}
