//! Methods of a packed map for a single pair of numbers, and for arrays with the best available
//! SIMD level.

use glam::{Vec2, Vec3};

use crate::map::packed::block::{Staged, Work};
use crate::map::packed::cdf::Forward;
use crate::map::packed::density::Density;
use crate::map::packed::inverse_cdf::Inverse;
use crate::map::packed::packed_map::PackedMapRef;
use crate::map::reconstruction::Reconstruction;
use crate::ndf::Ndf;
use crate::numeric::normal_distribution::{gaussian_cdf, inverse_gaussian_cdf};
use asperity_core::BatchError;
use asperity_core::math;
use core::marker::PhantomData;

use asperity_core::lanes::{self, Lanes, Scalar, Task, Transpose};

/// Lanes of a group: the width of the longest register.
const LANES: usize = 16;
/// Groups of a block: the data of all stages fits the L1 cache together with the tables.
const GROUPS: usize = 4;

impl PackedMapRef<'_> {
    /// The first two coordinates of the normal `(M, C)⁻¹(u)`.
    #[inline]
    #[must_use]
    pub fn inverse(&self, u: Vec2) -> Vec2 {
        self.one::<Inverse, 2>(u).into()
    }

    /// The uniform numbers `(M, C)` of a normal from its first two coordinates, each in [0, 1].
    #[inline]
    #[must_use]
    pub fn forward(&self, n: Vec2) -> Vec2 {
        self.one::<Forward, 2>(n).into()
    }

    /// Computes the first two coordinates of normals `n = (M, C)⁻¹(u)`, like
    /// [`inverse`](Self::inverse).
    ///
    /// The third coordinate is √(1 − n_x² − n_y²).
    ///
    /// # Errors
    /// Arrays of different lengths. Nothing is written in this case.
    pub fn inverse_batch(&self, u: [&[f32]; 2], n: [&mut [f32]; 2]) -> Result<(), BatchError> {
        BatchError::check_all(&[("u", &u)], ("n", &n)).map(|()| self.many::<Inverse, 2>(u, n))
    }

    /// Computes uniform numbers `u = (M, C)(n)` of normals, like [`forward`](Self::forward).
    ///
    /// Normals are given by their first two coordinates.
    ///
    /// # Errors
    /// Arrays of different lengths. Nothing is written in this case.
    pub fn forward_batch(&self, n: [&[f32]; 2], u: [&mut [f32]; 2]) -> Result<(), BatchError> {
        BatchError::check_all(&[("n", &n)], ("u", &u)).map(|()| self.many::<Forward, 2>(n, u))
    }

    /// Computes densities `D` of normals from their first two coordinates, in sr⁻¹.
    ///
    /// # Errors
    /// Arrays of different lengths. Nothing is written in this case.
    pub fn d_batch(&self, n: [&[f32]; 2], density: &mut [f32]) -> Result<(), BatchError> {
        let density = [density];
        BatchError::check_all(&[("n", &n)], ("density", &density))
            .map(|()| self.many::<Density, 1>(n, density))
    }

    /// A function of one pair.
    #[inline(always)]
    fn one<K: Staged<OUT>, const OUT: usize>(&self, pair: Vec2) -> [f32; OUT] {
        let mut group = K::Group::<1>::ZERO;
        *group.input() = pair.to_array().map(|x| [x]);
        let groups = core::slice::from_mut(&mut group);
        match self.layout.kind {
            Reconstruction::Constant => K::apply::<_, 1, 1>(self, Scalar, groups),
            Reconstruction::Bilinear => K::apply::<_, 1, 2>(self, Scalar, groups),
        }
        let mut results = [0.0; OUT];
        for (result, [output]) in results.iter_mut().zip(group.output()) {
            *result = *output;
        }
        results
    }

    /// A function of arrays of equal length.
    fn many<K: Staged<OUT>, const OUT: usize>(&self, inputs: [&[f32]; 2], mut outputs: [&mut [f32]; OUT]) {
        if inputs[0].len() <= K::FEW {
            for (k, (&x, &y)) in inputs[0].iter().zip(inputs[1]).enumerate() {
                for (output, result) in outputs.iter_mut().zip(self.one::<K, OUT>(Vec2::new(x, y))) {
                    if let Some(output) = output.get_mut(k) {
                        *output = result;
                    }
                }
            }
            return;
        }
        lanes::run(inputs[0].len(), Fill::<K, OUT> { map: self, inputs, outputs, staged: PhantomData });
    }
}

/// A function of arrays of equal length.
struct Fill<'a, K, const OUT: usize> {
    map: &'a PackedMapRef<'a>,
    inputs: [&'a [f32]; 2],
    outputs: [&'a mut [f32]; OUT],
    staged: PhantomData<K>,
}

impl<K: Staged<OUT>, const OUT: usize> Task for Fill<'_, K, OUT> {
    type Output = ();

    #[inline(always)]
    fn run<S: Lanes + Transpose>(self, s: S) {
        fill::<S, K, OUT>(s, self.map, self.inputs, self.outputs);
    }
}

impl Ndf for PackedMapRef<'_> {
    #[inline]
    fn d(&self, m: Vec3) -> f32 {
        let [density] = self.one::<Density, 1>(m.truncate());
        if m.z > 0.0 { density } else { 0.0 }
    }

    /// `(M, C)⁻¹(u)`, without the detour through Gaussian numbers.
    #[inline]
    fn sample(&self, u: Vec2) -> Vec3 {
        let n = self.inverse(u);
        n.extend(math::sqrt((1.0 - n.x * n.x - n.y * n.y).max(1e-15)))
    }

    #[inline]
    fn warp_gaussian(&self, z: Vec2) -> Vec3 {
        let u = z.to_array().map(|z| if z.is_nan() { 0.5 } else { gaussian_cdf(f64::from(z)) as f32 });
        self.sample(Vec2::from(u))
    }

    #[inline]
    fn invert(&self, m: Vec3) -> Vec2 {
        const LEAST: f64 = 1.0 / (1u32 << 25) as f64;
        let u = self.forward(Vec2::new(m.x, m.y)).to_array();
        Vec2::from(u.map(|u| inverse_gaussian_cdf(f64::from(u).clamp(LEAST, 1.0 - LEAST)) as f32))
    }
}

