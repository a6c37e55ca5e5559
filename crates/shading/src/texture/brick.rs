//! A brick wall with mortar grooves.

use glam::Vec2;

use crate::error::ShadingError;
use crate::math::{clamp_to, floor};
use crate::parameter::{not_negative, positive, within};
use crate::pixel::PixelEllipse;

/// Bricks in running bond: every other row is shifted by half a brick.
///
/// ```text
/// (s, t) = (u/(width + mortar), v/(height + mortar)),   s shifted by 1/2 in odd rows
/// brick  = 1 inside the brick, 0 in the mortar: a pulse in s times a pulse in t
/// height = smoothstep up over half the mortar, down over the other: a rounded pulse in s times one in t
/// ```
///
/// [`sample`](Self::sample) is the texture of the lecture at a point, [`filtered`](Self::filtered)
/// its exact mean over a box, for pixels of any size. Lengths are in the unit of the texture
/// coordinates. The height is 0 in the middle of the mortar and 1 on the brick, and the caller
/// scales it. The lecture displaces by the whole unit, which works only with a computed normal.
///
/// Cohen, *Procedural Bump Mapping and Noise*, listing `brickbump` (after Peachey in Ebert 1994).
///
/// ```
/// use asperity_shading::{Brick, PixelEllipse, glam::Vec2};
///
/// let wall = Brick::default();
/// let middle = wall.sample(Vec2::new(0.13, 0.045));
/// assert_eq!((middle.brick, middle.height, middle.slope), (1.0, 1.0, Vec2::ZERO));
/// assert_eq!(wall.sample(Vec2::ZERO).brick, 0.0);
/// // From afar a wall has its mean color.
/// let far = wall.filtered(Vec2::new(0.3, 0.7), PixelEllipse::aligned(Vec2::splat(1000.0)));
/// assert!((far.brick - wall.mean()).abs() < 1e-4);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Brick {
    /// Width and height of a brick with its mortar.
    cell: Vec2,
    /// Half the mortar as a fraction of the cell.
    margin: Vec2,
}

/// Sample of a [`Brick`] wall at a point; the default is mortar.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BrickSample {
    /// The fraction of brick, 1, versus mortar, 0.
    pub brick: f32,
    /// The height above the middle of the mortar, in `[0, 1]`.
    pub height: f32,
    /// `(∂height/∂u, ∂height/∂v)`.
    pub slope: Vec2,
    /// Column and row of the brick, for a color per brick; the middle one of a filtered sample.
    pub cell: [i32; 2],
}

/// The bricks of the lecture: 0.25 by 0.08 with 0.01 of mortar.
impl Default for Brick {
    fn default() -> Self {
        Self { cell: Vec2::new(0.26, 0.09), margin: Vec2::new(0.005 / 0.26, 0.005 / 0.09) }
    }
}

impl Brick {
    /// Creates bricks of this width and height, with mortar of this thickness between them.
    ///
    /// # Errors
    /// [`ShadingError`] unless all are finite, width and height at least 10⁻³⁰ and the mortar at
    /// least 0. Mortar thinner than 10⁻³⁰, or than twice this fraction of a brick, is ignored, so
    /// that all slopes are finite.
    pub fn new(width: f32, height: f32, mortar: f32) -> Result<Self, ShadingError> {
        let side = |parameter, side| within(parameter, positive(parameter, side)?, [THINNEST, f32::MAX]);
        let present = |mortar: f32| if mortar < THINNEST { 0.0 } else { mortar };
        let mortar = present(not_negative("mortar", mortar)?);
        let cell = Vec2::new(side("width", width)? + mortar, side("height", height)? + mortar);
        let margin = 0.5 * mortar / cell;
        Ok(Self { cell, margin: Vec2::new(present(margin.x), present(margin.y)) })
    }

    /// The fraction of the wall that is brick.
    #[must_use]
    pub fn mean(&self) -> f32 {
        (1.0 - 2.0 * self.margin.x) * (1.0 - 2.0 * self.margin.y)
    }

    /// The wall at a point; mortar for coordinates that are not finite.
    #[must_use]
    pub fn sample(&self, uv: Vec2) -> BrickSample {
        let Some((s, t, cell)) = self.place(uv) else { return BrickSample::default() };
        let shifted = s + shift(cell[1]);
        let column = shifted - floor(shifted);
        let (across, up) = (Pulse(self.margin.x), Pulse(self.margin.y));
        let (across, up) = (across.at(column), up.at(t));
        BrickSample {
            brick: across.step * up.step,
            height: across.round * up.round,
            slope: Vec2::new(across.slope * up.round, across.round * up.slope) / self.cell,
            cell: brick_of(cell, shifted),
        }
    }

