//! Refusals of arrays whose lengths differ.

use core::{error::Error, fmt};

/// An array that is not as long as the first one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct BatchError {
    /// Name of the parameter to which the array belongs.
    pub parameter: &'static str,
    /// Length of the first array.
    pub expected: usize,
    /// Length of this one.
    pub got: usize,
}

impl BatchError {
    /// Whether all arrays have one length: the inputs, then the output.
    pub(crate) fn check(
        inputs: &[(&'static str, &[&[f32]])],
        (output, arrays): (&'static str, &[&mut [f32]]),
    ) -> Result<(), Self> {
        let inputs = inputs.iter().flat_map(|(name, arrays)| arrays.iter().map(|array| (*name, array.len())));
        let mut lengths = inputs.chain(arrays.iter().map(|array| (output, array.len())));
        let expected = lengths.next().map_or(0, |(_, len)| len);
        match lengths.find(|&(_, got)| got != expected) {
            Some((parameter, got)) => Err(Self { parameter, expected, got }),
            None => Ok(()),
        }
    }
}

impl fmt::Display for BatchError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} must have {} elements, got {}", self.parameter, self.expected, self.got)
    }
}

impl Error for BatchError {}
