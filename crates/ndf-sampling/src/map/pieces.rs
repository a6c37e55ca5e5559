//! All pieces of a marginal, computed in blocks.

use alloc::vec::Vec;

use crate::map::breakpoints::Breakpoints;
use crate::map::columns::{Columns, mix};
use crate::map::disk::segment;
use crate::map::piece::Piece;
use crate::numeric::bernstein::Cubic;
use asperity_core::lanes::{self, Lanes, Task, Transpose};

/// Pieces that are computed together.
const BLOCK: usize = 32;

/// The pieces between the breakpoints, and the integral of the density inside the circle on each.
pub(crate) fn pieces(columns: &Columns, breakpoints: &Breakpoints) -> (Vec<Piece>, Vec<f64>) {
    lanes::run(usize::MAX, Pieces { columns, breakpoints })
}

struct Pieces<'a> {
    columns: &'a Columns,
    breakpoints: &'a Breakpoints,
}

impl Task for Pieces<'_> {
    type Output = (Vec<Piece>, Vec<f64>);

    #[inline(always)]
    fn run<S: Lanes + Transpose>(self, s: S) -> Self::Output {
        all(s, self.columns, self.breakpoints)
    }
}

#[inline(always)]
fn all<S: Transpose>(s: S, columns: &Columns, breakpoints: &Breakpoints) -> (Vec<Piece>, Vec<f64>) {
    let count = breakpoints.places.len().saturating_sub(1);
    let (mut pieces, mut masses) = (Vec::with_capacity(count + BLOCK), Vec::with_capacity(count + BLOCK));
    let map = Map::new(columns);
    let mut block = PieceBlock::default();
    for from in (0..count).step_by(BLOCK) {
        block.read(breakpoints, from);
        block.place(&map);
        block.look_up(columns);
        block.integrate(&map);
        block.append(s, &mut pieces);
        masses.extend_from_slice(&block.mass);
    }
    pieces.truncate(count);
    masses.truncate(count);
    (pieces, masses)
}

/// Numbers common to all pieces of a map.
struct Map {
    width: f64,
    height: f64,
    /// The first grid line before the border, in cells.
    offset: f64,
    /// 1 if the density changes across a column of cells, else 0.
    slope: f64,
    /// The middle of the map, in cells.
    middle: f64,
    /// The last row of cells that begins below the middle, and the last row of all.
    last: [u32; 2],
}

impl Map {
    fn new(columns: &Columns) -> Self {
        let kind = columns.kind;
        let rows = kind.cells(columns.height) as u32;
        Self {
            width: columns.width as f64,
            height: columns.height as f64,
            offset: kind.offset(),
            slope: 2.0 * kind.offset(),
            middle: 0.5 * f64::from(rows),
            last: [(rows - 1) / 2, rows - 1],
        }
    }
}

/// One number of each piece of a block.
type Numbers = [f64; BLOCK];

/// A block of pieces in structure-of-arrays form.
struct PieceBlock {
    x: [Numbers; 2],
    half_chord: [Numbers; 2],
    /// The positions of the ends in their column of cells.
    t: [Numbers; 2],
    cells: [u32; BLOCK],
    rows: [[u32; BLOCK]; 2],
    sides: [Sides; 2],
    marginal: [Numbers; 4],
    below: [Numbers; 4],
    mass: Numbers,
}

/// Integrals on one side of the middle of the map.
#[derive(Clone, Copy)]
struct Sides {
    /// The values at the corners of the cell in which the chord ends: left and right, each at its
    /// beginning and end.
    corners: [[Numbers; 2]; 2],
    /// The integral over the cells between it and the middle, on the left and on the right.
    whole: [Numbers; 2],
    /// Beginning of the cell.
    begin: Numbers,
}

impl Default for PieceBlock {
    fn default() -> Self {
        let none = [0.0; BLOCK];
        let sides = Sides { corners: [[none; 2]; 2], whole: [none; 2], begin: none };
        Self {
            x: [none; 2],
            half_chord: [none; 2],
            t: [none; 2],
            cells: [0; BLOCK],
            rows: [[0; BLOCK]; 2],
            sides: [sides; 2],
            marginal: [none; 4],
            below: [none; 4],
            mass: none,
        }
    }
}

impl PieceBlock {
    /// Reads the pieces starting at `from`; entries beyond the last one keep their previous
    /// contents.
    #[inline(always)]
    fn read(&mut self, breakpoints: &Breakpoints, from: usize) {
        for side in 0..2 {
            copy(&mut self.x[side], &breakpoints.places, from + side);
            copy(&mut self.half_chord[side], &breakpoints.half_chords, from + side);
        }
        copy(&mut self.cells, &breakpoints.cells, from);
    }

