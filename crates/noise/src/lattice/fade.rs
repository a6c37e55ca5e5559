//! The weights by which a noise blends the ends of a cell, and their derivatives.

use crate::lanes::{Lanes, Scalar};

/// A weight w(t) that rises from 0 to 1 over a cell, with w′ and w″.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fade {
    /// w = 3t² − 2t³, C¹ across cells.
    Cubic,
    /// w = 6t⁵ − 15t⁴ + 10t³, C² across cells.
    Quintic,
}

impl Fade {
    /// w(t).
    #[inline(always)]
    pub(crate) fn weight<S: Lanes>(self, s: S, t: S::F) -> S::F {
        match self {
            Self::Cubic => t * t * (s.float(3.0) - s.float(2.0) * t),
            Self::Quintic => t * t * t * (t * (t * s.float(6.0) - s.float(15.0)) + s.float(10.0)),
        }
    }

    /// w′(t).
    #[inline(always)]
    pub(crate) fn slope<S: Lanes>(self, s: S, t: S::F) -> S::F {
        match self {
            Self::Cubic => s.float(6.0) * t * (s.float(1.0) - t),
            Self::Quintic => {
                let rest = t - s.float(1.0);
                s.float(30.0) * (t * t) * (rest * rest)
            }
        }
    }

    /// w″(t).
    #[inline(always)]
    pub(crate) fn curvature<S: Lanes>(self, s: S, t: S::F) -> S::F {
        match self {
            Self::Cubic => s.float(6.0) - s.float(12.0) * t,
            Self::Quintic => s.float(60.0) * t * (s.float(1.0) - t) * (s.float(1.0) - s.float(2.0) * t),
        }
    }
}

/// A position along an axis of the cell: t, w(t) and w′(t).
#[derive(Clone, Copy)]
pub(crate) struct Along<S: Lanes> {
    pub(crate) position: S::F,
    pub(crate) weight: S::F,
    pub(crate) slope: S::F,
}

impl<S: Lanes> Along<S> {
    #[inline(always)]
    pub(crate) fn new(s: S, fade: Fade, t: S::F) -> Self {
        Self { position: t, weight: fade.weight(s, t), slope: fade.slope(s, t) }
    }

    /// The position in one lane.
    #[inline(always)]
    pub(crate) fn lane(&self, s: S, lane: usize) -> Along<Scalar> {
        Along {
            position: s.lane(self.position, lane),
            weight: s.lane(self.weight, lane),
            slope: s.lane(self.slope, lane),
        }
    }
}

impl Along<Scalar> {
    /// This position along an axis in every lane.
    #[inline(always)]
    pub(crate) fn splat<S: Lanes>(&self, s: S) -> Along<S> {
        Along { position: s.float(self.position), weight: s.float(self.weight), slope: s.float(self.slope) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::abs_diff_eq;

    #[test]
    fn fade_derivatives_match_differences() {
        let h = 1.0 / 256.0;
        for fade in [Fade::Cubic, Fade::Quintic] {
            let [w, dw] = [Fade::weight, Fade::slope].map(|f| move |t: f32| f(fade, Scalar, t));
            assert_eq!([w(0.0), w(0.5), w(1.0), dw(0.0), dw(1.0)], [0.0, 0.5, 1.0, 0.0, 0.0]);
            for i in 1..16_u8 {
                let t = f32::from(i) / 16.0;
                // The error of a central difference is h² max |w‴|/6 ≤ 10 h² plus rounding.
                let slope = (w(t + h) - w(t - h)) / (2.0 * h);
                assert!(abs_diff_eq!(dw(t), slope, epsilon = 2e-4), "{fade:?} at {t}: {slope}");
                let curvature = (dw(t + h) - dw(t - h)) / (2.0 * h);
                assert!(
                    abs_diff_eq!(fade.curvature(Scalar, t), curvature, epsilon = 2e-3),
                    "{fade:?} at {t}: {curvature}"
                );
            }
        }
    }

    #[test]
    fn quintic_weight_errs_as_documented() {
        let (mut error, mut beyond) = (0.0_f64, 0.0_f64);
        // Every float from 1/2 on. The largest errors are next to 1.
        for bits in 0.5_f32.to_bits()..1.0_f32.to_bits() {
            let t = f32::from_bits(bits);
            let (weight, x) = (f64::from(Fade::Quintic.weight(Scalar, t)), f64::from(t));
            error = error.max((weight - x * x * x * (x * (x * 6.0 - 15.0) + 10.0)).abs());
            beyond = beyond.max(weight - 1.0);
        }
        // The largest errors are 1.154e-6 and 9 units of 2⁻²³.
        assert!(error < 1.2e-6 && (1.0e-6..1.1e-6).contains(&beyond), "{error:e} {beyond:e}");
    }
}
