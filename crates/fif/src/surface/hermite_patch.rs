//! The bicubic Hermite patch without twist: values, slopes, and their ranges over parts of it.

use asperity_core::Interval;

use crate::numeric::polynomial::UNIT;

/// Value and the two slopes at a corner, slopes per width of the patch.
pub(crate) type Corner = [f64; 3];

/// A patch on the unit square; corner `[a][b]` lies at `(a, b)`.
///
/// ```text
/// p(u, v) = Σ_ab  z_ab H_a(u) H_b(v) + x_ab K_a(u) H_b(v) + y_ab H_a(u) K_b(v)
/// H_0(u) = (1 + 2u)(1 − u)²,  K_0(u) = u (1 − u)²,  H_1(u) = H_0(1 − u),  K_1(u) = −K_0(1 − u)
/// ```
#[derive(Clone, Copy, Debug)]
pub(crate) struct Patch(pub(crate) [[Corner; 2]; 2]);

/// Bounds of a patch for all patches with corners up to given magnitudes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Magnitudes {
    /// Bound of the sums of absolute terms of the value.
    pub(crate) value: f64,
    /// The same for either slope.
    pub(crate) slope: f64,
    /// The same for any second derivative.
    pub(crate) second: f64,
}

impl Magnitudes {
    /// Computes the bounds from the maximum magnitudes of corners.
    pub(crate) fn new([z, x, y]: Corner) -> Self {
        // ΣH = 1, Σ|K| = u(1 − u) ≤ 1/4, Σ|H′| ≤ 3, Σ|K′| ≤ 1, Σ|H″| ≤ 12, Σ|K″| ≤ 6.
        Self { value: z + 0.25 * (x + y), slope: 3.0 * z + 2.0 * x.max(y), second: 12.0 * z + 9.0 * (x + y) }
    }
}

impl Patch {
    /// Roundings of one term of a sum, and of the sum, in units of the sum of magnitudes.
    pub(crate) const ROUNDINGS: f64 = 16.0;

    /// `p(u, v)`.
    #[inline]
    pub(crate) fn value(&self, u: f64, v: f64) -> f64 {
        let ([h0, h1], [k0, k1]) = basis(u);
        let (rows, slopes) = self.rows(v);
        h0 * rows[0] + k0 * slopes[0] + (h1 * rows[1] + k1 * slopes[1])
    }

    /// `[∂p/∂u, ∂p/∂v]`.
    #[inline]
    pub(crate) fn slopes(&self, u: f64, v: f64) -> [f64; 2] {
        let ([h0, h1], [k0, k1]) = basis(u);
        let ([dh0, dh1], [dk0, dk1]) = basis_slopes(u);
        let (rows, slopes) = self.rows(v);
        let ([g0, g1], [l0, l1]) = basis_slopes(v);
        let across = |side: &[Corner; 2], k: usize| g0 * side[0][k] + g1 * side[1][k];
        let rise = |side: &[Corner; 2]| across(side, 0) + (l0 * side[0][2] + l1 * side[1][2]);
        let [low, high] = &self.0;
        [
            dh0 * rows[0] + dk0 * slopes[0] + (dh1 * rows[1] + dk1 * slopes[1]),
            h0 * rise(low) + k0 * across(low, 1) + (h1 * rise(high) + k1 * across(high, 1)),
        ]
    }

    /// Values and slopes along u of the two sides `u = 0` and `u = 1`, at `v`.
    #[inline]
    fn rows(&self, v: f64) -> ([f64; 2], [f64; 2]) {
        let ([h0, h1], [k0, k1]) = basis(v);
        let value =
            |side: &[Corner; 2]| h0 * side[0][0] + h1 * side[1][0] + (k0 * side[0][2] + k1 * side[1][2]);
        let slope = |side: &[Corner; 2]| h0 * side[0][1] + h1 * side[1][1];
        let [low, high] = &self.0;
        ([value(low), value(high)], [slope(low), slope(high)])
    }

    /// An enclosure of the value over the part `u × v` of the patch.
    pub(crate) fn range(&self, u: [f64; 2], v: [f64; 2]) -> Interval {
        let net = self.control_net();
        restriction(&net, u, v, largest(&net))
    }

    /// Enclosures of the value and both slopes over the part `u × v` of the patch.
    pub(crate) fn ranges(&self, u: [f64; 2], v: [f64; 2]) -> [Interval; 3] {
        let net = self.control_net();
        let mut along_u = [[0.0; 4]; 3];
        for (i, row) in along_u.iter_mut().enumerate() {
            for (j, difference) in row.iter_mut().enumerate() {
                *difference = 3.0 * (net[i + 1][j] - net[i][j]);
            }
        }
        let along_v = net.map(|[a, b, c, d]| [b - a, c - b, d - c].map(|difference| 3.0 * difference));
        let scale = largest(&net);
        [
            restriction(&net, u, v, scale),
            restriction(&along_u, u, v, 6.0 * scale),
            restriction(&along_v, u, v, 6.0 * scale),
        ]
    }

    /// Bézier control points: the patch lies within their range, its slopes within three times
    /// their differences.
    fn control_net(&self) -> [[f64; 4]; 4] {
        let mut net = [[0.0; 4]; 4];
        for (i, row) in net.iter_mut().enumerate() {
            for (j, point) in row.iter_mut().enumerate() {
                let [z, x, y] = self.0[i / 2][j / 2];
                let step = [0.0, 1.0, -1.0, 0.0];
                *point = z + (step[i] * x + step[j] * y) / 3.0;
            }
        }
        net
    }
}

