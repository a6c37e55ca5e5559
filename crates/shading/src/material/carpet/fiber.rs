//! Fibers: threads for close-up views.

use glam::{Vec2, Vec3};

use crate::error::ShadingError;
use crate::material::segment::{MOST, Segments};
use crate::material::surface_point::TextureGradients;
use crate::math::floor;
use crate::parameter::{as_share, as_size, direction_in_plane, parameters, range};
use crate::pixel::{Footprint, PixelEllipse};

parameters! {
    /// The parameters of [`Fibers`]. Lengths are in texture coordinates.
    pub struct FibersParameters of Fibers {
        /// The length of a fiber, within `[10⁻⁶, 10⁶]`. Default 0.004.
        fiber_length: f32 = 0.004, as_size;
        /// Its width over its length, within `[0.01, 0.3]`. Default 0.12.
        fiber_width: f32 = 0.12, range([0.01, 0.3]);
        /// Bend of a fiber: displacement of its ends to the side over its length, within `[0,
        /// 0.3]`. Default 0.15.
        fiber_bend: f32 = 0.15, range([0.0, 0.3]);
        /// The mean direction of the fibers. Default (1, 0).
        fiber_direction: Vec2 = Vec2::X;
        /// Spread around the direction: 0 is combed, 1 all directions. Default 0.6.
        fiber_spread: f32 = 0.6, as_share;
        /// Contrast: variation in brightness, and darkening towards roots and sides, within `[0,
        /// 1]`. Default 0.6.
        fiber_contrast: f32 = 0.6, as_share;
        /// Random seed.
        seed: u32 = 1;
    }
}

/// Short bent fibers that overlap, for close-up views of a carpet.
///
/// A fiber is a ridge with round ends along a hashed segment of the texture, bent to the side by a
/// parabola. Where several overlap, the highest is visible. Each has a random brightness. It is
/// darker towards its root and its sides, and in the gaps:
///
/// ```text
/// factor = (1 + contrast (b − 1))/mean,   b = (½ + ½ own) (0.35 + 0.65 rise),   b = 0.1 in gaps
/// rise   = (1 − t⁸ − s²) (t + 1)/2,   s across and t along, −1 … 1
/// ```
///
/// The mean of the factor over the surface is 1: `mean` is measured at construction, to 1 %. Where
/// pixels become as wide as fibers the factor fades to 1 and the slope to 0. A carpet of
/// threads times this factor therefore keeps its far
/// color and shows threads up close.
///
/// Nilsson 2008, §6.1, describes the problem and leaves it open.
///
/// ```
/// use asperity_shading::Footprint;
/// use asperity_shading::material::{Fibers, FibersParameters};
/// use asperity_shading::glam::Vec2;
///
/// let fibers = Fibers::new(FibersParameters::default())?;
/// let near = fibers.sample(Vec2::new(0.31, 0.17), Footprint::from_width(1e-6));
/// assert!(near.factor > 0.0);
/// assert_eq!(fibers.sample(Vec2::new(0.31, 0.17), Footprint::from_width(1.0)).factor, 1.0);
/// # Ok::<(), asperity_shading::ShadingError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fibers {
    parameters: FibersParameters,
    segments: Segments,
    half: f32,
    mean: f32,
    mean_height: f32,
    mean_square_slope: f32,
}

/// The fiber at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fiber {
    /// Factor of the colors; its mean is 1.
    pub factor: f32,
    /// The unit direction of the fiber in texture coordinates, from root to tip, for its highlight.
    ///
    /// The mean direction of all fibers in gaps and where the pixel does not resolve fibers.
    pub direction: Vec2,
    /// Half its width times 1 − t⁸ − s², in texture coordinates; 0 in gaps.
    pub height: f32,
    /// The slope of that height.
    pub slope: Vec2,
}

/// The brightness between fibers.
const GAP: f32 = 0.1;

impl Fibers {
    /// Creates fibers from these parameters; their mean is measured at 16384 points.
    ///
    /// # Errors
    /// [`ShadingError`] with the first parameter that is out of its range, or for a
    /// `fiber_direction` that is zero or not finite.
    pub fn new(parameters: FibersParameters) -> Result<Self, ShadingError> {
        parameters.check()?;
        let (p, length) = (&parameters, parameters.fiber_length);
        // The smallest valid cell: fibers must not reach farther than a cell from their midpoints.
        let cell = length * (0.5 + p.fiber_bend + 0.5 * p.fiber_width);
        let segments = Segments {
            cell,
            length,
            cover: MOST as f32,
            direction: direction_in_plane("fiber_direction", p.fiber_direction)?,
            spread: p.fiber_spread,
            seed: p.seed,
        };
        let half = 0.5 * length * p.fiber_width;
        let mut fibers =
            Self { parameters, segments, half, mean: 1.0, mean_height: 0.0, mean_square_slope: 0.0 };
        fibers.measure();
        Ok(fibers)
    }

