//! Simplex noise as a kernel: at points, with its Hessian.

use crate::{
    contract::compiled::on_standard_lattice,
    contract::hessian::{HessianKernel, Jet, mirror},
    contract::kernel::Kernel,
    kinds::simplex::geometry::{Term, kernel, pull},
    kinds::simplex::simplex::Simplex,
    lanes::{LaneSample, Lanes, Scalar},
    lattice::lattice::{Lattice, OnLattice},
};

impl<L: Lattice, const N: usize> HessianKernel<N> for Simplex<L> {
    /// ∂ᵢⱼ(t⁴ s) = 48 dᵢ dⱼ t² s − 8 t³ (δᵢⱼ s + dᵢ gⱼ + dⱼ gᵢ).
    #[inline]
    fn near_jet(&self, p: [f32; N], seed: u32) -> Jet<N> {
        let mut jet = Jet::ZERO;
        self.terms_at::<_, N, true>(
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
}

impl<L: Lattice, const N: usize> Kernel<N> for Simplex<L> {
    const REACH: f32 = 4_194_304.0;

    const SIMPLICIAL: bool = true;

    type RowScratch = ();

    on_standard_lattice!();

    const TILED: bool = L::TILED;

    const OCTAVES_IN_LANES: usize = if L::SHARED { 2 } else { usize::MAX };

    fn key(&self, seed: u32) -> u32 {
        self.lattice().key(seed)
    }

    /// The noise repeats with its lattice in 1-D only.
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
}
