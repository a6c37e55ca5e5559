//! What one evaluation of a noise returns: its value and its gradient.

/// A noise value with its analytic gradient, both from one evaluation.
///
/// `V` is the point's type: [`glam::Vec2`] or [`glam::Vec3`].
/// The gradient is in units of the value per unit of the noise's input coordinate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample<V> {
    /// The noise value, dimensionless.
    pub value: f32,
    /// ∂value/∂p, per unit length of the input.
    pub gradient: V,
}
