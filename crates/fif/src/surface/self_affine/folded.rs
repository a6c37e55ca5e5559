//! The folded Hermite surface: non-separable, continuously differentiable, on any grid.

use asperity_core::Interval;

use crate::numeric::estimate::Bounded;
use crate::numeric::polynomial::UNIT;
use crate::surface::bounds::SurfaceBounds;
use crate::surface::hermite_patch::Patch;
use crate::surface::self_affine::limits::Limits;
use crate::surface::self_affine::self_affine::{Cell, FoldParts, Part, SelfAffine};
use crate::surface::self_affine::zig_zag::{
    Grid, Strip, ZigZag, limits, part_of, slope_rounding, value_rounding,
};
use crate::system::error::FifError;

#[doc = include_str!("../../../docs/folded.md")]
pub type FoldedSurface = SelfAffine<ZigZag>;

impl SelfAffine<ZigZag> {
    /// Creates the surface with heights `z` and gradients `d` at the nodes of the grid of knots `x`
    /// and `y`.
    ///
    /// Node (i, j) lies at `(x_i, y_j)` and is entry `i · y.len() + j` of both lists.
    ///
    /// # Errors
    /// [`FifError`] for invalid data.
    pub fn new(x: &[f64], y: &[f64], scaling: f64, z: &[f64], d: &[[f64; 2]]) -> Result<Self, FifError> {
        let Grid { fold, narrowest, widest, magnitudes } = ZigZag::through(x, y, z, d)?;
        let contraction = scaling.abs() / narrowest * (1.0 + 32.0 * UNIT);
        if contraction.is_nan() || contraction >= 1.0 {
            return Err(FifError::SurfaceScaling { value: scaling, max: narrowest });
        }
        let limits = limits(&fold, scaling, [narrowest, widest], contraction).checked(magnitudes)?;
        Ok(Self { fold, factor: scaling, limits })
    }

    /// Cells along both axes, for shaders.
    pub(crate) fn cells(&self) -> [usize; 2] {
        self.fold.cells
    }

    /// Nodes, for shaders: x, y, then height and slopes of H, then those of H − G.
    ///
    /// Lengths are in units of the domain.
    pub(crate) fn nodes(&self) -> impl Iterator<Item = [f64; 8]> {
        let [wide, deep] = self.fold.domain.map(Interval::width);
        self.fold.nodes.iter().map(move |node| {
            let ([x, y], [z, z_x, z_y], [own, own_x, own_y]) = (node.at, node.data, node.own);
            [x, y, z, z_x * wide, z_y * deep, own, own_x, own_y]
        })
    }

    /// The guaranteed reduction of slopes per repetition, and the middles of the ranges of w and
    /// its slopes.
    ///
    /// For shaders.
    pub(crate) fn remainder(&self) -> (f64, [f64; 3]) {
        let [x, y] = self.limits.own_slopes.map(Interval::middle);
        (self.limits.contraction, [self.limits.own.middle(), x, y])
    }
}

impl FoldParts for ZigZag {
    type Position = [f64; 2];

    #[inline]
    fn domain(&self) -> [Interval; 2] {
        self.domain
    }

    #[inline]
    fn locate(&self, x: f64, y: f64) -> Option<([f64; 2], f64)> {
        let at = [part_of(self.domain[0], x), part_of(self.domain[1], y)];
        (!at[0].is_nan() && !at[1].is_nan()).then_some((at, 0.0))
    }

    #[inline]
    fn cell(&self, at: [f64; 2], part: Part) -> Cell {
        let strips = [self.strip(0, at[0]), self.strip(1, at[1])];
        let [u, v] = strips.map(|strip| strip.u);
        let node = ((u == 0.0 || u == 1.0) && (v == 0.0 || v == 1.0)).then(|| {
            let node = self.node(strips.map(|strip| strip.index + usize::from(strip.u == 1.0)));
            if part == Part::Data { node.data } else { node.own }
        });
        let index = strips.map(|strip| strip.index);
        Cell {
            index,
            patch: self.patch(strips, part),
            at: [u, v],
            widths: strips.map(|strip| strip.width),
            node,
        }
    }

    #[inline]
    fn next(&self, _: [f64; 2], cell: &Cell) -> [f64; 2] {
        [0, 1].map(|k| Strip { index: cell.index[k], width: cell.widths[k], u: cell.at[k] }.folded())
    }

    #[inline]
    fn turned(&self, jacobian: &[[f64; 2]; 2], cell: &Cell, factor: f64) -> [[f64; 2]; 2] {
        let slope = |k: usize| Strip { index: cell.index[k], width: cell.widths[k], u: 0.0 }.slope();
        [[jacobian[0][0] * factor * slope(0), 0.0], [0.0, jacobian[1][1] * factor * slope(1)]]
    }

    #[inline]
    fn value_enough(limits: &Limits, tolerance: f64) -> f64 {
        let floor = value_rounding(limits, 64);
        if tolerance > 2.5 * floor { 0.5 * tolerance } else { 0.25 * floor }
    }

    #[inline]
    fn value_rounding(limits: &Limits, steps: u32) -> f64 {
        value_rounding(limits, steps)
    }

    #[inline]
    fn slope_enough(limits: &Limits, tolerance: f64) -> f64 {
        // More steps than the smallest scalings need, which reserves the rounding part of the
        // bound.
        let floor = slope_rounding(limits, 256);
        let spare = tolerance - floor;
        if spare > floor { spare } else { floor }
    }

    #[inline]
    fn slope_rounding(limits: &Limits, steps: u32, _: f64) -> f64 {
        slope_rounding(limits, steps)
    }

    fn narrowest(&self, limits: &Limits) -> f64 {
        let [wide, deep] = self.domain.map(Interval::width);
        (if wide < deep { wide } else { deep }) / limits.stretch
    }

    fn bounds(surface: &FoldedSurface, x: Interval, y: Interval) -> SurfaceBounds {
        surface.bounds_over(x, y)
    }

    fn narrow(surface: &mut FoldedSurface) {
        surface.narrow();
    }

    fn mean(surface: &FoldedSurface) -> Bounded {
        let [m, n] = surface.fold.cells;
        let (mut sum, mut size, gain) = (0.0, 0.0, surface.factor / (1.0 - surface.factor));
        for (i, j) in (0..m).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let [x, y] = [surface.fold.strip_of(0, i), surface.fold.strip_of(1, j)];
            for (part, weight) in [(Part::Data, 1.0), (Part::Own, gain)] {
                let Patch(corners) = surface.fold.patch([x, y], part);
                for (a, b, [z, z_x, z_y]) in
                    [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(a, b)| (a, b, corners[a][b]))
                {
                    let moment = |end: usize| if end == 0 { 1.0 / 24.0 } else { -1.0 / 24.0 };
                    let area = x.width * y.width * weight;
                    sum += area * (0.25 * z + moment(a) * z_x + moment(b) * z_y);
                    size += area.abs() * (0.25 * z.abs() + (z_x.abs() + z_y.abs()) / 24.0);
                }
            }
        }
        let roundings = 8.0 * (m * n) as f64 + 64.0 + 8.0 * gain.abs();
        let bound = UNIT * roundings * size + (1.0 + gain.abs()) * surface.limits.noise[0];
        Bounded { value: sum, bound: 1.01 * bound }
    }

    fn searched(&self, x: Interval, y: Interval) -> [Interval; 2] {
        let cut = |range: Interval, side: Interval| {
            let part = range.intersection(side);
            if part.width() >= 0.0 { part } else { side }
        };
        [cut(x, self.domain[0]), cut(y, self.domain[1])]
    }
}
