//! Errors that stop a command.

pub use asperity_render::failure::{Failure, Interrupted};

/// A value, or an error that stops the command.
pub type Result<T, E = Failure> = std::result::Result<T, E>;
