//! Products with matrices, and what else is a sum of products: from left to right.

use naga::TypeInner;

use super::super::operators::{Binary, Unary};
use super::super::program::Slot;
use super::body::Body;

/// Words of the columns of a matrix.
fn columns(matrix: &[Slot], rows: usize) -> Vec<&[Slot]> {
    matrix.chunks(rows.max(1)).collect()
}

impl Body<'_> {
    /// A product of linear algebra; none where words are multiplied one by one.
    pub(super) fn matrix_product(
        &mut self,
        left: &TypeInner,
        right: &TypeInner,
        a: &[Slot],
        b: &[Slot],
    ) -> Option<Vec<Slot>> {
        match (left, right) {
            (TypeInner::Matrix { rows, .. }, TypeInner::Vector { .. }) => {
                Some(self.matrix_times(a, *rows as usize, b))
            }
            (TypeInner::Vector { .. }, TypeInner::Matrix { rows, .. }) => {
                let columns = columns(b, *rows as usize);
                Some(columns.into_iter().map(|column| self.dot(a, column, true)).collect())
            }
            (TypeInner::Matrix { rows, .. }, TypeInner::Matrix { rows: inner, .. }) => {
                let columns = columns(b, *inner as usize);
                Some(
                    columns
                        .into_iter()
                        .flat_map(|column| self.matrix_times(a, *rows as usize, column))
                        .collect(),
                )
            }
            _ => None,
        }
    }

    /// The sum of a matrix's columns, each by a component of the vector.
    fn matrix_times(&mut self, matrix: &[Slot], rows: usize, vector: &[Slot]) -> Vec<Slot> {
        let row = |row: usize| matrix.iter().skip(row).step_by(rows).copied().collect::<Vec<Slot>>();
        (0..rows).map(|at| self.dot(&row(at), vector, true)).collect()
    }

    /// The sum of products, from the first component to the last.
    pub(super) fn dot(&mut self, a: &[Slot], b: &[Slot], is_float: bool) -> Slot {
        let (multiply, add) = if is_float {
            (Binary::Multiply, Binary::Add)
        } else {
            (Binary::MultiplyInteger, Binary::AddInteger)
        };
        let products = self.pairs(multiply, a, b);
        let (first, rest) = products.split_at(1);
        rest.iter().fold(first[0], |sum, product| self.binary(add, sum, *product))
    }

    /// `a_i b_j − b_i a_j`.
    fn minor(&mut self, a: &[Slot], b: &[Slot], i: usize, j: usize) -> Slot {
        let left = self.binary(Binary::Multiply, a[i], b[j]);
        let right = self.binary(Binary::Multiply, b[i], a[j]);
        self.binary(Binary::Subtract, left, right)
    }

    pub(super) fn cross(&mut self, a: &[Slot], b: &[Slot]) -> Vec<Slot> {
        [(1, 2), (2, 0), (0, 1)].map(|(i, j)| self.minor(a, b, i, j)).to_vec()
    }

    pub(super) fn length(&mut self, a: &[Slot]) -> Slot {
        if let [scalar] = *a {
            return self.unary(Unary::Abs, scalar);
        }
        let squared = self.dot(a, a, true);
        self.unary(Unary::Sqrt, squared)
    }
}
