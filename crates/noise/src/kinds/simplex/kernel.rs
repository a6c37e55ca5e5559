//! Simplex noise as a kind: at points, along rows, with its Hessian and its statistics.

use crate::{
    contract::hessian::{CurvedKernel, Jet, mirror},
    contract::kernel::{Kernel, Sealed},
    contract::noise::noise,
    kinds::simplex::geometry::{Term, first_corner, kernel, pull},
    kinds::simplex::rows::{Sums, rows},
    kinds::simplex::simplex::{Radius, Simplex},
    lanes::lanes::{LaneSample, Lanes, Scalar},
    lattice::lattice::Lattice,
    row::row::Row,
    statistics::absolute_moments,
    statistics::statistics::Statistics,
    statistics::tables,
};

noise!(Simplex, curved);

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

impl<L: Lattice, const N: usize> Sealed<N> for Simplex<L> {}

impl<L: Lattice, const N: usize> Kernel<N> for Simplex<L> {
    const REACH: f32 = 4_194_304.0;

    type RowScratch = Sums<N>;

    #[inline(always)]
    fn seed(&self) -> u32 {
        self.seed
    }

    #[inline(always)]
    fn lane_values<S: Lanes>(&self, s: S, p: [S::F; N], seed: u32) -> S::F {
        let corner = first_corner(s, &p);
        let terms = self.terms(s, &corner);
        let mut value = s.float(0.0);
        // Written out, because a loop with such a body is not unrolled.
        for_corners!(N, |k| {
            let Term { t, slope, .. } = self.term(s, &p, &corner, &terms, k, seed);
            value = value + kernel(t) * slope;
        });
        value
    }

    #[inline(always)]
    fn lane_samples<S: Lanes>(&self, s: S, p: [S::F; N], seed: u32) -> LaneSample<S, N> {
        let corner = first_corner(s, &p);
        let terms = self.terms(s, &corner);
        let (mut value, mut gradient) = (s.float(0.0), [s.float(0.0); N]);
        for_corners!(N, |k| {
            let Term { t, d, g, slope } = self.term(s, &p, &corner, &terms, k, seed);
            let (t4, pull) = (kernel(t), pull(s, t, slope));
            value = value + t4 * slope;
            for axis in 0..N {
                gradient[axis] = gradient[axis] + (g[axis] * t4 - d[axis] * pull);
            }
        });
        (value, gradient)
    }

    #[inline(always)]
    fn rows<S: Lanes, const GRADIENTS: bool>(
        &self,
        s: S,
        row: &Row<N>,
        seed: u32,
        scratch: &mut Sums<N>,
        values: &mut [f32],
        gradients: Option<&mut [&mut [f32]; N]>,
    ) {
        rows::<L, S, N, GRADIENTS>(s, self, row, seed, scratch, values, gradients);
    }

    fn statistics(&self) -> &'static Statistics {
        match self.radius() {
            Radius::Continuous => &tables::SIMPLEX_CONTINUOUS[N - 1],
            Radius::Wide => &tables::SIMPLEX_WIDE[N - 1],
        }
    }

    fn absolute_moments(&self) -> [f32; 4] {
        match self.radius() {
            Radius::Continuous => absolute_moments::SIMPLEX_CONTINUOUS[N - 1],
            Radius::Wide => absolute_moments::SIMPLEX_WIDE[N - 1],
        }
    }
}
