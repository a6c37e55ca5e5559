//! Lookups of many normals at once, in passes over short blocks that the compiler vectorizes.

use core::ops::Deref;

use glam::{Vec2, Vec3};

use crate::normal_table::chart::Chart;
use crate::normal_table::layout::TableEntry;
use crate::normal_table::spacing::Spacing;
use crate::normal_table::table::NormalLut;
use asperity_core::BatchError;

/// Normals per pass: their numbers fit the L1 cache next to the table.
const BLOCK: usize = 64;

impl<E: TableEntry, S: Deref<Target = [E]>> NormalLut<S> {
    /// [`NormalLut::nearest_normal`] of many coordinates at once, with the same results.
    ///
    /// # Errors
    /// Arrays of different lengths. Nothing is written in this case.
    pub fn nearest_normals(&self, z: [&[f32]; 2], m: [&mut [f32]; 3]) -> Result<(), BatchError> {
        BatchError::check_all(&[("z", &z)], ("m", &m))?;
        let table = self.view();
        table.in_blocks(z, m, |place| table.position(place), |x, y| table.nearest_point(x, y));
        Ok(())
    }

    /// [`NormalLut::bilinear_normal`] of many coordinates at once, with the same results.
    ///
    /// # Errors
    /// Arrays of different lengths. Nothing is written in this case.
    ///
    /// ```
    /// use asperity_ndf_sampling::{NormalLut, glam::{Vec2, Vec3}, normal_table::TableLayout};
    ///
    /// static FLASH: [[f32; 2]; 4] = [[-0.5, 0.0], [0.5, 0.0], [-0.5, 0.1], [0.5, 0.1]];
    /// let table = NormalLut::from_entries(2, TableLayout::default(), &FLASH)?;
    /// let (z1, z2) = ([0.3, -1.0, 2.0], [0.1, 0.7, -0.4]);
    /// let (mut x, mut y, mut z) = ([0.0; 3], [0.0; 3], [0.0; 3]);
    /// table.bilinear_normals([&z1, &z2], [&mut x, &mut y, &mut z])?;
    /// assert_eq!(Vec3::new(x[1], y[1], z[1]), table.bilinear_normal(Vec2::new(-1.0, 0.7)));
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    pub fn bilinear_normals(&self, z: [&[f32]; 2], m: [&mut [f32]; 3]) -> Result<(), BatchError> {
        BatchError::check_all(&[("z", &z)], ("m", &m))?;
        let table = self.view();
        table.in_blocks(z, m, |place| table.cell(table.position(place)), |x, y| table.bilinear_point(x, y));
        Ok(())
    }
}

impl<E: TableEntry> NormalLut<&'_ [E]> {
    /// Computes positions among the entries, points and normals in turn, each for a whole block.
    #[inline]
    fn in_blocks<P: Copy + Default>(
        self,
        [z1, z2]: [&[f32]; 2],
        [x, y, z]: [&mut [f32]; 3],
        position: impl Fn(f32) -> P,
        point: impl Fn(P, P) -> Vec2,
    ) {
        let mut positions = [[P::default(); BLOCK]; 2];
        let mut points = [[0.0_f32; BLOCK]; 2];
        let inputs = z1.chunks(BLOCK).zip(z2.chunks(BLOCK));
        let outputs = x.chunks_mut(BLOCK).zip(y.chunks_mut(BLOCK)).zip(z.chunks_mut(BLOCK));
        for ((z1, z2), ((x, y), z)) in inputs.zip(outputs) {
            let [columns, rows] = &mut positions;
            self.positions(z1, columns, &position);
            self.positions(z2, rows, &position);
            let [p, q] = &mut points;
            for (((&column, &row), p), q) in
                columns.iter().zip(&*rows).zip(&mut *p).zip(&mut *q).take(z1.len())
            {
                let point = point(column, row);
                (*p, *q) = (point.x, point.y);
            }
            self.normals(p, q, [x, y, z]);
        }
    }

    #[inline]
    fn positions<P>(self, z: &[f32], positions: &mut [P; BLOCK], position: impl Fn(f32) -> P) {
        // One loop for each spacing, so that the choice is made once.
        match self.layout().spacing {
            Spacing::Coordinates => fill(z, positions, |z| position(Spacing::Coordinates.place(z))),
            Spacing::Quantiles => fill(z, positions, |z| position(Spacing::Quantiles.place(z))),
            Spacing::Warped => fill(z, positions, |z| position(Spacing::Warped.place(z))),
        }
    }

    #[inline]
    fn normals(self, p: &[f32; BLOCK], q: &[f32; BLOCK], normals: [&mut [f32]; 3]) {
        let chart = self.layout().chart;
        // Points outside the chart are rare and need a branch. One test covers the block.
        if p.iter().zip(q).fold(true, |all, (&p, &q)| all & chart.holds(Vec2::new(p, q))) {
            match chart {
                Chart::Projected => normals_by(p, q, normals, |p| Chart::Projected.inside(p)),
                Chart::Slopes => normals_by(p, q, normals, |p| Chart::Slopes.inside(p)),
                Chart::Stereographic => normals_by(p, q, normals, |p| Chart::Stereographic.inside(p)),
            }
        } else {
            normals_by(p, q, normals, |p| chart.to_normal(p));
        }
    }
}

