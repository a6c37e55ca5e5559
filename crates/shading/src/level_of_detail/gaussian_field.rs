//! Two Gaussian coordinates at every point of a surface, the basis of a bump map.

use asperity_ndf_sampling::Frame;
use asperity_noise::{Fbm, FbmSpectrum, GaussianNoise, Lattice};
use glam::{Vec2, Vec3};

/// The resolved part of a bump map at a point, the input of both level-of-detail rules.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ResolvedBumps {
    /// The noise `z_b` of the resolved octaves: two independent N(0, 1) over the surface.
    pub z: Vec2,
    /// The fraction `s` of the variance in these octaves, in `[0, 1]`; 0 where nothing is resolved.
    pub variance: f32,
    /// The weight of the first octave in `[0, 1]`, with which the bump map fades in.
    pub blend: f32,
}

impl ResolvedBumps {
    /// ResolvedBumps of a pixel that resolves nothing.
    pub const FAR: Self = Self { z: Vec2::ZERO, variance: 0.0, blend: 0.0 };

    /// Whether the pixel resolves any part of the bumps.
    #[inline]
    pub(crate) fn are_resolved(self) -> bool {
        self.variance > 0.0
    }

    /// The coordinates `z` of the first octaves of a spectrum.
    fn of([x, y]: [f32; 2], spectrum: &FbmSpectrum, octaves: f32) -> Self {
        let (variance, blend) = (spectrum.resolved_variance(octaves), spectrum.weight(octaves, 0));
        Self { z: Vec2::new(x, y), variance, blend }
    }
}

/// Two independent Gaussian numbers at every point of a surface, with a real number of octaves.
///
/// For every real `octaves > 0` both coordinates of `z` are standard Gaussian over the surface. A
/// field normalizes the resolved octaves, and returns their fraction of the whole variance.
///
/// | field | `z` |
/// |---|---|
/// | [`GaussianFbm`](asperity_noise::GaussianFbm) | slopes of one noise: looks like a relief |
/// | [`IndependentChannels`] | values of two noises |
/// | [`RemappedOctaves`](crate::level_of_detail::RemappedOctaves) | values of two classic noises |
///
/// ```text
/// z = Σ wᵢ aᵢ zᵢ / √Σ wᵢ² aᵢ²,   share = Σ wᵢ² aᵢ² / Σ aᵢ²,   fade = w₀,   wᵢ = clamp(octaves − i, 0, 1)
/// ```
///
/// The last sum is over the infinite spectrum: octaves that the field does not have are never
/// resolved.
///
/// At `octaves ≤ 0` or NaN a field returns [`ResolvedBumps::FAR`]. Counts are clamped to
/// [`GaussianField::max_octaves`]. A NaN or infinite point returns some finite `z`.
pub trait GaussianField {
    /// The coordinates at `p`, in lattice cells of the first octave, of this number of octaves.
    ///
    /// `frame` is the orthonormal frame of the surface in which the NDF is given. Fields whose `z`
    /// is not a slope ignore it.
    #[must_use]
    fn coordinates(&self, p: Vec3, frame: &Frame, octaves: f32) -> ResolvedBumps;

    /// The frequency ratio of consecutive octaves, more than 1.
    #[must_use]
    fn lacunarity(&self) -> f32;

    /// The maximum number of octaves of this field.
    #[must_use]
    fn max_octaves(&self) -> f32;
}

/// The bumps of a relief: `z` is the downward slope of one noise along both tangents.
///
/// ```text
/// zᵢ = −(Bᵀ Cᵢ B)^(−1/2) Bᵀ ∇nᵢ,   Cᵢ = Cov(∇nᵢ),   B = (t, b)
/// ```
///
/// The sign makes the normal `T(z)` lean downhill, as the normal of the height `n` does.
///
/// Exactly Gaussian at every point, so the mean of the `Exact` rule is exact. See
/// [`Fbm::whitened_gradient`]. `z` is 0 in a frame with parallel or non-finite tangents.
///
/// On any lattice, including an [anchored](Fbm::anchored) sum, with differences from its
/// anchor.
///
/// ```
/// use asperity_shading::Frame;
/// use asperity_shading::level_of_detail::{ResolvedBumps, GaussianField};
/// use asperity_shading::glam::Vec3;
/// use asperity_shading::noise::{GaussianNoise, GaussianFbm, FbmSpectrum};
///
/// let field = GaussianFbm::<Vec3>::new(GaussianNoise::new(7), FbmSpectrum::default());
/// let (p, frame) = (Vec3::new(0.3, 1.7, -2.2), Frame::from_normal(Vec3::X));
/// assert_eq!(field.coordinates(p, &frame, 0.0), ResolvedBumps::FAR);
/// assert_eq!(field.coordinates(p, &frame, 1.0).variance, 0.75);
/// assert_eq!(field.coordinates(p, &frame, 0.5).blend, 0.5);
/// ```
impl<L: Lattice> GaussianField for Fbm<GaussianNoise<L>, Vec3> {
    fn coordinates(&self, p: Vec3, frame: &Frame, octaves: f32) -> ResolvedBumps {
        let z = self.whitened_gradient_with_octaves(p, [frame.tangent, frame.bitangent], octaves);
        ResolvedBumps::of(z.map(|z| -z), self.spectrum(), octaves)
    }

