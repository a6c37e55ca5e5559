//! Simplex noise, with the continuous kernel radius and with the classic wider radius.

use crate::{
    contract::noise::{kind, measured, noise},
    kinds::simplex::geometry::{Corner, Term, UNSKEW, first_corner, product, within},
    lanes::Lanes,
    lattice::edges::{Lengths, edge_direction, edge_product},
    lattice::integer_hash::IntegerHash,
    lattice::lattice::Lattice,
    lattice::variates::MARGIN,
    statistics::tables,
};

/// Gradient noise on the simplicial lattice, with n + 1 corners in n dimensions.
///
#[cfg_attr(doc, doc = include_str!("../../../docs/pictures/simplex.md"))]
///
/// ```text
/// n(p) = A Σ_c max(0, r² − |d|²)⁴ g_c·d,   d = p − c
/// ```
///
/// In 1 to 4 dimensions. Far from the origin corners are rounded by up to |p|·2⁻²², which is about
/// the rounding of the point itself. The noise stays continuous. From Σ |xᵢ| = 2²² on, where `f32`
/// cannot resolve simplices, it is 0.
///
/// - **Range:** [−1, 1]. A is the inverse of the searched maximum, attained within 2e-6. Far from
///   the origin rounded corners would exceed the range, by 1e-4 at 1000 and by 0.3 at 10⁶, so the
///   value is clamped. The gradient there is the gradient of the sum before clamping.
/// - **Kernels** end where r² − |d|² falls to 2⁻¹⁰, with a discontinuity below 1e-10. Rounding
///   therefore never decides whether the corner opposite to a face contributes, and grids may add
///   corners in sequence.
///
/// Nilsson 2008, section 4.1.3, prints the dot product with minus signs and its derivative without
/// a factor. With t = r² − |d|² and s = g·d the derivative is ∂(t⁴ s)/∂x = −8 x t³ s + t⁴ gₓ.
///
/// ```
/// use asperity_noise::{Field, Simplex, glam::Vec3};
///
/// let sample = Simplex::new(3).sample(Vec3::new(0.4, -1.3, 2.2));
/// assert!(sample.value.abs() <= 1.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Simplex<L = IntegerHash> {
    seed: u32,
    kernel: Radius,
    lattice: L,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Radius {
    Continuous,
    Classic,
}

kind!(
    Simplex { kernel: Radius::Continuous },
    "of r² = 1/2, the distance from a corner to the opposite face: C³ everywhere"
);

impl<L> Simplex<L> {
    /// Sets the classic r² = 0.6, as in Nilsson 2008.
    ///
    /// It has higher contrast than r² = 0.5 but is **discontinuous** at simplex faces, where
    /// kernels are cut off. Measured discontinuities are up to 0.0045 in 2-D and 0.0023 in 3-D.
    #[must_use]
    pub fn with_classic_radius(self) -> Self {
        Self { kernel: Radius::Classic, ..self }
    }

    pub(crate) const fn lattice(&self) -> &L {
        &self.lattice
    }

    /// Returns r², the square of the kernel's radius.
    #[must_use]
    pub const fn radius_squared(&self) -> f32 {
        match self.kernel {
            Radius::Continuous => 0.5,
            Radius::Classic => 0.6,
        }
    }
}

/// The searched max Σ t⁴ max_g g·d in 1 to 4 dimensions, r² = ½ and 0.6.
const MAXIMA: [[f32; 2]; 4] = [
    [0.009_196_735, 0.020_895_276],
    [0.014_136_467, 0.040_496_275],
    [0.013_007_157, 0.030_584_887],
    [0.015_929_222, 0.036_730_024],
];

/// The lengths of gradients in 1 to 4 dimensions, r² = ½ and 0.6.
static LENGTHS: [[Lengths; 2]; 4] = [lengths(0), lengths(1), lengths(2), lengths(3)];

