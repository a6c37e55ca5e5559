//! Ridges along the edges of a polygon.

use glam::{Vec2, Vec3};

use crate::direction;
use crate::error::ShadingError;
use crate::math::sqrt;
use crate::parameter::{parameters, positive, within};

parameters! {
    /// The parameters of a [`Bevel`]: `plateau` is less than `ridge`, and no slope is beyond
    /// `f32::MAX/(4 max(1, ridge))`, so heights are finite.
    pub struct BevelParameters of Bevel {
        /// The width of the plateau, at least 0. Default 0.02.
        plateau: f32 = 0.02;
        /// The width of the whole ridge: plateau and flank. Default 0.1.
        ridge: f32 = 0.1, positive;
        /// The slope where the flank begins, positive downward. Default 0.
        top: f32 = 0.0;
        /// The slope where the flank ends, positive downward. Default 1.
        bottom: f32 = 1.0;
    }
}

/// The profile of a ridge along an edge: a plateau next to the edge, then a flank down to the face.
///
/// ```text
/// distance d to the edge   0 … plateau          height H, slope 0
///                          plateau … ridge      slope from `top` to `bottom`, linearly; the height its integral
///                          ridge …              height 0, slope 0
/// H = (top + bottom)/2 · (ridge − plateau)
/// ```
///
/// Slopes are the decrease of the height with the distance from the edge; negative slopes make a
/// groove. Widths are in the unit of the distance. The [`Edge`] of the polygon contains the
/// distance and the direction away from it. The gradient of the height is the slope along this
/// direction.
///
/// Cohen, *Procedural Bump Mapping and Noise*, "Bevelling Effects": ridge and plateau widths,
/// slopes at the top and the bottom of the ridge, perpendicular to the closest edge. The lecture
/// does not specify the ridge function; this one has the smallest curvature for its four
/// parameters.
///
/// ```
/// use asperity_shading::texture::{Bevel, BevelParameters, Edge};
/// use asperity_shading::glam::Vec2;
///
/// let bevel = Bevel::new(BevelParameters { plateau: 0.02, ridge: 0.1, top: 0.0, bottom: 1.0 })?;
/// let tile = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
/// let edge = Edge::nearest(&tile, Vec2::new(0.5, 0.06)).unwrap();
/// let [height, slope] = bevel.profile(edge.distance);
/// // Halfway down the flank, which descends away from the edge below.
/// assert!((slope + 0.5).abs() < 1e-6 && height > 0.0 && edge.away == Vec2::Y);
/// # Ok::<(), asperity_shading::ShadingError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bevel {
    parameters: BevelParameters,
    flank: f32,
}

impl Bevel {
    /// Creates the ridge of these parameters.
    ///
    /// # Errors
    /// [`ShadingError`] with the first parameter that is out of its range.
    pub fn new(parameters: BevelParameters) -> Result<Self, ShadingError> {
        parameters.check()?;
        let BevelParameters { plateau, ridge, top, bottom } = parameters;
        // A plateau as wide as the ridge leaves no flank.
        within("plateau", plateau, [0.0, ridge.next_down()])?;
        // Sums of two slopes, and their products with a width, stay in range.
        let steepest = 0.25 * f32::MAX / ridge.max(1.0);
        for (parameter, slope) in [("top", top), ("bottom", bottom)] {
            within(parameter, slope, [-steepest, steepest])?;
        }
        Ok(Self { parameters, flank: ridge - plateau })
    }

    /// Width of the flank.
    pub(crate) const fn flank(&self) -> f32 {
        self.flank
    }

    /// Height and its derivative by the distance, at a distance from the edge; flat for NaN.
    #[must_use]
    pub fn profile(&self, distance: f32) -> [f32; 2] {
        let x = (distance - self.parameters.plateau) / self.flank;
        if x <= 0.0 {
            return [0.5 * (self.parameters.top + self.parameters.bottom) * self.flank, 0.0];
        }
        if x < 1.0 {
            let slope = self.parameters.top + (self.parameters.bottom - self.parameters.top) * x;
            [0.5 * (1.0 - x) * (slope + self.parameters.bottom) * self.flank, -slope]
        } else {
            // NaN too.
            [0.0, 0.0]
        }
    }

