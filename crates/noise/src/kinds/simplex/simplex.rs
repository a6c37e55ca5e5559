//! Simplex noise, with the kernel radius that is continuous and with the customary wider one.

use crate::{
    contract::hessian::{Curved, Jet, mirror},
    contract::kernel::{Kernel, LaneSample, Row},
    kinds::cell::rows::Stretch,
    kinds::simplex::rows::rows,
    lattice::integer_hash::IntegerHash,
    lattice::lattice::Lattice,
    lattice::variates::edge_direction,
    simd::lanes::{Floats, Lanes, Scalar},
    statistics::absolute_moments,
    statistics::statistics::Statistics,
    statistics::tables,
};

/// Gradient noise on the simplicial lattice: n + 1 corners in n dimensions.
///
#[cfg_attr(doc, doc = include_str!("../../../docs/pictures/simplex.md"))]
///
/// ```text
/// n(p) = A Σ_c max(0, r² − |d|²)⁴ g_c·d,   d = p − c
/// ```
///
/// In 1 to 4 dimensions. Far from the origin corners are rounded, by up to |p|·2⁻²², which is about what `f32` cannot hold
/// of the point itself; the noise stays continuous. From Σ |xᵢ| = 2²² on, where `f32` cannot tell simplices apart, it is 0.
///
/// - **Range:** [−1, 1]; A is the inverse of the searched maximum, attained within 2e-6. Where corners are rounded the range is
///   wider, up to 1 + Σ |xᵢ|·2⁻²²; at 2¹⁵ 1.0034 was seen.
/// - **Kernels** end where r² − |d|² falls to 2⁻¹⁰, by a leap of less than 1e-10. So no rounding decides whether the corner
///   opposite to a face counts, and grids may add corners up one after the other.
///
/// Nilsson 2008, section 4.1.3, prints the dot product with minus signs and its derivative without a factor. With
/// t = r² − |d|² and s = g·d it is ∂(t⁴ s)/∂x = −8 x t³ s + t⁴ gₓ.
///
/// ```
/// use asperity_noise::{Noise, Simplex, glam::Vec3};
///
/// let sample = Simplex::CONTINUOUS.sample(Vec3::new(0.4, -1.3, 2.2), 3);
/// assert!(sample.value.abs() <= 1.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Simplex<L = IntegerHash> {
    kernel: Radius,
    lattice: L,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Radius {
    Continuous,
    Wide,
}

impl Simplex {
    /// r² = 1/2, the distance from a corner to the opposite face: C³ everywhere.
    pub const CONTINUOUS: Self = Self { kernel: Radius::Continuous, lattice: IntegerHash };

    /// r² = 0.6, as in Nilsson 2008: smoother to the eye, but kernels are cut off at the faces of the simplices, where the noise
    /// leaps. **Discontinuous** in 2-D and 3-D; measured leaps up to 0.0045 and 0.0023.
    pub const WIDE: Self = Self { kernel: Radius::Wide, lattice: IntegerHash };
}

impl<L> Simplex<L> {
    /// The same noise on another lattice.
    #[must_use]
    pub fn with_lattice<M>(self, lattice: M) -> Simplex<M> {
        Simplex { kernel: self.kernel, lattice }
    }

    /// r², the square of the kernel's radius.
    #[must_use]
    pub const fn radius_squared(&self) -> f32 {
        match self.kernel {
            Radius::Continuous => 0.5,
            Radius::Wide => 0.6,
        }
    }
}

/// Keeps rounding from crossing 1.
const MARGIN: f32 = 1.0 - 2e-6;
/// The searched max Σ t⁴ max_g g·d in 1 to 4 dimensions, r² = ½ and 0.6.
const MAXIMA: [[f32; 2]; 4] = [
    [0.009_196_735, 0.020_895_276],
    [0.014_255_562, 0.040_844_663],
    [0.013_007_157, 0.030_584_887],
    [0.015_929_222, 0.036_730_024],
];
/// (√(n + 1) − 1)/n, which shears the simplices into halves, sixths, … of cubes; nothing is sheared in 1-D.
const SKEW: [f32; 4] = [0.0, 0.366_025_4, 1.0 / 3.0, 0.309_017];
/// (1 − 1/√(n + 1))/n, which shears back.
pub(crate) const UNSKEW: [f32; 4] = [0.0, 0.211_324_87, 1.0 / 6.0, 0.138_196_6];

