//! Rounding that WGSL leaves to an implementation.

/// Rounding of a sum of products.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Arithmetic {
    /// Every operation is rounded, in the order that is written.
    #[default]
    Written,
    /// A product that only one sum or difference uses is one `mul_add` with it, the left one of two.
    Fused,
}

/// Everything that an implementation may choose.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Rounding {
    pub(super) arithmetic: Arithmetic,
    /// Added to the bits of every quotient and square root.
    pub(super) division_ulps: i32,
    /// Denormals are zero.
    pub(super) flush_denormals: bool,
}
