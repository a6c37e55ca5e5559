//! Arrays of samples of a packed map, in blocks, with the instructions that the machine has.

use crate::batch::BatchError;
use crate::packed::PackedMap;
use crate::reconstruction::Reconstruction;

/// Samples of a block: their searches and loads overlap.
const BLOCK: usize = 16;

impl PackedMap<'_> {
    /// `n = (M, C)⁻¹(u)`: the first two coordinates of normals, the third is √(1 − n_x² − n_y²).
    ///
    /// # Errors
    /// Arrays of different lengths; nothing is written then.
    pub fn fill_samples(&self, u: [&[f32]; 2], n: [&mut [f32]; 2]) -> Result<(), BatchError> {
        BatchError::check(&u, &n)?;
        match self.layout.kind {
            Reconstruction::Constant => fill(Samples::<1>(self), u, n),
            Reconstruction::Bilinear => fill(Samples::<2>(self), u, n),
        }
        Ok(())
    }

    /// `u = (M, C)(n)`: the uniform numbers of normals by their first two coordinates.
    ///
    /// # Errors
    /// Arrays of different lengths; nothing is written then.
    pub fn fill_forward(&self, n: [&[f32]; 2], u: [&mut [f32]; 2]) -> Result<(), BatchError> {
        BatchError::check(&n, &u)?;
        match self.layout.kind {
            Reconstruction::Constant => fill(Forward::<1>(self), n, u),
            Reconstruction::Bilinear => fill(Forward::<2>(self), n, u),
        }
        Ok(())
    }

    /// The densities `D` of normals by their first two coordinates, in sr⁻¹.
    ///
    /// # Errors
    /// Arrays of different lengths; nothing is written then.
    pub fn fill_density(&self, n: [&[f32]; 2], density: &mut [f32]) -> Result<(), BatchError> {
        let density = [density];
        BatchError::check(&n, &density)?;
        match self.layout.kind {
            Reconstruction::Constant => fill(Densities::<1>(self), n, density),
            Reconstruction::Bilinear => fill(Densities::<2>(self), n, density),
        }
        Ok(())
    }
}

/// What is done to a block.
trait Block<const OUT: usize>: Copy {
    fn apply<const N: usize>(self, inputs: [&[f32; N]; 2]) -> [[f32; N]; OUT];
}

#[derive(Clone, Copy)]
struct Samples<'a, const SIDES: usize>(&'a PackedMap<'a>);

#[derive(Clone, Copy)]
struct Forward<'a, const SIDES: usize>(&'a PackedMap<'a>);

#[derive(Clone, Copy)]
struct Densities<'a, const SIDES: usize>(&'a PackedMap<'a>);

impl<const SIDES: usize> Block<2> for Samples<'_, SIDES> {
    #[inline(always)]
    fn apply<const N: usize>(self, inputs: [&[f32; N]; 2]) -> [[f32; N]; 2] {
        self.0.inverse_block::<N, SIDES>(inputs)
    }
}

impl<const SIDES: usize> Block<2> for Forward<'_, SIDES> {
    #[inline(always)]
    fn apply<const N: usize>(self, inputs: [&[f32; N]; 2]) -> [[f32; N]; 2] {
        self.0.forward_block::<N, SIDES>(inputs)
    }
}

impl<const SIDES: usize> Block<1> for Densities<'_, SIDES> {
    #[inline(always)]
    fn apply<const N: usize>(self, inputs: [&[f32; N]; 2]) -> [[f32; N]; 1] {
        [self.0.density_block::<N, SIDES>(inputs)]
    }
}

/// Applies a block's work to arrays of one length.
fn fill<const OUT: usize>(block: impl Block<OUT>, inputs: [&[f32]; 2], outputs: [&mut [f32]; OUT]) {
    #[cfg(feature = "simd")]
    fearless_simd::dispatch!(crate::batch::best_level(), simd => {
        let _ = simd;
        each(block, inputs, outputs);
    });
    #[cfg(not(feature = "simd"))]
    each(block, inputs, outputs);
}

#[inline(always)]
fn each<const OUT: usize>(block: impl Block<OUT>, [x, y]: [&[f32]; 2], mut outputs: [&mut [f32]; OUT]) {
    let ((xs, x_rest), (ys, y_rest)) = (x.as_chunks::<BLOCK>(), y.as_chunks::<BLOCK>());
    for (k, (x, y)) in xs.iter().zip(ys).enumerate() {
        let results = block.apply([x, y]);
        for (output, result) in outputs.iter_mut().zip(&results) {
            if let Some(output) = output.get_mut(k * BLOCK..(k + 1) * BLOCK) {
                output.copy_from_slice(result);
            }
        }
    }
    if x_rest.is_empty() {
        return;
    }
    let mut padded = [[0.0; BLOCK]; 2];
    for (padded, rest) in padded.iter_mut().zip([x_rest, y_rest]) {
        for (to, from) in padded.iter_mut().zip(rest) {
            *to = *from;
        }
    }
    let results = block.apply([&padded[0], &padded[1]]);
    for (output, result) in outputs.iter_mut().zip(&results) {
        let rest = output.get_mut(xs.len() * BLOCK..).unwrap_or_default();
        for (to, from) in rest.iter_mut().zip(result) {
            *to = *from;
        }
    }
}
