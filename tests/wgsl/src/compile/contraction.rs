//! Products and sums that are rounded once.

use std::collections::{HashMap, HashSet};

use super::super::operators::{Binary, Ternary};
use super::super::program::{Operation, Slot, Step};

/// Makes one operation of every product and the only sum or difference that uses it.
pub(super) fn fuse(steps: &mut [Step]) {
    let mut products = HashMap::new();
    let mut uses = HashMap::new();
    visit(steps, &mut |operations| {
        for operation in operations.iter() {
            operation.for_each_read(|slot| *uses.entry(slot).or_insert(0) += 1);
            if let Operation::Binary(Binary::Multiply, to, factors) = *operation {
                products.insert(to, factors);
            }
        }
    });
    let lone = |slot: Slot| products.get(&slot).filter(|_| uses.get(&slot) == Some(&1)).copied();
    let mut fused = HashSet::new();
    visit(steps, &mut |operations| {
        for operation in operations.iter_mut() {
            let (ternary, to, product, factors, term) = match *operation {
                Operation::Binary(sum @ (Binary::Add | Binary::Subtract), to, [left, right]) => {
                    let first =
                        if sum == Binary::Add { Ternary::MultiplyAdd } else { Ternary::MultiplySubtract };
                    let second =
                        if sum == Binary::Add { Ternary::MultiplyAdd } else { Ternary::NegatedMultiplyAdd };
                    match (lone(left), lone(right)) {
                        (Some(factors), _) => (first, to, left, factors, right),
                        (None, Some(factors)) => (second, to, right, factors, left),
                        (None, None) => continue,
                    }
                }
                _ => continue,
            };
            *operation = Operation::Ternary(ternary, to, [factors[0], factors[1], term]);
            fused.insert(product);
        }
    });
    visit(steps, &mut |operations| {
        operations.retain(|operation| {
            !matches!(operation, Operation::Binary(Binary::Multiply, to, _) if fused.contains(to))
        });
    });
}

/// Hands all operations of the statements and of those within them to `change`.
pub(super) fn visit(steps: &mut [Step], change: &mut impl FnMut(&mut Vec<Operation>)) {
    for step in steps {
        match step {
            Step::Compute(operations) => change(operations),
            Step::If { accept, reject, .. } => {
                visit(accept, change);
                visit(reject, change);
            }
            Step::Switch { cases, .. } => cases.iter_mut().for_each(|case| visit(&mut case.body, change)),
            Step::Loop { body, continuing, .. } => {
                visit(body, change);
                visit(continuing, change);
            }
            Step::Block(steps) => visit(steps, change),
            Step::Break | Step::Continue | Step::Return | Step::Call(_) => {}
        }
    }
}
