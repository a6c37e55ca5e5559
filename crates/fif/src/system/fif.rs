//! The validated system of maps and its constructors.

use asperity_core::Interval;

use crate::numeric::double::Double;
use crate::numeric::polynomial::{UNIT, horner, larger, magnitude, substitute};
use crate::system::cell::Cell;
use crate::system::error::{
    FifError, check_coefficients, check_data, check_factor, check_finite, check_knots, check_length,
};
use crate::system::map::Piece;
use crate::system::range::box_of_range;
use crate::system::storage::Storage;

#[doc = include_str!("../../docs/systems.md")]
#[derive(Clone, Copy, Debug)]
#[doc(alias = "ifs")]
#[doc(alias = "fractal interpolation")]
pub struct System<S, const C: usize> {
    pieces: S,
    spacing: Spacing,
    range: Interval,
    /// Error of one polynomial, at any point of the domain.
    pub(crate) noise: f64,
    /// `1/(1 − max|α|)`, rounded up.
    pub(crate) gain: f64,
}

/// Spacing of the knots.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Spacing {
    Uniform,
    Nonuniform,
}

impl<S: Storage<C>, const C: usize> System<S, C> {
    /// Creates a system from knots, vertical scalings and polynomials, which determine the
    /// ordinates.
    ///
    /// ```text
    /// y_0 = q_1(x_0)/(1 − α_1)        y_j = F_j(x_N, y_N)        y_N = q_N(x_N)/(1 − α_N)
    /// ```
    ///
    /// # Errors
    /// See [`FifError`]; also if `F_{j+1}(x_0, y_0) ≠ y_j` beyond
    /// 2⁻⁴⁰.
    pub fn new(x: &[f64], alpha: &[f64], q: &[[f64; C]]) -> Result<Self, FifError> {
        let maps = check_knots(x)?;
        check_length("alpha", maps, alpha.len())?;
        check_length("q", maps, q.len())?;
        Self::from_lists(maps, &|j| value(x, j), &|j| Some((value(alpha, j), *q.get(j)?)))
    }

    /// [`System::new`] from checked knots, and from scalings and polynomials map by map.
    pub(crate) fn from_lists(
        maps: usize,
        x: &dyn Fn(usize) -> f64,
        map: &dyn Fn(usize) -> Option<(f64, [f64; C])>,
    ) -> Result<Self, FifError> {
        for j in 0..maps {
            let (alpha, q) = map(j).ok_or(FifError::Length { parameter: "q", expected: maps, got: j })?;
            check_factor(j + 1, alpha)?;
            check_coefficients(j + 1, &q)?;
        }
        let alpha = |j: usize| map(j).map_or(0.0, |(alpha, _)| alpha);
        let at = |j: usize, x: f64| map(j).map_or(0.0, |(_, q)| horner(&q, x));
        let last = maps.saturating_sub(1);
        let y0 = at(0, x(0)) / (1.0 - alpha(0));
        let y_end = at(last, x(maps)) / (1.0 - alpha(last));
        let ordinate = |j: usize| match j {
            0 => y0,
            j if j > last => y_end,
            j => alpha(j - 1) * y_end + at(j - 1, x(maps)),
        };
        Self::assemble(maps, x, &ordinate, &alpha, &|j| map(j).map(|(_, q)| q))
    }

    /// Creates a system from knots, their ordinates, vertical scalings and polynomials.
    ///
    /// # Errors
    /// See [`FifError`]; both ends of every map must match the ordinates within
    /// 2⁻⁴⁰.
    pub fn with_ordinates(x: &[f64], y: &[f64], alpha: &[f64], q: &[[f64; C]]) -> Result<Self, FifError> {
        let maps = check_knots(x)?;
        check_length("q", maps, q.len())?;
        check_data(maps, y, alpha)?;
        (1..).zip(q).try_for_each(|(map, q)| check_coefficients(map, q))?;
        Self::assemble(maps, &|j| value(x, j), &|j| value(y, j), &|j| value(alpha, j), &|j| q.get(j).copied())
    }

