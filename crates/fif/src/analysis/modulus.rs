//! Moduli of continuity: Lipschitz and Hölder bounds, and the conditioning at a point.

use asperity_core::Interval;
use asperity_core::math::{ln_f64, pow_f64};

use crate::system::fif::{Spacing, System};
use crate::system::map::Piece;

/// A bound of `|f(x) − f(y)|` in terms of `d = |x − y|`, over the whole domain.
///
/// ```
/// use asperity_fif::{Modulus, cochran_2000};
/// let g = cochran_2000::g()?.modulus();
/// assert!((g.exponent() - 0.234).abs() < 1e-3);
/// assert!(matches!(cochran_2000::f()?.modulus(), Modulus::LogLipschitz { .. }));
/// assert!(matches!(cochran_2000::g_hat()?.modulus(), Modulus::Lipschitz { .. }));
/// # Ok::<(), asperity_fif::FifError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub enum Modulus {
    /// `constant · d`.
    Lipschitz {
        /// The largest slope.
        constant: f64,
    },
    /// `constant · d · (1 + ln(width/d))`, for `d` up to the width of the domain.
    LogLipschitz {
        /// The factor.
        constant: f64,
        /// The width of the domain.
        width: f64,
    },
    /// `constant · d^exponent`, with an exponent in `(0, 1)`.
    Holder {
        /// The Hölder exponent.
        exponent: f64,
        /// The factor.
        constant: f64,
    },
}

impl Modulus {
    /// The bound of `|f(x) − f(y)|` for `|x − y| ≤ distance`; 0 for distance 0, NaN for NaN.
    #[must_use]
    pub fn at(&self, distance: f64) -> f64 {
        let d = distance.abs();
        if d == 0.0 {
            return 0.0;
        }
        match *self {
            Self::Lipschitz { constant } => constant * d,
            Self::LogLipschitz { constant, width } if d >= width => constant * width,
            Self::LogLipschitz { constant, width } => constant * d * (1.0 + ln_f64(width / d)),
            Self::Holder { exponent, constant } => constant * pow_f64(d, exponent),
        }
    }

    /// The largest exponent `h` with a bound of order `d^h`, up to logarithms: 1, or the Hölder
    /// exponent.
    #[must_use]
    pub fn exponent(&self) -> f64 {
        match *self {
            Self::Lipschitz { .. } | Self::LogLipschitz { .. } => 1.0,
            Self::Holder { exponent, .. } => exponent,
        }
    }
}

/// Margin for the roundings of the constants, of powers and of logarithms.
const UP: f64 = 1.0 + 1.0 / 1_073_741_824.0;

/// Difference of a scaling from `a_j` that is treated as equality.
const NEAR: f64 = 1.0 / 1_125_899_906_842_624.0;

impl<S: AsRef<[Piece<C>]>, const C: usize> System<S, C> {
    /// A bound of `|f(x) − f(y)|` for any two points.
    ///
    /// With `Λ_j` the Lipschitz constant of `q_j` in units of the domain:
    ///
    /// ```text
    /// |α_j| < a_j for all j:   Lipschitz, max Λ_j/(a_j − |α_j|)
    /// |α_j| ≤ a_j:             d (1 + ln(1/d))
    /// else:                    Hölder, h = min ln|α_j| / ln a_j
    /// ```
    ///
    /// The exponent is optimal unless `f` is a polynomial. Over the cells of the iterated map with
    /// the minimum, `f` moves by `|α_j|ⁿ = a_jⁿʰ` times a constant. The exponent is rounded down by
    /// 2⁻⁴⁰. The constant follows two points to the level where they separate, and from there to
    /// the knots between them. It is up to ten times the value from samples of random systems, and
    /// large if cells are tiny. It is rounded up by 2⁻³⁰.
    ///
    /// Not in the sources. The exponent for equal cells is from Bedford, *Hölder exponents and box
    /// dimension for self-affine fractal functions*, 1989.
    ///
    /// ```
    /// let g = asperity_fif::cochran_2000::g()?;
    /// let (x, y) = (0.70, 0.71);
    /// let moved = (g.evaluate(x, 1e-9).value - g.evaluate(y, 1e-9).value).abs();
    /// assert!(moved <= g.modulus().at(y - x));
    /// # Ok::<(), asperity_fif::FifError>(())
    /// ```
    pub fn modulus(&self) -> Modulus {
        let width = self.domain().width();
        let (mut exponent, mut lipschitz, mut gentle, mut even) = (1.0_f64, 0.0_f64, true, true);
        for piece in self.pieces() {
            let (a, alpha, slope) = measures(piece);
            gentle &= alpha < a * (1.0 - NEAR);
            even &= alpha <= a * (1.0 + NEAR);
            lipschitz = lipschitz.max(slope / (a - alpha));
            // Others have an exponent of 1 or more. A map of the whole domain, up to rounding, has
            // ln a = 0.
            if alpha > a {
                exponent = exponent.min(ln_f64(alpha) / ln_f64(a));
            }
        }
        if gentle {
            return Modulus::Lipschitz { constant: UP * lipschitz / width };
        }
        if even {
            let (ends, log) = self.parting(1.0);
            return Modulus::LogLipschitz { constant: UP * (ends + log) / width, width };
        }
        let exponent = exponent * (1.0 - 1.0 / 1_099_511_627_776.0);
        let (ends, inner) = self.parting(exponent);
        Modulus::Holder { exponent, constant: UP * (ends + inner) / pow_f64(width, exponent) }
    }

