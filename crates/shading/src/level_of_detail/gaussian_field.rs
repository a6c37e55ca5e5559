//! Two Gaussian coordinates at every point of space, the basis of a bump map.

use asperity_noise::{Fbm, GaussianNoise, Lattice};
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
}

/// A pair of independent Gaussian noises over space, with a real number of octaves.
///
/// For every real `octaves > 0` both coordinates of `z` are standard Gaussian over the surface. A
/// field normalizes the resolved octaves, and returns their fraction of the whole variance.
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
    #[must_use]
    fn coordinates(&self, p: Vec3, octaves: f32) -> ResolvedBumps;

    /// The frequency ratio of consecutive octaves, more than 1.
    #[must_use]
    fn lacunarity(&self) -> f32;

    /// The maximum number of octaves of this field.
    #[must_use]
    fn max_octaves(&self) -> f32;
}

/// Exactly Gaussian at every point, so the mean of the `Exact` rule is exact.
///
/// ```
/// use asperity_shading::level_of_detail::{ResolvedBumps, GaussianField};
/// use asperity_shading::glam::Vec3;
/// use asperity_shading::noise::{GaussianNoise, GaussianFbm, FbmSpectrum};
///
/// let field = GaussianFbm::<Vec3>::new(GaussianNoise::new(7), FbmSpectrum::default());
/// let p = Vec3::new(0.3, 1.7, -2.2);
/// assert_eq!(field.coordinates(p, 0.0), ResolvedBumps::FAR);
/// assert_eq!(field.coordinates(p, 1.0).variance, 0.75);
/// assert_eq!(field.coordinates(p, 0.5).blend, 0.5);
/// ```
/// On any lattice, including an [anchored](Fbm::anchored) sum, with differences from its
/// anchor.
impl<L: Lattice> GaussianField for Fbm<GaussianNoise<L>, Vec3> {
    fn coordinates(&self, p: Vec3, octaves: f32) -> ResolvedBumps {
        let [x, y] = self.pair_with_octaves(p, octaves);
        ResolvedBumps {
            z: Vec2::new(x.value, y.value),
            variance: self.spectrum().resolved_variance(octaves),
            blend: self.spectrum().weight(octaves, 0),
        }
    }

    fn lacunarity(&self) -> f32 {
        self.spectrum().lacunarity()
    }

    fn max_octaves(&self) -> f32 {
        self.spectrum().max_octaves() as f32
    }
}

impl<F: GaussianField + ?Sized> GaussianField for &F {
    fn coordinates(&self, p: Vec3, octaves: f32) -> ResolvedBumps {
        (**self).coordinates(p, octaves)
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
            assert_eq!(field.coordinates(p, 3.5), same.coordinates(p, 3.5));
            // The sum has six octaves.
            assert_eq!(field.coordinates(p, 7.0), field.coordinates(p, 6.0));
            assert_ne!(field.coordinates(p, 6.0), field.coordinates(p, 5.5));
        }
        let spectrum = FbmSpectrum::new(2.5, 0.6, 6).unwrap();
        let gaussian = GaussianFbm::<Vec3>::new(GaussianNoise::new(1), spectrum);
        let remapped = RemappedOctaves::new(Simplex::new(0), spectrum, 3).unwrap();
        compared(gaussian, &gaussian as &dyn GaussianField);
        compared(remapped, &remapped as &dyn GaussianField);
    }
}
