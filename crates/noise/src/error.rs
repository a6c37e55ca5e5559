//! The error of the constructors of this crate.

use asperity_core::{Short, error_enum};

error_enum! {
    /// Error returned for invalid parameters.
    ///
    /// ```
    /// use asperity_noise::{Cellular, NoiseError};
    ///
    /// let error = Cellular::new(1).with_jitter(1.5).unwrap_err();
    /// assert!(matches!(error, NoiseError::OutOfRange { parameter: "jitter", .. }));
    /// assert_eq!(error.to_string(), "`jitter` must be between 0 and 1, got 1.5");
    /// ```
    pub enum NoiseError {
        /// A parameter is outside its range or NaN.
        OutOfRange { parameter: &'static str, value: f32, min: f32, max: f32 } =>
            "`{parameter}` must be between {} and {}, got {}", Short(min), Short(max), Short(value);
        /// A number of octaves or impulses is outside its range.
        Count { parameter: &'static str, value: u32, min: u32, max: u32 } =>
            "`{parameter}` must be between {min} and {max}, got {value}";
        /// A parameter violates another rule.
        Invalid { parameter: &'static str, value: f32, rule: &'static str } =>
            "`{parameter}` must be {rule}, got {}", Short(value);
        /// The period along an axis, counted from 0, is 0 or too long.
        Period { axis: usize, period: u32 } => "`periods[{axis}]` must be between 1 and 2097152, got {period}";
        /// The noise repeats only with multiples of `factor`.
        PeriodMultiple { axis: usize, period: u32, factor: u32 } =>
            "`periods[{axis}]` must be a multiple of {factor}, got {period}";
        /// The lacunarity makes the period of an octave fractional or too long.
        ///
        /// Octaves are counted from 0, and `period` is the period of the first.
        OctavePeriod { axis: usize, period: u32, lacunarity: f32, octave: u32 } =>
            "`periods[{axis}]` · `lacunarity`^{octave} must be an integer up to 2097152, got {period} · {lacunarity}^{octave}";
        /// An entry of a permutation occurs a second time.
        DuplicateEntry { index: usize, entry: u8 } =>
            "`entries` must be a permutation of 0 to 255, got {entry} again at index {index}";
    }
}
