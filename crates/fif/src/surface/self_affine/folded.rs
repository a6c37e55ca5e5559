//! The folded Hermite surface: non-separable, continuously differentiable, on any grid.

use crate::numeric::interval::{Bounded, Interval};
use crate::numeric::polynomial::UNIT;
use crate::surface::bounds::SurfaceBounds;
use crate::surface::hermite_patch::Patch;
use crate::surface::self_affine::error::SelfAffineError;
use crate::surface::self_affine::folded_limits::{limits, slope_rounding, value_rounding};
use crate::surface::self_affine::limits::Limits;
use crate::surface::self_affine::self_affine::{Cell, FoldParts, Part, SelfAffine};
use crate::surface::self_affine::zig_zag::{Grid, Strip, ZigZag, part_of};

/// A fractal surface through given heights with given gradients on a grid of unequal cells, once continuously
/// differentiable, that is no product of curves.
///
/// ```text
/// f = H + s (f − G)∘Φ,   so f = G + w,   w = (H − G) + s w∘Φ = Σ_k sᵏ (H − G)∘Φᵏ
/// Φ(x, y) = (φ(x), ψ(y)): zig-zags, affine from every cell onto the domain, rising and falling in turn
/// H: bicubic Hermite patches without twist through all heights with all gradients
/// G: such patches on the same grid, through the heights and slopes of the bilinear surface of the four corners;
///    at nodes on the border slopes across it are those given
/// ```
///
/// Why that works: H − G is 0 at the corners of the domain, and its slope across the border is 0 along all of it. Φ sends
/// nodes to corners and the lines of the grid to the border.
///
/// - **Interpolation:** `w` is 0 with its gradient at the corners, so `f = H` and `∇f = ∇H` at all nodes.
/// - **C¹:** let `w_K` be C¹ with slope 0 across the border. Over a line of the grid `w_K∘Φ` is continuous as Φ is; its slope
///   across is `±1/a` times that of `w_K` across the border, 0 on both sides, and its slope along is the same on both. So
///   `w_{K+1} = (H − G) + s w_K∘Φ` is such a function too.
/// - **Convergence:** gradients contract by `|s|/a` for the smallest share `a` of a cell in the domain, values by `|s|`. With
///   `|s| < a` the limit is C¹; its gradient is Hölder continuous ([`SelfAffine::gradient_modulus`]).
///
/// s is one number, since a factor that varies would have to be constant across every line of the grid, and since the mean
/// is known then: [`SelfAffine::mean`]. [`RoughFolded`](crate::RoughFolded) has a factor at every node, up to 1, and no slopes.
///
/// - **Domain:** `[x_0, x_m] × [y_0, y_n]`; points outside, infinite ones too, are clamped to it. NaN gives NaN.
/// - **Accuracy:** at the given nodes exact. Else within the reported bounds: values 2·10⁻¹⁵ of the range where `|s|/a` is
///   0.09, 4·10⁻¹⁴ where it is 0.75. A gradient is that of a point within some 10⁻¹⁴ of the domain's size, and its bound is
///   what the gradient may change over that distance: 2·10⁻¹³ and 6·10⁻⁹ were measured in these two cases.
///
/// Some grain is left, as the maps keep the axes: the slopes' energy within 5° of them is 1.1 to 1.6 times that of a
/// surface without direction on 8 × 8 unequal cells, 4 times on equal ones. [`Torus`](crate::Torus) has 0.19,
/// the product of two integrals of the source's f 6.6.
///
/// ```
/// use asperity_fif::Folded;
/// let z = [0.0, 1.0, 0.0, 0.5, 2.0, 0.5, 0.0, 1.0, 0.0];
/// let mut d = [[0.0; 2]; 9];
/// d[4] = [0.5, -0.25];
/// let surface = Folded::new(&[0.0, 1.0, 2.0], &[0.0, 0.8, 2.0], 0.375, &z, &d)?;
/// assert_eq!(surface.height(1.0, 0.8), 2.0);
/// assert_eq!(surface.gradient(1.0, 0.8).y, -0.25);
/// # Ok::<(), asperity_fif::SelfAffineError>(())
/// ```
pub type Folded = SelfAffine<ZigZag>;

impl SelfAffine<ZigZag> {
    /// The surface with heights `z` and gradients `d` at the nodes of the grid of knots `x` and `y`: node (i, j) lies at
    /// `(x_i, y_j)` and is entry `i · y.len() + j` of both lists.
    ///
    /// # Errors
    /// A [`SelfAffineError`] names the rule that the data break.
    pub fn new(
        x: &[f64],
        y: &[f64],
        factor: f64,
        z: &[f64],
        d: &[[f64; 2]],
    ) -> Result<Self, SelfAffineError> {
        let Grid { fold, narrowest, widest, magnitudes } = ZigZag::through(x, y, z, d)?;
        let contraction = factor.abs() / narrowest * (1.0 + 32.0 * UNIT);
        if contraction.is_nan() || contraction >= 1.0 {
            return Err(SelfAffineError::Factor { factor, most: narrowest });
        }
        let limits = limits(&fold, factor, [narrowest, widest], contraction).checked(magnitudes)?;
        Ok(Self { fold, factor, limits })
    }

    /// Cells along both axes, for other machines.
    #[doc(hidden)]
    #[must_use]
    pub fn cells(&self) -> [usize; 2] {
        self.fold.cells
    }

