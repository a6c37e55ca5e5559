//! Compiled functions: operations on words of one memory, in which every variable and every intermediate
//! result has a place of its own, as nothing in WGSL calls itself.

use super::operators::{Binary, Ternary, Unary};

/// Index of a word of memory.
pub(super) type Slot = u32;

/// An operation on scalars.
#[derive(Clone, Debug)]
pub(super) enum Operation {
    Unary(Unary, Slot, [Slot; 1]),
    Binary(Binary, Slot, [Slot; 2]),
    Ternary(Ternary, Slot, [Slot; 3]),
    /// Moves a float by units in the last place.
    Nudge {
        to: Slot,
        ulps: i32,
    },
    /// Writes a variable.
    Store {
        to: Slot,
        from: Slot,
    },
    /// `to = base + index · stride`, refused where `index` is not below `bound`.
    Index {
        to: Slot,
        base: Option<Slot>,
        index: Slot,
        stride: u32,
        bound: u32,
    },
    /// Reads memory at `address + offset`.
    Load {
        to: Slot,
        address: Slot,
        offset: u32,
    },
    /// Writes memory at `address + offset`.
    StoreAt {
        address: Slot,
        offset: u32,
        from: Slot,
    },
    /// Reads a buffer at `address + offset`.
    LoadBuffer {
        to: Slot,
        buffer: u32,
        address: Option<Slot>,
        offset: u32,
    },
    /// Reads a table of the module itself.
    LoadTable {
        to: Slot,
        table: u32,
        address: Slot,
    },
    /// Number of elements of so many words that a buffer has behind `offset`.
    ArrayLength {
        to: Slot,
        buffer: u32,
        offset: u32,
        stride: u32,
    },
    /// Reads component x of a texel.
    LoadTexel {
        to: Slot,
        texture: Slot,
        x: Slot,
        y: Slot,
        level: Slot,
    },
    /// Width and height of a texture, in two neighbouring words.
    TextureSize {
        to: Slot,
        texture: Slot,
    },
}

impl Operation {
    /// Hands every word that is read to `visit`.
    pub(super) fn for_each_read(&self, mut visit: impl FnMut(Slot)) {
        match *self {
            Self::Unary(_, _, [a]) => visit(a),
            Self::Binary(_, _, operands) => operands.into_iter().for_each(visit),
            Self::Ternary(_, _, operands) => operands.into_iter().for_each(visit),
            Self::Nudge { to, .. } => visit(to),
            Self::Store { from, .. } => visit(from),
            Self::Index { base, index, .. } => base.into_iter().chain([index]).for_each(visit),
            Self::Load { address, .. } | Self::LoadTable { address, .. } => visit(address),
            Self::StoreAt { address, from, .. } => [address, from].into_iter().for_each(visit),
            Self::LoadBuffer { address, .. } => address.into_iter().for_each(visit),
            Self::ArrayLength { .. } => {}
            Self::LoadTexel { texture, x, y, level, .. } => {
                [texture, x, y, level].into_iter().for_each(visit);
            }
            Self::TextureSize { texture, .. } => visit(texture),
        }
    }
}

/// A statement.
#[derive(Clone, Debug)]
pub(super) enum Step {
    Compute(Vec<Operation>),
    If { condition: Slot, accept: Vec<Self>, reject: Vec<Self> },
    Switch { selector: Slot, cases: Vec<Case> },
    Loop { body: Vec<Self>, continuing: Vec<Self>, break_if: Option<Slot> },
    Block(Vec<Self>),
    Break,
    Continue,
    Return,
    Call(usize),
}

/// A case of a switch.
#[derive(Clone, Debug)]
pub(super) struct Case {
    /// None in the default case.
    pub(super) value: Option<u32>,
    pub(super) body: Vec<Step>,
    /// Goes on with the case below.
    pub(super) fall_through: bool,
}

/// A function.
#[derive(Debug)]
pub(super) struct Function {
    pub(super) name: String,
    /// Number of words of every argument, which lie one after the other.
    pub(super) arguments: Vec<usize>,
    pub(super) first_argument: Slot,
    pub(super) result: Slot,
    pub(super) result_words: u32,
    pub(super) steps: Vec<Step>,
}

/// All functions of a module.
#[derive(Debug, Default)]
pub(super) struct Program {
    /// By the index of naga; a function with anything that is not known has its error.
    pub(super) functions: Vec<Result<Function, String>>,
    /// Number of words of memory.
    pub(super) memory: u32,
    /// Words of memory that never change.
    pub(super) constants: Vec<(Slot, u32)>,
    /// Private variables' first values.
    pub(super) variables: Vec<(Slot, u32)>,
    /// Arrays of constants that are read at an index.
    pub(super) tables: Vec<Vec<u32>>,
}
