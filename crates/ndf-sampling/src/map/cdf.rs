//! Marginal and conditional distribution functions of a density on the disk, and their exact inverses.

use alloc::vec::Vec;

use crate::map::breakpoints::Breakpoints;
use crate::map::columns::{Columns, Strip};
use crate::map::disk::to_normal;
use crate::map::piece::Piece;
use crate::map::pieces::pieces;
use crate::map::prefix_sums::WINDOW;
use crate::map::reconstruction::Reconstruction;
use crate::map::row_guide::{RowGuide, row_of};
use crate::numeric::bernstein::cubic;
use crate::numeric::compensated_sum::CompensatedSums;
use crate::numeric::guide_table::GuideTable;
use asperity_core::math;

/// The largest `f64` below 1: `u = 1` counts as this, so that inversion ends inside the density.
pub(crate) const BELOW_ONE: f64 = 1.0 - f64::EPSILON / 2.0;

/// The marginal and conditional distribution functions of a density on the (x, y) map of normals.
///
/// ```text
/// x = (n_x + 1)/2, y = (n_y + 1)/2;   f(x, y) = 4 D inside the disk, 0 outside
/// m(x) = ∫ f dy,  M(x) = ∫₀ˣ m,   c(y|x) = f/m,  C(y|x) = ∫₀ʸ c;     x = M⁻¹(u₁), y = C⁻¹(u₂|x)
/// ```
///
/// The density is constant on each texel, or bilinear between their centres, **and clipped to the disk**: a texel at the rim
/// counts with the part of it that is inside, so no sample leaves the disk.
///
/// The disk's rim is cut where it crosses a line of the grid, and where that leaves more, at every 2√3/1024 of angle. At the breakpoints
/// `M` is that of the circle. Between two breakpoints the rim is a straight chord: `m` is a polynomial of degree 3 (1 for constant texels), `M` of
/// degree 4, inverted by bracketed Newton steps from the closed form for a linear `m`; the conditional is linear in `y` for
/// constant texels, else quadratic, and inverted in closed form. The chords leave out less than 1.5e-6 of the disk's radius
/// and 1.91e-6 of its area; their pieces' weight is that of the circle, so what is left out is spread over the same piece.
///
/// - **Domain:** every argument is clamped to [0, 1] (and `y` to the chord at `x`); NaN counts as ½ for `x` and `y`, 0 for `u`.
/// - **Where `m(x) = 0`** the conditional is uniform on the chord.
/// - **Accuracy:** `forward(inverse(u)) = u` within 1e-10 for every `u`, and within 1e-14 but next to the ends of weight, where
///   the chord shrinks to a point. `f64` throughout, sums compensated: in `f32` prefix sums lose the rows of small weight.
///
/// ```
/// use asperity_ndf_sampling::{Measure, NdfMap, Reconstruction};
///
/// let map = NdfMap::from_fn(16, 16, Measure::Normals, Reconstruction::Bilinear, |n| n.z)?;
/// let [x, y] = map.cdf().inverse([0.25, 0.75]);
/// let [u1, u2] = map.cdf().forward([x, y]);
/// assert!((u1 - 0.25).abs() < 1e-12 && (u2 - 0.75).abs() < 1e-12);
/// # Ok::<(), asperity_ndf_sampling::NdfMapError>(())
/// ```
///
/// Kautz, Heidrich, Seidel 2001, section 4 (the functions m, M, c, C).
#[derive(Clone, Debug, PartialEq)]
pub struct Cdf {
    pub(crate) columns: Columns,
    /// Factor of the values by which the integral over the disk is 1.
    pub(crate) scale: f64,
    pub(crate) pieces: Vec<Piece>,
    /// Beginnings of the pieces, and 1.
    pub(crate) places: Vec<f64>,
    /// `M` there.
    pub(crate) cumulative: Vec<f64>,
    pub(crate) by_place: GuideTable,
    pub(crate) by_weight: GuideTable,
    by_quantile: RowGuide,
}

