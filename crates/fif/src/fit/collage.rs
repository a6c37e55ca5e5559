//! Vertical scalings by least squares on the collage error.

use alloc::vec::Vec;
use asperity_core::math::sqrt_f64;

use crate::system::error::{self as system, FifError, check_finite, check_length};
use crate::system::fif::Fif;

/// The largest vertical scaling of a fit, `1 − 2⁻¹⁰`, to which larger ones are clamped.
pub(crate) const STEEPEST: f64 = 1.0 - 1.0 / 1024.0;

/// An affine fractal interpolation function fitted to data, with the error of the fit.
#[derive(Clone, Debug)]
pub struct Fit {
    /// The function; it passes through the data at the knots.
    pub system: Fif<2>,
    /// `max |y_i − f(x_i)|` over the data, measured, plus the error bound of the values.
    pub error: f64,
    /// The root mean square of `y_i − f(x_i)`, measured.
    pub rms: f64,
    /// The collage error `sup |Y − T Y|`, where `T Y` is the image of the polygon `Y` through the
    /// data.
    pub collage: f64,
    /// The bound `collage/(1 − max|α_j|)` of the distance between polygon and `f` (collage
    /// theorem).
    pub bound: f64,
}

/// Fits vertical scalings by least squares, with knots at the given points of the data.
///
/// ```text
/// α_j = ⟨u_j, v⟩/⟨v, v⟩     u_j = y − chord_j,  v = (Y − chord) ∘ L_j⁻¹   at the data over map j
/// ```
///
/// with `chord` the line through the first and last point of the data, `chord_j` the line through
/// those of the part, and `Y` the polygon through the data. Each `α_j` minimizes the squared
/// collage error at the data over its part. It is clamped to 1 − 1/1024 in magnitude, and 0 where
/// `v` is 0. The sum over all parts is not the error of the fit: see
/// [`refine`](crate::fit::refine()).
///
/// Time: one binary search per point, and the same per map to measure the collage error.
///
/// Mazel and Hayes, *Using iterated function systems to model discrete sequences*, 1992, the
/// analytic algorithm.
///
/// # Errors
/// [`FifError`]: points that are too few, not finite or not in order; `knots` that do not increase
/// from 0 to the last point.
pub fn affine(x: &[f64], y: &[f64], knots: &[usize]) -> Result<Fit, FifError> {
    check_points(x, y)?;
    check_knots(x.len(), knots)?;
    let data = Data { x, y };
    let alpha: Vec<f64> = knots.windows(2).map(|k| data.factor(k[0], k[1])).collect();
    data.fit(knots, &alpha)
}

/// Points in order, and the polygon through them.
#[derive(Clone, Copy)]
pub(crate) struct Data<'a> {
    pub(crate) x: &'a [f64],
    pub(crate) y: &'a [f64],
}

impl Data<'_> {
    pub(crate) fn point(&self, i: usize) -> (f64, f64) {
        (self.x.get(i).copied().unwrap_or(0.0), self.y.get(i).copied().unwrap_or(0.0))
    }

    /// `Y(x)`, clamped to the data.
    fn polygon(&self, x: f64) -> f64 {
        let right = self.x.partition_point(|&knot| knot <= x).clamp(1, self.x.len().saturating_sub(1).max(1));
        line(x, self.point(right - 1), self.point(right))
    }

    /// `Y − chord` at the fraction `t` of the domain.
    fn deviation(&self, t: f64) -> f64 {
        let (first, last) = (self.point(0), self.point(self.x.len().saturating_sub(1)));
        let x = first.0 + t * (last.0 - first.0);
        self.polygon(x) - line(x, first, last)
    }

    /// `(u, v)` at the points strictly between two points.
    fn pairs(&self, from: usize, to: usize) -> impl Iterator<Item = (f64, f64)> + '_ {
        let (left, right) = (self.point(from), self.point(to));
        (from + 1..to).map(move |i| {
            let (x, y) = self.point(i);
            (y - line(x, left, right), self.deviation((x - left.0) / (right.0 - left.0)))
        })
    }

    /// The least-squares scaling of a map onto the part between two points.
    pub(crate) fn factor(&self, from: usize, to: usize) -> f64 {
        let (mixed, square) =
            self.pairs(from, to).fold((0.0, 0.0), |(mixed, square), (u, v)| (mixed + u * v, square + v * v));
        let alpha = mixed / square;
        if alpha.is_nan() { 0.0 } else { alpha.clamp(-STEEPEST, STEEPEST) }
    }

    /// The largest collage error at the data between two points.
    pub(crate) fn misfit(&self, from: usize, to: usize) -> f64 {
        let alpha = self.factor(from, to);
        self.pairs(from, to).fold(0.0, |worst, (u, v)| worst.max((u - alpha * v).abs()))
    }

    /// The system with these scalings, measured.
    pub(crate) fn fit(&self, knots: &[usize], alpha: &[f64]) -> Result<Fit, FifError> {
        let (x, y): (Vec<f64>, Vec<f64>) = knots.iter().map(|&i| self.point(i)).unzip();
        let system: Fif<2> = Fif::affine(&x, &y, alpha)?;
        let (mut error, mut squares) = (0.0_f64, 0.0);
        for (&x, &y) in self.x.iter().zip(self.y) {
            let got = system.evaluate(x, 0.0);
            error = error.max((got.value - y).abs() + got.bound);
            squares += (got.value - y) * (got.value - y);
        }
        // The difference of two polygons is largest at a corner of one of them.
        let mut collage = 0.0_f64;
        for (k, &alpha) in knots.windows(2).zip(alpha) {
            let &[from, to] = k else { continue };
            let (left, right) = (self.point(from), self.point(to));
            let gap = |x: f64, y: f64| {
                let t = (x - left.0) / (right.0 - left.0);
                (y - line(x, left, right) - alpha * self.deviation(t)).abs()
            };
            let (first, last) = (self.point(0).0, self.point(self.x.len().saturating_sub(1)).0);
            for i in from..=to {
                let (x, y) = self.point(i);
                collage = collage.max(gap(x, y));
            }
            for &x in self.x {
                let x = left.0 + (x - first) / (last - first) * (right.0 - left.0);
                collage = collage.max(gap(x, self.polygon(x)));
            }
        }
        let steepest = alpha.iter().fold(0.0_f64, |m, alpha| m.max(alpha.abs()));
        let rms = sqrt_f64(squares / self.x.len().max(1) as f64);
        Ok(Fit { system, error, rms, collage, bound: collage / (1.0 - steepest) })
    }
}

