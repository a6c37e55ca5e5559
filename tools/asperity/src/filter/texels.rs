//! The texels that a material's normal and roughness maps have in one square.

use std::sync::Arc;

use asperity_render::image::read::ImageFile;
use asperity_render::image::texture_map::Wrap;
use glam::{DAffine2, DVec2, Vec2};
use rayon::prelude::*;

use crate::filter::tails::Spread;
use crate::filter::texture::Places;

/// Largest side of a new texture.
const MOST_SIDE: usize = 8192;

/// The steepest slope: 45°.
///
/// A few steep texels on the edges of flat parts would otherwise dominate the variance, and dull the
/// highlight of the flat parts. Steeper facets reflect other light, far from that highlight.
const STEEPEST: f32 = 1.0;

/// An image with its wrap modes.
pub(super) struct Map {
    pub(super) image: Arc<ImageFile>,
    pub(super) wrap: [Wrap; 2],
}

/// The maps of a material.
pub(super) struct Maps {
    pub(super) normal: Map,
    /// Multiplies slopes.
    pub(super) scale: f32,
    /// Occlusion, roughness and metallic in red, green and blue.
    pub(super) roughness: Option<Map>,
    /// Multiplies the roughness.
    pub(super) factor: f32,
    pub(super) places: Places,
}

/// Maps at one resolution, whose texels are at least as dense as in both.
pub(super) struct Texels {
    pub(super) size: [usize; 2],
    slopes: Slopes,
    roughness: Option<Map>,
    factor: f32,
    place: DAffine2,
}

/// Slopes of a normal map, bilinear between its texels.
struct Slopes {
    size: [usize; 2],
    wrap: [Wrap; 2],
    texels: Vec<Vec2>,
    place: DAffine2,
}

impl Maps {
    /// Aligns the maps, with sides of a multiple; `None` if that takes too many texels.
    pub(super) fn texels(self, multiple: usize) -> Option<Texels> {
        let Self { normal, scale, roughness, factor, places } = self;
        let mut size = density(&normal.image, places.normal);
        if let Some(map) = &roughness {
            let other = density(&map.image, places.roughness);
            size = [0, 1].map(|axis| f64::max(size[axis], other[axis]));
        }
        let size = size.map(|side| (side.round() as usize).next_multiple_of(multiple));
        if size.iter().any(|side| *side > MOST_SIDE) {
            return None;
        }
        let image = normal.image.as_ref();
        let [x, y, z] = image.colors();
        let slope = |k: usize| {
            let [x, y, z] = [x[k], y[k], z[k]].map(|value| 2.0 * value - 1.0);
            // Black texels between charts have no normal.
            let slope = if z > 0.0 { scale * Vec2::new(x, y) / z } else { Vec2::ZERO };
            let steepness = slope.length();
            if steepness > STEEPEST { slope * (STEEPEST / steepness) } else { slope }
        };
        let texels = (0..image.width * image.height).into_par_iter().map(slope).collect();
        let slopes =
            Slopes { size: [image.width, image.height], wrap: normal.wrap, texels, place: places.normal };
        Some(Texels { size, slopes, roughness, factor, place: places.roughness })
    }
}

/// Returns the texels that a side of the square crosses, along u and v.
fn density(image: &ImageFile, place: DAffine2) -> [f64; 2] {
    let size = DVec2::new(image.width as f64, image.height as f64);
    [place.matrix2.x_axis, place.matrix2.y_axis].map(|axis| (axis * size).abs().max_element())
}

fn is_identity(place: DAffine2) -> bool {
    place.abs_diff_eq(DAffine2::IDENTITY, 1e-6)
}

/// Returns the four texels around a point, with their bilinear weights.
fn corners(size: [usize; 2], wrap: [Wrap; 2], uv: DVec2) -> [(f32, usize); 4] {
    let place = uv * DVec2::new(size[0] as f64, size[1] as f64) - 0.5;
    let (corner, part) = (place.floor(), (place - place.floor()).as_vec2());
    let column = |i: i64| wrap[0].index(corner.x as i64 + i, size[0]);
    let row = |j: i64| wrap[1].index(corner.y as i64 + j, size[1]) * size[0];
    [
        ((1.0 - part.x) * (1.0 - part.y), row(0) + column(0)),
        (part.x * (1.0 - part.y), row(0) + column(1)),
        ((1.0 - part.x) * part.y, row(1) + column(0)),
        (part.x * part.y, row(1) + column(1)),
    ]
}