    /// The mean of the wall over the bounding box of a pixel, and the slope of the mean height.
    ///
    /// Exact, by antiderivatives of the four pulses over even and odd rows, without sampling, at
    /// any width. Sides below 2⁻¹⁰ of a brick are read as 0. NaN widths, and widths above 2¹⁶
    /// bricks, return the mean of the whole wall.
    #[must_use]
    pub fn filtered(&self, uv: Vec2, pixel: PixelEllipse) -> BrickSample {
        let widths = pixel.sides();
        let Some((s, t, [ds, dt], cell)) = self.boxed(uv, widths) else { return BrickSample::default() };
        // Rows are counted from the even one at or below, so that positions stay small.
        let t = t + if cell[1] % 2 == 0 { 0.0 } else { 1.0 };
        let rows = if dt < LEAST {
            Rows::at(Pulse(self.margin.y), t)
        } else {
            Rows::over(Pulse(self.margin.y), t, dt)
        };
        let mut sample = BrickSample { cell: brick_of(cell, s + shift(cell[1])), ..BrickSample::default() };
        for (row, shift) in rows.0.into_iter().zip([0.0, 0.5]) {
            let across = Pulse(self.margin.x).over(s + shift, ds);
            sample.brick += across.step * row.step;
            sample.height += across.round * row.round;
            sample.slope += Vec2::new(across.slope * row.round, across.round * row.slope) / self.cell;
        }
        // Sums of fractions, rounded.
        sample.brick = clamp_to(sample.brick, 1.0);
        sample.height = clamp_to(sample.height, 1.0);
        sample
    }

    /// The center of a box in its cell, its sides in cells, and the cell without the shift of its
    /// row.
    pub(super) fn boxed(&self, uv: Vec2, widths: Vec2) -> Option<(f32, f32, [f32; 2], [i32; 2])> {
        let (s, t, cell) = self.place(uv)?;
        let widest = |width: f32, cell: f32| {
            let width = (width / cell).abs();
            if width <= MOST { width } else { MOST }
        };
        Some((s, t, [widest(widths.x, self.cell.x), widest(widths.y, self.cell.y)], cell))
    }

    /// Width and height of a brick with its mortar.
    pub(crate) const fn cell(&self) -> Vec2 {
        self.cell
    }

    /// Half the mortar as a fraction of the cell.
    pub(crate) const fn margin(&self) -> Vec2 {
        self.margin
    }

    /// Column and row fractions, and the cell without the shift of its row.
    fn place(&self, uv: Vec2) -> Option<(f32, f32, [i32; 2])> {
        let p = uv / self.cell;
        if !p.is_finite() {
            return None;
        }
        let (column, row) = (floor(p.x), floor(p.y));
        // The casts saturate.
        Some((p.x - column, p.y - row, [column as i32, row as i32]))
    }
}

/// The minimum side of a brick and thickness of mortar, and half of this as a fraction of a brick.
const THINNEST: f32 = 1e-30;

pub(super) const LEAST: f32 = 1.0 / 1024.0;
const MOST: f32 = 65536.0;

/// The brick in a cell, at this position in its shifted row.
fn brick_of([column, row]: [i32; 2], shifted: f32) -> [i32; 2] {
    [column.saturating_add(i32::from(shifted >= 1.0)), row]
}

pub(super) fn shift(row: i32) -> f32 {
    if row % 2 == 0 { 0.0 } else { 0.5 }
}

/// A pulse of period 1 that is 0 within the margin of integers; sharp, and with rounded flanks.
#[derive(Clone, Copy)]
pub(super) struct Pulse(pub(super) f32);

/// Values of both pulses and the slope of the round one; or their means, and the slope of the mean.
#[derive(Clone, Copy, Default)]
pub(super) struct Value {
    pub(super) step: f32,
    pub(super) round: f32,
    pub(super) slope: f32,
    /// Fraction of an interval that lies in rows of one kind.
    pub(super) length: f32,
}

impl Value {
    /// The mean over an interval between two antiderivatives.
    fn rate(a: Self, b: Self, width: f32) -> Self {
        let over = |a: f32, b: f32| (b - a) / width;
        Self {
            step: over(a.step, b.step),
            round: over(a.round, b.round),
            slope: over(a.slope, b.slope),
            length: over(a.length, b.length),
        }
    }
}

