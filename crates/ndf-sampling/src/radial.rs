//! The trait of densities that depend on the tilt alone.

use crate::ndf::{Ndf, forward};

/// A density that may depend on the tilt alone, with the distribution of the tilt.
///
/// ```text
/// E(t) = −ln P(tan θ > t) = |T⁻¹(m)|²/2   for m tilted by tan θ = t
/// ```
///
/// With an exponent `T` keeps directions: `T(z)` is tilted towards `z`. Mixtures of such densities have a
/// bijection of their own, see [`Mixture`](crate::Mixture).
///
/// ```
/// use asperity_ndf_sampling::{Ggx, Radial};
///
/// let share = (-Ggx::isotropic(0.2)?.exponent(0.2).unwrap()).exp();
/// assert!((share - 0.5).abs() < 1e-6);
/// assert_eq!(Ggx::new(0.2, 0.4)?.exponent(0.2), None);
/// # Ok::<(), asperity_ndf_sampling::RangeError>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` may depend on the azimuth",
    note = "for a sum of any densities, without a map from Gaussian coordinates, take `Blend`"
)]
pub trait Radial: Ndf {
    /// `E(t)` for the slope `t ≥ 0`, increasing from 0; `None` if the density depends on the azimuth.
    #[must_use]
    fn exponent(&self, slope: f64) -> Option<f64>;
}

impl<N: Radial + ?Sized> Radial for &N {
    forward! { |ndf| **ndf; exponent(slope: f64) -> Option<f64>; }
}
