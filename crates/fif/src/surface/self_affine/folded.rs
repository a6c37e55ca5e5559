//! The folded Hermite surface: non-separable, continuously differentiable, on any grid.

use crate::numeric::interval::{Bounded, Interval};
use crate::numeric::polynomial::UNIT;
use crate::surface::hermite_patch::{Corner, Patch};
use crate::surface::self_affine::folded_error::FoldedError;
use crate::surface::self_affine::folded_limits::FoldedLimits;
use crate::surface::self_affine::folded_node::{FoldedNode, FoldedStorage, FoldedView};

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
///   `|s| < a` the limit is C¹; its gradient is Hölder continuous ([`FoldedSurface::gradient_modulus`]).
///
/// s is one number, since a factor that varies would have to be constant across every line of the grid, and since the mean
/// is known then: [`FoldedSurface::mean`].
///
/// - **Domain:** `[x_0, x_m] × [y_0, y_n]`; points outside, infinite ones too, are clamped to it. NaN gives NaN.
/// - **Accuracy:** at the given nodes exact. Else within the reported bounds: values 2·10⁻¹⁵ of the range where `|s|/a` is
///   0.09, 4·10⁻¹⁴ where it is 0.75. A gradient is that of a point within some 10⁻¹⁴ of the domain's size, and its bound is
///   what the gradient may change over that distance: 2·10⁻¹³ and 6·10⁻⁹ were measured in these two cases.
///
/// Some grain is left, as the maps keep the axes: the slopes' energy within 5° of them is 1.1 to 1.6 times that of a
/// surface without direction on 8 × 8 unequal cells, 4 times on equal ones. [`TorusSurface`](crate::TorusSurface) has 0.19,
/// the product of two integrals of the source's f 6.6.
///
/// ```
/// use asperity_fif::FixedFolded;
/// let z = [0.0, 1.0, 0.0, 0.5, 2.0, 0.5, 0.0, 1.0, 0.0];
/// let mut d = [[0.0; 2]; 9];
/// d[4] = [0.5, -0.25];
/// let surface = FixedFolded::<9>::new(&[0.0, 1.0, 2.0], &[0.0, 0.8, 2.0], 0.375, &z, &d)?;
/// assert_eq!(surface.height(1.0, 0.8), 2.0);
/// assert_eq!(surface.gradient(1.0, 0.8).y, -0.25);
/// # Ok::<(), asperity_fif::FoldedError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct FoldedSurface<S> {
    pub(crate) nodes: S,
    pub(crate) cells: [usize; 2],
    pub(crate) domain: [Interval; 2],
    pub(crate) factor: f64,
    pub(crate) limits: FoldedLimits,
}

/// A cell of one axis, and a place within it.
#[derive(Clone, Copy)]
pub(crate) struct Strip {
    pub(crate) index: usize,
    /// In units of the domain.
    pub(crate) width: f64,
    /// In units of the cell.
    pub(crate) u: f64,
}

impl Strip {
    /// Where Φ sends the place.
    #[inline]
    pub(crate) fn folded(self) -> f64 {
        if self.index.is_multiple_of(2) { self.u } else { 1.0 - self.u }
    }

    /// The slope of Φ, or of the zig-zag along this axis.
    #[inline]
    pub(crate) fn slope(self) -> f64 {
        if self.index.is_multiple_of(2) { 1.0 / self.width } else { -1.0 / self.width }
    }
}

/// Which of a node's two functions.
#[derive(Clone, Copy)]
pub(crate) enum Part {
    /// `H`.
    Data,
    /// `H − G`.
    Own,
}