    /// The segments of the fibers, the half width of a fiber, and the mean brightness and mean
    /// square slope.
    pub(crate) const fn parts(&self) -> (&Segments, [f32; 3]) {
        (&self.segments, [self.half, self.mean, self.mean_square_slope])
    }

    /// The fiber at a point of the texture, over a pixel of the plane of texture coordinates.
    ///
    /// The factor is 1 where a coordinate is not finite or beyond 2²³ cells.
    #[must_use]
    pub fn sample(&self, uv: Vec2, footprint: Footprint) -> Fiber {
        let kept = footprint.kept(0.25 / self.half);
        let place = uv / self.segments.cell;
        if kept <= 0.0 || !uv.is_finite() || place.abs().max_element() >= 8_388_608.0 {
            let (direction, height) = (self.segments.direction, self.mean_height);
            return Fiber { factor: 1.0, direction, height, slope: Vec2::ZERO };
        }
        let near = self.top(uv);
        Fiber {
            factor: 1.0 + kept * (near.factor / self.mean - 1.0),
            height: self.mean_height + kept * (near.height - self.mean_height),
            slope: near.slope * kept,
            ..near
        }
    }

    /// The fiber at a surface point, its surface gradient, and the slope variance removed by the
    /// footprint.
    ///
    /// The variance is along each axis.
    ///
    /// The gradient uses the slope in the texture, regardless of the scale of the texture.
    pub(crate) fn surface(
        &self,
        uv: Vec2,
        texture: &TextureGradients,
        pixel: &PixelEllipse,
    ) -> (Fiber, Vec3, f32) {
        let footprint = texture.pixel(pixel).long();
        let (fiber, kept) = (self.sample(uv, footprint), footprint.kept(0.25 / self.half));
        let gradient = texture.of(fiber.slope).normalize_or_zero() * fiber.slope.length();
        (fiber, gradient, 0.5 * self.mean_square_slope * (1.0 - kept * kept))
    }

    /// The highest fiber, with its brightness for the factor.
    fn top(&self, uv: Vec2) -> Fiber {
        let p = &self.parameters;
        let brightness = |b: f32| 1.0 + p.fiber_contrast * (b - 1.0);
        let direction = self.segments.direction;
        let mut top = Fiber { factor: brightness(GAP), direction, height: 0.0, slope: Vec2::ZERO };
        let mut highest = f32::NEG_INFINITY;
        // The maximum displacement of the side of a bent fiber.
        let aside = p.fiber_bend * self.segments.length + self.half;
        self.segments.visit(uv, aside, |near| {
            let [own, bend] = near.random;
            let bend = (2.0 * bend - 1.0) * p.fiber_bend * self.segments.length;
            let t = near.along;
            let t2 = t * t;
            let t4 = t2 * t2;
            let s = (near.across - bend * t * t) / self.half;
            let crown = 1.0 - t4 * t4 - s * s;
            if crown <= 0.0 {
                return;
            }
            let rise = crown * 0.5 * (t + 1.0);
            // Which fiber is on top, and which root is hidden, does not depend on the brightness.
            let spread = own * 618.034;
            let height = rise + (spread - floor(spread));
            if height > highest {
                highest = height;
                // The height half · (1 − t⁸ − s²) by s and t, where s depends on the distance
                // across and, through the bend, along.
                let by_s = -2.0 * s;
                let by_along = -2.0 * bend * t / (0.5 * self.segments.length);
                let by_end = -8.0 * self.half * t4 * t2 * t / (0.5 * self.segments.length);
                top = Fiber {
                    factor: brightness((0.5 + 0.5 * own) * (0.35 + 0.65 * rise)),
                    direction: near.direction,
                    height: self.half * crown,
                    slope: (near.direction.perp() + near.direction * by_along) * by_s
                        + near.direction * by_end,
                };
            }
        });
        top
    }

