//! Metrics of cellular noise.

use crate::lanes::Lanes;

/// The metric of the distances of cellular noise.
///
/// ```text
/// Euclidean √(Σ dᵢ²),   Manhattan Σ |dᵢ|,   Chebyshev max |dᵢ|
/// ```
///
/// The squared Euclidean distance is not a metric. It has the same nearest points, so its F₁ is the
/// square of the Euclidean F₁.
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
    /// A measure with one more offset: Σ d² of the Euclidean metric, the distance itself of the
    /// others. No measure is −0.
    #[inline(always)]
    pub(super) fn joined<S: Lanes>(self, s: S, measure: S::F, offset: S::F) -> S::F {
        match self {
            Self::Euclidean => measure + offset * offset,
            Self::Manhattan => measure + s.abs(offset),
            Self::Chebyshev => s.max(measure, s.abs(offset)),
        }
    }

    /// The measure of the offsets along all axes but the first.
    #[inline(always)]
    pub(super) fn rest<S: Lanes, const N: usize>(self, s: S, offsets: [S::F; N]) -> S::F {
        let mut measure = s.float(0.0);
        for axis in 1..N {
            measure = self.joined(s, measure, offsets[axis]);
        }
        measure
    }

    /// The measure of offsets, with the first axis last because it changes along a row.
    #[inline(always)]
    pub(super) fn measure<S: Lanes, const N: usize>(self, s: S, offsets: [S::F; N]) -> S::F {
        self.joined(s, self.rest(s, offsets), offsets[0])
    }

    /// The distance of a measure.
    #[inline(always)]
    pub(super) fn distance<S: Lanes>(self, s: S, measure: S::F) -> S::F {
        match self {
            Self::Euclidean => s.sqrt(measure),
            Self::Manhattan | Self::Chebyshev => measure,
        }
    }

    /// The gradient of the distance along the offsets; 0 where the distance is 0.
    ///
    /// If axes tie for the largest offset, the first axis is used.
    #[inline(always)]
    pub(super) fn slopes<S: Lanes, const N: usize>(
        self,
        s: S,
        offsets: [S::F; N],
        distance: S::F,
    ) -> [S::F; N] {
        let (zero, one) = (s.float(0.0), s.float(1.0));
        let sign = |x| s.select(s.less(zero, x), one, s.select(s.less(x, zero), s.float(-1.0), zero));
        let mut slopes = [zero; N];
        let mut taken = zero;
        for axis in 0..N {
            slopes[axis] = match self {
                Self::Euclidean => s.select(s.less(zero, distance), offsets[axis] / distance, zero),
                Self::Manhattan => sign(offsets[axis]),
                Self::Chebyshev => {
                    // The largest offset is the distance, bit for bit.
                    let shorter = s.less(s.abs(offsets[axis]), distance);
                    let slope =
                        s.select(s.less(zero, taken), zero, s.select(shorter, zero, sign(offsets[axis])));
                    taken = s.select(shorter, taken, one);
                    slope
                }
            };
        }
        slopes
    }

    /// Maximum distance of a cell, in cells along one axis, for its feature point to be the nearest
    /// or the second nearest of a point.
    ///
    /// Let tᵢ be the position of the point in its cell, mᵢ = max(tᵢ, 1 − tᵢ), and m the maximum of
    /// the mᵢ. The feature point of this cell is within |m|, the length of the vector of the mᵢ.
    /// The next cell along the axis of m, across the closer border, has its feature point within
    /// the same length with 2 − m as that component. A cell k along axis i is at least k − mᵢ away.
    ///
    /// In 1-D neither bound exceeds that distance for k = 2. In the Chebyshev metric neither does
    /// for any k ≥ 2, where the second bound is 2 − m. The Euclidean bounds are √n and at most 2.
    /// The Manhattan bounds are Σ mᵢ and Σ mᵢ + 2 − 2m, which k − mᵢ reaches from n + 1 on.
    #[inline(always)]
    pub(super) const fn reach(self, dimension: usize) -> usize {
        match self {
            Self::Euclidean if dimension > 1 => 2,
            Self::Euclidean | Self::Chebyshev => 1,
            Self::Manhattan => dimension,
        }
    }
}
