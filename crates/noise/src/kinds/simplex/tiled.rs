//! Tileable simplex noise in 3-D.

use crate::{
    contract::kernel::{Kernel, Measured},
    contract::noise::{Noise, noise},
    error::NoiseError,
    kinds::simplex::simplex::Simplex,
    lanes::{LaneSample, Lanes},
    lattice::integer_hash::IntegerHash,
    lattice::lattice::{Lattice, OnLattice, words_by_terms},
    lattice::tiled::{Tile, Tiled, octave_period, remainder},
    statistics::statistics::Statistics,
};

/// [`Simplex`] noise in 3-D with a period along each axis, a multiple of 3.
///
/// The corner of the simplicial lattice with skewed coordinates (i, j, k) is at x = i − (i + j +
/// k)/6, and so on. The step (4, 1, 1) moves by 3 along the x axis, so it maps the lattice onto
/// itself. The integers 6x, 6y and 6z identify a corner. Corners that agree modulo six periods get
/// the same word.
///
/// In 2-D and 4-D no step along an axis maps the lattice onto itself: x = i − (i + j)(3 − √3)/6 is
/// irrational unless i + j = 0.
///
/// - **Range, continuity:** as for [`Simplex`]. If p and p + period are exact in `f32` and below
///   2²², values and gradients have the same bits. Corners wrap from 2²⁸ on.
///
/// ```
/// use asperity_noise::{Field, Simplex, glam::Vec3};
///
/// let noise = Simplex::new(1).tiled([6, 3, 9])?;
/// let p = Vec3::new(1.25, -0.5, 2.0);
/// assert_eq!(noise.sample(p), noise.sample(p + Vec3::new(6.0, -3.0, 9.0)));
/// # Ok::<(), asperity_noise::NoiseError>(())
/// ```
#[doc(alias("seamless", "tileable", "periodic"))]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TiledSimplex<L = IntegerHash> {
    noise: Simplex<Corners<L>>,
    periods: [u32; 3],
}

impl<L: Clone> Tile<1> for Simplex<L> {
    type Tiled = Simplex<Tiled<L, 1>>;

    fn tiled(self, periods: [u32; 1]) -> Result<Self::Tiled, NoiseError> {
        let lattice = Tiled::new(self.lattice().clone(), periods)?;
        Ok(self.with_lattice(lattice))
    }
}

impl<L: Clone> Tile<3> for Simplex<L> {
    type Tiled = TiledSimplex<L>;

    fn tiled(self, periods: [u32; 3]) -> Result<Self::Tiled, NoiseError> {
        let Tiled { lattice, periods } = Tiled::new(self.lattice().clone(), periods)?;
        for (axis, period) in periods.into_iter().enumerate() {
            if period % 3 != 0 {
                return Err(NoiseError::PeriodMultiple { axis, period, factor: 3 });
            }
        }
        Ok(TiledSimplex { noise: self.with_lattice(Corners { lattice, periods }), periods })
    }
}

impl<L> TiledSimplex<L> {
    /// Sets the seed.
    #[must_use]
    pub fn with_seed(self, seed: u32) -> Self {
        Self { noise: self.noise.with_seed(seed), ..self }
    }

    /// Returns the period along each axis.
    #[must_use]
    pub const fn periods(&self) -> &[u32; 3] {
        &self.periods
    }
}

/// The simplicial lattice in 3-D; corners are identified by six times their coordinates modulo the
/// periods.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Corners<L> {
    lattice: L,
    periods: [u32; 3],
}

impl<L: Lattice + Clone> Lattice for Corners<L> {
    const TILED: bool = true;

    #[inline(always)]
    fn of_octave(&self, frequency: f32, _: &[i32]) -> Option<Self> {
        let periods = self.periods.map(|period| octave_period(period, frequency));
        Some(Self { lattice: self.lattice.clone(), periods })
    }

    words_by_terms!();

    #[inline(always)]
    fn words<S: Lanes, const N: usize>(&self, s: S, cell: [S::U; N], seed: u32) -> S::U {
        self.lattice.words(s, self.terms_of(s, cell), seed)
    }

    #[inline(always)]
    fn upper_words<S: Lanes, const N: usize>(&self, s: S, cell: [S::U; N], seed: u32) -> S::U {
        self.lattice.upper_words(s, self.terms_of(s, cell), seed)
    }
}

impl<L: Lattice> Corners<L> {
    /// The terms of corners, moved by whole periods into the first tile.
    #[inline(always)]
    fn terms_of<S: Lanes, const N: usize>(&self, s: S, cell: [S::U; N]) -> [S::U; N] {
        let mut sum = cell[0];
        for axis in 1..N {
            sum = sum + cell[axis];
        }
        let mut terms = cell;
        for axis in 0..N {
            let corner = cell[axis] * s.word(6) - sum;
            let corner = remainder(s, corner, 6 * self.periods[axis % 3]);
            terms[axis] = self.lattice.term(s, axis, corner);
        }
        terms
    }
}

impl<L> TiledSimplex<L> {
    /// Points moved by whole periods into the first tile, so that all tiles have the same bits.
    #[inline(always)]
    fn in_first_tile<S: Lanes>(&self, s: S, p: [S::F; 3]) -> [S::F; 3] {
        let mut q = p;
        for axis in 0..3 {
            let period = s.float(self.periods[axis] as f32);
            q[axis] = p[axis] - period * s.floor(p[axis] / period);
        }
        q
    }
}

impl<L: Lattice + Clone> Kernel<3> for TiledSimplex<L> {
    const TILED: bool = true;

    type RowScratch = ();

    fn period(&self, axis: usize) -> u32 {
        self.periods.get(axis).copied().unwrap_or(0)
    }

    #[inline(always)]
    fn of_octave(&self, frequency: f32, cell: &[i32]) -> Option<Self> {
        let noise = OnLattice::of_octave(&self.noise, frequency, cell)?;
        Some(Self { noise, periods: self.periods.map(|period| octave_period(period, frequency)) })
    }

    #[inline(always)]
    fn evaluate<S: Lanes, const GRADIENTS: bool>(&self, s: S, p: [S::F; 3], seed: u32) -> LaneSample<S, 3> {
        self.noise.evaluate::<S, GRADIENTS>(s, self.in_first_tile(s, p), seed)
    }
}

impl<L> Measured<3> for TiledSimplex<L> {
    fn seed(&self) -> u32 {
        Measured::<3>::seed(&self.noise)
    }

    fn statistics(&self) -> &'static Statistics {
        Measured::<3>::statistics(&self.noise)
    }
}

noise!(TiledSimplex, [], 3, Clone);

impl<L> Noise for TiledSimplex<L> {
    fn statistics(&self, dimension: usize) -> &'static Statistics {
        Noise::statistics(&self.noise, dimension)
    }

    fn with_seed(self, seed: u32) -> Self {
        Self::with_seed(self, seed)
    }
}