    /// Conditioning at `x`: the distance between `f(x)` and the value computed by
    /// [`System::evaluate`].
    ///
    /// It is the width of an enclosure of `f` over the points that rounding of knots and of the
    /// orbit may confuse with `x`:
    ///
    /// ```text
    /// equally spaced knots:   |x′ − x| ≤ 4 ulp
    /// others:                 |x′ − x| ≤ 4 ulp + 8 u (x_N − x_0) min(4096, 1/(1 − max a_j)),   u = 2⁻⁵³
    /// ```
    ///
    /// with the ulp of the larger end of the domain. Therefore `|value − f(x)| ≤ bound +
    /// conditioning(x)` on any knots. For an exact point on equally spaced knots `bound` alone
    /// suffices. The conditioning is unavoidable for evaluation in `f64`: one ulp of `x` changes g
    /// of the source by 5·10⁻⁴.
    ///
    /// NaN returns NaN; points outside the domain are clamped. Takes microseconds to milliseconds.
    ///
    /// ```
    /// use asperity_fif::cochran_2000;
    /// assert!(cochran_2000::g_hat()?.conditioning(0.7) < 1e-13);
    /// let rough = cochran_2000::g()?.conditioning(0.7);
    /// assert!(rough > 1e-4 && rough < 1e-2);
    /// # Ok::<(), asperity_fif::FifError>(())
    /// ```
    #[must_use]
    pub fn conditioning(&self, x: f64) -> f64 {
        if x.is_nan() {
            return f64::NAN;
        }
        let domain = self.domain();
        let largest = self.pieces().iter().fold(0.0_f64, |a, piece| a.max(piece.map().a));
        let levels = (1.0 / (1.0 - largest)).min(crate::evaluate::value::MAX_DEPTH as f64);
        let orbit = match self.spacing() {
            Spacing::Uniform => 0.0,
            Spacing::Nonuniform => 4.0 * f64::EPSILON * domain.width() * levels,
        };
        let reach = 4.0 * f64::EPSILON * domain.magnitude() + orbit;
        let x = domain.nearest(x);
        let taken = |width: f64| {
            self.enclosure(x - reach, x + reach, width).map_or_else(|| self.range().width(), Interval::width)
        };
        // Narrower and narrower searches, as long as they help.
        let mut moved = taken(0.125 * self.range().width());
        for _ in 0..64 {
            let next = taken(0.125 * moved);
            let paid = next < 0.5 * moved;
            moved = if next < moved { next } else { moved };
            if !paid {
                break;
            }
        }
        moved
    }

    /// Constants of the bound `|f(x) − f(y)| ≤ (first + second) d^h`, in units of the domain.
    ///
    /// For `|α_j| ≤ a_j^h`.
    ///
    /// The first is for two points in different cells, `δ^h` for their distance `δ`. The second is
    /// for the polynomials of their common levels. It is a geometric sum, or for `h = 1` one term
    /// per level with the total factor `1 + ln(1/d)`.
    fn parting(&self, h: f64) -> (f64, f64) {
        let last = self.pieces().len().saturating_sub(1);
        let [y0, y_end] = self.end_values();
        let (mut steep, mut narrowest, mut rise) = (0.0_f64, 1.0_f64, 0.0_f64);
        let mut widest = Widths { part: 0.0, rest: 1.0 };
        // max |f − y_0| / t^h over the cells right of the first one, and the same from the right.
        let mut away = [0.0_f64; 2];
        let mut first = [(widest, 0.0); 2];
        for (j, piece) in self.pieces().iter().enumerate() {
            let (a, _, slope) = measures(piece);
            let widths = Widths { part: a, rest: piece.s[0] + (1.0 - piece.s[1]) };
            steep = steep.max(slope / pow_f64(a, h));
            if widths.rest < widest.rest {
                widest = widths;
            }
            narrowest = narrowest.min(a);
            rise = rise.max((piece.y()[1] - piece.y()[0]).abs() / a);
            let range = crate::system::cell::Cell::root().child(piece).range(self.range());
            if j > 0 {
                away[0] =
                    away[0].max(range.sum(Interval::new(-y0, -y0)).magnitude() / pow_f64(piece.s[0], h));
            } else {
                first[0] = (widths, slope);
            }
            if j < last {
                away[1] = away[1]
                    .max(range.sum(Interval::new(-y_end, -y_end)).magnitude() / pow_f64(1.0 - piece.s[1], h));
            } else {
                first[1] = (widths, slope);
            }
        }
        let ends: f64 = (0..2)
            .map(|side| {
                let (widths, slope) = first[side];
                // A zero slope on zero width is 0.
                let over = if slope == 0.0 { 0.0 } else { slope / pow_f64(widths.part, h) };
                away[side] + widths.levels(h, over) + steep
            })
            .sum();
        let between = (ends + rise).min(if h < 1.0 {
            self.range().width() / pow_f64(narrowest, h)
        } else {
            f64::INFINITY
        });
        (ends.max(between), widest.levels(h, steep))
    }
}

