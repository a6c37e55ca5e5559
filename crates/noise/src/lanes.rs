//! The lanes of `asperity-core` that noise kinds are written over, and the SIMD levels of a
//! machine.

pub(crate) use asperity_core::lanes::MAX_LANES as LANES;
pub(crate) use asperity_core::lanes::{Arithmetic, Floats, Lanes, Scalar};

pub(crate) mod level;

/// Numbers in every lane.
#[inline(always)]
pub(crate) fn splat<S: Lanes, const N: usize>(s: S, x: [f32; N]) -> [S::F; N] {
    let mut lanes = [s.float(0.0); N];
    for axis in 0..N {
        lanes[axis] = s.float(x[axis]);
    }
    lanes
}

/// The numbers in one lane.
#[inline(always)]
pub(crate) fn lane_of<S: Lanes, const N: usize>(s: S, x: &[S::F; N], lane: usize) -> [f32; N] {
    let mut numbers = [0.0; N];
    for axis in 0..N {
        numbers[axis] = s.lane(x[axis], lane);
    }
    numbers
}

/// A value in lanes, and its gradient.
pub(crate) type LaneSample<S, const N: usize> = (<S as Arithmetic>::F, [<S as Arithmetic>::F; N]);
