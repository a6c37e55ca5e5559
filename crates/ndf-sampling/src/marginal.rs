//! Marginal and conditional distribution functions of a piecewise-constant density on the disk, and their exact inverses.

use alloc::vec;
use alloc::vec::Vec;

use crate::disk::{half_chord, meets, to_normal};
use crate::math;
use crate::slab::Slab;
use crate::sum::Sum;

/// The largest `f64` below 1: `u = 1` counts as this, so that inversion ends inside the density.
const BELOW_ONE: f64 = 1.0 - f64::EPSILON / 2.0;

/// Crossings of the circle with the grid that are nearer to one another than this are one.
const MERGED: f64 = 1e-12;

/// The marginal and conditional distribution functions of a density on the (x, y) map of normals.
///
/// ```text
/// x = (n_x + 1)/2, y = (n_y + 1)/2;   f(x, y) = 4 D inside the disk, 0 outside
/// m(x) = ∫ f dy,  M(x) = ∫₀ˣ m,   c(y|x) = f/m,  C(y|x) = ∫₀ʸ c;     x = M⁻¹(u₁), y = C⁻¹(u₂|x)
/// ```
///
/// The density is constant on each texel **and clipped to the disk exactly**: a rim texel counts with the part of it that is
/// inside, so no sample leaves the disk and density, samples and both maps are those of one and the same density. Within a
/// column `m` is `a + b √(x(1−x))` between the places where the circle crosses a line of the grid, so `M` is in closed form,
/// and inverted in closed form where no rim texel carries weight, by bracketed Newton steps where one does.
///
/// - **Domain:** every argument is clamped to [0, 1] (and `y` to the chord at `x`); NaN counts as ½ for `x` and `y`, 0 for `u`.
/// - **Where `m(x) = 0`** the conditional is uniform on the chord.
/// - **Accuracy:** `forward(inverse(u)) = u` within 1e-11, and within 1e-6 (1e-4 over twelve decades of contrast) for `u` at the
///   very ends, where the chord shrinks to 10⁻⁸. `f64` throughout: prefix sums and their differences in `f32` lose the rows of small weight.
///
/// ```
/// use asperity_ndf_sampling::{Measure, NdfMap};
///
/// let map = NdfMap::from_fn(16, 16, Measure::Normals, |n| n.z)?;
/// let [x, y] = map.cdf().inverse([0.25, 0.75]);
/// let [u1, u2] = map.cdf().forward([x, y]);
/// assert!((u1 - 0.25).abs() < 1e-12 && (u2 - 0.75).abs() < 1e-12);
/// # Ok::<(), asperity_ndf_sampling::NdfMapError>(())
/// ```
///
/// Kautz, Heidrich, Seidel 2001, section 4 (the functions m, M, c, C).
#[derive(Clone, Debug, PartialEq)]
pub struct Cdf {
    width: usize,
    height: usize,
    /// The density's texels, column by column, as they were given.
    texels: Vec<f32>,
    /// What a texel is multiplied with for the integral over the disk to be 1.
    scale: f64,
    /// Per column the integral of the density over y at every line of the grid.
    columns: Vec<f64>,
    /// The pieces of x on which `m` has one formula, and a last one at `x = 1`.
    slabs: Vec<Slab>,
    /// For each of `slabs.len()` equal parts of u the slab in which it begins.
    guide: Vec<u32>,
}

impl Cdf {
    /// The functions of `texels`, given column by column, finite and not negative; nothing if no weight is in the disk.
    pub(crate) fn new(width: usize, height: usize, texels: Vec<f32>) -> Option<Self> {
        let mut columns = vec![0.0; width * (height + 1)];
        for (sums, texels) in columns.chunks_exact_mut(height + 1).zip(texels.chunks_exact(height)) {
            let mut sum = Sum::default();
            for (above, &texel) in sums.iter_mut().skip(1).zip(texels) {
                sum.add(f64::from(texel) / height as f64);
                *above = sum.value();
            }
        }
        let mut cdf =
            Self { width, height, texels, scale: 1.0, columns, slabs: Vec::new(), guide: Vec::new() };
        cdf.build_slabs();
        let total = cdf.slabs.last().map_or(0.0, |last| last.cumulative);
        if !(total > 0.0 && (1.0 / total).is_finite()) {
            return None;
        }
        cdf.normalise(total);
        cdf.build_guide();
        Some(cdf)
    }