impl Cdf {
    /// The functions of columns of values that are finite and not negative; nothing if no weight is in the disk.
    pub(crate) fn new(columns: Columns) -> Option<Self> {
        let height = columns.height as f64;
        let breakpoints = Breakpoints::new(columns.width, columns.height, columns.kind);
        let (pieces, masses) = pieces(&columns, &breakpoints);
        let places = breakpoints.places;
        let mut sum = CompensatedSums::default();
        let mut cumulative = Vec::with_capacity(places.len());
        cumulative.push(0.0);
        cumulative.extend(masses.iter().map(|&mass| {
            sum.add([mass]);
            sum.values()[0]
        }));
        let [total] = sum.values();
        if !(total > 0.0 && (1.0 / total).is_finite()) {
            return None;
        }
        let per_total = 1.0 / total;
        for sum in &mut cumulative {
            *sum = (*sum * per_total).min(1.0);
        }
        // Every piece after the last weight ends at exactly 1.
        for sum in cumulative.iter_mut().rev().take_while(|sum| **sum >= BELOW_ONE) {
            *sum = 1.0;
        }
        if let Some(last) = cumulative.last_mut() {
            *last = 1.0;
        }
        let (by_place, by_weight) = (GuideTable::new(&places), GuideTable::new(&cumulative));
        let by_quantile = RowGuide::new(&columns);
        let scale = height * per_total;
        Some(Self { columns, scale, pieces, places, cumulative, by_place, by_weight, by_quantile })
    }

    /// The number of texels along x.
    #[inline]
    #[must_use]
    pub const fn width(&self) -> usize {
        self.columns.width
    }

    /// The number of texels along y.
    #[inline]
    #[must_use]
    pub const fn height(&self) -> usize {
        self.columns.height
    }

    /// Reconstruction between the texels' centres.
    #[inline]
    #[must_use]
    pub const fn reconstruction(&self) -> Reconstruction {
        self.columns.kind
    }

    /// `f(x, y)`, per unit area of the map; 0 outside the disk. It is 4 D.
    #[inline]
    #[must_use]
    pub fn density(&self, [x, y]: [f64; 2]) -> f64 {
        let (nx, ny) = (to_normal(x), to_normal(y));
        if nx * nx + ny * ny <= 1.0 { self.value([x, y]) } else { 0.0 }
    }

    /// `m(x)`, per unit length of the map.
    #[must_use]
    pub fn marginal(&self, x: f64) -> f64 {
        let x = coordinate(x);
        match self.pieces.get(self.piece(x)) {
            Some(piece) => cubic(piece.marginal, piece.place(x)) * self.scale / self.height() as f64,
            None => 0.0,
        }
    }

    /// `M(x)`, in [0, 1].
    #[must_use]
    pub fn marginal_cdf(&self, x: f64) -> f64 {
        let x = coordinate(x);
        let k = self.piece(x);
        match self.pieces.get(k) {
            Some(piece) if x < 1.0 => self.cumulative_at(k, piece, piece.place(x)),
            _ => 1.0,
        }
    }

    /// `M⁻¹(u)`, in [0, 1]: a place where the marginal has weight.
    #[must_use]
    pub fn marginal_inverse(&self, u: f64) -> f64 {
        self.find(probability(u)).map_or(0.5, |(_, _, x)| x)
    }

    /// `C(y|x)`, in [0, 1].
    #[must_use]
    pub fn conditional_cdf(&self, x: f64, y: f64) -> f64 {
        let x = coordinate(x);
        self.pieces.get(self.piece(x)).map_or(0.5, |piece| self.conditional(piece, piece.place(x), x, y))
    }

    /// `C⁻¹(u|x)`, on the chord `½ ± √(x(1−x))`.
    #[must_use]
    pub fn conditional_inverse(&self, x: f64, u: f64) -> f64 {
        let x = coordinate(x);
        self.pieces
            .get(self.piece(x))
            .map_or(0.5, |piece| self.invert_conditional(piece, piece.place(x), x, u))
    }

    /// `(u₁, u₂) = (M(x), C(y|x))`.
    #[inline]
    #[must_use]
    pub fn forward(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let x = coordinate(x);
        let k = self.piece(x);
        let Some(piece) = self.pieces.get(k) else { return [0.5; 2] };
        let s = piece.place(x);
        [if x < 1.0 { self.cumulative_at(k, piece, s) } else { 1.0 }, self.conditional(piece, s, x, y)]
    }

    /// `(x, y)` with `x = M⁻¹(u₁)`, `y = C⁻¹(u₂|x)`; it has the density `f` if `u` is uniform on the square.
    #[inline]
    #[must_use]
    pub fn inverse(&self, [u1, u2]: [f64; 2]) -> [f64; 2] {
        let Some((piece, s, x)) = self.find(probability(u1)) else { return [0.5; 2] };
        [x, self.invert_conditional(piece, s, x, u2)]
    }

    /// The density at a point, without the disk.
    #[inline]
    pub(crate) fn value(&self, at: [f64; 2]) -> f64 {
        self.columns.value(at) * self.scale
    }

    /// The piece that holds `x`.
    #[inline]
    fn piece(&self, x: f64) -> usize {
        self.by_place.find(&self.places, x).min(self.pieces.len().saturating_sub(1))
    }

