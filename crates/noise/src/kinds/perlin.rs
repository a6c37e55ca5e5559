//! Gradient noise on the integer lattice: Perlin noise of 1985 and 2002.

use crate::{
    contract::noise::{kind, measured, noise, tiles},
    kinds::cell::column::Column,
    kinds::cell::corner::{CellNoise, Corner},
    kinds::cell::edge_columns::edge_column,
    lanes::{Arithmetic, Lanes, Scalar},
    lattice::edges::{EDGE_MAXIMUM, Lengths, edge_direction},
    lattice::fade::{Along, Fade},
    lattice::integer_hash::IntegerHash,
    lattice::lattice::Lattice,
    lattice::variates::{MARGIN, UNIT_SCALE, unit_direction},
    statistics::tables,
};

/// Perlin noise of 1985: unit gradients uniform on the circle or sphere, cubic weights; C¹.
///
#[cfg_attr(doc, doc = include_str!("../../docs/pictures/perlin_1985.md"))]
///
/// ```text
/// n(p) = A Σ_c W_c(p) g_c·(p − c),   W = Π w or 1 − w,   w(t) = 3t² − 2t³
/// ```
///
/// In 1 to 4 dimensions; in 1-D a unit gradient is ±1.
///
/// - **Range:** [−1, 1]. A = 1/max Σ W_c |p − c| = 2/√n in n dimensions, attained in cell centers
///   within 2e-6.
/// - **Lattice points:** the value is 0 at every lattice point. The variance depends on the
///   position in the cell.
///
/// Perlin 1985, "An Image Synthesizer"; Ebert (ed.) 1994, "Texturing and Modeling".
///
/// ```
/// use asperity_noise::{Field, PerlinClassic, glam::Vec2};
///
/// assert_eq!(PerlinClassic::new(9).value(Vec2::new(3.0, -2.0)), 0.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PerlinClassic<L = IntegerHash> {
    seed: u32,
    lattice: L,
}

/// Perlin noise of 2002: gradients to the edges of a cube, quintic weights; C².
///
#[cfg_attr(doc, doc = include_str!("../../docs/pictures/perlin_2002.md"))]
///
/// The sum of [`PerlinClassic`] with w(t) = 6t⁵ − 15t⁴ + 10t³ and other gradients. In 3-D they are
/// the twelve (±1, ±1, 0) and its rotations, in 4-D the 32 of the form (0, ±1, ±1, ±1). In 2-D they
/// are the eight of length √2 at odd multiples of 22.5°, and in 1-D ±⅛ … ±1.
///
/// - **Range:** [−1, 1], attained within 2e-6; the scale is the inverse of the searched maximum.
///
/// Perlin 2002, "Improving Noise". There are two deviations. All twelve gradients are equally
/// likely, where Perlin repeats four to fill a table of sixteen. The range is normalized to
/// [−1, 1]. With [`PerlinTable`](crate::lattice::PerlinTable) neither deviation applies, and the
/// noise equals Perlin's up to its scale.
///
/// ```
/// use asperity_noise::{Field, Perlin, glam::Vec3};
///
/// let sample = Perlin::new(2).sample(Vec3::new(0.5, 0.5, 0.5));
/// assert!(sample.value.abs() <= 1.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Perlin<L = IntegerHash> {
    seed: u32,
    lattice: L,
}

kind!(PerlinClassic);
measured!(PerlinClassic, |self| &tables::PERLIN_1985);
noise!(PerlinClassic, curved);
tiles!(PerlinClassic);

impl PerlinClassic {
    /// Returns the unit gradient that the noise draws from a lattice point's
    /// [`word`](crate::Lattice::word), before scaling.
    ///
    /// It is uniform on the circle or sphere, and ±1 in 1-D. Its length is 1 within 2e-7.
    #[must_use]
    pub fn gradient<const N: usize>(word: u32) -> [f32; N] {
        unit_direction(Scalar, Scalar.word(word), 1.0)
    }
}

kind!(Perlin);
measured!(Perlin, |self| &tables::PERLIN_2002);
noise!(Perlin, curved);
tiles!(Perlin);

impl Perlin {
    /// Returns the gradient that the noise draws from a lattice point's
    /// [`upper_word`](crate::Lattice::upper_word), before scaling.
    ///
    /// [`Simplex`](crate::Simplex) draws the same gradients.
    #[must_use]
    pub fn gradient<const N: usize>(word: u32) -> [f32; N] {
        edge_direction(Scalar, Scalar.word(word), &const { Lengths::new(1.0) })
    }
}

/// The inverse of the searched maximum.
const SCALE_2002: [f32; 4] =
    [MARGIN / EDGE_MAXIMUM[0], MARGIN / EDGE_MAXIMUM[1], MARGIN / EDGE_MAXIMUM[2], MARGIN / EDGE_MAXIMUM[3]];

static LENGTHS_2002: [Lengths; 4] = [
    Lengths::new(SCALE_2002[0]),
    Lengths::new(SCALE_2002[1]),
    Lengths::new(SCALE_2002[2]),
    Lengths::new(SCALE_2002[3]),
];

impl<L: Lattice, const N: usize> CellNoise<N> for PerlinClassic<L> {
    type Standard = PerlinClassic;

    #[inline(always)]
    fn standard(&self) -> PerlinClassic {
        Self::standard(self)
    }

    const HAS_VALUE: bool = false;
    const FADE: Fade = Fade::Cubic;

    #[inline(always)]
    fn corner<S: Lanes>(&self, s: S, word: S::U) -> Corner<S, N> {
        Corner { value: s.float(0.0), gradient: unit_direction(s, word, UNIT_SCALE[N - 1]) }
    }
}

impl<L: Lattice, const N: usize> CellNoise<N> for Perlin<L> {
    type Standard = Perlin;

    #[inline(always)]
    fn standard(&self) -> Perlin {
        Self::standard(self)
    }

    const UPPER_BITS: bool = true;
    const HAS_VALUE: bool = false;

    #[inline(always)]
    fn corner<S: Lanes>(&self, s: S, word: S::U) -> Corner<S, N> {
        Corner { value: s.float(0.0), gradient: edge_direction(s, word, &LENGTHS_2002[N - 1]) }
    }

    #[inline(always)]
    fn column<S: Lanes>(&self, s: S, along: &[Along<S>; N], words: &[S::U; 4]) -> Option<Column<S, N>> {
        if N > 2 { Some(edge_column(s, along, words, SCALE_2002[N - 1])) } else { None }
    }
}
