//! Samples of a function.

/// A function sampled on a regular grid, with its slopes if it is an integral.
pub(super) struct Curve {
    pub(super) knots: Vec<[f64; 2]>,
    pub(super) points: Vec<[f64; 2]>,
    pub(super) slopes: Option<Vec<f64>>,
    /// Bound of the absolute errors of the points.
    pub(super) error: f64,
}