/// A function of arrays of equal length, block by block.
#[inline(always)]
fn fill<P: Lanes, K: Staged<OUT>, const OUT: usize>(
    p: P,
    map: &PackedMapRef<'_>,
    [x, y]: [&[f32]; 2],
    mut outputs: [&mut [f32]; OUT],
) {
    // Short input does not wait for a whole block to be cleared.
    let (mut one, mut all);
    let groups: &mut [K::Group<LANES>] = if x.len() <= LANES {
        one = [K::Group::ZERO];
        &mut one
    } else {
        all = [K::Group::ZERO; GROUPS];
        &mut all
    };
    let mut done = 0;
    for (x, y) in x.chunks(LANES * GROUPS).zip(y.chunks(LANES * GROUPS)) {
        let groups = groups.get_mut(..x.len().div_ceil(LANES)).unwrap_or_default();
        for (axis, input) in [x, y].into_iter().enumerate() {
            let (whole, rest) = input.as_chunks();
            for (group, input) in groups.iter_mut().zip(whole) {
                group.input()[axis] = *input;
            }
            if let (Some(group), Some(first)) = (groups.last_mut(), rest.first()) {
                // Unused lanes repeat a used one.
                group.input()[axis] = [*first; LANES];
                copy(&mut group.input()[axis], rest);
            }
        }
        match map.layout.kind {
            Reconstruction::Constant => K::apply::<P, LANES, 1>(map, p, groups),
            Reconstruction::Bilinear => K::apply::<P, LANES, 2>(map, p, groups),
        }
        for (axis, output) in outputs.iter_mut().enumerate() {
            let (whole, rest) = output.get_mut(done..done + x.len()).unwrap_or_default().as_chunks_mut();
            for (group, output) in groups.iter().zip(whole) {
                *output = group.output()[axis];
            }
            if let (Some(group), false) = (groups.last(), rest.is_empty()) {
                copy(rest, &group.output()[axis]);
            }
        }
        done += x.len();
    }
}

/// Copies as many numbers as the shorter slice has.
#[cold]
fn copy(to: &mut [f32], from: &[f32]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = *from;
    }
}

#[cfg(all(test, feature = "alloc", feature = "simd"))]
mod tests {
    use super::*;
    use crate::NdfMap;
    use alloc::vec::Vec;
    use asperity_core::lanes::{Level, each_level, run_at};

    fn at_level<K: Staged<OUT>, const OUT: usize>(
        level: Level,
        map: &PackedMapRef<'_>,
        inputs: [&[f32]; 2],
        outputs: [&mut [f32]; OUT],
    ) {
        run_at(level, Fill::<K, OUT> { map, inputs, outputs, staged: PhantomData });
    }

    /// Numbers over the whole square and some invalid ones, in random order.
    fn pairs() -> [Vec<f32>; 2] {
        let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -0.5, 2.0, 0.0, -0.0, 1.0];
        let number = |k: u32| match k % 17 {
            0 => bad[k as usize / 17 % 8],
            _ => (k.wrapping_mul(0x9E37_79B9) >> 8) as f32 / 8_388_608.0 - 1.0,
        };
        [3, 1000].map(|from| (0..1111).map(|k| number(from + 5 * k)).collect())
    }

    #[test]
    fn arrays_are_bit_identical_to_single_calls_at_every_simd_level() {
        let [x, y] = pairs();
        // Smooth; with columns and rows without weight; rough.
        let images: [fn(Vec3) -> f32; 3] =
            [|n| n.z, |n| f32::from(n.x > 0.3 && n.y.abs() > 0.5), |n| (1e4 * n.x * n.y).sin().max(0.0)];
        let kinds = [Reconstruction::Constant, Reconstruction::Bilinear];
        for (image, kind) in images.into_iter().flat_map(|image| kinds.map(|kind| (image, kind))) {
            let array = NdfMap::from_fn(40, 33, crate::Measure::ProjectedSolidAngle, kind, image)
                .unwrap()
                .into_array();
            let map = PackedMapRef::new(&array).unwrap();
            let single = |k: usize| {
                let pair = Vec2::new(x[k], y[k]);
                let ([u, n], density) = ([map.forward(pair), map.inverse(pair)], map.one::<Density, 1>(pair));
                [n.x, n.y, u.x, u.y, density[0]].map(f32::to_bits)
            };
            let expected: Vec<_> = (0..x.len()).map(single).collect();
            each_level(|level| {
                for len in (0..70).chain([x.len()]) {
                    let from = len % 7 * usize::from(len < 70);
                    let pairs = [&x[from..from + len], &y[from..from + len]];
                    let mut got = [(); 5].map(|()| alloc::vec![0.0; len]);
                    let [a, b, c, d, e] = &mut got;
                    at_level::<Inverse, 2>(level, &map, pairs, [a, b]);
                    at_level::<Forward, 2>(level, &map, pairs, [c, d]);
                    at_level::<Density, 1>(level, &map, pairs, [e]);
                    for k in 0..len {
                        let got = got.each_ref().map(|results| results[k].to_bits());
                        assert_eq!(got, expected[from + k], "{level:?} {kind:?} {k} of {len}");
                    }
                }
            });
        }
    }
}
