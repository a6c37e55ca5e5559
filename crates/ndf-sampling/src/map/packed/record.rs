//! The numbers of a bin of the marginal, as they lie in a packed map.

/// Numbers before the first part of a map.
pub(crate) const HEADER: usize = 16;
/// Numbers of a cubic.
pub(crate) const CUBIC: usize = 16;

/// The polynomials of a bin, or of a piece: four coefficients, of `r³`, `r²s`, `rs²` and `s³`, for the place `s` in it, from 0 to
/// 1, and `r = 1 − s`.
///
/// ```text
/// (M − M₀)/s,  the marginal,  its part below the middle;      M₀, and two numbers for pieces
/// ```
///
/// Their coefficients are not negative: no sum cancels. A bin that is more than one piece has the first row alone: two numbers
/// whose sum is where the first of them is among the cubics, for [`MARGINAL`] and [`BELOW`], and for [`BEFORE`] how many there are,
/// negative.
pub(crate) type Rows = [[f32; 4]; 4];

/// Which column.
pub(crate) const WEIGHT: usize = 0;
pub(crate) const MARGINAL: usize = 1;
pub(crate) const BELOW: usize = 2;
pub(crate) const BEFORE: usize = 3;

/// The row whose number of [`BEFORE`] is where a piece begins, in bins.
pub(crate) const BEGIN: usize = 1;
/// The row whose number of [`BEFORE`] is how wide a piece is.
pub(crate) const WIDE: usize = 2;

/// Numbers of a leaf, four by four: `M` where it begins, one over its weight, four more for the inverse of that; where it begins
/// and how wide it is in its bin; its cubic, its bin, how it is inverted, `M` where it ends.
///
/// ```text
/// s = r + r (1 − r) (c₀ + c₁ r + c₂ r² + c₃ r³),   r = (u − M₀)/(M₁ − M₀)
/// ```
pub(crate) const LEAF: usize = 12;
/// Which of them its cubic is, and `M` where it ends.
#[cfg(feature = "alloc")]
pub(crate) const CUBIC_OF: usize = 8;
#[cfg(feature = "alloc")]
pub(crate) const END: usize = 11;

/// The inverse needs one of Newton's steps.
#[cfg(feature = "alloc")]
pub(crate) const ONE_STEP: f32 = 1.0;
/// The inverse needs as many as it takes, from elsewhere.
pub(crate) const MANY_STEPS: f32 = 2.0;
