//! Self-affine surfaces: patches and smaller copies of the whole, over any fold of the plane.

use asperity_core::Interval;
use core::fmt::Debug;
use glam::{DVec2, DVec3};

use crate::numeric::estimate::Bounded;
use crate::numeric::matrix2::{IDENTITY, transposed};
use crate::surface::bounds::{Surface, SurfaceBounds, upward_normal};
use crate::surface::extrema::{SurfaceExtrema, extrema};
use crate::surface::hermite_patch::{Corner, Patch};
use crate::surface::self_affine::limits::Limits;

/// Maximum number of steps of one evaluation.
pub(crate) const MOST_STEPS: u32 = 1 << 16;

/// A C¹ fractal surface through given heights and gradients.
///
/// It consists of smooth patches and smaller copies of itself, and is not a product of curves.
///
/// ```text
/// f = H + s w∘Φ,   w = P + s w∘Φ        H, P: bicubic Hermite patches without twist
/// ```
///
/// The fold `Φ` maps every cell of a grid onto the whole. It is an integer matrix of the torus
/// ([`PeriodicSurface`](crate::PeriodicSurface), periodic, without grain), or zig-zags along both
/// axes ([`FoldedSurface`](crate::FoldedSurface), on unequal cells).
#[derive(Clone, Debug)]
pub struct SelfAffine<F> {
    pub(crate) fold: F,
    pub(crate) factor: f64,
    pub(crate) limits: Limits,
}

/// One of the two functions with patches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// `H`.
    Data,
    /// `P`.
    Own,
}

/// The patch of a cell, and a position in it.
#[derive(Clone, Copy, Debug)]
pub struct Cell {
    pub(crate) index: [usize; 2],
    pub(crate) patch: Patch,
    /// In units of the cell.
    pub(crate) at: [f64; 2],
    /// In units of the domain.
    pub(crate) widths: [f64; 2],
    /// Height and slopes if the position is a node; those of `H` as given.
    pub(crate) node: Option<Corner>,
}

/// A fold of the plane with its nodes: [`TorusFold`](crate::surface::TorusFold) or
/// [`ZigZag`](crate::surface::ZigZag).
///
/// The trait is sealed.
pub trait Fold: FoldParts {}

impl<F: FoldParts> Fold for F {}

/// The operations of a [`Fold`].
pub trait FoldParts: Sized + Clone + Debug {
    /// A point, as exactly as its orbit needs.
    type Position: Copy;

    fn domain(&self) -> [Interval; 2];

    /// The point and the truncation of a coordinate; `None` for an invalid point.
    fn locate(&self, x: f64, y: f64) -> Option<(Self::Position, f64)>;

    fn cell(&self, at: Self::Position, part: Part) -> Cell;

    /// The image of the point.
    fn next(&self, at: Self::Position, cell: &Cell) -> Self::Position;

    /// The Jacobian of one more repetition.
    fn turned(&self, jacobian: &[[f64; 2]; 2], cell: &Cell, factor: f64) -> [[f64; 2]; 2];

    /// Sufficient truncation of values, and bounds of their rounding.
    fn value_enough(limits: &Limits, tolerance: f64) -> f64;

    fn value_rounding(limits: &Limits, steps: u32) -> f64;

    /// Sufficient truncation of slopes, and bounds of their rounding with partial sums up to
    /// `largest`.
    fn slope_enough(limits: &Limits, tolerance: f64) -> f64;

    fn slope_rounding(limits: &Limits, steps: u32, largest: f64) -> f64;

    /// The narrowest cell of the grid.
    fn narrowest(&self, limits: &Limits) -> f64;

    fn bounds(surface: &SelfAffine<Self>, x: Interval, y: Interval) -> SurfaceBounds;

    fn narrow(surface: &mut SelfAffine<Self>);

    fn mean(surface: &SelfAffine<Self>) -> Bounded;