    fn lacunarity(&self) -> f32 {
        self.spectrum().lacunarity()
    }

    fn max_octaves(&self) -> f32 {
        self.spectrum().max_octaves() as f32
    }
}

/// Two independent channels of a noise as coordinates, in place of the slopes of one.
///
/// The distribution is that of the slopes. The bumps look like stains, not like a relief, and have
/// no height. Kautz, Heidrich, Seidel 2001, *Real-Time Bump Map Synthesis*, look up such channels in
/// table L.
///
/// ```
/// use asperity_shading::Frame;
/// use asperity_shading::level_of_detail::{GaussianField, IndependentChannels};
/// use asperity_shading::glam::Vec3;
/// use asperity_shading::noise::{GaussianNoise, GaussianFbm, FbmSpectrum};
///
/// let noise = GaussianFbm::<Vec3>::new(GaussianNoise::new(7), FbmSpectrum::default());
/// let seen = IndependentChannels(noise).coordinates(Vec3::ONE, &Frame::IDENTITY, 4.0);
/// assert_eq!(seen.z.to_array(), noise.pair_with_octaves(Vec3::ONE, 4.0).map(|channel| channel.value));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IndependentChannels<F>(pub F);

impl<L: Lattice> GaussianField for IndependentChannels<Fbm<GaussianNoise<L>, Vec3>> {
    fn coordinates(&self, p: Vec3, _: &Frame, octaves: f32) -> ResolvedBumps {
        let pair = self.0.pair_with_octaves(p, octaves);
        ResolvedBumps::of(pair.map(|channel| channel.value), self.0.spectrum(), octaves)
    }

    fn lacunarity(&self) -> f32 {
        self.0.lacunarity()
    }

    fn max_octaves(&self) -> f32 {
        self.0.max_octaves()
    }
}

impl<F: GaussianField + ?Sized> GaussianField for &F {
    fn coordinates(&self, p: Vec3, frame: &Frame, octaves: f32) -> ResolvedBumps {
        (**self).coordinates(p, frame, octaves)
    }

    fn lacunarity(&self) -> f32 {
        (**self).lacunarity()
    }

    fn max_octaves(&self) -> f32 {
        (**self).max_octaves()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::level_of_detail::RemappedOctaves;
    use asperity_noise::{FbmSpectrum, GaussianFbm, Simplex};

    #[test]
    fn octave_limits_and_references_of_fields() {
        fn compared(field: impl GaussianField, same: impl GaussianField) {
            let p = Vec3::new(0.3, 1.7, -2.2);
            assert_eq!((field.lacunarity(), field.max_octaves()), (2.5, 6.0));
            assert_eq!((same.lacunarity(), same.max_octaves()), (2.5, 6.0));
            let frame = Frame::from_normal(p);
            assert_eq!(field.coordinates(p, &frame, 3.5), same.coordinates(p, &frame, 3.5));
            // The sum has six octaves.
            assert_eq!(field.coordinates(p, &frame, 7.0), field.coordinates(p, &frame, 6.0));
            assert_ne!(field.coordinates(p, &frame, 6.0), field.coordinates(p, &frame, 5.5));
        }
        let spectrum = FbmSpectrum::new(2.5, 0.6, 6).unwrap();
        let gaussian = GaussianFbm::<Vec3>::new(GaussianNoise::new(1), spectrum);
        let remapped = RemappedOctaves::new(Simplex::new(0), spectrum, 3).unwrap();
        compared(gaussian, &gaussian as &dyn GaussianField);
        let channels = IndependentChannels(gaussian);
        compared(channels, &channels as &dyn GaussianField);
        compared(remapped, &remapped as &dyn GaussianField);
    }
}
