//! Wallpaper with a star in some of its cells.

use asperity_noise::{Field, Perlin, WhiteNoise, filtered_fraction};
use core::f32::consts::{PI, TAU};
use glam::Vec2;

use crate::error::ShadingError;
use crate::math::{atan2, cos, sin, sqrt};
use crate::parameter::{as_share, parameters, positive, within};
use crate::pixel::Footprint;

parameters! {
    /// The parameters of a [`StarWallpaper`]. The defaults are the stars of the lecture.
    pub struct StarWallpaperParameters of StarWallpaper {
        /// The number of points of a star, from 2 to 1000. Default 5.
        points: u32 = 5;
        /// The radius of the notches, positive. Default 0.01.
        r_min: f32 = 0.01, positive;
        /// The radius of the points, at least `r_min` and at most 0.4 of a cell: a larger star
        /// could reach past the neighboring cells. Default 0.03.
        r_max: f32 = 0.03;
        /// The number of cells per unit, positive. Default 10.
        cells: f32 = 10.0, positive;
        /// The probability that a cell has a star, within `[0, 1]`. Default 0.55.
        chance: f32 = 0.55, as_share;
        /// Random seed.
        seed: u32 = 0;
    }
}

/// Stars scattered over a grid of cells.
///
/// ```text
/// a cell has a star with the given chance; its center is within 0.6 of a cell of the cell center, along both axes
/// star: n points at radius r_max, notches at r_min between them
/// ```
///
/// Each point tests the stars of its cell and the eight neighboring cells. The listing is corrected
/// in two places, which [`as_listed`](Self::as_listed) keeps for comparison. First, a fraction of a
/// turn is used as an angle in radians, which makes the notches shallow. Second, the chance and the
/// offsets come from lattice noise, which is not uniform and does not match the chance. A third
/// error, `CELLSIZE (1/NCELLS)`, is an integer division with result 0, which leaves nothing to
/// reproduce.
///
/// Cohen, *Procedural Bump Mapping and Noise*, listing `wallpaper`.
///
/// ```
/// use asperity_shading::Footprint;
/// use asperity_shading::glam::Vec2;
/// use asperity_shading::texture::StarWallpaper;
///
/// let wallpaper = StarWallpaper::default();
/// // From afar, the fraction of stars.
/// assert_eq!(wallpaper.coverage(Vec2::new(0.3, 0.8), Footprint::from_width(10.0)), wallpaper.mean());
/// // Up close it is star or ground.
/// let share = wallpaper.coverage(Vec2::new(0.3, 0.8), Footprint::from_width(0.0));
/// assert!(share == 0.0 || share == 1.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StarWallpaper {
    parameters: StarWallpaperParameters,
}

/// Maximum offset of the center of a star from the center of its cell, in cells.
const SCATTER: f32 = 0.6;

/// The stars of the lecture.
impl Default for StarWallpaper {
    fn default() -> Self {
        Self { parameters: StarWallpaperParameters::default() }
    }
}

impl StarWallpaper {
    /// Creates the wallpaper of these parameters.
    ///
    /// # Errors
    /// [`ShadingError`] with a parameter that is out of its range.
    pub fn new(parameters: StarWallpaperParameters) -> Result<Self, ShadingError> {
        let StarWallpaperParameters { points, r_min, r_max, cells, .. } = parameters;
        // Points are few, so the cast is exact; invalid counts are rejected anyway.
        within("points", points as f32, [2.0, 1000.0])?;
        parameters.check()?;
        within("r_max", r_max, [r_min, 0.4 / cells])?;
        Ok(Self { parameters })
    }

    /// The fraction of the wall covered by stars, if they do not overlap.
    ///
    /// ```text
    /// chance · cells² · n r_min r_max sin(π/n)
    /// ```
    ///
    /// Overlaps make the true fraction smaller: by 2 % relative for the stars of the lecture,
    /// measured.
    #[must_use]
    pub fn mean(&self) -> f32 {
        let n = self.parameters.points as f32;
        (self.parameters.chance
            * self.parameters.cells
            * self.parameters.cells
            * n
            * self.parameters.r_min
            * self.parameters.r_max
            * sin(PI / n))
        .min(1.0)
    }

    /// Points, radii, cells, chance, mean, half the angle between two points as a direction, that
    /// angle; seeds.
    ///
    /// The seeds are those of the lattices.
    pub(crate) fn parts(&self) -> ([f32; 9], [u32; 3]) {
        let angle = TAU / self.parameters.points as f32;
        let [x, y] = [cos(0.5 * angle), sin(0.5 * angle)];
        let StarWallpaperParameters { r_min, r_max, cells, chance, .. } = self.parameters;
        let seeds = [0, 1, 2].map(|k| self.parameters.seed.wrapping_mul(3).wrapping_add(k));
        ([self.parameters.points as f32, r_min, r_max, cells, chance, self.mean(), x, y, angle], seeds)
    }

