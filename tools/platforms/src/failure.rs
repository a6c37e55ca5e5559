//! Errors that stop a command.

/// Any error that stops a command.
pub(crate) type Failure = Box<dyn std::error::Error + Send + Sync>;

/// A value, or an error that stops the command.
pub(crate) type Result<T, E = Failure> = std::result::Result<T, E>;
