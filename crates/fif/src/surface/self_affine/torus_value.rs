//! Heights, gradients and normals of a torus surface, with bounds of their errors.

use glam::{DVec2, DVec3};

use crate::numeric::interval::{Bounded, Interval};
use crate::numeric::matrix2::{IDENTITY, product, transposed};
use crate::numeric::polynomial::UNIT;
use crate::surface::height_field::height_field::upward_normal;
use crate::surface::self_affine::address::{Long, Ratio, Turn, turn};
use crate::surface::self_affine::torus::{TorusSurface, at_node};
use crate::surface::self_affine::torus_node::TorusNode;

/// Steps that one evaluation takes at most.
pub(crate) const MOST_STEPS: u32 = 1 << 16;

impl<S: AsRef<[TorusNode]>> TorusSurface<S> {
    /// `f(x, y)` with a bound of its error, to `tolerance` or the rounding error.
    ///
    /// ```text
    /// f(x) = Σ_{k<K} sᵏ p(Mᵏ x) + sᴷ f(Mᴷ x)
    /// ```
    ///
    /// The last term is replaced by `sᴷ` times the middle of the range, or at a node by its exact value.
    #[inline]
    #[must_use]
    pub fn evaluate(&self, x: f64, y: f64, tolerance: f64) -> Bounded {
        let Some((at, cut)) = place(x, y) else { return Bounded::NAN };
        match at.shortened() {
            Some(short) => self.value_from(short, tolerance),
            None => {
                let Bounded { value, bound } = self.value_from(at, tolerance);
                Bounded { value, bound: bound + 2.0 * cut * self.limits.steepest }
            }
        }
    }

    /// `[∂f/∂x, ∂f/∂y]`, each with a bound of its error, to `tolerance` or the rounding error.
    ///
    /// ```text
    /// ∇f(x) = Σ_{k<K} J_kᵀ ∇p(Mᵏ x) + J_Kᵀ ∇f(Mᴷ x),   J_k = sᵏ Mᵏ
    /// ```
    #[inline]
    #[must_use]
    pub fn evaluate_gradient(&self, x: f64, y: f64, tolerance: f64) -> [Bounded; 2] {
        let Some((at, cut)) = place(x, y) else { return [Bounded::NAN; 2] };
        match at.shortened() {
            Some(short) => self.gradient_from(short, tolerance),
            None => {
                let change = if cut == 0.0 { 0.0 } else { self.gradient_modulus(2.0 * cut) };
                self.gradient_from(at, tolerance)
                    .map(|Bounded { value, bound }| Bounded { value, bound: bound + change })
            }
        }
    }

    /// [`TorusSurface::evaluate`] at the rational point `numerators / denominator`, whose orbit is followed exactly.
    ///
    /// NaN for the denominator 0.
    ///
    /// ```
    /// # use asperity_fif::FixedTorus;
    /// let z = [0.0, 1.0, -0.5, 0.25];
    /// let surface = FixedTorus::<4>::new(2, [[2, -1], [1, 2]], 0.375, &z, &[[0.0; 2]; 4])?;
    /// assert_eq!(surface.evaluate_ratio([1, -3], 2, 1e-12).value, 0.25); // (1/2, −3/2), a node
    /// assert!(surface.evaluate_ratio([1, 2], 3, 1e-12).bound <= 1e-12);
    /// # Ok::<(), asperity_fif::TorusError>(())
    /// ```
    #[must_use]
    pub fn evaluate_ratio(&self, numerators: [i64; 2], denominator: u32, tolerance: f64) -> Bounded {
        Ratio::new(numerators, denominator).map_or(Bounded::NAN, |at| self.value_from(at, tolerance))
    }

    /// [`TorusSurface::evaluate_gradient`] at the rational point `numerators / denominator`.
    ///
    /// The gradient is only Hölder continuous, so that of the nearest double may differ by far more than its rounding:
    /// [`TorusSurface::gradient_modulus`]. NaN for the denominator 0.
    #[must_use]
    pub fn evaluate_gradient_ratio(
        &self,
        numerators: [i64; 2],
        denominator: u32,
        tolerance: f64,
    ) -> [Bounded; 2] {
        Ratio::new(numerators, denominator).map_or([Bounded::NAN; 2], |at| self.gradient_from(at, tolerance))
    }

    /// `f(x, y)` to the rounding error; the value of [`TorusSurface::evaluate`] at tolerance 0.
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

