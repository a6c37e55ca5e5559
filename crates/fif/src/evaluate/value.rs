//! Values of a fractal interpolation function, at a point and at an address.

use crate::evaluate::address::{Fraction, LongFraction, Orbit, Position, Step};
use crate::numeric::double::Double;
use crate::numeric::estimate::Bounded;
use crate::numeric::polynomial::{LEAST, UNIT, horner};
use crate::system::cell::Cell;
use crate::system::fif::{Spacing, System};
use crate::system::map::Piece;

/// Maximum number of maps that one evaluation composes.
///
/// Sufficient for 10⁻¹² of the range at `|α| ≤ 0.993`. Beyond, the returned bound is larger.
pub(crate) const MAX_DEPTH: usize = 4096;

impl<S: AsRef<[Piece<C>]>, const C: usize> System<S, C> {
    /// `f(x)` with an error bound, which is at most `tolerance` if `f64` permits.
    ///
    /// After `k` inverse steps `f(x) = acc + A f(u)`, so the error is at most `|A| R`, where `R` is
    /// half the width of [`System::range`]. The middle of the range replaces the tail. This
    /// determines the depth. The horizontal contraction does not bound the error of `y`: Algorithm
    /// 2 of the source, taken literally, errs by 0.38 for its own `g` at ε = 10⁻³ and by 0.075 at
    /// 10⁻⁶ (measured at 400,000 points). At most 4096 steps are made. `bound` includes
    /// truncation and rounding.
    ///
    /// - **Domain:** points outside the domain are clamped to it; NaN returns NaN. A tolerance that
    ///   is zero, negative, NaN or below the rounding error means the rounding error.
    /// - **Accuracy:** knots are exact, with bound 0. On equally spaced knots, `x − x_0` in units
    ///   of the domain is a binary fraction with all its bits, whose address is exact at every
    ///   depth. Then `value ± bound` contains `f(x)` itself, if `x − x_0` and its quotient by the
    ///   width are exact, as for a width that is a power of two and `x_0 = 0`. Otherwise it
    ///   contains `f(x′)` for an `x′` within eight units in the last place of `x` and of the ends
    ///   of the domain. Note that one unit of `x` changes g of the source by 5·10⁻⁴.
    ///
    /// Cochran, Lewis, Hart 2000, Algorithm 2, corrected.
    ///
    /// ```
    /// let g = asperity_fif::cochran_2000::g()?;
    /// let top = g.evaluate(3.0 / 7.0, 1e-6);
    /// assert!(top.bound <= 1e-6 && g.range().contains(top.value));
    /// assert_eq!(g.evaluate(1.0, 1e-6).value, 1.0); // a knot
    /// assert!(g.evaluate(f64::NAN, 1e-6).value.is_nan());
    /// # Ok::<(), asperity_fif::FifError>(())
    /// ```
    pub fn evaluate(&self, x: f64, tolerance: f64) -> Bounded {
        match self.locate(x) {
            Location::Nowhere => Bounded::NAN,
            Location::Knot { value, .. } => Bounded { value, bound: 0.0 },
            Location::Inside(t) => match self.spacing() {
                Spacing::Uniform if t < Fraction::LEAST => self.follow_long(t, tolerance),
                Spacing::Uniform => self.follow(Fraction::new(t), tolerance),
                Spacing::Nonuniform => self.follow(Position::new(t), tolerance),
            },
        }
    }

    /// [`System::evaluate`] at a position between doubles.
    pub(crate) fn evaluate_between(&self, x: Double, tolerance: f64) -> Bounded {
        let domain = self.domain();
        let t = x.minus(Double::from(domain.lo)).over(domain.width());
        match self.spacing() {
            Spacing::Uniform if t > Double::from(Fraction::LEAST) && t < Double::from(1.0) => {
                self.follow(Fraction::of(t), tolerance)
            }
            _ => self.evaluate(x.hi, tolerance),
        }
    }

