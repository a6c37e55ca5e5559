//! Rigorous extrema over the domain and over any interval, with their positions.

use asperity_core::Interval;

use crate::analysis::branch_and_bound::{Goal, Search};
use crate::system::fif::{FifRef, System};
use crate::system::map::Piece;

/// Brackets of the two extrema of a function over an interval, and their positions.
///
/// ```
/// let f = asperity_fif::cochran_2000::f()?;
/// let top = f.extrema(1e-9);
/// // Certificate of the lower end: f is at least this large there.
/// let x = top.at_maximum.middle();
/// assert!(f.evaluate(x, 1e-12).value >= top.maximum.lo - 1e-12);
/// // 2/3 and 4/3 are the outermost points of the maximum.
/// assert!(top.maximum_within.contains(2.0 / 3.0) && top.maximum_within.contains(4.0 / 3.0));
/// # Ok::<(), asperity_fif::FifError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub struct Extrema {
    /// Contains the minimum.
    pub minimum: Interval,
    /// Contains the maximum.
    pub maximum: Interval,
    /// A certificate: `f` is at most `minimum.hi` somewhere in this interval.
    ///
    /// It is a few units in the last place around a knot of some level.
    pub at_minimum: Interval,
    /// A certificate: `f` is at least `maximum.lo` somewhere in this interval.
    pub at_maximum: Interval,
    /// Contains every point of the minimum; found with 2¹² cells from each side.
    pub minimum_within: Interval,
    /// Contains every point of the maximum, likewise.
    pub maximum_within: Interval,
}

impl Extrema {
    /// `[minimum.lo, maximum.hi]`: contains every value.
    #[inline]
    pub fn enclosure(&self) -> Interval {
        Interval::new(self.minimum.lo, self.maximum.hi)
    }
}

impl<S: AsRef<[Piece<C>]>, const C: usize> System<S, C> {
    /// Brackets of the extrema over the domain, each at most `width` wide if `f64` and 2¹⁶ cells
    /// permit.
    ///
    /// The brackets are rigorous for any width: the upper end of the maximum bounds `f`, and its
    /// lower end is a value at a knot of some level. A chaos game (Algorithm 1 of the source) with
    /// 10⁴ points misses up to 27 % of the range, so no inflation of its result is safe.
    ///
    /// A search visits at most 2¹⁶ cells, or eight per map if that is more, at most 200 levels
    /// deep, without recursion. With a scaling near one this is not sufficient: 200 levels of 0.999
    /// leave 82 % of the range, and the bracket has this width.
    ///
    /// ```
    /// let f = asperity_fif::cochran_2000::f()?;
    /// let extrema = f.extrema(1e-9);
    /// assert!(extrema.maximum.contains(4.0 / 3.0) && extrema.maximum.width() <= 1e-9);
    /// assert!(extrema.minimum.contains(0.0));
    /// # Ok::<(), asperity_fif::FifError>(())
    /// ```
    pub fn extrema(&self, width: f64) -> Extrema {
        self.view().search(self.domain(), width)
    }

    /// Brackets of the extrema over `[l, r]`, clipped to the domain, see [`System::extrema`].
    ///
    /// The interval is widened by the rounding of the ends of cells: eight units in the last place
    /// of the domain, and one for each level. If it contains no knot of any visited level, a
    /// bracket is the whole enclosure, and its certificate is the interval. Returns `None` if the
    /// interval misses the domain, is empty or has NaN ends.
    ///
    /// ```
    /// let f = asperity_fif::cochran_2000::f()?;
    /// let rise = f.extrema_over(0.0, 0.5, 1e-6).unwrap();
    /// assert!(rise.maximum.contains(13.0 / 12.0)); // f(5/12), over f(1/2) = 1
    /// assert!(f.extrema_over(3.0, 4.0, 1e-6).is_none());
    /// # Ok::<(), asperity_fif::FifError>(())
    /// ```
    #[must_use]
    pub fn extrema_over(&self, l: f64, r: f64, width: f64) -> Option<Extrema> {
        let over = Interval::new(l, r).intersection(self.domain());
        let whole = l <= r && over.lo <= over.hi;
        whole.then(|| self.view().search(over, width))
    }

