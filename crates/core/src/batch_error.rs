//! Errors of batches.

use core::{error::Error, fmt};

/// Error returned when the slices of a batch have different lengths.
///
/// ```
/// use asperity_core::BatchError;
///
/// let error = BatchError::check("values", 4, 3).unwrap_err();
/// assert_eq!(error.to_string(), "`values` must have 4 elements, got 3");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct BatchError {
    /// Name of the parameter that the slice belongs to.
    pub parameter: &'static str,
    /// Required length: the number of inputs.
    pub expected: usize,
    /// Actual length.
    pub got: usize,
}

impl BatchError {
    /// Checks the length of one slice.
    ///
    /// # Errors
    /// Returns an error if `got` is not `expected`.
    #[inline]
    pub const fn check(parameter: &'static str, expected: usize, got: usize) -> Result<(), Self> {
        if expected == got { Ok(()) } else { Err(Self { parameter, expected, got }) }
    }

    /// Checks that all slices have the same length: the inputs, then the outputs.
    ///
    /// # Errors
    /// Returns an error for the first slice whose length differs.
    pub fn check_all(
        inputs: &[(&'static str, &[&[f32]])],
        (output, slices): (&'static str, &[&mut [f32]]),
    ) -> Result<(), Self> {
        let inputs = inputs.iter().flat_map(|(name, slices)| slices.iter().map(|slice| (*name, slice.len())));
        let mut lengths = inputs.chain(slices.iter().map(|slice| (output, slice.len())));
        let expected = lengths.next().map_or(0, |(_, len)| len);
        lengths.try_for_each(|(parameter, got)| Self::check(parameter, expected, got))
    }
}

impl fmt::Display for BatchError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}` must have {} elements, got {}", self.parameter, self.expected, self.got)
    }
}

impl Error for BatchError {}
