//! The measured statistics of a kind of noise in one dimension.

/// Standard deviation, excess kurtosis, range and distribution of a kind of noise, measured over points and seeds.
///
/// The distribution G is that of the sum of eight octaves with gain 0.5, divided by its standard deviation:
/// knot k of K stands at r = −4 + 8 k/(K − 1), and G(−r) = 1 − G(r).
///
/// ```
/// use asperity_noise::{Noise, Perlin2002, glam::Vec3};
///
/// let statistics = Noise::<Vec3>::statistics(&Perlin2002::default());
/// assert!(statistics.cdf.windows(2).all(|knots| knots[0] <= knots[1]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Statistics {
    /// σ₁, the standard deviation of one octave over all points and seeds.
    pub standard_deviation: f32,
    /// κ₁, the excess kurtosis of one octave over all points and seeds.
    pub excess_kurtosis: f32,
    /// The bound of |n|, proved or searched.
    pub range: f32,
    /// G at an odd number of knots over ±4 standard deviations.
    pub cdf: &'static [f32],
}