    /// The fraction of a pixel covered by stars, at a point of the texture seen through this
    /// footprint.
    ///
    /// The edge of a star is a ramp, half as wide as the footprint in each of its quarters. As the
    /// footprint approaches the size of a star, the wall becomes its mean. A footprint of 0 returns
    /// 0 or 1. Non-finite coordinates return 0.
    #[must_use]
    pub fn coverage(&self, uv: Vec2, footprint: Footprint) -> f32 {
        if !uv.is_finite() {
            return 0.0;
        }
        let footprint = footprint.width();
        let far = filtered_fraction(footprint, 0.75 / self.parameters.r_max);
        if far >= 1.0 {
            return self.mean();
        }
        let white = |cell: Vec2, k: u32| {
            WhiteNoise::new(self.parameters.seed.wrapping_mul(3).wrapping_add(k)).value(cell)
        };
        let mut bare = 1.0;
        self.for_neighbors(uv, |cell| {
            if 0.5 + 0.5 * white(cell, 0) < self.parameters.chance {
                let offset = SCATTER * Vec2::new(white(cell, 1), white(cell, 2));
                let p = uv - (cell + offset) / self.parameters.cells;
                // Out of reach of every ramp.
                if p.dot(p) < (self.parameters.r_max + footprint) * (self.parameters.r_max + footprint) {
                    bare *= 1.0 - self.ramped(p, footprint);
                }
            }
        });
        let near = 1.0 - bare;
        near + far * (self.mean() - near)
    }

    /// The listing as printed, with [`Perlin`] as noise: whether at least one star covers a
    /// point.
    ///
    /// The noise is the `noise` of the listing, `0.5 + 0.5 n`. The angle within a star runs to half
    /// a unit instead of half the angle of a star.
    #[must_use]
    pub fn as_listed(&self, uv: Vec2) -> bool {
        let mut covered = false;
        if uv.is_finite() {
            let noise = |x: f32, y: f32| Perlin::new(self.parameters.seed).value(Vec2::new(x, y));
            self.for_neighbors(uv, |middle| {
                let cell = middle - 0.5;
                if 0.5 + 0.5 * noise(3.0 * cell.x - 9.5, 7.0 * cell.y + 7.5) < self.parameters.chance {
                    let offset =
                        Vec2::new(noise(cell.x + 0.5, cell.y + 0.5), noise(cell.x + 3.5, cell.y + 8.5));
                    let center = (middle + SCATTER * offset) / self.parameters.cells;
                    covered |= self.inside(uv - center, self.parameters.points as f32 / TAU) >= 0.0;
                }
            });
        }
        covered
    }

    /// The fraction of a pixel covered by a star around 0: the mean of ramps over its quarters.
    fn ramped(&self, p: Vec2, footprint: f32) -> f32 {
        let quarter = 0.25 * footprint;
        if quarter == 0.0 {
            return if self.inside(p, 1.0) >= 0.0 { 1.0 } else { 0.0 };
        }
        let mut sum = 0.0;
        for x in [-quarter, quarter] {
            for y in [-quarter, quarter] {
                sum += (0.5 + self.inside(p + Vec2::new(x, y), 1.0) / (2.0 * quarter)).clamp(0.0, 1.0);
            }
        }
        0.25 * sum
    }

    /// The centers of the cell and its neighbors, in cells.
    fn for_neighbors(&self, uv: Vec2, mut visit: impl FnMut(Vec2)) {
        let cell = (uv * self.parameters.cells).floor();
        for i in [-0.5, 0.5, 1.5] {
            for j in [-0.5, 0.5, 1.5] {
                visit(cell + Vec2::new(i, j));
            }
        }
    }

    /// Signed distance of `p` to the edge of a star around 0, negative outside.
    ///
    /// The angle from its point is multiplied by `listed`, which is 1 for a star.
    fn inside(&self, p: Vec2, listed: f32) -> f32 {
        let angle = TAU / self.parameters.points as f32;
        let turn = (atan2(p.x, p.y) + PI) / angle;
        let fraction = turn - (turn as u32) as f32;
        let a = fraction.min(1.0 - fraction) * angle * listed;
        let tip = Vec2::new(self.parameters.r_max, 0.0);
        let edge = self.parameters.r_min * Vec2::new(cos(0.5 * angle), sin(0.5 * angle)) - tip;
        let r = sqrt(p.dot(p));
        edge.perp_dot(r * Vec2::new(cos(a), sin(a)) - tip) / sqrt(edge.dot(edge))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stars_continue_across_cell_borders() {
        let wall = StarWallpaper::default();
        // Points on either side of a line between two cells differ where the edge of a star lies
        // between them, and along a star that is cut there. Of 4500 pairs 91 differ, and 314 if
        // each cell draws only its own star.
        let differ = |covered: &dyn Fn(Vec2) -> bool| {
            let of = |k: u32, side: f32| {
                covered(Vec2::new((k / 500 + 1) as f32 / 10.0 + side, (k % 500) as f32 / 500.0))
            };
            (0..4500).filter(|&k| of(k, -1e-4) != of(k, 1e-4)).count()
        };
        let listed = differ(&|uv| wall.as_listed(uv));
        let corrected = differ(&|uv| wall.coverage(uv, Footprint::from_width(0.0)) > 0.5);
        assert!(listed <= 9 && corrected <= 9, "{listed} {corrected}");
    }

    #[test]
    fn star_has_points_and_notches_shallow_as_listed() {
        let wall = StarWallpaper::default();
        // The angle of the listing starts at the negative second axis.
        let at = |r: f32, turn: f32, listed: f32| {
            let angle = turn * TAU / 5.0 - PI;
            wall.inside(r * Vec2::new(angle.sin(), angle.cos()), listed)
        };
        for k in 0..5 {
            let k = k as f32;
            assert!(at(0.0299, k, 1.0) > 0.0 && at(0.0301, k, 1.0) < 0.0, "point {k}");
            assert!(at(0.0099, k + 0.5, 1.0) > 0.0 && at(0.0101, k + 0.5, 1.0) < 0.0, "notch {k}");
        }
        // A notch ends where the edge reaches half a radian instead of half the angle of a star, at
        // 0.0113.
        assert!(at(0.0112, 0.5, 5.0 / TAU) > 0.0 && at(0.0114, 0.5, 5.0 / TAU) < 0.0);
    }
}
