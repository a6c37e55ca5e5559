//! Threads of a carpet: the texture of many, and single ones.

use asperity_noise::{
    Fbm, FbmSpectrum, Field, Noise, Normalization, Sample, Simplex, Turbulence, filtered_fraction,
};
use glam::Vec3;

use crate::error::ShadingError;
use crate::material::fbm::{SLOPE_VARIANCE, SizedFbm};
use crate::parameter::as_size;
use crate::pixel::Footprint;

/// The threads of a carpet: rough noise that is added to the diffuse color.
///
/// ```text
/// value = Σ N(2ⁱ p/size)/3,   i = 0, 1, 2
/// ```
///
/// Every octave is as strong as the first, so the surface is rough; more than three octaves would
/// average it smooth. Octaves that a pixel cannot resolve fade to 0, their mean. The corresponding
/// height is `size · value`. Its gradient, which does not depend on the size, is `gradient`.
///
/// - **Range:** [−1, 1].
///
/// Nilsson 2008, §4.2.2, *Diffuse map*.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct DiffuseThreads(SizedFbm);

impl DiffuseThreads {
    /// Creates threads of this size, in units of the positions.
    ///
    /// # Errors
    /// [`ShadingError::OutOfRange`] unless `diffuse_thread_size` is within `[10⁻⁶, 10⁶]`.
    pub(crate) fn new(size: f32, seed: u32) -> Result<Self, ShadingError> {
        Ok(Self(SizedFbm::new(FbmSpectrum::THREADS, as_size("diffuse_thread_size", size)?, seed)))
    }

    /// The noise.
    pub(crate) const fn noise(&self) -> &SizedFbm {
        &self.0
    }

    /// The value at a point, and its gradient by p/size; both 0 where a coordinate is not finite.
    pub(crate) fn sample(&self, position: Vec3, footprint: Footprint) -> Sample<Vec3> {
        self.0.sample(position, footprint)
    }

    /// The variance of each component of the gradient by p/size that the pixel does not resolve.
    pub(crate) fn removed_slope(&self, footprint: Footprint) -> f32 {
        self.0.removed_slope(footprint, SLOPE_VARIANCE)
    }
}

/// The single threads of a carpet, visible as highlights: plasma to the seventh power.
///
/// ```text
/// t = (1 − Σ |N(2ⁱ p/size)|/3)⁷,   i = 0, 1, 2
/// ```
///
/// - **Range:** [0, 1], mean 0.132.
///
/// # Level of detail
///
/// The mean of a power is not the power of a mean. Octaves that fade to their means *inside* the
/// power make a carpet too dark from afar, by nearly half. Here each unresolved octave is replaced
/// by the expectation of the whole over it:
///
/// ```text
/// t_j = E[t | the first j octaves] = Σ_k C(7, k) c^(7−k) (−1)ᵏ E[Uᵏ],   c = 1 − Σ_{i<j} |Nᵢ|/3,   U = Σ_{i≥j} |Nᵢ|/3
/// t   = t_0 + Σ_j (1 − k_j) (t_{j+1} − t_j),   k_j = smoothstep(0.2, 0.6, 2ʲ footprint/size)
/// ```
///
/// with the measured moments of |N|. The mean is the same at every distance, and the far view is
/// the mean of the near one.
///
/// Nilsson 2008, §4.2.2, *Specular map*.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SpecularThreads {
    veins: Fbm<Simplex, Vec3, Turbulence>,
    frequency: f32,
    /// C(7, k) (−1)ᵏ times the k-th moment of U, where the first 0, 1, 2, 3 octaves are known.
    coefficients: [[f32; 8]; 4],
}

/// E|N|⁵, E|N|⁶ and E|N|⁷ of continuous simplex noise in space: means over 1.6·10⁷ points, to 0.1
/// %.
const HIGHER_MOMENTS: [f32; 3] = [0.046_27, 0.035_68, 0.028_55];

impl SpecularThreads {
    /// Creates threads of this size, in units of the positions.
    ///
    /// # Errors
    /// [`ShadingError::OutOfRange`] unless `specular_thread_size` is within `[10⁻⁶, 10⁶]`.
    pub(crate) fn new(size: f32, seed: u32) -> Result<Self, ShadingError> {
        let size = as_size("specular_thread_size", size)?;
        let veins = Fbm::new(Simplex::new(seed), FbmSpectrum::THREADS)
            .with_normalization(Normalization::UnitRange)
            .with_shape(Turbulence);
        Ok(Self { veins, frequency: 1.0 / size, coefficients: coefficients() })
    }

    /// The turbulence, cells of its first octave per unit of length, and the coefficients of the
    /// mean.
    ///
    /// The coefficients are for 0 to 3 known octaves.
    pub(crate) const fn parts(&self) -> (&Fbm<Simplex, Vec3, Turbulence>, f32, &[[f32; 8]; 4]) {
        (&self.veins, self.frequency, &self.coefficients)
    }

    /// The mean over the surface, at every distance.
    #[cfg(test)]
    fn mean(&self) -> f32 {
        self.expectation(0, Vec3::ZERO)
    }