impl<S: FoldedStorage> FoldedSurface<S> {
    /// The surface with heights `z` and gradients `d` at the nodes of the grid of knots `x` and `y`: node (i, j) lies at
    /// `(x_i, y_j)` and is entry `i · y.len() + j` of both lists.
    ///
    /// # Errors
    /// A [`FoldedError`] names the rule that the data break.
    pub fn new(x: &[f64], y: &[f64], factor: f64, z: &[f64], d: &[[f64; 2]]) -> Result<Self, FoldedError> {
        let along = [knots(0, x)?, knots(1, y)?];
        let expected = x.len().saturating_mul(y.len());
        if z.len() != expected || d.len() != expected {
            return Err(FoldedError::Length { expected, heights: z.len(), gradients: d.len() });
        }
        let axis = usize::from(along[1].narrowest < along[0].narrowest);
        let [Spacing { cell, narrowest: ratio, .. }, _] =
            if axis == 0 { along } else { [along[1], along[0]] };
        let contraction = factor.abs() / ratio * (1.0 + 32.0 * UNIT);
        if contraction.is_nan() || contraction >= 1.0 {
            return Err(FoldedError::NotContractive { factor, axis, cell, ratio });
        }
        let given = || z.iter().zip(d).map(|(&z, &[x, y])| [z, x, y]);
        let mut magnitude = 0.0_f64;
        for (index, data) in given().enumerate() {
            for value in data {
                if !value.is_finite() {
                    return Err(FoldedError::NotFinite { node: [index / y.len(), index % y.len()], value });
                }
                magnitude = magnitude.max(value.abs());
            }
        }
        let mut nodes = S::with_len(expected).map_err(|found| FoldedError::Storage { expected, found })?;
        let domain = along.map(|axis| axis.domain);
        let corner = |i: usize, j: usize| z.get(i * (x.len() - 1) * y.len() + j * (y.len() - 1));
        let corner = |i, j| corner(i, j).copied().unwrap_or(0.0);
        let corners = [[corner(0, 0), corner(0, 1)], [corner(1, 0), corner(1, 1)]];
        let places = x.iter().enumerate().flat_map(|p| y.iter().enumerate().map(move |q| (p, q)));
        for ((node, [z, z_x, z_y]), ((i, &px), (j, &py))) in
            nodes.as_mut().iter_mut().zip(given()).zip(places)
        {
            let at = [part_of(domain[0], px), part_of(domain[1], py)];
            let data = [z, z_x, z_y];
            let [base, base_x, base_y] = bilinear(&corners, at);
            let (ends_x, ends_y) = (i == 0 || i + 1 == x.len(), j == 0 || j + 1 == y.len());
            let own = [
                if ends_x && ends_y { 0.0 } else { z - base },
                if ends_x { 0.0 } else { z_x * domain[0].width() - base_x },
                if ends_y { 0.0 } else { z_y * domain[1].width() - base_y },
            ];
            *node = FoldedNode { at, data, own };
        }
        let cells = [x.len() - 1, y.len() - 1];
        let mut surface = Self { nodes, cells, domain, factor, limits: FoldedLimits::EMPTY };
        let widest = along[0].widest.max(along[1].widest);
        surface.limits = FoldedLimits::new(&surface, [ratio, widest], contraction);
        if surface.limits.is_finite() { Ok(surface) } else { Err(FoldedError::TooLarge { magnitude }) }
    }
}

impl<S: AsRef<[FoldedNode]>> FoldedSurface<S> {
    /// The same surface over borrowed nodes.
    #[inline]
    #[must_use]
    pub fn view(&self) -> FoldedView<'_> {
        let &Self { ref nodes, cells, domain, factor, limits } = self;
        FoldedSurface { nodes: nodes.as_ref(), cells, domain, factor, limits }
    }

    /// `[x_0, x_m]` and `[y_0, y_n]`.
    #[inline]
    #[must_use]
    pub const fn domain(&self) -> [Interval; 2] {
        self.domain
    }

    /// The vertical factor s.
    #[inline]
    #[must_use]
    pub const fn factor(&self) -> f64 {
        self.factor
    }

    /// A rigorous enclosure of all heights.
    #[inline]
    #[must_use]
    pub const fn range(&self) -> Interval {
        self.limits.range
    }

    /// Rigorous enclosures of `∂f/∂x` and `∂f/∂y`.
    #[inline]
    #[must_use]
    pub fn slope_range(&self) -> [Interval; 2] {
        self.per_domain(self.limits.slopes)
    }

    /// The mean height over the domain, exact up to the rounding error that is reported.
    ///
    /// ```text
    /// ∫ w∘Φ = Σ_cells (area of the cell / area of the domain) ∫ w = ∫ w,   so ∫ f = ∫ H + s/(1 − s) ∫ (H − G)
    /// ∫ over a cell of widths a, b = a b Σ_corners (z/4 ± a z_x/24 ± b z_y/24), + at its lower ends
    /// ```
    ///
    /// ```
    /// # use asperity_fif::FixedFolded;
    /// let z = [0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0];
    /// let surface = FixedFolded::<9>::new(&[0.0, 1.0, 3.0], &[0.0, 1.0, 2.0], 0.25, &z, &[[0.0; 2]; 9])?;
    /// let mean = surface.mean(); // H = H − G is a bump of mean 1/4
    /// assert!((mean.value - 1.0 / 3.0).abs() <= mean.bound && mean.bound < 1e-13);
    /// # Ok::<(), asperity_fif::FoldedError>(())
    /// ```
    #[must_use]
    pub fn mean(&self) -> Bounded {
        let [m, n] = self.cells;
        let (mut sum, mut size, gain) = (0.0, 0.0, self.factor / (1.0 - self.factor));
        for (i, j) in (0..m).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let [x, y] = [self.strip_of(0, i), self.strip_of(1, j)];
            for (part, weight) in [(Part::Data, 1.0), (Part::Own, gain)] {
                let Patch(corners) = self.patch([x, y], part);
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
        let bound = UNIT * roundings * size + (1.0 + gain.abs()) * self.limits.noise[0];
        Bounded { value: sum, bound: 1.01 * bound }
    }

    /// Slopes per the domain's widths as slopes.
    pub(crate) fn per_domain(&self, slopes: [Interval; 2]) -> [Interval; 2] {
        [0, 1].map(|k| slopes[k].scaled(1.0 / self.domain[k].width()).inflated(0.0))
    }

    /// Knot `index` of an axis, in units of the domain.
    #[inline]
    fn knot(&self, axis: usize, index: usize) -> f64 {
        let number = if axis == 0 { index * (self.cells[1] + 1) } else { index };
        self.nodes.as_ref().get(number).map_or(0.0, |node| if axis == 0 { node.at[0] } else { node.at[1] })
    }

    /// A whole cell of an axis.
    pub(crate) fn strip_of(&self, axis: usize, index: usize) -> Strip {
        Strip { index, width: self.knot(axis, index + 1) - self.knot(axis, index), u: 0.0 }
    }

    /// The cell of an axis in which a place is, in units of the domain.
    #[inline]
    pub(crate) fn strip(&self, axis: usize, place: f64) -> Strip {
        let count = if axis == 0 { self.cells[0] } else { self.cells[1] };
        let mut index = ((place * count as f64) as usize).min(count - 1);
        while index > 0 && place < self.knot(axis, index) {
            index -= 1;
        }
        while index + 1 < count && place >= self.knot(axis, index + 1) {
            index += 1;
        }
        let left = self.knot(axis, index);
        let width = self.knot(axis, index + 1) - left;
        let u = (place - left) / width;
        Strip { index, width, u: if u > 1.0 { 1.0 } else { u } }
    }

    /// The patch of a function over a cell, slopes per width of the cell.
    #[inline]
    pub(crate) fn patch(&self, [x, y]: [Strip; 2], part: Part) -> Patch {
        let corner = |i: usize, j: usize| {
            let node = self.node([i, j]);
            let ([z, z_x, z_y], scale) = match part {
                Part::Data => (node.data, self.domain.map(Interval::width)),
                Part::Own => (node.own, [1.0; 2]),
            };
            [z, z_x * (x.width * scale[0]), z_y * (y.width * scale[1])]
        };
        let ([i, j], [next_i, next_j]) = ([x.index, y.index], [x.index + 1, y.index + 1]);
        Patch([[corner(i, j), corner(i, next_j)], [corner(next_i, j), corner(next_i, next_j)]])
    }

    /// The node of an index pair.
    #[inline]
    pub(crate) fn node(&self, [i, j]: [usize; 2]) -> FoldedNode {
        self.nodes.as_ref().get(i * (self.cells[1] + 1) + j).copied().unwrap_or(FoldedNode::EMPTY)
    }
}

