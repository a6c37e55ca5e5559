//! The folded surface with a vertical scaling at every node: continuous, with variable roughness.

use alloc::vec::Vec;
use asperity_core::Interval;
use glam::DVec2;

use crate::numeric::estimate::Bounded;
use crate::numeric::polynomial::UNIT;
use crate::surface::bounds::{Surface, SurfaceBounds};
use crate::surface::extrema::{SurfaceExtrema, extrema};
use crate::surface::self_affine::folded_ranges::{STEP, image, pieces};
use crate::surface::self_affine::limits::Limits;
use crate::surface::self_affine::self_affine::{FoldParts, MOST_STEPS, Part};
use crate::surface::self_affine::zig_zag::{Grid, Strip, ZigZag, bilinear, patches, shift};
use crate::system::error::FifError;

/// Maximum number of steps in which bounds follow a rectangle.
const FOLLOWED: u32 = 128;

#[doc = include_str!("../../../docs/rough-folded.md")]
#[derive(Clone, Debug)]
pub struct RoughFoldedSurface {
    fold: ZigZag,
    /// At the nodes, row after row.
    factors: Vec<f64>,
    /// The maximum |S|, and the errors of a scaling and of a patch, including the rounding of the
    /// position.
    steepest: f64,
    noise: [f64; 2],
    /// Rounding of the position, in units of the domain.
    shift: f64,
    /// Enclose f and w.
    range: Interval,
    own: Interval,
}

impl RoughFoldedSurface {
    /// Creates the surface with vertical scalings `scaling`, heights `z` and gradients `d` at the
    /// nodes.
    ///
    /// The gradients are those of the smooth part. The nodes form the grid of knots `x` and `y`:
    /// node (i, j) lies at `(x_i, y_j)` and is entry `i · y.len() + j` of all lists.
    ///
    /// # Errors
    /// [`FifError`] for invalid data, with the node. Scalings must be below 1 in magnitude,
    /// by more than their rounding.
    pub fn new(x: &[f64], y: &[f64], scaling: &[f64], z: &[f64], d: &[[f64; 2]]) -> Result<Self, FifError> {
        const SWEEPS: u32 = 64;
        let Grid { fold, narrowest, widest, magnitudes } = ZigZag::through(x, y, z, d)?;
        let (expected, got) = (fold.nodes.len(), scaling.len());
        if got != expected {
            return Err(FifError::Length { parameter: "scaling", expected, got });
        }
        let shift = shift(widest);
        // The relative rounding of a scaling; along both axes the position errs by the shift.
        let rounding = 16.0 * UNIT + 4.0 * shift / narrowest;
        let (mut steepest, mut all) = (0.0_f64, Interval::EMPTY);
        for (index, &factor) in scaling.iter().enumerate() {
            let most = factor.abs() * (1.0 + rounding);
            if most.is_nan() || most >= 1.0 {
                let node = [index / y.len(), index % y.len()];
                return Err(FifError::NodeScaling { node, value: factor });
            }
            steepest = steepest.max(factor.abs());
            all = all.hull(Interval::new(factor, factor));
        }
        let mut limits = Limits::EMPTY;
        let [[h, ..], [e, ..]] = patches(&fold, &mut limits);
        let noise = [steepest * rounding, limits.noise[0] + 2.0 * shift * limits.patch[1]];
        let all = all.inflated(noise[0]);
        let reach = e.magnitude() / (1.0 - steepest) * (1.0 + 64.0 * UNIT);
        let mut own = Interval::new(-reach, reach);
        for _ in 0..SWEEPS {
            own = own.intersection(e.sum(all.product(own)));
        }
        let range = h.sum(all.product(own));
        if !(range.magnitude().is_finite() && noise[1].is_finite()) {
            let magnitude = magnitudes.into_iter().fold(0.0, f64::max);
            return Err(FifError::TooLarge { magnitude });
        }
        Ok(Self { fold, factors: scaling.into(), steepest, noise, shift, range, own })
    }

    /// The rectangle under the surface.
    #[inline]
    pub const fn domain(&self) -> [Interval; 2] {
        self.fold.domain
    }

    /// A rigorous enclosure of all heights.
    #[inline]
    pub const fn range(&self) -> Interval {
        self.range
    }