    /// `M` at a place of piece `k`.
    #[inline]
    fn cumulative_at(&self, k: usize, piece: &Piece, s: f64) -> f64 {
        match self.cumulative.get(k..) {
            Some(&[from, to, ..]) => (from + (to - from) * piece.share(s)).min(to),
            _ => 1.0,
        }
    }

    /// The piece in which `M` is `u`, the place in it, and `x`.
    #[inline]
    fn find(&self, u: f64) -> Option<(&Piece, f64, f64)> {
        let k = self.by_weight.find(&self.cumulative, u).min(self.pieces.len().saturating_sub(1));
        let (piece, &[from, to]) = (self.pieces.get(k)?, self.cumulative.get(k..k + 2)?.first_chunk()?);
        let (s, x) = piece.inverse((u - from) / (to - from), to - from);
        Some((piece, s, x))
    }

    fn conditional(&self, piece: &Piece, s: f64, x: f64, y: f64) -> f64 {
        let (c, y) = (piece.half_chord(s), coordinate(y));
        let y = y.clamp(0.5 - c, 0.5 + c);
        let marginal = cubic(piece.marginal, s);
        if marginal < f64::MIN_POSITIVE {
            return if c > 0.0 { ((y - 0.5) / c * 0.5 + 0.5).clamp(0.0, 1.0) } else { 0.5 };
        }
        let kind = self.reconstruction();
        let strip = self.columns.strip(piece.column as usize);
        let t = place_in_column(kind, x, self.width(), piece.column as usize);
        let row = kind.cell(y, self.height()).clamp(piece.rows[0] as usize, piece.rows[1] as usize);
        let q = (y * self.height() as f64 + kind.offset() - row as f64).clamp(0.0, 1.0);
        let [a, b] = strip.row(t, row);
        let sum = strip.sum(t, row) + q * ((1.0 - 0.5 * q) * a + 0.5 * q * b);
        ((sum + cubic(piece.below, s)) / marginal).clamp(0.0, 1.0)
    }

    fn invert_conditional(&self, piece: &Piece, s: f64, x: f64, u: f64) -> f64 {
        let (u, c) = (probability(u), piece.half_chord(s));
        let (low, high) = (0.5 - c, 0.5 + c);
        let marginal = cubic(piece.marginal, s);
        if marginal < f64::MIN_POSITIVE {
            return low + (high - low) * u;
        }
        let kind = self.reconstruction();
        let column = piece.column as usize;
        let (strip, rows) = (self.columns.strip(column), piece.rows.map(|row| row as usize));
        let t = place_in_column(kind, x, self.width(), column);
        // Rounding may put the target beyond the weight at either end.
        let top = strip.sum(t, rows[1] + 1);
        let target = (u * marginal - cubic(piece.below, s)).max(strip.sum(t, rows[0])).min(top);
        let row = if target < top {
            find_row(strip, t, target, rows, self.by_quantile.line(column, u))
        } else {
            // The last row that has weight.
            row_of(|row| strip.sum(t, row) < target, rows, rows[1])
        };
        let [a, b] = strip.row(t, row);
        let excess = (target - strip.sum(t, row)).max(0.0);
        let root = math::sqrt_f64((a * a + 2.0 * (b - a) * excess).max(0.0));
        let q = if excess > 0.0 { 2.0 * excess / (a + root) } else { 0.0 };
        let height = self.height();
        let [begin, end] = [row, row + 1].map(|line| kind.line(line, height));
        let y = begin + q.min(1.0) / height as f64;
        y.max(begin).min(end.next_down()).clamp(low, high)
    }
}

/// The last of the rows from `first` to `last` that begins before the target or at it, looked for from a line of the grid on.
#[inline]
fn find_row(strip: Strip<'_>, t: f64, target: f64, rows: [usize; 2], from: usize) -> usize {
    let mut line = from;
    for _ in 0..3 {
        match strip.passed(t, line, target) {
            Some(0) if line > 0 => line = line.saturating_sub(WINDOW),
            Some(passed @ 1..WINDOW) => return (line + passed - 1).clamp(rows[0], rows[1]),
            Some(WINDOW) => line += WINDOW,
            _ => break,
        }
    }
    row_of(|row| strip.sum(t, row) <= target, rows, line)
}

