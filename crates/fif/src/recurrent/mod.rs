//! Recurrent systems, whose maps copy parts of the graph.

pub(crate) mod error;
pub(crate) mod link;
pub(crate) mod mean;
pub(crate) mod recurrent;
pub(crate) mod value;
