//! The extension module of the Python package `asperity`.

mod bake;
mod batch;
mod command;
mod curve;
mod distribution;
mod fif;
mod filter;
mod ndf;
mod noise;
mod parallel;
mod shading;
mod surface;

use pyo3::prelude::*;

/// Compiled parts of `asperity`.
#[pymodule]
mod _asperity {
    #[pymodule_export]
    use crate::bake::bake;
    #[pymodule_export]
    use crate::command::run;
    #[pymodule_export]
    use crate::fif::Fif;
    #[pymodule_export]
    use crate::filter::filter;
    #[pymodule_export]
    use crate::ndf::Ndf;
    #[pymodule_export]
    use crate::noise::Field;
    #[pymodule_export]
    use crate::shading::Bsdf;
    #[pymodule_export]
    use crate::surface::Surface;
}