    /// Mean brightness, height and square slope over 128² points, one per square of a patch of
    /// cells.
    fn measure(&mut self) {
        const ACROSS: u16 = 128;
        let (mut sum, mut heights, mut squares) = (0.0, 0.0, 0.0);
        for i in 0..ACROSS {
            for j in 0..ACROSS {
                // Slightly more than a quarter of a cell apart, so positions in cells are evenly
                // distributed.
                let at = Vec2::new(f32::from(i) + 0.618 * f32::from(j % 7), f32::from(j))
                    * (0.2618 * self.segments.cell);
                let fiber = self.top(at);
                sum += fiber.factor;
                heights += fiber.height;
                squares += fiber.slope.length_squared();
            }
        }
        let count = f32::from(ACROSS) * f32::from(ACROSS);
        // A brightness is at least 1 − contrast and in gaps 0.1, so the mean is not 0.
        self.mean = (sum / count).max(1e-3);
        self.mean_height = heights / count;
        self.mean_square_slope = squares / count;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn fiber_mean_factor_is_one_at_every_footprint() {
        for spread in [0.0, 0.6, 1.0] {
            let fibers =
                Fibers::new(FibersParameters { fiber_spread: spread, ..Default::default() }).unwrap();
            let mut random = 7_u32;
            let mut uniform = || {
                random = random.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
                (random >> 8) as f32 / 16_777_216.0
            };
            for width in [0.0, 0.2 * fibers.half, fibers.half] {
                let mut sum = 0.0;
                for _ in 0..20_000 {
                    sum += fibers
                        .sample(
                            Vec2::new(uniform(), uniform()) * 400.0 * fibers.segments.cell,
                            Footprint::from_width(width),
                        )
                        .factor;
                }
                // Standard deviation 0.35: five standard errors are 1.2 %, and the measured mean
                // has 1 %.
                assert_abs_diff_eq!(sum / 20_000.0, 1.0, epsilon = 0.02, "{spread}, {width}");
            }
        }
    }

    #[test]
    fn fiber_ends_are_round() {
        // All along x, not bent and far apart.
        let parameters =
            FibersParameters { fiber_spread: 0.0, fiber_bend: 0.0, ..FibersParameters::default() };
        let mut fibers = Fibers::new(parameters).unwrap();
        fibers.segments.cover = 0.02;
        let (cell, half, mut seen) = (fibers.segments.cell, fibers.half, [0; 2]);
        for k in 0..1_600_000_u32 {
            let uv = Vec2::new((k % 400) as f32 * 0.25 * cell, (k / 400) as f32 * 0.05 * half);
            fibers.segments.visit(uv, half, |near| {
                let (t, s) = (near.along.abs(), near.across.abs() / half);
                let there = fibers.top(uv).slope != Vec2::ZERO;
                // Its half width is (1 − t⁸)^½: 0.998 at t = 0.5, and 0.58 at 0.95.
                if t < 0.5 && s < 0.99 {
                    seen[0] += 1;
                    assert!(there, "{near:?}");
                } else if t > 0.95 && s > 0.59 {
                    seen[1] += 1;
                    assert!(!there, "{near:?}");
                }
            });
        }
        assert!(seen.iter().all(|&points| points > 50), "{seen:?}");
    }

    #[test]
    fn fiber_slopes_match_finite_differences() {
        let mut fibers = Fibers::new(FibersParameters { fiber_width: 0.3, ..Default::default() }).unwrap();
        // So few that hardly any overlap.
        fibers.segments.cover = 0.1;
        let (half, length) = (fibers.half, fibers.segments.length);
        let height = |uv: Vec2| {
            let (mut found, mut all) = (0.0, 0);
            fibers.segments.visit(uv, fibers.parameters.fiber_bend * length + half, |near| {
                let bend = (2.0 * near.random[1] - 1.0) * fibers.parameters.fiber_bend * length;
                let t = near.along;
                let s = (near.across - bend * t * t) / half;
                found = half * (1.0 - t.powi(8) - s * s);
                all += 1;
            });
            (all == 1 && found > 0.05 * half).then_some(found)
        };
        let (step, mut checked) = (0.01 * half, 0);
        for k in 0..40_000_u32 {
            let uv = Vec2::new((k % 200) as f32, (k / 200) as f32) * (0.37 * half);
            let around = [Vec2::X, -Vec2::X, Vec2::Y, -Vec2::Y].map(|d| height(uv + step * d));
            let [Some(right), Some(left), Some(up), Some(down)] = around else { continue };
            let slope = Vec2::new(right - left, up - down) / (2.0 * step);
            // Second differences of t⁸ and of the bend, and the rounding of positions 50 half
            // widths away. The worst is 0.02.
            let error = fibers.top(uv).slope.distance(slope);
            assert!(error < 0.03, "{uv}: {error}");
            checked += 1;
        }
        assert!(checked > 200, "{checked}");
    }

    #[test]
    fn fibers_cover_most_of_the_surface() {
        let fibers = Fibers::new(FibersParameters::default()).unwrap();
        let mut gaps = 0;
        for i in 0..10_000_u16 {
            let uv = Vec2::new(f32::from(i % 100), f32::from(i / 100)) * 0.000_37;
            gaps += u16::from(fibers.top(uv).slope == Vec2::ZERO);
        }
        assert!(gaps < 2500, "{gaps}");
    }
}