/// Place of `x` from the left to the right side of a column of cells; 0 if its density is the same on both.
#[inline]
pub(crate) fn place_in_column(kind: Reconstruction, x: f64, width: usize, column: usize) -> f64 {
    match kind {
        Reconstruction::Constant => 0.0,
        Reconstruction::Bilinear => (x * width as f64 + kind.offset() - column as f64).clamp(0.0, 1.0),
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::texels::{Measure, columns_of_texels, texel_meets};
    use alloc::vec;

    /// Column by column.
    fn constant(width: usize, height: usize, values: &[f32]) -> Option<Cdf> {
        let texels: Vec<f32> = (0..values.len()).map(|k| values[k % width * height + k / width]).collect();
        cdf(width, height, &texels, Reconstruction::Constant)
    }

    fn cdf(width: usize, height: usize, texels: &[f32], kind: Reconstruction) -> Option<Cdf> {
        Cdf::new(columns_of_texels(width, height, texels, Measure::Normals, kind).unwrap())
    }

    #[test]
    fn one_texel_is_the_uniform_disk() {
        let bilinear = cdf(1, 1, &[7.0], Reconstruction::Bilinear);
        for cdf in [constant(1, 1, &[7.0]).unwrap(), bilinear.unwrap()] {
            asperity_core::assert_abs_diff_eq!(
                cdf.density([0.3, 0.6]),
                4.0 / core::f64::consts::PI,
                epsilon = 1e-13
            );
            asperity_core::assert_abs_diff_eq!(cdf.marginal_cdf(0.5), 0.5, epsilon = 1e-15);
            asperity_core::assert_abs_diff_eq!(cdf.marginal_inverse(0.5), 0.5, epsilon = 1e-15);
            // At a breakpoint M is that of the circle, (θ − sin θ cos θ)/π; between two it differs by less than their segment.
            let breakpoint = cdf.places[100];
            let theta = (1.0 - 2.0 * breakpoint).acos();
            let circle = (theta - theta.sin() * theta.cos()) / core::f64::consts::PI;
            asperity_core::assert_abs_diff_eq!(cdf.marginal_cdf(breakpoint), circle, epsilon = 1e-14);
            for (u, ends) in [(0.0, 0.0..1e-6), (1.0, 0.999..1.0)] {
                let [x, y] = cdf.inverse([u, u]);
                assert!(x > 0.0 && ends.contains(&x), "{x} {y}");
                asperity_core::assert_abs_diff_eq!(y, 0.5, epsilon = 1e-3, "{x}");
            }
        }
    }

    #[test]
    fn empty_columns_are_uniform_on_the_chord() {
        let mut texels = vec![0.0; 16];
        texels[4 + 2] = 3.0;
        let cdf = constant(4, 4, &texels).unwrap();
        let c = cdf.pieces[cdf.piece(0.8)].half_chord(cdf.pieces[cdf.piece(0.8)].place(0.8));
        assert_eq!(cdf.marginal(0.8), 0.0);
        asperity_core::assert_abs_diff_eq!(
            cdf.conditional_inverse(0.8, 0.25),
            (0.5 - 0.5 * c),
            epsilon = 1e-15
        );
        asperity_core::assert_abs_diff_eq!(cdf.conditional_cdf(0.8, 0.5 - 0.5 * c), 0.25, epsilon = 1e-15);
    }

    #[test]
    fn the_last_place_of_a_column_belongs_to_it_at_every_width() {
        for width in (1..=24).chain([49, 93, 100]) {
            for column in 0..width {
                // The middle row of three: it has weight in the disk in every column.
                let texels: Vec<f32> =
                    (0..3 * width).map(|k| if k == 3 * column + 1 { 1.0 } else { 0.0 }).collect();
                let cdf = constant(width, 3, &texels).unwrap();
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
        let cdf = constant(8, 8, &texels).unwrap();
        for u1 in [f64::NAN, -1.0, 0.0, 1e-300, 0.5, 1.0 - 2f64.powi(-24), BELOW_ONE, 1.0, f64::INFINITY] {
            for u2 in [0.0, 0.5, 1.0 - 2f64.powi(-24), 1.0] {
                let [x, y] = cdf.inverse([u1, u2]);
                assert!((0.25..0.375).contains(&x) && (0.625..0.75).contains(&y), "{u1} {u2}: {x} {y}");
            }
        }
        asperity_core::assert_abs_diff_eq!(cdf.density([0.3, 0.7]), 64.0, epsilon = 1e-10);
    }

    #[test]
    fn every_texel_with_a_part_in_the_disk_has_weight() {
        for (width, height) in [(1, 1), (3, 2), (8, 8), (10, 10), (13, 64)] {
            for texel in 0..width * height {
                let mut texels = vec![0.0; width * height];
                texels[texel] = 1.0;
                let meets = texel_meets(texel / height, width, texel % height, height);
                assert_eq!(
                    constant(width, height, &texels).is_some(),
                    meets,
                    "{texel} of {width} × {height}"
                );
            }
        }
    }
}
