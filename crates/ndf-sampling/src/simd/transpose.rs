//! Transposes 4 × 4 blocks in SIMD registers.

/// Instructions that turn squares of four by four; without the feature `simd` the unit type.
pub(crate) trait Transpose: TransposeSquare<f32> + TransposeSquare<f64> {}

impl<S: TransposeSquare<f32> + TransposeSquare<f64>> Transpose for S {}

/// Turns squares of `T`.
pub(crate) trait TransposeSquare<T>: Copy {
    fn transpose(self, rows: [[T; 4]; 4]) -> [[T; 4]; 4];
}

#[cfg(feature = "simd")]
macro_rules! transpose_by {
    ($type:ty, $interleave:ident) => {
        impl<S: fearless_simd::Simd> TransposeSquare<$type> for S {
            #[inline(always)]
            fn transpose(self, rows: [[$type; 4]; 4]) -> [[$type; 4]; 4] {
                let [a, b, c, d] = rows.map(|row| fearless_simd::SimdInto::simd_into(row, self));
                let ((p, q), (r, s)) = (self.$interleave(a, c), self.$interleave(b, d));
                let ((a, b), (c, d)) = (self.$interleave(p, r), self.$interleave(q, s));
                [a.into(), b.into(), c.into(), d.into()]
            }
        }
    };
}

#[cfg(feature = "simd")]
transpose_by!(f32, interleave_f32x4);
#[cfg(feature = "simd")]
transpose_by!(f64, interleave_f64x4);

#[cfg(not(feature = "simd"))]
impl<T: Copy> TransposeSquare<T> for () {
    fn transpose(self, rows: [[T; 4]; 4]) -> [[T; 4]; 4] {
        [0, 1, 2, 3].map(|lane| rows.map(|row| row[lane]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check<S: Transpose>(s: S) {
        let rows = [0_u8, 4, 8, 12].map(|from| [0, 1, 2, 3].map(|k| f64::from(from + k)));
        let transposed = [0_u8, 1, 2, 3].map(|from| [0, 4, 8, 12].map(|k| f64::from(from + k)));
        assert_eq!(s.transpose(rows), transposed);
        assert_eq!(
            s.transpose(rows.map(|row| row.map(|x| x as f32))),
            transposed.map(|row| row.map(|x| x as f32))
        );
    }

    #[test]
    fn rows_become_columns() {
        #[cfg(feature = "simd")]
        fearless_simd::dispatch!(crate::simd::dispatch::best_level(), simd => check(simd));
        #[cfg(not(feature = "simd"))]
        check(());
    }
}
