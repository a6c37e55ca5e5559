//! Reference distribution functions of a map in `f64`, by quadrature, for testing maps in `f32`.

use asperity_ndf_sampling::{Measure, NdfMap, Reconstruction};
use core::f64::consts::PI;

/// Nodes and weights of Gauss quadrature on [0, 1].
const GAUSS: [(f64, f64); 5] = [
    (0.046_910_077_030_668, 0.118_463_442_528_094_55),
    (0.230_765_344_947_158_45, 0.239_314_335_249_683_24),
    (0.5, 0.284_444_444_444_444_45),
    (0.769_234_655_052_841_6, 0.239_314_335_249_683_24),
    (0.953_089_922_969_332, 0.118_463_442_528_094_55),
];

/// Texels over the disk, for densities over normals.
pub(crate) struct ExactMap {
    size: [usize; 2],
    kind: Reconstruction,
    /// Column by column. Texels outside the disk are replaced by the nearest texel inside in their
    /// column.
    columns: Vec<Vec<f64>>,
    /// Angles `φ` of `n_x = −cos φ` between which the marginal is smooth, and the integral of the
    /// density up to each.
    knots: Vec<f64>,
    sums: Vec<f64>,
}

impl ExactMap {
    pub(crate) fn new(width: usize, height: usize, texels: &[f32], kind: Reconstruction) -> Self {
        let range = |k: usize, n: usize| [k, k + 1].map(|k| 2.0 * k as f64 / n as f64 - 1.0);
        let nearest = |[from, to]: [f64; 2]| 0.0_f64.clamp(from, to);
        let column = |i: usize| {
            let meets = |j: &usize| nearest(range(i, width)).hypot(nearest(range(*j, height))) < 1.0;
            let (first, last) =
                ((0..height).find(meets).expect("a row"), (0..height).rfind(meets).expect("a row"));
            (0..height).map(|j| f64::from(texels[j.clamp(first, last) * width + i])).collect()
        };
        let lines = |n: usize| {
            let offset = if kind == Reconstruction::Bilinear { 0.5 } else { 0.0 };
            (0..=n).map(move |k| 2.0 * (k as f64 + offset) / n as f64 - 1.0).filter(|line| line.abs() < 1.0)
        };
        let across = lines(height).flat_map(|y| [y.abs().asin(), PI - y.abs().asin()]);
        let mut knots: Vec<f64> = lines(width)
            .map(|x| (-x).acos())
            .chain(across)
            .chain((0..=64).map(|k| PI * f64::from(k) / 64.0))
            .collect();
        knots.sort_by(f64::total_cmp);
        let columns = (0..width).map(column).collect();
        let mut map = Self { size: [width, height], kind, columns, knots, sums: vec![0.0] };
        for k in 1..map.knots.len() {
            map.sums.push(map.sums[k - 1] + map.mass(map.knots[k - 1], map.knots[k]));
        }
        map
    }

    /// Returns the map of texels, exact and in `f32`.
    pub(crate) fn both(width: usize, height: usize, texels: &[f32], kind: Reconstruction) -> (Self, NdfMap) {
        let map =
            NdfMap::from_texels(width, height, texels, Measure::ProjectedSolidAngle, kind).expect("valid");
        (Self::new(width, height, texels, kind), map)
    }

    /// Returns the cell of a coordinate: its two texels and the position between them.
    fn cell(&self, axis: usize, n: f64) -> (usize, usize, f64) {
        let size = self.size[axis];
        let at = (0.5 * (n + 1.0) * size as f64).clamp(0.0, size as f64);
        if self.kind == Reconstruction::Bilinear {
            let cell = (at + 0.5) as usize;
            (cell.saturating_sub(1), cell.min(size - 1), at + 0.5 - cell as f64)
        } else {
            ((at as usize).min(size - 1), (at as usize).min(size - 1), 0.0)
        }
    }

    /// Returns the density at a position, before normalization.
    fn value(&self, x: f64, y: f64) -> f64 {
        let ((left, right, s), (below, above, t)) = (self.cell(0, x), self.cell(1, y));
        let along = |column: usize| (1.0 - t) * self.columns[column][below] + t * self.columns[column][above];
        (1.0 - s) * along(left) + s * along(right)
    }

    /// Returns the integral along y.
    fn integral(&self, x: f64, from: f64, to: f64) -> f64 {
        let (height, offset) =
            (self.size[1] as f64, if self.kind == Reconstruction::Bilinear { 0.5 } else { 0.0 });
        let cell = |y: f64| (0.5 * (y + 1.0) * height - offset).floor() as i64;
        let line = |cell: i64| 2.0 * (cell as f64 + offset) / height - 1.0;
        let part = |cell: i64| {
            let (a, b) = (line(cell).clamp(from, to), line(cell + 1).clamp(from, to));
            self.value(x, 0.5 * (a + b)) * (b - a)
        };
        (cell(from)..=cell(to)).map(part).sum()
    }

    fn mass(&self, from: f64, to: f64) -> f64 {
        let at = |t: f64| {
            let (sin, cos) = (from + (to - from) * t).sin_cos();
            self.integral(-cos, -sin, sin) * sin
        };
        GAUSS.iter().map(|&(t, weight)| weight * at(t)).sum::<f64>() * (to - from)
    }

    fn total(&self) -> f64 {
        self.sums[self.sums.len() - 1]
    }

    /// Returns `D` inside the disk.
    pub(crate) fn density(&self, x: f64, y: f64) -> f64 {
        self.value(x, y) / self.total()
    }

    /// Returns the marginal density of `n_x`.
    pub(crate) fn marginal(&self, x: f64) -> f64 {
        let c = (1.0 - x * x).max(0.0).sqrt();
        self.integral(x, -c, c) / self.total()
    }

    /// Returns the maximum density at this `n_x`, over the marginal.
    pub(crate) fn peak(&self, x: f64) -> f64 {
        let c = (1.0 - x * x).max(0.0).sqrt();
        let most = (0..=256).map(|k| self.value(x, c * (f64::from(k) / 128.0 - 1.0))).fold(0.0, f64::max);
        most / self.integral(x, -c, c).max(1e-300)
    }

    /// Returns `(M, C)` of a normal.
    pub(crate) fn forward(&self, x: f64, y: f64) -> [f64; 2] {
        let phi = (-x.clamp(-1.0, 1.0)).acos();
        let k = self.knots.partition_point(|&knot| knot <= phi).clamp(1, self.knots.len() - 1) - 1;
        let sum = self.sums[k] + self.mass(self.knots[k], phi);
        let c = (1.0 - x * x).max(0.0).sqrt();
        let (below, all) = (self.integral(x, -c, y.clamp(-c, c)), self.integral(x, -c, c));
        let conditional = if all > 0.0 { below / all } else { 0.5 + 0.5 * (y / c).clamp(-1.0, 1.0) };
        [sum / self.total(), conditional]
    }
}
