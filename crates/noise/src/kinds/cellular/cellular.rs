//! Cellular noise: distances to the nearest feature points, one at a random position in each cell.

use asperity_core::math;

use crate::{
    contract::compiled::on_lattice,
    contract::kernel::{Kernel, Measured},
    contract::noise::{kind, noise, tiles},
    error::NoiseError,
    kinds::cellular::metric::Metric,
    kinds::cellular::rows::{Columns, LONG_STEP},
    kinds::cellular::search::{CellPosition, Features, number},
    lanes::{LaneSample, Lanes, splat},
    lattice::integer_hash::IntegerHash,
    lattice::lattice::Lattice,
    row::cells::POINTS,
    row::row::Strip,
    statistics::cellular,
    statistics::statistics::Statistics,
    statistics::tables,
};

/// The output of cellular noise, a function of the nearest feature points.
///
/// Worley's Fₙ is the distance to the nth nearest feature point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum CellularOutput {
    /// F₁, the distance to the nearest feature point: continuous, with a crease where two are
    /// equally near.
    #[default]
    F1,
    /// F₂, the distance to the second nearest.
    ///
    /// Continuous, with creases where the two nearest, or the second and third nearest, are equally
    /// near.
    F2,
    /// F₂ − F₁: continuous, and 0 on the borders between the regions of feature points.
    F2MinusF1,
    /// A random number of the nearest feature point, uniform in (−1, 1).
    ///
    /// Constant in the region of the feature point and discontinuous at its border.
    Cell,
}

/// Cellular noise: the exact distance to the nearest feature points, one at a random position in
/// each cell.
///
#[cfg_attr(doc, doc = include_str!("../../../docs/pictures/cellular.md"))]
///
/// ```text
/// F₁(p) = min_c |p − x_c|,   F₂(p) = the second least |p − x_c|,   x_c = c + ½ + j (u_c − ½)
/// ```
///
/// In 1 to 4 dimensions, with u uniform in the unit cube. [`CellularOutput`] and [`Metric`] are
/// configurable. The jitter j is 1 by default. At 0 feature points are the centers of cells. The
/// value is the distance itself, in cells, with a positive [mean](crate::Moments).
/// [`Unit`](crate::ops::Unit) maps its range to [0, 1], and [`Fbm`](crate::Fbm) of variance 1
/// subtract the mean.
///
/// - **Exact search:** visits every cell that can be as near as the current result, up to 2 cells
///   away in the Euclidean metric, n cells in the Manhattan metric and 1 in the Chebyshev metric.
/// - **Range:** from 0 to the supremum, with h = (1 + j)/2. In the Euclidean, Manhattan and
///   Chebyshev metric the supremum of F₁ is √n h, n h and h. The supremum of F₂ and of F₂ − F₁ is
///   √max(n h², (n − 1) j²/4 + (1 + j/2)²), max(n h, 1 + n j/2) and 1 + j/2.
/// - **Gradient:** the gradient of the distance to the feature point, of length 1 in the Euclidean
///   metric, and 0 where the distance is 0. The gradient is discontinuous where two feature points
///   are equally near. There it is the gradient of the cell that comes first in the order of its
///   coordinates, the first axis before the last, before the axes between. In the Manhattan and the
///   Chebyshev metric the gradient is also discontinuous on axes and diagonals through the feature
///   point.
/// - **Resolution of positions:** j 2⁻¹⁶.
///
/// Worley 1996, "A Cellular Texture Basis Function". Unlike there each cell has one feature point
/// instead of a Poisson-distributed number, which avoids empty regions.
///
/// ```
/// use asperity_noise::{CellularOutput, Cellular, Field, Metric, glam::Vec3};
///
/// let (noise, p) = (Cellular::new(3), Vec3::new(0.3, -1.2, 4.5));
/// let [near, far, between] = [CellularOutput::F1, CellularOutput::F2, CellularOutput::F2MinusF1].map(|basis| noise.with_output(basis).value(p));
/// assert!(near <= far && between == far - near);
///
/// let nearest = p - near * noise.sample(p).gradient;
/// assert!(noise.value(nearest) < 1e-6);
///
/// let squares = noise.with_metric(Metric::Chebyshev).with_jitter(0.0)?;
/// assert!((squares.value(Vec3::new(0.1, 0.5, 0.5)) - 0.4).abs() < 1e-6);
/// assert!(noise.with_jitter(1.5).is_err());
/// # Ok::<(), asperity_noise::NoiseError>(())
/// ```
#[doc(alias("worley", "voronoi", "F1", "F2"))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cellular<L = IntegerHash> {
    seed: u32,
    pub(super) basis: CellularOutput,
    pub(super) metric: Metric,
    jitter: f32,
    lattice: L,
}

kind!(
    Cellular { basis: CellularOutput::F1, metric: Metric::Euclidean, jitter: 1.0 },
    "F₁ in the Euclidean metric with a jitter of 1"
);
noise!(Cellular);
tiles!(Cellular);

