//! Systems of maps: the validated type, its storage, its range, its serialization.

pub(crate) mod cell;
#[cfg(feature = "alloc")]
pub(crate) mod chord;
pub(crate) mod error;
pub(crate) mod fif;
pub(crate) mod map;
pub(crate) mod range;
#[cfg(feature = "serde")]
pub(crate) mod serde;
pub(crate) mod storage;
pub(crate) mod support;

pub use error::End;
pub use map::Piece;
pub use storage::Storage;
