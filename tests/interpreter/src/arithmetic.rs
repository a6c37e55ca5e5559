//! Rounding that WGSL leaves to the implementation.

/// Rounding of a sum of products.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Arithmetic {
    /// Every operation is rounded, in source order.
    #[default]
    Written,
    /// A product used only by one sum or difference is fused with it to one `mul_add`; of two
    /// products, the left one.
    Fused,
}

/// All implementation choices.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Rounding {
    pub(super) arithmetic: Arithmetic,
    /// Added to the bits of every quotient and square root.
    pub(super) division_ulps: i32,
    /// Whether denormals are flushed to zero.
    pub(super) flush_denormals: bool,
}
