//! The curvature of a height field whose axes are twice differentiable.

use asperity_core::math::sqrt_f64;
use glam::DVec2;

use crate::surface::height_field::function::Function;
use crate::surface::height_field::height_field::HeightField;
use crate::system::fif::System;
use crate::system::map::Piece;

/// The curvature of a surface at a point, per unit length.
///
/// It is positive where the surface bends towards its upward normal, in a valley.
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub struct Curvature {
    /// The mean curvature `H = (κ₁ + κ₂)/2`.
    pub mean: f64,
    /// The Gaussian curvature `K = κ₁ κ₂`.
    pub gauss: f64,
}

impl Curvature {
    /// The curvature of a graph with this gradient and these second derivatives `h_xx, h_xy, h_yy`.
    ///
    /// ```text
    /// H = ((1 + h_y²) h_xx − 2 h_x h_y h_xy + (1 + h_x²) h_yy) / (2 w³),   K = (h_xx h_yy − h_xy²)/w⁴,   w² = 1 + h_x² + h_y²
    /// ```
    ///
    /// ```
    /// use asperity_fif::{Curvature, glam::DVec2};
    /// let cap = Curvature::of_graph(DVec2::ZERO, [-0.5, 0.0, -0.5]); // the top of a sphere of radius 2
    /// assert_eq!((cap.mean, cap.gauss), (-0.5, 0.25));
    /// ```
    pub fn of_graph(gradient: DVec2, [xx, xy, yy]: [f64; 3]) -> Self {
        let DVec2 { x, y } = gradient;
        let square = 1.0 + x * x + y * y;
        let mean = (1.0 + y * y) * xx - 2.0 * x * y * xy + (1.0 + x * x) * yy;
        Self {
            mean: 0.5 * mean / (square * sqrt_f64(square)),
            gauss: (xx * yy - xy * xy) / (square * square),
        }
    }

    /// The principal curvatures `κ₁ ≥ κ₂ = H ± √(H² − K)`.
    #[must_use]
    pub fn principal(&self) -> [f64; 2] {
        // The difference is not negative, but its rounding may be.
        let root = sqrt_f64((self.mean * self.mean - self.gauss).max(0.0));
        [self.mean + root, self.mean - root]
    }
}

impl<F: Function, G: Function> HeightField<F, G> {
    /// The curvature at `(x, y)`, from the second derivatives `f″` and `g″` of the two axes.
    ///
    /// `None` unless both axes are differentiable.
    ///
    /// `f″` is the derivative of the slope, [`System::derivative`], which the caller computes once.
    /// It exists for few functions, such as second integrals.
    ///
    /// ```
    /// use asperity_fif::{FixedFif, HeightField, cochran_2000};
    /// let second = cochran_2000::f()?;
    /// let axis: FixedFif<2, 4> = cochran_2000::f_hat()?.integral(0.0)?;
    /// let curvature = HeightField::new(axis, axis).curvature(1.0, 1.0, &second, &second).unwrap();
    /// let [k1, k2] = curvature.principal();
    /// assert!((k1 * k2 - curvature.gauss).abs() < 1e-15 && k1 >= k2);
    /// # Ok::<(), asperity_fif::FifError>(())
    /// ```
    #[must_use]
    pub fn curvature<U: AsRef<[Piece<D>]>, V: AsRef<[Piece<E>]>, const D: usize, const E: usize>(
        &self,
        x: f64,
        y: f64,
        f_second: &System<U, D>,
        g_second: &System<V, E>,
    ) -> Option<Curvature> {
        let (f_slope, g_slope) = (self.x.slope(x)?, self.y.slope(y)?);
        let (f, g) = (self.x.evaluate(x, 0.0).value, self.y.evaluate(y, 0.0).value);
        let (f_second, g_second) = (f_second.evaluate(x, 0.0).value, g_second.evaluate(y, 0.0).value);
        let gradient = DVec2::new(f_slope * g, f * g_slope);
        Some(Curvature::of_graph(gradient, [f_second * g, f_slope * g_slope, f * g_second]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{FixedFif, cochran_2000};
    use approx::assert_abs_diff_eq;

    #[test]
    fn divergence_of_the_normal_is_twice_the_mean_curvature() {
        let (f, g) = (cochran_2000::f().unwrap(), cochran_2000::g().unwrap());
        let [x_axis, y_axis] = [f, g].map(|second| {
            let slope: FixedFif<2, 3> = second.integral(0.1).unwrap();
            slope.integral::<[Piece<4>; 2], 4>(0.2).unwrap()
        });
        let surface = HeightField::new(x_axis, x_axis);
        let (x, y, step) = (0.7, 1.3, 1e-5);
        let normal = |dx: f64, dy: f64| surface.normal(x + dx * step, y + dy * step).unwrap();
        let along_x = (normal(1.0, 0.0).x - normal(-1.0, 0.0).x) / (2.0 * step);
        let along_y = (normal(0.0, 1.0).y - normal(0.0, -1.0).y) / (2.0 * step);
        let got = surface.curvature(x, y, &f, &f).unwrap();
        assert!((along_x + along_y + 2.0 * got.mean).abs() < 1e-3, "{} != {got:?}", along_x + along_y);
        let cross = (normal(0.0, 1.0).x - normal(0.0, -1.0).x) * (normal(1.0, 0.0).y - normal(-1.0, 0.0).y);
        let determinant = along_x * along_y - cross / (4.0 * step * step);
        // The area ratio of the Gauss map on the surface is K; projected, both areas shrink by the
        // same cosine.
        assert_abs_diff_eq!(determinant, got.gauss, epsilon = 1e-3);
        let rough = HeightField::new(f, y_axis);
        assert!(rough.curvature(x, y, &f, &g).is_none());
    }
}
