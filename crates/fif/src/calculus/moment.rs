//! Integrals of powers of a function times powers of `x`, over the domain and over any interval.

use asperity_core::Interval;

use crate::calculus::cells::{Tile, directed};
use crate::calculus::moment_basis::MomentBasis;
use crate::numeric::bernstein::{Form, power, rounding};
use crate::numeric::estimate::{Bounded, Estimate};
use crate::numeric::polynomial::{LEAST, UNIT};
use crate::system::cell::Cell;
use crate::system::error::FifError;
use crate::system::fif::{FifRef, System};
use crate::system::map::Piece;

impl<S: AsRef<[Piece<C>]>, const C: usize> System<S, C> {
    /// `∫ xᵏ fᵖ` over the whole domain.
    ///
    /// ```text
    /// ∫ xᵏ fᵖ = Σ_j a_j Σ_m C(p, m) α_jᵐ ∫ (a_j x + b_j)ᵏ q_j(x)^(p−m) f(x)ᵐ dx
    /// ```
    ///
    /// The integrals with lower powers of `f` are known, and the integrals with `fᵖ` follow from
    /// linear equations.
    ///
    /// - **Accuracy:** measured against exact rationals, `p ≤ 4`, `k ≤ 6`, ten systems: within
    ///   1e-14 relative times `condition`.
    ///
    /// ```
    /// let f = asperity_fif::cochran_2000::f()?;
    /// assert!((f.moment(0, 2)?.value - 20.0 / 9.0).abs() < 1e-14);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// Barnsley 1986, for `p = 1`.
    ///
    /// # Errors
    /// [`FifError`] if `k` or `p` is too large.
    pub fn moment(&self, k: usize, p: usize) -> Result<Estimate, FifError> {
        let domain = self.domain();
        self.moment_over(k, p, domain.lo, domain.hi)
    }

    /// `∫ xᵏ fᵖ` from `l` to `r`, negative if `l > r`; ends are clamped to the domain.
    ///
    /// The interval is a union of `O(N log)` cells. Each is a copy `A f + P` of the whole, so no
    /// large integrals are subtracted. Cumulative moments have `l = x_0`.
    ///
    /// ```
    /// let f = asperity_fif::cochran_2000::f()?;
    /// let (left, right) = (f.moment_over(1, 1, 0.0, 0.7)?, f.moment_over(1, 1, 0.7, 2.0)?);
    /// assert!((left.value + right.value - f.moment(1, 1)?.value).abs() < 1e-14);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`FifError`] if `k` or `p` is too large.
    pub fn moment_over(&self, k: usize, p: usize, l: f64, r: f64) -> Result<Estimate, FifError> {
        let domain = self.domain();
        let weight = |s: f64| if s >= 1.0 { domain.hi } else { domain.lo + domain.width() * s };
        Ok(match directed(l, r, domain) {
            Some((l, r, sign)) => self.view().weighted(k, p, l, r, &weight)?.0.scaled(sign),
            None => Estimate::NAN,
        })
    }

    /// The `n`-th integral from `x_0` to `x`, each with initial value 0; `f(x)` itself for `n = 0`.
    ///
    /// ```text
    /// ∫∫…∫ f = ∫_{x_0}^x (x − t)^(n−1)/(n−1)! f(t) dt        (Cauchy)
    /// ```
    ///
    /// For many points create the system of the integral once, [`System::integral`].
    ///
    /// ```
    /// let f = asperity_fif::cochran_2000::f()?;
    /// assert!((f.nth_integral(2, 2.0)?.value - 2.0).abs() < 1e-14);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`FifError`] if `n` is too large.
    pub fn nth_integral(&self, n: usize, x: f64) -> Result<Estimate, FifError> {
        let domain = self.domain();
        let Some(k) = n.checked_sub(1) else {
            return Ok(Estimate::of(self.evaluate(x, 0.0)));
        };
        let Some((l, r, _)) = directed(domain.lo, x, domain) else { return Ok(Estimate::NAN) };
        let end = (r - domain.lo) / domain.width();
        let weight = |s: f64| if end > s { domain.width() * (end - s) } else { 0.0 };
        let factorial = (1..=k).fold(1.0, |product, i| product * i as f64);
        Ok(self.view().weighted(k, 1, l, r, &weight)?.0.scaled(1.0 / factorial))
    }

    /// `∫ f²` over the whole domain, the square of the L² norm.
    ///
    /// # Errors
    /// [`FifError`] if the degree of the polynomials is too large.
    pub fn norm_squared(&self) -> Result<Estimate, FifError> {
        self.moment(0, 2)
    }

