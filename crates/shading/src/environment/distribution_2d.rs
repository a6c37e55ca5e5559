//! Sampling of directions in proportion to the brightness of an image.

use core::f32::consts::TAU;

use glam::{Vec2, Vec3};

use crate::environment::latitude_longitude::{ImagePosition, LatitudeLongitude, MAX_TEXELS};
use crate::error::ShadingError;
use crate::image::texel_count;
use crate::math::{cos, sin, sqrt};

/// The largest `f32` below 1, to which `u = 1` is clamped, so that inversion ends inside the
/// density.
const BELOW_ONE: f32 = 1.0 - f32::EPSILON / 2.0;

/// The number of entries in the table of an image.
///
/// They are the sums along each row, then the CDF over the strips between rows.
pub(super) const fn table_len(width: usize, height: usize) -> Result<usize, ShadingError> {
    match texel_count(width, height, MAX_TEXELS) {
        Ok(texels) => Ok(texels + height + 1),
        Err(error) => Err(error),
    }
}

/// The brightness for sampling: the mean of the channels, so that none is missed.
#[inline]
fn brightness(color: Vec3) -> f32 {
    color.dot(Vec3::splat(1.0 / 3.0))
}

/// Fills the table of an image and returns the integral of its brightness over the sphere.
pub(super) fn fill(image: LatitudeLongitude<&[Vec3]>, table: &mut [f32]) -> f32 {
    let (width, height) = (image.width(), image.height());
    let (rows, strips) = table.split_at_mut((width * height).min(table.len()));
    for (row, sums) in rows.chunks_exact_mut(width).enumerate() {
        let at = |column| f64::from(brightness(image.node(row + 1, column)));
        let mut sum = 0.0;
        for (column, entry) in sums.iter_mut().enumerate() {
            sum += 0.5 * (at(column) + at(image.next(column)));
            *entry = sum as f32;
        }
    }
    let tables = Tables { image, rows, strips: &[], total: 0.0 };
    let mut total = 0.0;
    for (strip, entry) in strips.iter_mut().enumerate() {
        let [above, below] = [strip, strip + 1].map(|row| f64::from(tables.row_sum(row)));
        let [up, down] = [strip, strip + 1].map(|row| 0.5 * image.theta(row));
        let area = 2.0 * f64::from(sin(up + down)) * f64::from(sin(down - up));
        total += 0.5 * (above + below) * area;
        *entry = total as f32;
    }
    // Divided by its own last entry, which is then exactly 1.
    let last = strips.last().copied().unwrap_or_default();
    for entry in strips.iter_mut() {
        *entry /= last;
    }
    (total * f64::from(TAU) / width as f64) as f32
}

/// An image with its filled table.
pub(super) struct Tables<'a> {
    pub(super) image: LatitudeLongitude<&'a [Vec3]>,
    /// Sums of brightness along each row.
    pub(super) rows: &'a [f32],
    /// The CDF over the strips.
    pub(super) strips: &'a [f32],
    /// The integral of the brightness over the sphere.
    pub(super) total: f32,
}

