//! What every noise of this crate offers.

use crate::{sample::Sample, statistics::Statistics};

/// A random field over points `V`, one of many that a seed selects.
///
/// Evaluation is total. A point with an infinite or NaN coordinate gives value 0 and gradient 0. From |x| = 2²³ on
/// `f32` holds integers only, so the noise is seen at its lattice points; cells wrap modulo 2³², and beyond |x| = 2⁶³
/// every coordinate falls in one cell per sign. [`Simplex`](crate::Simplex) has a skewed lattice and is 0 from 2³¹ on.
///
/// ```
/// use asperity_noise::{Noise, Perlin2002, glam::Vec3};
///
/// let noise = Perlin2002::default();
/// let sample = noise.sample(Vec3::new(0.3, -4.2, 7.9), 1);
/// assert!(sample.value.abs() <= 1.0);
/// assert_eq!(noise.sample(Vec3::new(f32::NAN, 0.0, 0.0), 1).value, 0.0);
/// ```
pub trait Noise<V> {
    /// Value and gradient at `p`.
    #[must_use]
    fn sample(&self, p: V, seed: u32) -> Sample<V>;

    /// The value alone, the same bits as [`sample`](Self::sample)'s.
    #[must_use]
    fn value(&self, p: V, seed: u32) -> f32 {
        self.sample(p, seed).value
    }

    /// The measured statistics of the kind in this dimension.
    #[must_use]
    fn statistics(&self) -> &'static Statistics;
}