impl<L> Cellular<L> {
    /// Sets the output of the noise.
    #[must_use]
    pub fn with_output(self, basis: CellularOutput) -> Self {
        Self { basis, ..self }
    }

    /// Returns the output of the noise.
    #[must_use]
    pub const fn basis(&self) -> CellularOutput {
        self.basis
    }

    /// Sets the metric.
    #[must_use]
    pub fn with_metric(self, metric: Metric) -> Self {
        Self { metric, ..self }
    }

    /// Returns the metric.
    #[must_use]
    pub const fn metric(&self) -> Metric {
        self.metric
    }

    /// Sets the jitter, the side of the box in the middle of each cell that contains its feature
    /// point.
    ///
    /// # Errors
    ///
    /// If the jitter is not in [0, 1].
    pub fn with_jitter(self, jitter: f32) -> Result<Self, NoiseError> {
        if (0.0..=1.0).contains(&jitter) {
            // −0 + 0 = 0.
            Ok(Self { jitter: jitter + 0.0, ..self })
        } else {
            Err(NoiseError::OutOfRange { parameter: "jitter", value: jitter, min: 0.0, max: 1.0 })
        }
    }

    /// Returns j, the side of the box in the middle of a cell that contains its feature point.
    #[must_use]
    pub const fn jitter(&self) -> f32 {
        self.jitter
    }

    fn features(&self, seed: u32) -> Features<'_, L> {
        Features { lattice: &self.lattice, seed, metric: self.metric, jitter: self.jitter }
    }
}

impl<L: Lattice, const N: usize> Kernel<N> for Cellular<L> {
    const LONG_STEP: f32 = LONG_STEP;

    type RowScratch = Columns<N>;

    on_lattice!();

    #[inline(always)]
    fn evaluate<S: Lanes, const GRADIENTS: bool>(&self, s: S, p: [S::F; N], seed: u32) -> LaneSample<S, N> {
        let (features, position) = (self.features(seed), CellPosition::<S, N>::new(s, p));
        if !GRADIENTS && self.basis != CellularOutput::Cell {
            let nearest = features.nearest::<S, N, false>(s, &position, self.takes_second());
            return self.of_measures::<S, N>(s, nearest.measures);
        }
        let nearest = features.nearest::<S, N, true>(s, &position, self.takes_second());
        let (word, offsets) = features.of_rank::<S, N>(s, &position, nearest.ranks[0]);
        if self.basis == CellularOutput::Cell {
            return (number(s, word), [s.float(0.0); N]);
        }
        let mut both = [offsets; 2];
        if self.takes_second() {
            both[1] = features.of_rank::<S, N>(s, &position, nearest.ranks[1]).1;
        }
        self.of_offsets(s, nearest.measures, both)
    }

    #[inline(always)]
    fn rows<S: Lanes, const GRADIENTS: bool>(
        &self,
        s: S,
        columns: &mut Columns<N>,
        mut strip: Strip<'_, N, GRADIENTS>,
    ) -> usize {
        let features = self.features(strip.seed);
        let count = strip.values.len();
        for start in (0..count).step_by(POINTS) {
            let mut part = strip.part(start..count.min(start + POINTS));
            let (points, mut i) = (part.values.len(), 0);
            if columns.plan(s, self.metric, &part.row, points) {
                let positions = splat(s, columns.fill(s, &features, &part.row, self.takes_second()));
                let run = columns.plan.run(0);
                for j in 0..columns.cells {
                    let (_, end) = columns.plan.cell(&run, j);
                    self.wave::<S, N, GRADIENTS>(
                        s,
                        columns.seen(j),
                        &columns.plan,
                        positions,
                        &mut part,
                        i..end,
                    );
                    i = end;
                }
            }
            if i < points {
                return start + i;
            }
        }
        count
    }
}

impl<L> Cellular<L> {
    #[inline(always)]
    pub(super) fn takes_second(&self) -> bool {
        matches!(self.basis, CellularOutput::F2 | CellularOutput::F2MinusF1)
    }

    /// The value for measures of the nearest and the second nearest feature point.
    #[inline(always)]
    pub(super) fn of_measures<S: Lanes, const N: usize>(
        &self,
        s: S,
        [first, second]: [S::F; 2],
    ) -> LaneSample<S, N> {
        let value = match self.basis {
            CellularOutput::F1 | CellularOutput::Cell => self.metric.distance(s, first),
            CellularOutput::F2 => self.metric.distance(s, second),
            CellularOutput::F2MinusF1 => self.metric.distance(s, second) - self.metric.distance(s, first),
        };
        (value, [s.float(0.0); N])
    }

