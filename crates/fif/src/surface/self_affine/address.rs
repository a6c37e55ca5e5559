//! Points of the torus as exact fractions of a turn, and how an integer matrix moves them.

/// The coordinates of a point of the unit torus, as fractions with as many bits as a word has.
pub(crate) trait Turn: Copy {
    /// `M (x, y)` modulo 1, exact.
    fn moved(self, matrix: &[[i32; 2]; 2]) -> Self;

    /// The cell of a grid of `2^bits` cells along a side, and the place within it in units of the cell, 53 bits of it.
    fn cell(self, bits: u32) -> ([usize; 2], [f64; 2]);

    /// Whether the point is a corner of such a cell.
    fn is_corner(self, bits: u32) -> bool;
}

/// 64 bits: every `f64` of magnitude 2⁻¹¹ or more, and every one that is a multiple of 2⁻⁶⁴.
#[derive(Clone, Copy)]
pub(crate) struct Short(pub(crate) [u64; 2]);

/// 128 bits.
#[derive(Clone, Copy)]
pub(crate) struct Long(pub(crate) [u128; 2]);

impl Turn for Short {
    #[inline]
    fn moved(self, matrix: &[[i32; 2]; 2]) -> Self {
        let [x, y] = self.0;
        // Sign extension and wrapping products are arithmetic modulo 2⁶⁴, whole turns drop out.
        let row = |[a, b]: [i32; 2]| {
            x.wrapping_mul(i64::from(a) as u64).wrapping_add(y.wrapping_mul(i64::from(b) as u64))
        };
        Self([row(matrix[0]), row(matrix[1])])
    }

    #[inline]
    fn cell(self, bits: u32) -> ([usize; 2], [f64; 2]) {
        (self.0.map(|t| (t >> (64 - bits)) as usize), self.0.map(|t| unit(t << bits)))
    }

    #[inline]
    fn is_corner(self, bits: u32) -> bool {
        (self.0[0] | self.0[1]) << bits == 0
    }
}

impl Turn for Long {
    fn moved(self, matrix: &[[i32; 2]; 2]) -> Self {
        let [x, y] = self.0;
        let row = |[a, b]: [i32; 2]| {
            x.wrapping_mul(i128::from(a) as u128).wrapping_add(y.wrapping_mul(i128::from(b) as u128))
        };
        Self([row(matrix[0]), row(matrix[1])])
    }

    fn cell(self, bits: u32) -> ([usize; 2], [f64; 2]) {
        let high = |t: u128| (t >> 64) as u64;
        (self.0.map(|t| (high(t) >> (64 - bits)) as usize), self.0.map(|t| unit(high(t << bits))))
    }

    fn is_corner(self, bits: u32) -> bool {
        (self.0[0] | self.0[1]) << bits == 0
    }
}

/// Numerators under a common denominator: the orbit of a rational point is periodic and exact.
#[derive(Clone, Copy)]
pub(crate) struct Ratio {
    numerators: [u64; 2],
    denominator: u32,
}

impl Ratio {
    /// The point modulo 1; `None` for the denominator 0.
    pub(crate) fn new(numerators: [i64; 2], denominator: u32) -> Option<Self> {
        let remainder = |k: i64| k.checked_rem_euclid(i64::from(denominator)).map(i64::unsigned_abs);
        Some(Self { numerators: [remainder(numerators[0])?, remainder(numerators[1])?], denominator })
    }
}

impl Turn for Ratio {
    fn moved(self, matrix: &[[i32; 2]; 2]) -> Self {
        let [x, y] = self.numerators.map(i128::from);
        let row = |[a, b]: [i32; 2]| {
            let sum = i128::from(a) * x + i128::from(b) * y;
            sum.checked_rem_euclid(i128::from(self.denominator)).map_or(0, |rest| rest as u64)
        };
        Self { numerators: [row(matrix[0]), row(matrix[1])], ..self }
    }

    fn cell(self, bits: u32) -> ([usize; 2], [f64; 2]) {
        let denominator = u64::from(self.denominator).max(1);
        let whole = self.numerators.map(|k| ((k << bits) / denominator) as usize);
        let part = self.numerators.map(|k| ((k << bits) % denominator) as f64 / denominator as f64);
        (whole, part)
    }

    fn is_corner(self, bits: u32) -> bool {
        let denominator = u64::from(self.denominator).max(1);
        self.numerators.iter().all(|k| (k << bits).is_multiple_of(denominator))
    }
}

impl Long {
    /// The short form, if no bit is lost.
    #[inline]
    pub(crate) fn shortened(self) -> Option<Short> {
        ((self.0[0] | self.0[1]) as u64 == 0).then(|| Short(self.0.map(|t| (t >> 64) as u64)))
    }
}

/// The highest 53 of 64 bits, in `[0, 1)`.
#[inline]
fn unit(fraction: u64) -> f64 {
    const ULP: f64 = 1.0 / 9_007_199_254_740_992.0;
    (fraction >> 11) as i64 as f64 * ULP
}

/// `x` modulo 1 with 128 bits, and what was cut off at most; `None` unless `x` is finite.
#[inline]
pub(crate) fn turn(x: f64) -> Option<(u128, f64)> {
    const MANTISSA: u32 = 52;
    const CUT: f64 = 1.0 / 340_282_366_920_938_463_463_374_607_431_768_211_456.0;
    if !x.is_finite() {
        return None;
    }
    let bits = x.to_bits();
    let exponent = (bits >> MANTISSA) as i32 & 0x7FF;
    let fraction = bits & ((1 << MANTISSA) - 1);
    let mantissa = u128::from(if exponent == 0 { fraction } else { fraction | 1 << MANTISSA });
    // The mantissa's last bit weighs 2^(exponent − 1075), the word's 2⁻¹²⁸.
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
    fn doubles_become_their_fraction_of_a_turn() {
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
    fn both_lengths_move_alike() {
        let matrix = [[2, -1], [1, 2]];
        let mut long = Long([0.3, -0.7].map(|x| turn(x).unwrap().0));
        let mut short = long.shortened().unwrap();
        for step in 0..200 {
            for bits in [1, 5] {
                assert_eq!(long.cell(bits), short.cell(bits), "step {step}");
            }
            (long, short) = (long.moved(&matrix), short.moved(&matrix));
        }
        let tiny = Long([2f64.powi(-70), 0.5].map(|x| turn(x).unwrap().0));
        assert!(tiny.shortened().is_none() && !tiny.is_corner(1));
        assert!(Long([1 << 127, 0]).is_corner(1) && Short([1 << 63, 0]).is_corner(1));
    }
}
