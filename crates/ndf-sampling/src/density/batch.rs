//! Normals by the thousand: closed forms in the lanes of a SIMD register.

use crate::batch_error::BatchError;
use crate::density::closed_form::{Coordinates, Density, InLanes, Kernel, Normal, Sample, Visible};
use crate::simd::dispatch::Level;
#[cfg(feature = "simd")]
use crate::simd::dispatch::best_level;
use crate::simd::lanes::{Lanes, Scalar};
#[cfg(feature = "simd")]
use crate::simd::{register_pair::Twice, registers::Wide};

/// Evaluates closed-form densities at many places at once; every array holds one component.
///
/// Results agree with the calls of [`Ndf`](crate::Ndf) within 1e-6 and have the same bits on every machine, in every number of
/// lanes and under every feature: sine, exponential and logarithm are made of sums, products, quotients and roots alone.
///
/// ```
/// use asperity_ndf_sampling::{Batch, Ggx, Ndf, glam::{Vec2, Vec3}};
///
/// let ggx = Ggx::new(0.2, 0.4)?;
/// let z = [[0.7, -0.1, 2.0], [-1.2, 0.0, 0.3]];
/// let [mut x, mut y, mut up] = [[0.0; 3]; 3];
/// Batch::new().from_gaussian(&ggx, [&z[0], &z[1]], [&mut x, &mut y, &mut up])?;
/// assert!(ggx.from_gaussian(Vec2::new(0.7, -1.2)).abs_diff_eq(Vec3::new(x[0], y[0], up[0]), 1e-6));
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Batch {
    wide: Option<Level>,
}

impl Default for Batch {
    fn default() -> Self {
        Self::new()
    }
}

impl Batch {
    /// As many lanes as this machine has; without `std`, as the program was built for; one without the feature `simd`.
    #[must_use]
    pub fn new() -> Self {
        #[cfg(feature = "simd")]
        let wide = Some(best_level());
        #[cfg(not(feature = "simd"))]
        let wide = None;
        Self { wide }
    }

    /// One lane: the same bits, to be compared with.
    #[must_use]
    pub const fn scalar() -> Self {
        Self { wide: None }
    }

    /// The normals `T(z)` of Gaussian coordinates.
    ///
    /// # Errors
    /// Arrays of different lengths; nothing is written then.
    pub fn from_gaussian<N: InLanes>(
        self,
        ndf: &N,
        z: [&[f32]; 2],
        m: [&mut [f32]; 3],
    ) -> Result<(), BatchError> {
        self.run(&Normal(ndf), z, m)
    }

    /// The Gaussian coordinates `T⁻¹(m)` of normals.
    ///
    /// # Errors
    /// Arrays of different lengths; nothing is written then.
    pub fn to_gaussian<N: InLanes>(
        self,
        ndf: &N,
        m: [&[f32]; 3],
        z: [&mut [f32]; 2],
    ) -> Result<(), BatchError> {
        self.run(&Coordinates(ndf), m, z)
    }

    /// The densities `D(m)` of normals, in sr⁻¹.
    ///
    /// # Errors
    /// Arrays of different lengths; nothing is written then.
    pub fn density<N: InLanes>(self, ndf: &N, m: [&[f32]; 3], density: &mut [f32]) -> Result<(), BatchError> {
        self.run(&Density(ndf), m, [density])
    }

    /// The normals of uniform numbers `u` in [0, 1)², with the density `D cos θ` over solid angle.
    ///
    /// # Errors
    /// Arrays of different lengths; nothing is written then.
    pub fn sample<N: InLanes>(self, ndf: &N, u: [&[f32]; 2], m: [&mut [f32]; 3]) -> Result<(), BatchError> {
        self.run(&Sample(ndf), u, m)
    }

    /// Visible normals for the views `v` and the uniform numbers `u`, one view for each.
    ///
    /// Views as in [`Microfacet::sample_visible`](crate::Microfacet::sample_visible), of any length up to 10¹². For
    /// [`Beckmann`](crate::Beckmann) the share of slopes below the sample is `u` within 2e-6.
    ///
    /// # Errors
    /// Arrays of different lengths; nothing is written then.
    pub fn sample_visible<N: InLanes>(
        self,
        ndf: &N,
        v: [&[f32]; 3],
        u: [&[f32]; 2],
        m: [&mut [f32]; 3],
    ) -> Result<(), BatchError> {
        self.run(&Visible(ndf), [v[0], v[1], v[2], u[0], u[1]], m)
    }

    fn run<K: Kernel<I, O>, const I: usize, const O: usize>(
        self,
        kernel: &K,
        inputs: [&[f32]; I],
        outputs: [&mut [f32]; O],
    ) -> Result<(), BatchError> {
        BatchError::check(&inputs, &outputs)?;
        match self.wide {
            #[cfg(feature = "simd")]
            Some(level) => {
                fearless_simd::dispatch!(level, simd => {
                    let pair = Twice(Wide(simd));
                    if K::LONG {
                        fill(Twice(pair), kernel, inputs, outputs);
                    } else {
                        fill(pair, kernel, inputs, outputs);
                    }
                });
            }
            #[cfg(not(feature = "simd"))]
            Some(never) => match never {},
            None => fill(Scalar, kernel, inputs, outputs),
        }
        Ok(())
    }
}

/// Applies a kernel to arrays of one length, a register after the other.
#[inline(always)]
fn fill<S: Lanes, K: Kernel<I, O>, const I: usize, const O: usize>(
    s: S,
    kernel: &K,
    inputs: [&[f32]; I],
    mut outputs: [&mut [f32]; O],
) {
    let len = inputs.first().map_or(0, |input| input.len());
    let mut at = 0;
    while at + S::LEN <= len {
        let mut x = [s.float(0.0); I];
        for (x, input) in x.iter_mut().zip(&inputs) {
            if let Some(input) = input.get(at..at + S::LEN) {
                *x = s.load(input);
            }
        }
        let y = kernel.apply(s, x);
        for (y, output) in y.iter().zip(&mut outputs) {
            if let Some(output) = output.get_mut(at..at + S::LEN) {
                s.store(*y, output);
            }
        }
        at += S::LEN;
    }
    if at < len {
        let mut x = [s.float(0.0); I];
        for (x, input) in x.iter_mut().zip(&inputs) {
            *x = s.load(input.get(at..).unwrap_or_default());
        }
        let y = kernel.apply(s, x);
        for (y, output) in y.iter().zip(&mut outputs) {
            s.store(*y, output.get_mut(at..).unwrap_or_default());
        }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::Ggx;
    use std::string::ToString;

    #[test]
    fn arrays_of_other_lengths_are_refused_unwritten() {
        let ggx = Ggx::isotropic(0.3).unwrap();
        let (mut x, mut y, mut z) = ([9.0; 4], [9.0; 4], [9.0; 3]);
        let error =
            Batch::new().from_gaussian(&ggx, [&[0.0; 4], &[0.0; 4]], [&mut x, &mut y, &mut z]).unwrap_err();
        assert_eq!(error.to_string(), "array 4 must have the 4 elements of the first, got 3");
        assert_eq!((x, y, z), ([9.0; 4], [9.0; 4], [9.0; 3]));
    }

    #[test]
    fn nothing_is_done_for_nothing() {
        let ggx = Ggx::isotropic(0.3).unwrap();
        assert_eq!(Batch::new().density(&ggx, [&[], &[], &[]], &mut []), Ok(()));
    }
}
