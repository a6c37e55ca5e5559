//! Rows of points: the cells that they cross, and the memory that rows of a grid reuse.

pub(crate) mod cells;
pub(crate) mod grid;
pub(crate) mod points;
pub(crate) mod row;
