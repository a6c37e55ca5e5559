//! Words of types: packed without padding in memory, with padding in buffers.

use naga::{ArraySize, Handle, Module, Scalar, ScalarKind, Type, TypeInner};

/// Scalar types, each in one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Float,
    Signed,
    Unsigned,
    Bool,
}

/// Returns the type of a scalar.
pub(super) fn kind(scalar: Scalar) -> Result<Kind, String> {
    match (scalar.kind, scalar.width) {
        (ScalarKind::Float, 4) => Ok(Kind::Float),
        (ScalarKind::Sint, 4) => Ok(Kind::Signed),
        (ScalarKind::Uint, 4) => Ok(Kind::Unsigned),
        (ScalarKind::Bool, _) => Ok(Kind::Bool),
        _ => Err(format!("unsupported scalar type {:?} with {} bytes", scalar.kind, scalar.width)),
    }
}

/// Returns the number of words of a type without padding; 0 for a runtime-sized array.
pub(super) fn words(module: &Module, inner: &TypeInner) -> Result<u32, String> {
    match *inner {
        TypeInner::Scalar(scalar) => kind(scalar).map(|_| 1),
        TypeInner::Vector { size, scalar } => kind(scalar).map(|_| size as u32),
        TypeInner::Matrix { columns, rows, scalar } => kind(scalar).map(|_| columns as u32 * rows as u32),
        TypeInner::Array { base, size, .. } => {
            let words = words_of(module, base)?;
            match size {
                ArraySize::Constant(size) => Ok(words * size.get()),
                ArraySize::Dynamic => Ok(0),
                ArraySize::Pending(_) => {
                    Err("arrays with an override as their length are not supported".into())
                }
            }
        }
        TypeInner::Struct { ref members, .. } => {
            members.iter().map(|member| words_of(module, member.ty)).sum()
        }
        // An address, or the number of a texture.
        TypeInner::Pointer { .. } | TypeInner::ValuePointer { .. } | TypeInner::Image { .. } => Ok(1),
        ref other => Err(format!("unsupported value type {other:?}")),
    }
}

/// Returns the number of words of a type of the module.
pub(super) fn words_of(module: &Module, of: Handle<Type>) -> Result<u32, String> {
    words(module, &module.types[of].inner)
}

/// Returns part `index` of a value: the words before it, and its number of words.
pub(super) fn part(module: &Module, inner: &TypeInner, index: u32) -> Result<(u32, u32), String> {
    if let TypeInner::Struct { ref members, .. } = *inner {
        let (before, own) = members.split_at(index as usize);
        let before = before.iter().map(|member| words_of(module, member.ty)).sum::<Result<u32, _>>()?;
        let own = own.first().ok_or_else(|| format!("a struct has no member {index}"))?;
        return Ok((before, words_of(module, own.ty)?));
    }
    let (stride, _) = elements(module, inner)?;
    Ok((index * stride, stride))
}

/// Returns words per element, and the number of elements; for a runtime-sized array the maximum
/// number.
pub(super) fn elements(module: &Module, inner: &TypeInner) -> Result<(u32, u32), String> {
    match *inner {
        TypeInner::Vector { size, .. } | TypeInner::ValuePointer { size: Some(size), .. } => {
            Ok((1, size as u32))
        }
        TypeInner::Matrix { columns, rows, .. } => Ok((rows as u32, columns as u32)),
        TypeInner::Array { base, size, .. } => {
            let bound = match size {
                ArraySize::Constant(size) => size.get(),
                _ => u32::MAX,
            };
            Ok((words_of(module, base)?, bound))
        }
        ref other => Err(format!("values of type {other:?} have no elements")),
    }
}

/// Appends the words of a value at a byte offset of a buffer, without padding.
pub(super) fn unpad(
    module: &Module,
    of: Handle<Type>,
    words: &[u32],
    byte: u32,
    unpadded: &mut Vec<u32>,
) -> Result<(), String> {
    let mut run = |byte: u32, count: u32| -> Result<(), String> {
        let first = byte as usize / 4;
        let run = words.get(first..first + count as usize);
        unpadded.extend(run.ok_or_else(|| format!("word {first} is out of bounds"))?);
        Ok(())
    };
    match module.types[of].inner {
        TypeInner::Scalar(_) => run(byte, 1),
        TypeInner::Vector { size, .. } => run(byte, size as u32),
        TypeInner::Matrix { columns, rows, .. } => {
            // A column is laid out like a vector: two words, or four for three and four.
            let stride = if rows as u32 == 2 { 8 } else { 16 };
            (0..columns as u32).try_for_each(|column| run(byte + column * stride, rows as u32))
        }
        TypeInner::Array { base, size, stride } => {
            let count = match size {
                ArraySize::Constant(size) => size.get(),
                _ => (words.len() as u32 * 4).saturating_sub(byte) / stride,
            };
            (0..count).try_for_each(|at| unpad(module, base, words, byte + at * stride, unpadded))
        }
        TypeInner::Struct { ref members, .. } => members
            .iter()
            .try_for_each(|member| unpad(module, member.ty, words, byte + member.offset, unpadded)),
        ref other => Err(format!("unsupported buffer type {other:?}")),
    }
}
