//! Heights, gradients and normals of a folded surface, with bounds of their errors.

use glam::{DVec2, DVec3};

use crate::numeric::interval::Bounded;
use crate::surface::height_field::height_field::upward_normal;
use crate::surface::self_affine::folded::{FoldedSurface, Part, Strip, part_of};
use crate::surface::self_affine::folded_node::FoldedNode;

/// Steps that one evaluation takes at most.
const MOST_STEPS: u32 = 1 << 16;

impl<S: AsRef<[FoldedNode]>> FoldedSurface<S> {
    /// `f(x, y)` with a bound of its error, to `tolerance` or the rounding error.
    ///
    /// ```text
    /// f = H + Σ_{0<k<K} sᵏ (H − G)∘Φᵏ + sᴷ w∘Φᴷ
    /// ```
    ///
    /// The last term is replaced by `sᴷ` times the middle of w's range, or at a node by its exact value.
    #[inline]
    #[must_use]
    pub fn evaluate(&self, x: f64, y: f64, tolerance: f64) -> Bounded {
        let limits = &self.limits;
        let Some(mut at) = self.place(x, y) else { return Bounded::NAN };
        let radius = 0.5 * limits.own.width();
        let floor = limits.value_rounding(64);
        let enough = if tolerance > 2.5 * floor { 0.5 * tolerance } else { 0.25 * floor };
        let (mut sum, mut weight, mut steps, mut part) = (0.0, 1.0_f64, 0, Part::Data);
        loop {
            let strips = [self.strip(0, at[0]), self.strip(1, at[1])];
            let [u, v] = strips.map(|strip| strip.u);
            sum += weight * self.patch(strips, part).value(u, v);
            let is_node = (u == 0.0 || u == 1.0) && (v == 0.0 || v == 1.0);
            if is_node {
                return Bounded { value: sum, bound: limits.value_rounding(steps) };
            }
            weight *= self.factor;
            steps += 1;
            if weight.abs() * radius <= enough || steps == MOST_STEPS {
                let value = sum + weight * limits.own.middle();
                let truncation = 1.0001 * weight.abs() * radius;
                return Bounded { value, bound: truncation + limits.value_rounding(steps) };
            }
            at = strips.map(Strip::folded);
            part = Part::Own;
        }
    }

    /// `[∂f/∂x, ∂f/∂y]`, each with a bound of its error, to `tolerance` or the rounding error.
    ///
    /// ```text
    /// ∇f = ∇H + Σ_{0<k<K} J_k ∇(H − G)∘Φᵏ + J_K ∇w∘Φᴷ,   J_k = sᵏ times the diagonal matrix of slopes of Φᵏ
    /// ```
    ///
    /// The bound includes what the gradient may change over the rounding of the point in units of the domain, which is more
    /// than any other rounding: [`FoldedSurface::gradient_modulus`].
    #[inline]
    #[must_use]
    pub fn evaluate_gradient(&self, x: f64, y: f64, tolerance: f64) -> [Bounded; 2] {
        let limits = &self.limits;
        let Some(mut at) = self.place(x, y) else { return [Bounded::NAN; 2] };
        let per = self.domain.map(|side| 1.0 / side.width());
        let moved = self.modulus(2.0 * limits.shift);
        let most = if per[0] < per[1] { per[1] } else { per[0] };
        // More steps than the least factors need; it reserves what the bound says of rounding.
        let floor = limits.slope_rounding(256);
        let spare = tolerance / (1.0002 * most) - moved - floor;
        let enough = if spare > floor { spare } else { floor };
        let (mut sum, mut jacobian, mut steps, mut part) = ([0.0_f64; 2], [1.0_f64; 2], 0, Part::Data);
        let ended = |sum: [f64; 2], rest: [f64; 2], steps: u32| {
            let error = moved + limits.slope_rounding(steps);
            [0, 1].map(|k| Bounded { value: sum[k] * per[k], bound: 1.0001 * (rest[k] + error) * per[k] })
        };
        loop {
            let strips = [self.strip(0, at[0]), self.strip(1, at[1])];
            let [u, v] = strips.map(|strip| strip.u);
            let is_node = (u == 0.0 || u == 1.0) && (v == 0.0 || v == 1.0);
            let slopes = if is_node {
                let [i, j] = strips.map(|strip| strip.index + usize::from(strip.u == 1.0));
                let node = self.node([i, j]);
                match (part, node.data, node.own) {
                    (Part::Data, [_, x, y], _) => {
                        let error = moved + limits.slope_rounding(0);
                        return [(x, 0), (y, 1)].map(|(value, k)| Bounded { value, bound: error * per[k] });
                    }
                    (Part::Own, _, [_, x, y]) => [x, y],
                }
            } else {
                let [x, y] = self.patch(strips, part).slopes(u, v);
                [x / strips[0].width, y / strips[1].width]
            };
            sum = [sum[0] + jacobian[0] * slopes[0], sum[1] + jacobian[1] * slopes[1]];
            if is_node {
                return ended(sum, [0.0; 2], steps);
            }
            jacobian = [0, 1].map(|k| jacobian[k] * self.factor * strips[k].slope());
            steps += 1;
            let rest = [0, 1].map(|k| jacobian[k].abs() * limits.own_slopes[k]);
            if (rest[0] <= enough && rest[1] <= enough) || steps == MOST_STEPS {
                return ended(sum, rest, steps);
            }
            at = strips.map(Strip::folded);
            part = Part::Own;
        }
    }

