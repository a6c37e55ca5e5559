//! The default storage of tables.

/// Entries owned by a table. Without `alloc`, entries in static memory.
#[cfg(feature = "alloc")]
pub(crate) type Entries<T> = alloc::vec::Vec<T>;

/// Entries owned by a table. Without `alloc`, entries in static memory.
#[cfg(not(feature = "alloc"))]
pub(crate) type Entries<T> = &'static [T];