    /// Finds the rows in which the chords end.
    #[inline(always)]
    fn place(&mut self, map: &Map) {
        for k in 0..BLOCK {
            let cell = f64::from(self.cells[k]);
            let mean = 0.5 * (self.half_chord[0][k] + self.half_chord[1][k]) * map.height;
            // A zero-length chord in the middle of the map still begins below it.
            let rows = [map.middle - mean, map.middle + mean];
            for (side, row) in rows.into_iter().enumerate() {
                self.t[side][k] = map.slope * unit(self.x[side][k] * map.width + map.offset - cell);
                self.rows[side][k] = (row as i32 as u32).min(map.last[side]);
                self.sides[side].begin[k] = f64::from(self.rows[side][k]);
            }
        }
    }

    /// Looks up the values and integrals at these rows.
    #[inline(always)]
    fn look_up(&mut self, columns: &Columns) {
        let rows = columns.kind.cells(columns.height);
        for k in 0..BLOCK {
            let cell = self.cells[k] as usize;
            for (side, all) in self.sides.iter_mut().enumerate() {
                let row = self.rows[side][k] as usize;
                let whole = if side == 0 { row < rows / 2 } else { row >= rows.div_ceil(2) };
                let (corners, sums) = columns.at(cell, row, row + 1 - side);
                for end in 0..2 {
                    all.corners[end][0][k] = corners[end][0];
                    all.corners[end][1][k] = corners[end][1];
                    all.whole[end][k] = if whole { sums[end].abs() } else { 0.0 };
                }
            }
        }
    }

    /// Computes the marginals and the integrals.
    #[inline(always)]
    fn integrate(&mut self, map: &Map) {
        let Map { height, middle, .. } = *map;
        for k in 0..BLOCK {
            let t = [self.t[0][k], self.t[1][k]];
            let c = [self.half_chord[0][k], self.half_chord[1][k]];
            let x = [self.x[0][k], self.x[1][k]];
            let ends = [height * c[0], height * c[1]];
            let (below, rim_below) =
                self.sides[0].integral::<false>(k, t, [middle - ends[0], middle - ends[1]], middle);
            let (above, rim_above) =
                self.sides[1].integral::<true>(k, t, [middle + ends[0], middle + ends[1]], middle);
            let marginal =
                [below[0] + above[0], below[1] + above[1], below[2] + above[2], below[3] + above[3]];
            let mean = 0.25 * (marginal[0] + marginal[1] + marginal[2] + marginal[3]);
            let mass = (x[1] - x[0]) * mean + segment(x, c) * height * (rim_below + rim_above);
            let some = mean > 0.0;
            for i in 0..4 {
                self.marginal[i][k] = if some { marginal[i] } else { 0.0 };
                self.below[i][k] = if some { below[i] } else { 0.0 };
            }
            self.mass[k] = if some { mass } else { 0.0 };
        }
    }

    #[inline(always)]
    fn append<S: Transpose>(&self, s: S, pieces: &mut Vec<Piece>) {
        let [x, c] = [&self.x, &self.half_chord];
        for quad in 0..BLOCK / 4 {
            let four = |numbers: &Numbers| numbers.as_chunks::<4>().0[quad];
            let ends = s.transpose([four(&x[0]), four(&x[1]), four(&c[0]), four(&c[1])]);
            let marginal = s.transpose([0, 1, 2, 3].map(|i| four(&self.marginal[i])));
            let below = s.transpose([0, 1, 2, 3].map(|i| four(&self.below[i])));
            pieces.extend_from_slice(&[0, 1, 2, 3].map(|k| Piece {
                x: [ends[k][0], ends[k][1]],
                half_chord: [ends[k][2], ends[k][3]],
                marginal: marginal[k],
                below: below[k],
                column: self.cells[4 * quad + k],
                rows: [self.rows[0][4 * quad + k], self.rows[1][4 * quad + k]],
            }));
        }
    }
}

/// Copies the elements available from a position on.
#[inline(always)]
fn copy<T: Copy>(to: &mut [T; BLOCK], from: &[T], at: usize) {
    let from = from.get(at..).unwrap_or_default();
    match from.first_chunk() {
        Some(from) => *to = *from,
        None => to.iter_mut().zip(from).for_each(|(to, &from)| *to = from),
    }
}