/// A point's simplex: its first corner in the skewed lattice, and the order of the axes on the way to the last.
struct Corner<S: Lanes, const N: usize> {
    /// The corner's skewed coordinates, integers.
    skewed: [S::F; N],
    /// Their sum.
    sum: S::F,
    /// Than how many axes the point is farther along each axis in the skewed cell.
    rank: [S::F; N],
}

#[inline(always)]
fn first_corner<S: Lanes, const N: usize>(s: S, p: &[S::F; N]) -> Corner<S, N> {
    let (one, zero) = (s.float(1.0), s.float(0.0));
    let mut corner = Corner { skewed: *p, sum: zero, rank: [zero; N] };
    // The first coordinate comes last: along a row of a grid the rest of the sum does not change.
    let mut sum = p[N - 1];
    for axis in (0..N - 1).rev() {
        sum = sum + p[axis];
    }
    let shift = sum * s.float(SKEW[N - 1]);
    for axis in 0..N {
        corner.skewed[axis] = s.floor(if N == 1 { p[axis] } else { p[axis] + shift });
        corner.sum = corner.sum + corner.skewed[axis];
    }
    // Which axis the point is farther along does not depend on what all are shifted by.
    for axis in 1..N {
        for before in 0..axis {
            let low = p[axis] - corner.skewed[axis];
            let ahead = s.select(s.less(low, p[before] - corner.skewed[before]), one, zero);
            corner.rank[before] = corner.rank[before] + ahead;
            corner.rank[axis] = corner.rank[axis] + (one - ahead);
        }
    }
    corner
}

/// Where kernels end: t is 0 from here down.
///
/// Corners of other simplices come as near as t = 0, and nearer by rounding. Were there no gap, it would depend on the order of
/// evaluation whether they count. The leap is t⁴ A |g·d| < 1e-10, and that of the gradient 5e-7.
pub(crate) const GAP: f32 = 1.0 / 1024.0;

/// One term of the sum: t = r² − |d|², 0 below the gap, d, g and g·d.
struct Term<S: Lanes, const N: usize> {
    t: S::F,
    d: [S::F; N],
    g: [S::F; N],
    slope: S::F,
}

/// r² − Σ dᵢ² and Σ gᵢ dᵢ over all axes but the first: what does not change along a row.
#[inline(always)]
pub(crate) fn beside<S: Lanes, const N: usize>(
    s: S,
    radius_squared: f32,
    d: &[S::F; N],
    g: &[S::F; N],
) -> [S::F; 2] {
    let (mut rest, mut side) = (s.float(radius_squared), s.float(0.0));
    for axis in 1..N {
        rest = rest - d[axis] * d[axis];
        side = if axis == 1 { g[axis] * d[axis] } else { side + g[axis] * d[axis] };
    }
    [rest, side]
}

/// t and g·d of a term from what is beside the first axis.
#[inline(always)]
pub(crate) fn along<S: Lanes, const N: usize>(s: S, [rest, side]: [S::F; 2], d: S::F, g: S::F) -> [S::F; 2] {
    let (t, slope) = (rest - d * d, g * d);
    let t = s.above(t, GAP);
    [t, if N == 1 { slope } else { side + slope }]
}

/// t⁴.
#[inline(always)]
pub(crate) fn kernel<F: Floats>(t: F) -> F {
    let t2 = t * t;
    t2 * t2
}

/// 8 t³ (g·d).
#[inline(always)]
pub(crate) fn pull<S: Lanes>(s: S, t: S::F, slope: S::F) -> S::F {
    s.float(8.0) * (t * t * t) * slope
}

