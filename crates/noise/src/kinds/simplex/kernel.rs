//! Simplex noise as a kind: at points, along rows, with its Hessian.

use crate::{
    contract::compiled::on_standard_lattice,
    contract::hessian::{CurvedKernel, Jet, mirror},
    contract::kernel::Kernel,
    kinds::simplex::geometry::{Term, kernel, pull},
    kinds::simplex::rows::Sums,
    kinds::simplex::simplex::Simplex,
    lanes::{LaneSample, Lanes, Scalar},
    lattice::lattice::{Lattice, OnLattice},
    row::row::Strip,
};

#[cfg(feature = "simd")]
use crate::{kinds::simplex::at_corners::around, lanes::level::four};

impl<L: Lattice, const N: usize> CurvedKernel<N> for Simplex<L> {
    /// ∂ᵢⱼ(t⁴ s) = 48 dᵢ dⱼ t² s − 8 t³ (δᵢⱼ s + dᵢ gⱼ + dⱼ gᵢ).
    #[inline]
    fn near_jet(&self, p: [f32; N], seed: u32) -> Jet<N> {
        #[cfg(feature = "simd")]
        if N > 1
            && let Some(s) = four()
        {
            return around::<_, _, N>(s, self, p, seed).jet(s);
        }
        one_by_one(self, p, seed)
    }
}

/// The jet of a point, corner by corner.
#[inline(always)]
fn one_by_one<L: Lattice, const N: usize>(noise: &Simplex<L>, p: [f32; N], seed: u32) -> Jet<N> {
    let mut jet = Jet::ZERO;
    noise.terms_at::<_, N, true>(
        Scalar,
        &p,
        seed,
        #[inline(always)]
        |Term { t, d, g, slope }| {
            let t2 = t * t;
            let (t3, t4) = (t2 * t, t2 * t2);
            jet.value += t4 * slope;
            let (pull, bend) = (8.0 * t3 * slope, 48.0 * t2 * slope);
            for i in 0..N {
                jet.gradient[i] += g[i] * t4 - d[i] * pull;
                for j in i..N {
                    let twist = 8.0 * t3 * (d[i] * g[j] + d[j] * g[i]);
                    jet.hessian[i][j] += bend * (d[i] * d[j]) - twist;
                }
                jet.hessian[i][i] -= pull;
            }
        },
    );
    jet.value = Scalar.within_one(jet.value);
    mirror(&mut jet.hessian);
    jet
}

impl<L: Lattice, const N: usize> Kernel<N> for Simplex<L> {
    const REACH: f32 = 4_194_304.0;

    const SIMPLICIAL: bool = true;

    type RowScratch = Sums<N>;

    on_standard_lattice!();

    const TILED: bool = L::TILED;

    const OCTAVES_IN_LANES: usize = if L::SHARED { 2 } else { usize::MAX };

    fn key(&self, seed: u32) -> u32 {
        self.lattice().key(seed)
    }

    /// Only on the line does the noise repeat with its lattice.
    fn period(&self, axis: usize) -> u32 {
        if N == 1 { Lattice::period(self.lattice(), axis) } else { 0 }
    }

    #[inline(always)]
    fn of_octave(&self, frequency: f32, cell: &[i32]) -> Option<Self> {
        OnLattice::of_octave(self, frequency, cell)
    }

    #[inline(always)]
    fn copied(&self) -> Option<Self> {
        self.lattice().copied().map(|lattice| self.on(lattice))
    }

    #[inline(always)]
    fn evaluate<S: Lanes, const GRADIENTS: bool>(&self, s: S, p: [S::F; N], seed: u32) -> LaneSample<S, N> {
        let (mut value, mut gradient) = (s.float(0.0), [s.float(0.0); N]);
        self.terms_at::<_, N, GRADIENTS>(
            s,
            &p,
            seed,
            #[inline(always)]
            |Term { t, d, g, slope }| {
                let t4 = kernel(t);
                value = value + t4 * slope;
                if GRADIENTS {
                    let pull = pull(s, t, slope);
                    for axis in 0..N {
                        gradient[axis] = gradient[axis] + (g[axis] * t4 - d[axis] * pull);
                    }
                }
            },
        );
        (s.within_one(value), gradient)
    }

    #[inline(always)]
    fn lone<const GRADIENTS: bool>(&self, p: [f32; N], seed: u32) -> LaneSample<Scalar, N> {
        #[cfg(feature = "simd")]
        if N > 1
            && let Some(s) = four()
        {
            return around::<_, _, N>(s, self, p, seed).sum::<GRADIENTS>(s);
        }
        self.evaluate::<Scalar, GRADIENTS>(Scalar, p, seed)
    }

    #[inline(always)]
    fn rows<S: Lanes, const GRADIENTS: bool>(
        &self,
        s: S,
        sums: &mut Sums<N>,
        strip: Strip<'_, N, GRADIENTS>,
    ) {
        sums.rows(s, self, strip);
    }
}

#[cfg(all(test, feature = "simd"))]
mod tests {
    use super::*;
    use crate::lattice::integer_hash::mix;

    fn same<const N: usize>(noise: &Simplex) {
        for i in 0..400 {
            let mut p = [0.0; N];
            for axis in 0..N {
                let word = mix(i * 4 + axis as u64) as i32;
                // Lattice points and diagonals, where axes are equally far along, and coordinates near and far.
                p[axis] = match i % 8 {
                    0 => (word >> 28) as f32,
                    1 => (mix(i) as i32 >> 20) as f32 / 256.0,
                    2 => word as f32 * 1e-4,
                    _ => word as f32 / 536_870_912.0,
                };
            }
            let (seed, lone) = (i as u32, Scalar);
            assert_eq!(noise.near_jet(p, seed), one_by_one(noise, p, seed), "{p:?}");
            assert_eq!(noise.lone::<true>(p, seed), noise.evaluate::<Scalar, true>(lone, p, seed), "{p:?}");
            let value = noise.lone::<false>(p, seed).0;
            assert_eq!(value, noise.evaluate::<Scalar, false>(lone, p, seed).0, "{p:?}");
        }
    }

    #[test]
    fn corners_in_lanes_have_the_bits_of_corners_one_by_one() {
        for noise in [Simplex::new(1), Simplex::wide(1)] {
            same::<2>(&noise);
            same::<3>(&noise);
            same::<4>(&noise);
        }
    }
}