impl Sides {
    /// `∫ f dy` from the end of the chord to the middle of the map along piece `k`, and the density
    /// at the rim.
    ///
    /// The integral is in cells.
    ///
    /// `end` is the end of the chord at either end of the piece, in cells.
    #[inline(always)]
    fn integral<const ABOVE: bool>(&self, k: usize, t: [f64; 2], end: [f64; 2], middle: f64) -> (Cubic, f64) {
        let begin = self.begin[k];
        let q = [unit(end[0] - begin), unit(end[1] - begin)];
        // The line of the cell that is nearer to the middle, or the middle itself if it is in the
        // cell.
        let inner = unit(middle - begin);
        let whole =
            [mix(self.whole[0][k], self.whole[1][k], t[0]), mix(self.whole[0][k], self.whole[1][k], t[1])];
        // The density at the beginning and end of the cell, at the beginning and end of the piece.
        let [left, right] = [0, 1].map(|side| [self.corners[side][0][k], self.corners[side][1][k]]);
        let first = [mix(left[0], right[0], t[0]), mix(left[1], right[1], t[0])];
        let last = [mix(left[0], right[0], t[1]), mix(left[1], right[1], t[1])];
        let along = |ends: [f64; 2], q: f64| mix(ends[0], ends[1], q);
        // A bilinear density is a quadratic along the straight rim. Its middle coefficient is the
        // mean of the crossed values.
        let rim = [along(first, q[0]), 0.5 * (along(first, q[1]) + along(last, q[0])), along(last, q[1])];
        let inside = [along(first, inner), along(last, inner)];
        let mean = [
            0.5 * (rim[0] + inside[0]),
            0.5 * (rim[1] + 0.5 * (inside[0] + inside[1])),
            0.5 * (rim[2] + inside[1]),
        ];
        let depth = if ABOVE {
            [unit(q[0] - inner), unit(q[1] - inner)]
        } else {
            [unit(inner - q[0]), unit(inner - q[1])]
        };
        let third = 1.0 / 3.0;
        let integral = [
            depth[0] * mean[0] + whole[0],
            (2.0 * (depth[0] * mean[1] + whole[0]) + (depth[1] * mean[0] + whole[1])) * third,
            ((depth[0] * mean[2] + whole[0]) + 2.0 * (depth[1] * mean[1] + whole[1])) * third,
            depth[1] * mean[2] + whole[1],
        ];
        (integral, 0.25 * (rim[0] + 2.0 * rim[1] + rim[2]))
    }
}

/// Clamps to [0, 1].
#[inline(always)]
fn unit(x: f64) -> f64 {
    let x = if x > 0.0 { x } else { 0.0 };
    if x < 1.0 { x } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::reconstruction::Reconstruction;
    use crate::map::texels::{Measure, columns_of_texels};
    use crate::numeric::bernstein::cubic;
    use asperity_core::assert_abs_diff_eq;

    fn value(columns: &Columns, x: f64, y: f64) -> f64 {
        let (kind, width, height) = (columns.kind, columns.width, columns.height);
        let (column, row) = (kind.cell(x, width), kind.cell(y, height));
        let along =
            |x: f64, n: usize, cell: usize| (x * n as f64 + kind.offset() - cell as f64).clamp(0.0, 1.0);
        let ([left, right], q) = (columns.at(column, row, 0).0, along(y, height, row));
        mix(mix(left[0], left[1], q), mix(right[0], right[1], q), along(x, width, column))
    }

    /// `∫ f dy` in cells between two positions, row by row: the density is linear in each.
    fn integral(columns: &Columns, x: f64, [from, to]: [f64; 2]) -> f64 {
        let (kind, height) = (columns.kind, columns.height);
        let rows = (0..kind.cells(height)).map(|row| {
            let [begin, end] = [row, row + 1].map(|line| kind.line(line, height).clamp(from, to));
            value(columns, x, 0.5 * (begin + end)) * (end - begin)
        });
        rows.sum::<f64>() * height as f64
    }

    #[test]
    fn marginals_are_integrals_over_the_chord() {
        for kind in [Reconstruction::Constant, Reconstruction::Bilinear] {
            for (width, height) in [(1, 1), (2, 3), (5, 4), (9, 16), (12, 7)] {
                let texels: Vec<f32> = (0..width * height).map(|k| ((k * 7 + 3) % 11) as f32).collect();
                let columns =
                    columns_of_texels(width, height, &texels, Measure::ProjectedSolidAngle, kind).unwrap();
                let breakpoints = Breakpoints::new(width, height, kind);
                let (pieces, masses) = pieces(&columns, &breakpoints);
                assert_eq!(
                    (pieces.len(), masses.len()),
                    (breakpoints.places.len() - 1, breakpoints.places.len() - 1)
                );
                for (piece, mass) in pieces.iter().zip(masses) {
                    for s in [0.25, 0.75] {
                        let x = piece.x[0] + s * (piece.x[1] - piece.x[0]);
                        let c = mix(piece.half_chord[0], piece.half_chord[1], s);
                        let below = integral(&columns, x, [0.5 - c, 0.5]);
                        let above = integral(&columns, x, [0.5, 0.5 + c]);
                        // Next to a grid line the chord may end in the neighboring row, by
                        // rounding.
                        let parts = [piece.below, piece.marginal].map(|part| cubic(part, s));
                        for (part, expected) in parts.into_iter().zip([below, below + above]) {
                            assert_abs_diff_eq!(
                                part,
                                expected,
                                epsilon = 1e-11,
                                "{kind:?} {width} × {height}"
                            );
                        }
                    }
                    let mean = 0.25 * piece.marginal.iter().sum::<f64>() * (piece.x[1] - piece.x[0]);
                    // Half the density at both rims, at most 10, over the segments.
                    let beyond = 20.0 * height as f64 * segment(piece.x, piece.half_chord);
                    assert!(
                        (mean..=mean + beyond + 1e-16).contains(&mass),
                        "{kind:?} {width} × {height}: {mass}"
                    );
                }
            }
        }
    }
}