    /// An enclosure of `f` over `[l, r]`, clipped to the domain, each end within `width` of the
    /// best one.
    ///
    /// The enclosure of [`System::extrema_over`], with its limits and its `None`, without the
    /// search for positions.
    ///
    /// ```
    /// let g = asperity_fif::cochran_2000::g()?;
    /// let part = g.enclosure(0.5, 0.75, 1e-6).unwrap();
    /// assert!(part.contains(g.evaluate(0.6, 1e-9).value) && part.width() < g.range().width());
    /// # Ok::<(), asperity_fif::FifError>(())
    /// ```
    #[must_use]
    pub fn enclosure(&self, l: f64, r: f64, width: f64) -> Option<Interval> {
        let over = Interval::new(l, r).intersection(self.domain());
        let whole = l <= r && over.lo <= over.hi;
        whole.then(|| {
            let goal = self.view().goal(over, width);
            let (top, bottom, _) = self.view().searches(&goal, over);
            Interval::new(-bottom.bound, top.bound)
        })
    }
}

impl<'a, const C: usize> FifRef<'a, C> {
    fn goal(self, over: Interval, width: f64) -> Goal {
        // A bracket cannot be narrower than the rounding errors of the two bounds.
        let least = 64.0 * (self.noise * self.gain).max(f64::EPSILON * self.range().magnitude());
        Goal::new(over, self.domain(), if width > least { width } else { least })
    }

    /// The finished searches for the maxima of `f` and `−f`, and a range of `f` over the domain.
    fn searches(self, goal: &'a Goal, over: Interval) -> (Search<'a, C>, Search<'a, C>, Interval) {
        let (mut top, mut bottom) = (Search::new(self, goal, 1.0), Search::new(self, goal, -1.0));
        let mut range = self.range();
        if over == self.domain() {
            // Both passes run, regardless of the result of the first.
            while top.narrow(range) | bottom.narrow(range) {
                range = range.intersection(Interval::new(-bottom.bound, top.bound));
            }
            return (top, bottom, range);
        }
        while top.narrow(range) | bottom.narrow(range) {}
        (top, bottom, range)
    }

    fn search(self, over: Interval, width: f64) -> Extrema {
        let goal = self.goal(over, width);
        let (mut top, mut bottom, range) = self.searches(&goal, over);
        top.assume(range);
        bottom.assume(range);
        // Without a knot inside, a value is only known to be in the enclosure.
        let attained = |best: f64, other: f64| if best.is_finite() { best } else { -other };
        Extrema {
            minimum: Interval::new(-bottom.bound, -attained(bottom.best, top.bound)),
            maximum: Interval::new(attained(top.best, bottom.bound), top.bound),
            at_minimum: bottom.at,
            at_maximum: top.at,
            minimum_within: bottom.positions(),
            maximum_within: top.positions(),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::{FixedFif, cochran_2000};

    #[test]
    fn extrema_with_an_unreachable_width_are_bracketed() {
        for width in [0.0, -1.0, f64::NAN, 1e-300] {
            let e = cochran_2000::g().unwrap().extrema(width);
            assert!(e.maximum.width() < 1e-10 && e.maximum.contains(41_969.0 / 21_609.0), "{width}: {e:?}");
        }
    }

    #[test]
    fn extrema_over_empty_intervals_is_none() {
        let f = cochran_2000::f().unwrap();
        for (l, r) in [(1.0, 0.5), (f64::NAN, 1.0), (0.0, f64::NAN), (-2.0, -1.0)] {
            assert!(f.extrema_over(l, r, 1e-6).is_none() && f.enclosure(l, r, 1e-6).is_none(), "[{l}, {r}]");
        }
        let whole = f.extrema_over(f64::NEG_INFINITY, f64::INFINITY, 1e-6).unwrap();
        assert_eq!(whole, f.extrema(1e-6));
        let point = f.extrema_over(2.0 / 3.0, 2.0 / 3.0, 1e-6).unwrap();
        assert!(point.enclosure().contains(4.0 / 3.0) && point.enclosure().width() < 1e-5, "{point:?}");
        // No knot is certainly inside, so the position is the interval itself.
        assert_eq!(point.at_maximum, crate::Interval::new(2.0 / 3.0, 2.0 / 3.0));
    }

    #[test]
    fn extrema_finds_cells_of_a_billionth() {
        // A spike of height 1 in the first billionth of the domain, and its copies.
        let spike =
            FixedFif::<3, 2>::affine(&[0.0, 1e-9, 2e-9, 1.0], &[0.0, 1.0, 0.0, 0.0], &[0.5, 0.5, 0.5]);
        let e = spike.unwrap().extrema(1e-9);
        assert!(e.maximum.width() <= 1e-9 && e.minimum.contains(0.0), "{e:?}");
        assert!(e.at_maximum.lo >= 0.0 && e.at_maximum.hi < 2.1e-9, "{e:?}");
    }
}
