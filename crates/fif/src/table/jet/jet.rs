//! A function, its derivative and its integral, together.

/// A function, its derivative and its integral at a point; or bounds of their errors, or places for many.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Jet<T = f64> {
    /// `f(x)`.
    pub value: T,
    /// `f′(x)`.
    pub slope: T,
    /// `∫ f` from `x_0` to `x`.
    pub integral: T,
}

impl<T> Jet<T> {
    /// All three mapped by one function.
    #[must_use]
    pub fn map<U>(self, to: impl Fn(T) -> U) -> Jet<U> {
        Jet { value: to(self.value), slope: to(self.slope), integral: to(self.integral) }
    }

    pub(crate) fn zip<U>(self, other: Jet<U>) -> Jet<(T, U)> {
        Jet {
            value: (self.value, other.value),
            slope: (self.slope, other.slope),
            integral: (self.integral, other.integral),
        }
    }
}
