//! Transposes of 4 × 4 blocks.

use crate::lanes::lanes::Scalar;
#[cfg(feature = "simd")]
use crate::lanes::registers::Registers;

/// A token that transposes 4 × 4 blocks of `f32` and `f64`.
pub trait Transpose: TransposeSquare<f32> + TransposeSquare<f64> {}

impl<S: TransposeSquare<f32> + TransposeSquare<f64>> Transpose for S {}

/// Transposes blocks of `T`.
pub trait TransposeSquare<T>: Copy {
    /// The columns of the rows.
    fn transpose(self, rows: [[T; 4]; 4]) -> [[T; 4]; 4];
}

#[cfg(feature = "simd")]
macro_rules! transpose_by {
    ($type:ty, $interleave:ident) => {
        impl<S: fearless_simd::Simd, D: Copy> TransposeSquare<$type> for Registers<S, D> {
            #[inline(always)]
            fn transpose(self, rows: [[$type; 4]; 4]) -> [[$type; 4]; 4] {
                let simd = self.simd;
                let [a, b, c, d] = rows.map(|row| fearless_simd::SimdInto::simd_into(row, simd));
                let ((p, q), (r, s)) = (simd.$interleave(a, c), simd.$interleave(b, d));
                let ((a, b), (c, d)) = (simd.$interleave(p, r), simd.$interleave(q, s));
                [a.into(), b.into(), c.into(), d.into()]
            }
        }
    };
}

#[cfg(feature = "simd")]
transpose_by!(f32, interleave_f32x4);
#[cfg(feature = "simd")]
transpose_by!(f64, interleave_f64x4);

impl<T: Copy> TransposeSquare<T> for Scalar {
    #[inline(always)]
    fn transpose(self, rows: [[T; 4]; 4]) -> [[T; 4]; 4] {
        [0, 1, 2, 3].map(|lane| rows.map(|row| row[lane]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(s: impl Transpose) {
        let rows = [0_u8, 4, 8, 12].map(|from| [0, 1, 2, 3].map(|k| f64::from(from + k)));
        let transposed = [0_u8, 1, 2, 3].map(|from| [0, 4, 8, 12].map(|k| f64::from(from + k)));
        let narrow = |block: [[f64; 4]; 4]| block.map(|row| row.map(|x| x as f32));
        assert_eq!(s.transpose(rows), transposed);
        assert_eq!(s.transpose(narrow(rows)), narrow(transposed));
    }

    #[test]
    fn transpose_rows() {
        check(Scalar);
        #[cfg(feature = "simd")]
        crate::lanes::dispatch::each_level(
            |level| fearless_simd::dispatch!(level, simd => check(Registers::new(simd))),
        );
    }
}