    /// Everything but the join-up and the range has been checked.
    pub(crate) fn assemble(
        maps: usize,
        x: &dyn Fn(usize) -> f64,
        y: &dyn Fn(usize) -> f64,
        alpha: &dyn Fn(usize) -> f64,
        q: &dyn Fn(usize) -> Option<[f64; C]>,
    ) -> Result<Self, FifError> {
        let mut pieces = S::with_len(maps).map_err(|got| FifError::Length {
            parameter: "storage",
            expected: maps,
            got,
        })?;
        let domain = [x(0), x(maps)];
        let width = domain[1] - domain[0];
        let spacing = spacing(maps, x);
        let position = |j: usize| match spacing {
            _ if j == maps => 1.0,
            Spacing::Uniform => j as f64 / maps as f64,
            Spacing::Nonuniform => (x(j) - domain[0]) / width,
        };
        let fraction = |j: usize| match spacing {
            Spacing::Uniform => 1.0 / maps as f64,
            Spacing::Nonuniform => (x(j + 1) - x(j)) / width,
        };
        let mut noise = 0.0_f64;
        let mut steepest = 0.0_f64;
        let (y0, y_end) = (y(0), y(maps));
        for (j, piece) in pieces.as_mut().iter_mut().enumerate() {
            let alpha = alpha(j);
            let q = q(j).unwrap_or([0.0; C]);
            let ends = [x(j), x(j + 1)];
            let part = [position(j), position(j + 1)];
            let built = Piece::new(alpha, q, domain, ends, [y(j), y(j + 1)], part, fraction(j)).joined(
                j + 1,
                domain,
                [y0, y_end],
            )?;
            noise = larger(noise, built.slack + 8.0 * C as f64 * UNIT * magnitude(&built.local, 1.0));
            steepest = steepest.max(alpha.abs());
            *piece = built;
        }
        let gain = (1.0 / (1.0 - steepest)).next_up();
        let unbounded = FifError::Unbounded { alpha: steepest };
        let range = box_of_range(pieces.as_ref()).ok_or(unbounded)?;
        if !(noise.is_finite() && width.is_finite() && gain.is_finite()) {
            return Err(unbounded);
        }
        let mut fif = Self { pieces, spacing, range, noise, gain };
        fif.tighten();
        // Bounds are multiples of it.
        if fif.range.width().is_finite() { Ok(fif) } else { Err(unbounded) }
    }

    /// Replaces the box by the hull of its images under all composites of a few maps, as long as
    /// this helps.
    fn tighten(&mut self) {
        const CELLS: usize = 1024;
        const ROUNDS: usize = 8;
        let maps = self.pieces().len();
        let mut depth = 1;
        while maps.saturating_pow(depth + 1) <= CELLS {
            depth += 1;
        }
        let leaves = if depth > 1 { S::leaves(self.pieces(), depth) } else { None };
        for _ in 0..if depth > 1 { ROUNDS } else { 0 } {
            let hull = match &leaves {
                Some(leaves) => leaves
                    .as_ref()
                    .iter()
                    .fold(Interval::EMPTY, |hull, leaf| hull.hull(leaf.range(self.range))),
                None => self.hull_of_cells(&Cell::root(), depth),
            };
            let hull = hull.intersection(self.range);
            let gained = hull.width() < 0.99 * self.range.width();
            self.range = hull;
            if !gained {
                break;
            }
        }
    }
}

impl<S: AsRef<[Piece<C>]>, const C: usize> System<S, C> {
    /// The maps with their intervals, from left to right.
    #[must_use]
    pub fn pieces(&self) -> &[Piece<C>] {
        self.pieces.as_ref()
    }

    /// A copyable handle on the function, over borrowed pieces.
    #[must_use]
    pub fn view(&self) -> System<&[Piece<C>], C> {
        self.over(self.pieces())
    }

