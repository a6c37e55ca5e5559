//! Points of the torus as exact fractions of a turn, and their images under an integer matrix.

/// A point of the unit torus, as fractions with the bits of a word, or as ratios.
#[derive(Clone, Copy, Debug)]
pub enum Address {
    /// 64 bits: every `f64` of magnitude 2⁻¹¹ or more, and every one that is a multiple of 2⁻⁶⁴.
    Short([u64; 2]),
    /// 128 bits.
    Long([u128; 2]),
    /// Numerators under a common denominator: the orbit of a rational point is periodic and exact.
    Ratio([u64; 2], u32),
}

impl Address {
    /// The point and the truncation of a coordinate; `None` unless both are finite.
    #[inline]
    pub(crate) fn of(x: f64, y: f64) -> Option<(Self, f64)> {
        let ((x, cut_x), (y, cut_y)) = (turn(x)?, turn(y)?);
        let short = (x | y) as u64 == 0;
        let at = if short { Self::Short([x, y].map(|t| (t >> 64) as u64)) } else { Self::Long([x, y]) };
        Some((at, if cut_x > cut_y { cut_x } else { cut_y }))
    }

    /// The ratio modulo 1; `None` for the denominator 0.
    pub(crate) fn ratio(numerators: [i64; 2], denominator: u32) -> Option<Self> {
        let remainder = |k: i64| k.checked_rem_euclid(i64::from(denominator)).map(i64::unsigned_abs);
        Some(Self::Ratio([remainder(numerators[0])?, remainder(numerators[1])?], denominator))
    }

    /// `M (x, y)` modulo 1, exact.
    #[inline]
    pub(crate) fn moved(self, matrix: &[[i32; 2]; 2]) -> Self {
        // Sign extension and wrapping products are arithmetic modulo the word; whole turns vanish.
        match self {
            Self::Short([x, y]) => Self::Short(matrix.map(|[a, b]| {
                x.wrapping_mul(i64::from(a) as u64).wrapping_add(y.wrapping_mul(i64::from(b) as u64))
            })),
            Self::Long([x, y]) => Self::Long(matrix.map(|[a, b]| {
                x.wrapping_mul(i128::from(a) as u128).wrapping_add(y.wrapping_mul(i128::from(b) as u128))
            })),
            Self::Ratio(numerators, denominator) => {
                let [x, y] = numerators.map(i128::from);
                let row = |[a, b]: [i32; 2]| {
                    let sum = i128::from(a) * x + i128::from(b) * y;
                    sum.checked_rem_euclid(i128::from(denominator)).map_or(0, |rest| rest as u64)
                };
                Self::Ratio(matrix.map(row), denominator)
            }
        }
    }

    /// The cell of a grid of `2^bits` cells per side, and the position in it.
    ///
    /// The position is in units of the cell, with 53 bits.
    #[inline]
    pub(crate) fn cell(self, bits: u32) -> ([usize; 2], [f64; 2]) {
        let high = |t: u128| (t >> 64) as u64;
        match self {
            Self::Short(at) => (at.map(|t| (t >> (64 - bits)) as usize), at.map(|t| unit(t << bits))),
            Self::Long(at) => {
                (at.map(|t| (high(t) >> (64 - bits)) as usize), at.map(|t| unit(high(t << bits))))
            }
            Self::Ratio(numerators, denominator) => {
                let denominator = u64::from(denominator).max(1);
                let whole = numerators.map(|k| ((k << bits) / denominator) as usize);
                (whole, numerators.map(|k| ((k << bits) % denominator) as f64 / denominator as f64))
            }
        }
    }

    /// Whether the point is a corner of such a cell.
    #[inline]
    pub(crate) fn is_corner(self, bits: u32) -> bool {
        match self {
            Self::Short([x, y]) => (x | y) << bits == 0,
            Self::Long([x, y]) => (x | y) << bits == 0,
            Self::Ratio(numerators, denominator) => {
                let denominator = u64::from(denominator).max(1);
                numerators.iter().all(|k| (k << bits).is_multiple_of(denominator))
            }
        }
    }
}

/// The highest 53 of 64 bits, in `[0, 1)`.
#[inline]
fn unit(fraction: u64) -> f64 {
    const ULP: f64 = 1.0 / 9_007_199_254_740_992.0;
    (fraction >> 11) as i64 as f64 * ULP
}

/// `x` modulo 1 with 128 bits, and the maximum truncation; `None` unless `x` is finite.
#[inline]
fn turn(x: f64) -> Option<(u128, f64)> {
    const MANTISSA: u32 = 52;
    const CUT: f64 = 1.0 / 340_282_366_920_938_463_463_374_607_431_768_211_456.0;
    if !x.is_finite() {
        return None;
    }
    let bits = x.to_bits();
    let exponent = (bits >> MANTISSA) as i32 & 0x7FF;
    let fraction = bits & ((1 << MANTISSA) - 1);
    let mantissa = u128::from(if exponent == 0 { fraction } else { fraction | 1 << MANTISSA });
    // The last bit of the mantissa weighs 2^(exponent − 1075), the last bit of the word 2⁻¹²⁸.
    let shift = exponent.max(1) - 947;
    let (part, rest) = match shift {
        128.. => (0, 0),
        0.. => (mantissa << shift, 0),
        -127.. => (mantissa >> -shift, mantissa & ((1 << -shift) - 1)),
        _ => (0, mantissa),
    };
    Some((if x < 0.0 { part.wrapping_neg() } else { part }, if rest == 0 { 0.0 } else { CUT }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turn_of_doubles_is_exact() {
        const ONE: f64 = 18_446_744_073_709_551_616.0;
        for (x, want) in [
            (0.0, 0.0),
            (-0.0, 0.0),
            (0.25, 0.25),
            (-0.25, 0.75),
            (7.5, 0.5),
            (-1e300, 0.0),
            (4_503_599_627_370_495.5, 0.5),
            (1.0 / 3.0, 1.0 / 3.0),
        ] {
            let (got, cut) = turn(x).unwrap();
            assert_eq!((got, cut), ((want * ONE) as u128 * (1 << 64), 0.0), "{x}");
        }
        assert_eq!(turn(2f64.powi(-128)), Some((1, 0.0)));
        assert_eq!(turn(3.0 * 2f64.powi(-129)), Some((1, 2f64.powi(-128))));
        assert_eq!(turn(f64::from_bits(1)), Some((0, 2f64.powi(-128))));
        assert!([f64::NAN, f64::INFINITY, f64::NEG_INFINITY].iter().all(|&x| turn(x).is_none()));
    }

    #[test]
    fn moved_is_equal_for_both_word_lengths() {
        let matrix = [[2, -1], [1, 2]];
        let mut long = Address::Long([0.3, -0.7].map(|x| turn(x).unwrap().0));
        let (mut short, cut) = Address::of(0.3, -0.7).unwrap();
        assert!(matches!(short, Address::Short(_)) && cut == 0.0);
        for step in 0..200 {
            for bits in [1, 5] {
                assert_eq!(long.cell(bits), short.cell(bits), "step {step}");
            }
            (long, short) = (long.moved(&matrix), short.moved(&matrix));
        }
        let (tiny, _) = Address::of(2f64.powi(-70), 0.5).unwrap();
        assert!(matches!(tiny, Address::Long(_)) && !tiny.is_corner(1));
        assert!(Address::Long([1 << 127, 0]).is_corner(1) && Address::Short([1 << 63, 0]).is_corner(1));
    }
}
