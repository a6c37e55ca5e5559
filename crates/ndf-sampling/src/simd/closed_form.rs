//! Closed forms of densities over arrays, at any SIMD level.

use crate::batch_error::BatchError;
use crate::ndf::Ndf;
use crate::simd::dispatch::{Kernel, Level};
use crate::simd::lanes::Lanes;

/// The closed forms of a density, in lanes; sealed.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no closed form in SIMD lanes",
    note = "`Ggx` and `Beckmann` have; call other densities one by one"
)]
pub trait ClosedForm: Ndf {
    #[doc(hidden)]
    fn normal<S: Lanes>(&self, s: S, z: [S::F; 2]) -> [S::F; 3];
    #[doc(hidden)]
    fn gaussian<S: Lanes>(&self, s: S, m: [S::F; 3]) -> [S::F; 2];
    #[doc(hidden)]
    fn density_in_lanes<S: Lanes>(&self, s: S, m: [S::F; 3]) -> S::F;
    #[doc(hidden)]
    fn polar<S: Lanes>(&self, s: S, u: [S::F; 2]) -> [S::F; 3];
    /// For `[v_x, v_y, v_z, u₁, u₂]`.
    #[doc(hidden)]
    fn visible<S: Lanes>(&self, s: S, view: [S::F; 5]) -> [S::F; 3];
}

/// `T`.
pub(crate) struct Normal<'a, N>(pub(crate) &'a N);
/// `T⁻¹`.
pub(crate) struct Coordinates<'a, N>(pub(crate) &'a N);
/// `D`.
pub(crate) struct Density<'a, N>(pub(crate) &'a N);
/// The polar map.
pub(crate) struct Sample<'a, N>(pub(crate) &'a N);
/// Visible normals.
pub(crate) struct Visible<'a, N>(pub(crate) &'a N);

impl<N: ClosedForm> Kernel<2, 3> for Normal<'_, N> {
    #[inline(always)]
    fn apply<S: Lanes>(&self, s: S, z: [S::F; 2]) -> [S::F; 3] {
        self.0.normal(s, z)
    }
}

impl<N: ClosedForm> Kernel<3, 2> for Coordinates<'_, N> {
    #[inline(always)]
    fn apply<S: Lanes>(&self, s: S, m: [S::F; 3]) -> [S::F; 2] {
        self.0.gaussian(s, m)
    }
}

impl<N: ClosedForm> Kernel<3, 1> for Density<'_, N> {
    #[inline(always)]
    fn apply<S: Lanes>(&self, s: S, m: [S::F; 3]) -> [S::F; 1] {
        [self.0.density_in_lanes(s, m)]
    }
}

impl<N: ClosedForm> Kernel<2, 3> for Sample<'_, N> {
    #[inline(always)]
    fn apply<S: Lanes>(&self, s: S, u: [S::F; 2]) -> [S::F; 3] {
        self.0.polar(s, u)
    }
}

impl<N: ClosedForm> Kernel<5, 3> for Visible<'_, N> {
    #[cfg(feature = "simd")]
    const LONG: bool = true;

    #[inline(always)]
    fn apply<S: Lanes>(&self, s: S, view: [S::F; 5]) -> [S::F; 3] {
        self.0.visible(s, view)
    }
}

impl Level {
    /// [`Ggx::normals`](crate::Ggx::normals) at this level.
    ///
    /// # Errors
    /// Arrays of different lengths; nothing is written then.
    pub fn normals<N: ClosedForm>(
        self,
        ndf: &N,
        z: [&[f32]; 2],
        m: [&mut [f32]; 3],
    ) -> Result<(), BatchError> {
        BatchError::check(&[("z", &z)], ("m", &m)).map(|()| self.run(&Normal(ndf), z, m))
    }

    /// [`Ggx::coordinates`](crate::Ggx::coordinates) at this level.
    ///
    /// # Errors
    /// Arrays of different lengths; nothing is written then.
    pub fn coordinates<N: ClosedForm>(
        self,
        ndf: &N,
        m: [&[f32]; 3],
        z: [&mut [f32]; 2],
    ) -> Result<(), BatchError> {
        BatchError::check(&[("m", &m)], ("z", &z)).map(|()| self.run(&Coordinates(ndf), m, z))
    }

    /// [`Ggx::densities`](crate::Ggx::densities) at this level.
    ///
    /// # Errors
    /// Arrays of different lengths; nothing is written then.
    pub fn densities<N: ClosedForm>(
        self,
        ndf: &N,
        m: [&[f32]; 3],
        density: &mut [f32],
    ) -> Result<(), BatchError> {
        let density = [density];
        BatchError::check(&[("m", &m)], ("density", &density)).map(|()| self.run(&Density(ndf), m, density))
    }

    /// [`Ggx::samples`](crate::Ggx::samples) at this level.
    ///
    /// # Errors
    /// Arrays of different lengths; nothing is written then.
    pub fn samples<N: ClosedForm>(
        self,
        ndf: &N,
        u: [&[f32]; 2],
        m: [&mut [f32]; 3],
    ) -> Result<(), BatchError> {
        BatchError::check(&[("u", &u)], ("m", &m)).map(|()| self.run(&Sample(ndf), u, m))
    }

    /// [`Ggx::visible_samples`](crate::Ggx::visible_samples) at this level.
    ///
    /// # Errors
    /// Arrays of different lengths; nothing is written then.
    pub fn visible_samples<N: ClosedForm>(
        self,
        ndf: &N,
        v: [&[f32]; 3],
        u: [&[f32]; 2],
        m: [&mut [f32]; 3],
    ) -> Result<(), BatchError> {
        BatchError::check(&[("v", &v), ("u", &u)], ("m", &m))
            .map(|()| self.run(&Visible(ndf), [v[0], v[1], v[2], u[0], u[1]], m))
    }
}

#[cfg(test)]
mod tests {
    use crate::{BatchError, Ggx};

    #[test]
    fn arrays_of_different_lengths_are_refused() {
        let ggx = Ggx::isotropic(0.5).unwrap();
        let [mut x, mut y, mut z] = [[7.0; 4], [7.0; 4], [7.0; 4]];
        let error = ggx.normals([&[0.0; 4]; 2], [&mut x, &mut y[..3], &mut z]).unwrap_err();
        assert_eq!(error, BatchError { parameter: "m", expected: 4, got: 3 });
        assert_eq!((x, y, z), ([7.0; 4], [7.0; 4], [7.0; 4]));
        let error = ggx.visible_samples([&x; 3], [&x, &x[1..]], [&mut y, &mut z, &mut []]).unwrap_err();
        assert_eq!(error, BatchError { parameter: "u", expected: 4, got: 3 });
        assert_eq!(ggx.densities([&[], &[], &[]], &mut []), Ok(()));
    }
}
