//! A bump map in space: a Gaussian field, its scale, and the part that a pixel resolves.

use asperity_ndf_sampling::Frame;
use asperity_noise::{Fbm, GaussianNoise, Lattice, Sample};
use glam::Vec3;

use crate::error::ShadingError;
use crate::level_of_detail::gaussian_field::{GaussianField, ResolvedBumps};
use crate::math::sqrt;
use crate::pixel::{Footprint, FrequencyClamp};

/// A Gaussian field in space with a given size of bumps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BumpField<F> {
    field: F,
    clamp: FrequencyClamp,
}

impl<F: GaussianField> BumpField<F> {
    /// Creates the field whose first octave has `frequency` lattice cells per unit of length.
    ///
    /// Lacunarity and maximum octave count are those of the field.
    ///
    /// # Errors
    /// [`ShadingError`] unless `frequency` is finite and positive; also if the lacunarity or
    /// octave count of the field is invalid.
    pub fn new(field: F, frequency: f32) -> Result<Self, ShadingError> {
        let clamp = FrequencyClamp::new(frequency, field.lacunarity(), field.max_octaves())?;
        Ok(Self { field, clamp })
    }

    /// The field.
    #[must_use]
    pub const fn field(&self) -> &F {
        &self.field
    }

    /// Frequency clamp of the field: the number of octaves that a footprint resolves.
    #[must_use]
    pub const fn clamp(&self) -> &FrequencyClamp {
        &self.clamp
    }

    /// The coordinates of the bump map at the surface point `p`, as far as the footprint resolves
    /// them.
    ///
    /// `frame` is the frame of the surface in which the NDF is given, for instance
    /// [`SurfacePoint::frame`](crate::SurfacePoint::frame).
    ///
    /// Continuous in `p`, in the frame and in the footprint. [`ResolvedBumps::FAR`] as soon as the
    /// pixel is wider than half a cell of the first octave.
    ///
    /// For an [anchored](asperity_noise::Fbm::anchored) field `p` is the difference from the
    /// anchor, near which the field is exact at any zoom. The anchor is in cells of the first
    /// octave, i.e. the surface point times the frequency.
    ///
    /// These are as many octaves as do not alias. The mean over a pixel still contains a bit of the
    /// next octave. Half of the pixel width as footprint minimizes the error.
    #[must_use]
    pub fn coordinates(&self, p: Vec3, frame: &Frame, footprint: Footprint) -> ResolvedBumps {
        self.field.coordinates(p * self.clamp.frequency(), frame, self.clamp.octaves(footprint))
    }
}

impl<L: Lattice> BumpField<Fbm<GaussianNoise<L>, Vec3>> {
    /// The height of the bumps at `p`, for displacement and occlusion, with its gradient.
    ///
    /// ```text
    /// h = √s Σ wᵢ aᵢ nᵢ/fᵢ / √(κ Σ wᵢ² aᵢ²),   −Bᵀ∇h ≈ √s z
    /// ```
    ///
    /// It has the octaves and the fraction `s` of [`coordinates`](Self::coordinates), and is 0 where
    /// nothing is resolved. For an NDF with slopes of deviation σ the height is σ h, where σ is α/√2
    /// for Beckmann. The normals of the displaced surface are then those of [`LevelOfDetail::Exact`]
    /// up to the whitening of the slopes. Other NDFs bend the slopes: their surface has the same
    /// hills with other profiles.
    ///
    /// - **Unit:** length per unit of slope. The gradient has no unit.
    /// - **Accuracy:** the correlation of `−Bᵀ∇h` and `√s z` is 0.98 (measured, 1 to 5 octaves).
    /// - **Continuity:** C² in `p` and continuous in the footprint.
    ///
    /// [`LevelOfDetail::Exact`]: crate::LevelOfDetail::Exact
    ///
    /// ```
    /// use asperity_shading::bump::displace;
    /// use asperity_shading::noise::{FbmSpectrum, GaussianFbm, GaussianNoise};
    /// use asperity_shading::{Beckmann, BumpField, Footprint, glam::{Vec2, Vec3}};
    ///
    /// let bumps = BumpField::new(GaussianFbm::new(GaussianNoise::new(1), FbmSpectrum::default()), 20.0)?;
    /// let (p, pixel) = (Vec3::new(0.3, 0.1, 0.0), Footprint::from_width(1e-3));
    /// let sigma = Beckmann::isotropic(0.3)?.alpha_x() / 2.0_f32.sqrt();
    /// let height = bumps.height(p, pixel);
    /// let slope = sigma * Vec2::new(height.gradient.x, height.gradient.y);
    /// let raised = displace(p, Vec3::Z, [Vec3::X, Vec3::Y], [Vec3::ZERO; 2], sigma * height.value, slope);
    /// assert!((raised.position.z - sigma * height.value).abs() < 1e-6);
    /// assert!(raised.normal.x * height.gradient.x <= 0.0);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    #[must_use]
    #[doc(alias = "displacement")]
    pub fn height(&self, p: Vec3, footprint: Footprint) -> Sample<Vec3> {
        let (frequency, octaves) = (self.clamp.frequency(), self.clamp.octaves(footprint));
        let Sample { value, gradient } = self.field.height_with_octaves(p * frequency, octaves);
        let share = sqrt(self.field.spectrum().resolved_variance(octaves));
        Sample { value: share * value / frequency, gradient: share * gradient }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;
    use asperity_noise::{FbmSpectrum, GaussianFbm, GaussianNoise};

    #[test]
    fn bump_field_resolves_octaves_by_footprint() {
        let field = GaussianFbm::new(GaussianNoise::new(4), FbmSpectrum::new(3.0, 0.6, 5).unwrap());
        let bumps = BumpField::new(field, 8.0).unwrap();
        let p = Vec3::new(0.21, -1.3, 0.77);
        // Two octaves above 8 cells per unit: 8 · 3² = 72 at the Nyquist frequency.
        let pixel = Footprint::from_width(0.5 / 72.0);
        assert_abs_diff_eq!(bumps.clamp().octaves(pixel), 2.0, epsilon = 1e-6);
        let (frame, octaves) = (Frame::from_normal(p), bumps.clamp().octaves(pixel));
        assert_eq!(bumps.coordinates(p, &frame, pixel), field.coordinates(8.0 * p, &frame, octaves));
        assert_eq!(bumps.clamp().octaves(Footprint::from_width(0.0)), 5.0);
    }

    #[test]
    fn anchored_field_equals_the_field_at_the_anchor() {
        let field = GaussianFbm::new(GaussianNoise::new(4), FbmSpectrum::default());
        let anchor = Vec3::new(0.625, -1.5, 0.25);
        let bumps = BumpField::new(field, 4.0).unwrap();
        let near =
            BumpField::new(field.anchored(anchor.to_array().map(|x| 4.0 * f64::from(x))), 4.0).unwrap();
        let (p, pixel) = (Vec3::new(0.0625, 0.03125, -0.015625), Footprint::from_width(1e-3));
        let frame = Frame::from_normal(anchor);
        let [whole, part] =
            [bumps.coordinates(p + anchor, &frame, pixel), near.coordinates(p, &frame, pixel)];
        assert_abs_diff_eq!(whole.z, part.z, epsilon = 1e-4);
        assert_eq!((whole.variance, whole.blend), (part.variance, part.blend));
    }
}
