//! The search of the nearest feature points of points, one in each lane.

use crate::{
    kinds::cellular::metric::Metric,
    lanes::Lanes,
    lattice::integer_hash::further,
    lattice::lattice::{Lattice, cell},
    lattice::variates::uniform,
};

/// Cells may be passed over whose border is farther than the second nearest point: less than this is lost to rounding, which
/// is 5e-7 for ways up to 5.
const MARGIN: f32 = 4e-6;

/// Weights of the cells' steps in a rank: steps are from −4 to 4, and the first axis weighs most.
const RANKS: [[f32; 4]; 4] =
    [[1.0, 0.0, 0.0, 0.0], [9.0, 1.0, 0.0, 0.0], [81.0, 1.0, 9.0, 0.0], [729.0, 1.0, 9.0, 81.0]];

/// The feature points of a lattice, one in each cell.
pub(super) struct Features<'a, L> {
    pub(super) lattice: &'a L,
    pub(super) seed: u32,
    pub(super) metric: Metric,
    /// The side of the box in the middle of a cell that its feature point lies in.
    pub(super) jitter: f32,
}

/// The cells of points, and the points' places there.
pub(super) struct Place<S: Lanes, const N: usize> {
    pub(super) cell: [S::U; N],
    pub(super) t: [S::F; N],
}

impl<S: Lanes, const N: usize> Place<S, N> {
    #[inline(always)]
    pub(super) fn new(s: S, p: [S::F; N]) -> Self {
        let mut place = Self { cell: [s.word(0); N], t: p };
        for axis in 0..N {
            let (cell, t) = cell(s, p[axis]);
            place.cell[axis] = cell;
            place.t[axis] = t;
        }
        place
    }
}

/// The number of the cell of a word.
#[inline(always)]
pub(super) fn number<S: Lanes>(s: S, word: S::U) -> S::F {
    uniform(s, further::<S, 2>(s, word))
}

/// Measures of the distances to the nearest and to the second nearest feature point, and the ranks of their cells.
pub(super) struct Nearest<S: Lanes> {
    pub(super) measures: [S::F; 2],
    pub(super) ranks: [S::F; 2],
}

impl<S: Lanes> Nearest<S> {
    #[inline(always)]
    fn none(s: S) -> Self {
        let far = s.float(f32::INFINITY);
        Self { measures: [far; 2], ranks: [far; 2] }
    }

    /// Takes a feature point in; of two at one distance that of the lower rank is nearer, in whichever order they come.
    #[inline(always)]
    fn take<const RANKED: bool>(&mut self, s: S, measure: S::F, rank: S::F) {
        let [first, second] = self.measures;
        if !RANKED {
            self.measures = [s.min(first, measure), s.min(second, s.max(first, measure))];
            return;
        }
        let before = |other: S::F, other_rank: S::F| {
            let (yes, no) = (s.float(1.0), s.float(0.0));
            let tied = s.select(s.less(rank, other_rank), yes, no);
            let not_farther = s.select(s.less(other, measure), no, tied);
            s.less(no, s.select(s.less(measure, other), yes, not_farther))
        };
        let [first_rank, second_rank] = self.ranks;
        let (nearest, nearer) = (before(first, first_rank), before(second, second_rank));
        let place = |first, second, new| {
            let displaced = s.select(nearest, first, s.select(nearer, new, second));
            [s.select(nearest, new, first), displaced]
        };
        self.measures = place(first, second, measure);
        self.ranks = place(first_rank, second_rank, rank);
    }
}

/// One axis of a cell that is visited: the term of its word, and its step from the point's own cell.
struct Axis<S: Lanes> {
    term: S::U,
    step: S::F,
}

impl<S: Lanes> Clone for Axis<S> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Lanes> Copy for Axis<S> {}

