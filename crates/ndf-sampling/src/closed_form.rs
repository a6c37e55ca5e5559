//! NDFs in closed form over arrays, with SIMD.

use glam::Vec3;

use crate::coordinates::GaussianSplit;
use crate::ndf::Ndf;
use asperity_core::BatchError;
use asperity_core::lanes::{Arithmetic, Kernel, map};

/// An NDF with methods that fill arrays with SIMD.
///
/// Every array holds one component of many points. The trait is sealed.
///
/// Results agree with single calls within 1e-6. They have the same bits on every machine, for every
/// SIMD width and every feature. They are bit-identical to single calls except for visible normals
/// of [`Beckmann`](crate::Beckmann).
///
/// ```
/// use asperity_ndf_sampling::{ClosedForm, Ggx, Ndf, glam::{Vec2, Vec3}};
///
/// let (ggx, z) = (Ggx::new(0.2, 0.4)?, [[0.7, -0.1, 2.0], [-1.2, 0.0, 0.3]]);
/// let [mut x, mut y, mut up] = [[0.0; 3]; 3];
/// ggx.warp_gaussian_batch([&z[0], &z[1]], [&mut x, &mut y, &mut up])?;
/// assert_eq!(Vec3::new(x[0], y[0], up[0]), ggx.warp_gaussian(Vec2::new(0.7, -1.2)));
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no closed form in SIMD lanes",
    note = "`Ggx` and `Beckmann` have; call other densities one by one"
)]
pub trait ClosedForm: Formulas {
    /// Computes normals `T(z)` of Gaussian coordinates, like [`warp_gaussian`](Ndf::warp_gaussian).
    ///
    /// # Errors
    /// Arrays of different lengths. Nothing is written in this case.
    #[inline]
    fn warp_gaussian_batch(&self, z: [&[f32]; 2], m: [&mut [f32]; 3]) -> Result<(), BatchError> {
        BatchError::check_all(&[("z", &z)], ("m", &m)).map(|()| map(&Normal(self), z, m))
    }

    /// Computes Gaussian coordinates `T⁻¹(m)` of normals, like [`invert`](Ndf::invert).
    ///
    /// # Errors
    /// Arrays of different lengths. Nothing is written in this case.
    #[inline]
    fn invert_batch(&self, m: [&[f32]; 3], z: [&mut [f32]; 2]) -> Result<(), BatchError> {
        BatchError::check_all(&[("m", &m)], ("z", &z)).map(|()| map(&Coordinates(self), m, z))
    }

    /// Computes densities `D(m)` of normals, in sr⁻¹.
    ///
    /// # Errors
    /// Arrays of different lengths. Nothing is written in this case.
    #[inline]
    fn d_batch(&self, m: [&[f32]; 3], density: &mut [f32]) -> Result<(), BatchError> {
        let density = [density];
        BatchError::check_all(&[("m", &m)], ("density", &density)).map(|()| map(&Density(self), m, density))
    }

    /// Samples normals with density `D cos θ` over solid angle, for uniform `u` in [0, 1)².
    ///
    /// # Errors
    /// Arrays of different lengths. Nothing is written in this case.
    #[inline]
    fn sample_batch(&self, u: [&[f32]; 2], m: [&mut [f32]; 3]) -> Result<(), BatchError> {
        BatchError::check_all(&[("u", &u)], ("m", &m)).map(|()| map(&Sample(self), u, m))
    }

    /// Samples visible normals for the views `v` and uniform numbers `u`, one view each.
    ///
    /// Views as in [`Microfacet::sample_visible`](crate::Microfacet::sample_visible), of any length
    /// up to 10¹². For [`Beckmann`](crate::Beckmann) the fraction of slopes below the sample is `u`
    /// within 2e-6.
    ///
    /// # Errors
    /// Arrays of different lengths. Nothing is written in this case.
    #[inline]
    fn sample_visible_batch(
        &self,
        v: [&[f32]; 3],
        u: [&[f32]; 2],
        m: [&mut [f32]; 3],
    ) -> Result<(), BatchError> {
        let view = [v[0], v[1], v[2], u[0], u[1]];
        BatchError::check_all(&[("v", &v), ("u", &u)], ("m", &m)).map(|()| map(&Visible(self), view, m))
    }
}

/// The formulas of an NDF in closed form, for every number of lanes.
pub trait Formulas: Ndf + Sized {
    fn normal<S: Arithmetic>(&self, s: S, z: [S::F; 2]) -> [S::F; 3];
    fn gaussian<S: Arithmetic>(&self, s: S, m: [S::F; 3]) -> [S::F; 2];
    fn density_in_lanes<S: Arithmetic>(&self, s: S, m: [S::F; 3]) -> [S::F; 1];
    /// `p_s(h | z_b)`.
    fn conditional<S: Arithmetic>(&self, s: S, split: GaussianSplit, h: [S::F; 3]) -> [S::F; 1];
    fn polar<S: Arithmetic>(&self, s: S, u: [S::F; 2]) -> [S::F; 3];
    /// For `[v_x, v_y, v_z, u₁, u₂]`.
    fn visible<S: Arithmetic>(&self, s: S, view: [S::F; 5]) -> [S::F; 3];
}

