//! Ridges that bear ridges: octaves weighted by the octave before.

use core::{error::Error, fmt};

use crate::{
    contract::field::Field,
    contract::kernel::{Kernel, LaneSample, samples, values},
    simd::lanes::Lanes,
    sums::octaves::{FirstOctaves, Normalisation, Octaves, scaled},
    sums::shape::Shape,
    sums::spectrum::Spectrum,
    sums::turbulence::Ridged,
};

/// A sum of ridged octaves in which an octave is strong only where the one before is.
///
#[cfg_attr(doc, doc = include_str!("../../docs/pictures/ridged_multifractal.md"))]
///
/// ```text
/// n(p) = Σ wᵢ aᵢ sᵢ / Σ wᵢ aᵢ,   sᵢ = vᵢ (1 − |nᵢ|)²,   v₀ = 1,   vᵢ₊₁ = min(1, feedback · sᵢ)
/// ```
///
/// Valleys stay smooth and ridges are rough. The gradient is that of the formula, through the weights too; where |nᵢ| is creased
/// sign(0) = 0, and where a weight is cut off at 1 its gradient is 0.
///
/// - **Range:** [0, 1] for kinds of range 1. The mean depends on the feedback and is not known.
///
/// Musgrave in Ebert (ed.) 1994, the ridged multifractal with the offset 1; divided by Σ wᵢ aᵢ here.
///
/// ```
/// use asperity_noise::{Field, Perlin2002, RidgedMultifractal, Spectrum, glam::Vec2};
///
/// let mountains = RidgedMultifractal::new(Perlin2002::default(), Spectrum::CLOUD, 2.0, 1)?;
/// let sample = mountains.first(7.5).sample(Vec2::new(0.3, 0.8));
/// assert!((0.0..=1.0).contains(&sample.value));
/// # Ok::<(), asperity_noise::FeedbackError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RidgedMultifractal<K, const N: usize> {
    octaves: Octaves<K, N, Ridged>,
    feedback: f32,
}

impl<K: Kernel<N>, const N: usize> RidgedMultifractal<K, N> {
    /// The sum of octaves of `noise` that `seed` selects, each randomly rotated.
    ///
    /// # Errors
    ///
    /// If `feedback` is not a finite number from 0 on.
    pub fn new(noise: K, spectrum: Spectrum, feedback: f32, seed: u32) -> Result<Self, FeedbackError> {
        if !(feedback >= 0.0 && feedback.is_finite()) {
            return Err(FeedbackError::FeedbackNegative(feedback));
        }
        let octaves = Octaves::new(noise, spectrum, Normalisation::Range, seed).with_shape(Ridged);
        Ok(Self { octaves, feedback })
    }

    /// The factor from an octave to the weight of the next.
    #[must_use]
    pub const fn feedback(&self) -> f32 {
        self.feedback
    }

    /// The sum of the first `octaves` octaves.
    #[must_use]
    #[inline]
    pub fn first(&self, octaves: f32) -> FirstRidges<'_, K, N> {
        FirstRidges { octaves: self.octaves.first(octaves), feedback: self.feedback }
    }
}

/// A ridged multifractal with its number of octaves, as [`RidgedMultifractal::first`] gives it.
#[derive(Clone, Copy, Debug)]
pub struct FirstRidges<'a, K, const N: usize> {
    octaves: FirstOctaves<'a, K, N, Ridged>,
    feedback: f32,
}

impl<K: Kernel<N>, const N: usize> Field<N> for FirstRidges<'_, K, N> {
    #[inline(always)]
    fn lane_values<S: Lanes>(&self, s: S, p: [S::F; N]) -> S::F {
        let one = s.float(1.0);
        let (mut sum, mut weight) = (s.float(0.0), one);
        for (amplitude, layer) in self.octaves.active() {
            let value = Ridged.value(s, values(self.octaves.noise(), s, layer.points(s, p), layer.seed));
            let ridge = weight * value;
            sum = sum + s.float(amplitude) * ridge;
            let next = s.float(self.feedback) * ridge;
            weight = s.select(s.less(next, one), next, one);
        }
        sum * s.float(self.octaves.factor())
    }

    #[inline(always)]
    fn lane_samples<S: Lanes>(&self, s: S, p: [S::F; N]) -> LaneSample<S, N> {
        let (zero, one, feedback) = (s.float(0.0), s.float(1.0), s.float(self.feedback));
        let (mut sum, mut weight) = ((zero, [zero; N]), (one, [zero; N]));
        for (amplitude, layer) in self.octaves.active() {
            let sample = samples(self.octaves.noise(), s, layer.points(s, p), layer.seed);
            let (value, slopes) = Ridged.sample(s, sample);
            let slopes = layer.pull_back(s, slopes);
            let ridge = weight.0 * value;
            sum.0 = sum.0 + s.float(amplitude) * ridge;
            let next = feedback * ridge;
            let below = s.less(next, one);
            for axis in 0..N {
                let slope = weight.0 * slopes[axis] + weight.1[axis] * value;
                sum.1[axis] = sum.1[axis] + s.float(amplitude) * slope;
                weight.1[axis] = s.select(below, feedback * slope, zero);
            }
            weight.0 = s.select(below, next, one);
        }
        let factor = s.float(self.octaves.factor());
        scaled(s, sum, factor)
    }
}

/// Why a [`RidgedMultifractal`] was refused.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum FeedbackError {
    /// The feedback is negative, infinite or not a number.
    FeedbackNegative(f32),
}

impl fmt::Display for FeedbackError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::FeedbackNegative(value) => write!(f, "feedback {value} is not a finite number from 0 on"),
        }
    }
}

impl Error for FeedbackError {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinds::perlin::Perlin2002;
    use glam::Vec3;

    #[test]
    fn only_finite_feedback_from_zero_on_is_taken() {
        let new = |feedback| {
            RidgedMultifractal::<_, 2>::new(Perlin2002::default(), Spectrum::default(), feedback, 1)
        };
        for feedback in [-1.0, f32::INFINITY] {
            assert_eq!(new(feedback), Err(FeedbackError::FeedbackNegative(feedback)));
        }
        assert!(new(f32::NAN).is_err() && new(0.0).is_ok());
    }

    #[test]
    fn one_octave_is_one_ridged_octave() {
        let ridges = RidgedMultifractal::new(Perlin2002::default(), Spectrum::default(), 1.0, 1).unwrap();
        let octaves = Octaves::new(Perlin2002::default(), Spectrum::default(), Normalisation::Range, 1);
        let octaves = octaves.with_shape(Ridged);
        let p = Vec3::new(0.2, 7.1, -3.4);
        assert_eq!(ridges.first(1.0).sample(p), octaves.sample(p, 1.0));
        assert_ne!(ridges.first(2.0).sample(p), octaves.sample(p, 2.0));
        assert_eq!(ridges.first(5.0).value(p), ridges.first(5.0).sample(p).value);
    }

    #[test]
    fn without_feedback_only_the_first_octave_counts() {
        let ridges = RidgedMultifractal::new(Perlin2002::default(), Spectrum::default(), 0.0, 1).unwrap();
        let p = Vec3::new(0.2, 7.1, -3.4);
        let [one, three] = [1.0, 3.0].map(|octaves| ridges.first(octaves).value(p));
        assert!((three * 1.75 - one).abs() < 1e-6);
    }
}