const fn lengths(axis: usize) -> [Lengths; 2] {
    [Lengths::new(MARGIN / MAXIMA[axis][0]), Lengths::new(MARGIN / MAXIMA[axis][1])]
}

/// Repeats a block of code for each of the N + 1 corners.
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

impl<L: Lattice> Simplex<L> {
    /// The terms of the lattice for the first corner and for one step along each axis.
    #[inline(always)]
    pub(crate) fn terms<S: Lanes, const N: usize>(&self, s: S, corner: &Corner<S, N>) -> [[S::U; 2]; N] {
        let mut terms = [[s.word(0); 2]; N];
        for axis in 0..N {
            terms[axis] = self.lattice.terms(s, axis, s.integer(corner.skewed[axis]));
        }
        terms
    }

    /// The term of the corner with the given skewed coordinates, whose sum is `sum`; draws its
    /// word.
    ///
    /// A corner's position is computed from its skewed coordinates alone, so that all simplices
    /// around it use the same bits. Far from the origin rounding moves corners without opening
    /// seams.
    #[inline(always)]
    pub(crate) fn term<S: Lanes, const N: usize, const GRADIENTS: bool>(
        &self,
        s: S,
        p: &[S::F; N],
        skewed: [S::F; N],
        sum: S::F,
        word: S::U,
    ) -> Term<S, N> {
        let back = sum * s.float(UNSKEW[N - 1]);
        let mut d = *p;
        for axis in 0..N {
            d[axis] = if N == 1 { p[axis] - skewed[axis] } else { p[axis] - (skewed[axis] - back) };
        }
        let t = within(s, self.radius_squared(), &d);
        if N == 3 && !GRADIENTS && S::LEN > 4 {
            let slope = edge_product(s, word, self.lengths::<N>(), &d);
            return Term { t, d, g: d, slope };
        }
        let g = edge_direction(s, word, self.lengths::<N>());
        Term { t, d, g, slope: product::<S, N>(&g, &d) }
    }

    /// Passes the terms of the corners of a point's simplex to `add`, from the first to the last.
    #[inline(always)]
    pub(crate) fn terms_at<S: Lanes, const N: usize, const GRADIENTS: bool>(
        &self,
        s: S,
        p: &[S::F; N],
        seed: u32,
        mut add: impl FnMut(Term<S, N>),
    ) {
        let first = first_corner(s, p);
        let (steps, terms) = (first.steps(s, p), self.terms(s, &first));
        let mut last = first.skewed;
        for axis in 0..N {
            last[axis] = last[axis] + s.float(1.0);
        }
        // Repeated by a macro, because the compiler does not unroll a loop with this body.
        for_corners!(N, |k| {
            let (mut words, mut skewed) = ([terms[0][0]; N], first.skewed);
            for axis in 0..N {
                let [low, high] = terms[axis];
                (words[axis], skewed[axis]) = if k == 0 {
                    (low, skewed[axis])
                } else if k == N {
                    (high, last[axis])
                } else {
                    let ahead = steps[(k - 1) % N][axis];
                    (s.select_word(ahead, high, low), s.select(ahead, last[axis], skewed[axis]))
                };
            }
            let word = self.lattice.upper_words(s, words, seed);
            add(self.term::<S, N, GRADIENTS>(s, p, skewed, first.sum + s.float(k as f32), word));
        });
    }

    /// The noise on a lattice.
    #[inline(always)]
    pub(crate) fn on(&self, lattice: L) -> Self {
        Self { lattice, ..*self }
    }

    #[inline(always)]
    fn lengths<const N: usize>(&self) -> &'static Lengths {
        &LENGTHS[N - 1][usize::from(self.kernel == Radius::Classic)]
    }
}

measured!(Simplex, |self| match self.kernel {
    Radius::Continuous => &tables::SIMPLEX_CONTINUOUS,
    Radius::Classic => &tables::SIMPLEX_WIDE,
});
noise!(Simplex, curved);