impl<L: Lattice> Simplex<L> {
    /// The terms of the lattice for the first corner and for one step along each axis.
    #[inline(always)]
    fn terms<S: Lanes, const N: usize>(&self, s: S, corner: &Corner<S, N>) -> [[S::U; 2]; N] {
        let mut terms = [[s.word(0); 2]; N];
        for axis in 0..N {
            terms[axis] = self.lattice.terms(s, axis, s.integer(corner.skewed[axis]));
        }
        terms
    }

    /// The term of the corner that is k steps from the first.
    ///
    /// A corner's place is computed from its skewed coordinates alone, so that all simplices around it agree on it to the
    /// last bit, and what is rounded far from the origin moves corners but opens no seams.
    #[inline(always)]
    fn term<S: Lanes, const N: usize>(
        &self,
        s: S,
        p: &[S::F; N],
        corner: &Corner<S, N>,
        terms: &[[S::U; 2]; N],
        k: usize,
        seed: u32,
    ) -> Term<S, N> {
        let (one, zero) = (s.float(1.0), s.float(0.0));
        let back = (corner.sum + s.float(k as f32)) * s.float(UNSKEW[N - 1]);
        let (mut words, mut d) = ([terms[0][0]; N], *p);
        for axis in 0..N {
            let ([low, high], mut skewed) = (terms[axis], corner.skewed[axis]);
            words[axis] = low;
            if k == N {
                words[axis] = high;
                skewed = skewed + one;
            } else if k > 0 {
                // From corner to corner one steps along the axes in descending order of the ranks.
                let ahead = s.less(s.float((N - k) as f32 - 0.5), corner.rank[axis]);
                words[axis] = s.select_word(ahead, high, low);
                skewed = skewed + s.select(ahead, one, zero);
            }
            d[axis] = if N == 1 { p[axis] - skewed } else { p[axis] - (skewed - back) };
        }
        let g = self.direction(s, self.lattice.words(s, words, seed));
        let [t, slope] = along::<S, N>(s, beside(s, self.radius_squared(), &d, &g), d[0], g[0]);
        Term { t, d, g, slope }
    }

    /// The direction that a word draws, scaled.
    #[inline(always)]
    pub(crate) fn direction<S: Lanes, const N: usize>(&self, s: S, word: S::U) -> [S::F; N] {
        let maximum = MAXIMA[N - 1][usize::from(self.kernel == Radius::Wide)];
        edge_direction(s, word, MARGIN / maximum)
    }

    #[inline(always)]
    pub(crate) fn lattice(&self) -> &L {
        &self.lattice
    }

    /// Whether no corner but those of a point's own simplex comes within the kernel's radius.
    #[inline(always)]
    pub(crate) fn is_continuous(&self) -> bool {
        self.kernel == Radius::Continuous
    }
}

impl<L: Lattice, const N: usize> Curved<N> for Simplex<L> {
    /// ∂ᵢⱼ(t⁴ s) = 48 dᵢ dⱼ t² s − 8 t³ (δᵢⱼ s + dᵢ gⱼ + dⱼ gᵢ).
    #[inline]
    fn near_jet(&self, p: [f32; N], seed: u32) -> Jet<[f32; N], N> {
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
    fn rows<S: Lanes, const SCALED: bool, const GRADIENTS: bool>(
        &self,
        s: S,
        row: &Row<N, SCALED>,
        seed: u32,
        stretch: &mut Stretch<N>,
        values: &mut [f32],
        gradients: Option<&mut [&mut [f32]; N]>,
    ) {
        rows::<L, S, N, SCALED, GRADIENTS>(s, self, row, seed, stretch, values, gradients);
    }

    fn statistics(&self) -> &'static Statistics {
        match self.kernel {
            Radius::Continuous => &tables::SIMPLEX_CONTINUOUS[N - 1],
            Radius::Wide => &tables::SIMPLEX_WIDE[N - 1],
        }
    }

    fn absolute_moments(&self) -> [f32; 4] {
        match self.kernel {
            Radius::Continuous => absolute_moments::SIMPLEX_CONTINUOUS[N - 1],
            Radius::Wide => absolute_moments::SIMPLEX_WIDE[N - 1],
        }
    }
}