impl Tables<'_> {
    /// The sum of a row of centers, or of a pole, up to and including the trapezoid at `column`.
    #[inline]
    fn sum(&self, row: usize, column: usize) -> f32 {
        if row == 0 || row > self.image.height() {
            brightness(self.image.node(row, 0)) * (column + 1) as f32
        } else {
            self.rows.get((row - 1) * self.image.width() + column).copied().unwrap_or_default()
        }
    }

    #[inline]
    fn row_sum(&self, row: usize) -> f32 {
        self.sum(row, self.image.width() - 1)
    }

    /// The density over solid angle.
    pub(super) fn density(&self, place: ImagePosition) -> f32 {
        let ImagePosition { strip, column, along, theta, .. } = place;
        let [above, below] = [strip, strip + 1].map(|row| self.image.theta(row));
        // (cos above − cos θ)/(cos above − cos below) without the differences.
        let down = sin(0.5 * (theta + above)) * sin(0.5 * (theta - above))
            / (sin(0.5 * (below + above)) * sin(0.5 * (below - above)));
        let next = self.image.next(column);
        let [above, below] = [strip, strip + 1].map(|row| {
            let [left, right] = [column, next].map(|column| brightness(self.image.node(row, column)));
            left + along * (right - left)
        });
        ((above + down.clamp(0.0, 1.0) * (below - above)) / self.total).max(0.0)
    }

    /// The direction of a uniform point.
    pub(super) fn sample(&self, u: Vec2) -> Vec3 {
        let [across, u] = u.to_array().map(|u| if u > 0.0 { u.min(BELOW_ONE) } else { 0.0 });
        // The strip, and the position in it.
        let strip = self.strips.partition_point(|&sum| sum <= u).min(self.image.height());
        let below = |k: usize| self.strips.get(k).copied().unwrap_or_default();
        let before = if strip > 0 { below(strip - 1) } else { 0.0 };
        let share = (u - before) / (below(strip) - before);
        let down = linear_quantile(self.row_sum(strip), self.row_sum(strip + 1), share);
        // The column. The interpolated sums of both rows are the sums of the row in between.
        let between = |[above, below]: [f32; 2]| above + down * (below - above);
        let sum = |column: usize| between([self.sum(strip, column), self.sum(strip + 1, column)]);
        let last = self.image.width() - 1;
        let target = across * sum(last);
        let (mut first, mut end) = (0, last);
        while first < end {
            let middle = first + (end - first) / 2;
            if sum(middle) <= target { first = middle + 1 } else { end = middle }
        }
        let before = if first > 0 { sum(first - 1) } else { 0.0 };
        let share = (target - before) / (sum(first) - before);
        let [left, right] = [first, self.image.next(first)]
            .map(|column| between([strip, strip + 1].map(|row| brightness(self.image.node(row, column)))));
        let along = linear_quantile(left, right, share);
        // sin² and cos² of θ/2 are linear in the height z, and keep their digits at both poles.
        let [s, c] = [sin, cos].map(|f: fn(f32) -> f32| {
            let square = |row| {
                let x = f(0.5 * self.image.theta(row));
                x * x
            };
            between([square(strip), square(strip + 1)])
        });
        let phi = TAU * (0.5 - (first as f32 + 0.5 + along) / self.image.width() as f32);
        let rho = 2.0 * sqrt((s * c).max(0.0));
        Vec3::new(rho * cos(phi), rho * sin(phi), c - s)
    }
}

/// Inverse CDF at `u` of a linear density over [0, 1] from `a` to `b`.
///
/// ```text
/// x = u (a + b)/(a + √(a² + u (b² − a²)))
/// ```
fn linear_quantile(a: f32, b: f32, u: f32) -> f32 {
    let most = a.max(b);
    let (a, b) = (a / most, b / most);
    let root = sqrt((a * a + u * (b * b - a * a)).max(0.0));
    let x = u * (a + b) / (a + root);
    // NaN if both weights are 0. No sample falls into such a cell.
    if x > 0.0 { x.min(1.0) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn linear_quantile_inverts_the_cdf() {
        for (a, b) in [(1.0, 1.0), (0.0, 2.0), (3.0, 0.0), (1e-20, 1e30), (0.2, 0.7)] {
            for k in 0..=64 {
                let u = k as f32 / 64.0;
                let x = linear_quantile(a, b, u);
                let (a, b, x) = (f64::from(a), f64::from(b), f64::from(x));
                let share = x * (a + 0.5 * x * (b - a)) / (0.5 * (a + b));
                assert_abs_diff_eq!(share, f64::from(u), epsilon = 4e-7, "{a} {b} {u}");
            }
        }
        assert_eq!(linear_quantile(0.0, 0.0, 0.5), 0.0);
    }
}
