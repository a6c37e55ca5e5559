//! Absorption of light by a medium.

use glam::Vec3;

use crate::error::ShadingError;
use crate::math::{clamp_to, exp, log2, pow, sqrt};
use crate::parameter::{color, not_negative, positive};

/// Absorption coefficient `σ_a` of a medium, with the Beer–Lambert law.
///
/// ```text
/// T(d) = e^(−σ_a d)
/// ```
///
/// - **Unit:** per unit of length, linear RGB.
/// - **Accuracy:** 2·10⁻⁷ (1 + σ_a d) relative.
///
/// ```
/// use asperity_shading::{glam::Vec3, reflectance::Absorption};
///
/// // Bottle glass with this transmittance over 2 units has its square over 4.
/// let color = Vec3::new(0.4, 0.8, 0.5);
/// let glass = Absorption::of_color(color, 2.0)?;
/// assert!((glass.transmittance(2.0) - color).length() < 1e-6);
/// assert!((glass.transmittance(4.0) - color * color).length() < 1e-6);
/// # Ok::<(), asperity_shading::ShadingError>(())
/// ```
///
/// Beer 1852, *Bestimmung der Absorption des rothen Lichts in farbigen Flüssigkeiten*; Pharr,
/// Jakob, Humphreys 2023, *Physically Based Rendering*, §11.2.1.
#[doc(alias = "beer-lambert")]
#[doc(alias = "extinction")]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Absorption {
    coefficient: Vec3,
}

/// The smallest transmittance that [`Absorption::of_color`] distinguishes from black, whose
/// logarithm is infinite.
const BLACK: f32 = 1e-6;

impl Absorption {
    /// A medium that absorbs nothing.
    pub const NONE: Self = Self { coefficient: Vec3::ZERO };

    /// Creates the medium with this coefficient.
    ///
    /// # Errors
    /// [`ShadingError::OutOfRange`] unless every component is finite and at least 0.
    pub fn new(coefficient: Vec3) -> Result<Self, ShadingError> {
        coefficient.to_array().into_iter().try_for_each(|c| not_negative("coefficient", c).map(|_| ()))?;
        Ok(Self { coefficient })
    }

    /// Creates the medium with this transmittance over this distance; clamped to at least 10⁻⁶.
    ///
    /// # Errors
    /// [`ShadingError`] unless every component is within `[0, 1]` and the distance finite and
    /// positive.
    pub fn of_color(transmittance: Vec3, distance: f32) -> Result<Self, ShadingError> {
        let (share, distance) = (color("transmittance", transmittance)?, positive("distance", distance)?);
        let depth = share.max(Vec3::splat(BLACK)).map(log2) * -core::f32::consts::LN_2;
        Ok(Self { coefficient: (depth / distance).clamp(Vec3::ZERO, Vec3::MAX) })
    }

    /// `σ_a`, per unit of length.
    #[must_use]
    pub const fn coefficient(&self) -> Vec3 {
        self.coefficient
    }

    /// The transmittance over this distance, in `[0, 1]³`; 1 if the distance is not positive.
    #[must_use]
    pub fn transmittance(&self, distance: f32) -> Vec3 {
        let distance = clamp_to(distance, f32::MAX);
        self.coefficient.map(|c| exp(-(c * distance)))
    }
}

/// The transmittance of a wall at an angle, given its transmittance `tint` at normal incidence.
///
/// The path is longer by the cosine of the refracted angle.
///
/// ```text
/// tint^(1/cos θ_t),   sin θ_t = sin θ/η
/// ```
pub(super) fn through_wall(tint: Vec3, cosine: f32, relative_index: f32) -> Vec3 {
    let cosine = clamp_to(cosine, 1.0);
    let sine2 = (1.0 - cosine * cosine) / (relative_index * relative_index);
    let longer = 1.0 / sqrt((1.0 - sine2).max(1e-6));
    tint.map(|share| clamp_to(pow(clamp_to(share, 1.0), longer), 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn transmittances_of_consecutive_paths_multiply() {
        let medium = Absorption::new(Vec3::new(0.3, 0.0, 20.0)).unwrap();
        for (a, b) in [(0.1, 0.4), (1.5, 3.0), (0.0, 2.0)] {
            let both = medium.transmittance(a) * medium.transmittance(b);
            assert_abs_diff_eq!(medium.transmittance(a + b), both, epsilon = 1e-6, "{a}, {b}");
        }
    }

    #[test]
    fn transmittance_accepts_every_length() {
        let black = Absorption::of_color(Vec3::ZERO, 1e-30).unwrap();
        let most = Absorption::new(Vec3::MAX).unwrap();
        for medium in [black, most, Absorption::NONE] {
            for length in [f32::NAN, f32::NEG_INFINITY, -1.0, 0.0, 1e-30, 1.0, f32::MAX, f32::INFINITY] {
                let share = medium.transmittance(length);
                assert!(share.min_element() >= 0.0 && share.max_element() <= 1.0, "{medium:?}, {length}");
                assert!(length > 0.0 || share == Vec3::ONE, "{medium:?}, {length}");
            }
        }
        assert_eq!(Absorption::NONE.transmittance(f32::INFINITY), Vec3::ONE);
        for bad in [-1.0, f32::NAN, f32::INFINITY] {
            assert!(
                Absorption::new(Vec3::splat(bad)).is_err() && Absorption::of_color(Vec3::ONE, bad).is_err()
            );
        }
    }

    #[test]
    fn wall_paths_are_longest_at_the_horizon() {
        let tint = Vec3::new(0.25, 0.5, 1.0);
        assert_eq!(through_wall(tint, 1.0, 1.5), tint);
        // sin θ_t = 2/3, cos θ_t = √5/3.
        let horizon = Vec3::new(0.25, 0.5, 1.0).map(|c: f32| c.powf(3.0 / 5.0_f32.sqrt()));
        assert_abs_diff_eq!(through_wall(tint, 0.0, 1.5), horizon, epsilon = 1e-6);
        for bad in [f32::NAN, -1.0, 0.0, f32::INFINITY] {
            let share = through_wall(tint, bad, 0.1);
            assert!(share.min_element() >= 0.0 && share.max_element() <= 1.0, "{bad}");
        }
    }
}