impl<L: Lattice> Features<'_, L> {
    /// The places of the feature points of words in their cells.
    #[inline(always)]
    pub(super) fn places<S: Lanes, const N: usize>(&self, s: S, word: S::U) -> [S::F; N] {
        let low = s.word(0xffff);
        let second = if N > 2 { further::<S, 1>(s, word) } else { word };
        let fields = [s.shr::<16>(word), word & low, s.shr::<16>(second), second & low];
        let (side, corner) = (s.float(self.jitter / 65_536.0), s.float(0.5 - 0.5 * self.jitter));
        let mut places = [corner; N];
        for axis in 0..N {
            places[axis] = corner + (s.real(fields[axis]) + s.float(0.5)) * side;
        }
        places
    }

    /// The ways from feature points to points.
    #[inline(always)]
    fn ways<S: Lanes, const N: usize>(
        &self,
        s: S,
        place: &Place<S, N>,
        axes: &[Axis<S>; N],
        word: S::U,
    ) -> [S::F; N] {
        let places = self.places::<S, N>(s, word);
        let mut ways = places;
        for axis in 0..N {
            ways[axis] = place.t[axis] - (axes[axis].step + places[axis]);
        }
        ways
    }

    #[inline(always)]
    fn word<S: Lanes, const N: usize>(&self, s: S, axes: &[Axis<S>; N]) -> S::U {
        let mut terms = [axes[0].term; N];
        for axis in 1..N {
            terms[axis] = axes[axis].term;
        }
        self.lattice.words(s, terms, self.seed)
    }

    #[inline(always)]
    fn visit<S: Lanes, const N: usize, const RANKED: bool>(
        &self,
        s: S,
        place: &Place<S, N>,
        axes: &[Axis<S>; N],
        nearest: &mut Nearest<S>,
    ) {
        let ways = self.ways(s, place, axes, self.word(s, axes));
        let mut rank = s.float(0.0);
        if RANKED {
            for axis in 0..N {
                rank = rank + axes[axis].step * s.float(RANKS[N - 1][axis]);
            }
        }
        nearest.take::<RANKED>(s, self.metric.measure(s, ways), rank);
    }

    /// The nearest feature point and, if `second`, the second nearest; of no meaning else.
    ///
    /// The 2ⁿ cells next to the nearest corner are visited first. Along an axis the others follow in the order of their distance,
    /// and end where the border of a cell is farther than what is sought in every lane.
    #[inline(always)]
    pub(super) fn nearest<S: Lanes, const N: usize, const RANKED: bool>(
        &self,
        s: S,
        place: &Place<S, N>,
        second: bool,
    ) -> Nearest<S> {
        let mut nearest = Nearest::none(s);
        let zero = s.float(0.0);
        // Towards the nearer border, and the distance of the point from the middle of its cell.
        let (mut towards, mut off_centre) = ([zero; N], [zero; N]);
        let mut near = [[Axis { term: place.cell[0], step: zero }; 2]; N];
        for axis in 0..N {
            let t = place.t[axis] - s.float(0.5);
            towards[axis] = s.select(s.less(t, zero), s.float(-1.0), s.float(1.0));
            off_centre[axis] = s.abs(t);
            near[axis] = [self.axis(s, place, axis, zero), self.axis(s, place, axis, towards[axis])];
        }
        for corner in 0..1 << N {
            let mut axes = [near[0][corner & 1]; N];
            for axis in 1..N {
                axes[axis] = near[axis][corner >> axis & 1];
            }
            self.visit::<S, N, RANKED>(s, place, &axes, &mut nearest);
        }

        let last = 2 * self.metric.reach(N);
        let half = 0.5 * self.jitter + MARGIN;
        // Along an axis whose point is so far from the middle of its cell.
        let gap = |off_centre: S::F, turn: usize| {
            let cells = turn.div_ceil(2) as f32;
            let off = if turn % 2 == 1 { -off_centre } else { off_centre };
            s.max(s.float(cells - half) + off, zero)
        };
        let mut turns = [0; N];
        let mut axes = [near[0][0]; N];
        // The measure of the gaps along an axis and those after it.
        let mut gaps = [zero; 5];
        for axis in (0..N).rev() {
            axes[axis] = near[axis][0];
            gaps[axis] = self.metric.joined(s, gaps[axis + 1], gap(off_centre[axis], 0));
        }
        let mut axis = 0;
        while axis < N {
            turns[axis] += 1;
            let turn = turns[axis];
            if turn <= last {
                let gaps_here = self.metric.joined(s, gaps[axis + 1], gap(off_centre[axis], turn));
                let sought = nearest.measures[usize::from(second)];
                if !s.all(s.less(sought, gaps_here)) {
                    gaps[axis] = gaps_here;
                    let cells = turn.div_ceil(2) as f32;
                    let step = towards[axis] * s.float(if turn % 2 == 1 { cells } else { -cells });
                    axes[axis] = self.axis(s, place, axis, step);
                    for before in (0..axis).rev() {
                        gaps[before] = self.metric.joined(s, gaps[before + 1], gap(off_centre[before], 0));
                    }
                    axis = 0;
                    if turns.iter().any(|&turn| turn > 1) {
                        self.visit::<S, N, RANKED>(s, place, &axes, &mut nearest);
                    }
                    continue;
                }
            }
            turns[axis] = 0;
            axes[axis] = near[axis][0];
            axis += 1;
        }
        nearest
    }

    #[inline(always)]
    fn axis<S: Lanes, const N: usize>(&self, s: S, place: &Place<S, N>, axis: usize, step: S::F) -> Axis<S> {
        Axis { term: self.lattice.term(s, axis, place.cell[axis] + s.integer(step)), step }
    }

    /// The word and the ways of the feature point of a rank.
    #[inline(always)]
    pub(super) fn of_rank<S: Lanes, const N: usize>(
        &self,
        s: S,
        place: &Place<S, N>,
        rank: S::F,
    ) -> (S::U, [S::F; N]) {
        let weights = RANKS[N - 1];
        let mut axes = [Axis { term: place.cell[0], step: s.float(0.0) }; N];
        // The greatest weight first: the first axis, then from the last one down.
        let mut rest = rank;
        for turn in 0..N {
            let axis = if turn == 0 { 0 } else { N - turn };
            // The rest of lesser weights is under half a weight.
            let step = s.floor(rest * s.float(1.0 / weights[axis]) + s.float(0.5));
            rest = rest - step * s.float(weights[axis]);
            axes[axis] = self.axis(s, place, axis, step);
        }
        let word = self.word(s, &axes);
        (word, self.ways(s, place, &axes, word))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Basis, Cellular, Field, Point,
        contract::kernel::{FillRow, Measured},
        lanes::{Arithmetic, Scalar, level::Level},
        lattice::integer_hash::{IntegerHash, mix},
        lattice::lattice::OnLattice,
        row::row::Row,
    };
    use approx::assert_abs_diff_eq;
    use core::array::from_fn;
    use glam::{Vec2, Vec3, Vec4};

    const METRICS: [Metric; 3] = [Metric::Euclidean, Metric::Manhattan, Metric::Chebyshev];

    /// A feature point as a plain search in `f64` finds it.
    #[derive(Clone, Copy)]
    struct Found<const N: usize> {
        distance: f64,
        way: [f64; N],
        word: u32,
    }

    /// The three nearest feature points in all cells up to `window` away.
    fn wide_search<L: Lattice, const N: usize>(
        noise: &Cellular<L>,
        p: [f32; N],
        window: i32,
    ) -> [Found<N>; 3] {
        let mut nearest = [Found { distance: f64::INFINITY, way: [0.0; N], word: 0 }; 3];
        let side = 2 * window + 1;
        for index in 0..side.pow(N as u32) {
            let cell: [i32; N] = from_fn(|axis| {
                f64::from(p[axis]).floor() as i32 + index / side.pow(axis as u32) % side - window
            });
            let word = OnLattice::lattice(noise).word(cell, Measured::<N>::seed(noise));
            let second = further::<_, 1>(Scalar, Scalar.word(word)).0;
            let fields = [word >> 16, word & 0xffff, second >> 16, second & 0xffff];
            let way: [f64; N] = from_fn(|axis| {
                let u = (f64::from(fields[axis]) + 0.5) / 65_536.0;
                f64::from(p[axis]) - (f64::from(cell[axis]) + 0.5 + f64::from(noise.jitter()) * (u - 0.5))
            });
            let distance = match noise.metric() {
                Metric::Euclidean => way.iter().map(|d| d * d).sum::<f64>().sqrt(),
                Metric::Manhattan => way.iter().map(|d| d.abs()).sum(),
                Metric::Chebyshev => way.iter().fold(0.0, |greatest, d| d.abs().max(greatest)),
            };
            let place = nearest.iter().position(|other| distance < other.distance);
            if let Some(place) = place {
                nearest[place..].rotate_right(1);
                nearest[place] = Found { distance, way, word };
            }
        }
        nearest
    }

    /// The bases at a point against a wide search, and their gradients and the cell where no other feature point is as near.
    fn compare<V, L, const N: usize>(noise: Cellular<L>, p: [f32; N], window: i32)
    where
        V: Point<Coordinates = [f32; N]>,
        L: Lattice + Copy,
    {
        let nearest = wide_search(&noise, p, window);
        let [first, second, third] = nearest.map(|found| found.distance);
        let what = || alloc::format!("{:?} {p:?} of jitter {}", noise.metric(), noise.jitter());
        for (basis, expected) in [(Basis::F1, first), (Basis::F2, second), (Basis::F2MinusF1, second - first)]
        {
            let noise = noise.with_basis(basis);
            let sample = noise.sample(V::from_coordinates(p));
            // Ways are rounded by up to 2.4e-7 each and their roots by little; 7e-7 was seen.
            assert!((f64::from(sample.value) - expected).abs() < 1.5e-6, "{basis:?} {}: {sample:?}", what());
            assert_eq!(noise.value(V::from_coordinates(p)), sample.value, "{basis:?} {}", what());
            let [low, high] = Field::<V>::range(&noise);
            assert!((low..=high).contains(&sample.value), "{basis:?} {}: {sample:?}", what());
            let slope = |found: &Found<N>, axis: usize| match noise.metric() {
                Metric::Euclidean => found.way[axis] / found.distance,
                Metric::Manhattan => found.way[axis].signum(),
                Metric::Chebyshev if found.way[axis].abs() == found.distance => found.way[axis].signum(),
                Metric::Chebyshev => 0.0,
            };
            // Near creases and near feature points the last bits decide.
            let apart = |found: &Found<N>| {
                let ways = found.way.map(f64::abs);
                let ties = (0..N).any(|i| (0..i).any(|j| (ways[i] - ways[j]).abs() < 1e-5));
                ways.iter().all(|&way| way > 1e-3) && !(noise.metric() == Metric::Chebyshev && ties)
            };
            let clear = second - first > 1e-5 && (basis == Basis::F1 || third - second > 1e-5);
            if clear && nearest[..2].iter().all(apart) {
                for (axis, slope_here) in sample.gradient.coordinates().into_iter().enumerate() {
                    let expected = match basis {
                        Basis::F1 => slope(&nearest[0], axis),
                        Basis::F2 => slope(&nearest[1], axis),
                        _ => slope(&nearest[1], axis) - slope(&nearest[0], axis),
                    };
                    // A way of 1e-3 is rounded by 2.4e-7.
                    assert_abs_diff_eq!(f64::from(slope_here), expected, epsilon = 6e-4);
                }
            }
        }
        if second - first > 1e-5 {
            let cell = noise.with_basis(Basis::Cell).value(V::from_coordinates(p));
            assert_eq!(cell, number(Scalar, Scalar.word(nearest[0].word)), "{}", what());
        }
    }

    /// Random places, a third of them next to borders, in cells near the origin and far from it.
    fn random_point<const N: usize>(counter: &mut u64) -> [f32; N] {
        from_fn(|_| {
            *counter += 1;
            let word = mix(*counter);
            let t = (word >> 40) as f32 / 16_777_216.0;
            let t = match word % 6 {
                0 => 1e-3 * t,
                1 => 1.0 - 1e-3 * t,
                _ => t,
            };
            ((word >> 8 & 63) as i32 - 32) as f32 + t
        })
    }

    fn compare_at_random<V: Point<Coordinates = [f32; N]>, const N: usize>(count: u32, window: i32) {
        for metric in METRICS {
            let mut counter = 1 << 32;
            for i in 0..count {
                let jitter = [1.0, 1.0, 1.0, 0.6, 0.25][i as usize % 5];
                let noise = Cellular::new(i).with_metric(metric).with_jitter(jitter).unwrap();
                compare::<V, IntegerHash, N>(noise, random_point(&mut counter), window);
            }
        }
    }

    #[test]
    fn no_feature_point_is_missed_at_random_points() {
        compare_at_random::<f32, 1>(2000, 4);
        compare_at_random::<Vec2, 2>(2000, 4);
        compare_at_random::<Vec3, 3>(400, 4);
        compare_at_random::<Vec4, 4>(60, 4);
    }

    /// Rows that find their feature points together, each a step further along all axes but the first, against a wide search.
    fn compare_rows<const N: usize>(rows: u16, points: usize, window: i32) {
        for (metric, step) in METRICS.into_iter().zip([0.05, -0.031, 0.12]) {
            for basis in [Basis::F1, Basis::F2] {
                let noise = Cellular::new(7).with_metric(metric).with_basis(basis);
                let (mut columns, mut values) = (Default::default(), alloc::vec![0.0; points]);
                for i in 0..rows {
                    let origin = from_fn(|axis| 0.31 + 0.07 * f32::from(i) - 1.4 * axis as f32);
                    let row = Row::<N>::new(origin, step, 0);
                    let (scratch, values) = (&mut columns, &mut values[..]);
                    let call =
                        FillRow::<_, N> { kernel: &noise, seed: 7, row, scratch, values, gradients: None };
                    call.at(Level::Scalar.instructions());
                    for (k, &value) in values.iter().enumerate() {
                        let nearest = wide_search(&noise, row.point(k), window);
                        let expected = nearest[usize::from(basis == Basis::F2)].distance;
                        // As above.
                        assert!((f64::from(value) - expected).abs() < 1.5e-6, "{noise:?} {:?}", row.point(k));
                    }
                }
            }
        }
    }

    #[test]
    fn no_feature_point_is_missed_along_rows() {
        compare_rows::<1>(1, 600, 3);
        compare_rows::<2>(20, 70, 4);
        compare_rows::<3>(9, 40, 3);
        compare_rows::<4>(2, 24, 4);
    }

    /// Feature points as far from the origin as their cells allow, but for those of planted cells, which are as near.
    #[derive(Clone, Copy)]
    struct Planted<'a> {
        /// Words of feature points in each corner of a cell.
        words: &'a [u32; 16],
        cells: [[i32; 4]; 2],
    }

    impl Lattice for Planted<'_> {
        fn word<const N: usize>(&self, cell: [i32; N], _: u32) -> u32 {
            let near = self.cells.iter().any(|planted| planted[..N] == cell);
            let corner =
                (0..N).fold(0, |corner, axis| corner | usize::from((cell[axis] >= 0) != near) << axis);
            self.words[corner]
        }
    }

    /// Words whose feature points lie within 1/16 of each corner of their cells.
    fn words_of_corners() -> [u32; 16] {
        from_fn(|corner| {
            let ends = |field: u32, axis: usize| field >> 12 == if corner >> axis & 1 == 1 { 15 } else { 0 };
            let of = |axis: usize, low: u32| if corner >> axis & 1 == 1 { 0xf000 | low } else { low };
            let word = |i: u32| of(0, i >> 12) << 16 | of(1, i & 0xfff);
            let fits = |&word: &u32| {
                let second = further::<_, 1>(Scalar, Scalar.word(word)).0;
                ends(second >> 16, 2) && ends(second & 0xffff, 3)
            };
            (0..1 << 24).map(word).find(fits).unwrap()
        })
    }

    fn compare_with_planted<V: Point<Coordinates = [f32; N]>, const N: usize>(count: u32) {
        let words = words_of_corners();
        for metric in METRICS {
            let mut counter = 2 << 32;
            for i in 0..count {
                // Up to N + 1 cells away along one axis and next to the origin or two away along the others.
                let cells = from_fn(|k| {
                    let mut next = |bound: u64| {
                        counter += 1;
                        (mix(counter) >> 20) % bound
                    };
                    let axis = next(N as u64) as usize;
                    let far = next(N as u64 + 1) as i32 + 1;
                    from_fn(|other| {
                        let away = if other == axis { far } else { next(5) as i32 / 4 };
                        if k == 0 || next(2) == 0 { away } else { -1 - away }
                    })
                });
                let p = from_fn(|_| {
                    counter += 1;
                    let t = (mix(counter) >> 40) as f32 / 16_777_216.0;
                    if i % 4 == 0 { t - 0.5 } else { 0.02 * t - 0.01 }
                });
                let lattice = Planted { words: &words, cells };
                let noise = Cellular::new(0).with_metric(metric).with_lattice(lattice);
                compare::<V, _, N>(noise, p, N as i32 + 1);
            }
        }
    }

    #[test]
    fn no_feature_point_is_missed_far_away() {
        compare_with_planted::<f32, 1>(100);
        compare_with_planted::<Vec2, 2>(400);
        compare_with_planted::<Vec3, 3>(200);
        compare_with_planted::<Vec4, 4>(60);
    }
}