impl Slopes {
    /// Returns the slope at a point.
    fn at(&self, uv: DVec2) -> Vec2 {
        let parts = corners(self.size, self.wrap, self.place.transform_point2(uv));
        parts.iter().map(|(weight, k)| *weight * self.texels[*k]).sum()
    }

    /// Returns the slopes around a texel, row by row.
    fn near(&self, k: usize) -> [[Vec2; 3]; 3] {
        let [width, height] = self.size;
        let columns = [-1, 0, 1].map(|i| self.wrap[0].index((k % width) as i64 + i, width));
        let rows = [-1, 0, 1].map(|j| self.wrap[1].index((k / width) as i64 + j, height) * width);
        rows.map(|row| columns.map(|column| self.texels[row + column]))
    }
}

/// Places along a side of a texel, from its center: ¼ ± 1/(4√3), on both sides.
const PLACES: [f32; 4] = [-0.394_337_57, -0.105_662_43, 0.105_662_43, 0.394_337_57];

impl Texels {
    /// Returns the slope at a point.
    pub(super) fn slope(&self, uv: DVec2) -> Vec2 {
        self.slopes.at(uv)
    }

    /// Returns occlusion, roughness times its factor, and metallic at a point.
    pub(super) fn surface(&self, uv: DVec2) -> [f32; 3] {
        let Some(map) = &self.roughness else { return [1.0, self.factor, 1.0] };
        let image = map.image.as_ref();
        let parts = corners([image.width, image.height], map.wrap, self.place.transform_point2(uv));
        let [r, g, b] = image.colors().map(|plane| parts.iter().map(|(w, k)| w * plane[*k]).sum::<f32>());
        [r, (g * self.factor).clamp(0.0, 1.0), b]
    }

    /// Returns occlusion, roughness and metallic of a texel.
    pub(super) fn texel(&self, k: usize) -> [f32; 3] {
        if let Some(map) = &self.roughness
            && self.size == [map.image.width, map.image.height]
            && is_identity(self.place)
        {
            let [r, g, b] = map.image.colors().map(|plane| plane[k]);
            return [r, (g * self.factor).clamp(0.0, 1.0), b];
        }
        self.surface(self.within(k, Vec2::ZERO))
    }

    /// Returns the slopes in the square of a texel.
    ///
    /// By the 2 × 2 Gauss rule in each quarter, which is exact between four texels of the normal
    /// map, as the mean and the covariance are quadratic there along each axis.
    pub(super) fn spread(&self, k: usize) -> Spread {
        let places: [Vec2; 16] = std::array::from_fn(|at| Vec2::new(PLACES[at % 4], PLACES[at / 4]));
        let mixed = |slope: &dyn Fn(Vec2) -> Vec2| {
            Spread::mixed(&places.map(|place| (1.0, Spread::point(slope(place)))))
        };
        if self.size != self.slopes.size || !is_identity(self.slopes.place) {
            return mixed(&|place| self.slope(self.within(k, place)));
        }
        let near = self.slopes.near(k);
        mixed(&|place| {
            let [i, j] = place.to_array().map(|t| if t < 0.0 { 0 } else { 2 });
            let Vec2 { x, y } = place.abs();
            near[1][1].lerp(near[1][i], x).lerp(near[j][1].lerp(near[j][i], x), y)
        })
    }

    /// Returns a point of a texel, given from its center.
    fn within(&self, k: usize, place: Vec2) -> DVec2 {
        let [width, height] = self.size;
        let point = DVec2::new((k % width) as f64 + 0.5, (k / width) as f64 + 0.5) + place.as_dvec2();
        point / DVec2::new(width as f64, height as f64)
    }
}