    /// The mean of `f²` over the interval between `l` and `r`, in either order; `f(l)²` if they are
    /// equal.
    ///
    /// As accurate as [`System::mean`].
    ///
    /// # Errors
    /// [`FifError`] if the degree of the polynomials is too large.
    pub fn mean_square(&self, l: f64, r: f64) -> Result<Estimate, FifError> {
        let Some((l, r, _)) = directed(l, r, self.domain()) else { return Ok(Estimate::NAN) };
        let (sum, length) = self.view().weighted(0, 2, l, r, &|_| 1.0)?;
        let range = self.range();
        let squares = Interval::new(0.0, power(range.magnitude(), 2).next_up());
        if length.value > 0.0 {
            let whole = self.domain().width() * length.value;
            let mean = sum.scaled(1.0 / whole);
            // In the denominator the widths of the cells round, and their ends move, as well.
            let bound = mean.bound + squares.hi * length.bound / length.value + 4.0 * UNIT * mean.value;
            let Bounded { value, bound } = Bounded { value: mean.value, bound: 1.01 * bound }.within(squares);
            return Ok(Estimate { value, bound, ..mean });
        }
        let value = if l < r {
            Bounded::around(self.enclosure(l, r, 0.0).unwrap_or(range))
        } else {
            self.evaluate(l, 0.0)
        };
        let value = Estimate::of(value);
        Ok(value.product(value))
    }
}

impl<const C: usize> FifRef<'_, C> {
    /// `∫ wᵏ fᵖ` over `[l, r]` for a linear `w`, and the summed length of the cells with its error.
    ///
    /// `w` is given by its values at fractions of the domain; the length is in units of the domain.
    fn weighted(
        self,
        k: usize,
        p: usize,
        l: f64,
        r: f64,
        weight: &dyn Fn(f64) -> f64,
    ) -> Result<(Estimate, Bounded), FifError> {
        let basis = MomentBasis::new(self, k, p)?;
        if l >= r {
            return Ok((Estimate::new(0.0, 0.0, 0.0), Bounded { value: 0.0, bound: 0.0 }));
        }
        let domain = self.domain();
        let range = self.range().magnitude();
        let (mut sum, mut magnitude, mut bound) = (0.0, 0.0, 0.0);
        let (mut tiles, mut length) = (0.0, 0.0);
        let far = domain.magnitude();
        let part = |x: f64| (x - domain.lo) / domain.width();
        let mut heaviest = weight(part(l)).abs().max(weight(part(r)).abs()) + 16.0 * UNIT * far;
        let tiling = self.tile(l, r, &mut |tile: &Tile<C>| {
            let ends = [weight(tile.left), weight(tile.left + tile.width)];
            let part = Part::new(&basis, &tile.cell, ends, far, [k, p], range);
            sum += tile.width * part.value;
            magnitude += tile.width * part.magnitude;
            bound += tile.width * part.bound;
            heaviest = heaviest.max(ends[0].abs()).max(ends[1].abs());
            tiles += 1.0;
            length += tile.width;
        });
        // A width is a product of one factor per map, each with three roundings, and its own.
        let widths = (tiles + 4.0 * tiling.steps + 4.0) * UNIT;
        let least = 2.0 * (tiles + 1.0) * (tiling.steps + 2.0) * LEAST;
        let largest = power(heaviest, k) * power(range, p);
        bound += widths * magnitude + 2.0 * tiling.drift * largest + least * (1.0 + largest);
        let width = domain.width();
        let bound = 1.01 * width * bound + 4.0 * UNIT * (width * sum).abs() + 2.0 * LEAST;
        let length = Bounded { value: length, bound: widths * length + 2.0 * tiling.drift + least };
        Ok((Estimate::new(width * sum, width * magnitude, bound), length))
    }
}

/// The mean of `wᵏ fᵖ` over one cell.
struct Part {
    value: f64,
    magnitude: f64,
    bound: f64,
}

impl Part {
    fn new<const C: usize>(
        basis: &MomentBasis,
        cell: &Cell<C>,
        ends: [f64; 2],
        far: f64,
        [k, p]: [usize; 2],
        range: f64,
    ) -> Self {
        let polynomial = Form::from_bernstein(cell.bernstein());
        let size = cell.polynomial_range().magnitude();
        let heaviest = ends[0].abs().max(ends[1].abs());
        let mut form = Form::power_of_linear(ends, k);
        let (mut value, mut magnitude, mut bound) = (0.0, 0.0, 0.0);
        let mut choose = 1.0;
        for m in (0..=p).rev() {
            let factor = choose * power(cell.product, m);
            let (moments, error) = basis.power(m);
            let [part, part_magnitude] = form.against(moments);
            value += factor * part;
            magnitude += (factor * part_magnitude).abs();
            bound += factor.abs() * power(size, p - m) * power(heaviest, k) * error;
            form = form.product(&polynomial);
            choose = choose * m as f64 / (p - m + 1) as f64;
        }
        // The polynomial and the scaling of the cell are rounded, and so are the values of the
        // weight at its ends.
        let whole = cell.product.abs() * range + size;
        let cell_error = cell.error() + cell.product_error() * cell.product.abs() * range;
        bound += (rounding(k + p * polynomial.degree) + p as f64 * UNIT) * magnitude;
        bound += p as f64 * power(heaviest, k) * power(whole, p.saturating_sub(1)) * cell_error;
        bound += k as f64
            * 2.0
            * (8.0 * UNIT + 4.0 * cell.product_error())
            * far
            * power(heaviest, k.saturating_sub(1))
            * power(whole, p);
        Self { value, magnitude, bound }
    }
}