    /// `f(x, y)` with an error bound, to `tolerance` or the rounding error.
    ///
    /// ```text
    /// f = H + Σ_{0<k<K} A_k (H − G)∘Φᵏ + A_K w∘Φᴷ,   A_k = Π_{i<k} S∘Φⁱ,   |A_K| ≤ (max |s|)ᴷ
    /// ```
    ///
    /// The last term is replaced by A_K times the middle of the range of w, or at a node by its
    /// exact value. The bound includes all rounding, and the rounding of the position except for
    /// its effect on f itself: see the type.
    pub fn evaluate(&self, x: f64, y: f64, tolerance: f64) -> Bounded {
        let Some((mut at, _)) = self.fold.locate(x, y) else { return Bounded::NAN };
        let radius = 0.5 * self.own.width();
        let floor = self.noise[1] + 16.0 * UNIT * self.range.magnitude();
        let enough = if tolerance > 16.0 * floor { 0.5 * tolerance } else { 0.25 * floor };
        let (mut sum, mut weight, mut part) = (0.0, 1.0_f64, Part::Data);
        // Errors of both.
        let (mut error, mut weight_error) = (0.0, 0.0);
        for _ in 0..MOST_STEPS {
            let cell = self.fold.cell(at, part);
            let [u, v] = cell.at;
            let patch = cell.node.map_or_else(|| cell.patch.value(u, v), |[z, ..]| z);
            let term = weight * patch;
            sum += term;
            error += weight_error * (patch.abs() + self.noise[1]) + 2.0 * UNIT * (term.abs() + sum.abs());
            if cell.node.is_some() {
                // If a node is reached by rounding, its height replaces that of a nearby point.
                let near = if part == Part::Data { 0.0 } else { weight.abs() * self.noise[1] };
                let error = if part == Part::Data { 0.0 } else { error };
                return Bounded { value: sum, bound: 1.01 * (error + near) };
            }
            error += weight.abs() * self.noise[1];
            let factor = bilinear(&self.corners(cell.index), [u, v])[0];
            weight_error =
                weight_error * self.steepest + weight.abs() * (self.noise[0] + UNIT * self.steepest);
            weight *= factor;
            if (weight.abs() + weight_error) * radius <= enough {
                break;
            }
            at = self.fold.next(at, &cell);
            part = Part::Own;
        }
        let middle = self.own.middle();
        let value = sum + weight * middle;
        let tail = weight.abs() * radius + weight_error * self.own.magnitude();
        let rounding = 2.0 * UNIT * (value.abs() + 2.0 * (weight * middle).abs());
        Bounded { value, bound: 1.01 * (tail + error + rounding) }
    }

    /// `f(x, y)` to the rounding error; the value of [`RoughFoldedSurface::evaluate`] at tolerance
    /// 0.
    #[inline]
    #[must_use]
    pub fn height(&self, x: f64, y: f64) -> f64 {
        self.evaluate(x, y, 0.0).value
    }

