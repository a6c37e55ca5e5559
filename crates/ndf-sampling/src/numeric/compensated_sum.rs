//! Compensated summation.

/// Neumaier's compensated sums of non-negative terms in lanes.
///
/// Their error does not grow with the number of terms.
#[derive(Clone, Copy)]
pub(crate) struct CompensatedSums<const N: usize> {
    sums: [f64; N],
    lost: [f64; N],
}

impl<const N: usize> Default for CompensatedSums<N> {
    fn default() -> Self {
        Self { sums: [0.0; N], lost: [0.0; N] }
    }
}

impl<const N: usize> CompensatedSums<N> {
    #[inline(always)]
    pub(crate) fn add(&mut self, terms: [f64; N]) {
        for ((before, lost), term) in self.sums.iter_mut().zip(&mut self.lost).zip(terms) {
            let sum = *before + term;
            let (less, more) = if *before < term { (*before, term) } else { (term, *before) };
            // The rounding error of the smaller term, from Dekker's exact sum: the same number with
            // fewer additions.
            *lost += less - (sum - more);
            *before = sum;
        }
    }

    #[inline(always)]
    pub(crate) fn values(&self) -> [f64; N] {
        core::array::from_fn(|k| self.sums[k] + self.lost[k])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_terms_survive_a_large_one() {
        let mut sums = CompensatedSums::default();
        sums.add([1e16, 0.0]);
        for k in 1..1000 {
            sums.add([1.0, 0.1]);
            assert_eq!(sums.values()[0], 1e16 + f64::from(k));
        }
        assert_eq!(sums.values()[1], 99.9);
    }
}
