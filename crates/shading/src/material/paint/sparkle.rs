//! Sparkling flakes of constant width on the screen.

use asperity_noise::filtered_fraction;
use glam::Vec3;

use crate::error::ShadingError;
use crate::material::paint::flake_patch::covered_flake;
use crate::math::clamp_to;
use crate::parameter::{as_share, as_size, within};
use crate::pixel::Footprint;

/// Fraction of omitted flakes, by distance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum Elimination {
    /// The same fraction at every distance.
    #[default]
    Fixed,
    /// A smaller fraction from afar, where sparkles become a dense cover of flakes: *smart flake
    /// sparkle*.
    ///
    /// ```text
    /// share · (1 − smoothstep(0.2, 0.6, footprint · pixel size/unit))
    /// ```
    ///
    /// The thesis has a unit of 1, which depends on the scale of the model.
    Adaptive {
        /// The width of a sparkle, in units of the positions, from which on none is omitted; within
        /// `[10⁻⁶, 10⁶]`.
        unit: f32,
    },
}

/// Sparkling flakes: patches of a fixed width in pixels that tilt the normal.
///
/// ```text
/// width  = min(pixel size · footprint, physical size),   one flake to a cell of the physical size
/// n′     = normalize(n + fade · variation · tilt),   fade = 1 − smoothstep(0.2, 0.6, pixel size · footprint/physical size)
/// weight = cover · fade,   cover the fraction of the pixel under the flake
/// ```
///
/// Up close, flakes are few pixels wide and far apart. From farther away they become dense, and
/// fade where they would overlap. A flake is omitted if the random number of its *center* is below
/// the elimination; by its normal, whole directions would have no flakes.
///
/// # Level of detail
///
/// The weight is continuous in the position and in the footprint. Its mean over the cell of the
/// flake is `fade · (width/physical size)²`, so a material can remove from the cell the light that
/// the flake adds: see [`MetallicPaint`](crate::MetallicPaint).
///
/// - **Deviations:** flakes are scattered in their cells, see [`covered_flake`], and have soft
///   edges, one footprint wide; in the thesis they pop where their edge meets a point. Flakes that
///   [`Elimination::Adaptive`] restores fade in together; in the thesis they appear one by one. The
///   footprint has one width; the thesis uses one along each axis of space. Along the axis next to
///   the normal a flake is as wide as its cell, so flakes cover `(width/physical size)²` of the
///   area of any surface. In the thesis most surfaces pass between the cubes, increasingly so as
///   the cubes become smaller.
///
/// Nilsson 2008, §4.3.4. For counted flakes see [`GlintField`](crate::material::GlintField).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sparkles {
    pixel_size: f32,
    physical_size: f32,
    variation: f32,
    elimination: f32,
    rule: Elimination,
    seed: u32,
}

/// A sparkling flake at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sparkle {
    /// The vector that is added to the unit normal.
    tilt: Vec3,
    /// The fraction of the tilt that remains at this distance, in (0, 1]; included in `tilt`.
    pub(crate) fade: f32,
    /// The weight of the flake at the point, in [0, 1]: its cover of the pixel, times `fade`.
    pub(crate) weight: f32,
    /// The mean of the weight over the cell of the flake.
    pub(crate) mean_weight: f32,
}

impl Sparkle {
    /// The normal of the flake on a surface of unit normal `n`.
    pub(crate) fn normal(&self, n: Vec3) -> Vec3 {
        let normal = (n + self.tilt).normalize_or_zero();
        if normal == Vec3::ZERO { n } else { normal }
    }
}

impl Sparkles {
    /// Creates flakes of `pixel_size` pixels, in cells of `physical_size`, tilted by up to
    /// `variation`.
    ///
    /// # Errors
    /// [`ShadingError::OutOfRange`] unless `flake_sparkle_pixel_size` is within `[0, 1000]`,
    /// `flake_sparkle_physical_size` and the unit of [`Elimination::Adaptive`],
    /// `smart_flake_sparkle`, within `[10⁻⁶, 10⁶]`, and `flake_sparkle_variation` and
    /// `flake_sparkle_elimination` within `[0, 1]`.
    pub(crate) fn new(
        pixel_size: f32,
        physical_size: f32,
        variation: f32,
        elimination: f32,
        rule: Elimination,
        seed: u32,
    ) -> Result<Self, ShadingError> {
        if let Elimination::Adaptive { unit } = rule {
            as_size("smart_flake_sparkle", unit)?;
        }
        Ok(Self {
            pixel_size: within("flake_sparkle_pixel_size", pixel_size, [0.0, 1000.0])?,
            physical_size: as_size("flake_sparkle_physical_size", physical_size)?,
            variation: as_share("flake_sparkle_variation", variation)?,
            elimination: as_share("flake_sparkle_elimination", elimination)?,
            rule,
            seed,
        })
    }

    /// The seed of the lattice.
    pub(crate) const fn seed(&self) -> u32 {
        self.seed
    }

    /// The flake of the cell of a point on a surface of normal `n`, with its weight there.
    ///
    /// `None` where the footprint has no flakes, where the flake of the cell is omitted, and where
    /// a coordinate is not finite. The weight is 0 between flakes.
    pub(crate) fn flake(&self, position: Vec3, n: Vec3, footprint: Footprint) -> Option<Sparkle> {
        let pixel = footprint.width();
        let width = pixel * self.pixel_size;
        let fade = 1.0 - filtered_fraction(width, 1.0 / self.physical_size);
        if fade <= 0.0 {
            return None;
        }
        // 1 along the axis nearest to the normal, 0 along the others.
        let n = n.abs();
        let across = if n.x > n.y.max(n.z) {
            Vec3::X
        } else if n.y > n.z {
            Vec3::Y
        } else {
            Vec3::Z
        };
        let width = width.min(self.physical_size);
        let widths = Vec3::splat(width).max(across * self.physical_size);
        let (flake, cover) = covered_flake(position, self.physical_size, widths, pixel, self.seed)?;
        let kept = if flake.value < self.elimination { self.returned(footprint) } else { 1.0 };
        let (share, most) = (width / self.physical_size, fade * kept);
        let tilt = flake.tilt * (self.variation * fade);
        (most > 0.0).then_some(Sparkle {
            tilt,
            fade,
            weight: cover * most,
            mean_weight: share * share * most,
        })
    }

