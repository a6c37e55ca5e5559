//! Targets of pointers.

use super::super::program::Slot;

/// Unit of the addresses of a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Base {
    Memory,
    /// A uniform or storage buffer, by the index of naga.
    Buffer(u32),
}

/// `address + offset`, in words.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) base: Base,
    /// Place of the part of the address that only running finds.
    pub(super) address: Option<Slot>,
    pub(super) offset: u32,
}

impl Place {
    /// A variable.
    pub(super) const fn memory(offset: Slot) -> Self {
        Self { base: Base::Memory, address: None, offset }
    }

    /// Target of a pointer that is an argument.
    pub(super) const fn pointed(address: Slot) -> Self {
        Self { base: Base::Memory, address: Some(address), offset: 0 }
    }

    /// The beginning of a buffer.
    pub(super) const fn buffer(index: u32) -> Self {
        Self { base: Base::Buffer(index), address: None, offset: 0 }
    }

    /// So many words further.
    pub(super) const fn plus(self, words: u32) -> Self {
        Self { offset: self.offset + words, ..self }
    }
}
