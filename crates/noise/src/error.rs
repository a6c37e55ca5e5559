//! The error of the constructors of this crate.

use asperity_core::error_enum;

error_enum! {
    /// Error returned for invalid parameters.
    ///
    /// ```
    /// use asperity_noise::{Cellular, NoiseError};
    ///
    /// let error = Cellular::new(1).with_jitter(1.5).unwrap_err();
    /// assert!(matches!(error, NoiseError::OutOfRange { parameter: "jitter", .. }));
    /// assert_eq!(error.to_string(), "`jitter` is out of range: 1.5 (allowed: 0 to 1)");
    /// ```
    pub enum NoiseError {
        /// A parameter is outside its range or NaN.
        OutOfRange { parameter: &'static str, value: f32, min: f32, max: f32 } =>
            "`{parameter}` is out of range: {value} (allowed: {min} to {max})";
        /// A number of octaves or impulses is outside its range.
        Count { parameter: &'static str, value: u32, min: u32, max: u32 } =>
            "`{parameter}` is out of range: {value} (allowed: {min} to {max})";
        /// A parameter violates another rule.
        Invalid { parameter: &'static str, value: f32, rule: &'static str } =>
            "`{parameter}` is invalid: {value} ({rule})";
        /// The period along an axis, counted from 0, is 0 or too long.
        Period { axis: usize, period: u32 } => "`periods[{axis}]` is out of range: {period} (allowed: 1 to 2097152)";
        /// The noise repeats only with multiples of `factor`.
        PeriodMultiple { axis: usize, period: u32, factor: u32 } =>
            "`periods[{axis}]` is invalid: {period} (must be a multiple of {factor})";
        /// The lacunarity makes the period of an octave fractional or too long.
        ///
        /// Octaves are counted from 0, and `period` is the period of the first.
        OctavePeriod { axis: usize, period: u32, lacunarity: f32, octave: u32 } =>
            "the period of octave {octave} is invalid: `periods[{axis}]` {period} · `lacunarity` {lacunarity}^{octave} \
             (must be an integer up to 2097152)";
        /// An entry of a permutation occurs a second time.
        DuplicateEntry { index: usize, entry: u8 } =>
            "`entries[{index}]` is a duplicate: {entry} (must be a permutation of 0 to 255)";
    }
}
