//! The slopes within a pixel of a brick wall, as a few facets with weights.

use glam::Vec2;

use crate::math::floor;
use crate::pixel::PixelEllipse;
use crate::texture::brick::{Brick, LEAST, Pulse, Rows, shift};

/// A part of a pulse within an interval: its fraction, height and slope.
#[derive(Clone, Copy, Debug)]
struct Part {
    share: f32,
    /// 1 on the plateau, 0 on a flank.
    step: f32,
    round: f32,
    slope: f32,
}

impl Brick {
    /// The facets of the wall within the bounding box of a pixel.
    ///
    /// Each has a fraction, brick 1 or mortar 0, and a slope.
    ///
    /// The fractions add up to 1. The pixel shows the mean of a lighting model over the facets; for
    /// a steep groove the model at the [mean slope](Self::filtered) differs. A flank within the box
    /// is two facets. The facets of a whole flank have the slopes 0.6 and 1.5 of its mean, and
    /// facets of a cut flank blend to these over the last fifth. A box over the whole wall has 50
    /// facets. The box is computed as in [`filtered`](Self::filtered); non-finite coordinates are
    /// one facet of mortar.
    ///
    /// ```
    /// use asperity_shading::{Brick, PixelEllipse, glam::Vec2};
    ///
    /// let wall = Brick::default();
    /// let (mut shares, mut slope) = (0.0, Vec2::ZERO);
    /// wall.facets(Vec2::new(0.3, 0.7), PixelEllipse::aligned(Vec2::new(0.05, 0.02)), |share, _, s| {
    ///     shares += share;
    ///     slope += share * s;
    /// });
    /// assert!((shares - 1.0).abs() < 1e-5);
    /// ```
    pub fn facets(&self, uv: Vec2, pixel: PixelEllipse, mut visit: impl FnMut(f32, f32, Vec2)) {
        let widths = pixel.sides();
        let Some((s, t, [ds, dt], [_, index])) = self.boxed(uv, widths) else {
            return visit(1.0, 0.0, Vec2::ZERO);
        };
        let (across, up) = (Pulse(self.margin().x), Pulse(self.margin().y));
        let mut row = |row: i32, vertical: Part| {
            let s = s + shift(row);
            across.parts(s - 0.5 * ds, s + 0.5 * ds, |horizontal| {
                let slope = Vec2::new(horizontal.slope * vertical.round, horizontal.round * vertical.slope);
                visit(
                    vertical.share * horizontal.share,
                    horizontal.step * vertical.step,
                    slope / self.cell(),
                );
            });
        };
        let (low, high) = (t - 0.5 * dt, t + 0.5 * dt);
        if dt < LEAST {
            up.parts(t, t, |part| row(index, part));
        } else if dt >= 2.0 {
            for (kind, rows) in (0..2).zip(Rows::over(up, t, dt).0) {
                whole(rows.length, rows.step, up.0, &mut |part| row(index.saturating_add(kind), part));
            }
        } else {
            let mut k = floor(low);
            while k < high {
                let (from, to) = (low.max(k), high.min(k + 1.0));
                if to > from {
                    let share = (to - from) / dt;
                    up.parts(from, to, |part| {
                        row(index.saturating_add(k as i32), Part { share: share * part.share, ..part });
                    });
                }
                k += 1.0;
            }
        }
    }
}

