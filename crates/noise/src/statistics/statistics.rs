//! The measured statistics of a kind of noise in one dimension.

/// Standard deviation, excess kurtosis, range and distribution of a kind of noise, measured over
/// points and seeds.
///
/// The distribution G is the distribution of the sum of eight octaves with gain 0.5, divided by its
/// standard deviation. Knot k of K is at r = −4 + 8 k/(K − 1). G(−r) = 1 − G(r), except for
/// [`Cellular`](crate::Cellular) noise, whose mean is subtracted first.
///
/// ```
/// use asperity_noise::{Noise, Perlin};
///
/// let statistics = Perlin::default().statistics(3);
/// assert!(statistics.cdf.windows(2).all(|knots| knots[0] <= knots[1]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Statistics {
    /// σ₁, the standard deviation of one octave over all points and seeds.
    pub standard_deviation: f32,
    /// κ₁, the excess kurtosis of one octave over all points and seeds.
    pub excess_kurtosis: f32,
    /// E|n|, E|n|², E|n|³ and E|n|⁴ of one octave over all points and seeds.
    pub absolute_moments: [f32; 4],
    /// The bound of |n|, proved or searched.
    pub range: f32,
    /// G at an odd number of knots over ±4 standard deviations.
    pub cdf: &'static [f32],
}

impl Statistics {
    /// The statistics of a field that is not a kind.
    pub(crate) const UNKNOWN: Self = Self {
        standard_deviation: f32::NAN,
        excess_kurtosis: f32::NAN,
        absolute_moments: [f32::NAN; 4],
        range: f32::INFINITY,
        cdf: &[],
    };
}

/// Mean, standard deviation and absolute moments of the values of a field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moments {
    /// E n.
    pub mean: f32,
    /// σ₁.
    pub standard_deviation: f32,
    /// E|n|, E|n|², E|n|³ and E|n|⁴, from which the mean of a [`Shape`](crate::Shape) follows.
    pub absolute: [f32; 4],
}

/// The distribution at all knots, from the distribution at knots below 0.
pub(crate) const fn mirrored(low: [f32; 128]) -> [f32; 257] {
    let mut cdf = [0.5; 257];
    let mut k = 0;
    while k < 128 {
        cdf[k] = low[k];
        cdf[256 - k] = 1.0 - low[k];
        k += 1;
    }
    cdf
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mirrored_cdf_is_odd_about_one_half() {
        let low = core::array::from_fn(|k| (k * k) as f32 / 65_536.0);
        let cdf = mirrored(low);
        assert_eq!((&cdf[..128], cdf[128]), (&low[..], 0.5));
        for (below, above) in cdf.iter().zip(cdf.iter().rev()) {
            assert_eq!(below + above, 1.0);
        }
    }
}
