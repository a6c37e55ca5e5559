//! Simplex noise as a kind: at points, along rows, with its Hessian.

use crate::{
    contract::hessian::{CurvedKernel, Jet, mirror},
    contract::kernel::Kernel,
    kinds::simplex::geometry::{Term, kernel, pull},
    kinds::simplex::rows::Sums,
    kinds::simplex::simplex::Simplex,
    lanes::lanes::{LaneSample, Lanes, Scalar},
    lattice::lattice::{Lattice, OnLattice},
    row::row::Strip,
};

#[cfg(feature = "simd")]
use crate::{kinds::cell::blend::splat, kinds::simplex::geometry::first_corner, lanes::registers::four};

impl<L: Lattice, const N: usize> CurvedKernel<N> for Simplex<L> {
    /// ∂ᵢⱼ(t⁴ s) = 48 dᵢ dⱼ t² s − 8 t³ (δᵢⱼ s + dᵢ gⱼ + dⱼ gᵢ).
    #[inline]
    fn near_jet(&self, p: [f32; N], seed: u32) -> Jet<N> {
        let mut jet = Jet::ZERO;
        self.terms_at(
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
        mirror(&mut jet.hessian);
        jet
    }
}

#[cfg(feature = "simd")]
impl<L: Lattice> Simplex<L> {
    /// One point's value by four lanes, one for each corner, and the gradient if `GRADIENTS`; the bits of the lone lane's. In 4-D the
    /// last corner comes after them.
    #[inline(always)]
    fn by_corners<S: Lanes, const N: usize, const GRADIENTS: bool>(
        &self,
        s: S,
        p: [f32; N],
        seed: u32,
    ) -> LaneSample<Scalar, N> {
        let corner = first_corner(Scalar, &p);
        let (ranks, terms) = (corner.ranks(Scalar, &p), self.terms(Scalar, &corner));
        let (points, number) = (splat(s, p), s.real(s.iota()));
        // The axes of corner k are those of ranks from N − k on.
        let least = s.float(N as f32 - 0.5) - number;
        let (mut words, mut skewed) = ([s.word(0); N], points);
        for axis in 0..N {
            let ahead = s.less(least, s.float(ranks[axis]));
            let [low, high] = terms[axis];
            words[axis] = s.select_word(ahead, s.word(high.0), s.word(low.0));
            skewed[axis] = s.float(corner.skewed[axis]) + s.select(ahead, s.float(1.0), s.float(0.0));
        }
        let sum = s.float(corner.sum) + number;
        let term = self.term(s, &points, skewed, sum, self.lattice().upper_words(s, words, seed));
        let t4 = kernel(term.t);
        let (mut value, mut gradient) = (0.0, [0.0; N]);
        let parts = t4 * term.slope;
        for k in 0..(N + 1).min(4) {
            value += s.lane(parts, k);
        }
        if GRADIENTS {
            let pull = pull(s, term.t, term.slope);
            for axis in 0..N {
                let parts = term.g[axis] * t4 - term.d[axis] * pull;
                for k in 0..(N + 1).min(4) {
                    gradient[axis] += s.lane(parts, k);
                }
            }
        }
        if N == 4 {
            let (words, skewed) = (terms.map(|[_, high]| high), corner.skewed.map(|x| x + 1.0));
            let word = self.lattice().upper_words(Scalar, words, seed);
            let term = self.term(Scalar, &p, skewed, corner.sum + 4.0, word);
            let t4 = kernel(term.t);
            value += t4 * term.slope;
            if GRADIENTS {
                let pull = pull(Scalar, term.t, term.slope);
                for axis in 0..N {
                    gradient[axis] += term.g[axis] * t4 - term.d[axis] * pull;
                }
            }
        }
        (value, gradient)
    }
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
        let (mut value, mut gradient) = (s.float(0.0), [s.float(0.0); N]);
        self.terms_at(
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
        (value, gradient)
    }

    #[inline(always)]
    fn lone<const GRADIENTS: bool>(&self, p: [f32; N], seed: u32) -> LaneSample<Scalar, N> {
        #[cfg(feature = "simd")]
        if (N > 2 || (N == 2 && GRADIENTS))
            && let Some(s) = four()
        {
            return self.by_corners::<_, N, GRADIENTS>(s, p, seed);
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
