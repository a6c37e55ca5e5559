//! Diffuse BRDFs: Lambert, and four forms of Oren–Nayar.

mod energy_preserving;
mod lambert;
mod oren_nayar;
mod rough;

pub use energy_preserving::EnergyPreservingOrenNayar;
pub use lambert::Lambert;
pub use oren_nayar::{OrenNayar, OrenNayarVariant};