    /// `[x_0, x_N]`.
    pub fn domain(&self) -> Interval {
        let pieces = self.pieces();
        Interval::new(pieces.first().map_or(0.0, |p| p.x()[0]), pieces.last().map_or(0.0, |p| p.x()[1]))
    }

    /// The ordinates `y_0` and `y_N` at the ends of the domain.
    #[must_use]
    pub fn end_values(&self) -> [f64; 2] {
        let pieces = self.pieces();
        [pieces.first().map_or(0.0, |p| p.y()[0]), pieces.last().map_or(0.0, |p| p.y()[1])]
    }

    /// Knot `j`.
    pub(crate) fn knot(&self, j: usize) -> f64 {
        self.pieces().get(j).map_or(self.domain().hi, |piece| piece.x()[0])
    }

    /// Knot `j` in units of the domain, between doubles.
    pub(crate) fn place(&self, j: usize) -> Double {
        let pieces = self.pieces();
        match self.spacing {
            Spacing::Uniform => Double::ratio(j as f64, pieces.len() as f64),
            Spacing::Nonuniform => Double::from(pieces.get(j).map_or(1.0, |piece| piece.s[0])),
        }
    }

    /// The ordinate at knot `j`.
    pub(crate) fn ordinate(&self, j: usize) -> f64 {
        self.pieces().get(j).map_or(self.end_values()[1], |piece| piece.y()[0])
    }

    /// `max |α_j|`.
    #[cfg(feature = "alloc")]
    pub(crate) fn steepest(&self) -> f64 {
        self.pieces().iter().fold(0.0, |most, piece| most.max(piece.map().alpha.abs()))
    }

    /// A rigorous enclosure of `f` over its domain; for a tighter one see [`System::extrema`].
    ///
    /// The smallest box `B` with `α_j B + q_j(X) ⊂ B` for all maps, by policy iteration, inflated
    /// until the inclusion holds with outward rounding. It is then intersected with the hull of its
    /// images under composites of a few maps. Eq. 47 and 48 of the source take the minimum from one
    /// polynomial and the maximum from the other; for `α < 0` they swap.
    pub fn range(&self) -> Interval {
        self.range
    }

    /// The system over a copy of its pieces.
    pub(crate) fn over<T>(&self, pieces: T) -> System<T, C> {
        System { pieces, spacing: self.spacing, range: self.range, noise: self.noise, gain: self.gain }
    }

    pub(crate) fn spacing(&self) -> Spacing {
        self.spacing
    }

    fn hull_of_cells(&self, cell: &Cell<C>, depth: u32) -> Interval {
        if depth == 0 {
            return cell.range(self.range);
        }
        self.pieces()
            .iter()
            .fold(Interval::EMPTY, |hull, piece| hull.hull(self.hull_of_cells(&cell.child(piece), depth - 1)))
    }
}

impl<S: Storage<2>> System<S, 2> {
    /// Creates Barnsley's affine interpolation through `(x_j, y_j)` with vertical scalings `alpha`.
    ///
    /// ```text
    /// q_j(x) = y_{j−1} − α_j y_0 + (y_j − y_{j−1} − α_j (y_N − y_0)) (x − x_0)/(x_N − x_0)
    /// ```
    ///
    /// # Errors
    /// See [`FifError`].
    pub fn affine(x: &[f64], y: &[f64], alpha: &[f64]) -> Result<Self, FifError> {
        let maps = check_knots(x)?;
        check_data(maps, y, alpha)?;
        let (x0, width) = (value(x, 0), value(x, maps) - value(x, 0));
        let (y0, rise) = (value(y, 0), value(y, maps) - value(y, 0));
        let line = |j: usize| {
            let alpha = value(alpha, j);
            let slope = (value(y, j + 1) - value(y, j) - alpha * rise) / width;
            Some([value(y, j) - alpha * y0 - slope * x0, slope])
        };
        Self::assemble(maps, &|j| value(x, j), &|j| value(y, j), &|j| value(alpha, j), &line)
    }
}

