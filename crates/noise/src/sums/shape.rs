//! What is made of an octave before it is summed.

use core::fmt::Debug;

use crate::{contract::kernel::LaneSample, simd::lanes::Lanes};

/// A function φ that every octave of a sum goes through: the noise itself, or one of the shapes with creases.
///
/// The shapes are [`Signed`], which is the noise itself, [`Turbulence`](crate::Turbulence), [`Plasma`](crate::Plasma),
/// [`Billow`](crate::Billow) and [`Ridged`](crate::Ridged). A shape has no size and costs what its arithmetic costs.
pub trait Shape: Copy + Debug + Default + PartialEq {
    /// φ(n).
    fn value<S: Lanes>(self, s: S, n: S::F) -> S::F;

    /// φ(n) and its gradient φ′(n) ∇n.
    fn sample<S: Lanes, const N: usize>(self, s: S, sample: LaneSample<S, N>) -> LaneSample<S, N>;

    /// Mean and standard deviation of φ(n), from those of n and from its absolute moments.
    ///
    /// `moments` are E|n|, E|n|², E|n|³ and E|n|⁴ as [`Kernel::absolute_moments`](crate::Kernel::absolute_moments) has them.
    fn mean_and_deviation(self, standard_deviation: f32, moments: [f32; 4]) -> [f32; 2];
}

/// φ(n) = n: fractional Brownian motion.
///
/// The cloud pattern of Nilsson 2008, section 4.1.5, is this with [`Spectrum::CLOUD`](crate::Spectrum::CLOUD).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Signed;

impl Shape for Signed {
    #[inline(always)]
    fn value<S: Lanes>(self, _: S, n: S::F) -> S::F {
        n
    }

    #[inline(always)]
    fn sample<S: Lanes, const N: usize>(self, _: S, sample: LaneSample<S, N>) -> LaneSample<S, N> {
        sample
    }

    fn mean_and_deviation(self, standard_deviation: f32, _: [f32; 4]) -> [f32; 2] {
        [0.0, standard_deviation]
    }
}
