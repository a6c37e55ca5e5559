//! Diffuse reflectance: Lambert, Oren and Nayar's rough surface in its four forms.

mod energy_preserving;
mod lambert;
mod oren_nayar;
mod rough;

pub use energy_preserving::EnergyPreservingOrenNayar;
pub use lambert::Lambert;
pub use oren_nayar::{OrenNayar, OrenNayarForm};
