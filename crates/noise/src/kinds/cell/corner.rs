//! Noises that blend one linear function per corner of a cell: gradient, value, value-gradient and
//! Gaussian noise.
//!
//! Corners are blended first along the third axis and later axes, which leaves four columns. The
//! columns are blended along the first axis, which leaves two edges, and the edges along the second
//! axis. Rows of a grid that cross the same cells can therefore reuse edges.
//!
//! ```text
//! column   C = c + a x + b y,                       x, y from the column
//! edge     E = e + f y,   e = lerp(c₀ + a₀ t, c₁ + a₁ (t − 1), w(t)),   f = lerp(b₀, b₁, w(t))
//! cell     n = lerp(e₀ + f₀ u, e₁ + f₁ (u − 1), w(u))
//! ```

use crate::{
    contract::compiled::Compiled,
    contract::kernel::Measured,
    kinds::cell::column::Column,
    lanes::{LaneSample, Lanes},
    lattice::fade::{Along, Fade},
    lattice::lattice::OnLattice,
};

/// The linear function of a corner: its value at the corner and its gradient.
#[derive(Clone, Copy)]
pub(crate) struct Corner<S: Lanes, const N: usize> {
    pub(crate) value: S::F,
    pub(crate) gradient: [S::F; N],
}

impl<S: Lanes, const N: usize> Corner<S, N> {
    #[inline(always)]
    pub(crate) fn nothing(s: S) -> Self {
        Self { value: s.float(0.0), gradient: [s.float(0.0); N] }
    }
}

/// A noise defined by values and gradients at the corners of cells, and by their blend.
pub(crate) trait CellNoise<const N: usize>: OnLattice + Measured<N> {
    /// The noise on the standard lattice.
    type Standard: CellNoise<N> + Compiled<N>;

    /// The noise with the same seed and parameters on the standard lattice.
    fn standard(&self) -> Self::Standard;

    /// Whether only the upper bits of a corner's word are used.
    const UPPER_BITS: bool = false;
    /// Unit of the values of corners without gradients.
    const UNIT: f32 = 1.0;
    /// Whether values are clamped to [−1, 1], which rounded weights would exceed.
    const CLAMPED: bool = false;
    /// Whether corners have values other than 0.
    const HAS_VALUE: bool = true;
    /// Whether corners have gradients other than 0.
    const HAS_GRADIENT: bool = true;
    /// The weights.
    const FADE: Fade = Fade::Quintic;
    /// Whether the sum is divided by its standard deviation at the point, see
    /// [`GaussianNoise`](crate::GaussianNoise).
    const NORMALIZED: bool = false;

    fn corner<S: Lanes>(&self, s: S, word: S::U) -> Corner<S, N>;

    /// The column of the corners with these words, for kinds with a faster method than corner by
    /// corner.
    #[inline(always)]
    fn column<S: Lanes>(&self, s: S, along: &[Along<S>; N], words: &[S::U; 4]) -> Option<Column<S, N>> {
        let _ = (s, along, words);
        None
    }
}

/// n/√v, and its gradient if `GRADIENTS`.
#[inline(always)]
pub(crate) fn normalized<S: Lanes, const N: usize, const GRADIENTS: bool>(
    s: S,
    (value, gradient): LaneSample<S, N>,
    (v, dv): LaneSample<S, N>,
) -> LaneSample<S, N> {
    let inverse = s.float(1.0) / s.sqrt(v);
    let z = value * inverse;
    let mut dz = gradient;
    if GRADIENTS {
        let factor = z * (s.float(0.5) * inverse * inverse);
        for axis in 0..N {
            dz[axis] = gradient[axis] * inverse - factor * dv[axis];
        }
    }
    (z, dz)
}