    /// A rigorous enclosure of the heights over `x × y`; tighter for smaller rectangles.
    ///
    /// ```text
    /// f(Q) ⊂ H(Q) + Σ_{0<k<K} A_k(Q) (H − G)(Φᵏ Q) + A_K(Q) w
    /// ```
    ///
    /// K is the step at which the image covers more than two cells. A rectangle of that size
    /// returns the range, and so does one that is empty or has NaN ends. Parts outside the domain
    /// are read as its border.
    ///
    /// ```
    /// # use asperity_fif::{Interval, RoughFoldedSurface};
    /// # let knots = [0.0, 1.0, 2.0];
    /// # let z = [0.0, 1.0, 0.0, 0.5, 2.0, 0.5, 0.0, 1.0, 0.0];
    /// # let surface = RoughFoldedSurface::new(&knots, &knots, &[0.75; 9], &z, &[[0.0; 2]; 9])?;
    /// let bounds = surface.bounds(Interval::new(0.3, 0.3001), Interval::new(0.7, 0.7001));
    /// assert!(bounds.contains(surface.height(0.30004, 0.70001)) && bounds.width() < 0.5);
    /// # Ok::<(), asperity_fif::FifError>(())
    /// ```
    pub fn bounds(&self, x: Interval, y: Interval) -> Interval {
        let (Some((low, _)), Some((high, _))) = (self.fold.locate(x.lo, y.lo), self.fold.locate(x.hi, y.hi))
        else {
            return self.range;
        };
        let mut at = [0, 1].map(|k| Interval::new(low[k], high[k]));
        if !(at[0].width() >= 0.0 && at[1].width() >= 0.0) {
            return self.range;
        }
        let (mut sum, mut weight, mut part) = (Interval::new(0.0, 0.0), Interval::new(1.0, 1.0), Part::Data);
        let mut height = self.range;
        for step in 0..FOLLOWED {
            let pad = STEP + self.shift;
            // Arrays are written out, because `map` is a call for each of them, which takes a
            // quarter of the time of a ray.
            let ends = |k: usize| {
                let (low, high) = ((at[k].lo - pad).max(0.0), (at[k].hi + pad).min(1.0));
                [self.fold.strip(k, low), self.fold.strip(k, high)]
            };
            let ends = [ends(0), ends(1)];
            let all = at.iter().all(|side| side.width() >= 1.0);
            if (all && step > 0) || ends.iter().any(|[low, high]| high.index - low.index > 1) {
                break;
            }
            let [patch, factor] = self.ranges(ends, part);
            sum = sum.sum(weight.product(patch));
            weight = weight.product(factor);
            let folded = |ends| pieces(ends).map(image).fold(Interval::EMPTY, Interval::hull);
            at = [folded(ends[0]), folded(ends[1])];
            part = Part::Own;
            height = height.intersection(sum.sum(weight.product(self.own)));
        }
        height
    }

    /// Brackets of the extrema over `x × y`, each at most `width` wide if 2¹⁶ rectangles permit.
    ///
    /// See [`SelfAffine::extrema_over`](crate::SelfAffine::extrema_over).
    ///
    /// ```
    /// # use asperity_fif::RoughFoldedSurface;
    /// # let knots = [0.0, 1.0, 2.0];
    /// # let z = [0.0, 1.0, 0.0, 0.5, 2.0, 0.5, 0.0, 1.0, 0.0];
    /// # let surface = RoughFoldedSurface::new(&knots, &knots, &[0.5; 9], &z, &[[0.0; 2]; 9])?;
    /// let [x, y] = surface.domain();
    /// let extrema = surface.extrema_over(x, y, 0.1);
    /// assert!(extrema.maximum.width() <= 0.1 && extrema.maximum.hi >= 2.0);
    /// # Ok::<(), asperity_fif::FifError>(())
    /// ```
    pub fn extrema_over(&self, x: Interval, y: Interval, width: f64) -> SurfaceExtrema {
        extrema(self, self.fold.searched(x, y), width)
    }

    /// Scalings at the corners of a cell.
    #[inline]
    fn corners(&self, [i, j]: [usize; 2]) -> [[f64; 2]; 2] {
        let row = self.fold.cells[1] + 1;
        let at = |i: usize, j: usize| self.factors.get(i * row + j).copied().unwrap_or(0.0);
        [[at(i, j), at(i, j + 1)], [at(i + 1, j), at(i + 1, j + 1)]]
    }

    /// Ranges of the patches of a function and of S over a rectangle within two cells along each
    /// axis.
    fn ranges(&self, [x, y]: [[Strip; 2]; 2], part: Part) -> [Interval; 2] {
        let [mut patch, mut factor] = [Interval::EMPTY; 2];
        for (across, u) in pieces(x) {
            for (along, v) in pieces(y) {
                patch = patch.hull(self.fold.patch([across, along], part).range(u, v));
                // A bilinear function has its extrema at corners.
                let corners = self.corners([across.index, along.index]);
                for (u, v) in [(u[0], v[0]), (u[0], v[1]), (u[1], v[0]), (u[1], v[1])] {
                    let [s, ..] = bilinear(&corners, [u, v]);
                    factor = factor.hull(Interval::new(s, s));
                }
            }
        }
        [patch.inflated(self.noise[1]), factor.inflated(self.noise[0])]
    }
}

impl Surface for RoughFoldedSurface {
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
        SurfaceBounds { height: self.bounds(x, y), slopes: [Interval::ENTIRE; 2] }
    }

    fn gradient_near(&self, _: f64, _: f64, _: f64) -> Option<DVec2> {
        None
    }
}