impl<S: Storage<4>> System<S, 4> {
    /// Creates a C¹ interpolation of ordinates `y` and slopes `slope`, for `|α_j| < a_j`.
    ///
    /// `q_j` is the cubic with
    ///
    /// ```text
    /// q_j(x_0) = y_{j−1} − α_j y_0        q_j′(x_0) = a_j d_{j−1} − α_j d_0
    /// q_j(x_N) = y_j − α_j y_N            q_j′(x_N) = a_j d_j − α_j d_N
    /// ```
    ///
    /// # Errors
    /// See [`FifError`]; [`FifError::SteepScaling`] if `|α_j| ≥ a_j`.
    pub fn hermite(x: &[f64], y: &[f64], slope: &[f64], alpha: &[f64]) -> Result<Self, FifError> {
        let maps = check_knots(x)?;
        check_data(maps, y, alpha)?;
        check_length("slope", maps + 1, slope.len())?;
        check_finite("slope", slope)?;
        let (x0, width) = (value(x, 0), value(x, maps) - value(x, 0));
        for (j, &alpha) in alpha.iter().enumerate() {
            let a = (value(x, j + 1) - value(x, j)) / width;
            if alpha.abs() >= a {
                return Err(FifError::SteepScaling { map: j + 1, alpha, a });
            }
        }
        let end = |values: &[f64], j: usize, k: usize| {
            value(values, j) - value(alpha, k) * value(values, if j == k { 0 } else { maps })
        };
        let cubic = |j: usize| {
            let a = (value(x, j + 1) - value(x, j)) / width;
            let alpha = value(alpha, j);
            let (p0, p1) = (end(y, j, j), end(y, j + 1, j));
            let m0 = width * (a * value(slope, j) - alpha * value(slope, 0));
            let m1 = width * (a * value(slope, j + 1) - alpha * value(slope, maps));
            let local = [p0, m0, 3.0 * (p1 - p0) - 2.0 * m0 - m1, 2.0 * (p0 - p1) + m0 + m1];
            Some(substitute(&local, 1.0 / width, -x0 / width))
        };
        Self::assemble(maps, &|j| value(x, j), &|j| value(y, j), &|j| value(alpha, j), &cubic)
    }
}

#[cfg(feature = "alloc")]
impl<S: AsRef<[Piece<C>]>, const C: usize> System<S, C> {
    /// The system with its maps copied to a vector.
    pub(crate) fn owned(&self) -> Fif<C> {
        self.over(self.pieces().to_vec())
    }
}

/// A system of any number of maps in a vector.
#[cfg(feature = "alloc")]
#[doc(alias = "ifs")]
pub type Fif<const C: usize> = System<alloc::vec::Vec<Piece<C>>, C>;

/// A system over borrowed pieces, from [`System::view`]; copyable.
pub type FifRef<'a, const C: usize> = System<&'a [Piece<C>], C>;

impl<'a, const C: usize> FifRef<'a, C> {
    /// [`System::pieces`] for the lifetime of the borrow.
    pub(crate) const fn maps(self) -> &'a [Piece<C>] {
        self.pieces
    }
}

/// A system of `N` maps in an array, without an allocator.
pub type FixedFif<const N: usize, const C: usize> = System<[Piece<C>; N], C>;

/// Whether every knot is within two units in the last place (of the larger end) of equal spacing.
fn spacing(maps: usize, x: &dyn Fn(usize) -> f64) -> Spacing {
    let (x0, x_end) = (x(0), x(maps));
    let tolerance = 2.0 * f64::EPSILON * x0.abs().max(x_end.abs());
    let equal = (0..=maps).all(|j| {
        let part = j as f64 / maps as f64;
        (x(j) - (x0 + (x_end - x0) * part)).abs() <= tolerance
    });
    if equal { Spacing::Uniform } else { Spacing::Nonuniform }
}

/// `values[j]`; the lengths of the lists have been checked, so the 0 is never used.
pub(crate) fn value(values: &[f64], j: usize) -> f64 {
    values.get(j).copied().unwrap_or(0.0)
}