    /// A bound of `|∇f(x) − ∇f(x′)|` over all points at most `distance` apart: how well the gradient is conditioned.
    ///
    /// ```text
    /// Σ_k min(L ‖M‖ᵏ distance, 2 sup|∇p|) (|s| ‖M‖)ᵏ
    /// ```
    ///
    /// It falls like a power of the distance, `−ln(|s| ‖M‖)/ln ‖M‖` where that is under 1.
    #[must_use]
    pub fn gradient_modulus(&self, distance: f64) -> f64 {
        let limits = &self.limits;
        let (mut sum, mut weight, mut change) = (0.0, 1.0, limits.bend * distance.abs());
        let most = 2.0 * limits.patch[1];
        for _ in 0..MOST_STEPS {
            if change.is_nan() || change >= most || weight * most < f64::MIN_POSITIVE {
                break;
            }
            sum += weight * change;
            weight *= limits.contraction;
            change *= limits.norm;
        }
        1.01 * (sum + weight * most * limits.gain[1])
    }

    #[inline]
    pub(crate) fn value_from<T: Turn>(&self, mut at: T, tolerance: f64) -> Bounded {
        let limits = &self.limits;
        let radius = 0.5 * limits.range.width();
        let floor = limits.noise[0] + 2.0 * UNIT * limits.range.magnitude();
        let enough = if tolerance > floor { 0.5 * tolerance } else { floor };
        let (mut sum, mut weight, mut steps) = (0.0, 1.0_f64, 0);
        loop {
            let (cell, [u, v]) = at.cell(self.bits);
            if at.is_corner(self.bits) {
                let last = weight * at_node(self.nodes.as_ref(), self.bits, cell).data[0];
                let bound = if steps == 0 { 0.0 } else { limits.value_rounding(steps) };
                return Bounded { value: sum + last, bound };
            }
            sum += weight * self.patch(cell).value(u, v);
            weight *= self.factor;
            steps += 1;
            if weight.abs() * radius <= enough || steps == MOST_STEPS {
                let truncation = weight.abs() * radius * (1.0 + 4.0 * f64::from(steps) * UNIT);
                let value = sum + weight * limits.range.middle();
                return Bounded { value, bound: truncation + limits.value_rounding(steps) };
            }
            at = at.moved(&self.matrix);
        }
    }

    #[inline]
    fn gradient_from<T: Turn>(&self, mut at: T, tolerance: f64) -> [Bounded; 2] {
        let limits = &self.limits;
        let floor = limits.noise[1] + 2.0 * UNIT * limits.steepest;
        let enough = if tolerance > floor { 0.5 * tolerance } else { floor };
        let radii = limits.slopes.map(|range| 0.5 * range.width());
        let scale = self.side() as f64;
        let by = self.scaled_matrix();
        let (mut sum, mut largest) = ([0.0_f64; 2], 0.0_f64);
        let (mut jacobian, mut steps) = (IDENTITY, 0);
        loop {
            let (cell, [u, v]) = at.cell(self.bits);
            if at.is_corner(self.bits) {
                let [_, x, y] = at_node(self.nodes.as_ref(), self.bits, cell).data;
                let last = transposed(&jacobian, [x, y]);
                return [0, 1].map(|k| {
                    let value = sum[k] + last[k];
                    let bound =
                        if steps == 0 { 0.0 } else { limits.slope_rounding(steps, largest.max(value.abs())) };
                    Bounded { value, bound }
                });
            }
            let slopes = self.patch(cell).slopes(u, v).map(|slope| slope * scale);
            let term = transposed(&jacobian, slopes);
            sum = [sum[0] + term[0], sum[1] + term[1]];
            largest = largest.max(sum[0].abs()).max(sum[1].abs());
            jacobian = product(&by, &jacobian);
            steps += 1;
            let rest = transposed(&jacobian.map(|row| row.map(f64::abs)), radii);
            if rest[0].max(rest[1]) <= enough || steps == MOST_STEPS {
                let last = transposed(&jacobian, limits.slopes.map(Interval::middle));
                return [0, 1].map(|k| {
                    let value = sum[k] + last[k];
                    let rounding = limits.slope_rounding(steps, largest.max(value.abs()));
                    Bounded { value, bound: 1.0001 * rest[k] + rounding }
                });
            }
            at = at.moved(&self.matrix);
        }
    }
}

/// The point as exact fractions, and what was cut off of a coordinate.
#[inline]
pub(crate) fn place(x: f64, y: f64) -> Option<(Long, f64)> {
    let ((x, cut_x), (y, cut_y)) = (turn(x)?, turn(y)?);
    Some((Long([x, y]), if cut_x > cut_y { cut_x } else { cut_y }))
}