impl Pulse {
    /// At `f` in `[0, 1]`.
    pub(super) fn at(self, f: f32) -> Value {
        let m = self.0;
        let flank = f.min(1.0 - f);
        if flank >= m {
            return Value { step: 1.0, round: 1.0, ..Value::default() };
        }
        let x = (flank / m).max(0.0);
        let sign = if f < 0.5 { 1.0 } else { -1.0 };
        Value {
            step: 0.0,
            round: x * x * (3.0 - 2.0 * x),
            slope: sign * 6.0 * x * (1.0 - x) / m,
            ..Value::default()
        }
    }

    /// The mean over the interval of this width around `x`.
    pub(super) fn over(self, x: f32, width: f32) -> Value {
        if width < LEAST {
            return self.at(x - floor(x));
        }
        let (left, right) = (x - 0.5 * width, x + 0.5 * width);
        let (a, b) = (self.antiderivative(left), self.antiderivative(right));
        let ends = self.at(right - floor(right)).round - self.at(left - floor(left)).round;
        Value { slope: ends / width, ..Value::rate(a, b, width) }
    }

    /// Integrals from 0 to `x`, of either sign.
    fn antiderivative(self, x: f32) -> Value {
        let whole = floor(x);
        let within = self.integral(x - whole);
        let full = self.integral(1.0);
        Value {
            step: whole * full.step + within.step,
            round: whole * full.round + within.round,
            ..Value::default()
        }
    }

    /// Integrals from 0 to `f` in `[0, 1]`.
    fn integral(self, f: f32) -> Value {
        let m = self.0;
        let step = (f - m).clamp(0.0, 1.0 - 2.0 * m);
        // ∫ of the rising flank up to x of its width.
        let rise = |x: f32| m * x * x * x * (1.0 - 0.5 * x);
        let round = if f < m {
            rise(f / m)
        } else if f <= 1.0 - m {
            f - 0.5 * m
        } else {
            1.0 - m - if m > 0.0 { rise(((1.0 - f) / m).max(0.0)) } else { 0.0 }
        };
        Value { step, round, ..Value::default() }
    }
}

/// Means over a range of heights of even and of odd rows.
pub(super) struct Rows(pub(super) [Value; 2]);

impl Rows {
    fn at(pulse: Pulse, t: f32) -> Self {
        let value = pulse.at(t - floor(t));
        if t < 1.0 { Self([value, Value::default()]) } else { Self([Value::default(), value]) }
    }

    /// Over the interval of this width around `t`, where row 0 is even.
    pub(super) fn over(pulse: Pulse, t: f32, width: f32) -> Self {
        let (low, high) = (t - 0.5 * width, t + 0.5 * width);
        Self([0.0, 1.0].map(|row| {
            let (a, b) = (Self::antiderivative(pulse, low - row), Self::antiderivative(pulse, high - row));
            Value::rate(a, b, width)
        }))
    }