    /// The facets between two distances from the edge: fraction and slope of each, as seen by a
    /// pixel.
    ///
    /// The fractions add up to 1. A part of the flank is two facets, by Gauss quadrature. The pixel
    /// shows the mean of a lighting model over them, which differs from the model at the mean
    /// slope. An empty or NaN interval is replaced by its middle.
    ///
    /// ```
    /// use asperity_shading::texture::{Bevel, BevelParameters};
    ///
    /// let bevel = Bevel::new(BevelParameters::default())?;
    /// let (mut shares, mut slope) = (0.0, 0.0);
    /// bevel.facets(0.0, 0.2, |share, s| {
    ///     shares += share;
    ///     slope += share * s;
    /// });
    /// // The mean slope is the decrease of the height over the interval.
    /// let fall = (bevel.profile(0.2)[0] - bevel.profile(0.0)[0]) / 0.2;
    /// assert!((shares - 1.0_f32).abs() < 1e-6 && (slope - fall).abs() < 1e-6);
    /// # Ok::<(), asperity_shading::ShadingError>(())
    /// ```
    pub fn facets(&self, low: f32, high: f32, mut visit: impl FnMut(f32, f32)) {
        let width = high - low;
        if !(width > 0.0 && width.is_finite()) {
            let [_, slope] = self.profile(0.5 * (low + high));
            return visit(1.0, slope);
        }
        let within = |begin: f32, end: f32| {
            let [from, to] = [begin.max(low), end.min(high)];
            [from, (to - from).max(0.0)]
        };
        let [from, flank] = within(self.parameters.plateau, self.parameters.plateau + self.flank);
        if flank > 0.0 {
            for at in GAUSS {
                let [_, slope] = self.profile(from + at * flank);
                visit(0.5 * flank / width, slope);
            }
        }
        visit((1.0 - flank / width).max(0.0), 0.0);
    }

    /// The mean height between two distances from the edge, the first not below 0.
    ///
    /// An empty or NaN interval is replaced by its middle.
    pub(crate) fn mean_height(&self, low: f32, high: f32) -> f32 {
        let width = high - low;
        if !(width > 0.0 && width.is_finite()) {
            return self.profile(0.5 * (low + high))[0];
        }
        let cut = |begin: f32, end: f32| [begin.max(low), (end.min(high) - begin.max(low)).max(0.0)];
        let [_, plateau] = cut(0.0, self.parameters.plateau);
        let [from, flank] = cut(self.parameters.plateau, self.parameters.plateau + self.flank);
        let heights = GAUSS.map(|at| self.profile(from + at * flank)[0]);
        (plateau * self.profile(0.0)[0] + 0.5 * flank * (heights[0] + heights[1])) / width
    }

    /// The mean height of a whole square tile of side 1 whose edges have this ridge.
    pub(crate) fn mean_height_of_tile(&self) -> f32 {
        rings().map(|[low, high, share]| share * self.mean_height(low, high)).sum()
    }

    /// The minimum and the maximum of the ridge; the ground is 0.
    pub(crate) fn range(&self) -> [f32; 2] {
        // The height has an extremum where the slope changes its sign.
        let turn = self.parameters.top / (self.parameters.top - self.parameters.bottom);
        let turn = if turn > 0.0 && turn < 1.0 { turn } else { 0.0 };
        let heights = [self.profile(0.0)[0], self.profile(self.parameters.plateau + turn * self.flank)[0]];
        heights.into_iter().fold([0.0, 0.0], |[low, high], height| [low.min(height), high.max(height)])
    }

    /// The facets of a whole square tile of side 1 whose edges have this ridge, in rings around its
    /// center.
    pub(crate) fn tile(&self, mut visit: impl FnMut(f32, f32)) {
        for [low, high, ring] in rings() {
            self.facets(low, high, |share, slope| visit(ring * share, slope));
        }
    }
}

/// The two Gauss points in an interval of length 1.
const GAUSS: [f32; 2] = [0.211_324_87, 0.788_675_1];