impl<N: Formulas> ClosedForm for N {}

/// Kernels of the formulas. A long one interleaves four registers, except in unoptimized builds:
/// there every temporary has its own stack slot, which overflows the 2 MiB stack of a thread.
macro_rules! kernels {
    ($($kernel:ident<$inputs:literal, $outputs:literal>: $formula:ident, long: $long:literal;)+) => {$(
        struct $kernel<'a, N>(&'a N);

        impl<N: Formulas> Kernel<$inputs, $outputs> for $kernel<'_, N> {
            const LONG: bool = $long && !cfg!(debug_assertions);

            #[inline(always)]
            fn apply<S: Arithmetic>(&self, s: S, x: [S::F; $inputs]) -> [S::F; $outputs] {
                self.0.$formula(s, x)
            }
        }
    )+};
}
kernels! {
    Normal<2, 3>: normal, long: false;
    Coordinates<3, 2>: gaussian, long: false;
    Density<3, 1>: density_in_lanes, long: false;
    Sample<2, 3>: polar, long: false;
    Visible<5, 3>: visible, long: true;
}

/// The kernel of [`Formulas::conditional`].
struct Conditional<'a, N>(&'a N, GaussianSplit);

impl<N: Formulas> Kernel<3, 1> for Conditional<'_, N> {
    #[inline(always)]
    fn apply<S: Arithmetic>(&self, s: S, h: [S::F; 3]) -> [S::F; 1] {
        self.0.conditional(s, self.1, h)
    }
}

/// [`Ndf::residual_ndf_batch`] with SIMD, up to the shorter slice.
pub(crate) fn residual_ndf_batch<N: Formulas>(
    ndf: &N,
    h: &[Vec3],
    split: GaussianSplit,
    densities: &mut [f32],
) {
    /// Half vectors whose components are transposed at a time.
    const BLOCK: usize = 32;
    // SIMD does not pay off for a single half vector.
    if let ([h], [density, ..]) | ([h, ..], [density]) = (h, &mut *densities) {
        *density = ndf.residual_ndf(*h, split);
        return;
    }
    for (h, densities) in h.chunks(BLOCK).zip(densities.chunks_mut(BLOCK)) {
        let len = h.len().min(densities.len());
        let (mut x, mut y, mut z) = ([0.0; BLOCK], [0.0; BLOCK], [0.0; BLOCK]);
        for (((x, y), z), h) in x.iter_mut().zip(&mut y).zip(&mut z).zip(h) {
            (*x, *y, *z) = (h.x, h.y, h.z);
        }
        map(&Conditional(ndf, split), [&x[..len], &y[..len], &z[..len]], [&mut densities[..len]]);
    }
}

#[cfg(test)]
mod tests {
    use super::Formulas;
    use crate::{BatchError, Beckmann, ClosedForm, Ggx};
    use asperity_core::lanes::Scalar;

    #[test]
    fn visible_normals_are_bit_identical_in_registers_and_single_lanes() {
        // One more than a whole number of registers. Single calls of Beckmann use a different form.
        let numbers = [f32::NAN, f32::INFINITY, -1.0, 0.0, 1e-40, 1e-3, 0.2, 0.7, 1.0];
        let arrays: [[f32; 4097]; 5] =
            core::array::from_fn(|axis| core::array::from_fn(|k| numbers[k / [1, 9, 81, 729, 2][axis] % 9]));
        let ([mut x, mut y, mut up], [v1, v2, v3, u1, u2]) = ([[0.0; 4097]; 3], &arrays);
        let beckmann = Beckmann::new(0.02, 0.5).unwrap();
        beckmann.sample_visible_batch([v1, v2, v3], [u1, u2], [&mut x, &mut y, &mut up]).unwrap();
        for k in 0..x.len() {
            let view = arrays.each_ref().map(|array| array[k]);
            let single = beckmann.visible(Scalar, view).map(f32::to_bits);
            assert_eq!([x[k], y[k], up[k]].map(f32::to_bits), single, "{view:?}");
        }
    }

    #[test]
    fn arrays_of_different_lengths_are_an_error() {
        let ggx = Ggx::isotropic(0.5).unwrap();
        let [mut x, mut y, mut z] = [[7.0; 4], [7.0; 4], [7.0; 4]];
        let error = ggx.warp_gaussian_batch([&[0.0; 4]; 2], [&mut x, &mut y[..3], &mut z]).unwrap_err();
        assert_eq!(Err(error), BatchError::check("m", 4, 3));
        assert_eq!((x, y, z), ([7.0; 4], [7.0; 4], [7.0; 4]));
        let error = ggx.sample_visible_batch([&x; 3], [&x, &x[1..]], [&mut y, &mut z, &mut []]).unwrap_err();
        assert_eq!(Err(error), BatchError::check("u", 4, 3));
        assert_eq!(ggx.d_batch([&[], &[], &[]], &mut []), Ok(()));
    }
}