    /// The weight at this footprint of a flake that is eliminated up close.
    fn returned(&self, footprint: Footprint) -> f32 {
        match self.rule {
            Elimination::Fixed => 0.0,
            Elimination::Adaptive { unit } => {
                filtered_fraction(footprint.width() * self.pixel_size, 1.0 / unit)
            }
        }
    }
}

/// The boosted specular color of a flake, the *boost* of the artist.
///
/// ```text
/// specular + (target − specular) · boost
/// ```
///
/// Nilsson 2008, §4.3.4, *Glitter strength*. The boost is clamped to [0, 1], NaN is read as 0.
pub(super) fn boosted(specular: Vec3, target: Vec3, boost: f32) -> Vec3 {
    specular + (target - specular) * clamp_to(boost, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    /// The fraction of a plane covered by flakes.
    fn cover(sparkles: &Sparkles, width: f32) -> f32 {
        let mut flakes = 0.0;
        for i in 0..20_000_u16 {
            let p = Vec3::new(0.87, f32::from(i % 141) * 0.317, f32::from(i / 141) * 0.283);
            let flake = sparkles.flake(p, Vec3::X, Footprint::from_width(width));
            flakes += flake.map_or(0.0, |flake| flake.weight / flake.fade);
        }
        flakes / 20_000.0
    }

    #[test]
    fn sparkle_weight_is_continuous_with_the_stated_mean() {
        let sparkles = Sparkles::new(2.0, 1.0, 0.3, 0.5, Elimination::Adaptive { unit: 0.7 }, 1).unwrap();
        for (cell, width) in (0..40_u8).zip([0.02, 0.07, 0.13, 0.2, 0.25, 0.29].into_iter().cycle()) {
            let footprint = Footprint::from_width(width);
            let at = |x: f32, y: f32| {
                let p = Vec3::new(0.87, f32::from(cell) + x, y);
                sparkles.flake(p, Vec3::X, footprint)
            };
            let Some(any) = at(0.5, 0.5) else { continue };
            let (mut sum, mut before) = (0.0, [0.0; 2]);
            for k in 0..90_000_u32 {
                let [x, y] = [k % 300, k / 300].map(|i| (i as f32 + 0.5) / 300.0);
                let flake = at(x, y).unwrap();
                assert_eq!((flake.tilt, flake.mean_weight), (any.tilt, any.mean_weight));
                sum += flake.weight;
                before = if k % 300 == 0 { [flake.weight; 2] } else { [before[1], flake.weight] };
                // A 300th of the cell, over an edge as wide as the pixel or the rest of the cell.
                let edge = width.min(1.0 - 2.0 * width);
                assert!((before[1] - before[0]).abs() < 1.001 / 300.0 / edge + 1e-5, "{width}: {before:?}");
            }
            // The midpoint rule over four creases along each axis.
            assert_abs_diff_eq!(sum / 90_000.0, any.mean_weight, epsilon = 1e-4, "{cell}, {width}");
        }
    }

    #[test]
    fn flakes_have_constant_width_in_pixels() {
        let sparkles = Sparkles::new(2.0, 1.0, 0.3, 0.0, Elimination::Fixed, 1).unwrap();
        for width in [0.05_f32, 0.1, 0.2] {
            let expected = (2.0 * width) * (2.0 * width);
            // Positions in cells of 0.317 and 0.283 are evenly distributed; over 141 columns the
            // discrepancy is about a percent.
            let got = cover(&sparkles, width);
            assert_abs_diff_eq!(got, expected, epsilon = 0.02, "{width}");
        }
    }

    #[test]
    fn elimination_is_a_probability() {
        let fixed = Sparkles::new(2.0, 1.0, 0.3, 0.7, Elimination::Fixed, 1).unwrap();
        let all = Sparkles::new(2.0, 1.0, 0.3, 0.0, Elimination::Fixed, 1).unwrap();
        // Of 20000 points at least 700 different flakes: four standard errors of 0.3 are 0.07.
        assert_abs_diff_eq!(cover(&fixed, 0.2) / cover(&all, 0.2), 0.3, epsilon = 0.07);
        let smart = Sparkles::new(2.0, 1.0, 0.3, 0.7, Elimination::Adaptive { unit: 0.5 }, 1).unwrap();
        assert_eq!(cover(&smart, 0.05), cover(&fixed, 0.05));
        assert_eq!(cover(&smart, 0.2), cover(&all, 0.2));
        assert!(smart.returned(Footprint::from_width(0.1)) > 0.0);
    }

    #[test]
    fn boost_is_a_clamped_blend() {
        assert_eq!(boosted(Vec3::ZERO, Vec3::ONE, f32::NAN), Vec3::ZERO);
        assert_eq!(boosted(Vec3::ZERO, Vec3::ONE, 2.0), Vec3::ONE);
        let golden = Vec3::new(0.552, 0.636, 0.86);
        assert_abs_diff_eq!(boosted(Vec3::new(0.36, 0.48, 0.8), Vec3::ONE, 0.3), golden, epsilon = 1e-7);
    }
}