    fn build_slabs(&mut self) {
        let columns = (0..=self.width).map(|i| i as f64 / self.width as f64);
        // Crossings that differ by rounding alone would leave pieces without a width, in which nothing can be inverted.
        let apart =
            |x: f64| (x - math::floor_f64(x * self.width as f64 + 0.5) / self.width as f64).abs() > MERGED;
        let lines = (1..self.height).map(|j| half_chord(j as f64 / self.height as f64));
        let mut cuts: Vec<f64> = lines.flat_map(|c| [0.5 - c, 0.5 + c]).filter(|&x| apart(x)).collect();
        cuts.sort_unstable_by(f64::total_cmp);
        cuts.dedup_by(|next, kept| *next - *kept < MERGED);
        cuts.extend(columns);
        cuts.sort_unstable_by(f64::total_cmp);

        let mut sum = Sum::default();
        let mut slabs = Vec::with_capacity(cuts.len());
        for piece in cuts.windows(2) {
            let &[x, end] = piece else { continue };
            let middle = 0.5 * (x + end);
            let (column, c) = (self.column(middle), half_chord(middle));
            let (below, top) = (self.row(0.5 - c), self.row(0.5 + c));
            // ∫ f dy up to ½ ± c is linear in y within a row, hence in c: its value at y = ½ and its slope.
            let (centre0, slope0) = self.line(column, below);
            let (centre1, slope1) = self.line(column, top);
            let (flat, curved) = (centre1 - centre0, slope1 + slope0);
            let slab = Slab { x, cumulative: sum.value(), flat, curved };
            slabs.push(slab);
            sum.add(slab.mass(x, end));
        }
        slabs.push(Slab { x: 1.0, cumulative: sum.value(), flat: 0.0, curved: 0.0 });
        self.slabs = slabs;
    }

    fn normalise(&mut self, total: f64) {
        self.scale = 1.0 / total;
        for sum in &mut self.columns {
            *sum *= self.scale;
        }
        for slab in &mut self.slabs {
            slab.cumulative = (slab.cumulative * self.scale).min(1.0);
            slab.flat *= self.scale;
            slab.curved *= self.scale;
        }
        // Every slab after the last weight ends at exactly 1.
        for slab in self.slabs.iter_mut().rev() {
            if slab.cumulative < BELOW_ONE {
                break;
            }
            slab.cumulative = 1.0;
        }
    }

    fn build_guide(&mut self) {
        let (slabs, parts) = (&self.slabs, self.slabs.len());
        let mut slab = 0;
        self.guide = (0..parts)
            .map(|part| {
                let u = part as f64 / parts as f64;
                while slabs.get(slab + 1).is_some_and(|next| next.cumulative <= u) {
                    slab += 1;
                }
                slab as u32
            })
            .collect();
    }

    /// The number of texels along x.
    #[inline]
    #[must_use]
    pub const fn width(&self) -> usize {
        self.width
    }

    /// The number of texels along y.
    #[inline]
    #[must_use]
    pub const fn height(&self) -> usize {
        self.height
    }

    /// `f(x, y)`, per unit area of the map; 0 outside the disk. It is 4 D.
    #[must_use]
    pub fn density(&self, [x, y]: [f64; 2]) -> f64 {
        let (nx, ny) = (to_normal(x), to_normal(y));
        if nx * nx + ny * ny <= 1.0 { self.texel([x, y]) } else { 0.0 }
    }

    /// `m(x)`, per unit length of the map.
    #[must_use]
    pub fn marginal(&self, x: f64) -> f64 {
        let x = coordinate(x);
        let column = self.column(x);
        let c = half_chord(x);
        (self.sum_to(column, 0.5 + c) - self.sum_to(column, 0.5 - c)).max(0.0)
    }

    /// `M(x)`, in [0, 1].
    #[must_use]
    pub fn marginal_cdf(&self, x: f64) -> f64 {
        let x = coordinate(x);
        let after = self.slabs.partition_point(|slab| slab.x <= x);
        match self.slabs.get(after.saturating_sub(1)..) {
            Some(&[slab, next, ..]) => (slab.cumulative + slab.mass(slab.x, x)).min(next.cumulative),
            _ => 1.0,
        }
    }

    /// `M⁻¹(u)`, in [0, 1]: a place where the marginal has weight.
    #[must_use]
    pub fn marginal_inverse(&self, u: f64) -> f64 {
        let u = probability(u);
        let parts = self.guide.len();
        let part = ((u * parts as f64) as usize).min(parts.saturating_sub(1));
        let guess = |part: usize| self.guide.get(part).map(|&slab| slab as usize);
        let from = guess(part).unwrap_or(0);
        let to = guess(part + 1).map_or(self.slabs.len(), |slab| slab + 2).min(self.slabs.len());
        let within = self.slabs.get(from..to).unwrap_or_default();
        let after = from + within.partition_point(|slab| slab.cumulative <= u);
        match self.slabs.get(after.saturating_sub(1)..) {
            Some(&[slab, next, ..]) => slab.inverse(u, next),
            _ => 0.5,
        }
    }

