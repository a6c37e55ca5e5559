//! Leaves out what nothing reads.

use std::collections::HashSet;

use super::super::program::{Operation, Slot, Step};

/// Removes operations whose result nothing reads.
pub(super) fn remove(steps: &mut [Step]) {
    sweep(steps, &mut HashSet::new());
}

/// From the last statement to the first, so that whoever reads a word comes before its operation. What goes round a loop does so
/// in variables, which stay.
fn sweep(steps: &mut [Step], read: &mut HashSet<Slot>) {
    for step in steps.iter_mut().rev() {
        match step {
            Step::Compute(operations) => {
                let mut kept: Vec<Operation> = Vec::new();
                for operation in std::mem::take(operations).into_iter().rev() {
                    if result(&operation).is_none_or(|to| read.contains(&to)) {
                        operation.for_each_read(|slot| {
                            read.insert(slot);
                        });
                        kept.push(operation);
                    }
                }
                kept.reverse();
                *operations = kept;
            }
            Step::If { condition, accept, reject } => {
                sweep(reject, read);
                sweep(accept, read);
                read.insert(*condition);
            }
            Step::Switch { selector, cases } => {
                cases.iter_mut().rev().for_each(|case| sweep(&mut case.body, read));
                read.insert(*selector);
            }
            Step::Loop { body, continuing, break_if } => {
                read.extend(*break_if);
                sweep(continuing, read);
                sweep(body, read);
            }
            Step::Block(steps) => sweep(steps, read),
            Step::Break | Step::Continue | Step::Return | Step::Call(_) => {}
        }
    }
}

/// The only word that an operation writes, if it neither is a variable nor may be refused.
const fn result(operation: &Operation) -> Option<Slot> {
    match *operation {
        Operation::Unary(_, to, _)
        | Operation::Binary(_, to, _)
        | Operation::Ternary(_, to, _)
        | Operation::Load { to, .. }
        | Operation::LoadTable { to, .. } => Some(to),
        _ => None,
    }
}