/// The relative width of a piece and of the rest of the domain.
///
/// The rest is separate, because it cannot be computed accurately if the piece is nearly
/// everything.
#[derive(Clone, Copy)]
struct Widths {
    part: f64,
    rest: f64,
}

impl Widths {
    /// A term for every common level of two points: `term Σ (a^{1−h})^i`, or for `h = 1` the number
    /// of levels.
    ///
    /// The number is in units of `ln(1/d)`.
    ///
    /// By Bernoulli's inequality `1 − (1 − r)^{1−h} ≥ (1 − h) r`, and `−ln(1 − r) ≥ r`. For
    /// small `r` these bounds do not cancel.
    fn levels(self, h: f64, term: f64) -> f64 {
        let Self { part, rest } = self;
        let left = match (h < 1.0, rest > 1.0 / 1_048_576.0) {
            (true, true) => 1.0 - pow_f64(part, 1.0 - h),
            (true, false) => (1.0 - h) * rest,
            (false, true) => -ln_f64(part),
            (false, false) => rest,
        };
        if term == 0.0 { 0.0 } else { term * (1.0 / left) }
    }
}

/// `a_j`, `|α_j|`, and a Lipschitz constant of `q_j` over the domain scaled to `[0, 1]`.
fn measures<const C: usize>(piece: &Piece<C>) -> (f64, f64, f64) {
    let degree = C.saturating_sub(1) as f64;
    let pairs = piece.bernstein.iter().zip(piece.bernstein.iter().skip(1));
    let steepest = pairs.fold(0.0_f64, |m, (b, next)| m.max((next - b).abs()));
    // Markov's inequality for the error of the coefficients.
    (piece.map().a, piece.map().alpha.abs(), degree * steepest + 2.0 * degree * degree * piece.slack)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{FixedFif, cochran_2000};

    #[test]
    fn modulus_of_a_parabola_is_its_slope() {
        // x² on halves, α = 1/4: Lipschitz constant 2.
        let q = [[0.0, 0.0, 0.0], [0.25, 0.5, 0.0]];
        let f = FixedFif::<2, 3>::new(&[0.0, 0.5, 1.0], &[0.25, 0.25], &q).unwrap();
        let Modulus::Lipschitz { constant } = f.modulus() else { panic!("{:?}", f.modulus()) };
        assert!((2.0..2.0 + 1e-6).contains(&constant), "{constant}");
        assert_eq!(f.modulus().exponent(), 1.0);
    }

    #[test]
    fn modulus_at_zero_is_zero() {
        for modulus in [cochran_2000::f().unwrap().modulus(), cochran_2000::g().unwrap().modulus()] {
            assert!(modulus.at(0.0) == 0.0 && modulus.at(f64::NAN).is_nan(), "{modulus:?}");
            assert!(modulus.at(100.0) >= modulus.at(2.0) && modulus.at(2.0) >= modulus.at(1e-300));
        }
    }

    #[test]
    fn modulus_is_finite_if_one_map_covers_nearly_everything() {
        for narrow in [1e-3, 1e-9, 1e-15, 1e-20, 1e-300] {
            for alpha in [[0.5, 0.3], [0.3, -0.9], [0.0, 0.0]] {
                for x in [[0.0, narrow, 1.0], [-1.0, -narrow, 0.0]] {
                    let f = FixedFif::<2, 2>::affine(&x, &[0.0, 1.0, 0.25], &alpha).unwrap();
                    let modulus = f.modulus();
                    assert!((0.0..=1.0).contains(&modulus.exponent()), "{x:?} {alpha:?}: {modulus:?}");
                    for distance in [1e-300, 1e-12, 0.1, 1.0, -8_388_608.0, f64::MAX] {
                        assert!(modulus.at(distance) >= 0.0, "{x:?} {alpha:?}: {modulus:?} at {distance}");
                    }
                    // The width of the narrow map is exact only at the left end.
                    assert!(x[0] < 0.0 || modulus.at(1.0).is_finite(), "{x:?} {alpha:?}: {modulus:?}");
                    let (y, z) =
                        (f.evaluate(0.3 * (x[0] + x[2]), 1e-9), f.evaluate(0.31 * (x[0] + x[2]), 1e-9));
                    let (moved, bounds) = ((y.value - z.value).abs(), y.bound + z.bound);
                    assert!(moved <= modulus.at(0.01) + bounds, "{x:?} {alpha:?}: {modulus:?}");
                }
            }
        }
    }

    #[test]
    fn conditioning_accepts_every_input() {
        let g = cochran_2000::g().unwrap();
        assert!(g.conditioning(f64::NAN).is_nan());
        for x in [f64::NEG_INFINITY, -1.0, 0.0, 1.0, 2.0, 3.0, f64::INFINITY] {
            assert!(g.conditioning(x) > 0.0 && g.conditioning(x) < 0.02, "{x}: {}", g.conditioning(x));
        }
    }
}