    /// `C(y|x)`, in [0, 1].
    #[must_use]
    pub fn conditional_cdf(&self, x: f64, y: f64) -> f64 {
        let (x, y) = (coordinate(x), coordinate(y));
        let (column, c) = (self.column(x), half_chord(x));
        let below = self.sum_to(column, 0.5 - c);
        let all = self.sum_to(column, 0.5 + c) - below;
        if all > 0.0 {
            ((self.sum_to(column, y) - below) / all).clamp(0.0, 1.0)
        } else if c > 0.0 {
            ((y - 0.5) / c * 0.5 + 0.5).clamp(0.0, 1.0)
        } else {
            0.5
        }
    }

    /// `C⁻¹(u|x)`, on the chord `½ ± √(x(1−x))`.
    #[must_use]
    pub fn conditional_inverse(&self, x: f64, u: f64) -> f64 {
        let (x, u) = (coordinate(x), probability(u));
        let (column, c) = (self.column(x), half_chord(x));
        let (low, high) = (0.5 - c, 0.5 + c);
        let below = self.sum_to(column, low);
        let all = self.sum_to(column, high) - below;
        if all <= 0.0 {
            return low + (high - low) * u;
        }
        let target = below + all * u;
        let sums = self.column_sums(column);
        // The row that passes the target; if rounding leaves none, the last one that has weight.
        let row = match sums.partition_point(|&sum| sum <= target) {
            after if after < sums.len() => after.saturating_sub(1),
            _ => sums.partition_point(|&sum| sum < target).saturating_sub(1),
        };
        let begin = row as f64 / self.height as f64;
        let end = (row + 1) as f64 / self.height as f64;
        let sum = sums.get(row).copied().unwrap_or(0.0);
        let y = begin + (target - sum) / self.value(column, row);
        y.max(begin).min(end.next_down()).clamp(low, high)
    }

    /// `(u₁, u₂) = (M(x), C(y|x))`.
    #[inline]
    #[must_use]
    pub fn forward(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.marginal_cdf(x), self.conditional_cdf(x, y)]
    }

    /// `(x, y)` with `x = M⁻¹(u₁)`, `y = C⁻¹(u₂|x)`; it has the density `f` if `u` is uniform on the square.
    #[inline]
    #[must_use]
    pub fn inverse(&self, [u1, u2]: [f64; 2]) -> [f64; 2] {
        let x = self.marginal_inverse(u1);
        [x, self.conditional_inverse(x, u2)]
    }

    /// The density of the texel at a point, without the disk.
    pub(crate) fn texel(&self, [x, y]: [f64; 2]) -> f64 {
        self.value(self.column(x), self.row(y))
    }

    fn column(&self, x: f64) -> usize {
        cell(x, self.width)
    }

    fn row(&self, y: f64) -> usize {
        cell(y, self.height)
    }

    fn column_sums(&self, column: usize) -> &[f64] {
        let from = column * (self.height + 1);
        self.columns.get(from..=from + self.height).unwrap_or_default()
    }

    /// The normalised density of a texel.
    fn value(&self, column: usize, row: usize) -> f64 {
        self.texels.get(column * self.height + row).map_or(0.0, |&texel| f64::from(texel) * self.scale)
    }

    /// `∫₀ʸ f` in a column as if there were no disk, for `y` in `row`: its value at `y = ½` and its slope.
    fn line(&self, column: usize, row: usize) -> (f64, f64) {
        let slope = self.value(column, row);
        let sum = self.column_sums(column).get(row).copied().unwrap_or(0.0);
        (sum + slope * (0.5 - row as f64 / self.height as f64), slope)
    }

    /// `∫₀ʸ f` in a column as if there were no disk.
    fn sum_to(&self, column: usize, y: f64) -> f64 {
        let row = self.row(y);
        let sum = self.column_sums(column).get(row).copied().unwrap_or(0.0);
        sum + self.value(column, row) * (y - row as f64 / self.height as f64)
    }
}

/// A coordinate of the map; NaN is its middle.
fn coordinate(x: f64) -> f64 {
    if x.is_nan() { 0.5 } else { x.clamp(0.0, 1.0) }
}

