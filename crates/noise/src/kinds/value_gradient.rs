//! Value-gradient noise: a weighted sum of value noise and gradient noise on one lattice.

use asperity_core::math;

use crate::{
    contract::kernel::Measured,
    contract::noise::{kind, noise, tiles},
    error::NoiseError,
    kinds::cell::corner::{CellNoise, Corner},
    lanes::Lanes,
    lattice::integer_hash::{IntegerHash, further},
    lattice::lattice::Lattice,
    lattice::variates::{MARGIN, UNIT_SCALE, uniform, unit_direction},
    statistics::absolute_moments,
    statistics::statistics::Statistics,
    statistics::tables,
};

/// The weighted sum of value noise and gradient noise, neither flat nor 0 at lattice points; C².
///
#[cfg_attr(doc, doc = include_str!("../../docs/pictures/value_gradient.md"))]
///
/// ```text
/// n(p) = Σ_c W_c(p) ((1 − μ) v_c + μ (2/√n) g_c·(p − c)),   W = Π w or 1 − w,   w(t) = 6t⁵ − 15t⁴ + 10t³
/// ```
///
/// In 1 to 4 dimensions. v is uniform in (−1, 1). g is uniform on the circle or sphere, ±1 in 1-D,
/// and independent of v. μ is the weight of gradient noise. At μ = 0 this is
/// [`ValueNoise`](crate::ValueNoise) noise with other random numbers.
///
/// - **Range:** [−1, 1] for every μ, as either part attains 1 in cell centers. The value is clamped
///   to it, as for [`ValueNoise`](crate::ValueNoise).
/// - **Variance:** σ² = (1 − μ)² σ_v² + μ² σ_g² at every point, as v and g are independent.
///
/// Ebert (ed.) 1994, "Texturing and Modeling", `vgnoise`, with the weights of Perlin 2002. The
/// original is [`Vgnoise`](crate::ebert_1994::Vgnoise).
///
/// ```
/// use asperity_noise::{Field, ValueGradient, glam::Vec3};
///
/// let noise = ValueGradient::new(2).with_weight(0.6)?;
/// let sample = noise.sample(Vec3::new(4.0, -1.0, 7.0));
/// assert!(sample.value != 0.0 && sample.gradient != Vec3::ZERO);
/// assert!(ValueGradient::default().with_weight(1.5).is_err());
/// # Ok::<(), asperity_noise::NoiseError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ValueGradient<L = IntegerHash> {
    seed: u32,
    weight: f32,
    lattice: L,
}

kind!(ValueGradient { weight: 0.5 }, "of equal weights");
noise!(ValueGradient, curved);
tiles!(ValueGradient);

impl<L> ValueGradient<L> {
    /// Sets the weight of gradient noise; value noise has the weight 1 − `weight`.
    ///
    /// # Errors
    ///
    /// If the weight is not in [0, 1].
    pub fn with_weight(self, weight: f32) -> Result<Self, NoiseError> {
        if (0.0..=1.0).contains(&weight) {
            Ok(Self { weight, ..self })
        } else {
            Err(NoiseError::OutOfRange { parameter: "weight", value: weight, min: 0.0, max: 1.0 })
        }
    }

    /// Returns μ, the weight of gradient noise.
    #[must_use]
    pub const fn weight(&self) -> f32 {
        self.weight
    }
}

impl<L: Lattice, const N: usize> CellNoise<N> for ValueGradient<L> {
    type Standard = ValueGradient;

    #[inline(always)]
    fn standard(&self) -> ValueGradient {
        Self::standard(self)
    }

    const CLAMPED: bool = true;

    #[inline(always)]
    fn corner<S: Lanes>(&self, s: S, word: S::U) -> Corner<S, N> {
        Corner {
            value: uniform(s, further::<S, 6>(s, word)) * s.float(MARGIN * (1.0 - self.weight)),
            gradient: unit_direction(s, word, UNIT_SCALE[N - 1] * self.weight),
        }
    }
}

impl<L, const N: usize> Measured<N> for ValueGradient<L> {
    fn seed(&self) -> u32 {
        self.seed
    }

    /// The statistics at equal weights.
    fn statistics(&self) -> &'static Statistics {
        &tables::VALUE_GRADIENT[N - 1]
    }

    /// From σ_v and from σ at equal weights, σ_½² = (σ_v² + σ_g²)/4.
    fn standard_deviation(&self) -> f32 {
        let (v, half) = (&tables::VALUE[N - 1], &tables::VALUE_GRADIENT[N - 1]);
        let square = |statistics: &Statistics| statistics.standard_deviation * statistics.standard_deviation;
        let (value, gradient) = (square(v), 4.0 * square(half) - square(v));
        let (low, high) = (1.0 - self.weight, self.weight);
        math::sqrt(low * low * value + high * high * gradient)
    }

    /// σᵏ times E|n|ᵏ/σᵏ, which is measured at μ = 0, ¼, ½, ¾ and 1 and interpolated by the
    /// polynomial through all five.
    fn absolute_moments(&self) -> [f32; 4] {
        let mut ratios = [0.0; 3];
        for (i, table) in absolute_moments::VALUE_GRADIENT.iter().enumerate() {
            let basis = (0..absolute_moments::VALUE_GRADIENT.len())
                .filter(|&j| j != i)
                .fold(1.0, |product, j| product * (4.0 * self.weight - j as f32) / (i as f32 - j as f32));
            let [first, square, third, fourth] = table[N - 1];
            let root = math::sqrt(square);
            ratios[0] += basis * (first / root);
            ratios[1] += basis * (third / (square * root));
            ratios[2] += basis * (fourth / (square * square));
        }
        let sigma = Measured::<N>::standard_deviation(self);
        let square = sigma * sigma;
        [ratios[0] * sigma, square, ratios[1] * (square * sigma), ratios[2] * (square * square)]
    }
}
