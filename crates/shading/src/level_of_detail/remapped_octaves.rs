//! Classic lattice noise as Gaussian coordinates, by its measured distribution.

use asperity_ndf_sampling::{Frame, NdfError, NoiseCdfRef, NoiseDistribution};
use asperity_noise::{Anchor, Fbm, FbmSpectrum, Field, Noise};
use glam::{Vec2, Vec3};

use crate::level_of_detail::gaussian_field::{GaussianField, ResolvedBumps};

/// The noise value, in standard deviations, at either end of the measured distributions.
const RANGE: f32 = 4.0;

/// Difference of the seed of the second channel: 2³²/φ, an unlikely increment of user seeds.
const SECOND: u32 = 0x9E37_79B9;

/// Two sums of octaves of a classic noise, made Gaussian by its measured distribution `G`.
///
/// ```text
/// z_k = Φ⁻¹(G(n_k / σ(octaves))),   k = 1, 2
/// ```
///
/// This is the method of Kautz, Heidrich, Seidel 2001, §4, for Perlin's turbulence, with constant
/// variance while octaves are added. `G` is measured for eight octaves. It is correct on average
/// over a surface and for several octaves, and approximate for one or two. The mean of the `Exact`
/// rule over a surface is off by up to 4 % with one octave of Perlin noise, and by about 1 % with
/// two (measured, Beckmann 0.3, at the peak). [`GaussianFbm`](asperity_noise::GaussianFbm)
/// has no such error, and its coordinates are the slopes of a relief.
///
/// The channels have separate seeds, offsets and rotations in every octave, so their lattices are
/// unrelated.
///
/// ```
/// use asperity_shading::Frame;
/// use asperity_shading::level_of_detail::{GaussianField, RemappedOctaves};
/// use asperity_shading::glam::Vec3;
/// use asperity_shading::noise::{Perlin, FbmSpectrum};
///
/// let field = RemappedOctaves::new(Perlin::default(), FbmSpectrum::default(), 3)?;
/// let coordinates = field.coordinates(Vec3::new(0.3, 1.7, -2.2), &Frame::IDENTITY, 4.0);
/// assert!(coordinates.z.is_finite() && coordinates.z.x != coordinates.z.y);
/// # Ok::<(), asperity_shading::ndf_sampling::NdfError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RemappedOctaves<K> {
    channels: [Fbm<K, Vec3>; 2],
    cdf: NoiseCdfRef<'static>,
}

impl<K: Noise + Field<Vec3> + Clone> RemappedOctaves<K> {
    /// Creates the pair of sums of octaves of `noise` selected by `seed`.
    ///
    /// # Errors
    /// [`NdfError`] if the measured distribution of the noise is invalid; those of
    /// `asperity-noise` are valid.
    pub fn new(noise: K, spectrum: FbmSpectrum, seed: u32) -> Result<Self, NdfError> {
        let cdf = NoiseCdfRef::new(RANGE, noise.statistics(3).cdf)?;
        let first = Fbm::new(noise.clone(), spectrum).with_seed(seed);
        let second = Fbm::new(noise, spectrum).with_seed(seed.wrapping_add(SECOND));
        Ok(Self { channels: [first, second], cdf })
    }
}

impl<K> RemappedOctaves<K> {
    /// The frequencies and amplitudes of the octaves.
    #[must_use]
    pub fn spectrum(&self) -> &FbmSpectrum {
        let [first, _] = &self.channels;
        first.spectrum()
    }
}

impl<K: Anchor<3>> RemappedOctaves<K> {
    /// The pair as seen from an anchor: its value at p is that of the original at anchor + p.
    ///
    /// Each octave is in its own cell there, see [`Fbm::anchored`].
    ///
    /// ```
    /// use asperity_shading::{Frame, glam::Vec3};
    /// use asperity_shading::level_of_detail::{GaussianField, RemappedOctaves};
    /// use asperity_shading::noise::{Simplex, FbmSpectrum};
    ///
    /// let field = RemappedOctaves::new(Simplex::new(0), FbmSpectrum::default(), 3)?;
    /// let [here, there] = [0.0, 1.0].map(|x| field.anchored([1e9 + x, -2e8, 0.5]));
    /// let p = Vec3::new(0.3, 0.7, -0.2);
    /// let [a, b] = [here.coordinates(p + Vec3::X, &Frame::IDENTITY, 4.0).z, there.coordinates(p, &Frame::IDENTITY, 4.0).z];
    /// assert!((a - b).length() < 1e-3);
    /// # Ok::<(), asperity_shading::ndf_sampling::NdfError>(())
    /// ```
    #[must_use]
    pub fn anchored(self, at: impl Into<[f64; 3]>) -> RemappedOctaves<K::Shifted> {
        let at = at.into();
        RemappedOctaves { channels: self.channels.map(|channel| channel.anchored(at)), cdf: self.cdf }
    }
}