    /// `f(x, y)` to the rounding error; the value of [`FoldedSurface::evaluate`] at tolerance 0.
    #[inline]
    #[must_use]
    pub fn height(&self, x: f64, y: f64) -> f64 {
        self.evaluate(x, y, 0.0).value
    }

    /// `(∂f/∂x, ∂f/∂y)` to the rounding error.
    #[inline]
    #[must_use]
    pub fn gradient(&self, x: f64, y: f64) -> DVec2 {
        let [x, y] = self.evaluate_gradient(x, y, 0.0);
        DVec2::new(x.value, y.value)
    }

    /// The unit normal, upward: `(−∂f/∂x, −∂f/∂y, 1) / |…|`.
    #[inline]
    #[must_use]
    pub fn normal(&self, x: f64, y: f64) -> DVec3 {
        upward_normal(self.gradient(x, y))
    }

    /// A bound of `|∂f/∂x(p) − ∂f/∂x(q)|`, and of the same along y, over all points at most `distance` apart along each axis.
    ///
    /// ```text
    /// Σ_k min(L a⁻ᵏ distance, 2 sup|∇|) (|s|/a)ᵏ
    /// ```
    ///
    /// L is a Lipschitz constant of the slopes of H and H − G, a the share of the narrowest cell. The bound falls like a power of
    /// the distance, `ln(|s|/a)/ln a` where that is under 1.
    #[must_use]
    pub fn gradient_modulus(&self, distance: f64) -> f64 {
        let per = self.domain.map(|side| 1.0 / side.width());
        let most = if per[0] > per[1] { per[0] } else { per[1] };
        1.01 * self.modulus(distance.abs() * most) * most
    }

    /// The same in units of the domain.
    pub(crate) fn modulus(&self, distance: f64) -> f64 {
        let limits = &self.limits;
        let (mut sum, mut weight, mut change) = (0.0, 1.0, limits.bend * distance);
        let most = 2.0 * limits.patch[1];
        for _ in 0..MOST_STEPS {
            if change.is_nan() || change >= most || weight * most < f64::MIN_POSITIVE {
                break;
            }
            sum += weight * change;
            weight *= limits.contraction;
            change *= limits.stretch;
        }
        1.01 * (sum + weight * most * limits.gain[1])
    }

    /// The point in units of the domain; `None` for NaN.
    #[inline]
    pub(crate) fn place(&self, x: f64, y: f64) -> Option<[f64; 2]> {
        let at = [part_of(self.domain[0], x), part_of(self.domain[1], y)];
        (!at[0].is_nan() && !at[1].is_nan()).then_some(at)
    }
}