/// Rings around the center of a square tile of side 1: distances from its edge, and fraction of
/// each.
fn rings() -> impl Iterator<Item = [f32; 3]> {
    (0..16_u8).map(|k| {
        let [low, high] = [k, k + 1].map(|k| f32::from(k) / 32.0);
        let within = |d: f32| (1.0 - 2.0 * d) * (1.0 - 2.0 * d);
        [low, high, within(low) - within(high)]
    })
}

/// The closest edge of a polygon to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// Distance to it, at least 0.
    pub distance: f32,
    /// The unit direction from its closest point to the point; perpendicular to the edge for a
    /// point on it.
    pub away: Vec2,
}

impl Edge {
    /// The closest edge of the polygon with these corners, for a point inside or outside.
    ///
    /// The corners may have either orientation.
    ///
    /// `None` for fewer than two corners, and if all distances are NaN.
    #[must_use]
    pub fn nearest(corners: &[Vec2], p: Vec2) -> Option<Self> {
        let mut nearest: Option<Self> = None;
        let mut from = *corners.last().filter(|_| corners.len() > 1)?;
        for &to in corners {
            let edge = Self::of(from, to, p);
            if edge.distance.is_finite() && nearest.is_none_or(|nearest| edge.distance < nearest.distance) {
                nearest = Some(edge);
            }
            from = to;
        }
        nearest
    }