impl Pulse {
    /// The parts of the pulse over an interval, whose fractions add up to 1.
    fn parts(self, low: f32, high: f32, mut visit: impl FnMut(Part)) {
        let width = high - low;
        let m = self.0;
        if width < LEAST {
            let middle = 0.5 * (low + high);
            let value = self.at(middle - floor(middle));
            return visit(Part { share: 1.0, step: value.step, round: value.round, slope: value.slope });
        }
        let mut flanks = 0.0;
        if width >= 1.0 {
            return whole(1.0, self.over(0.5 * (low + high), width).step, m, &mut visit);
        } else {
            let mut k = floor(low);
            while k < high {
                for (begin, end, sign) in [(k, k + m, 1.0), (k + 1.0 - m, k + 1.0, -1.0)] {
                    let (from, to) = (begin.max(low), end.min(high));
                    if to > from {
                        let share = (to - from) / width;
                        flanks += share;
                        // Two Gauss points, which become those of a whole flank over its last
                        // fifth.
                        let whole = (5.0 * (to - from) / m - 4.0).clamp(0.0, 1.0);
                        for (at, share_of_whole, slope_of_whole) in
                            [(0.211_324_87, 5.0 / 9.0, 0.6), (0.788_675_1, 4.0 / 9.0, 1.5)]
                        {
                            let x = from + at * (to - from);
                            let value = self.at(x - floor(x));
                            visit(Part {
                                share: share * (0.5 + whole * (share_of_whole - 0.5)),
                                step: 0.0,
                                round: value.round + whole * (0.5 - value.round),
                                slope: value.slope + whole * (slope_of_whole * sign / m - value.slope),
                            });
                        }
                    }
                }
                k += 1.0;
            }
        }
        if flanks < 1.0 {
            visit(Part { share: 1.0 - flanks, step: 1.0, round: 1.0, slope: 0.0 });
        }
    }
}

/// The parts of many whole pulses, with nearly equal numbers of rising and falling flanks.
fn whole(length: f32, plateau: f32, m: f32, visit: &mut impl FnMut(Part)) {
    let flanks = (length - plateau).max(0.0);
    for sign in [1.0, -1.0] {
        whole_flank(0.5 * flanks, sign / m, visit);
    }
    visit(Part { share: length - if m > 0.0 { flanks } else { 0.0 }, step: 1.0, round: 1.0, slope: 0.0 });
}

/// Three Gauss points over a flank, of which the outer two have the same slope.
fn whole_flank(share: f32, mean: f32, visit: &mut impl FnMut(Part)) {
    if share > 0.0 && mean.is_finite() {
        visit(Part { share: share * (5.0 / 9.0), step: 0.0, round: 0.5, slope: 0.6 * mean });
        visit(Part { share: share * (4.0 / 9.0), step: 0.0, round: 0.5, slope: 1.5 * mean });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn facets_add_up_to_the_filtered_wall() {
        for (width, height, mortar) in [(0.25, 0.08, 0.01), (1.0, 1.0, 0.5), (0.3, 0.2, 0.0), (2.0, 0.5, 0.3)]
        {
            let wall = Brick::new(width, height, mortar).unwrap();
            for i in 0..200 {
                let uv = Vec2::new(0.173 * i as f32 - 5.0, 0.217 * i as f32 - 9.0);
                let size = Vec2::new(3.7_f32.powi(i % 7 - 4), 2.9_f32.powi(i % 5 - 3));
                let filtered = wall.filtered(uv, PixelEllipse::aligned(size));
                let (mut shares, mut brick, mut slope, mut count) = (0.0, 0.0, Vec2::ZERO, 0);
                wall.facets(uv, PixelEllipse::aligned(size), |share, b, s| {
                    assert!(share >= 0.0 && s.is_finite(), "{uv} {size}: {share} {s}");
                    shares += share;
                    brick += share * b;
                    slope += share * s;
                    count += 1;
                });
                assert_abs_diff_eq!(shares, 1.0, epsilon = 1e-4, "{uv} {size}");
                assert_abs_diff_eq!(brick, filtered.brick, epsilon = 2e-3, "{uv} {size}");
                // At most half the rise of a flank on either side of a box wider than a brick, and
                // corners.
                let bound = 0.6 / size.min(wall.cell());
                let apart = (slope - filtered.slope).abs();
                assert!(apart.x < bound.x && apart.y < bound.y, "{uv} {size}: {slope} {}", filtered.slope);
                assert!(count <= 200, "{count}");
            }
        }
    }

    #[test]
    fn whole_flank_has_the_moments_of_its_slopes() {
        let mut moments = [0.0; 3];
        whole_flank(1.0, 2.0, &mut |part| {
            for (power, moment) in (0..).zip(&mut moments) {
                *moment += part.share * part.slope.powi(power);
            }
        });
        // ∫ (6x(1 − x))² dx = 6/5, times the square of the mean.
        for (got, expected) in moments.into_iter().zip([1.0, 2.0, 4.8]) {
            assert_abs_diff_eq!(got, expected, epsilon = 1e-6);
        }
    }
}