    /// `f` at the point with this address: the indices of the maps, from 0, the outermost first.
    ///
    /// The point is `L_i(L_j(L_k(…)))` for the address `i, j, k, …`. Addresses may be infinite. The
    /// method reads as many indices as `tolerance` needs, at most 2²²: if cells shrink slowly, it
    /// continues after their scalings are negligible. The bound of a finite address covers every
    /// point of its cell. Repeat 0 for the left end and the last index for the right end. An
    /// address can be exact where the nearest `f64` is not.
    ///
    /// Returns `None` for an index without a map.
    ///
    /// ```
    /// let f = asperity_fif::cochran_2000::f()?;
    /// // 2/3 = 0.0101…₂ of [0, 2] in halves: the maximum of f, 4/3.
    /// let top = f.value_at_address([0, 1].into_iter().cycle(), 1e-14).unwrap();
    /// assert!((top.value - 4.0 / 3.0).abs() < 1e-14);
    /// assert!(f.value_at_address([2], 1e-6).is_none());
    /// # Ok::<(), asperity_fif::FifError>(())
    /// ```
    #[must_use]
    pub fn value_at_address<I: IntoIterator<Item = usize>>(
        &self,
        address: I,
        tolerance: f64,
    ) -> Option<Bounded> {
        const LONGEST: usize = 1 << 22;
        let mut cell = Cell::root();
        let mut range = self.range();
        let mut address = address.into_iter().take(LONGEST);
        // Repeated restriction of a polynomial loses more digits than tracking a position.
        let mut steps = 0;
        while steps < 128 || cell.product.abs() * self.range().width() > 0.25 * UNIT * range.magnitude() {
            let Some(index) = address.next() else { break };
            steps += 1;
            cell = cell.child(self.pieces().get(index)?);
            range = cell.range(self.range());
            if 0.5 * range.width() <= tolerance || (0.5 * range.width()) <= 1.02 * cell.error() {
                return Some(Bounded::around(range));
            }
        }
        // The rest is a polynomial, and the position in the cell.
        let (mut left, mut width) = (Double::from(0.0), 1.0);
        let radius = 0.5 * cell.polynomial_range().width();
        let steep = 2.0 * C.saturating_sub(1) as f64 * radius;
        for index in address {
            let piece = self.pieces().get(index)?;
            left = left.plus(self.place(index).times(Double::from(width)));
            width *= piece.s[1] - piece.s[0];
            if steep * width <= tolerance || steep * width <= cell.error() {
                break;
            }
        }
        if width < 1.0 {
            let [from, to] = [left.hi - 2.0 * UNIT, left.hi + width + 2.0 * UNIT];
            range = cell.levelled(self.range(), from.max(0.0), to.min(1.0)).range(self.range());
        }
        Some(Bounded::around(range))
    }

