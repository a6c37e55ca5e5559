//! Octaves relative to an anchor far from the origin, each evaluated near it in its own cell.

/// Position of an anchor in the coordinates of an octave along an axis: cell + fraction, without
/// rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Position {
    cell: i64,
    fraction: f64,
}

/// Positions from here on are rejected.
const LIMIT: f64 = 4_611_686_018_427_387_904.0 / 16.0;

impl Position {
    /// Adds a number that `f64` holds exactly; `None` if the sum is too large or not a number.
    fn add(self, exact: f64) -> Option<Self> {
        if !(exact > -LIMIT && exact < LIMIT) {
            return None;
        }
        let whole = exact as i64;
        Some(Self { cell: self.cell.wrapping_add(whole), fraction: self.fraction + (exact - whole as f64) })
    }

    /// The same position with a fraction in [0, 1].
    fn floored(self) -> Self {
        let truncated = self.fraction as i64;
        let floor = if self.fraction < truncated as f64 { truncated - 1 } else { truncated };
        Self { cell: self.cell.wrapping_add(floor), fraction: self.fraction - floor as f64 }
    }

    /// row · at + offset: products of 24 bits with halves of 26 and 27.
    fn new(row: &[f32], at: &[f64], offset: f32) -> Option<Self> {
        let mut sum = Self { cell: 0, fraction: f64::from(offset) };
        for (entry, x) in row.iter().zip(at) {
            let high = f64::from_bits(x.to_bits() & !0x7ff_ffff);
            for part in [high, x - high] {
                sum = sum.add(f64::from(*entry) * part)?;
            }
        }
        Some(sum.floored())
    }
}

/// (1 − 1/√(n + 1))/n in 1 to 4 dimensions, in four parts of 24 bits.
const UNSKEW: [[f64; 4]; 4] = [
    [0.0; 4],
    [
        0.211_324_855_685_234_07,
        9.719_952_842_601_742e-9,
        2.053_194_629_254_623_2e-16,
        1.629_890_759_826_099_6e-24,
    ],
    [0.166_666_656_732_559_2, 9.934_106_870_446_158e-9, 5.921_189_111_737_107e-16, 3.529_303_736_530_01e-23],
    [
        0.138_196_587_562_561_04,
        1.356_244_894_168_412_4e-8,
        5.383_391_482_261_999e-16,
        1.879_755_667_351_070_2e-23,
    ],
];
/// (√(n + 1) − 1)/n.
const SKEW: [f64; 4] = [0.0, 0.366_025_403_784_438_65, 1.0 / 3.0, 0.309_016_994_374_947_4];

/// The cell of an anchor in an octave, modulo 2³², and the position relative to the cell.
///
/// `matrix` and `offset` map points into the octave. The position is near the corner of the
/// cell, inside the cell if cells are cubes. `None` if a coordinate is 2⁵⁸ or more, or not a
/// number.
pub(crate) fn anchored<const N: usize>(
    matrix: &[[f32; N]; N],
    at: &[f64; N],
    offset: &[f32; N],
    simplicial: bool,
) -> Option<([i32; N], [f32; N])> {
    let mut positions = [Position { cell: 0, fraction: 0.0 }; N];
    for axis in 0..N {
        positions[axis] = Position::new(&matrix[axis], at, offset[axis])?;
    }
    let (mut shift, mut back) = (0, 0.0);
    if simplicial && N > 1 {
        // A step of the skewed lattice to near the anchor. Any step works, but its corner must be
        // exact to the last digit, and the corner is the small difference of large numbers.
        let sum = positions.iter().fold(0_i64, |sum, position| sum.wrapping_add(position.cell));
        shift = (SKEW[N - 1] * sum as f64) as i64;
        let corners = sum.wrapping_add(shift.wrapping_mul(N as i64));
        let mut unskewed = Position { cell: shift.wrapping_neg(), fraction: 0.0 };
        for part in UNSKEW[N - 1] {
            for (bits, scale) in [(0, 1.0), (28, 268_435_456.0), (56, 72_057_594_037_927_936.0)] {
                // The last part keeps the sign.
                let digits = if bits == 56 { corners >> bits } else { corners >> bits & 0xfff_ffff };
                unskewed = unskewed.add(part * (digits as f64 * scale))?;
            }
        }
        back = unskewed.cell as f64 + unskewed.fraction;
    }
    Some((
        positions.map(|position| position.cell.wrapping_add(shift) as i32),
        positions.map(|position| (position.fraction + back) as f32),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_are_exact() {
        // 1e12 + 1/8192 times a number of 24 bits, in integers.
        let (x, entry) = (1e12 + 1.0 / 8192.0, 2.17_f32);
        let scaled = i128::from(8_192_000_000_000_001_i64) * i128::from((entry * 4_194_304.0) as i64);
        let denominator = 8192 * 4_194_304_i128;
        let position = Position::new(&[entry], &[x], 0.0).unwrap();
        assert_eq!(i128::from(position.cell), scaled.div_euclid(denominator));
        assert_eq!(position.fraction, scaled.rem_euclid(denominator) as f64 / denominator as f64);
        let negative = Position::new(&[entry], &[-x], 0.0).unwrap();
        assert_eq!(negative.cell, -position.cell - 1);
        assert_eq!(negative.fraction, 1.0 - position.fraction);
        for x in [f64::NAN, f64::INFINITY, 1e18, f64::MIN] {
            assert_eq!(Position::new(&[entry], &[x], 0.5), None, "{x}");
        }
    }

    #[test]
    fn parts_of_the_unskewing_factors_add_up() {
        for (n, parts) in (1..).zip(UNSKEW).skip(1) {
            let n = f64::from(n);
            let factor = (1.0 - 1.0 / f64::from(asperity_core::math::sqrt((n + 1.0) as f32))) / n;
            approx::assert_abs_diff_eq!(parts.iter().sum::<f64>(), factor, epsilon = 1e-7);
            for part in parts {
                assert_eq!(part.to_bits() & 0x1fff_ffff, 0, "24 bits: {part}");
            }
        }
    }
}
