//! A module with all that it is run with.

use naga::valid::ModuleInfo;

use super::arithmetic::Rounding;
use super::binding::Bindings;

/// A validated module, what its names are bound to, and how it rounds.
#[derive(Debug)]
pub(super) struct Shader {
    pub(super) module: naga::Module,
    pub(super) info: ModuleInfo,
    pub(super) bindings: Bindings,
    pub(super) rounding: Rounding,
}