fn largest(net: &[[f64; 4]; 4]) -> f64 {
    net.iter().flatten().fold(0.0, |scale, point| scale.max(point.abs()))
}

/// The range of the control points of a part of a patch, expanded by their rounding.
///
/// The degrees of the patch are `A − 1` and `B − 1`.
fn restriction<const A: usize, const B: usize>(
    net: &[[f64; B]; A],
    u: [f64; 2],
    v: [f64; 2],
    scale: f64,
) -> Interval {
    let rows = net.map(|row| part(row, v));
    let mut range = Interval::EMPTY;
    for j in 0..B {
        for point in part(rows.map(|row| row[j]), u) {
            range = range.hull(Interval::new(point, point));
        }
    }
    // Points of the net err by 4 roundings, their differences by as many of six times the scale.
    // Then there are up to 6 interpolations of 3 roundings each.
    range.inflated(64.0 * UNIT * scale)
}

/// Control points over `[a, b]` of the polynomial with control points `points` over `[0, 1]`, by
/// its blossom.
fn part<const N: usize>(points: [f64; N], [a, b]: [f64; 2]) -> [f64; N] {
    core::array::from_fn(|count| {
        let mut level = points;
        for step in 1..N {
            let t = if step <= count { b } else { a };
            for i in 0..N - step {
                level[i] = level[i] * (1.0 - t) + level[i + 1] * t;
            }
        }
        level[0]
    })
}

/// `([H_0, H_1], [K_0, K_1])`.
#[inline]
fn basis(u: f64) -> ([f64; 2], [f64; 2]) {
    let w = 1.0 - u;
    let (uu, ww) = (u * u, w * w);
    ([(u + u + 1.0) * ww, (w + w + 1.0) * uu], [u * ww, -(w * uu)])
}

/// Derivatives of [`basis`].
#[inline]
fn basis_slopes(u: f64) -> ([f64; 2], [f64; 2]) {
    let w = 1.0 - u;
    let bump = 6.0 * u * w;
    ([-bump, bump], [w * (w - u - u), u * (u - w - w)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::{abs_diff_eq, assert_abs_diff_eq};

    const PATCH: Patch =
        Patch([[[0.25, -1.0, 0.5], [1.5, 2.0, -0.75]], [[-0.5, 0.25, 3.0], [0.125, -2.5, 1.0]]]);

    #[test]
    fn patch_interpolates_its_corners() {
        for (a, side) in PATCH.0.iter().enumerate() {
            for (b, corner) in side.iter().enumerate() {
                let (u, v) = (a as f64, b as f64);
                let [x, y] = PATCH.slopes(u, v);
                assert_eq!([PATCH.value(u, v), x, y], *corner, "({u}, {v})");
            }
        }
    }

    #[test]
    fn slopes_match_finite_differences() {
        const STEP: f64 = 1e-4;
        for (u, v) in [(0.3, 0.6), (0.01, 0.97), (0.5, 0.5)] {
            let [x, y] = PATCH.slopes(u, v);
            let along_u = (PATCH.value(u + STEP, v) - PATCH.value(u - STEP, v)) / (2.0 * STEP);
            let along_v = (PATCH.value(u, v + STEP) - PATCH.value(u, v - STEP)) / (2.0 * STEP);
            // Third derivatives are below 100 here: h²/6 of that.
            assert!(
                abs_diff_eq!(x, along_u, epsilon = 2e-7) && abs_diff_eq!(y, along_v, epsilon = 2e-7),
                "({u}, {v})"
            );
        }
    }

    #[test]
    fn ranges_contain_values_and_shrink_to_the_point() {
        for [u, v] in [[[0.0, 1.0], [0.0, 1.0]], [[0.2, 0.7], [0.55, 0.6]], [[0.9, 1.0], [0.3, 0.31]]] {
            let ranges = PATCH.ranges(u, v);
            assert_eq!(PATCH.range(u, v), ranges[0]);
            for i in 0..=10 {
                for j in 0..=10 {
                    let at = |[a, b]: [f64; 2], k: i32| a + (b - a) * f64::from(k) / 10.0;
                    let (u, v) = (at(u, i), at(v, j));
                    let [x, y] = PATCH.slopes(u, v);
                    let all = ranges.iter().zip([PATCH.value(u, v), x, y]).all(|(r, p)| r.contains(p));
                    assert!(all, "({u}, {v}): {ranges:?}");
                }
            }
        }
        let point = PATCH.ranges([0.4; 2], [0.7; 2]);
        assert!(point.iter().all(|range| range.width() < 1e-12), "{point:?}");
    }

    #[test]
    fn magnitudes_bound_values_and_slopes() {
        let bounds = Magnitudes::new([1.5, 2.5, 3.0]);
        let ranges = PATCH.ranges([0.0, 1.0], [0.0, 1.0]);
        assert!(ranges[0].magnitude() <= bounds.value + 2.0 && bounds.value < 3.0);
        for k in 0..=100 {
            let t = f64::from(k) / 100.0;
            let [x, y] = PATCH.slopes(t, 1.0 - t);
            assert!(x.abs().max(y.abs()) <= bounds.slope);
            assert_abs_diff_eq!(PATCH.value(t, t), 0.0, epsilon = bounds.value);
        }
    }
}
