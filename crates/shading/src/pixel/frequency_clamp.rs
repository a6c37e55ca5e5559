//! Frequency clamping: the number of octaves that a pixel resolves.

use crate::error::ShadingError;
use crate::math::{clamp_to, exp2, log2};
use crate::parameter::{not_negative, positive, within};
use crate::pixel::footprint::Footprint;

/// The real number of octaves that a pixel resolves, none above its Nyquist frequency.
///
/// Octave `i` of a noise has the frequency `f λⁱ` (its lattice cells per unit of length). A pixel
/// of width `d` resolves frequencies up to `1/(2d)`. An octave starts to fade in where its
/// frequency **is** that limit, and is complete when the next octave reaches it:
///
/// ```text
/// octaves(d) = clamp(log_λ(1 / (2 d f)), 0, max),   weight of octave i = clamp(octaves − i, 0, 1)
/// ```
///
/// An octave is weighted by its cells across the pixel, `x = d f λⁱ`. This filter, `clamp(−log_λ
/// 2x, 0, 1)`, is linear in the zoom. With `λ = 2.17` it is 1 up to `x = 0.23` and 0 from 0.5 on.
/// The other filter, [`Footprint::kept`], is smooth from 0.2 to 0.6, and is used by materials and
/// textures. The count is continuous in `d`, decreases with `d`, and is linear in `log d` between
/// its ends. It is 0 if the first octave is below the pixel, and `max` for a pixel of width 0.
///
/// ```
/// use asperity_shading::pixel::FrequencyClamp;
/// use asperity_shading::Footprint;
///
/// let clamp = FrequencyClamp::new(10.0, 2.0, 8.0)?;
/// assert_eq!(clamp.octaves(Footprint::from_width(0.05)), 0.0);
/// assert_eq!(clamp.octaves(Footprint::from_width(0.05 / 8.0)), 3.0);
/// assert_eq!(clamp.octaves(Footprint::from_width(0.0)), 8.0);
/// # Ok::<(), asperity_shading::ShadingError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrequencyClamp {
    frequency: f32,
    lacunarity: f32,
    max_octaves: f32,
    log2_lacunarity: f32,
}

impl FrequencyClamp {
    /// Creates a clamp for octaves from `frequency` upward with ratio `lacunarity`.
    ///
    /// There are at most `max_octaves` of them.
    ///
    /// `frequency` is in lattice cells per unit of the surface positions.
    ///
    /// # Errors
    /// [`ShadingError`] unless all are finite, `frequency` positive, `lacunarity` more than 1,
    /// and `max_octaves` not negative.
    pub fn new(frequency: f32, lacunarity: f32, max_octaves: f32) -> Result<Self, ShadingError> {
        positive("frequency", frequency)?;
        // 1 is invalid, because the logarithm is a divisor.
        within("lacunarity", lacunarity, [1.0_f32.next_up(), f32::MAX])?;
        not_negative("max_octaves", max_octaves)?;
        Ok(Self { frequency, lacunarity, max_octaves, log2_lacunarity: log2(lacunarity) })
    }

    /// The frequency of the first octave, in cells per unit of length.
    #[must_use]
    pub const fn frequency(&self) -> f32 {
        self.frequency
    }

    /// The frequency ratio of consecutive octaves.
    #[must_use]
    pub const fn lacunarity(&self) -> f32 {
        self.lacunarity
    }

    /// The maximum number of octaves of any pixel.
    #[must_use]
    pub const fn max_octaves(&self) -> f32 {
        self.max_octaves
    }

    /// The base-2 logarithm of the lacunarity, above 0.
    pub(crate) const fn log2_lacunarity(&self) -> f32 {
        self.log2_lacunarity
    }

    /// The real number of octaves that a pixel of this footprint resolves, in `[0, max_octaves]`.
    #[must_use]
    pub fn octaves(&self, footprint: Footprint) -> f32 {
        // A footprint is never NaN and both of its ends are defined: log2(0) = −∞ and log2(∞) = ∞.
        let octaves = -log2(2.0 * footprint.width() * self.frequency) / self.log2_lacunarity;
        clamp_to(octaves, self.max_octaves)
    }

    /// The widest footprint that resolves this many octaves: the inverse of
    /// [`FrequencyClamp::octaves`].
    ///
    /// ```text
    /// d = λ^(−octaves) / (2 f)
    /// ```
    ///
    /// `octaves` is clamped to `[0, max_octaves]`, NaN is read as 0.
    #[must_use]
    pub fn footprint(&self, octaves: f32) -> Footprint {
        let octaves = clamp_to(octaves, self.max_octaves);
        Footprint::from_width(0.5 / self.frequency * exp2(-octaves * self.log2_lacunarity))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    fn clamp() -> FrequencyClamp {
        FrequencyClamp::new(16.0, 2.17, 6.0).unwrap()
    }

    #[test]
    fn no_octave_with_weight_exceeds_the_nyquist_frequency() {
        for i in 0..2000 {
            let width = 10.0_f32.powf(-6.0 + i as f32 / 250.0);
            let octaves = clamp().octaves(Footprint::from_width(width));
            let mut octave = 0;
            while (octave as f32) < octaves {
                let frequency = 16.0 * 2.17_f32.powi(octave);
                assert!(
                    frequency * width <= 0.5 * (1.0 + 1e-5),
                    "width = {width}, octave {octave} of {octaves}"
                );
                octave += 1;
            }
        }
    }

    #[test]
    fn octaves_is_continuous_and_decreasing() {
        let mut last = 6.0;
        for i in 0..=20_000 {
            let width = 2.0_f32.powf(-16.0 + i as f32 / 1000.0);
            let octaves = clamp().octaves(Footprint::from_width(width));
            assert!(octaves <= last + 1e-6, "width = {width}: {octaves} after {last}");
            // A thousandth of an octave of width at ratio 2 is 0.000895 octaves at ratio 2.17.
            assert!(last - octaves < 9.1e-4, "width = {width}: {octaves} after {last}");
            last = octaves;
        }
        assert_eq!(last, 0.0);
    }

    #[test]
    fn footprint_inverts_octaves() {
        for i in 0..=60 {
            let octaves = i as f32 / 10.0;
            let got = clamp().octaves(clamp().footprint(octaves));
            assert_abs_diff_eq!(got, octaves, epsilon = 2e-6);
        }
        assert_eq!(clamp().footprint(f32::NAN), clamp().footprint(0.0));
        assert_eq!(clamp().footprint(f32::INFINITY), clamp().footprint(6.0));
    }

    #[test]
    fn accessors_return_the_constructor_arguments() {
        let clamp = FrequencyClamp::new(16.0, 4.0, 6.0).unwrap();
        assert_eq!([clamp.frequency(), clamp.lacunarity(), clamp.max_octaves()], [16.0, 4.0, 6.0]);
        assert_eq!(clamp.log2_lacunarity(), 2.0);
        assert!(FrequencyClamp::new(16.0, 1.0, 6.0).is_err() && FrequencyClamp::new(0.0, 4.0, 6.0).is_err());
    }

    #[test]
    fn octaves_reaches_both_ends() {
        assert_eq!(clamp().octaves(Footprint::from_width(0.0)), 6.0);
        assert_eq!(clamp().octaves(Footprint::from_width(f32::INFINITY)), 0.0);
        assert_eq!(clamp().octaves(Footprint::from_width(f32::NAN)), 0.0);
        assert_eq!(clamp().octaves(Footprint::from_width(f32::MAX)), 0.0);
        assert_eq!(clamp().octaves(Footprint::from_width(f32::MIN_POSITIVE)), 6.0);
    }
}
