//! Noises on cells as kernels: at points and along rows.

use crate::{
    contract::compiled::on_lattice,
    contract::kernel::Kernel,
    kinds::cell::corner::{CellNoise, normalized},
    kinds::cell::corners::CellPosition,
    kinds::cell::rows::EdgeCache,
    lanes::{LaneSample, Lanes, Scalar, lane_of},
    lattice::lattice::Lattice,
    row::row::{Row, Strip},
};

#[cfg(feature = "simd")]
use crate::{kinds::cell::at_ends::by_corners, lanes::level::four};

/// n, and v if the noise is normalized, with their gradients if `GRADIENTS`.
#[inline(always)]
pub(crate) fn parts<K: CellNoise<N>, S: Lanes, const N: usize, const GRADIENTS: bool>(
    s: S,
    noise: &K,
    p: [S::F; N],
    seed: u32,
) -> (LaneSample<S, N>, LaneSample<S, N>) {
    let position = CellPosition::new(s, noise, &p, 0);
    position.parts::<K, GRADIENTS>(s, &position.drawn_edges(s, noise, seed))
}

/// A lane's value, and its gradient if `GRADIENTS`.
#[inline(always)]
pub(crate) fn of_lane<S: Lanes, const N: usize, const GRADIENTS: bool>(
    s: S,
    (value, gradient): LaneSample<S, N>,
    lane: usize,
) -> LaneSample<Scalar, N> {
    let slopes = if GRADIENTS { lane_of(s, &gradient, lane) } else { [0.0; N] };
    (s.lane(value, lane), slopes)
}

/// The step from which on sixteen lanes are faster than the reuse in rows, for words that are fast
/// to compute.
const LONG_STEP_OF_WIDE_LANES: f32 = 0.6;

impl<K: CellNoise<N>, const N: usize> Kernel<N> for K {
    const OCTAVES_IN_LANES: usize = match (<K::Lattice as Lattice>::SHARED, K::NORMALIZED) {
        (false, _) => usize::MAX,
        (true, false) => 3,
        // Its variates are looked up lane by lane, and unused lanes cost as much.
        (true, true) => 4,
    };

    // Variates are looked up lane by lane.
    const WIDE: bool = !K::NORMALIZED;

    type RowScratch = EdgeCache<N>;

    on_lattice!();

    #[inline(always)]
    fn evaluate<S: Lanes, const GRADIENTS: bool>(&self, s: S, p: [S::F; N], seed: u32) -> LaneSample<S, N> {
        let (sample, variance) = parts::<K, S, N, GRADIENTS>(s, self, p, seed);
        if K::NORMALIZED { normalized::<S, N, GRADIENTS>(s, sample, variance) } else { sample }
    }

    #[inline(always)]
    fn lone<const GRADIENTS: bool>(&self, p: [f32; N], seed: u32) -> LaneSample<Scalar, N> {
        #[cfg(feature = "simd")]
        if N > 1
            && let Some(s) = four()
        {
            return of_lane::<_, N, GRADIENTS>(s, by_corners::<K, _, N, GRADIENTS>(s, self, p, seed), 0);
        }
        self.evaluate::<Scalar, GRADIENTS>(Scalar, p, seed)
    }

    /// Rows of cells that are crossed by more than one row of points reuse edges.
    #[inline(always)]
    fn reuses(&self, row: &Row<N>, _: usize, wide: bool) -> bool {
        let longest = if wide && K::UPPER_BITS { LONG_STEP_OF_WIDE_LANES } else { 1.0 };
        row.stride().abs() < longest
    }

    #[inline(always)]
    fn rows<S: Lanes, const GRADIENTS: bool>(
        &self,
        s: S,
        stretch: &mut EdgeCache<N>,
        strip: Strip<'_, N, GRADIENTS>,
    ) -> usize {
        stretch.rows(s, self, strip)
    }
}
