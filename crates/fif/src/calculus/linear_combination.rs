//! Systems from maps and from other systems: sums, multiples, and the number of derivatives.

use crate::system::error::{FifError, check_cells};
use crate::system::fif::System;
use crate::system::map::{JOIN_TOLERANCE, Map, Piece};
use crate::system::storage::Storage;

/// Checks that the number of maps and the knots are equal.
pub(crate) fn check_knots_equal<const C: usize, const D: usize>(
    left: &[Piece<C>],
    right: &[Piece<D>],
) -> Result<(), FifError> {
    if left.len() != right.len() {
        return Err(FifError::Length { parameter: "other", expected: left.len(), got: right.len() });
    }
    for (j, (l, r)) in left.iter().zip(right).enumerate() {
        for (end, (l, r)) in l.x().into_iter().zip(r.x()).enumerate() {
            if l != r {
                return Err(FifError::Unequal { parameter: "knot", index: j + end, left: l, right: r });
            }
        }
    }
    Ok(())
}

impl<S: Storage<C>, const C: usize> System<S, C> {
    /// Creates a system from maps `(a_j x + b_j, α_j y + q_j(x))` that tile `[x0, x_end]` from left
    /// to right.
    ///
    /// ```text
    /// x_j = a_j x_N + b_j = a_{j+1} x_0 + b_{j+1}
    /// ```
    ///
    /// ```
    /// use asperity_fif::{FixedFif, FifError, cochran_2000};
    /// let f = cochran_2000::f()?;
    /// let [first, second] = [0, 1].map(|j| *f.pieces()[j].map());
    /// let again = FixedFif::<2, 2>::from_maps(0.0, 2.0, &[first, second])?;
    /// assert_eq!(again.evaluate(0.7, 1e-12), f.evaluate(0.7, 1e-12));
    /// let gap = FixedFif::<2, 2>::from_maps(0.0, 2.0, &[second, first]);
    /// assert!(matches!(gap, Err(FifError::Tiling { map: 1, .. })));
    /// # Ok::<(), FifError>(())
    /// ```
    ///
    /// # Errors
    /// [`FifError::Tiling`] if the image of a map does not begin where the previous one ends (or
    /// at `x0`), or the last does not end at `x_end`, beyond 2⁻⁴⁰ of the numbers involved;
    /// otherwise see [`System::new`].
    pub fn from_maps(x0: f64, x_end: f64, maps: &[Map<C>]) -> Result<Self, FifError> {
        let count = maps.len();
        if count < 2 {
            return Err(FifError::TooFew { parameter: "maps", min: 2, got: count });
        }
        for (knot, value) in [(0, x0), (count, x_end)] {
            if !value.is_finite() {
                return Err(FifError::NotFinite { parameter: "x", index: knot, value });
            }
        }
        let mut expected = x0;
        for (j, map) in maps.iter().enumerate() {
            let [found, next] = [x0, x_end].map(|x| map.a * x + map.b);
            let scale = (map.a * x0).abs() + map.b.abs() + expected.abs();
            // Written so that NaN is an error.
            let meets = |expected: f64, found: f64| (found - expected).abs() <= JOIN_TOLERANCE * scale;
            if !meets(expected, found) {
                return Err(FifError::Tiling { map: j + 1, expected, got: found });
            }
            if j + 1 == count && !meets(x_end, next) {
                return Err(FifError::Tiling { map: count, expected: x_end, got: next });
            }
            if next <= expected {
                return Err(FifError::KnotOrder { knot: j + 1, left: expected, right: next });
            }
            expected = next;
        }
        let knot = |j: usize| match (j, maps.get(j.wrapping_sub(1))) {
            (0, _) => x0,
            (_, Some(map)) if j < count => map.a * x_end + map.b,
            _ => x_end,
        };
        check_cells(count, &knot)?;
        Self::from_lists(count, &knot, &|j| maps.get(j).map(|map| (map.alpha, map.q)))
    }

    /// The function times `factor`.
    ///
    /// ```
    /// let f = asperity_fif::cochran_2000::f()?;
    /// assert_eq!(f.scaled(3.0)?.evaluate(1.0, 0.0).value, 3.0);
    /// # Ok::<(), asperity_fif::FifError>(())
    /// ```
    ///
    /// # Errors
    /// [`FifError::NotFinite`], [`FifError::Unbounded`] if the numbers overflow or `factor`
    /// is not finite.
    pub fn scaled(&self, factor: f64) -> Result<Self, FifError> {
        let q = |j: usize| self.pieces().get(j).map(|p| p.map().q.map(|c| factor * c));
        self.combined(&|j| factor * self.ordinate(j), &q)
    }

