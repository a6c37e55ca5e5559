//! Inputs common to all contenders of a row: one grid, one set of points.

use std::hint::black_box;

use crate::row::Order;

/// The seed of every noise.
pub(crate) const SEED: u32 = 1;

/// Points per pass over arbitrary points and single calls.
pub(crate) const POINTS: usize = 1 << 14;

/// Step of finite differences for libraries without derivatives, in lattice cells.
pub(crate) const DIFFERENCE: f32 = 1.0 / 1024.0;

/// Side of the cube around the origin that contains arbitrary points.
const CUBE: f32 = 2000.0;

/// A grid in lattice cells; axis 0 varies fastest.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid<const N: usize> {
    pub(crate) origin: [f32; N],
    pub(crate) step: f32,
    pub(crate) size: [usize; N],
}

impl<const N: usize> Grid<N> {
    /// Creates a grid of 512 × 512 or 64 × 64 × 64 samples, both 2¹⁸. It contains the origin, with
    /// points on both sides of every axis.
    pub(crate) fn new(step: f32) -> Self {
        let side = if N == 2 { 512 } else { 64 };
        let mut origin = [0.0; N];
        for (axis, start) in origin.iter_mut().enumerate() {
            *start = -0.37 * side as f32 * step - 0.137 * axis as f32;
        }
        Self { origin: black_box(origin), step: black_box(step), size: black_box([side; N]) }
    }

    /// Returns the number of samples of the grid.
    pub(crate) fn samples(&self) -> usize {
        self.size.iter().product()
    }

    /// Returns this grid shifted by a vector.
    pub(crate) fn moved(self, by: [f32; N]) -> Self {
        Self { origin: std::array::from_fn(|axis| self.origin[axis] + by[axis]), ..self }
    }
}

/// Returns the number of samples of one pass.
pub(crate) fn samples<const N: usize>(order: Order) -> usize {
    if order == Order::Grid { Grid::<N>::new(1.0).samples() } else { POINTS }
}

/// Returns arbitrary points, one array per coordinate.
pub(crate) fn points<const N: usize>() -> [Vec<f32>; N] {
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    let mut next = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((state >> 40) as f32 / (1 << 24) as f32 - 0.5) * CUBE
    };
    std::array::from_fn(|_| (0..POINTS).map(|_| next()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grids_have_equal_sample_counts_and_contain_the_origin() {
        let (plane, space) = (Grid::<2>::new(0.05), Grid::<3>::new(0.05));
        assert_eq!((plane.samples(), space.samples()), (1 << 18, 1 << 18));
        for axis in 0..3 {
            let end = space.origin[axis] + 64.0 * space.step;
            assert!(space.origin[axis] < 0.0 && end > 0.0, "axis {axis}");
        }
        assert_eq!(space.moved([0.0, 0.5, 0.0]).origin[1], space.origin[1] + 0.5);
    }

    #[test]
    fn points_fill_the_cube() {
        let [x, y] = points::<2>();
        for axis in [x, y] {
            assert!(axis.iter().all(|x| x.abs() <= 1000.0));
            let mean = axis.iter().sum::<f32>() / POINTS as f32;
            // Standard error 577 / √16384 = 4.5.
            assert!(mean.abs() < 20.0, "{mean}");
        }
    }
}