    /// Integrals over the even rows from 0 to `t`; the slope is the round pulse itself.
    fn antiderivative(pulse: Pulse, t: f32) -> Value {
        let pair = floor(0.5 * t);
        let within = t - 2.0 * pair;
        let (full, part) = (pulse.integral(1.0), pulse.integral(within.min(1.0)));
        Value {
            step: pair * full.step + part.step,
            round: pair * full.round + part.round,
            slope: if within < 1.0 { pulse.at(within).round } else { 0.0 },
            length: pair + within.min(1.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bump::finite_difference_gradient;
    use asperity_core::assert_abs_diff_eq;

    const WALLS: [(f32, f32, f32); 4] =
        [(0.25, 0.08, 0.01), (1.0, 1.0, 0.5), (0.3, 0.2, 0.0), (2.0, 0.5, 0.3)];

    /// The listing, statement by statement.
    fn listing(wall: &Brick, uv: Vec2) -> (f32, f32) {
        let smoothstep = |a: f32, b: f32, x: f32| {
            let t = ((x - a) / (b - a)).clamp(0.0, 1.0);
            t * t * (3.0 - 2.0 * t)
        };
        let step = |a: f32, x: f32| if x < a { 0.0 } else { 1.0 };
        let (mut ss, mut tt) = (uv.x / wall.cell.x, uv.y / wall.cell.y);
        if (tt * 0.5).rem_euclid(1.0) > 0.5 {
            ss += 0.5;
        }
        ss -= ss.floor();
        tt -= tt.floor();
        let (mwf, mhf) = (wall.margin.x, wall.margin.y);
        let (w, h) = (step(mwf, ss) - step(1.0 - mwf, ss), step(mhf, tt) - step(1.0 - mhf, tt));
        let sbump = smoothstep(0.0, mwf, ss) - smoothstep(1.0 - mwf, 1.0, ss);
        let tbump = smoothstep(0.0, mhf, tt) - smoothstep(1.0 - mhf, 1.0, tt);
        (w * h, sbump * tbump)
    }

    #[test]
    fn sample_matches_the_listing() {
        for (width, height, mortar) in [WALLS[0], WALLS[1], WALLS[3]] {
            let wall = Brick::new(width, height, mortar).unwrap();
            for i in 0..4000 {
                let uv = Vec2::new(-3.0 + 0.001_73 * i as f32, 2.0 - 0.001_31 * i as f32);
                let (sample, (brick, bump)) = (wall.sample(uv), listing(&wall, uv));
                // Rounding may decide differently within 1e-5 of the edge.
                let near = wall.filtered(uv, PixelEllipse::aligned(wall.cell * 2.1e-3));
                assert!(sample.brick == brick || (near.brick > 0.0 && near.brick < 1.0), "{uv}");
                assert_abs_diff_eq!(sample.height, bump, epsilon = 2e-4, "{uv}");
            }
        }
    }

    #[test]
    fn slopes_match_finite_differences() {
        let wall = Brick::new(1.0, 0.7, 0.4).unwrap();
        let h = 1e-3;
        for i in 0..300 {
            let uv = Vec2::new(0.037 * i as f32, 0.071 * i as f32 + 0.013);
            for widths in [Vec2::ZERO, Vec2::new(0.3, 0.2), Vec2::new(2.7, 1.9)] {
                let at = |by: Vec2| wall.filtered(uv + by, PixelEllipse::aligned(widths)).height;
                let by = finite_difference_gradient(at, Vec2::ZERO, h);
                let got = wall.filtered(uv, PixelEllipse::aligned(widths)).slope;
                // Third derivatives are 12/0.2³ at most, and the second derivative jumps by 6/0.2²
                // at the start of the flanks.
                assert_abs_diff_eq!(got, by, epsilon = 0.2, "{uv}, {widths}");
            }
        }
    }

    #[test]
    fn whole_walls_have_their_mean() {
        for (width, height, mortar) in WALLS {
            let wall = Brick::new(width, height, mortar).unwrap();
            for widths in [Vec2::INFINITY, Vec2::NAN, Vec2::splat(1e30)] {
                let far = wall.filtered(Vec2::new(0.3, -7.2), PixelEllipse::aligned(widths));
                assert_abs_diff_eq!(far.brick, wall.mean(), epsilon = 1e-4, "{widths}");
                assert!(far.slope.length() < 1e-3);
            }
        }
    }

    #[test]
    fn thinnest_mortar_has_finite_slopes() {
        let sizes = [1e-30, 1e-20, 1e-6, 1.0, 1e6, 1e20, 3e38];
        let mortars = [1e-45, 1e-41, 1e-38, 1e-30, 1e-10, 1.0, 3e38];
        for (width, mortar) in sizes.into_iter().flat_map(|size| mortars.map(|mortar| (size, mortar))) {
            let wall = Brick::new(width, width, mortar).unwrap();
            for share in [0.0, 1e-45, 1e-38, 1e-30, 1e-20, 1e-7, 0.25, 0.5] {
                for of in [width, mortar] {
                    let uv = Vec2::new(share * of, -share * of);
                    for widths in [Vec2::ZERO, wall.cell * LEAST, wall.cell] {
                        let got = wall.filtered(uv, PixelEllipse::aligned(widths));
                        assert!(got.slope.is_finite(), "{wall:?} at {uv}: {got:?}");
                        wall.facets(uv, PixelEllipse::aligned(widths), |_, _, slope| {
                            assert!(slope.is_finite(), "{wall:?} at {uv}");
                        });
                    }
                    assert!(wall.sample(uv).slope.is_finite(), "{wall:?} at {uv}");
                }
            }
        }
        let error = Brick::new(1e-31, 1.0, 0.0).unwrap_err();
        assert_eq!(error.parameter(), "width");
    }

    #[test]
    fn brick_indices_follow_their_rows() {
        let wall = Brick::new(1.0, 1.0, 0.0).unwrap();
        assert_eq!(wall.sample(Vec2::new(0.6, 0.5)).cell, [0, 0]);
        assert_eq!(wall.sample(Vec2::new(0.4, 1.5)).cell, [0, 1]);
        assert_eq!(wall.sample(Vec2::new(0.6, 1.5)).cell, [1, 1]);
        assert_eq!(wall.sample(Vec2::new(-0.6, -0.5)).cell, [-1, -1]);
    }
}