    /// `self + other` for systems with the same knots and vertical scalings, in the same class.
    ///
    /// ```
    /// let (f, g) = (asperity_fif::cochran_2000::f()?, asperity_fif::cochran_2000::g()?);
    /// assert_eq!(f.sum(&f)?.evaluate(1.0, 0.0).value, 2.0);
    /// assert!(f.sum(&g).is_err()); // different vertical scalings
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`FifError`] if a knot or a scaling differs or the numbers overflow.
    pub fn sum<T: AsRef<[Piece<C>]>>(&self, other: &System<T, C>) -> Result<Self, FifError> {
        check_knots_equal(self.pieces(), other.pieces())?;
        for (j, (l, r)) in self.pieces().iter().zip(other.pieces()).enumerate() {
            let (left, right) = (l.map().alpha, r.map().alpha);
            if left != right {
                return Err(FifError::Unequal { parameter: "the scaling of map", index: j + 1, left, right });
            }
        }
        let q = |j: usize| {
            let (l, r) = (self.pieces().get(j)?, other.pieces().get(j)?);
            let mut q = l.map().q;
            for (sum, c) in q.iter_mut().zip(r.map().q) {
                *sum += c;
            }
            Some(q)
        };
        self.combined(&|j| self.ordinate(j) + other.ordinate(j), &q)
    }

    /// The number of continuous derivatives of the system.
    ///
    /// It is `m` if `m` derivative systems exist in sequence, and `C` if all exist (the function is
    /// a polynomial, or its pieces join that smoothly).
    ///
    /// ```text
    /// |α_j| < a_jᵐ, and the join-up of each derivative
    /// ```
    ///
    /// ```
    /// use asperity_fif::cochran_2000;
    /// assert_eq!(cochran_2000::f()?.differentiability(), 0);
    /// assert_eq!(cochran_2000::f_hat()?.differentiability(), 1);
    /// # Ok::<(), asperity_fif::FifError>(())
    /// ```
    #[must_use]
    pub fn differentiability(&self) -> usize {
        let mut current: Option<Self> = self.derivative().ok();
        let mut count = 0;
        while let (Some(derivative), true) = (&current, count < C) {
            count += 1;
            current = derivative.derivative().ok();
        }
        count
    }

    /// Creates a system on these knots, with these scalings, and other ordinates and polynomials.
    fn combined(
        &self,
        y: &dyn Fn(usize) -> f64,
        q: &dyn Fn(usize) -> Option<[f64; C]>,
    ) -> Result<Self, FifError> {
        let maps = self.pieces().len();
        for knot in 0..=maps {
            let value = y(knot);
            if !value.is_finite() {
                return Err(FifError::NotFinite { parameter: "y", index: knot, value });
            }
        }
        let alpha = |j: usize| self.pieces().get(j).map_or(0.0, |p| p.map().alpha);
        Self::assemble(maps, &|j| self.knot(j), y, &alpha, q)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{FixedFif, cochran_2000};
    use alloc::string::ToString;

    #[test]
    fn from_maps_requires_tiling() {
        let f = cochran_2000::f().unwrap();
        let [first, second] = [0, 1].map(|j| *f.pieces()[j].map());
        let build = |maps: &[Map<2>]| FixedFif::<2, 2>::from_maps(0.0, 2.0, maps).map(|f| f.end_values());
        let overlap = Map { a: 0.75, ..first };
        let says = |maps: &[Map<2>], message: &str| assert_eq!(build(maps).unwrap_err().to_string(), message);
        says(&[overlap, second], "`maps` must tile the domain, map 2 at 1.5, got 1");
        says(&[first, Map { a: 0.25, ..second }], "`maps` must tile the domain, map 2 at 2, got 1.5");
        says(&[first, Map { b: f64::NAN, ..second }], "`maps` must tile the domain, map 2 at 1, got NaN");
        says(&[first], "`maps` must have at least 2 elements, got 1");
        says(&[first, Map { alpha: -1.0, ..second }], "`alpha` of map 2 must be in (-1, 1), got -1");
        let flat = Map { a: 0.0, ..first };
        says(
            &[flat, Map { a: 1.0, b: 0.0, ..second }],
            "knots must be strictly increasing: `x[1]` = 0 follows 0",
        );
        let infinite = FixedFif::<2, 2>::from_maps(f64::NEG_INFINITY, 2.0, &[first, second]).unwrap_err();
        assert_eq!(infinite.to_string(), "`x[0]` must be finite, got -inf");
    }

    #[test]
    fn sum_of_different_systems_is_an_error() {
        let f = cochran_2000::f().unwrap();
        let says = |error: FifError, message: &str| assert_eq!(error.to_string(), message);
        says(
            f.sum(&cochran_2000::g().unwrap()).unwrap_err(),
            "`other` must have the scaling of map 1 at 0.5, got 0.85",
        );
        let shifted = FixedFif::<2, 2>::affine(&[0.0, 1.5, 2.0], &[0.0, 1.0, 0.0], &[0.5, 0.5]).unwrap();
        says(f.sum(&shifted).unwrap_err(), "`other` must have knot 1 at 1, got 1.5");
        let three = FixedFif::<3, 2>::affine(&[0.0, 0.5, 1.5, 2.0], &[0.0; 4], &[0.5; 3]).unwrap();
        says(f.sum(&three.view()).unwrap_err(), "`other` must have 2 elements, got 3");
        for factor in [f64::NAN, f64::INFINITY] {
            assert!(f.scaled(factor).is_err(), "{factor}");
        }
        assert!(f.scaled(0.0).unwrap().range().magnitude() < 1e-300);
    }

    #[test]
    fn differentiability_counts_derivatives() {
        // f integrated three times is three times differentiable; the second derivative of a
        // parabola is not contracted.
        let once = cochran_2000::f_hat().unwrap();
        let twice: FixedFif<2, 4> = once.integral(0.0).unwrap();
        let thrice: FixedFif<2, 5> = twice.integral(0.0).unwrap();
        assert_eq!((twice.differentiability(), thrice.differentiability()), (2, 3));
        let straight = FixedFif::<2, 2>::affine(&[0.0, 1.0, 2.0], &[0.0, 1.0, 2.0], &[0.0, 0.0]).unwrap();
        assert_eq!(straight.differentiability(), 2);
    }
}
