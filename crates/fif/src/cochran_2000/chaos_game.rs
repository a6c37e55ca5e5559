//! Algorithm 1 of the source: random points of a graph.

use asperity_core::SplitMix64;

use crate::system::fif::System;
use crate::system::map::Piece;

impl<S: AsRef<[Piece<C>]>, const C: usize> System<S, C> {
    /// An infinite sequence of random points `(x, y)` of the graph, by the chaos game with equal
    /// probabilities.
    ///
    /// It starts from `(x_0, y_0)`, the fixed point of the first map, so every point is on the
    /// graph up to rounding. For images only: **the points do not bound the range**. After 10⁴
    /// points 3 to 9 % of the range of g of the source are still missing, and up to 27 % for other
    /// systems. [`System::range`] and [`System::extrema`] compute rigorous bounds. On unequal knots
    /// the points are denser in short cells.
    ///
    /// Cochran, Lewis, Hart 2000, Algorithm 1; random numbers by SplitMix64 (Steele, Lea, Flood
    /// 2014).
    ///
    /// ```
    /// let f = asperity_fif::cochran_2000::f()?;
    /// for (x, y) in f.chaos_game(7).take(1000) {
    ///     assert!((f.evaluate(x, 1e-12).value - y).abs() < 1e-12);
    /// }
    /// # Ok::<(), asperity_fif::FifError>(())
    /// ```
    pub fn chaos_game(&self, seed: u64) -> impl Iterator<Item = (f64, f64)> + Clone + '_ {
        let (pieces, start) = (self.pieces(), (self.domain().lo, self.end_values()[0]));
        let start = (SplitMix64 { state: seed }, start);
        let points = core::iter::repeat(()).scan(start, |(random, point), ()| {
            let index = (u128::from(random.word()) * pieces.len() as u128) >> 64;
            *point = pieces.get(index as usize)?.map().apply(point.0, point.1);
            Some(*point)
        });
        points.fuse()
    }
}

#[cfg(test)]
mod tests {
    use crate::cochran_2000;

    #[test]
    fn chaos_game_misses_a_part_of_the_range() {
        let g = cochran_2000::g().unwrap();
        let whole = g.extrema(1e-6).enclosure();
        let (mut lo, mut hi, mut left) = (f64::INFINITY, f64::NEG_INFINITY, 0);
        for (x, y) in g.chaos_game(1).take(10_000) {
            assert!(g.domain().contains(x) && whole.inflated(1e-12).contains(y), "({x}, {y})");
            (lo, hi) = (lo.min(y), hi.max(y));
            left += u32::from(x < 1.0);
        }
        let missing = 1.0 - (hi - lo) / whole.width();
        assert!((0.033..0.034).contains(&missing), "{missing}");
        // Five standard deviations of 10⁴ fair coins.
        assert!(left.abs_diff(5000) < 250, "{left}");
    }
}