/// The line through two points.
fn line(x: f64, left: (f64, f64), right: (f64, f64)) -> f64 {
    let t = (x - left.0) / (right.0 - left.0);
    left.1 * (1.0 - t) + right.1 * t
}

pub(crate) fn check_points(x: &[f64], y: &[f64]) -> Result<(), FifError> {
    check_length("y", x.len(), y.len())?;
    system::check_knots(x)?;
    check_finite("y", y)
}

pub(crate) fn check_knots(points: usize, knots: &[usize]) -> Result<(), FifError> {
    let wrong = |at: usize| FifError::FitKnots { at, index: knots.get(at).copied().unwrap_or(points) };
    if knots.first() != Some(&0) {
        return Err(wrong(0));
    }
    if knots.len() < 3 {
        return Err(wrong(knots.len()));
    }
    if let Some(at) = (1..knots.len()).find(|&at| knots.get(at) <= knots.get(at - 1)) {
        return Err(wrong(at));
    }
    let last = knots.len() - 1;
    if knots.get(last).copied() != Some(points - 1) { Err(wrong(last)) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::ToString;

    #[test]
    fn fit_rejects_unordered_data() {
        let says = |x: &[f64], y: &[f64], knots: &[usize], message: &str| {
            assert_eq!(affine(x, y, knots).unwrap_err().to_string(), message);
        };
        let (x, y) = ([0.0, 1.0, 2.0, 3.0], [0.0, 1.0, 0.0, 1.0]);
        says(&x, &y[..3], &[0, 1, 3], "`y` must have 4 elements, got 3");
        says(&x[..2], &y[..2], &[0, 1], "`x` must have at least 3 elements, got 2");
        says(&x, &[0.0, f64::NAN, 0.0, 1.0], &[0, 1, 3], "`y[1]` must be finite, got NaN");
        says(
            &[0.0, 1.0, 1.0, 3.0],
            &y,
            &[0, 1, 3],
            "knots must be strictly increasing: `x[2]` = 1 follows 1",
        );
        let rule = "must increase from the first point to the last, at least three";
        for (knots, at, index) in [
            (&[1, 2, 3][..], 0, 1),
            (&[], 0, 4),
            (&[0, 3], 2, 4),
            (&[0, 2, 2, 3], 2, 2),
            (&[0, 1, 2], 2, 2),
            (&[0, 1, 9], 2, 9),
        ] {
            says(&x, &y, knots, &alloc::format!("`knots[{at}]` {rule}, got {index}"));
        }
    }

    #[test]
    fn scalings_of_straight_data_are_zero() {
        let fit = affine(&[0.0, 1.0, 2.0, 3.0, 5.0], &[1.0, 2.0, 3.0, 4.0, 6.0], &[0, 2, 4]).unwrap();
        // The error includes the bounds of the values, 4e-14 here.
        assert!(fit.error < 1e-13 && fit.collage < 1e-14, "{fit:?}");
        assert!(fit.system.pieces().iter().all(|p| p.map().alpha == 0.0), "{fit:?}");
    }
}
