//! Quotients that are off, denormals that are zero.

use super::super::arithmetic::Rounding;
use super::super::operators::{Binary, Unary};
use super::super::program::Step;
use super::super::program::{Operation, Slot};
use super::contraction::visit;
use super::memory::Memory;

/// Puts the errors that an implementation may make behind the operations that make them.
pub(super) fn round(steps: &mut [Step], rounding: Rounding, memory: &mut Memory) {
    if rounding.division_ulps == 0 && !rounding.flush_denormals {
        return;
    }
    visit(steps, &mut |operations| {
        for operation in std::mem::take(operations) {
            if rounding.flush_denormals {
                flush(operation, operations, memory);
            } else {
                operations.push(operation);
            }
            let divided = match operations.last() {
                Some(Operation::Binary(Binary::Divide, to, _) | Operation::Unary(Unary::Sqrt, to, _)) => {
                    Some(*to)
                }
                _ => None,
            };
            if let Some(to) = divided.filter(|_| rounding.division_ulps != 0) {
                operations.push(Operation::Nudge { to, ulps: rounding.division_ulps });
            }
            if rounding.flush_denormals
                && let Some(to) = result(operations.last())
            {
                operations.push(Operation::Unary(Unary::Flush, to, [to]));
            }
        }
    });
}

/// Appends an operation on operands without denormals.
fn flush(operation: Operation, operations: &mut Vec<Operation>, memory: &mut Memory) {
    let mut flushed = |from: Slot| {
        let to = memory.fresh(1);
        operations.push(Operation::Unary(Unary::Flush, to, [from]));
        to
    };
    let operation = match operation {
        Operation::Unary(unary, to, operands) if unary.is_float() => {
            Operation::Unary(unary, to, operands.map(&mut flushed))
        }
        Operation::Binary(binary, to, operands) if binary.is_float() => {
            Operation::Binary(binary, to, operands.map(&mut flushed))
        }
        Operation::Ternary(ternary, to, operands) if ternary.is_float() => {
            Operation::Ternary(ternary, to, operands.map(&mut flushed))
        }
        other => other,
    };
    operations.push(operation);
}

/// The float that an operation computes.
fn result(operation: Option<&Operation>) -> Option<Slot> {
    match *operation? {
        Operation::Unary(unary, to, _) if unary.is_float() => Some(to),
        Operation::Binary(binary, to, _) if binary.is_float() && !binary.is_comparison() => Some(to),
        Operation::Ternary(ternary, to, _) if ternary.is_float() => Some(to),
        Operation::Nudge { to, .. } => Some(to),
        _ => None,
    }
}