    /// The edge between two corners.
    fn of(from: Vec2, to: Vec2, p: Vec2) -> Self {
        let (along, offset) = (to - from, p - from);
        let length = along.dot(along);
        let t = if length > 0.0 { (offset.dot(along) / length).clamp(0.0, 1.0) } else { 0.0 };
        let apart = offset - t * along;
        let distance = sqrt(apart.dot(apart));
        // Twice, because a distance near 1e-22 has lost digits: its square is subnormal.
        let across = || direction::along(along.perp().extend(0.0)).map_or(Vec2::Y, Vec3::truncate);
        let away = (apart / distance).try_normalize().unwrap_or_else(across);
        Self { distance, away }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    fn bevel_of(plateau: f32, ridge: f32, top: f32, bottom: f32) -> Result<Bevel, ShadingError> {
        Bevel::new(BevelParameters { plateau, ridge, top, bottom })
    }

    #[test]
    fn profile_is_continuous_and_the_slopes_integral() {
        for (top, bottom) in [(0.0, 1.0), (1.0, 0.0), (0.4, 0.4), (-0.7, 0.2)] {
            let bevel = bevel_of(0.1, 0.6, top, bottom).unwrap();
            let mut integral = 0.0;
            let n = 1000;
            for i in (0..n).rev() {
                let d = 0.7 * (i as f32 + 0.5) / n as f32;
                let [height, slope] = bevel.profile(d);
                integral -= slope * 0.7 / n as f32;
                assert_abs_diff_eq!(height, integral, epsilon = 1e-3, "{top}, {bottom}, {d}");
            }
            assert_abs_diff_eq!(bevel.profile(0.1 + 1e-6)[1], -top, epsilon = 1e-4);
            assert_abs_diff_eq!(bevel.profile(0.6 - 1e-6)[1], -bottom, epsilon = 1e-4);
        }
    }

    #[test]
    fn points_on_edges_of_any_length_have_a_unit_direction() {
        for length in [f32::from_bits(1), 1e-40, 1e-23, 1e-20, 1.0, 1e18] {
            let corners = [Vec2::ZERO, length * Vec2::new(0.8, 0.6)];
            for p in [Vec2::ZERO, corners[1]] {
                let edge = Edge::nearest(&corners, p).unwrap();
                assert_eq!(edge.distance, 0.0, "{length}");
                assert_abs_diff_eq!(edge.away.length(), 1.0, epsilon = 2e-7, "{length}");
            }
        }
    }

    #[test]
    fn mean_height_matches_sampling() {
        for (top, bottom) in [(0.0, 1.0), (1.0, 0.0), (-0.7, 0.2), (0.7, -0.9)] {
            let bevel = bevel_of(0.05, 0.3, top, bottom).unwrap();
            let [least, most] = bevel.range();
            for [low, high] in [[0.0, 0.02], [0.01, 0.2], [0.1, 0.9], [0.4, 0.5]] {
                let places = (0..4000_u16).map(|k| low + (high - low) * (f32::from(k) + 0.5) / 4000.0);
                let heights: f32 = places.map(|d| bevel.profile(d)[0]).sum();
                let mean = bevel.mean_height(low, high);
                // The rule is exact for heights, which are of the second degree; sums of 4000
                // numbers below 0.2 are rounded.
                assert_abs_diff_eq!(
                    mean,
                    heights / 4000.0,
                    epsilon = 3e-6,
                    "{top}, {bottom}: {low} to {high}"
                );
                assert!((least - 1e-7..=most + 1e-7).contains(&mean), "{least}, {mean}, {most}");
            }
            // Half of a tile, from the middle of an edge: triangles of rings.
            let side = 512_u16;
            let middle = |k: u16| (f32::from(k) + 0.5) / f32::from(side);
            let mut sum = 0.0_f64;
            for k in 0..u32::from(side) * u32::from(side) {
                let [x, y] = [k % u32::from(side), k / u32::from(side)].map(|k| middle(k as u16));
                let edge = x.min(1.0 - x).min(y).min(1.0 - y);
                sum += f64::from(bevel.profile(edge)[0]);
            }
            let mean = (sum / f64::from(side).powi(2)) as f32;
            // Rings are uniform: the smaller weight of a fraction of 1/16 at the inner side, of
            // heights that change by 0.2.
            assert_abs_diff_eq!(bevel.mean_height_of_tile(), mean, epsilon = 1e-3);
        }
    }

    #[test]
    fn profile_of_nan_is_flat() {
        let bevel = bevel_of(0.1, 0.6, 0.3, 0.9).unwrap();
        assert_eq!(bevel.profile(f32::NAN), [0.0, 0.0]);
        assert_eq!(bevel.profile(f32::INFINITY), [0.0, 0.0]);
        assert_eq!(bevel.profile(-1.0), bevel.profile(0.0));
    }

    #[test]
    fn steepest_ridges_have_finite_heights() {
        for ridge in [f32::MIN_POSITIVE, 1e-3, 1.0, 7.3, 1e19, f32::MAX] {
            let steepest = 0.25 * f32::MAX / ridge.max(1.0);
            for (top, bottom) in [(steepest, steepest), (-steepest, steepest), (steepest, -steepest)] {
                let bevel = bevel_of(0.0, ridge, top, bottom).unwrap();
                for x in [-1.0, 0.0, 0.1, 0.5, 0.9, 1.0] {
                    let [height, slope] = bevel.profile(x * ridge);
                    assert!(height.is_finite() && slope.is_finite(), "{bevel:?} at {x}: {height}, {slope}");
                }
            }
            assert!(bevel_of(0.0, ridge, 1.01 * steepest, 0.0).is_err(), "{ridge}");
            assert!(bevel_of(0.0, ridge, 0.0, -1.01 * steepest).is_err(), "{ridge}");
        }
    }

    #[test]
    fn nearest_edge_is_found_from_both_sides() {
        let square = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
        for (x, y, distance, away) in
            [(0.9, 0.4, 0.1, Vec2::NEG_X), (-3.0, -4.0, 5.0, Vec2::new(-0.6, -0.8)), (0.5, 0.0, 0.0, Vec2::Y)]
        {
            let edge = Edge::nearest(&square, Vec2::new(x, y)).unwrap();
            assert_abs_diff_eq!(edge.distance, distance, epsilon = 1e-6, "{x}, {y}");
            assert_abs_diff_eq!(edge.away, away, epsilon = 1e-6, "{x}, {y}");
        }
        assert_eq!(Edge::nearest(&square, Vec2::NAN), None);
        assert_eq!(Edge::nearest(&square[..1], Vec2::ZERO), None);
        assert_eq!(Edge::nearest(&[], Vec2::ZERO), None);
    }
}