    /// Value and gradient for the offsets from the nearest and the second nearest feature point.
    #[inline(always)]
    pub(super) fn of_offsets<S: Lanes, const N: usize>(
        &self,
        s: S,
        measures: [S::F; 2],
        offsets: [[S::F; N]; 2],
    ) -> LaneSample<S, N> {
        let (value, mut gradient) = self.of_measures::<S, N>(s, measures);
        if self.basis != CellularOutput::F2 {
            gradient = self.metric.slopes(s, offsets[0], self.metric.distance(s, measures[0]));
        }
        if self.takes_second() {
            let second = self.metric.slopes(s, offsets[1], self.metric.distance(s, measures[1]));
            for axis in 0..N {
                gradient[axis] = second[axis] - gradient[axis];
            }
        }
        (value, gradient)
    }
}

/// The supremum of F₁, and of F₂ and F₂ − F₁, for feature points in boxes of side `jitter`.
///
/// Consider a point at |t − ½| = a from the middle of its cell along every axis. Its own feature
/// point is within |a + j/2|. The feature point across the nearest border is within |a + j/2| with
/// 1 − a + j/2 along the axis of the largest a. The first bound is largest at a = ½, the second at
/// a = 0 or a = ½, as it is convex in a.
fn supremum(metric: Metric, jitter: f32, second: bool, dimension: usize) -> f32 {
    let (n, half) = (dimension as f32, 0.5 * jitter);
    let (corner, across) = (0.5 + half, 1.0 + half);
    let [at_corner, at_center] = match metric {
        Metric::Euclidean => {
            [n * (corner * corner), (n - 1.0) * (half * half) + across * across].map(math::sqrt)
        }
        Metric::Manhattan => [n * corner, (n - 1.0) * half + across],
        Metric::Chebyshev => [corner, across],
    };
    // Accounts for the rounding of offsets and of the sum.
    let largest = if second { at_corner.max(at_center) } else { at_corner };
    largest * (1.0 + 2e-6)
}

/// The polynomial through numbers at the jitters 0, ¼, ½, ¾ and 1.
fn at_jitter(jitter: f32, numbers: [f32; 5]) -> f32 {
    (0..5).fold(0.0, |sum, i| {
        let basis = (0..5)
            .filter(|&j| j != i)
            .fold(1.0, |product, j| product * (4.0 * jitter - j as f32) / (i as f32 - j as f32));
        sum + basis * numbers[i]
    })
}

impl<L> Cellular<L> {
    /// E nᵏ, k = 1 … 4, at the jitters 0, ¼, ½, ¾ and 1; `None` for [`CellularOutput::Cell`].
    fn moments<const N: usize>(&self) -> Option<[[f32; 4]; 5]> {
        let basis = match self.basis {
            CellularOutput::F1 => 0,
            CellularOutput::F2 => 1,
            CellularOutput::F2MinusF1 => 2,
            CellularOutput::Cell => return None,
        };
        Some(cellular::MOMENTS.each_ref().map(|tables| tables[basis][row(self.metric, N)]))
    }
}

/// The row of a metric in the tables of a dimension; in 1-D all metrics are equal.
const fn row(metric: Metric, dimension: usize) -> usize {
    if dimension == 1 { 0 } else { metric as usize % 3 * 3 + dimension - 1 }
}

impl<L, const N: usize> Measured<N> for Cellular<L> {
    fn seed(&self) -> u32 {
        self.seed
    }

    /// The statistics at jitter 1.
    fn statistics(&self) -> &'static Statistics {
        let basis = match self.basis {
            CellularOutput::F1 => 0,
            CellularOutput::F2 => 1,
            CellularOutput::F2MinusF1 => 2,
            CellularOutput::Cell => return &tables::WHITE[N - 1],
        };
        &cellular::STATISTICS[basis][row(self.metric, N)]
    }

    fn mean(&self) -> f32 {
        self.moments::<N>().map_or(0.0, |tables| at_jitter(self.jitter, tables.map(|[mean, ..]| mean)))
    }

    fn bounds(&self) -> [f32; 2] {
        match self.basis {
            CellularOutput::Cell => [-1.0, 1.0],
            basis => [0.0, supremum(self.metric, self.jitter, basis != CellularOutput::F1, N)],
        }
    }

    fn standard_deviation(&self) -> f32 {
        let deviation = |[mean, square, ..]: [f32; 4]| math::sqrt((square - mean * mean).max(0.0));
        self.moments::<N>().map_or(tables::WHITE[N - 1].standard_deviation, |tables| {
            at_jitter(self.jitter, tables.map(deviation))
        })
    }

    fn absolute_moments(&self) -> [f32; 4] {
        let Some(tables) = self.moments::<N>() else { return tables::WHITE[N - 1].absolute_moments };
        let (mean, deviation) = (Measured::<N>::mean(self), Measured::<N>::standard_deviation(self));
        let higher = [2, 3].map(|k| at_jitter(self.jitter, tables.map(|moments| moments[k])));
        [mean, mean * mean + deviation * deviation, higher[0], higher[1]]
    }
}
