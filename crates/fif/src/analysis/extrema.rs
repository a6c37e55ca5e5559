//! Rigorous extrema over the domain and over any interval, with the places where they lie.

use asperity_core::Interval;

use crate::analysis::branch_and_bound::{Goal, Search};
use crate::system::fif::{FifRef, System};
use crate::system::map::Piece;

/// Brackets of the two extrema of a function over an interval, and where they lie.
///
/// ```
/// let f = asperity_fif::paper::f()?;
/// let top = f.extrema(1e-9);
/// // The certificate of the lower end: f is that large there.
/// let x = top.at_maximum.middle();
/// assert!(f.evaluate(x, 1e-12).value >= top.maximum.lo - 1e-12);
/// // 2/3 and 4/3 are the outermost of the points where f is largest.
/// assert!(top.maximum_within.contains(2.0 / 3.0) && top.maximum_within.contains(4.0 / 3.0));
/// # Ok::<(), asperity_fif::SystemError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub struct Extrema {
    /// The least value lies in here.
    pub minimum: Interval,
    /// The greatest value lies in here.
    pub maximum: Interval,
    /// A certificate: `f` is at most `minimum.hi` somewhere in here, a few units in the last place around a knot of some
    /// level.
    pub at_minimum: Interval,
    /// A certificate: `f` is at least `maximum.lo` somewhere in here, likewise.
    pub at_maximum: Interval,
    /// Every point where the least value is taken lies in here; found with 2¹² cells from each side.
    pub minimum_within: Interval,
    /// Every point where the greatest value is taken lies in here, likewise.
    pub maximum_within: Interval,
}

impl Extrema {
    /// `[minimum.lo, maximum.hi]`: every value lies in here.
    #[inline]
    pub fn enclosure(&self) -> Interval {
        Interval::new(self.minimum.lo, self.maximum.hi)
    }
}

impl<S: AsRef<[Piece<C>]>, const C: usize> System<S, C> {
    /// Brackets of the extrema over the domain, each at most `width` wide where `f64` and 2¹⁶ cells allow that.
    ///
    /// The brackets are rigorous whatever their width: an upper end bounds `f`, a lower end of the maximum is a value at
    /// a knot of some level. A chaos game (Algorithm 1 of the source) with 10⁴ points misses up to 27 % of the range, so
    /// no inflation of it is safe.
    ///
    /// A search visits at most 2¹⁶ cells, or eight per map where that is more, at most 200 levels deep; it does not
    /// recurse. With a factor near one neither suffices: 200 levels of 0.999 leave 82 % of the range, and the bracket
    /// is as wide as that.
    ///
    /// ```
    /// let f = asperity_fif::paper::f()?;
    /// let extrema = f.extrema(1e-9);
    /// assert!(extrema.maximum.contains(4.0 / 3.0) && extrema.maximum.width() <= 1e-9);
    /// assert!(extrema.minimum.contains(0.0));
    /// # Ok::<(), asperity_fif::SystemError>(())
    /// ```
    pub fn extrema(&self, width: f64) -> Extrema {
        self.view().search(self.domain(), width)
    }

    /// Brackets of the extrema over `[l, r]`, clipped to the domain, as [`System::extrema`].
    ///
    /// The interval is widened by the rounding of the ends of cells, eight units in the last place of the domain and
    /// one for each level. Over one that holds no knot of any visited level, a bracket is the whole enclosure, and its
    /// certificate the interval. `None` when the interval misses the domain, is empty or has NaN ends.
    ///
    /// ```
    /// let f = asperity_fif::paper::f()?;
    /// let rise = f.extrema_over(0.0, 0.5, 1e-6).unwrap();
    /// assert!(rise.maximum.contains(13.0 / 12.0)); // f(5/12), over f(1/2) = 1
    /// assert!(f.extrema_over(3.0, 4.0, 1e-6).is_none());
    /// # Ok::<(), asperity_fif::SystemError>(())
    /// ```
    #[must_use]
    pub fn extrema_over(&self, l: f64, r: f64, width: f64) -> Option<Extrema> {
        let over = Interval::new(l, r).intersection(self.domain());
        let whole = l <= r && over.lo <= over.hi;
        whole.then(|| self.view().search(over, width))
    }

