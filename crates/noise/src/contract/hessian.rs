//! Second derivatives of kinds: value, gradient and Hessian from one evaluation.

use crate::{
    contract::kernel::{Kernel, evaluated},
    point::Point,
    sample::SampleHessian,
};

/// Value, gradient and Hessian by coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Jet<const N: usize> {
    pub(crate) value: f32,
    pub(crate) gradient: [f32; N],
    pub(crate) hessian: [[f32; N]; N],
}

impl<const N: usize> Jet<N> {
    pub(crate) const ZERO: Self = Self { value: 0.0, gradient: [0.0; N], hessian: [[0.0; N]; N] };

    pub(crate) fn at<V: Point<Coordinates = [f32; N], Matrix = [[f32; N]; N]>>(self) -> SampleHessian<V> {
        SampleHessian {
            value: self.value,
            gradient: V::from_coordinates(self.gradient),
            hessian: self.hessian,
        }
    }
}

/// A kind with second derivatives.
pub(crate) trait HessianKernel<const N: usize>: Kernel<N> {
    /// Value, gradient and Hessian at a point whose coordinates are at most 2³¹ in magnitude.
    fn near_jet(&self, p: [f32; N], seed: u32) -> Jet<N>;
}

/// Value, gradient and Hessian at any point.
#[inline]
pub(crate) fn at<K: HessianKernel<N> + ?Sized, const N: usize>(kernel: &K, p: [f32; N], seed: u32) -> Jet<N> {
    evaluated(p, K::REACH).map_or(Jet::ZERO, |p| kernel.near_jet(p, seed))
}

/// Copies the entries above the diagonal to below it.
pub(crate) fn mirror<const N: usize>(matrix: &mut [[f32; N]; N]) {
    for i in 0..N {
        for j in 0..i {
            matrix[i][j] = matrix[j][i];
        }
    }
}