impl<K: Field<Vec3>> GaussianField for RemappedOctaves<K> {
    fn coordinates(&self, p: Vec3, _: &Frame, octaves: f32) -> ResolvedBumps {
        let spectrum = self.spectrum();
        let fade = spectrum.weight(octaves, 0);
        if fade == 0.0 {
            return ResolvedBumps::FAR;
        }
        let [x, y] =
            self.channels.each_ref().map(|channel| self.cdf.invert(channel.value_with_octaves(p, octaves)));
        ResolvedBumps { z: Vec2::new(x, y), variance: spectrum.resolved_variance(octaves), blend: fade }
    }

    fn lacunarity(&self) -> f32 {
        self.spectrum().lacunarity()
    }

    fn max_octaves(&self) -> f32 {
        self.spectrum().max_octaves() as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;
    use asperity_noise::{GaussianFbm, GaussianNoise, Perlin, Simplex};

    #[test]
    fn coordinates_are_finite_for_every_input() {
        let perlin = RemappedOctaves::new(Perlin::default(), FbmSpectrum::default(), 1).unwrap();
        let gaussian = GaussianFbm::<Vec3>::new(GaussianNoise::new(1), FbmSpectrum::default());
        for field in [&perlin as &dyn GaussianField, &gaussian] {
            for octaves in [f32::NAN, f32::NEG_INFINITY, -1.0, 0.0, 1e-30, 0.5, 3.7, 1e9, f32::INFINITY] {
                for x in [0.0, 0.3, f32::NAN, f32::INFINITY, -1e30] {
                    let ResolvedBumps { z, variance: share, blend: fade } =
                        field.coordinates(Vec3::new(0.5, x, 2.0), &Frame::IDENTITY, octaves);
                    assert!(z.is_finite() && (0.0..1.0).contains(&share), "{x}, {octaves}: {z}, {share}");
                    assert!((0.0..=1.0).contains(&fade), "{x}, {octaves}: {fade}");
                    assert!(octaves > 0.0 || (z, share, fade) == (Vec2::ZERO, 0.0, 0.0), "{x}, {octaves}");
                }
            }
        }
    }

    #[test]
    fn octaves_add_up_and_a_single_octave_is_unchanged() {
        let field = RemappedOctaves::new(Perlin::default(), FbmSpectrum::default(), 1).unwrap();
        let at = |octaves| field.coordinates(Vec3::new(0.3, 1.7, -2.2), &Frame::IDENTITY, octaves);
        assert_eq!(at(0.25).z, at(1.0).z);
        assert_eq!((at(0.25).blend, at(1.0).blend), (0.25, 1.0));
        assert_ne!(at(1.5).z, at(1.0).z);
        assert_ne!(at(8.0).z, at(1.5).z);
    }

    #[test]
    fn anchored_pair_equals_the_pair_at_the_anchor() {
        let field = RemappedOctaves::new(Simplex::new(0), FbmSpectrum::default(), 3).unwrap();
        let (at, p) = (Vec3::new(17.0, -4.5, 0.25), Vec3::new(0.3, 0.7, -0.2));
        let there = field.anchored(at.to_array().map(f64::from)).coordinates(p, &Frame::IDENTITY, 4.0);
        let expected = field.coordinates(at + p, &Frame::IDENTITY, 4.0);
        // Positions of the fourth octave are rounded at 2.17³ · 17.
        assert_abs_diff_eq!(there.z, expected.z, epsilon = 1e-3);
        assert_eq!((there.variance, there.blend), (expected.variance, expected.blend));
    }

    #[test]
    fn channels_and_seeds_differ() {
        let p = Vec3::new(0.3, 1.7, -2.2);
        let at = |seed| {
            let field = RemappedOctaves::new(Simplex::new(0), FbmSpectrum::default(), seed).unwrap();
            field.coordinates(p, &Frame::IDENTITY, 3.0).z
        };
        let values = [at(0).x, at(0).y, at(1).x, at(1).y];
        for (i, a) in values.iter().enumerate() {
            assert!(!values[i + 1..].contains(a), "{values:?}");
        }
    }
}