    /// Nodes, for other machines: x, y, then height and slopes of H, then those of H − G; lengths in units of the domain.
    #[doc(hidden)]
    pub fn nodes(&self) -> impl Iterator<Item = [f64; 8]> {
        let [wide, deep] = self.fold.domain.map(Interval::width);
        self.fold.nodes.iter().map(move |node| {
            let ([x, y], [z, z_x, z_y], [own, own_x, own_y]) = (node.at, node.data, node.own);
            [x, y, z, z_x * wide, z_y * deep, own, own_x, own_y]
        })
    }

    /// The factor by which slopes of one repetition more are smaller at least, and the middles of the ranges of w and its slopes, for
    /// other machines.
    #[doc(hidden)]
    #[must_use]
    pub fn remainder(&self) -> (f64, [f64; 3]) {
        let [x, y] = self.limits.own_slopes.map(Interval::middle);
        (self.limits.contraction, [self.limits.own.middle(), x, y])
    }
}

impl FoldParts for ZigZag {
    type Place = [f64; 2];

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
        // More steps than the least factors need; it reserves the rounding part of the bound.
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

    fn bounds(surface: &Folded, x: Interval, y: Interval) -> SurfaceBounds {
        surface.bounds_over(x, y)
    }

    fn narrow(surface: &mut Folded) {
        surface.narrow();
    }

    fn mean(surface: &Folded) -> Bounded {
        let [m, n] = surface.fold.cells;
        let (mut sum, mut size, gain) = (0.0, 0.0, surface.factor / (1.0 - surface.factor));
        for (i, j) in (0..m).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let [x, y] = [surface.fold.strip_of(0, i), surface.fold.strip_of(1, j)];
            for (part, weight) in [(Part::Data, 1.0), (Part::Own, gain)] {
                let Patch(corners) = surface.fold.patch([x, y], part);
                for (a, b, [z, z_x, z_y]) in
                    [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(a, b)| (a, b, corners[a][b]))
                {
                    let way = |end: usize| if end == 0 { 1.0 / 24.0 } else { -1.0 / 24.0 };
                    let area = x.width * y.width * weight;
                    sum += area * (0.25 * z + way(a) * z_x + way(b) * z_y);
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

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    const X: [f64; 4] = [-1.0, 0.0, 1.5, 3.0];
    const Y: [f64; 3] = [2.0, 3.0, 4.5];
    const FACTOR: f64 = 0.2;

    /// Heights, raised, and gradients of both signs.
    fn surface(sign: f64, rise: f64) -> Folded {
        let z: [f64; 12] = core::array::from_fn(|k| sign * ((5 * k + 2) % 7) as f64 + rise);
        let d: [[f64; 2]; 12] =
            core::array::from_fn(|k| [(k % 5) as f64 - 2.0, 1.5 - (k % 4) as f64].map(|slope| sign * slope));
        Folded::new(&X, &Y, FACTOR, &z, &d).unwrap()
    }

    #[test]
    fn nodes_hold_both_parts_per_width_of_the_domain() {
        let surface = surface(1.0, 0.5);
        assert_eq!(surface.cells(), [3, 2]);
        let height = |i: usize, j: usize| surface.height(X[i], Y[j]);
        let (wide, deep) = (X[3] - X[0], Y[2] - Y[0]);
        let mut nodes = surface.nodes();
        for (i, j) in (0..4).flat_map(|i| (0..3).map(move |j| (i, j))) {
            let [x, y, z, z_x, z_y, own, own_x, own_y] = nodes.next().unwrap();
            let at = [(X[i] - X[0]) / wide, (Y[j] - Y[0]) / deep];
            let gradient = surface.gradient(X[i], Y[j]);
            // The bilinear surface of the corners and its slopes, which G has at all nodes but across the border.
            let mix = |t: f64, a: f64, b: f64| (1.0 - t) * a + t * b;
            let (low, high) =
                (mix(at[0], height(0, 0), height(3, 0)), mix(at[0], height(0, 2), height(3, 2)));
            let base_x = mix(at[1], height(3, 0) - height(0, 0), height(3, 2) - height(0, 2));
            let slope_x = if i == 0 || i == 3 { 0.0 } else { gradient.x * wide - base_x };
            let slope_y = if j == 0 || j == 2 { 0.0 } else { gradient.y * deep - (high - low) };
            let expected = [
                at[0],
                at[1],
                height(i, j),
                gradient.x * wide,
                gradient.y * deep,
                height(i, j) - mix(at[1], low, high),
                slope_x,
                slope_y,
            ];
            for (got, expected) in [x, y, z, z_x, z_y, own, own_x, own_y].into_iter().zip(expected) {
                // A few roundings of numbers below 16.
                assert_abs_diff_eq!(got, expected, epsilon = 1e-14);
            }
        }
        assert!(nodes.next().is_none());
    }

    #[test]
    fn the_remainder_knows_nothing_of_a_rise_and_is_mirrored_with_the_data() {
        let of = |sign, rise| surface(sign, rise).remainder();
        let (contraction, middles) = of(1.0, 0.0);
        // The narrowest cell is a quarter of the domain.
        assert_abs_diff_eq!(contraction, FACTOR / 0.25, epsilon = 1e-14);
        // Of slopes the greatest magnitude is known, so that their middles are 0.
        let [height, ..] = middles;
        assert_eq!(middles, [height, 0.0, 0.0]);
        assert!(height.abs() > 1e-3, "{height}");
        let (raised, mirrored) = (of(1.0, 40.0).1, of(-1.0, 0.0).1);
        // Roundings of the rise.
        assert_abs_diff_eq!(raised[0], height, epsilon = 1e-11);
        assert_abs_diff_eq!(mirrored[0], -height, epsilon = 1e-14);
    }
}
