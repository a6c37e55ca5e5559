//! Metrics of cellular noise.

use crate::lanes::Lanes;

/// The metric that cellular noise measures distances in.
///
/// ```text
/// Euclidean √(Σ dᵢ²),   Manhattan Σ |dᵢ|,   Chebyshev max |dᵢ|
/// ```
///
/// The square of the Euclidean distance is no metric; it has the same nearest points, so that its F₁ is this one times itself.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Metric {
    /// √(Σ dᵢ²): round cells.
    #[default]
    Euclidean,
    /// Σ |dᵢ|: diamonds.
    Manhattan,
    /// max |dᵢ|: squares.
    Chebyshev,
}

impl Metric {
    /// A measure with one way more: Σ d² of the Euclidean metric, the distance itself of the others. No measure is −0.
    #[inline(always)]
    pub(super) fn joined<S: Lanes>(self, s: S, measure: S::F, way: S::F) -> S::F {
        match self {
            Self::Euclidean => measure + way * way,
            Self::Manhattan => measure + s.abs(way),
            Self::Chebyshev => s.max(measure, s.abs(way)),
        }
    }

    /// The measure of the ways along all axes but the first.
    #[inline(always)]
    pub(super) fn rest<S: Lanes, const N: usize>(self, s: S, ways: [S::F; N]) -> S::F {
        let mut measure = s.float(0.0);
        for axis in 1..N {
            measure = self.joined(s, measure, ways[axis]);
        }
        measure
    }

    /// The measure of ways, the first axis last: it is what changes along a row.
    #[inline(always)]
    pub(super) fn measure<S: Lanes, const N: usize>(self, s: S, ways: [S::F; N]) -> S::F {
        self.joined(s, self.rest(s, ways), ways[0])
    }

    /// The distance of a measure.
    #[inline(always)]
    pub(super) fn distance<S: Lanes>(self, s: S, measure: S::F) -> S::F {
        match self {
            Self::Euclidean => s.sqrt(measure),
            Self::Manhattan | Self::Chebyshev => measure,
        }
    }

    /// The gradient of the distance along the ways; 0 where the distance is, and of axes tied for the greatest way the first counts.
    #[inline(always)]
    pub(super) fn slopes<S: Lanes, const N: usize>(self, s: S, ways: [S::F; N], distance: S::F) -> [S::F; N] {
        let (zero, one) = (s.float(0.0), s.float(1.0));
        let sign = |x| s.select(s.less(zero, x), one, s.select(s.less(x, zero), s.float(-1.0), zero));
        let mut slopes = [zero; N];
        let mut taken = zero;
        for axis in 0..N {
            slopes[axis] = match self {
                Self::Euclidean => s.select(s.less(zero, distance), ways[axis] / distance, zero),
                Self::Manhattan => sign(ways[axis]),
                Self::Chebyshev => {
                    // The greatest way is the distance, bit for bit.
                    let shorter = s.less(s.abs(ways[axis]), distance);
                    let slope =
                        s.select(s.less(zero, taken), zero, s.select(shorter, zero, sign(ways[axis])));
                    taken = s.select(shorter, taken, one);
                    slope
                }
            };
        }
        slopes
    }

    /// Greatest distance of a cell, in cells along one axis, for its feature point to be the nearest or the second nearest of a point.
    ///
    /// Let the point lie in its cell with m as the greatest of mᵢ = max(tᵢ, 1 − tᵢ). A feature point of its own cell is within
    /// |m|, one of the cell across the border next to it along the axis of m within |m| with 2 − m in the place of m. A cell k
    /// along an axis is k − mᵢ or more away. Both bounds exceed that for k = 2 in no metric on the line and for no k of 2 or
    /// more in the metric of Chebyshev, where the second is 2 − m; the Euclidean ones are √n and at most 2, those of Manhattan
    /// Σ mᵢ and Σ mᵢ + 2 − 2m, which k − mᵢ reaches from n + 1 on.
    #[inline(always)]
    pub(super) const fn reach(self, dimension: usize) -> usize {
        match self {
            Self::Euclidean if dimension > 1 => 2,
            Self::Euclidean | Self::Chebyshev => 1,
            Self::Manhattan => dimension,
        }
    }
}
