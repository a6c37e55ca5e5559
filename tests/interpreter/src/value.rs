//! Arguments and results of functions.

/// The 32-bit words of a scalar, a vector, a matrix by columns, an array or a struct, without
/// padding.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Value(Vec<u32>);

impl Value {
    /// Returns all words, one for a scalar; booleans are 0 or 1.
    #[must_use]
    pub fn words(&self) -> &[u32] {
        &self.0
    }

    /// Returns all words as floats.
    #[must_use]
    pub fn f32s(&self) -> Vec<f32> {
        self.0.iter().copied().map(f32::from_bits).collect()
    }

    /// Returns the first word as a float, or NaN if there is none.
    #[must_use]
    pub fn f32(&self) -> f32 {
        self.0.first().map_or(f32::NAN, |word| f32::from_bits(*word))
    }

    /// Returns the first word, or 0 if there is none.
    #[must_use]
    pub fn u32(&self) -> u32 {
        self.0.first().copied().unwrap_or_default()
    }

    /// Returns the first word as a signed number, or 0 if there is none.
    #[must_use]
    pub fn i32(&self) -> i32 {
        self.u32().cast_signed()
    }
}

impl From<Vec<u32>> for Value {
    fn from(words: Vec<u32>) -> Self {
        Self(words)
    }
}

impl From<f32> for Value {
    fn from(value: f32) -> Self {
        Self(vec![value.to_bits()])
    }
}

impl From<u32> for Value {
    fn from(value: u32) -> Self {
        Self(vec![value])
    }
}

impl From<i32> for Value {
    fn from(value: i32) -> Self {
        Self(vec![value.cast_unsigned()])
    }
}

impl From<bool> for Value {
    fn from(value: bool) -> Self {
        Self(vec![value.into()])
    }
}

impl<const N: usize> From<[f32; N]> for Value {
    fn from(values: [f32; N]) -> Self {
        Self(values.map(f32::to_bits).to_vec())
    }
}

impl<const N: usize> From<[u32; N]> for Value {
    fn from(values: [u32; N]) -> Self {
        Self(values.to_vec())
    }
}

impl<const N: usize> From<[i32; N]> for Value {
    fn from(values: [i32; N]) -> Self {
        Self(values.map(i32::cast_unsigned).to_vec())
    }
}
