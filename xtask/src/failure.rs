//! Errors that stop a command.

pub(crate) use asperity_render::failure::{Failure, Interrupted};