    /// The rectangle that a search uses for `x × y`.
    fn searched(&self, x: Interval, y: Interval) -> [Interval; 2];
}

impl<F: Fold> SelfAffine<F> {
    /// The rectangle under the surface: one period, or the grid.
    pub fn domain(&self) -> [Interval; 2] {
        self.fold.domain()
    }

    /// The vertical scaling s.
    #[must_use]
    pub const fn factor(&self) -> f64 {
        self.factor
    }

    /// A rigorous enclosure of all heights.
    pub const fn range(&self) -> Interval {
        self.limits.range
    }

    /// Rigorous enclosures of `∂f/∂x` and `∂f/∂y`.
    pub fn slope_range(&self) -> [Interval; 2] {
        self.per_domain(self.limits.slopes)
    }

    /// The mean height over the domain, exact up to the reported rounding error.
    ///
    /// ```text
    /// torus:    ∫ f = ∫ p / (1 − s) = (Σ_v z_v − s Σ_v z_{Mv}) / (n² (1 − s))
    /// zig-zags: ∫ w∘Φ = Σ_cells (area of the cell / area of the domain) ∫ w = ∫ w,   so ∫ f = ∫ H + s/(1 − s) ∫ (H − G)
    ///           ∫ over a cell of widths a, b = a b Σ_corners (z/4 ± a z_x/24 ± b z_y/24), + at its lower ends
    /// ```
    ///
    /// On a torus the slopes of the nodes cancel between neighboring patches. For an odd
    /// determinant M permutes the nodes, and this is the mean of the data.
    ///
    /// ```
    /// use asperity_fif::{FoldedSurface, PeriodicSurface};
    /// let z = [0.0, 1.0, -0.5, 0.25];
    /// let mean = PeriodicSurface::new(2, [[2, -1], [1, 2]], 0.375, &z, &[[3.0, -1.0]; 4])?.mean();
    /// assert!((mean.value - 0.1875).abs() <= mean.bound && mean.bound < 1e-14);
    /// let z = [0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0];
    /// let mean = FoldedSurface::new(&[0.0, 1.0, 3.0], &[0.0, 1.0, 2.0], 0.25, &z, &[[0.0; 2]; 9])?.mean();
    /// assert!((mean.value - 1.0 / 3.0).abs() <= mean.bound && mean.bound < 1e-13); // H = H − G is a bump of mean 1/4
    /// # Ok::<(), asperity_fif::FifError>(())
    /// ```
    pub fn mean(&self) -> Bounded {
        F::mean(self)
    }

    /// `f(x, y)` with an error bound, to `tolerance` or the rounding error.
    ///
    /// ```text
    /// f = H + Σ_{0<k<K} sᵏ P∘Φᵏ + sᴷ w∘Φᴷ
    /// ```
    ///
    /// The last term is replaced by `sᴷ` times the middle of the range of w, or at a node by its
    /// exact value.
    pub fn evaluate(&self, x: f64, y: f64, tolerance: f64) -> Bounded {
        let Some((at, cut)) = self.fold.locate(x, y) else { return Bounded::NAN };
        let Bounded { value, bound } = self.value_from(at, tolerance);
        Bounded { value, bound: if cut > 0.0 { bound + 2.0 * cut * self.limits.steepest } else { bound } }
    }

    /// `[∂f/∂x, ∂f/∂y]`, each with an error bound, to `tolerance` or the rounding error.
    ///
    /// ```text
    /// ∇f = ∇H + Σ_{0<k<K} J_kᵀ ∇P∘Φᵏ + J_Kᵀ ∇w∘Φᴷ,   J_k: sᵏ times the Jacobian of Φᵏ
    /// ```
    ///
    /// The bound includes the change of the gradient over the rounding of the point, which on
    /// zig-zags exceeds any other rounding: [`SelfAffine::gradient_modulus`].
    pub fn evaluate_gradient(&self, x: f64, y: f64, tolerance: f64) -> [Bounded; 2] {
        let Some((at, cut)) = self.fold.locate(x, y) else { return [Bounded::NAN; 2] };
        self.gradient_from(at, cut, tolerance)
    }