/// A probability below 1; NaN is 0.
fn probability(u: f64) -> f64 {
    if u.is_nan() { 0.0 } else { u.clamp(0.0, BELOW_ONE) }
}

/// Whether the texel has a part inside the disk.
pub(crate) fn texel_meets(column: usize, width: usize, row: usize, height: usize) -> bool {
    meets(texel_edges(column, width), texel_edges(row, height))
}

/// The normal coordinates of a texel's two edges along one axis.
pub(crate) fn texel_edges(index: usize, count: usize) -> [f64; 2] {
    [index, index + 1].map(|k| to_normal(k as f64 / count as f64))
}

/// Which of `n` equal cells holds `x`, by the very edges `k/n` that the pieces of the marginal have.
fn cell(x: f64, n: usize) -> usize {
    let k = ((x * n as f64) as usize).min(n.saturating_sub(1));
    let edge = |k: usize| k as f64 / n as f64;
    // The product may round across an edge: just below 4/6 it is 4, and 15/22 times 22 is below 15.
    if x < edge(k) {
        k.saturating_sub(1)
    } else if k + 1 < n && x >= edge(k + 1) {
        k + 1
    } else {
        k
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_texel_is_the_uniform_disk() {
        let cdf = Cdf::new(1, 1, vec![7.0]).unwrap();
        assert!((cdf.density([0.3, 0.6]) - 4.0 / core::f64::consts::PI).abs() < 1e-14);
        assert!((cdf.marginal_cdf(0.5) - 0.5).abs() < 1e-15);
        assert!((cdf.marginal_inverse(0.5) - 0.5).abs() < 1e-15);
        let [x, y] = cdf.inverse([0.0, 0.0]);
        assert!(x > 0.0 && x < 1e-8 && (y - 0.5).abs() < 1e-4, "{x} {y}");
        let [x, y] = cdf.inverse([1.0, 1.0]);
        assert!(x < 1.0 && x > 0.999 && (y - 0.5).abs() < 1e-3, "{x} {y}");
    }

    #[test]
    fn empty_columns_are_uniform_on_the_chord() {
        let mut texels = vec![0.0; 16];
        texels[4 + 2] = 3.0;
        let cdf = Cdf::new(4, 4, texels).unwrap();
        let c = half_chord(0.8);
        assert_eq!(cdf.marginal(0.8), 0.0);
        assert!((cdf.conditional_inverse(0.8, 0.25) - (0.5 - 0.5 * c)).abs() < 1e-15);
        assert!((cdf.conditional_cdf(0.8, 0.5 - 0.5 * c) - 0.25).abs() < 1e-15);
    }

    #[test]
    fn the_last_place_of_a_column_belongs_to_it_at_every_width() {
        for width in 1..=100 {
            for column in 0..width {
                // The middle row of three: it has weight in the disk in every column.
                let texels = (0..3 * width).map(|k| if k == 3 * column + 1 { 1.0 } else { 0.0 }).collect();
                let cdf = Cdf::new(width, 3, texels).unwrap();
                for u in [[0.0, 0.3], [BELOW_ONE, 0.3], [1.0, 0.999]] {
                    let sample = cdf.inverse(u);
                    assert!(cdf.density(sample) > 0.0, "{width} {column} {u:?}: {sample:?}");
                }
            }
        }
    }

    #[test]
    fn edges_of_u_stay_in_the_only_texel() {
        let mut texels = vec![0.0; 64];
        texels[2 * 8 + 5] = 1e-30;
        let cdf = Cdf::new(8, 8, texels).unwrap();
        for u1 in [f64::NAN, -1.0, 0.0, 1e-300, 0.5, 1.0 - 2f64.powi(-24), BELOW_ONE, 1.0, f64::INFINITY] {
            for u2 in [0.0, 0.5, 1.0 - 2f64.powi(-24), 1.0] {
                let [x, y] = cdf.inverse([u1, u2]);
                assert!((0.25..0.375).contains(&x) && (0.625..0.75).contains(&y), "{u1} {u2}: {x} {y}");
            }
        }
        assert!((cdf.density([0.3, 0.7]) - 64.0).abs() < 1e-10);
    }

    #[test]
    fn nothing_in_the_disk_is_nothing() {
        assert_eq!(Cdf::new(3, 2, vec![0.0; 6]), None);
        // The corner texels of 8×8 are outside the disk.
        let mut corner = vec![0.0; 64];
        corner[0] = 1.0;
        assert_eq!(Cdf::new(8, 8, corner), None);
    }
}
