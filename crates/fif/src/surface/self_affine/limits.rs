//! Global bounds of a self-affine surface and of its evaluation errors, in units of the domain.

use asperity_core::Interval;

use crate::numeric::polynomial::UNIT;
use crate::system::error::FifError;

/// Constants of bounds, rounded up.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// The maximum stretch of the fold: `‖M‖₂`, or `1/a` for the relative width `a` of the smallest
    /// cell.
    pub(crate) stretch: f64,
    /// `|s|` times that.
    pub(crate) contraction: f64,
    /// `1/(1 − |s|)` and the reciprocal of 1 less the contraction.
    pub(crate) gain: [f64; 2],
    /// Error of the value and gradient of one patch.
    pub(crate) noise: [f64; 2],
    /// The maximum value and slope of the patches.
    pub(crate) patch: [f64; 2],
    /// A Lipschitz constant of the slopes of the patches.
    pub(crate) bend: f64,
    /// The computed orbit of a point stays this close to the orbit of a point this close; 0 where
    /// orbits are exact.
    pub(crate) shift: f64,
    /// Encloses `f`.
    pub(crate) range: Interval,
    /// Enclose the slopes of `f`.
    pub(crate) slopes: [Interval; 2],
    /// Encloses the repeated part `w`, and its slopes.
    pub(crate) own: Interval,
    pub(crate) own_slopes: [Interval; 2],
    /// The maximum of `|∇f|`, or the maximum slope along either axis.
    pub(crate) steepest: f64,
}

impl Limits {
    pub(crate) const EMPTY: Self = Self {
        stretch: 0.0,
        contraction: 0.0,
        gain: [0.0; 2],
        noise: [0.0; 2],
        patch: [0.0; 2],
        bend: 0.0,
        shift: 0.0,
        range: Interval::EMPTY,
        slopes: [Interval::EMPTY; 2],
        own: Interval::EMPTY,
        own_slopes: [Interval::EMPTY; 2],
        steepest: 0.0,
    };

    /// Returns the limits unless numbers of these magnitudes overflow or underflow `f64`.
    pub(crate) fn checked(self, magnitudes: [f64; 3]) -> Result<Self, FifError> {
        let ranges = [self.range, self.slopes[0], self.slopes[1]];
        let finite = ranges.iter().all(|range| range.magnitude().is_finite())
            && self.noise.iter().all(|noise| noise.is_finite())
            && (self.bend + self.steepest).is_finite();
        let magnitude = magnitudes.into_iter().fold(0.0, f64::max);
        if finite { Ok(self) } else { Err(FifError::TooLarge { magnitude }) }
    }

    /// `contractionᵏ`, rounded up; constant from 64 steps on.
    pub(crate) fn contraction_of(&self, steps: u32) -> f64 {
        (0..steps.min(64)).fold(1.0, |power, _| power * self.contraction * (1.0 + 2.0 * UNIT))
    }

    /// A bound of the change of slopes over a distance: `Σ_k min(L stretchᵏ distance, 2 sup|∇|)
    /// contractionᵏ`.
    pub(crate) fn modulus(&self, distance: f64) -> f64 {
        const MOST_STEPS: u32 = 1 << 16;
        let (mut sum, mut weight, mut change) = (0.0, 1.0, self.bend * distance);
        let most = 2.0 * self.patch[1];
        for _ in 0..MOST_STEPS {
            if change.is_nan() || change >= most || weight * most < f64::MIN_POSITIVE {
                break;
            }
            sum += weight * change;
            weight *= self.contraction;
            change *= self.stretch;
        }
        1.01 * (sum + weight * most * self.gain[1])
    }

    /// A tolerance that omits the repetitions whose cells are smaller than `distance`.
    ///
    /// It is computed from the finest cell and the maximum slope.
    pub(crate) fn left_out(&self, distance: f64, cell: f64, steepest: f64) -> f64 {
        const STEPS: u32 = 1 << 10;
        if distance.is_nan() || distance <= 0.0 {
            return 0.0;
        }
        let (mut cell, mut tolerance) = (cell, 2.0 * steepest);
        for _ in 0..STEPS {
            if cell < distance {
                break;
            }
            (cell, tolerance) = (cell / self.stretch, tolerance * self.contraction);
        }
        tolerance
    }
}
