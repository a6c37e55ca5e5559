//! The `Radial` trait.

use crate::ndf::{Ndf, forward};

/// An NDF that can report the distribution of its tilt.
///
/// ```text
/// E(t) = −ln P(tan θ > t) = |T⁻¹(m)|²/2   for m tilted by tan θ = t
/// ```
///
/// If the exponent exists, `T` keeps azimuths: `T(z)` is tilted towards `z`. Mixtures of such NDFs
/// have a bijection, see [`Mixture`](crate::Mixture).
///
/// ```
/// use asperity_ndf_sampling::{Ggx, Radial};
///
/// let fraction = (-Ggx::isotropic(0.2)?.exponent(0.2).unwrap()).exp();
/// assert!((fraction - 0.5).abs() < 1e-6);
/// assert_eq!(Ggx::new(0.2, 0.4)?.exponent(0.2), None);
/// # Ok::<(), asperity_ndf_sampling::NdfError>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` may depend on the azimuth",
    note = "for a sum of any densities, without a map from Gaussian coordinates, take `Blend`"
)]
pub trait Radial: Ndf {
    /// `E(t)` for the slope `t ≥ 0`, increasing from 0; `None` if the NDF depends on the azimuth.
    #[must_use]
    fn exponent(&self, slope: f64) -> Option<f64>;
}

impl<N: Radial + ?Sized> Radial for &N {
    forward! { |ndf| **ndf; exponent(slope: f64) -> Option<f64>; }
}
