//! Calls of a packed map: of one pair of numbers, and of arrays with the instructions that the machine has.

use glam::{Vec2, Vec3};

use crate::batch_error::BatchError;
use crate::map::packed::cdf::{Density, Forward};
use crate::map::packed::fetch::PairKernel;
use crate::map::packed::inverse_cdf::Inverse;
use crate::map::packed::packed_map::PackedMapRef;
use crate::map::reconstruction::Reconstruction;
use crate::math;
use crate::ndf::Ndf;
use crate::numeric::normal_distribution::{inverse_phi, phi};
use crate::simd::gather::Gather;
use crate::simd::lanes::Scalar;

impl PackedMapRef<'_> {
    /// `(M, C)⁻¹(u)`: the first two coordinates of the normal.
    #[inline]
    #[must_use]
    pub fn inverse(&self, u: Vec2) -> Vec2 {
        self.one::<Inverse, 2>(u).into()
    }

    /// `(M, C)`: the uniform numbers of a normal by its first two coordinates, each in [0, 1].
    #[inline]
    #[must_use]
    pub fn forward(&self, n: Vec2) -> Vec2 {
        self.one::<Forward, 2>(n).into()
    }

    /// First two coordinates of the normals `n = (M, C)⁻¹(u)`: [`inverse`](Self::inverse) of many. The third is √(1 − n_x² − n_y²).
    ///
    /// # Errors
    /// Arrays of different lengths; nothing is written then.
    pub fn inverses(&self, u: [&[f32]; 2], n: [&mut [f32]; 2]) -> Result<(), BatchError> {
        BatchError::check(&[("u", &u)], ("n", &n)).map(|()| self.many::<Inverse, 2>(u, n))
    }

    /// Uniform numbers `u = (M, C)(n)` of normals by their first two coordinates: [`forward`](Self::forward) of many.
    ///
    /// # Errors
    /// Arrays of different lengths; nothing is written then.
    pub fn forwards(&self, n: [&[f32]; 2], u: [&mut [f32]; 2]) -> Result<(), BatchError> {
        BatchError::check(&[("n", &n)], ("u", &u)).map(|()| self.many::<Forward, 2>(n, u))
    }

    /// Densities `D` of normals by their first two coordinates, in sr⁻¹.
    ///
    /// # Errors
    /// Arrays of different lengths; nothing is written then.
    pub fn densities(&self, n: [&[f32]; 2], density: &mut [f32]) -> Result<(), BatchError> {
        let density = [density];
        BatchError::check(&[("n", &n)], ("density", &density)).map(|()| self.many::<Density, 1>(n, density))
    }

    /// A kernel of one pair.
    #[inline(always)]
    fn one<K: PairKernel<OUT>, const OUT: usize>(&self, pair: Vec2) -> [f32; OUT] {
        match self.layout.kind {
            Reconstruction::Constant => K::apply::<_, 1, 1>(self, Scalar, pair.to_array()),
            Reconstruction::Bilinear => K::apply::<_, 1, 2>(self, Scalar, pair.to_array()),
        }
    }

    /// A kernel of arrays of one length.
    fn many<K: PairKernel<OUT>, const OUT: usize>(&self, inputs: [&[f32]; 2], outputs: [&mut [f32]; OUT]) {
        match self.layout.kind {
            Reconstruction::Constant => fill::<K, OUT, 1>(self, inputs, outputs),
            Reconstruction::Bilinear => fill::<K, OUT, 2>(self, inputs, outputs),
        }
    }
}

impl Ndf for PackedMapRef<'_> {
    #[inline]
    fn density(&self, m: Vec3) -> f32 {
        let [density] = self.one::<Density, 1>(m.truncate());
        if m.z > 0.0 { density } else { 0.0 }
    }

    /// `(M, C)⁻¹(u)`, without the detour over Gaussian numbers.
    #[inline]
    fn sample(&self, u: Vec2) -> Vec3 {
        let n = self.inverse(u);
        n.extend(math::sqrt((1.0 - n.x * n.x - n.y * n.y).max(1e-15)))
    }

    #[inline]
    fn from_gaussian(&self, z: Vec2) -> Vec3 {
        let u = z.to_array().map(|z| if z.is_nan() { 0.5 } else { phi(f64::from(z)) as f32 });
        self.sample(Vec2::from(u))
    }

    #[inline]
    fn to_gaussian(&self, m: Vec3) -> Vec2 {
        const LEAST: f64 = 1.0 / (1u32 << 25) as f64;
        let u = self.forward(Vec2::new(m.x, m.y)).to_array();
        Vec2::from(u.map(|u| inverse_phi(f64::from(u).clamp(LEAST, 1.0 - LEAST)) as f32))
    }
}

fn fill<K: PairKernel<OUT>, const OUT: usize, const SIDES: usize>(
    map: &PackedMapRef<'_>,
    inputs: [&[f32]; 2],
    outputs: [&mut [f32]; OUT],
) {
    #[cfg(feature = "simd")]
    fearless_simd::dispatch!(crate::simd::dispatch::best_level(), simd => {
        each::<_, K, 8, OUT, SIDES>(crate::simd::registers::EightLanes(simd), map, inputs, outputs);
    });
    #[cfg(not(feature = "simd"))]
    each::<_, K, 1, OUT, SIDES>(Scalar, map, inputs, outputs);
}

#[inline(always)]
fn each<P: Gather<N>, K: PairKernel<OUT>, const N: usize, const OUT: usize, const SIDES: usize>(
    p: P,
    map: &PackedMapRef<'_>,
    [x, y]: [&[f32]; 2],
    mut outputs: [&mut [f32]; OUT],
) {
    let ((xs, x_rest), (ys, y_rest)) = (x.as_chunks::<N>(), y.as_chunks::<N>());
    for (k, (x, y)) in xs.iter().zip(ys).enumerate() {
        let results = K::apply::<P, N, SIDES>(map, p, [p.of_floats(x), p.of_floats(y)]);
        for (output, result) in outputs.iter_mut().zip(results) {
            if let Some(output) = output.get_mut(k * N..(k + 1) * N) {
                output.copy_from_slice(&p.floats(result));
            }
        }
    }
    if !x_rest.is_empty() {
        let results = K::apply::<P, N, SIDES>(map, p, [p.load(x_rest), p.load(y_rest)]);
        for (output, result) in outputs.iter_mut().zip(results) {
            p.store(result, output.get_mut(xs.len() * N..).unwrap_or_default());
        }
    }
}