    /// The infinite address of `x`: indices of maps from 0, the outermost first.
    ///
    /// `x` is clamped to the domain; the address of NaN is empty.
    ///
    /// A knot has two addresses; this is the one that ends in zeros, except at the right end of the
    /// domain. On unequal knots the later indices belong to a point within a few units in the last
    /// place.
    ///
    /// ```
    /// let f = asperity_fif::cochran_2000::f()?;
    /// assert!(f.address(1.25).take(4).eq([1, 0, 1, 0]));
    /// # Ok::<(), asperity_fif::FifError>(())
    /// ```
    pub fn address(&self, x: f64) -> impl Iterator<Item = usize> + '_ {
        let last = self.pieces().len().saturating_sub(1);
        let (first, rest, mut orbit) = match self.locate(x) {
            Location::Nowhere => (None, None, None),
            Location::Knot { index, .. } if index > last => (None, Some(last), None),
            Location::Knot { index, .. } => (Some(index), Some(0), None),
            Location::Inside(t) => (None, None, Some((LongFraction::new(t), Position::new(t)))),
        };
        let rest = core::iter::from_fn(move || match &mut orbit {
            None => rest,
            Some((fraction, position)) => Some(match self.spacing() {
                Spacing::Uniform => fraction.step(self.pieces()).index,
                Spacing::Nonuniform => position.step(self.pieces()).index,
            }),
        });
        first.into_iter().chain(rest)
    }

    fn locate(&self, x: f64) -> Location {
        let domain = self.domain();
        let [y0, y_end] = self.end_values();
        if x.is_nan() {
            return Location::Nowhere;
        }
        if x <= domain.lo {
            return Location::Knot { index: 0, value: y0 };
        }
        if x >= domain.hi {
            return Location::Knot { index: self.pieces().len(), value: y_end };
        }
        let index = self.pieces().partition_point(|p| p.x()[0] < x);
        match self.pieces().get(index) {
            Some(piece) if piece.x()[0] == x => Location::Knot { index, value: piece.y()[0] },
            _ => Location::Inside((x - domain.lo) / domain.width()),
        }
    }

    /// Out of line, because few points are this close to the left end.
    #[cold]
    fn follow_long(&self, t: f64, tolerance: f64) -> Bounded {
        self.follow(LongFraction::new(t), tolerance)
    }

    #[inline]
    fn follow<O: Orbit>(&self, mut orbit: O, tolerance: f64) -> Bounded {
        let range = self.range();
        let radius = 0.5 * range.width();
        let scale = range.magnitude();
        // Truncation below the rounding error is not worth a step. Written so that NaN requests the
        // maximum.
        let floor = self.noise + 2.0 * UNIT * scale;
        let enough = if tolerance > floor { 0.5 * tolerance } else { floor };
        let (mut sum, mut product) = (0.0, 1.0_f64);
        let mut tail = None;
        let mut steps = 0;
        while steps < MAX_DEPTH {
            let Step { index, s, at_knot } = orbit.step(self.pieces());
            let Some(piece) = self.pieces().get(index) else { break };
            steps += 1;
            if at_knot {
                tail = Some(product * piece.y()[0]);
                break;
            }
            sum += product * horner(&piece.local, s);
            product *= piece.map().alpha;
            if product.abs() * radius <= enough {
                break;
            }
        }
        let steps = steps as f64;
        let truncation =
            if tail.is_some() { 0.0 } else { product.abs() * radius * (1.0 + 2.0 * steps * UNIT) };
        let value = sum + tail.unwrap_or(product * range.middle());
        Bounded { value, bound: 1.0001 * (truncation + self.rounding(steps)) }
    }

    /// Σ|A_k| and Σ k|A_k| are at most g and g²; every addition rounds a number of at most twice
    /// the range.
    #[inline]
    fn rounding(&self, steps: f64) -> f64 {
        let scale = self.range().magnitude();
        let weight = if steps < self.gain { steps } else { self.gain };
        // Products of the smallest numbers round to multiples of these.
        let least = 4.0 * (steps + 2.0) * LEAST;
        weight * self.noise
            + UNIT * (steps + 2.0) * 2.0 * scale
            + 4.0 * UNIT * weight * weight * scale
            + least
    }

    /// The largest bound that [`System::evaluate`] returns for the tolerance 0.
    #[cfg(feature = "alloc")]
    pub(crate) fn least_bound(&self) -> f64 {
        let range = self.range();
        let floor = self.noise + 2.0 * UNIT * range.magnitude();
        let (mut left, steepest) = (0.5 * range.width(), self.steepest());
        let mut steps = 1;
        while steps < MAX_DEPTH {
            left *= steepest;
            if left <= floor {
                break;
            }
            steps += 1;
        }
        let steps = steps as f64;
        let truncation = if left > floor { left } else { floor } * (1.0 + 4.0 * steps * UNIT);
        1.0001 * (truncation + self.rounding(steps))
    }
}

/// Location of a point in the domain.
enum Location {
    Nowhere,
    Knot {
        index: usize,
        value: f64,
    },
    /// The distance from `x_0` in units of the domain.
    Inside(f64),
}

#[cfg(test)]
mod tests {
    use crate::{FixedFif, cochran_2000};
    use approx::assert_abs_diff_eq;

    #[test]
    fn evaluate_is_within_its_bound_for_any_tolerance() {
        let f = cochran_2000::f().unwrap();
        for tolerance in [f64::INFINITY, 10.0, 1e-3, 1e-300, 0.0, -1.0, f64::NAN] {
            let got = f.evaluate(2.0 / 3.0, tolerance);
            assert!((got.value - 4.0 / 3.0).abs() <= got.bound + 1e-14, "{tolerance}: {got:?}");
            assert!(got.bound <= tolerance.max(1e-12), "{tolerance}: {got:?}");
        }
    }

