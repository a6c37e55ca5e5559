//! A module with its execution environment.

use naga::valid::ModuleInfo;

use super::arithmetic::Rounding;
use super::binding::Bindings;

/// A validated module, its bound resources, and its rounding.
#[derive(Debug)]
pub(super) struct Shader {
    pub(super) module: naga::Module,
    pub(super) info: ModuleInfo,
    pub(super) bindings: Bindings,
    pub(super) rounding: Rounding,
}
