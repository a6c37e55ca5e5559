//! Arrays of samples of a packed map, with the instructions that the machine has.

use crate::batch_error::BatchError;
use crate::map::packed::packed_map::PackedMapRef;
use crate::map::reconstruction::Reconstruction;
use crate::simd::gather::Gather;

impl PackedMapRef<'_> {
    /// First two coordinates of the normals `n = (M, C)⁻¹(u)`: [`inverse`](Self::inverse) of many. The third is √(1 − n_x² − n_y²).
    ///
    /// # Errors
    /// Arrays of different lengths; nothing is written then.
    pub fn inverses(&self, u: [&[f32]; 2], n: [&mut [f32]; 2]) -> Result<(), BatchError> {
        BatchError::check(&[("u", &u)], ("n", &n))?;
        match self.layout.kind {
            Reconstruction::Constant => fill(Samples::<1>(self), u, n),
            Reconstruction::Bilinear => fill(Samples::<2>(self), u, n),
        }
        Ok(())
    }

    /// Uniform numbers `u = (M, C)(n)` of normals by their first two coordinates: [`forward`](Self::forward) of many.
    ///
    /// # Errors
    /// Arrays of different lengths; nothing is written then.
    pub fn forwards(&self, n: [&[f32]; 2], u: [&mut [f32]; 2]) -> Result<(), BatchError> {
        BatchError::check(&[("n", &n)], ("u", &u))?;
        match self.layout.kind {
            Reconstruction::Constant => fill(Forward::<1>(self), n, u),
            Reconstruction::Bilinear => fill(Forward::<2>(self), n, u),
        }
        Ok(())
    }

    /// Densities `D` of normals by their first two coordinates, in sr⁻¹.
    ///
    /// # Errors
    /// Arrays of different lengths; nothing is written then.
    pub fn densities(&self, n: [&[f32]; 2], density: &mut [f32]) -> Result<(), BatchError> {
        let density = [density];
        BatchError::check(&[("n", &n)], ("density", &density))?;
        match self.layout.kind {
            Reconstruction::Constant => fill(Densities::<1>(self), n, density),
            Reconstruction::Bilinear => fill(Densities::<2>(self), n, density),
        }
        Ok(())
    }
}

/// A function of a pair of numbers, in lanes.
pub(crate) trait PairKernel<const OUT: usize>: Copy {
    fn apply<P: Gather<N>, const N: usize>(self, p: P, inputs: [P::F; 2]) -> [P::F; OUT];
}

#[derive(Clone, Copy)]
pub(crate) struct Samples<'a, const SIDES: usize>(pub(crate) &'a PackedMapRef<'a>);

#[derive(Clone, Copy)]
pub(crate) struct Forward<'a, const SIDES: usize>(pub(crate) &'a PackedMapRef<'a>);

#[derive(Clone, Copy)]
pub(crate) struct Densities<'a, const SIDES: usize>(pub(crate) &'a PackedMapRef<'a>);

impl<const SIDES: usize> PairKernel<2> for Samples<'_, SIDES> {
    #[inline(always)]
    fn apply<P: Gather<N>, const N: usize>(self, p: P, u: [P::F; 2]) -> [P::F; 2] {
        self.0.inverse_in::<P, N, SIDES>(p, u)
    }
}

impl<const SIDES: usize> PairKernel<2> for Forward<'_, SIDES> {
    #[inline(always)]
    fn apply<P: Gather<N>, const N: usize>(self, p: P, n: [P::F; 2]) -> [P::F; 2] {
        self.0.forward_in::<P, N, SIDES>(p, n)
    }
}

impl<const SIDES: usize> PairKernel<1> for Densities<'_, SIDES> {
    #[inline(always)]
    fn apply<P: Gather<N>, const N: usize>(self, p: P, n: [P::F; 2]) -> [P::F; 1] {
        [self.0.density_in::<P, N, SIDES>(p, n)]
    }
}

/// Applies work to arrays of one length.
fn fill<const OUT: usize>(work: impl PairKernel<OUT>, inputs: [&[f32]; 2], outputs: [&mut [f32]; OUT]) {
    #[cfg(feature = "simd")]
    fearless_simd::dispatch!(crate::simd::dispatch::best_level(), simd => {
        each(crate::simd::registers::EightLanes(simd), work, inputs, outputs);
    });
    #[cfg(not(feature = "simd"))]
    each(crate::simd::lanes::Scalar, work, inputs, outputs);
}

#[inline(always)]
fn each<P: Gather<N>, const N: usize, const OUT: usize>(
    p: P,
    work: impl PairKernel<OUT>,
    [x, y]: [&[f32]; 2],
    mut outputs: [&mut [f32]; OUT],
) {
    let ((xs, x_rest), (ys, y_rest)) = (x.as_chunks::<N>(), y.as_chunks::<N>());
    for (k, (x, y)) in xs.iter().zip(ys).enumerate() {
        let results = work.apply(p, [p.of_floats(x), p.of_floats(y)]);
        for (output, result) in outputs.iter_mut().zip(results) {
            if let Some(output) = output.get_mut(k * N..(k + 1) * N) {
                output.copy_from_slice(&p.floats(result));
            }
        }
    }
    if x_rest.is_empty() {
        return;
    }
    let results = work.apply(p, [p.load(x_rest), p.load(y_rest)]);
    for (output, result) in outputs.iter_mut().zip(results) {
        p.store(result, output.get_mut(xs.len() * N..).unwrap_or_default());
    }
}