    #[test]
    fn evaluate_near_the_left_end_satisfies_the_functional_equation() {
        // f(x) = F_1(f(N x)), down from points that are far from the end; every N^k x is exact.
        fn check<const N: usize>(f: &FixedFif<N, 2>, x: f64, steps: i32) {
            let map = f.pieces()[0].map();
            let mut at = x * (N as f64).powi(steps);
            let start = f.evaluate(at, 0.0);
            let (mut want, mut slack) = (start.value, start.bound);
            for k in (0..steps).rev() {
                want = map.apply(at, want).1;
                slack = map.alpha.abs() * slack + f64::EPSILON * f.range().magnitude();
                at = x * (N as f64).powi(k);
                let got = f.evaluate(at, 0.0);
                assert!((got.value - want).abs() <= got.bound + slack, "{at:e}: {got:?} != {want}");
                let (address, inner) = (f.address(at), f.address(at * N as f64));
                assert!(address.take(200).eq(core::iter::once(0).chain(inner).take(200)), "{at:e}");
            }
            assert_eq!(at, x);
        }
        let steep = FixedFif::<2, 2>::affine(&[0.0, 1.0, 2.0], &[0.0, 1.0, 0.0], &[0.97, 0.97]).unwrap();
        for (exponent, steps) in [(90, 89), (110, 109), (140, 139), (1000, 999)] {
            check(&steep, 1.123 * 2f64.powi(-exponent), steps);
        }
        let thirds = [0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0];
        let thirds = FixedFif::<3, 2>::affine(&thirds, &[0.0, 1.0, -1.0, 0.5], &[0.97, -0.9, 0.95]).unwrap();
        for exponent in [90, 140, 1000] {
            check(&thirds, 1.125 * 2f64.powi(-exponent), 20);
        }
        let g = cochran_2000::g().unwrap();
        check(&g, 2f64.powi(-128), 127);
        assert_abs_diff_eq!(g.evaluate(2f64.powi(-128), 0.0).value, 2.24e-9, epsilon = 1e-11);
    }

    #[test]
    fn address_of_knots_and_nan() {
        let f = cochran_2000::f().unwrap();
        assert!(f.address(1.0).take(4).eq([1, 0, 0, 0]));
        assert!(f.address(0.0).take(3).eq([0, 0, 0]) && f.address(-7.0).take(3).eq([0, 0, 0]));
        assert!(f.address(2.0).take(3).eq([1, 1, 1]) && f.address(9.0).take(3).eq([1, 1, 1]));
        assert_eq!(f.address(f64::NAN).next(), None);
    }

    #[test]
    fn value_at_address_of_slowly_shrinking_cells() {
        let f = FixedFif::<2, 2>::affine(&[0.0, 1e-3, 1.0], &[0.0, 1.0, 0.0], &[0.5, -0.875]).unwrap();
        let knot = f.value_at_address(core::iter::once(0).chain(core::iter::repeat(1)), 1e-12).unwrap();
        assert!((knot.value - 1.0).abs() <= knot.bound && knot.bound <= 1e-12, "{knot:?}");
        // Ninety-nine times the right map, the left one, and again: a fixed point of a hundred
        // maps.
        let period = || (0..100).map(|k| usize::from(k < 99)).cycle();
        let fine = f.value_at_address(period(), 1e-12).unwrap();
        assert!(fine.bound <= 1e-12, "{fine:?}");
        let coarse = f.value_at_address(period(), 1e-4).unwrap();
        assert!((fine.value - coarse.value).abs() <= fine.bound + coarse.bound && coarse.bound <= 1e-4);
        let gentle = FixedFif::<2, 2>::affine(&[0.0, 1.0, 2.0], &[0.0, 1.0, 0.0], &[0.999, 0.5]).unwrap();
        let start = gentle.value_at_address(core::iter::repeat(0), 1e-9).unwrap();
        assert!(start.value.abs() <= start.bound && start.bound <= 1e-9, "{start:?}");
    }

    #[test]
    fn evaluate_is_within_its_bound_for_subnormal_numbers() {
        let scale = 2f64.powi(900);
        let y = [1e-310, -3e-310, 2e-320, 7e-324, -1e-310];
        let x = [0.0, 0.25, 0.5, 0.75, 1.0];
        let tiny = FixedFif::<4, 2>::affine(&x, &y, &[0.7, -0.9, 0.3, -0.6]).unwrap();
        let large = FixedFif::<4, 2>::affine(&x, &y.map(|y| y * scale), &[0.7, -0.9, 0.3, -0.6]).unwrap();
        for i in 1..1000 {
            let at = f64::from(i) / 1000.0;
            let (got, want) = (tiny.evaluate(at, 0.0), large.evaluate(at, 0.0));
            assert!(
                (got.value * scale - want.value).abs() <= got.bound * scale + want.bound,
                "{at}: {got:?}, {want:?}"
            );
        }
    }

    #[test]
    fn value_at_finite_address_bounds_its_cell() {
        let f = cochran_2000::f().unwrap();
        let cell = f.value_at_address([0, 1], 1e-12).unwrap().interval();
        for k in 0..=16 {
            let x = 0.5 + f64::from(k) / 32.0;
            assert!(cell.contains(f.evaluate(x, 1e-14).value), "{x}: {cell:?}");
        }
        let whole = f.value_at_address([], 1e-12).unwrap();
        assert_eq!(whole.value, f.range().middle());
    }
}