/// What is known of the knots of an axis; widths in units of the domain.
#[derive(Clone, Copy)]
struct Spacing {
    domain: Interval,
    /// The narrowest cell.
    cell: usize,
    narrowest: f64,
    widest: f64,
}

fn knots(axis: usize, at: &[f64]) -> Result<Spacing, FoldedError> {
    let (&[first, ..], &[.., last]) = (at, at) else {
        return Err(FoldedError::TooFewKnots { axis, count: at.len() });
    };
    if at.len() < 3 {
        return Err(FoldedError::TooFewKnots { axis, count: at.len() });
    }
    let not_increasing = |knot, value| Err(FoldedError::NotIncreasing { axis, knot, value });
    if !first.is_finite() {
        return not_increasing(0, first);
    }
    let domain = Interval::new(first, last);
    let mut spacing = Spacing { domain, cell: 0, narrowest: f64::INFINITY, widest: 0.0 };
    for (cell, pair) in at.windows(2).enumerate() {
        let &[left, right] = pair else { continue };
        if !(right.is_finite() && right > left) {
            return not_increasing(cell + 1, right);
        }
    }
    for (cell, pair) in at.windows(2).enumerate() {
        let &[left, right] = pair else { continue };
        let width = part_of(domain, right) - part_of(domain, left);
        // Far more than the rounding of places in units of the domain.
        if width.is_nan() || width < 1e-9 {
            return not_increasing(cell + 1, right);
        }
        if width < spacing.narrowest {
            (spacing.narrowest, spacing.cell) = (width, cell);
        }
        spacing.widest = spacing.widest.max(width);
    }
    Ok(spacing)
}

/// A place in units of the domain, clamped to it; NaN for NaN.
#[inline]
pub(crate) fn part_of(domain: Interval, x: f64) -> f64 {
    let x = if x < domain.lo { domain.lo } else { x };
    let x = if x > domain.hi { domain.hi } else { x };
    (x - domain.lo) / (domain.hi - domain.lo)
}

/// The bilinear function through the corners of the unit square, and its slopes.
fn bilinear(corners: &[[f64; 2]; 2], [t, u]: [f64; 2]) -> Corner {
    let [[a, b], [c, d]] = *corners;
    let (s, v) = (1.0 - t, 1.0 - u);
    [s * (v * a + u * b) + t * (v * c + u * d), v * (c - a) + u * (d - b), s * (b - a) + t * (d - c)]
}
