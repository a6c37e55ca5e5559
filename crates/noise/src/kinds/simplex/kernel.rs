//! Simplex noise as a kind: at points, along rows, with its Hessian.

use crate::{
    contract::hessian::{CurvedKernel, Jet, mirror},
    contract::kernel::Kernel,
    kinds::simplex::geometry::{Term, first_corner, kernel, pull},
    kinds::simplex::rows::Sums,
    kinds::simplex::simplex::Simplex,
    lanes::lanes::{LaneSample, Lanes, Scalar},
    lattice::lattice::{Lattice, OnLattice},
    row::row::Strip,
};

impl<L: Lattice, const N: usize> CurvedKernel<N> for Simplex<L> {
    /// ∂ᵢⱼ(t⁴ s) = 48 dᵢ dⱼ t² s − 8 t³ (δᵢⱼ s + dᵢ gⱼ + dⱼ gᵢ).
    #[inline]
    fn near_jet(&self, p: [f32; N], seed: u32) -> Jet<N> {
        let corner = first_corner(Scalar, &p);
        let terms = self.terms(Scalar, &corner);
        let mut jet = Jet::ZERO;
        for k in 0..N + 1 {
            let Term { t, d, g, slope } = self.term(Scalar, &p, &corner, &terms, k, seed);
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
        }
        mirror(&mut jet.hessian);
        jet
    }
}

/// A block of code once for each of the N + 1 corners.
macro_rules! for_corners {
    ($n:ident, |$k:ident| $block:block) => {
        for_corners!(@ $n, $k, $block, 0 1 2 3 4)
    };
    (@ $n:ident, $k:ident, $block:block, $($corner:literal)*) => {
        $(if $corner < $n + 1 {
            let $k: usize = $corner;
            $block
        })*
    };
}

impl<L: Lattice, const N: usize> Kernel<N> for Simplex<L> {
    const REACH: f32 = 4_194_304.0;

    const SIMPLICIAL: bool = true;

    type RowScratch = Sums<N>;

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
    fn evaluate<S: Lanes, const GRADIENTS: bool>(&self, s: S, p: [S::F; N], seed: u32) -> LaneSample<S, N> {
        let corner = first_corner(s, &p);
        let terms = self.terms(s, &corner);
        let (mut value, mut gradient) = (s.float(0.0), [s.float(0.0); N]);
        // Written out, because a loop with such a body is not unrolled.
        for_corners!(N, |k| {
            let Term { t, d, g, slope } = self.term(s, &p, &corner, &terms, k, seed);
            let t4 = kernel(t);
            value = value + t4 * slope;
            if GRADIENTS {
                let pull = pull(s, t, slope);
                for axis in 0..N {
                    gradient[axis] = gradient[axis] + (g[axis] * t4 - d[axis] * pull);
                }
            }
        });
        (value, gradient)
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