#[inline]
fn fill<P>(z: &[f32], positions: &mut [P; BLOCK], position: impl Fn(f32) -> P) {
    for (&z, place) in z.iter().zip(positions) {
        *place = position(z);
    }
}

#[inline]
fn normals_by(p: &[f32; BLOCK], q: &[f32; BLOCK], [x, y, z]: [&mut [f32]; 3], normal: impl Fn(Vec2) -> Vec3) {
    for ((((&p, &q), x), y), z) in p.iter().zip(q).zip(x).zip(y).zip(z) {
        let n = normal(Vec2::new(p, q));
        (*x, *y, *z) = (n.x, n.y, n.z);
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::normal_table::TableLayout;
    use std::vec::Vec;

    /// A table of 8 × 8 points inside and outside the disk, some of them NaN.
    fn points() -> Vec<[f32; 2]> {
        let wild = |k: u32| (k.wrapping_mul(0x9E37_79B9) >> 20) as f32 / 2048.0 - 1.0;
        let mut points: Vec<[f32; 2]> = (0..64).map(|k| [wild(2 * k), wild(2 * k + 1)]).collect();
        points[9] = [f32::NAN, 0.5];
        points[40] = [f32::INFINITY, 1e30];
        points
    }

    #[test]
    fn batches_equal_single_calls() {
        let entries = points();
        let z1: Vec<f32> = (0..333).map(|k| (k * 37 % 333) as f32 * 0.031 - 5.1).collect();
        let mut z2: Vec<f32> = z1.iter().rev().map(|z| 0.7 * z).collect();
        (z2[5], z2[70], z2[130]) = (f32::NAN, f32::INFINITY, -1e38);
        for spacing in [Spacing::Coordinates, Spacing::Quantiles, Spacing::Warped] {
            for chart in [Chart::Projected, Chart::Slopes, Chart::Stereographic] {
                let table = NormalLut::from_entries(8, TableLayout { spacing, chart }, &entries).unwrap();
                let mut n = [(); 3].map(|()| std::vec![0.0; 333]);
                let [x, y, z] = &mut n;
                table.bilinear_normals([&z1, &z2], [x, y, z]).unwrap();
                for k in 0..333 {
                    let expected = table.bilinear_normal(Vec2::new(z1[k], z2[k]));
                    assert_eq!(Vec3::new(n[0][k], n[1][k], n[2][k]), expected, "{spacing:?} {chart:?} {k}");
                }
                let [x, y, z] = &mut n;
                table.nearest_normals([&z1, &z2], [x, y, z]).unwrap();
                for k in 0..333 {
                    let expected = table.nearest_normal(Vec2::new(z1[k], z2[k]));
                    assert_eq!(Vec3::new(n[0][k], n[1][k], n[2][k]), expected, "{spacing:?} {chart:?} {k}");
                }
            }
        }
    }

    #[test]
    fn arrays_of_different_lengths_are_an_error() {
        let table = NormalLut::from_entries(1, TableLayout::default(), &[[0.5_f32, 0.0]]).unwrap();
        let [mut x, mut y, mut z] = [[7.0; 9]; 3];
        let refused = table.bilinear_normals([&[0.0; 9]; 2], [&mut x, &mut y[..8], &mut z]).unwrap_err();
        assert_eq!(Err(refused), BatchError::check("m", 9, 8));
        assert!(table.nearest_normals([&[0.0; 9], &[0.0; 8]], [&mut x, &mut y, &mut z]).is_err());
        assert_eq!([x, y, z], [[7.0; 9]; 3]);
        assert_eq!(table.nearest_normals([&[0.0; 9]; 2], [&mut x, &mut y, &mut z]), Ok(()));
        assert_eq!((x[8], y[8], z[8]), (0.8, 0.0, 0.6));
    }
}