    /// `f(x, y)` to the rounding error; the value of [`SelfAffine::evaluate`] at tolerance 0.
    #[must_use]
    pub fn height(&self, x: f64, y: f64) -> f64 {
        self.evaluate(x, y, 0.0).value
    }

    /// `(∂f/∂x, ∂f/∂y)` to the rounding error.
    #[must_use]
    pub fn gradient(&self, x: f64, y: f64) -> DVec2 {
        let [x, y] = self.evaluate_gradient(x, y, 0.0);
        DVec2::new(x.value, y.value)
    }

    /// The unit normal, upward: `(−∂f/∂x, −∂f/∂y, 1) / |…|`.
    #[must_use]
    pub fn normal(&self, x: f64, y: f64) -> DVec3 {
        upward_normal(self.gradient(x, y))
    }

    /// A bound of the change of the gradient between points at most `distance` apart: its
    /// conditioning.
    ///
    /// On a torus it bounds `|∇f(p) − ∇f(q)|`. On zig-zags it bounds both components, with the
    /// distance along each axis.
    ///
    /// ```text
    /// Σ_k min(L λᵏ distance, 2 sup|∇P|) (|s| λ)ᵏ        λ = ‖M‖₂, or 1/a for the relative width a of the narrowest cell
    /// ```
    ///
    /// `L` is a Lipschitz constant of the slopes of the patches. The bound decreases like a power
    /// of the distance, `−ln(|s| λ)/ln λ` if that is below 1.
    #[must_use]
    pub fn gradient_modulus(&self, distance: f64) -> f64 {
        let per = self.per();
        let most = if per[0] > per[1] { per[0] } else { per[1] };
        1.01 * self.limits.modulus(distance.abs() * most) * most
    }

    /// Rigorous enclosures of the heights and slopes over `x × y`; tighter for smaller rectangles.
    ///
    /// ```text
    /// f(Q) ⊂ H(Q) + Σ_{0<k<K} sᵏ P(Φᵏ Q) + sᴷ w      ∇f(Q) ⊂ ∇H(Q) + Σ_{0<k<K} J_k(Q)ᵀ ∇P(Φᵏ Q) + J_K(Q)ᵀ ∇w
    /// f(Q) ⊂ f(c) + ∇f(Q) · (Q − c)
    /// torus: f(Q) ⊂ S_K(c) + ∇S_K(c) · (Q − c) ± Σ_{k<K} |s|ᵏ |∇p(Mᵏ Q) − ∇p(Mᵏ c)| |Mᵏ (Q − c)| + sᴷ f,   S_K = Σ_{k<K} sᵏ p∘Mᵏ
    /// ```
    ///
    /// K is the step at which the image covers a cell of the grid, or more than two. A rectangle of
    /// that size or more returns the global ranges, and so does one that is empty or has NaN ends.
    /// [`SelfAffine::extrema_over`] splits rectangles that are too large. On zig-zags parts outside
    /// the domain are read as its border.
    ///
    /// ```
    /// # use asperity_fif::{Interval, PeriodicSurface};
    /// # let z = [0.0, 1.0, -0.5, 0.25];
    /// # let surface = PeriodicSurface::new(2, [[2, -1], [1, 2]], 0.375, &z, &[[3.0, -1.0]; 4])?;
    /// let bounds = surface.bounds(Interval::new(0.3, 0.301), Interval::new(0.7, 0.701));
    /// assert!(bounds.height.contains(surface.height(0.3004, 0.7001)) && bounds.height.width() < 0.2);
    /// assert!(bounds.slopes[1].contains(surface.gradient(0.3004, 0.7001).y));
    /// # Ok::<(), asperity_fif::FifError>(())
    /// ```
    pub fn bounds(&self, x: Interval, y: Interval) -> SurfaceBounds {
        F::bounds(self, x, y)
    }