    /// The brightness at a point, in [0, 1] within 10⁻⁵.
    ///
    /// If a coordinate is not finite, the value where all noises are 0.
    pub(crate) fn value(&self, position: Vec3, footprint: Footprint) -> f32 {
        let p = position * self.frequency;
        let mut value = 0.0;
        let mut weight_before = 1.0;
        // Σ_j t_j (weight_j − weight_{j+1}): only levels with a weight are evaluated.
        for (j, frequency) in [1.0, 2.0, 4.0, f32::INFINITY].into_iter().enumerate() {
            let kept = if j < 3 {
                1.0 - filtered_fraction(footprint.width() * self.frequency, frequency)
            } else {
                0.0
            };
            let weight = weight_before - kept;
            if weight > 0.0 {
                value += weight * self.expectation(j, p);
            }
            weight_before = kept;
        }
        value
    }

    /// The expectation given the first `known` octaves at `p`.
    fn expectation(&self, known: usize, p: Vec3) -> f32 {
        let count = known as f32;
        let veins = if known == 3 { self.veins.value(p) } else { self.veins.value_with_octaves(p, count) };
        let c = 1.0 - veins * count / 3.0;
        self.coefficients.get(known).map_or(0.0, |row| row.iter().fold(0.0, |sum, k| sum * c + k))
    }
}

fn coefficients() -> [[f32; 8]; 4] {
    let [first, second, third, fourth] = Simplex::new(0).statistics(3).absolute_moments;
    let [fifth, sixth, seventh] = HIGHER_MOMENTS;
    let mut one = [1.0, first, second, third, fourth, fifth, sixth, seventh];
    let mut scale = 1.0;
    for moment in &mut one {
        *moment *= scale;
        scale /= 3.0;
    }
    // Exact, because every product of the first factors is a multiple of the next divisor.
    let choose = |n: usize, k: usize| (0..k).fold(1.0, |c, i| c * (n - i) as f32 / (i + 1) as f32);
    // The moments of no octave, and so on: E[(U + V)ⁿ] = Σ C(n, k) E[Uᵏ] E[Vⁿ⁻ᵏ].
    let mut moments = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let mut rows = [[0.0; 8]; 4];
    for row in rows.iter_mut().rev() {
        *row = core::array::from_fn(|k| if k % 2 == 0 { choose(7, k) } else { -choose(7, k) } * moments[k]);
        moments = core::array::from_fn(|n| {
            (0..=n).rev().fold(0.0, |sum, k| sum + choose(n, k) * moments[k] * one[n - k])
        });
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::fbm::mean_on_plane;
    use asperity_core::assert_abs_diff_eq;

    const P: Vec3 = Vec3::new(0.37, -1.21, 2.83);

    #[test]
    fn specular_threads_up_close_are_the_seventh_power() {
        let threads = SpecularThreads::new(0.5, 3).unwrap();
        for i in 0..100_u8 {
            let p = Vec3::new(f32::from(i) * 0.21, -1.3, 0.4);
            let plasma = 1.0 - threads.veins.value_with_octaves(p * 2.0, 3.0);
            let got = threads.value(p, Footprint::from_width(0.01));
            assert_abs_diff_eq!(got, plasma.powi(7), epsilon = 1e-6, "{p}");
        }
    }

    #[test]
    fn threads_have_their_pinned_values() {
        let (near, far) = (Footprint::from_width(1e-3), Footprint::from_width(1.0));
        let threads = DiffuseThreads::new(0.01, 1).unwrap();
        let sample = threads.sample(P, near);
        assert_abs_diff_eq!(sample.value, 0.014_884_244, epsilon = 1e-4 * 0.0148);
        let gradient = Vec3::new(-0.369_505, -0.281_605_57, -0.694_131_8);
        assert!((sample.gradient - gradient).abs().cmple(1e-4 * gradient.abs()).all(), "{sample:?}");
        assert_eq!(threads.sample(P, far).value, 0.0);
        let single = SpecularThreads::new(0.01, 1).unwrap();
        assert_abs_diff_eq!(single.value(P, near), 0.099_296_6, epsilon = 1e-4 * 0.0992);
        assert_abs_diff_eq!(single.mean(), 0.131_998_52, epsilon = 1e-4 * 0.1319);
        assert_eq!(single.value(P, far), single.mean());
    }

    #[test]
    fn single_threads_keep_their_mean_at_every_distance() {
        let threads = SpecularThreads::new(0.02, 7).unwrap();
        for width in [0.0, 0.0016, 0.002, 0.003, 0.005, 0.008, 0.011] {
            let [mean, error] = mean_on_plane(3, 60_000, |p| threads.value(p, Footprint::from_width(width)));
            // Five standard errors of a mean over independent points, plus the error of the
            // measured moments, 0.2 %.
            let tolerance = 5.0 * error + 0.002 * mean;
            assert_abs_diff_eq!(mean, f64::from(threads.mean()), epsilon = tolerance, "width {width}");
        }
        // The result of fading inside the power would be (1 − E|N|)⁷.
        let inside = (1.0 - 0.313_86_f64).powi(7);
        assert!(inside < 0.8 * f64::from(threads.mean()), "{inside}");
    }
}
