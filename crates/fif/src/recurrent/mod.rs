//! Recurrent systems, whose maps copy parts of the graph.

pub(crate) mod recurrent;
pub(crate) mod value;