    /// Narrows the global ranges of heights and slopes, by branch and bound over the domain.
    ///
    /// ```text
    /// sup |∇w| ≤ sup (|Σ_{k<K} J_kᵀ ∇P∘Φᵏ| + |J_K| sup |∇w|),   K and the square as in bounds()
    /// ```
    ///
    /// The constructor adds up the ranges of all terms; here they are added over small squares.
    /// This takes up to tens of milliseconds and makes [`SelfAffine::slope_range`] a few times as
    /// narrow, and with it every bound over a rectangle. It is worthwhile before searches;
    /// [`SelfAffine::tabulated`] includes it.
    ///
    /// ```
    /// # use asperity_fif::PeriodicSurface;
    /// let z = [0.0, 1.0, -0.5, 0.25];
    /// let surface = PeriodicSurface::new(2, [[2, -1], [1, 2]], 0.375, &z, &[[3.0, -1.0]; 4])?;
    /// let width = surface.slope_range()[0].width();
    /// assert!(surface.narrowed().slope_range()[0].width() < 0.7 * width);
    /// # Ok::<(), asperity_fif::FifError>(())
    /// ```
    #[must_use]
    pub fn narrowed(mut self) -> Self {
        F::narrow(&mut self);
        self
    }

    /// Brackets of the extrema over `x × y`, each at most `width` wide if 2¹⁶ rectangles permit.
    ///
    /// They are rigorous for any width. A rectangle that is empty or not finite is read as the
    /// domain; on zig-zags it is clipped to the domain.
    ///
    /// ```
    /// # use asperity_fif::{Interval, PeriodicSurface};
    /// # let z = [0.0, 1.0, -0.5, 0.25];
    /// # let surface = PeriodicSurface::new(2, [[2, -1], [1, 2]], 0.375, &z, &[[3.0, -1.0]; 4])?;
    /// let [x, y] = surface.domain();
    /// let extrema = surface.extrema_over(x, y, 1e-3);
    /// assert!(extrema.maximum.width() <= 1e-3 && extrema.maximum.lo >= 1.0);
    /// let top = surface.height(extrema.highest.x, extrema.highest.y);
    /// assert!(extrema.maximum.contains(top));
    /// # Ok::<(), asperity_fif::FifError>(())
    /// ```
    pub fn extrema_over(&self, x: Interval, y: Interval, width: f64) -> SurfaceExtrema {
        extrema(self, self.fold.searched(x, y), width)
    }

    /// Reciprocals of the widths of the domain.
    fn per(&self) -> [f64; 2] {
        self.fold.domain().map(|side| 1.0 / side.width())
    }

    /// Converts slopes per width of the domain to slopes.
    pub(crate) fn per_domain(&self, slopes: [Interval; 2]) -> [Interval; 2] {
        let domain = self.fold.domain();
        [0, 1].map(|k| match domain[k].width() {
            1.0 => slopes[k],
            width => slopes[k].scaled(1.0 / width).inflated(0.0),
        })
    }

    #[inline]
    pub(crate) fn value_from(&self, mut at: F::Position, tolerance: f64) -> Bounded {
        let limits = &self.limits;
        let own = self.limits.own;
        let radius = 0.5 * own.width();
        let enough = F::value_enough(limits, tolerance);
        let (mut sum, mut weight, mut steps, mut part) = (0.0, 1.0_f64, 0, Part::Data);
        loop {
            let cell = self.fold.cell(at, part);
            if let Some([z, ..]) = cell.node {
                return Bounded { value: sum + weight * z, bound: F::value_rounding(limits, steps) };
            }
            let [u, v] = cell.at;
            sum += weight * cell.patch.value(u, v);
            weight *= self.factor;
            steps += 1;
            if weight.abs() * radius <= enough || steps == MOST_STEPS {
                let truncation = 1.0001 * weight.abs() * radius;
                let value = sum + weight * own.middle();
                return Bounded { value, bound: truncation + F::value_rounding(limits, steps) };
            }
            at = self.fold.next(at, &cell);
            part = Part::Own;
        }
    }