    /// An enclosure of `f` over `[l, r]`, clipped to the domain, each end at most `width` from the best one.
    ///
    /// That of [`System::extrema_over`], with its limits and its `None`, without the search for places.
    ///
    /// ```
    /// let g = asperity_fif::paper::g()?;
    /// let part = g.enclosure(0.5, 0.75, 1e-6).unwrap();
    /// assert!(part.contains(g.evaluate(0.6, 1e-9).value) && part.width() < g.range().width());
    /// # Ok::<(), asperity_fif::SystemError>(())
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
        // A bracket under the rounding errors of the two bounds cannot be had.
        let least = 64.0 * (self.noise * self.gain).max(f64::EPSILON * self.range().magnitude());
        Goal::new(over, self.domain(), if width > least { width } else { least })
    }

    /// The finished searches for the maxima of `f` and `−f`, and a range of `f` over the domain.
    fn searches(self, goal: &'a Goal, over: Interval) -> (Search<'a, C>, Search<'a, C>, Interval) {
        let (mut top, mut bottom) = (Search::new(self, goal, 1.0), Search::new(self, goal, -1.0));
        let mut range = self.range();
        if over == self.domain() {
            // Both passes, however the first one ends.
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
        // Without a knot inside, all that is known of a value is that it lies in the enclosure.
        let attained = |best: f64, other: f64| if best.is_finite() { best } else { -other };
        Extrema {
            minimum: Interval::new(-bottom.bound, -attained(bottom.best, top.bound)),
            maximum: Interval::new(attained(top.best, bottom.bound), top.bound),
            at_minimum: bottom.at,
            at_maximum: top.at,
            minimum_within: bottom.places(),
            maximum_within: top.places(),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::{FixedFif, paper};

    #[test]
    fn an_impossible_width_still_gives_brackets() {
        for width in [0.0, -1.0, f64::NAN, 1e-300] {
            let e = paper::g().unwrap().extrema(width);
            assert!(e.maximum.width() < 1e-10 && e.maximum.contains(41_969.0 / 21_609.0), "{width}: {e:?}");
        }
    }

    #[test]
    fn empty_and_unordered_intervals_have_no_extrema() {
        let f = paper::f().unwrap();
        for (l, r) in [(1.0, 0.5), (f64::NAN, 1.0), (0.0, f64::NAN), (-2.0, -1.0)] {
            assert!(f.extrema_over(l, r, 1e-6).is_none() && f.enclosure(l, r, 1e-6).is_none(), "[{l}, {r}]");
        }
        let whole = f.extrema_over(f64::NEG_INFINITY, f64::INFINITY, 1e-6).unwrap();
        assert_eq!(whole, f.extrema(1e-6));
        let point = f.extrema_over(2.0 / 3.0, 2.0 / 3.0, 1e-6).unwrap();
        assert!(point.enclosure().contains(4.0 / 3.0) && point.enclosure().width() < 1e-5, "{point:?}");
        // No knot is surely inside: the interval itself is the place.
        assert_eq!(point.at_maximum, crate::Interval::new(2.0 / 3.0, 2.0 / 3.0));
    }

    #[test]
    fn cells_of_a_billionth_are_found() {
        // A spike of height 1 in the first billionth of the domain, and its copies.
        let spike =
            FixedFif::<3, 2>::affine(&[0.0, 1e-9, 2e-9, 1.0], &[0.0, 1.0, 0.0, 0.0], &[0.5, 0.5, 0.5]);
        let e = spike.unwrap().extrema(1e-9);
        assert!(e.maximum.width() <= 1e-9 && e.minimum.contains(0.0), "{e:?}");
        assert!(e.at_maximum.lo >= 0.0 && e.at_maximum.hi < 2.1e-9, "{e:?}");
    }
}