    #[inline]
    pub(crate) fn gradient_from(&self, mut at: F::Position, cut: f64, tolerance: f64) -> [Bounded; 2] {
        let limits = &self.limits;
        let own = self.limits.own_slopes;
        let distance = 2.0 * (self.limits.shift + cut);
        let moved = if distance > 0.0 { self.limits.modulus(distance) } else { 0.0 };
        let per = self.per();
        let most = if per[0] < per[1] { per[1] } else { per[0] };
        let enough = F::slope_enough(
            limits,
            if self.limits.shift > 0.0 { tolerance / (1.0002 * most) - moved } else { tolerance },
        );
        let radii = own.map(|range| 0.5 * range.width());
        let (mut sum, mut largest) = ([0.0_f64; 2], 0.0_f64);
        let (mut jacobian, mut steps, mut part) = (IDENTITY, 0, Part::Data);
        let ended = |sum: [f64; 2], rest: [f64; 2], steps: u32, largest: f64| {
            [0, 1].map(|k| {
                let rounding = F::slope_rounding(limits, steps, largest.max(sum[k].abs()));
                Bounded { value: sum[k] * per[k], bound: 1.0001 * (rest[k] + moved + rounding) * per[k] }
            })
        };
        loop {
            let cell = self.fold.cell(at, part);
            if let Some([_, x, y]) = cell.node {
                if steps == 0 {
                    let bounds = ended([0.0; 2], [0.0; 2], 0, 0.0);
                    return [(x, bounds[0]), (y, bounds[1])].map(|(value, all)| Bounded { value, ..all });
                }
                let last = transposed(&jacobian, [x, y]);
                return ended([sum[0] + last[0], sum[1] + last[1]], [0.0; 2], steps, largest);
            }
            let [u, v] = cell.at;
            let [x, y] = cell.patch.slopes(u, v);
            let term = transposed(&jacobian, [x / cell.widths[0], y / cell.widths[1]]);
            sum = [sum[0] + term[0], sum[1] + term[1]];
            largest = largest.max(sum[0].abs()).max(sum[1].abs());
            jacobian = self.fold.turned(&jacobian, &cell, self.factor);
            steps += 1;
            let rest = transposed(&jacobian.map(|row| row.map(f64::abs)), radii);
            if rest[0].max(rest[1]) <= enough || steps == MOST_STEPS {
                let last = transposed(&jacobian, own.map(Interval::middle));
                return ended([sum[0] + last[0], sum[1] + last[1]], rest, steps, largest);
            }
            at = self.fold.next(at, &cell);
            part = Part::Own;
        }
    }
}

impl<F: Fold> Surface for SelfAffine<F> {
    fn domain(&self) -> [Interval; 2] {
        self.domain()
    }

    fn range(&self) -> Interval {
        self.range()
    }

    fn evaluate(&self, x: f64, y: f64, tolerance: f64) -> Bounded {
        self.evaluate(x, y, tolerance)
    }

    fn bounds(&self, x: Interval, y: Interval) -> SurfaceBounds {
        self.bounds(x, y)
    }

    fn gradient_near(&self, x: f64, y: f64, distance: f64) -> Option<DVec2> {
        let [wide, deep] = self.domain().map(Interval::width);
        let steepest = self.limits.steepest / if wide < deep { wide } else { deep };
        let cell = self.fold.narrowest(&self.limits);
        let [x, y] = self.evaluate_gradient(x, y, self.limits.left_out(distance, cell, steepest));
        Some(DVec2::new(x.value, y.value))
    }
}
